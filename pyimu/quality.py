"""Quality of the raw samples: what to know of a recording before a model is blamed for its residual.

Every test looks at the measured samples alone, needs no reference and no model, and takes its threshold from the column
itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from pyimu.errors import Finding
from pyimu.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from pyimu.recording import Recording

LEAST_RUN = 5
"""Equal consecutive samples below this number are never called stuck."""

FALSE_ALARMS = 1e-3
"""Expected number of stuck runs reported in a column without any."""

NEIGHBOURS = 512
"""Samples on each side of a run whose repeats say how likely the run is."""

SPIKE_SIGMA = 6.0
"""A spike exceeds so many robust standard deviations of its neighbourhood."""

SPIKE_ISOLATION = 3.0
"""A spike exceeds everything near it by this factor."""

SPIKE_TAIL = 3.0
"""A spike's residual exceeds the 99 % quantile of its column by this factor."""

CORRUPT_ISOLATION = 12.0
"""The same where other columns are off at the same time: a corrupt row is alone, a shock rings."""

PLATEAU = 0.01
"""Clipped samples lie within this part of the distance from the median to the extreme."""

PILE_UP = 4.0
"""A clipped column has so many times more samples in the plateau than in an equal band below it."""

QUIET = 0.25
"""Inside a plateau the noise is below this part of the noise elsewhere: what is clipped has no noise."""

LEAST_CLIPPED = 5
"""Fewer samples in a plateau are never called clipped."""

CONCENTRATION = 0.8
"""|mean exp(2 pi i v / q)| above which values lie on a comb of step q."""

RELEVANT_STEP = 0.1
"""A step below this part of the noise is the rounding of the file, and does nothing."""

JITTER = 0.01
"""RMS deviation of the sample steps from their median, in periods, above which it is reported."""

WRAP = 0.8
"""A step above this part of a column's range goes across the edge of a word, where the column is else smooth."""

SMOOTH = 1 / 16
"""Half of a smooth column's steps are below this part of its range."""

LEAST_CHANGES = 1000
"""Fewer changes of a column's value do not tell whether they come at regular intervals."""

REGULAR = 0.5
"""The intervals of a held column scatter (variance) below this part of those of changes that come by chance, whose estimate from
1000 of them has a standard deviation of 0.09."""

BLOCK = 32
"""Samples of a block in which the local noise is estimated."""


def inspect(recording: Recording) -> tuple[Finding, ...]:
    """What the raw gyro and accelerometer samples and their times show: see the functions below for the kinds.

    ``constant_channel``, ``wrapped``, ``clipping``, ``stuck_samples``, ``held_samples``, ``spikes``, ``quantization_step`` for
    each column; ``jitter`` and ``gravity_down`` for the recording.
    """
    names, values = _channels(recording)
    columns = [finding for name, column in zip(names, values.T) for finding in _column(name, np.ascontiguousarray(column))]
    return (*columns, *_spikes(recording), *_jitter(recording), *_gravity_down(recording))


def _channels(recording: Recording) -> tuple[list[str], np.ndarray]:
    """Names and samples (n, columns) of the gyro and accelerometer columns."""
    present = [group for group in ("gyro", "accel") if getattr(recording, group) is not None]
    names = [f"{group}_{suffix}" for group in present for suffix in "xyz"]
    return names, np.hstack([np.empty((len(recording), 0)), *(getattr(recording, group) for group in present)])


def _column(name: str, values: np.ndarray) -> Iterator[Finding]:
    known = values[np.isfinite(values)]
    if len(known) < LEAST_RUN:
        return
    if known.min() == known.max():
        yield Finding("constant_channel", name, len(known), {"value": float(known[0])})
        return
    wrapped = list(_wrapped(name, values))
    yield from wrapped
    if not wrapped:  # the edge of a word is no level at which a sensor is clipped
        yield from _clipping(name, values)
    yield from _stuck(name, values)
    yield from _held(name, values)
    step = quantization_step(values)
    if step is not None:
        yield Finding("quantization_step", name, len(known), {"step": step})


# Clipping


def clipping_level(values: np.ndarray) -> tuple[float | None, float | None]:
    """(low, high): the levels at which ``values`` (n,) are clipped, None for a side that is not.

    Clipped samples pile up at the extreme, follow each other, and lack the noise of all others.  They need not be equal: a
    correction for temperature or cross-axis sensitivity after the clipping moves them a little, so the level is their median.
    """
    plateaus = [_plateau(values, sign) for sign in (-1, 1)]
    return tuple(None if not p.any() else float(np.median(values[p])) for p in plateaus)


def clipped(values: np.ndarray) -> np.ndarray:
    """Mask (n,) of the samples at a clipping level."""
    return _plateau(values, -1) | _plateau(values, 1)


def _clipping(name: str, values: np.ndarray) -> Iterator[Finding]:
    for sign, side in ((-1, "low"), (1, "high")):
        plateau = _plateau(values, sign)
        if plateau.any():
            yield Finding("clipping", name, int(plateau.sum()), {"side": side, "level": float(np.median(values[plateau]))})


def _plateau(values: np.ndarray, sign: int) -> np.ndarray:
    """Mask of the samples clipped on one side, all False where none are."""
    v, none = sign * values, np.zeros(len(values), bool)
    if np.count_nonzero(np.isfinite(v)) < LEAST_CLIPPED:
        return none
    top = np.nanmax(v)
    width = PLATEAU * (top - np.nanmedian(v))
    inside = v >= top - width
    below = np.count_nonzero((v >= top - 2 * width) & ~inside)
    count = np.count_nonzero(inside)
    if width <= 0 or count < LEAST_CLIPPED or count <= PILE_UP * below:
        return none
    deep = inside[:-2] & inside[1:-1] & inside[2:]
    if not deep.any():
        return none
    curvature = np.abs(np.diff(v, 2))
    return inside if np.median(curvature[deep]) < QUIET * _noise(curvature[~deep], 0.25) else none


def _noise(curvature: np.ndarray, quantile: float) -> float:
    """A quantile over blocks of the median of ``curvature``, the size of the second differences."""
    curvature = curvature[np.isfinite(curvature)]
    blocks = len(curvature) // BLOCK
    if not blocks:
        return float(np.median(curvature)) if len(curvature) else 0.0
    medians = np.median(curvature[:blocks * BLOCK].reshape(blocks, BLOCK), axis=1)
    return float(np.quantile(medians, quantile))


# Stuck samples


def stuck_runs(values: np.ndarray) -> list[tuple[int, int]]:
    """Index ranges (start, stop) of equal samples that are too long to be chance.

    In independent samples that repeat with probability p, n (1 - p) p^(m - 1) runs of m or more are expected (a geometric
    law); a run is stuck where that is below ``FALSE_ALARMS``.  p is that of the neighbourhood without the run itself and
    with three standard deviations of its estimate, for a coarse comb repeats more at rest than in motion; and at
    least that of the whole column.
    """
    same = np.concatenate(([False], values[1:] == values[:-1], [False]))
    edges = np.flatnonzero(same[1:] != same[:-1])
    starts, stops = edges[::2], edges[1::2] + 1
    long = stops - starts >= LEAST_RUN
    starts, stops = starts[long], stops[long]
    repeats = np.concatenate(([0], np.cumsum(same[1:])))
    chance = np.maximum(_repeat_chance(repeats, starts, stops), _clean_chance(repeats, starts, stops))
    expected = len(values) * (1 - chance) * chance ** (stops - starts - 1)
    stuck = expected < FALSE_ALARMS
    return [(int(a), int(b)) for a, b in zip(starts[stuck], stops[stuck])]


def _repeat_chance(repeats: np.ndarray, starts: np.ndarray, stops: np.ndarray) -> np.ndarray:
    """Probability of a repeat around each run, without it; ``repeats`` (n + 1,) counts them up to each sample."""
    low, high = np.maximum(starts - NEIGHBOURS, 0), np.minimum(stops + NEIGHBOURS, len(repeats) - 1)
    count = repeats[high] - repeats[low] - (stops - starts - 1)
    size = (high - low) - (stops - starts)
    p = (count + 1) / (size + 2)
    return np.minimum(p + 3 * np.sqrt(p * (1 - p) / (size + 2)), 1.0)


def _clean_chance(repeats: np.ndarray, starts: np.ndarray, stops: np.ndarray) -> float:
    """Probability of a repeat in the column without its long runs."""
    long = np.sum(stops - starts)
    return (repeats[-1] - long + len(starts)) / max(len(repeats) - 1 - long, 1)


def _stuck(name: str, values: np.ndarray) -> Iterator[Finding]:
    at_limit = clipped(values)
    runs = [(a, b) for a, b in stuck_runs(values) if not at_limit[a]]
    if runs:
        lengths = [b - a for a, b in runs]
        yield Finding("stuck_samples", name, sum(lengths), {"runs": len(runs), "longest": max(lengths), "first_row": runs[0][0]})


# Held samples


def held_rows(values: np.ndarray) -> float | None:
    """Rows for which a sensor that is slower than its log holds each of the ``values`` (n,), None where it does not.

    Such values change at regular intervals of two rows and more.  Where rounded noise repeats itself by chance, the intervals
    have the geometric law: mean m, variance m (m - 1).  A slow motion without noise, rounded, can change regularly, but by one
    step at a time.
    """
    change = np.diff(values)
    at = np.flatnonzero(np.isfinite(change) & (change != 0))
    if len(at) < LEAST_CHANGES:
        return None
    intervals, size = np.diff(at), np.abs(change[at])
    mean = float(intervals.mean())
    regular = np.median(intervals) >= 2 and intervals.var() < REGULAR * mean * (mean - 1)
    return mean if regular and np.mean(size < 1.5 * size.min()) < 0.9 else None


def _held(name: str, values: np.ndarray) -> Iterator[Finding]:
    rows = held_rows(values)
    if rows is not None:
        yield Finding("held_samples", name, len(values), {"rows": rows})


# Spikes


def spikes(values: np.ndarray) -> np.ndarray:
    """Mask of the isolated samples of ``values`` (n, columns) that are off.

    The residual of a sample against the cubic through its four neighbours vanishes for motion that the sampling resolves.
    A spike's exceeds ``SPIKE_SIGMA`` robust standard deviations of the residuals near it, those that are near but not
    caused by itself by ``SPIKE_ISOLATION``, and the column's 99 % quantile by ``SPIKE_TAIL``.  A shock moves several axes and
    rings: where another column is off at the same time, the isolation must be ``CORRUPT_ISOLATION``.
    """
    mask = np.zeros(values.shape, bool)
    if len(values) < 4 * BLOCK:
        return mask
    off = _residuals(values)
    sigma = _local_sigma(off)
    tail = np.quantile(off, 0.99, axis=0)
    loud = off > SPIKE_SIGMA * sigma
    several = np.count_nonzero(_widened(off > 4 * sigma), axis=1) > 1
    for k, column in np.argwhere(loud & (off > SPIKE_TAIL * tail)):
        mask[k, column] = _isolated(off[:, column], k, CORRUPT_ISOLATION if several[k] else SPIKE_ISOLATION)
    return mask


def _residuals(v: np.ndarray) -> np.ndarray:
    """|v_k - (4 (v_k-1 + v_k+1) - v_k-2 - v_k+2) / 6|, zero at the ends and where a value is missing."""
    off = np.zeros(v.shape)
    off[2:-2] = np.abs(v[2:-2] - (4 * (v[1:-3] + v[3:-1]) - v[:-4] - v[4:]) / 6)
    return np.nan_to_num(off)


def _local_sigma(off: np.ndarray) -> np.ndarray:
    """Robust standard deviation of the residuals around each, at least a quarter of the column's."""
    blocks = 1.4826 * np.median(sliding_window_view(off, 2 * BLOCK, axis=0)[::BLOCK], axis=-1)
    rows = np.minimum(np.arange(len(off)) // BLOCK, len(blocks) - 1)
    return np.maximum(blocks, np.median(blocks, axis=0) / 4)[rows]


def _widened(mask: np.ndarray) -> np.ndarray:
    """``mask`` and the samples before and after."""
    wide = mask.copy()
    wide[1:] |= mask[:-1]
    wide[:-1] |= mask[1:]
    return wide


def _isolated(off: np.ndarray, k: int, factor: float) -> bool:
    """Whether residual ``k`` exceeds those near it by ``factor``, the four that it shares samples with left out."""
    before, after = off[max(k - BLOCK // 2, 0):max(k - 2, 0)], off[k + 3:k + 1 + BLOCK // 2]
    others = max(before.max(initial=0.0), after.max(initial=0.0))
    return bool(off[k] == off[max(k - 2, 0):k + 3].max() and off[k] > factor * others)


def _spikes(recording: Recording) -> Iterator[Finding]:
    names, values = _channels(recording)
    if not names:
        return
    found = spikes(values)
    for column, name in enumerate(names):
        v, rows = values[:, column], np.flatnonzero(found[:, column])
        at_limit = _widened(_widened(clipped(v))) if len(rows) else found[:, column]
        rows = rows[~at_limit[rows]]
        if len(rows):
            size = np.abs(v[rows] - (v[rows - 1] + v[rows + 1]) / 2)
            yield Finding("spikes", name, len(rows), {"largest": float(size.max()), "first_row": int(rows[0])})


# Quantization


def quantization_step(values: np.ndarray) -> float | None:
    """The step q of the comb on which ``values`` (n,) lie, in their unit, or None.

    The step starts as the typical distance of neighbouring levels and is refined over a growing range, so that it is right
    to a small part of a level even at the extremes; then the phases v / q must agree.  They need not agree exactly: a file
    rounds the levels once more.  A step far below the noise is the file's rounding, and is not reported.
    """
    known = values[np.isfinite(values)]
    levels = np.unique(known)
    if len(levels) < 4:
        return float(np.diff(levels).min()) if len(levels) > 1 and len(known) > 20 * len(levels) else None
    step = _first_step(known, levels)
    if step is None or step < RELEVANT_STEP * _noise(np.abs(np.diff(known, 2)), 0.1) / np.sqrt(6):
        return None
    centre = levels - levels[np.argmin(np.abs(levels - np.median(known)))]
    step = _refined(step, centre)
    phases = np.exp(2j * np.pi * centre / step)
    return step if np.abs(phases.mean()) > CONCENTRATION else None


def _first_step(known: np.ndarray, levels: np.ndarray) -> float | None:
    """The median distance between levels where they are dense, in the middle half of the samples."""
    low, high = np.quantile(known, (0.25, 0.75))
    dense = levels[(levels >= low) & (levels <= high)]
    gaps = np.diff(dense if len(dense) > 8 else levels)
    gaps = gaps[gaps > 1e-9 * (levels[-1] - levels[0])]
    return float(np.median(gaps)) if len(gaps) else None


def _refined(step: float, centre: np.ndarray) -> float:
    reach, size = 8 * step, np.abs(centre)
    while True:
        near = centre[size <= reach]
        number = np.round(near / step)
        if np.any(number):
            slope = np.polyfit(number, near, 1)[0]
            step = float(slope) if abs(slope - step) < 0.1 * step else step
        if reach >= size.max():
            return step
        reach *= 2


# Words that wrapped


def wraps(values: np.ndarray) -> tuple[np.ndarray, float]:
    """(rows, span): where a word of integers wrapped around in ``values`` (n,), and its range in their unit; no rows where none did.

    A smooth column jumps from end to end of its range, and less the slope beside it each jump is the same: the word's
    range.  The samples span no more than that.  Those of a motion that is reversed at once, whose jumps look the same, do,
    by their noise; those of a spike jump back at once.
    """
    change = np.diff(values)
    size, rows = np.abs(change), np.zeros(0, int)
    reach = np.nanmax(values) - np.nanmin(values)
    if len(values) < 4 * BLOCK or not np.isfinite(size).any() or not 0 < np.nanmedian(size) < SMOOTH * reach:
        return rows, 0.0
    jumps = np.flatnonzero(size[1:-1] > WRAP * reach) + 1
    jumps = jumps[np.maximum(size[jumps - 1], size[jumps + 1]) < (1 - WRAP) * reach]
    spans = np.abs(change[jumps] - (change[jumps - 1] + change[jumps + 1]) / 2)
    noise = np.nanmedian(np.abs(np.diff(change)))
    span = float(np.median(spans)) if len(spans) > 1 else 0.0
    if reach > span + 2 * noise or np.median(np.abs(spans - span)) > 2 * noise:
        return rows, 0.0
    return np.flatnonzero(size > WRAP * reach) + 1, span


def _wrapped(name: str, values: np.ndarray) -> Iterator[Finding]:
    rows, span = wraps(values)
    if len(rows):
        yield Finding("wrapped", name, len(rows), {"span": span, "first_row": int(rows[0])})


# Times and axes


def _jitter(recording: Recording) -> Iterator[Finding]:
    period = recording.sample_period
    step = np.concatenate([np.diff(recording.time[a:b]) for a, b in recording.segments])
    rms = float(np.sqrt(np.mean((step - step.mean()) ** 2))) if len(step) else 0.0
    if rms > JITTER * period:
        yield Finding("jitter", "time", len(step), {"rms": rms, "period": period})


def _gravity_down(recording: Recording) -> Iterator[Finding]:
    """Gravity on -z at rest: probably a log in forward-right-down axes that nobody declared."""
    if recording.accel is None or recording.frame_declared:
        return
    rest = _quiet_force(recording)
    if rest is not None and rest[2] < -0.8 * STANDARD_GRAVITY:
        yield Finding("gravity_down", "accel_z", 1, {f"accel_{suffix}": float(f) for suffix, f in zip("xyz", rest)})


def _quiet_force(recording: Recording) -> np.ndarray | None:
    """The median specific force (3,) over the quietest tenth of blocks of a second, None where it is not gravity."""
    length = max(4, min(round(recording.sample_rate), len(recording) // 10))
    count = len(recording) // length
    blocks = recording.accel[:count * length].reshape(count, length, 3)
    blocks = blocks[np.all(np.isfinite(blocks), axis=(1, 2))]
    if not len(blocks):
        return None
    spread = blocks.std(axis=1).sum(axis=1)
    rest = np.median(blocks[spread <= np.quantile(spread, 0.1)].mean(axis=1), axis=0)
    return rest if abs(np.linalg.norm(rest) - STANDARD_GRAVITY) < 0.1 * STANDARD_GRAVITY else None
