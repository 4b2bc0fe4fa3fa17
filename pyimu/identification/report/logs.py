"""The logs: what each holds, what was estimated of it, and its reference."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from markupsafe import Markup, escape
from scipy.spatial.transform import Rotation

from pyimu.identification.found.entries import LogEntry
from pyimu.identification.logs.overview import Overview
from pyimu.identification.model.as_part import SENSORS
from pyimu.identification.outcome import Outcome
from pyimu.identification.reference.align import SIGNIFICANT
from pyimu.identification.report.errors import BESIDE
from pyimu.identification.report.strips import lags, strips
from pyimu.model.part import AXES
from pyimu.report.numbers import MISSING, in_unit, joined, number, pretty, unit_for, with_error
from pyimu.report.page import Picture, Table, both, file_name, prose


def overview_table(closed: Outcome) -> Table:
    """What each log holds, as it was measured."""
    table = Table(
        ("recording", "length", "held out", "at rest", "rate", "force", "temperature", "faults")
    )
    for r in closed.recordings:
        if r.overview is not None:
            table.rows.append((file_name(r.file), *_overview(r, r.overview)))
    return table


def _overview(r: LogEntry, o: Overview) -> tuple:
    share = r.held_out / max(r.samples, 1)
    return (
        _under(f"{number(o.duration, 4)} s", f"{r.samples:,} rows", f"{o.rate:.6g} Hz"),
        _under(f"{100 * share:.0f} %", f"{r.held_out:,} rows") if r.held_out else _in_turn(r),
        f"{100 * o.rest:.0f} %",
        MISSING if o.turning is None else _turning(*o.turning),
        MISSING if o.force is None else _by_axis(o.force, "m/s^2"),
        MISSING if o.temperature is None else _range(*o.temperature),
        _faults(o),
    )


def _in_turn(r: LogEntry) -> str:
    """Whether rests are left out of the fit in turn, where no rows are held out."""
    return "in turn" if any(e.data for e in r.errors.values()) else "none"


def _under(first: str, *more: str) -> Markup:
    """Lines of a cell, the later ones small."""
    return escape(first) + Markup("").join(
        Markup("<small>{}</small>").format(_unbroken(m)) for m in more
    )


def _unbroken(text: str) -> str:
    return text.replace(" ", "\u00a0")


def _by_axis(values: np.ndarray, si: str) -> Markup:
    unit = unit_for(values[np.isfinite(values)], si)
    each = [(a, v) for a, v in zip(AXES, values) if np.isfinite(v)]
    shown = [f"{a} {number(float(in_unit(v, si, unit)), 2)}" for a, v in each]
    return Markup("<br>").join([*shown[:-1], f"{shown[-1]} {pretty(unit)}"])


def _turning(rms: np.ndarray, largest: np.ndarray) -> Markup:
    """Of each axis the rms, and in brackets the largest."""
    unit = unit_for(rms, "rad/s")
    pairs = [
        " (".join(number(float(in_unit(v, "rad/s", unit)), 2) for v in both_of) + ")"
        for both_of in zip(rms, largest)
    ]
    lines = [f"{a} {pair}" for a, pair in zip(AXES, pairs)]
    return Markup("<br>").join([*lines[:2], f"{lines[2]} {pretty(unit)}"])


def _range(least: float, most: float) -> str:
    return f"{least:.1f} to {most:.1f} °C"


def _faults(o: Overview) -> Markup | str:
    said = [f"{o.gaps} gap{'s' * (o.gaps > 1)}, {number(o.missing)} s"] if o.gaps else []
    said += [f"{c.replace('_', ' ')}: {n:,} clipped" for c, n in o.clipped.items()]
    return prose("; ".join(said)) if said else "none seen"


def overviews(closed: Outcome) -> list[Picture]:
    """The rate and the temperature of each log over its own time."""
    drawn = [r for r in closed.recordings if r.overview is not None and r.overview.speed]
    return [_strips(drawn[k : k + BESIDE]) for k in range(0, len(drawn), BESIDE)]


def _strips(logs: Sequence[LogEntry]) -> Picture:
    svg = Markup(strips([(r.file, r.overview) for r in logs]))
    names = ", ".join(r.file for r in logs)
    warm = " and temperature" if any(r.overview.warmth for r in logs) else ""
    caption = (
        f"Size of the measured rate{warm} of {names}; time is that of the log's own time column. "
        "Shaded: rows that were held out."
    )
    return Picture(svg, caption, f"rate{warm} of {names} over time")


def log_states(closed: Outcome) -> Table:
    """What belongs to a log and not to the part."""
    table = Table(("recording", "sensor", "bias x", "bias y", "bias z", "mounting rotation"))
    for r in closed.recordings:
        for kind, state in r.log_state.items():
            si = closed.after.sensor(kind).output.unit
            unit = unit_for([b for b in state["bias"] if b is not None], si)
            bias = [both(b, si, unit) for b in state["bias"]]
            turn = _turn(state.get("rotation"))
            table.rows.append((file_name(r.file), SENSORS[kind], *bias, turn))
    return table


def reference_table(closed: Outcome) -> Table:
    """Of each log the instrument that it is compared with."""
    head = ("recording", "reference", "rate and band", "late by [ms]", "the lag is")
    away = any(entry["arm"] for entry in closed.references)
    scaled = any(entry["scale"] for entry in closed.references)
    more = [*(["the sensor's place"] if away else []), *(["positions' scale"] if scaled else [])]
    table = Table((*head, *more, "noise", "explains"))
    for entry in closed.references:
        table.rows.append(
            (
                file_name(entry["file"]),
                _under(*KINDS_OF_REFERENCE[entry["kind"]], f"of the {SENSORS[entry['sensor']]}"),
                _rates(entry["sample_rate"]["value"], entry["band_hz"]),
                *map(prose, _lag(entry)),
                *([_arm(entry["arm"])] if away else []),
                *([_scale(entry["scale"])] if scaled else []),
                _noise(entry["noise"]),
                MISSING if entry["explains"] is None else f"{100 * entry['explains']:.4g} %",
            )
        )
    return table


def lag_pictures(closed: Outcome) -> list[Picture]:
    """The lag of each log over its time, where it is not constant."""
    drawn = [e for e in closed.references if e["lag"]]
    return [_lags(drawn[k : k + BESIDE]) for k in range(0, len(drawn), BESIDE)]


def _lags(entries: Sequence[dict[str, Any]]) -> Picture:
    logs = [(e["file"], *(np.array(e["lag"][k]) for k in ("time", "late"))) for e in entries]
    names = ", ".join(name for name, *_ in logs)
    caption = (
        f"How late the sensor shows the motion by the clock of the reference of {names}: a slope "
        "is two clocks at different rates, a jump one that slips."
    )
    return Picture(Markup(lags(logs)), caption, f"lag of {names} over time")


KINDS_OF_REFERENCE = {
    "rate": ("rate",),
    "attitude": ("attitude", "differentiated"),
    "heading": ("heading", "differentiated"),
    "course": ("course", "differentiated"),
    "force": ("force",),
    "position": ("position and attitude", "differentiated"),
    "velocity": ("velocity and attitude", "differentiated"),
    "gravity": ("gravity", "in rests"),
    "static": ("rest",),
}


def _rates(own: float | None, band: float | None) -> Any:
    """How often the reference has a new value, and the band in which it is used."""
    if own is None:
        return MISSING
    return _under(f"{number(own, 4)} Hz", *([] if band is None else [f"below {number(band)} Hz"]))


def _arm(arm: dict[str, Any] | None) -> Any:
    """Where the sensor is from the point that the reference tracks, by the body's axes."""
    if arm is None:
        return MISSING
    value, std = (np.array(arm[k], dtype=float) for k in ("value", "std"))
    unit = "mm" if np.abs(value).max() < 1.0 else "m"
    each = [
        with_error(float(in_unit(v, "m", unit)), float(in_unit(s, "m", unit)))
        if np.isfinite(s)
        else number(float(in_unit(v, "m", unit)))
        for v, s in zip(value, std, strict=True)
    ]
    lines = [f"{a} {shown}" for a, shown in zip(AXES, each, strict=True)]
    return Markup("<br>").join([*lines[:2], f"{lines[2]} {pretty(unit)}"])


def _scale(scale: dict[str, Any] | None) -> str:
    """How many times as large as the body's way positions are."""
    return MISSING if scale is None else with_error(scale["value"], scale["std"])


def _noise(noise: dict[str, Any] | None) -> Any:
    if noise is None or not any(noise["value"]):
        return MISSING
    return _by_axis(np.array(noise["value"], dtype=float), noise["unit"])


def _lag(entry: dict[str, Any]) -> tuple[str, str]:
    """How late the sensor is by the reference's clock, and what became of it."""
    offset, own = entry["clock_offset"], entry["left_to_sensor"]
    if own is None:
        return MISSING, MISSING
    if offset is None:
        return "not seen", "too few rows follow the reference"
    late, least, most = (1e3 * (offset[k] + own["value"]) for k in ("value", "least", "most"))
    if least != most:
        said = f"{number(least)} to {number(most)}"
    else:
        said = with_error(late, 1e3 * offset["std"])
    if entry["taken_out"]:
        whose = "the clocks' or the sensor's" if entry["or_sensor"] else "the clocks'"
        return said, f"{whose}, taken out{_course(entry)}"
    return said, "left to the sensor" if own["value"] else f"within {SIGNIFICANT:g} of its errors"


def _course(entry: dict[str, Any]) -> str:
    """How a lag that is not constant goes on."""
    skew, slips = entry["clock_skew"], entry["slips"]
    if skew is None:
        offset = entry["clock_offset"]
        return "; it wanders" if offset["least"] != offset["most"] else ""
    said = f"; it grows by {with_error(1e6 * skew['value'], 1e6 * skew['std'])} ppm"
    if not slips:
        return said
    times = joined([f"{s['time']:.0f}" for s in slips])
    size = number(1e3 * abs(slips[0]["size"]))
    return f"{said}, and slips by {size} ms at {times} s"


def _turn(rotation: list | None) -> Any:
    """Angle of a rotation matrix; none where it is the identity."""
    if rotation is None:
        return MISSING
    angle = float(Rotation.from_matrix(rotation).magnitude())
    return both(angle, "rad") if angle else "none"
