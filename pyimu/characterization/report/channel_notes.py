"""Sentences about sensors and channels: their noise, its fit, their lines, and temperature."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.characterization.outcome import SAMPLE, SI, Channel, Outcome, SensorResult
from pyimu.characterization.report.coefficients import UNITS, value_or_bound
from pyimu.characterization.spectrum.lines import Line
from pyimu.model.part import AXES
from pyimu.report.findings import SENSORS
from pyimu.report.numbers import in_unit, number, pretty, quantity, unit_for

BAND = 0.1
"""Share of the sample rate up to which a spectrum is compared with the fit; filters lie above."""

UNLIKE = 0.1
"""Relative difference of the roots of the densities from which on it is mentioned."""

OTHERS = 2
"""Low-passes that the data do not tell from the one that is named, at most so many named too."""


def headline(c: Outcome) -> str:
    """White noise and bias instability of each sensor in a sentence."""
    return " ".join(_headline(c, kind) for kind in c.kinds)


def _headline(c: Outcome, kind: str) -> str:
    names = [f"{kind}_{axis}" for axis in AXES if (f"{kind}_{axis}", "N") in c.coefficients]
    if not names:
        return f"The {SENSORS[kind]} could not be characterised."
    said = []
    for term, word in (("N", "white noise N"), ("B", "bias instability B")):
        si, unit = SI[kind][term], UNITS[kind][term]
        means = [c.coefficients[n, term].mean for n in names]
        if kind != "gyro":
            unit = unit_for([m.value if m.needed else m.high for m in means], si)
        values = ", ".join(value_or_bound(m, si, unit) for m in means)
        said.append(f"{word} {values} {pretty(unit)}")
    return f"{SENSORS[kind].capitalize()} {', '.join(n[-1] for n in names)}: {'; '.join(said)}."


# The fit


def fit_notes(ch: Channel) -> str:
    """What the fit had to allow for besides the terms of the table, or nothing."""
    return "" if ch.noise is None else "; ".join(_fit_notes(ch))


def _fit_notes(ch: Channel) -> Iterator[str]:
    fit = ch.noise.fit
    if fit.lines:
        found = ", ".join(number(f, 4) for f in fit.line_frequencies)
        yield f"line{'s' * (len(fit.line_frequencies) > 1)} at {found} Hz allowed for"
    if fit.shortest > 1.5 * fit.sample_period:
        yield (
            f"fitted from {number(fit.shortest)} s on: what is faster is none of these kinds of "
            "noise, but a filter in the sensor or vibration"
        )
    elif fit.filtered:
        yield (
            "a filter in the sensor takes from the fastest noise, as quantization would add to it: "
            "of quantization only a bound can be given"
        )
    for term in fit.replaceable:
        value = quantity(fit.estimates[term], SI[ch.kind].get(term, SAMPLE[ch.kind]))
        yield (
            f"{term} has a bound only: another term describes the same curve as well; the fit that "
            f"is drawn takes {value} of it"
        )
    if fit.model_error:
        yield (
            "these kinds of noise describe the measured variances to "
            f"{number(100 * fit.model_error, 2)} % only, and the intervals are widened for that"
        )
    if ch.compensated_for:
        yield f"the effect of {ch.compensated_for} was taken off first"


def spectrum_note(s: SensorResult, i: int) -> str:
    """Where spectrum and fitted noise disagree on the white noise of channel ``i``, or nothing."""
    ch, f, fitted = s.channels[i], s.psd.frequency, s.fitted[:, i]
    if ch.noise is None or not len(f):
        return ""
    white = (2 * ch.noise.fit.estimates.get("N", 0.0) ** 2 > 0.9 * fitted) & (f < BAND / s.h)
    for line in ch.lines:
        white &= np.abs(f - line.frequency) > 0.1 * line.frequency + 3 * line.width
    if np.count_nonzero(white) < 5:
        return ""
    ratio = float(np.sqrt(np.median(s.psd.density[white, i] / fitted[white])))
    if abs(ratio - 1) < UNLIKE:
        return ""
    return (
        f"from {number(f[white][0])} to {number(f[white][-1])} Hz the spectrum is at "
        f"{number(ratio)} of the fitted noise: "
        "the noise is not of these kinds there, and N depends on where it is read"
    )


def bandwidth_sentence(ch: Channel) -> str:
    """Where the noise of a channel rolls off, or nothing."""
    if ch.bandwidth is None:
        return ""
    f = ch.bandwidth.frequency
    value, low, high = (number(v, 3) for v in (f.value, f.low, f.high))
    found = ch.bandwidth.low_pass
    where = f"bandwidth {value} ({low} to {high}) Hz, where the noise is down by 3 dB"
    if found is None:
        return f"{where}, read off the spectrum: it is that of no low-pass known here"
    others = " or ".join(v.words for v in ch.bandwidth.alike[:OTHERS])
    return f"{where}, as through {found.words}{f' (or {others})' if others else ''}"


# Lines


def frequency(v: Line) -> str:
    """The frequency of a line [Hz], with as many figures as give two of its standard error."""
    figures = int(
        np.clip(np.ceil(np.log10(v.frequency / max(v.frequency_std, 1e-9 * v.frequency))) + 1, 2, 8)
    )
    return number(v.frequency, figures)


def searched(s: SensorResult) -> str:
    """Between which frequencies lines were looked for."""
    low, high = s.searched
    if not np.isfinite(low):
        return f"The {SENSORS[s.kind]} has too few samples without gap for lines to be looked for."
    return (
        f"Lines of the {SENSORS[s.kind]} were looked for from {number(low, 2)} to "
        f"{number(high, 4)} Hz; half the sample rate is {0.5 / s.h:.6g} Hz."
    )


# Temperature


def thermal_sentence(ch: Channel) -> str:
    """What temperature does to the bias of a channel."""
    t, si = ch.thermal, f"{SAMPLE[ch.kind]}/K"
    if not t.order:
        return f"no effect of temperature is seen, below {quantity(t.bound, si)}"
    k = t.coefficients["kT"]
    unit = unit_for(k.value, si)
    value, low, high = (number(float(in_unit(v, si, unit))) for v in (k.value, k.low, k.high))
    more = {1: "", 2: ", and of second order", 3: ", and of third order"}[t.order]
    return (
        f"the bias changes by {value} ({low} to {high}) {pretty(unit)} at {number(t.T0, 4)} "
        f"°C{more}"
    )


def loop_sentence(ch: Channel) -> str:
    """How the bias differs between rising and falling temperature, or why that cannot be said."""
    h = ch.thermal.hysteresis
    if h is None:
        return f"hysteresis: {ch.thermal.no_hysteresis}" if ch.thermal.no_hysteresis else ""
    unit = unit_for(h.opening.value, SAMPLE[ch.kind])
    value, low, high = (
        number(float(in_unit(v, SAMPLE[ch.kind], unit)))
        for v in (h.opening.value, h.opening.low, h.opening.high)
    )
    text = f"rising less falling {value} ({low} to {high}) {pretty(unit)}"
    if h.warranted:
        return f"{text}: a loop of ±{number(h.width, 2)} K"
    return (
        f"{text}, which is not taken for a loop: of as many widths as were tried chance gives one "
        f"so with probability {number(h.p_value, 1)}"
    )
