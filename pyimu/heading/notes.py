"""What the reader of a heading should know of the log that it is from."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.heading.calibration import Calibration
from pyimu.heading.motion import Z
from pyimu.model.part import Part
from pyimu.recording.quality.inspect import rate_of_part
from pyimu.recording.recording import Recording
from pyimu.report.findings import detail

CLEARLY = 4.0
"""Standard errors from which on a reference is said to be late."""

LEAST_LATE = 0.01
"""Share of a sample period below which nothing is made of it."""


def of_log(log: Recording, true: np.ndarray | None) -> Iterator[str]:
    """What is missing of a log whose reference heading ``true`` (n,) is, NaN where it has none."""
    missing = np.flatnonzero(~np.isfinite(log.gyro[:, Z]))
    if len(missing):
        yield (
            f"{log.name}: gyro_z is missing in {len(missing):,} rows, the first at "
            f"{log.time[missing[0]]:.6g} s: a straight line is added up there, and the filter "
            "holds the last rate and knows the heading worse"
        )
    for begin, _ in log.segments[1:]:
        before = log.time[begin - 1]
        yield (
            f"{log.name}: a gap of {log.time[begin] - before:.4g} s after {before:.6g} s, in which "
            "the first rate after it is taken to have gone on"
        )
    known = np.flatnonzero(np.isfinite(true)) if true is not None else np.zeros(0, dtype=int)
    if len(known) and known[-1] < len(true) - 1:
        yield (
            f"{log.name}: the reference ends at {log.time[known[-1]]:.6g} s, "
            f"{log.time[-1] - log.time[known[-1]]:.4g} s before the log: the errors are those there"
        )


def of_part(log: Recording, part: Part) -> Iterator[str]:
    """Whether the part has another sample rate than the log."""
    for finding in rate_of_part(log, part.sample_rate):
        yield f"{log.name}: {detail(finding)}"


def of_clock(found: Calibration, period: float) -> Iterator[str]:
    """Whether a known motion's reference is on another clock."""
    if found.late is None or found.late_std is None:
        return
    if abs(found.late) > max(CLEARLY * found.late_std, LEAST_LATE * period):
        way = "late" if found.late > 0 else "early"
        yield (
            f"{found.name}: the reference is {way} by {1e3 * abs(found.late):.4g} ms, which the "
            "filter takes out; self-calibration and paper take it for scale factor and bias, and "
            "an error against it holds what was turned in that time"
        )
