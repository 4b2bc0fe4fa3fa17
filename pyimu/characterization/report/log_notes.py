"""Sentences about a log: its contents, its segments, and what its faults do to the coefficients."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.characterization.outcome import LogResult, Outcome, SensorResult
from pyimu.errors import Finding
from pyimu.recording.quality.false_force import what_is_false
from pyimu.report.findings import SENSORS, grouped
from pyimu.report.numbers import joined, number

TIMES = ((86400.0, "d"), (3600.0, "h"), (60.0, "min"), (0.0, "s"))
"""Seconds of the units of time, the largest first."""

OF_UNITS = ("gyro_at_rest", "gyro_noisy", "gyro_fast", "unlikely_rate")
"""Kinds of findings that say that a column, or the times, may be in another unit than is stated."""

FAULTS = {
    "clipping": (
        "clipped samples: what lies beyond the limit is missing, so that N is too small and the "
        "bias is off"
    ),
    "spikes": "the spikes are in N and Q, which are too large",
    "stuck_samples": "stuck samples hold one value for long; all but the first were left out",
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
"""Share of the white noise made by rounding above which the noise is not the sensor's own."""

NOTICED = 0.01
"""Share of the white noise below which spikes and stuck samples do not matter."""


def duration(seconds: float) -> str:
    """A time in the unit that suits it, ``2.78 h``."""
    size, unit = next((s, u) for s, u in TIMES if seconds >= 2 * s)
    return f"{number(seconds / (size or 1.0))} {unit}"


def about(log: LogResult) -> str:
    """A log in a line: its rows, its length, its sensors and their rates."""
    sensors = ", ".join(f"{SENSORS[k]} at {1 / s.h:.6g} Hz" for k, s in log.sensors.items())
    return f"{log.rows:,} rows, {duration(log.duration)}, {sensors}"


def notes(c: Outcome) -> list[str]:
    """What must be known of the logs: doubts, gaps, and channels that are left out."""
    return [
        line
        for log in c.logs
        for line in (*doubts(log), *_gaps(log), *_floors(log), *left_out(log))
    ]


def left_out(log: LogResult) -> Iterator[str]:
    """Which channels are left out, a sentence for each reason."""
    left = [ch for ch in log.channels if ch.noise is None]
    for reason in dict.fromkeys(ch.reason for ch in left):
        names = [ch.name for ch in left if ch.reason == reason]
        verb = "is" if len(names) == 1 else "are"
        yield f"{log.name}: {', '.join(names)} {verb} left out: {reason}."


def _gaps(log: LogResult) -> Iterator[str]:
    """What was done with a log that has gaps, a sentence for each sensor."""
    for k, s in log.sensors.items():
        if s.segments > 1:
            found = f"{log.name}: the {SENSORS[k]} has {_breaks(log, s.segments - 1)}. "
            yield f"{found}{_closed(s)}{_used(s)}, and the spectrum of all without gap."


def _closed(s: SensorResult) -> str:
    """Which gaps were closed."""
    if not s.closed:
        return "Nothing is bridged: "
    some = s.closed < s.segments - 1
    which = f"{s.closed:,} of them" if some else "It" if s.closed == 1 else "All"
    verb = "is" if s.closed == 1 else "are"
    return f"{which} {verb} short, and closed up: nothing is filled in, "


def _used(s: SensorResult) -> str:
    """What deviations were made of."""
    count = s.segments - s.closed
    if count == 1:
        return f"deviations are made of the whole, {duration(s.longest * s.h)}"
    few = s.segments_used < count
    used = f"the longest {s.segments_used:,} of {count:,}" if few else f"all {count:,}"
    return f"deviations are made of {used} segments, up to {duration(s.longest * s.h)} each"


BREAKS = {
    "gaps": ("gaps", "missing_cells"),
    "runs of repeats left out": ("repeated_samples", "stuck_samples"),
    "shocks left out": ("shocks",),
}
"""What breaks a log into segments, by the kinds of findings that say so."""


def _breaks(log: LogResult, count: int) -> str:
    """``3 gaps``, or ``3 gaps and shocks left out`` where these are of several kinds."""
    kinds = {f.kind for f in log.findings}
    found = joined([words for words, of in BREAKS.items() if kinds & set(of)] or ["gaps"])
    found = found.replace(" left out and", " and")
    if count == 1:
        found = found.replace("gaps", "gap").replace("shocks", "shock").replace("runs", "run")
    return f"{count:,} {found}"


def _floors(log: LogResult) -> Iterator[str]:
    """Of which channels the lowest Allan deviation is an upper bound."""
    falling = [ch for ch in log.channels if ch.noise is not None and ch.noise.floor.bound]
    if falling and not log.moves:
        last = max(ch.noise.floor.tau for ch in falling if ch.noise is not None)
        yield (
            f"{log.name}: {', '.join(ch.name for ch in falling)}: the Allan deviation falls as far "
            f"as it is read ({number(last)} s): the lowest one is an upper bound ('<') of the bias "
            "stability, and a longer log may show a lower one."
        )


def doubts(log: LogResult) -> Iterator[str]:
    """Why the coefficients of a log may not be those of the sensor.

    The log holds raw counts, is not at rest, may be in another unit than is stated, has faults that
    reach the coefficients, or a warm-up was removed from it.
    """
    yield from _not_at_rest(log)
    for said in grouped(f for f in log.findings if f.kind in OF_UNITS):
        yield f"{log.name}: {said.line}: {said.meaning}"
    for kind, text in FAULTS.items():
        columns = list(
            dict.fromkeys(f.column for f in log.findings if f.kind == kind and _matters(log, f))
        )
        if columns:
            yield f"{log.name}: {', '.join(columns)}: {text}."
    for f in log.findings:
        if f.kind == "held_samples" and f.column in SENSORS:
            yield (
                f"{log.name}: the {SENSORS[f.column]} is slower than its log and has a new sample "
                f"every {number(f.detail['rows'])} rows: its noise is that of these samples, at "
                f"{1 / log.sensors[f.column].h:.6g} Hz."
            )
    removed = [ch.compensated_for for ch in log.channels if "warm-up" in ch.compensated_for]
    for text in dict.fromkeys(removed):
        columns = [ch.name for ch in log.channels if ch.compensated_for == text]
        yield (
            f"{log.name}: {', '.join(columns)}: a warm-up was taken off; what its exponential "
            "leaves is in B, K and R."
        )


def why_no_part(c: Outcome) -> list[str]:
    """First of all, that a log moves, holds raw counts or forces in a false unit; nothing else."""
    said = []
    if c.moving:
        verb = "moves" if len(c.moving) == 1 else "move"
        said.append(
            f"{joined(c.moving)} {verb}: what follows is noise and motion together, and no part is "
            "written. pyimu close takes a log that moves, pyimu characterize wants one at rest."
        )
    if c.in_counts:
        verb = "holds" if len(c.in_counts) == 1 else "hold"
        said.append(
            f"{joined(c.in_counts)} {verb} raw counts: what follows is in a false unit, and no "
            "part is written."
        )
    said += [
        f"{name}: {what_is_false(finding)}. No part is written."
        for name, finding in c.in_false_unit.items()
    ]
    return said


def what_it_is(c: Outcome, kind: str) -> str:
    """What the coefficients of a sensor are, where they are not its own; else nothing."""
    if c.moving:
        return "noise and motion together"
    false = c.in_counts or (kind == "accel" and c.in_false_unit)
    return "in a false unit" if false else ""


def _not_at_rest(log: LogResult) -> Iterator[str]:
    """That a log holds raw counts, which look like motion, or else moves."""
    counts, moving = (
        [f.column for f in log.findings if f.kind == kind] for kind in ("counts", "motion")
    )
    if counts:
        verb = "holds" if len(counts) == 1 else "hold"
        yield (
            f"{log.name}: {', '.join(counts)} {verb} whole numbers, as counts of a converter do, "
            "in a unit that no sensor is that coarse in: "
            "the coefficients are in a false unit. Say the size of a count in a column map, "
            "[scale]."
        )
    elif moving:
        verb = "changes" if len(moving) == 1 else "change"
        yield (
            f"{log.name}: not at rest: {', '.join(moving)} {verb} more from one second to the next "
            "than noise does, "
            "so that the coefficients are also those of the motion. Give a log at rest, or the "
            "part of it that is."
        )


def rounding_share(step: float, N: float, h: float) -> float:
    """Share of the white noise N that rounding to ``step`` makes; infinite where there is no N.

    Samples are ``h`` s apart; rounding has the variance step^2 / 12.
    """
    return step**2 * h / 12 / N**2 if N else np.inf


def _matters(log: LogResult, f: Finding) -> bool:
    """Whether a finding reaches the coefficients of its channel, if it has any."""
    ch = next((ch for ch in log.channels if ch.name == f.column and ch.noise is not None), None)
    if ch is None:
        return False
    # Where N is not needed, as much as there may be.
    s, N = log.sensors[ch.kind], ch.noise.fit.estimates.get("N", 0.0) or ch.coefficient("N").high
    if f.kind == "quantization_step":
        return rounding_share(f.detail["step"], N, s.h) > COARSE
    if f.kind == "spikes":
        return f.count * f.detail["largest"] ** 2 * s.h > NOTICED * N**2 * s.samples
    # As a jump of the bias by one standard deviation, for as long as it lasts.
    return f.kind != "stuck_samples" or f.detail["longest"] ** 2 > NOTICED * s.samples
