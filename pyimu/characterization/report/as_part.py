"""A characterised sensor as a part file: what ``pyimu build`` simulates and ``pyimu close``
compares with.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.characterization.report.words import (
    COARSE,
    PEOPLE,
    doubts,
    duration,
    rounding_share,
    span,
)
from pyimu.characterization.result import SAMPLE, SI, Characterization
from pyimu.characterization.temperature.fit import ThermalFit
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import AXES, Part
from pyimu.model.sensor import Sensor
from pyimu.report.numbers import number, quantity
from pyimu.units import convert

EFFECTS = {
    "N": ("angle_random_walk", "N"),
    "B": ("bias_instability", "B"),
    "K": ("rate_random_walk", "K"),
    "Q": ("angle_quantization", "q"),
}
"""Where a coefficient stands in a part. A ramp belongs to a log."""

FLICKER_REACH = 10.0
"""Flicker is simulated up to so many times the frequency at which it crosses the white noise, and
down to a tenth of one over the log."""


DIGITS, EXACT = 5, 10
"""Figures of a coefficient in the file, none is known better; and of a step of the samples, which
is."""


def part_of(c: Characterization, name: str) -> Part:
    """The part: noise of both sensors, the gyro's turn-on bias, temperature effect and rounding
    where they were seen.

    The white noise that rounding makes is in the measured N; where rounding becomes an effect of
    the part it is taken out of it. A coefficient with a bound only is zero, and its source says the
    bound. The accelerometer's bias cannot be told from gravity, and is left to the data.
    """
    values: dict[str, dict] = {kind: {} for kind in ("gyro", "accel")}
    notes: dict[tuple[str, str, str], dict[str, str]] = {}
    for kind in c.kinds:
        for effect, parameter, value, unit, source in (
            *_bias(c, kind),
            *_thermal(c, kind),
            *_noise(c, kind),
        ):
            si = Sensor(kind).unit(CATALOGUE[effect].parameters[parameter].unit)
            values[kind].setdefault(effect, {})[parameter] = _tidy(value, parameter, si, unit)
            notes[kind, effect, parameter] = {
                k: v for k, v in (("unit", unit), ("source", source)) if v
            }
    rate = 1 / min(s.h for log in c.logs for s in log.sensors.values())
    rest = "not at rest" if any(f.kind == "motion" for f in c.findings) else "at rest"
    said = "".join(f" {text}" for log in c.logs for text in doubts(log))
    logs = ", ".join(f"{log.name} ({duration(log.duration)})" for log in c.logs)
    return Part(
        name,
        rate,
        Sensor("gyro", values["gyro"]),
        Sensor("accel", values["accel"]),
        notes=notes,
        description=(
            f"Characterised by pyimu from {logs}; {rest}. N is the root of the two-sided "
            f"density.{said}"
        ),
    )


def _tidy(value: np.ndarray, parameter: str, si: str, unit: str) -> np.ndarray:
    """SI values rounded to so many figures in the unit in which the file says them, so that it says
    them exactly.
    """
    if si == "degC":
        return np.round(value, 3)
    digits = EXACT if parameter == "q" else DIGITS
    shown = convert(value, si, unit)
    return np.asarray(
        convert(np.vectorize(lambda v: float(f"{v:.{digits - 1}e}"))(shown), unit, si)
    )


Entry = tuple[str, str, np.ndarray, str, str]


def _noise(c: Characterization, kind: str) -> Iterator[Entry]:
    rounding = _rounding(c, kind)
    for term, (effect, parameter) in EFFECTS.items():
        found = [c.coefficients.get((f"{kind}_{axis}", term)) for axis in AXES]
        if not any(s is not None and s.mean.needed for s in found):
            continue
        value = np.array([s.mean.value if s is not None else 0.0 for s in found])
        source = (
            "this characterisation, "
            f"{'; '.join(_said(s, kind, term, axis) for s, axis in zip(found, AXES, strict=True))}"
        )
        unit = PEOPLE[kind][term]
        if term == "N" and rounding is not None:
            value = np.sqrt(value**2 - rounding**2 * _h(c, kind) / 12)
            source += "; less the noise of rounding"
        if term == "Q":
            value, unit = value * np.sqrt(12), SI[kind][term]
        yield effect, parameter, value, unit, source
        if term == "B":
            yield from _band(c, kind)
    if rounding is not None:
        yield (
            "quantization",
            "q",
            rounding,
            {"gyro": "deg/s", "accel": "mg"}[kind],
            "the step on whose multiples the samples lie",
        )


def _said(s, kind: str, term: str, axis: str) -> str:
    if s is None:
        return f"{axis} not characterised"
    return f"{axis} {span(s.mean, SI[kind][term], PEOPLE[kind][term])} {PEOPLE[kind][term]}"


def _h(c: Characterization, kind: str) -> float:
    return next(log.sensors[kind].h for log in c.logs if kind in log.sensors)


def _rounding(c: Characterization, kind: str) -> np.ndarray | None:
    """The steps (3,) of the samples, zero where there is none; None where no axis has one, or where
    it is more than ``COARSE`` of the noise.
    """
    steps = np.zeros(3)
    for f in c.findings:
        if f.kind == "quantization_step" and f.column.startswith(kind):
            steps[AXES.index(f.column[-1])] = f.detail["step"]
    white = [c.coefficients.get((f"{kind}_{axis}", "N")) for axis in AXES]
    share = [
        rounding_share(q, s.mean.value if s is not None else 0.0, _h(c, kind))
        for q, s in zip(steps, white, strict=True)
        if q
    ]
    return steps if share and max(share) <= COARSE else None


def _band(c: Characterization, kind: str) -> Iterator[Entry]:
    """Two to five decades, from where white noise hides flicker to where the logs end."""
    longest = max(log.duration for log in c.logs)
    crossing = []
    for axis in AXES:
        pair = [c.coefficients.get((f"{kind}_{axis}", t)) for t in "BN"]
        if all(s is not None and s.mean.needed for s in pair):
            crossing.append(pair[0].mean.value ** 2 / (2 * np.pi * pair[1].mean.value ** 2))
    nyquist = 0.5 / _h(c, kind)
    high = min(max(FLICKER_REACH * max(crossing, default=1.0), 100 / longest), nyquist)
    low = float(np.clip(0.1 / longest, 1.001e-5 * high, 0.99e-2 * high))
    said = (
        "where white noise hides the flicker, ten times over; and a tenth of one over the longest "
        "log"
    )
    yield "bias_instability", "f_low", np.array(low), "Hz", said
    yield "bias_instability", "f_high", np.array(high), "Hz", said


def _thermal(c: Characterization, kind: str) -> Iterator[Entry]:
    """The coefficients that are warranted in at least half of the logs, means weighted by their
    standard errors.
    """
    fits = [
        [ch.thermal for ch in c.channel(f"{kind}_{axis}") if ch.thermal is not None]
        for axis in AXES
    ]
    T0 = next((t.T0 for f in fits for t in f), None)
    for order, (effect, name) in enumerate(
        (("thermal_bias", "kT"), ("thermal_bias_quadratic", "k2"), ("thermal_bias_cubic", "k3")), 1
    ):
        value, said = np.zeros(3), []
        for i, found in enumerate(fits):
            warranted = [t.coefficients[name] for t in found if t.order >= order]
            if warranted and 2 * len(warranted) >= len(found):
                weights = np.array([1 / k.std**2 for k in warranted])
                value[i] = np.sum(weights * [k.value for k in warranted]) / weights.sum()
                said.append(
                    f"{AXES[i]} with a standard error of "
                    f"{number(100 / np.sqrt(weights.sum()) / abs(value[i]), 2)} %"
                )
        if said:
            unit = SAMPLE[kind] + ("/K" if order == 1 else f"/K^{order}")
            shown = {"rad/s/K": "deg/s/K", "m/s^2/K": "mg/K"}.get(unit, unit)
            yield effect, name, value, shown, "this characterisation, " + ", ".join(said)
            yield effect, "T0", np.array(T0), "degC", ""
    yield from _hysteresis(fits, kind)


def _hysteresis(fits: list[list[ThermalFit]], kind: str) -> Iterator[Entry]:
    """Loops that are warranted in at least half of the logs; of one width, as a sensor has in the
    catalogue, that keeps each one's opening.
    """
    loops = [
        [t.hysteresis for t in found if t.hysteresis is not None and t.hysteresis.warranted]
        for found in fits
    ]
    kept = [
        own if own and 2 * len(own) >= len(found) else []
        for own, found in zip(loops, fits, strict=True)
    ]
    if not any(kept):
        return
    width = float(np.median([h.width for own in kept for h in own]))
    opening = np.array([np.mean([h.opening.value for h in own]) if own else 0.0 for own in kept])
    unit = {"gyro": "deg/h/K", "accel": "mg/K"}[kind]
    said = ", ".join(
        f"{AXES[i]} opens by {quantity(opening[i], SAMPLE[kind])}"
        for i, own in enumerate(kept)
        if own
    )
    yield "thermal_hysteresis", "kh", -opening / (2 * width), unit, f"this characterisation, {said}"
    yield (
        "thermal_hysteresis",
        "width",
        np.array(width),
        "K",
        "of the widths that were tried the most significant",
    )


def _bias(c: Characterization, kind: str) -> Iterator[Entry]:
    if kind != "gyro":
        return
    by_log = [
        [
            ch.thermal.coefficients["b0"].value
            if ch.thermal is not None and ch.thermal.order
            else ch.mean
            for ch in c.channel(f"{kind}_{axis}")
        ]
        for axis in AXES
    ]
    # An axis without samples has none.
    by_log = [[v for v in b if np.isfinite(v)] or [0.0] for b in by_log]
    value = np.array([np.mean(b) for b in by_log])
    spread = [np.std(b, ddof=1) for b in by_log] if min(map(len, by_log)) > 1 else []
    said = (
        "; standard deviations of the logs "
        f"{', '.join(number(convert(s, 'rad/s', 'deg/s')) for s in spread)} deg/s"
        if spread
        else ""
    )
    yield (
        "turn_on_bias",
        "b0",
        value,
        "deg/s",
        f"mean of the logs, the Earth's rate included; a new draw at each power-on{said}",
    )
