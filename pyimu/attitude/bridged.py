"""Single samples that a log lacks, set between their neighbours where these tell as much.

To a filter that goes forward an axis without a sample may turn by any rate (``lost_rate_std``): of
a row in twenty that makes a whole log unsure. In a log the next sample is there as well.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.attitude.columns import rate_noise
from pyimu.attitude.rest import Rest
from pyimu.model.part import Part
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording

MOST = 8
"""Samples in succession that may be set so; what is missing for longer is lost."""


def bridged(recording: Recording, rest: Rest, part: Part | None) -> tuple[Recording, np.ndarray]:
    """The recording with short spans of missing samples set on the line between their neighbours,
    and the rows (m,) in which there was one.

    A span is bridged by the line as long as what the line misses known samples by adds no more to
    the angle than the noise of one sample, which is white noise and the part's ``rate_noise``. The
    forces are bridged with the rates: the filter carries them along. Gaps of whole rows stay.
    """
    longest = _longest(recording, rest, rate_noise(part))
    if longest < 1:
        return recording, np.zeros(0, dtype=int)
    filled, marked = {}, np.zeros(len(recording.time), dtype=bool)
    for name in ("gyro", "accel"):
        values = getattr(recording, name)
        if values is not None:
            filled[name], missing = _filled(recording, values, longest)
            marked |= missing
    return replace(recording, **filled) if marked.any() else recording, np.flatnonzero(marked)


def _longest(recording: Recording, rest: Rest, relative: float) -> int:
    """How many samples in succession may be bridged; 0 where none is missing.

    The line over m samples is off in their middle as the mean of two samples is from the one half
    way between them; white noise makes that 3/2 of its variance.
    """
    gyro, period = recording.gyro, recording.sample_period
    if np.isfinite(gyro).all():
        return 0
    white = float(np.mean(rest.rate_std**2))
    allowed = white + relative**2 * 3 * _mean_square(gyro) / period
    for count in range(1, MOST + 1):
        step = (count + 2) // 2
        middle = gyro[step:-step] - (gyro[: -2 * step] + gyro[2 * step :]) / 2
        if not (_mean_square(middle) - 1.5 * white) * count**2 <= allowed:
            return count - 1
    return MOST


def _mean_square(values: np.ndarray) -> float:
    """That of the known ones; infinite where there are none."""
    known = values[np.isfinite(values)]
    return float(np.mean(known**2)) if len(known) else np.inf


def _filled(
    recording: Recording, values: np.ndarray, longest: int
) -> tuple[np.ndarray, np.ndarray]:
    """The samples (n, 3) with short spans bridged, and where (n,) they are."""
    out, marked = values.copy(), np.zeros(len(values), dtype=bool)
    within = np.zeros(len(values), dtype=int)
    for number, (first, stop) in enumerate(recording.segments):
        within[first:stop] = number
    for column in out.T:
        bad = ~np.isfinite(column)
        if bad.all() or not bad.any():
            continue
        short = np.zeros(len(column), dtype=bool)
        for first, stop in runs(bad):
            inside = 0 < first and stop < len(column) and within[first - 1] == within[stop]
            short[first:stop] = inside and stop - first <= longest
        column[short] = np.interp(recording.time[short], recording.time[~bad], column[~bad])
        marked |= short
    return out, marked
