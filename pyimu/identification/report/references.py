"""What was found of each log's reference: an instrument with a clock, a mounting and noise."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.files import plain
from pyimu.identification.errors.held_out import clock_of, log_state
from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.keys import LogPlace
from pyimu.identification.fit.noise_floor import reference_variance
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.scales import Scale
from pyimu.identification.search.investigation import Investigation
from pyimu.recording.recording import Recording

NATURE = {
    "rate": "ref_rate",
    "attitude": "ref_q",
    "heading": "ref_heading",
    "force": "ref_force",
}
"""The group of a recording that a kind of reference is read from."""


def references(
    found: Mapping[str, Investigation], logs: list[Recording], scales: Mapping[str, Scale]
) -> tuple[dict[str, Any], ...]:
    """The reference of each log, as report.json has it: the gyro's, else the accelerometer's; and
    that of the force where it acts at another point than the sensor, with the ``scales`` of
    positions.

    ``clock_offset`` is by how much later than the reference says the sensor shows the motion, less
    what is left to the sensor; it is positive where the sensor is late. ``clock_skew`` is by how
    much that grows in a second, ``slips`` when it jumps, and by how much. ``or_sensor`` says that
    the sensor may be late by what was taken out, which one log beside a reference on another clock
    does not tell.
    """
    entries = []
    for r in logs:
        of_log = [(k, inv, t) for k, inv in found.items() if (t := _trial(inv, r.name)) is not None]
        moving = [one for one in of_log if one[2].reference != "static"]
        first = (moving or of_log)[:1]
        forces = [one for one in moving[1:] if one[2].place is not None]
        entries += [_entry(r, *one, scales) for one in (*first, *forces)]
    return tuple(entries)


def _trial(inv: Investigation, name: str) -> Trial | None:
    return next((t for t in (*inv.after.trials, *inv.held) if t.name == name), None)


def _entry(
    r: Recording, kind: str, inv: Investigation, t: Trial, scales: Mapping[str, Scale]
) -> dict[str, Any]:
    noise = np.sqrt(reference_variance(inv.after, t.name))
    state = log_state(inv, r.name)
    clock, turn = clock_of(inv, r.name), Rotation.from_matrix(state["rotation"]).magnitude()
    offset, skew = _clock(clock)
    return plain(
        {
            "file": r.path.name if r.path else r.name,
            "sensor": kind,
            "kind": t.reference,
            "clock_offset": offset,
            "clock_skew": skew,
            "slips": None if clock is None else [s.as_dict() | {"unit": "s"} for s in clock.slips],
            "lag": None if clock is None or clock.keeps_step else _lag(clock),
            "taken_out": clock is not None and clock.taken_out,
            "or_sensor": clock is not None and clock.or_sensor,
            "left_to_sensor": None if clock is None else {"value": clock.own, "unit": "s"},
            "mounting": {
                "rotation": state["rotation"],
                "angle": {"value": turn, "unit": "rad"},
                "estimated": t.free_rotation,
            },
            "arm": _arm(inv, t, state),
            "scale": scales[t.name].as_dict() if t.place and t.name in scales else None,
            "noise": _noise(t, noise, inv.after.sensor.output.unit),
            "sample_rate": {"value": _own_rate(r, t), "unit": "Hz"},
            "band_hz": t.band_hz,
            "explains": None if clock is None else clock.explained,
        }
    )


def _clock(clock: Clock | None) -> tuple[dict[str, Any] | None, dict[str, Any] | None]:
    """Offset [s], and by how much it grows in a second where it does so steadily."""
    if clock is None or not np.isfinite(clock.std):
        return None, None
    offset = {"value": clock.mean, "std": clock.std, "unit": "s"}
    offset |= {"least": float(clock.late.min()), "most": float(clock.late.max())}
    if clock.skew is None:
        return offset, None
    value, std = clock.skew
    return offset, {"value": value, "std": std, "unit": "1"}


def _lag(clock: Clock) -> dict[str, Any]:
    """The lag [s] over the log's time [s], where it is not constant."""
    return {"time": clock.time, "late": clock.late, "unit": "s"}


def _arm(inv: Investigation, t: Trial, state: dict[str, Any]) -> dict[str, Any] | None:
    """Where the sensor is (3,) in the body that the reference tracks, from the point whose
    positions it gives; None where its force is the sensor's.
    """
    if t.place is None:
        return None
    std = [inv.after.std.get(LogPlace(t.name, k), np.nan) for k in range(3)]
    return {"value": state["place"][:3], "std": std, "unit": "m"}


def _noise(t: Trial, in_band: np.ndarray, unit: str) -> dict[str, Any] | None:
    """Root mean square (3,) of the reference's noise.

    In the band of a derivative, else in each of its rows; None where it has none to speak of.
    """
    value = in_band if t.band_hz is not None else None if t.noise is None else t.noise.std(axis=0)
    if value is None:
        return None
    covered = np.isin(np.arange(3), t.axes)
    return {"value": np.where(covered, value, np.nan), "unit": unit}


def _own_rate(r: Recording, t: Trial) -> float | None:
    """Hz; how often the reference has a new value, most of the time; None where it has no rows."""
    if t.band_limit is not None:
        return 4.0 * t.band_limit
    r = r.reference or r
    values = getattr(r, NATURE.get(t.reference, ""), None)
    if values is None:
        return None
    known = np.flatnonzero(np.isfinite(values.reshape(len(values), -1)).all(axis=1))
    return float(1 / np.median(np.diff(r.time[known]))) if len(known) > 1 else None
