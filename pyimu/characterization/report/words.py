"""What ``characterize`` found in words and rows: in the units that people use, for the page and for
a terminal.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from pyimu.characterization.noise.coefficients import Coefficient
from pyimu.characterization.result import (
    SAMPLE,
    SI,
    Channel,
    Characterization,
    LogResult,
    SensorResult,
    Summary,
    floor,
)
from pyimu.characterization.spectrum.lines import Line
from pyimu.errors import Finding
from pyimu.model.part import AXES
from pyimu.report.numbers import MISSING, in_unit, number, pretty, quantity, unit_for
from pyimu.report.page import detail

SENSORS = {"gyro": "gyro", "accel": "accelerometer"}

READING_ORDER = "NBKQR"
"""Terms as people read them."""

TERM_NAMES = {
    "gyro": {
        "Q": "angle quantization",
        "N": "angle random walk",
        "B": "bias instability",
        "K": "rate random walk",
        "R": "rate ramp",
    },
    "accel": {
        "Q": "velocity quantization",
        "N": "velocity random walk",
        "B": "bias instability",
        "K": "acceleration random walk",
        "R": "acceleration ramp",
    },
}
"""The field's names of the coefficients (IEEE Std 952, 1293)."""

PEOPLE = {
    "gyro": {"Q": "arcsec", "N": "deg/sqrt(h)", "B": "deg/h", "K": "deg/h/sqrt(h)", "R": "deg/h/h"},
    "accel": {"Q": "m/s", "N": "ug/sqrt(Hz)", "B": "mg", "K": "ug/sqrt(s)", "R": "ug/s"},
}
"""Units that data sheets and papers use."""

FURTHER = {"gyro": "deg/s/sqrt(Hz)", "accel": "m/s/sqrt(h)"}
"""Second units for N."""

BAND, UNLIKE = 0.1, 0.1
"""Share of the sample rate up to which a spectrum is compared with the fit, filters lie beyond; and
what is said of its root."""

TIMES = ((86400.0, "d"), (3600.0, "h"), (60.0, "min"), (0.0, "s"))


def duration(seconds: float) -> str:
    """2.78 h."""
    size, unit = next((s, u) for s, u in TIMES if seconds >= 2 * s)
    return f"{number(seconds / (size or 1.0))} {unit}"


def about(log: LogResult) -> str:
    """A log in a line: its rows, its length, its sensors and their rates."""
    sensors = ", ".join(f"{SENSORS[k]} at {1 / s.h:.6g} Hz" for k, s in log.sensors.items())
    return f"{log.rows:,} rows, {duration(log.duration)}, {sensors}"


def frequency(v: Line) -> str:
    """As many figures as show two of the standard error."""
    figures = int(
        np.clip(np.ceil(np.log10(v.frequency / max(v.frequency_std, 1e-9 * v.frequency))) + 1, 2, 8)
    )
    return number(v.frequency, figures)


def searched(s: SensorResult) -> str:
    """Where lines were looked for."""
    low, high = s.searched
    if not np.isfinite(low):
        return f"The {SENSORS[s.kind]} has too few samples without gap for lines to be looked for."
    return (
        f"Lines of the {SENSORS[s.kind]} were looked for from {number(low, 2)} to "
        f"{number(high, 4)} Hz; half the sample rate is {0.5 / s.h:.6g} Hz."
    )


def split(log: LogResult) -> Iterator[str]:
    """What was done with a log that has gaps, a sentence for each sensor."""
    for k, s in log.sensors.items():
        if s.stretches > 1:
            used = (
                f"all {s.used:,}"
                if s.used == s.stretches
                else f"the longest {s.used:,} of {s.stretches:,}"
            )
            yield (
                f"{log.name}: the {SENSORS[k]} has {s.stretches - 1:,} "
                f"gap{'s' * (s.stretches > 2)}. Nothing is bridged: deviations are made of "
                f"{used} stretches, up to {duration(s.longest * s.h)} each, and the spectrum of "
                "all."
            )


def doubts(log: LogResult) -> Iterator[str]:
    """What to say of a log that holds raw counts, is not at rest, or has faults that reach the
    coefficients.
    """
    counts, moving = (
        [f.column for f in log.findings if f.kind == kind] for kind in ("counts", "motion")
    )
    if counts:
        yield (
            f"{log.name}: {', '.join(counts)} hold whole numbers, as counts of a converter do, in "
            "a unit that no sensor is that coarse in: "
            "the coefficients are in a false unit. Say the size of a count in a column map, "
            "[scale]."
        )
    elif moving:
        yield (
            f"{log.name}: not at rest: {', '.join(moving)} change more from one second to the next "
            "than noise does, "
            "so that the coefficients are also those of the motion. Give a log at rest, or the "
            "part of it that is."
        )
    for kind, text in FAULTS.items():
        columns = list(
            dict.fromkeys(f.column for f in log.findings if f.kind == kind and _matters(log, f))
        )
        if columns:
            yield f"{log.name}: {', '.join(columns)}: {text}."
    for text in dict.fromkeys(ch.taken_off for ch in log.channels if "warm-up" in ch.taken_off):
        columns = [ch.name for ch in log.channels if ch.taken_off == text]
        yield (
            f"{log.name}: {', '.join(columns)}: a warm-up was taken off; what its exponential "
            "leaves is in B, K and R."
        )


FAULTS = {
    "clipping": (
        "clipped samples: what lies beyond the limit is missing, so that N is too small and the "
        "bias is off"
    ),
    "spikes": "the spikes are in N and Q, which are too large",
    "stuck_samples": "stuck samples hold one value for long, so that N, B and K are off",
    "held_samples": (
        "each value stands in several rows, so that Q and N at short clusters are those of the log "
        "and not of the sensor"
    ),
    "quantization_step": (
        "steps as coarse as the noise: N, B and K are also those of the rounding, and not of the "
        "sensor alone"
    ),
}
"""What findings do to the coefficients."""

COARSE = 0.5
"""Share of the white noise that rounding makes, from which on it is no noise of the sensor that is
seen."""

NOTICED = 0.01
"""Share of the white noise below which spikes and stuck samples do not matter."""


def rounding_share(step: float, N: float, h: float) -> float:
    """Of the white noise N of samples every h s, what rounding to steps makes; infinite where there
    is no N.
    """
    return step**2 * h / 12 / N**2 if N else np.inf


def _matters(log: LogResult, f: Finding) -> bool:
    """Whether a finding reaches the coefficients of its channel, if it has any."""
    ch = next((ch for ch in log.channels if ch.name == f.column and ch.noise is not None), None)
    if ch is None:
        return False
    # Where none is needed, as much as there may be.
    s, N = log.sensors[ch.kind], ch.noise.fit.fit.estimates.get("N", 0.0) or ch.noise.fit["N"].high
    if f.kind == "quantization_step":
        return rounding_share(f.detail["step"], N, s.h) > COARSE
    if f.kind == "spikes":
        return f.count * f.detail["largest"] ** 2 * s.h > NOTICED * N**2 * s.samples
    # As a jump of the bias by one standard deviation, for as long as it lasts.
    return f.kind != "stuck_samples" or f.detail["longest"] ** 2 > NOTICED * s.samples


def span(c: Coefficient, si: str, unit: str) -> str:
    """``2.42 (2.41 to 2.44)`` in a unit, ``< 3.5`` for a bound, or that there is none."""
    value, low, high = (float(in_unit(v, si, unit)) for v in (c.value, c.low, c.high))
    if not np.isfinite(high):
        return f"{number(value)} ({number(low)} or more)" if c.needed else "not bounded"
    if not c.needed:
        return f"< {number(high)}"
    figures = digits(c)
    return f"{number(value, figures)} ({number(low, figures)} to {number(high, figures)})"


def digits(c: Coefficient) -> int:
    """As many figures of a coefficient as show two of the width of its interval; three at the
    least.
    """
    return int(
        np.clip(np.ceil(np.log10(2 * c.value / max(c.high - c.low, 1e-9 * c.value))) + 2, 3, 6)
    )


def headline(c: Characterization) -> str:
    """White noise and instability of each sensor in a sentence."""
    return " ".join(_sentence(c, kind) for kind in c.kinds)


def _sentence(c: Characterization, kind: str) -> str:
    names = [f"{kind}_{axis}" for axis in AXES if (f"{kind}_{axis}", "N") in c.coefficients]
    if not names:
        return f"The {SENSORS[kind]} could not be characterised."
    shown = []
    for term, word in (("N", "white noise N"), ("B", "bias instability B")):
        si, unit = SI[kind][term], PEOPLE[kind][term]
        means = [c.coefficients[n, term].mean for n in names]
        unit = (
            unit
            if kind == "gyro"
            else unit_for([m.value if m.needed else m.high for m in means], si)
        )
        values = [
            number(float(in_unit(m.value, si, unit)))
            if m.needed
            else f"< {number(float(in_unit(m.high, si, unit)))}"
            for m in means
        ]
        shown.append(f"{word} {', '.join(values)} {pretty(unit)}")
    return f"{SENSORS[kind].capitalize()} {', '.join(n[-1] for n in names)}: {'; '.join(shown)}."


def reason_lines(c: Characterization) -> list[str]:
    """Channels that could not be characterised, and why."""
    return [
        f"{log.name}: {ch.name} is left out: {ch.reason}."
        for log in c.logs
        for ch in log.channels
        if ch.noise is None
    ]


def fit_notes(ch: Channel) -> str:
    """What the five terms were granted, or nothing."""
    if ch.noise is None:
        return ""
    fit, notes = ch.noise.fit, []
    if fit.lines:
        found = sorted(f / fit.fit.sample_period for group in fit.lines for f, _, _ in group)
        notes.append(
            f"line{'s' * (len(found) > 1)} at {', '.join(number(f, 4) for f in found)} Hz allowed "
            "for"
        )
    if fit.shortest > 1.5 * fit.fit.sample_period:
        notes.append(
            f"fitted from {number(fit.shortest)} s on: shorter clusters are not of the five kinds "
            "(filter, vibration)"
        )
    elif len(fit.free) > len(fit.lines):
        notes.append(
            "a term of 1/τ² of either sign allowed for (filter), so that quantization only has a "
            "bound"
        )
    for term in fit.fit.replaceable:
        shown = quantity(fit.fit.estimates[term], SI[ch.kind][term])
        notes.append(
            f"{term} has a bound only, because another term may be in its place; the curve of the "
            f"fit takes {shown} of it"
        )
    if fit.model_error:
        notes.append(
            f"the five terms describe the variances only to {number(100 * fit.model_error, 2)} %, "
            "and the intervals are as wide "
            "as that asks"
        )
    if ch.taken_off:
        notes.append(f"the effect of {ch.taken_off} was taken off first")
    return "; ".join(notes)


def spectrum_note(s: SensorResult, i: int) -> str:
    """Where the spectrum and the fitted noise disagree on the white noise of channel ``i``, or
    nothing.
    """
    ch, f = s.channels[i], s.psd.frequency
    if ch.noise is None or not len(f):
        return ""
    model = 2 * ch.noise.fit.psd_two_sided(f)
    white = (2 * ch.noise.fit.fit.estimates.get("N", 0.0) ** 2 > 0.9 * model) & (f < BAND / s.h)
    for line in ch.lines:
        white &= np.abs(f - line.frequency) > 0.1 * line.frequency + 3 * line.width
    if np.count_nonzero(white) < 5:
        return ""
    ratio = float(np.sqrt(np.median(s.psd.density[white, i] / model[white])))
    if abs(ratio - 1) < UNLIKE:
        return ""
    return (
        f"from {number(f[white][0])} to {number(f[white][-1])} Hz the spectrum is at "
        f"{number(ratio)} of the fitted noise: "
        "the noise is not of the five kinds there, and N depends on where it is read"
    )


# A terminal


def terminal(c: Characterization) -> str:
    """The report for a terminal."""
    lines = []
    for log in c.logs:
        lines.append(f"{log.name}: {about(log)}")
    lines += [line for log in c.logs for line in (*doubts(log), *split(log))] + reason_lines(c)
    for kind in c.kinds:
        lines += ["", *_grid(_rows(c, kind))]
    lines += [
        "",
        (
            f"Intervals: {100 * c.level:g} %. '<' is an upper bound: the data do not need the term. N "
            "is the root of the two-sided density."
        ),
    ]
    if len(c.logs) > 1:
        lines.append(f"Means over {len(c.logs)} logs; ± is the standard deviation of the logs.")
    for log in c.logs:
        lines += [
            f"{log.name}: {text}"
            for text in (*_line_words(log), *_thermal_words(log), *_quality_words(log))
        ]
    return "\n".join(lines)


def _rows(c: Characterization, kind: str) -> list[tuple[str, ...]]:
    rows = [(SENSORS[kind], "", *AXES)]
    for term in READING_ORDER:
        summaries = [c.coefficients.get((f"{kind}_{axis}", term)) for axis in AXES]
        if any(summaries):
            rows.append(
                (
                    f"  {term} {TERM_NAMES[kind][term]}",
                    PEOPLE[kind][term],
                    *(_cell(s, kind, term) for s in summaries),
                )
            )
    floors = [[floor(ch.noise) for ch in c.channel(f"{kind}_{axis}") if ch.noise] for axis in AXES]
    unit = PEOPLE[kind]["B"]
    cells = [
        f"{number(float(in_unit(np.mean([v for v, _ in f]), SAMPLE[kind], unit)))} at "
        f"{number(f[0][1])} s"
        if f
        else MISSING
        for f in floors
    ]
    return [*rows, ("  lowest Allan deviation", unit, *cells)]


def _cell(s: Summary | None, kind: str, term: str) -> str:
    if s is None:
        return MISSING
    spread = (
        f" ± {number(float(in_unit(s.spread, SI[kind][term], PEOPLE[kind][term])), 2)}"
        if np.isfinite(s.spread)
        else ""
    )
    return span(s.mean, SI[kind][term], PEOPLE[kind][term]) + spread


def _grid(rows: Sequence[tuple[str, ...]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]


def _line_words(log: LogResult) -> Iterator[str]:
    for ch in log.channels:
        if ch.lines:
            top = sorted(ch.lines, key=lambda v: -v.amplitude)[:4]
            more = f" and {len(ch.lines) - len(top)} more" if len(ch.lines) > len(top) else ""
            said = [f"{frequency(v)} Hz ({quantity(v.amplitude, SAMPLE[ch.kind])})" for v in top]
            yield f"{ch.name} has lines at {', '.join(said)}{more}"


def _thermal_words(log: LogResult) -> Iterator[str]:
    for ch in log.channels:
        if ch.thermal is not None:
            h = ch.thermal.hysteresis
            loop = f"; {loop_sentence(ch)}" if h is not None and h.warranted else ""
            yield f"{ch.name}: {thermal_sentence(ch)}{loop}"


def loop_sentence(ch: Channel) -> str:
    """What rising and falling temperature make different, or why that cannot be said."""
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


def thermal_sentence(ch: Channel) -> str:
    """What temperature does to a channel."""
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


def _quality_words(log: LogResult) -> Iterator[str]:
    for kind, columns, count, text in grouped(log.findings):
        yield (
            f"{kind}{f' of {columns}' if columns not in ('time', '') else ''}: "
            f"{count:,}{f' ({text})' if text else ''}"
        )


def grouped(findings: Iterable[Finding]) -> list[tuple[str, str, int, str]]:
    """Findings as (kind, columns, count, detail); those that differ in the axis alone are one:
    ``gyro x, y, z``.
    """
    rows: dict[tuple, list[Finding]] = {}
    for f in findings:
        sensor = f.column.partition("_")[0] if f.column.startswith(tuple(SENSORS)) else f.column
        rows.setdefault((f.kind, sensor, f.count, detail(f)), []).append(f)
    return [
        (kind.replace("_", " "), _axes(sensor, found), count, text)
        for (kind, sensor, count, text), found in rows.items()
    ]


def _axes(sensor: str, found: Sequence[Finding]) -> str:
    return (
        f"{sensor} {', '.join(f.column[-1] for f in found)}"
        if sensor in SENSORS
        else sensor.replace("_", " ")
    )
