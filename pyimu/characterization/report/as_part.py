"""A characterised sensor as a part, for ``pyimu build`` and ``pyimu close``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from pyimu.characterization.outcome import SAMPLE, SI, Channel, Outcome, Summary
from pyimu.characterization.report.coefficients import SAMPLE_UNIT, UNITS, with_interval
from pyimu.characterization.report.log_notes import (
    COARSE,
    doubts,
    duration,
    left_out,
    rounding_share,
)
from pyimu.characterization.temperature import fit as thermal_fit
from pyimu.characterization.temperature.fit import ThermalFit
from pyimu.characterization.temperature.hysteresis import Hysteresis
from pyimu.model.part import AXES, Part
from pyimu.model.part_value import DIGITS, EXACT, PartValue, with_values
from pyimu.model.sensor import Sensor
from pyimu.report.numbers import number, quantity
from pyimu.units import convert

EFFECTS = {
    "N": ("angle_random_walk", "N"),
    "B": ("bias_instability", "B"),
    "K": ("rate_random_walk", "K"),
    "Q": ("angle_quantization", "q"),
}
"""The effect and its parameter that a coefficient is in a part. A ramp belongs to a log."""

FLICKER_REACH = 10.0
"""Flicker is simulated up to so many times the frequency at which it crosses the white noise, and
down to a tenth of one over the duration of the log."""


def part_of(c: Outcome, name: str) -> Part:
    """The part that was characterised, as ``Characterization.part`` describes it.

    The white noise that rounding makes is in the measured N; where rounding becomes an effect of
    the part, that noise is subtracted from N.
    """
    sensors, notes = {}, {}
    for kind in SI:
        found = (*_bias(c, kind), *_thermal(c, kind), *_noise(c, kind)) if kind in c.kinds else ()
        sensors[kind], said = with_values(Sensor(kind), found)
        notes |= said
    return Part(
        name,
        1 / min(s.h for log in c.logs for s in log.sensors.values()),
        **sensors,
        notes=notes,
        description=_description(c),
    )


def _description(c: Outcome) -> str:
    logs = ", ".join(f"{log.name} ({duration(log.duration)})" for log in c.logs)
    rest = "not at rest" if any(f.kind == "motion" for f in c.findings) else "at rest"
    doubted = "".join(f" {text}" for log in c.logs for text in (*doubts(log), *left_out(log)))
    return (
        f"Characterised by pyimu from {logs}; {rest}. N is the root of the two-sided "
        f"density.{doubted}"
    )


# Noise


def _noise(c: Outcome, kind: str) -> Iterator[PartValue]:
    rounding = _rounding(c, kind)
    for term, (effect, parameter) in EFFECTS.items():
        found = _summaries(c, kind, term)
        if not any(s is not None and s.mean.needed for s in found):
            continue
        value = np.array([s.mean.value if s is not None else 0.0 for s in found])
        each = (_source(s, kind, term, axis) for s, axis in zip(found, AXES, strict=True))
        source, unit = f"this characterisation, {'; '.join(each)}", UNITS[kind][term]
        if term == "N" and rounding is not None:
            value = np.sqrt(value**2 - rounding**2 * _h(c, kind) / 12)
            source += "; less the noise of rounding"
        if term == "Q":
            # The angle is rounded to steps of q, with the variance q^2 / 12.
            value, unit = value * np.sqrt(12), SI[kind][term]
        yield PartValue(effect, parameter, value, unit, source, EXACT if term == "Q" else DIGITS)
        if term == "B":
            yield from _flicker_band(c, kind)
    yield from _markov(c, kind)
    if rounding is not None:
        source = "the step on whose multiples the samples lie"
        yield PartValue("quantization", "q", rounding, SAMPLE_UNIT[kind], source, EXACT)


def _markov(c: Outcome, kind: str) -> Iterator[PartValue]:
    """Gauss-Markov noise, the slower one first; an axis without has a drive of zero."""
    axes = [c.markov(f"{kind}_{axis}") for axis in AXES]
    for k, effect in enumerate(("gauss_markov", "second_gauss_markov")):
        found = [own[k] if len(own) > k else None for own in axes]
        times = [g[1] for g in found if g]
        if not times:
            continue
        said = "; ".join(
            f"{axis} {quantity(g[0], SAMPLE[kind])} with {number(g[1])} s"
            for axis, g in zip(AXES, found, strict=True)
            if g
        )
        source = f"this characterisation, standard deviation and correlation time: {said}"
        drive = np.array([g[0] * np.sqrt(2 / g[1]) if g else 0.0 for g in found])
        each = np.array([g[1] if g else times[0] for g in found])
        yield PartValue(effect, "q", drive, UNITS[kind]["K"], source)
        yield PartValue(effect, "tau", each, "s", source)


def _summaries(c: Outcome, kind: str, term: str) -> list[Summary | None]:
    """The coefficient of each axis, None where it was not characterised."""
    return [c.coefficients.get((f"{kind}_{axis}", term)) for axis in AXES]


def _source(s: Summary | None, kind: str, term: str, axis: str) -> str:
    if s is None:
        return f"{axis} not characterised"
    unit = UNITS[kind][term]
    return f"{axis} {with_interval(s.mean, SI[kind][term], unit)} {unit}"


def _h(c: Outcome, kind: str) -> float:
    """Sample period [s] of a sensor in the first log that has it."""
    return next(log.sensors[kind].h for log in c.logs if kind in log.sensors)


def _rounding(c: Outcome, kind: str) -> np.ndarray | None:
    """The steps (3,) of the samples, zero where there is none.

    None where no axis has one, or where it makes more than ``COARSE`` of the white noise.
    """
    steps = np.zeros(3)
    for f in c.findings:
        if f.kind == "quantization_step" and f.column.startswith(kind):
            steps[AXES.index(f.column[-1])] = f.detail["step"]
    share = [
        rounding_share(q, s.mean.value if s is not None else 0.0, _h(c, kind))
        for q, s in zip(steps, _summaries(c, kind, "N"), strict=True)
        if q
    ]
    return steps if share and max(share) <= COARSE else None


def _flicker_band(c: Outcome, kind: str) -> Iterator[PartValue]:
    """Two to five decades, from where white noise hides flicker to where the logs end."""
    longest = max(log.duration for log in c.logs)
    crossing = [
        b.mean.value**2 / (2 * np.pi * n.mean.value**2)
        for b, n in zip(_summaries(c, kind, "B"), _summaries(c, kind, "N"), strict=True)
        if b is not None and n is not None and b.mean.needed and n.mean.needed
    ]
    nyquist = 0.5 / _h(c, kind)
    high = min(max(FLICKER_REACH * max(crossing, default=1.0), 100 / longest), nyquist)
    low = float(np.clip(0.1 / longest, 1.001e-5 * high, 0.99e-2 * high))
    source = (
        "where white noise hides the flicker, ten times over; and a tenth of one over the longest "
        "log"
    )
    yield PartValue("bias_instability", "f_low", np.array(low), "Hz", source)
    yield PartValue("bias_instability", "f_high", np.array(high), "Hz", source)


# Bias and temperature


def _bias(c: Outcome, kind: str) -> Iterator[PartValue]:
    """The turn-on bias of the gyro, with its spread over the logs."""
    if kind != "gyro":
        return
    by_axis = [[_bias_of(ch) for ch in c.channel(f"{kind}_{axis}")] for axis in AXES]
    if not np.isfinite(np.concatenate(by_axis)).any():
        return
    # An axis without samples has none.
    by_axis = [[v for v in b if np.isfinite(v)] or [0.0] for b in by_axis]
    spread = ""
    if min(map(len, by_axis)) > 1:
        stds = (number(convert(np.std(b, ddof=1), "rad/s", "deg/s")) for b in by_axis)
        spread = f"; standard deviations of the logs {', '.join(stds)} deg/s"
    yield PartValue(
        "turn_on_bias",
        "b0",
        np.array([np.mean(b) for b in by_axis]),
        "deg/s",
        f"mean of the logs, the Earth's rate included; a new draw at each power-on{spread}",
    )


def _bias_of(ch: Channel) -> float:
    """The bias of a channel: that at T0 where temperature has an effect on it, else the mean."""
    if ch.thermal is not None and ch.thermal.order:
        return ch.thermal.coefficients["b0"].value
    return ch.mean


def _thermal(c: Outcome, kind: str) -> Iterator[PartValue]:
    """The coefficients of temperature that are warranted in at least half of the logs.

    They are means weighted by the standard errors.
    """
    fits = [
        [ch.thermal for ch in c.channel(f"{kind}_{axis}") if ch.thermal is not None]
        for axis in AXES
    ]
    T0 = next((t.T0 for f in fits for t in f), None)
    for order, (name, (effect, parameter)) in enumerate(thermal_fit.EFFECTS.items(), 1):
        means = [_mean_of_order(found, order, name) for found in fits]
        said = [
            f"{axis} with a standard error of {number(100 * m[1] / abs(m[0]), 2)} %"
            for axis, m in zip(AXES, means, strict=True)
            if m is not None
        ]
        if said:
            value = np.array([0.0 if m is None else m[0] for m in means])
            unit = SAMPLE[kind] + ("/K" if order == 1 else f"/K^{order}")
            in_file = {"rad/s/K": "deg/s/K", "m/s^2/K": "mg/K"}.get(unit, unit)
            source = f"this characterisation, {', '.join(said)}"
            yield PartValue(effect, parameter, value, in_file, source)
            yield PartValue(effect, "T0", np.array(T0), "degC", "")
    yield from _hysteresis(fits, kind)


def _mean_of_order(fits: Sequence[ThermalFit], order: int, name: str) -> tuple[float, float] | None:
    """Mean and standard error of a coefficient over the logs; None where it is not warranted."""
    warranted = [t.coefficients[name] for t in fits if t.order >= order]
    if not warranted or 2 * len(warranted) < len(fits):
        return None
    weights = np.array([1 / k.std**2 for k in warranted])
    mean = np.sum(weights * [k.value for k in warranted]) / weights.sum()
    return mean, 1 / np.sqrt(weights.sum())


def _hysteresis(fits: Sequence[Sequence[ThermalFit]], kind: str) -> Iterator[PartValue]:
    """The loops that are warranted in at least half of the logs.

    They get one width, as a sensor has one in the catalogue; each keeps its opening.
    """
    loops = [_loops(found) for found in fits]
    if not any(loops):
        return
    width = float(np.median([h.width for own in loops for h in own]))
    opening = np.array([np.mean([h.opening.value for h in own]) if own else 0.0 for own in loops])
    said = ", ".join(
        f"{axis} opens by {quantity(by, SAMPLE[kind])}"
        for axis, by, own in zip(AXES, opening, loops, strict=True)
        if own
    )
    unit = {"gyro": "deg/h/K", "accel": "mg/K"}[kind]
    source = f"this characterisation, {said}"
    yield PartValue("thermal_hysteresis", "kh", -opening / (2 * width), unit, source)
    source = "of the widths that were tried the most significant"
    yield PartValue("thermal_hysteresis", "width", np.array(width), "K", source)


def _loops(fits: Sequence[ThermalFit]) -> list[Hysteresis]:
    """The warranted loops of an axis; none where they are in less than half of its logs."""
    own = [t.hysteresis for t in fits if t.hysteresis is not None and t.hysteresis.warranted]
    return own if 2 * len(own) >= len(fits) else []
