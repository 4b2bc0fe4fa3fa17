"""Samples that a sensor repeats: stuck for a while, or held for several rows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.quality.clipping import clipped

LEAST_RUN = 5
"""Equal consecutive samples below this number are never called stuck."""


FALSE_ALARMS = 1e-3
"""Expected number of stuck runs reported in a column without any."""


NEIGHBOURS = 512
"""Samples on each side of a run whose repeats say how likely the run is."""


LEAST_CHANGES = 1000
"""Fewer changes of a column's value do not tell whether they come at regular intervals."""


REGULAR = 0.5
"""The intervals of a held column scatter (variance) below this part of those of changes that come
by chance, whose estimate from 1000 of them has a standard deviation of 0.09."""


def stuck_runs(values: np.ndarray) -> list[tuple[int, int]]:
    """Index ranges (start, stop) of equal samples that are too long to be chance.

    In independent samples that repeat with probability p, n (1 - p) p^(m - 1) runs of m or more are
    expected (a geometric law); a run is stuck where that is below ``FALSE_ALARMS``.  p is that of
    the neighbourhood without the run itself and with three standard deviations of its estimate, for
    a coarse comb repeats more at rest than in motion; and at least that of the whole column.
    """
    same = np.concatenate(([False], values[1:] == values[:-1], [False]))
    edges = np.flatnonzero(same[1:] != same[:-1])
    starts, stops = edges[::2], edges[1::2] + 1
    long = stops - starts >= LEAST_RUN
    starts, stops = starts[long], stops[long]
    repeats = np.concatenate(([0], np.cumsum(same[1:])))
    chance = np.maximum(
        _repeat_chance(repeats, starts, stops), _clean_chance(repeats, starts, stops)
    )
    expected = len(values) * (1 - chance) * chance ** (stops - starts - 1)
    stuck = expected < FALSE_ALARMS
    return [(int(a), int(b)) for a, b in zip(starts[stuck], stops[stuck])]


def _repeat_chance(repeats: np.ndarray, starts: np.ndarray, stops: np.ndarray) -> np.ndarray:
    """Probability of a repeat around each run, the run itself left out.

    ``repeats`` (n + 1,) counts the repeats up to each sample.
    """
    low, high = np.maximum(starts - NEIGHBOURS, 0), np.minimum(stops + NEIGHBOURS, len(repeats) - 1)
    count = repeats[high] - repeats[low] - (stops - starts - 1)
    size = (high - low) - (stops - starts)
    return _at_most(count, size)


def _at_most(count: np.ndarray, size: np.ndarray) -> np.ndarray:
    """The probability of what was seen ``count`` times in ``size``, with three standard deviations
    of its estimate.
    """
    p = (count + 1) / (size + 2)
    return np.minimum(p + 3 * np.sqrt(p * (1 - p) / (size + 2)), 1.0)


def longest_chance_run(windows: Sequence[np.ndarray], samples: int) -> float:
    """The repeats in succession that chance does not make in so many ``samples``; may be infinite.

    By the law of ``stuck_runs``, with p of the window that repeats most. ``windows`` say of
    successive samples which repeat the one before.
    """
    count, size = np.array([(np.sum(w), len(w)) for w in windows]).T
    chance = _at_most(count, size).max()
    with np.errstate(divide="ignore"):
        return float(np.log(FALSE_ALARMS / (samples * (1 - chance))) / np.log(chance))


def _clean_chance(repeats: np.ndarray, starts: np.ndarray, stops: np.ndarray) -> float:
    """Probability of a repeat in the column without its long runs."""
    long = np.sum(stops - starts)
    return (repeats[-1] - long + len(starts)) / max(len(repeats) - 1 - long, 1)


def hung_runs(values: np.ndarray, zeroed: bool = False) -> list[tuple[int, int]]:
    """The ``stuck_runs`` of a column (n,) that are not at a limit of its range.

    Zeros of one that is ``zeroed`` are none.
    """
    runs = [(a, b) for a, b in stuck_runs(values) if not zeroed or values[a] != 0]
    if not runs:
        return []
    at_limit = clipped(values)
    return [(a, b) for a, b in runs if not at_limit[a]]


def stuck_findings(name: str, values: np.ndarray, zeroed: bool = False) -> Iterator[Finding]:
    """A finding ``stuck_samples`` of a column; zeros of one that is ``zeroed`` are none."""
    runs = hung_runs(values, zeroed)
    if runs:
        lengths = [b - a for a, b in runs]
        yield Finding(
            "stuck_samples",
            name,
            sum(lengths),
            {"runs": len(runs), "longest": max(lengths), "first_row": runs[0][0]},
        )


def at_even_intervals(intervals: np.ndarray) -> bool:
    """Whether ``intervals`` (k,) of rows between events scatter less than those of chance do.

    By chance they have the geometric law: mean m, variance m (m - 1).
    """
    mean = float(intervals.mean()) if len(intervals) else 1.0
    return bool(intervals.var() < REGULAR * mean * (mean - 1)) if mean > 1 else False


def held_rows(values: np.ndarray) -> float | None:
    """Rows for which each of ``values`` (n,) is held, None where they are not held.

    They are held by a sensor that is slower than its log.

    Such values change at regular intervals of two rows and more. Where rounded noise repeats
    itself by chance, they are not even (``at_even_intervals``). A slow
    motion without noise, rounded, can change regularly, but by one step at a time.
    """
    change = np.diff(values)
    at = np.flatnonzero(np.isfinite(change) & (change != 0))
    if len(at) < LEAST_CHANGES:
        return None
    intervals, size = np.diff(at), np.abs(change[at])
    mean = float(intervals.mean())
    regular = np.median(intervals) >= 2 and at_even_intervals(intervals)
    return mean if regular and np.mean(size < 1.5 * size.min()) < 0.9 else None


def held_findings(name: str, values: np.ndarray) -> Iterator[Finding]:
    rows = held_rows(values)
    if rows is not None:
        yield Finding("held_samples", name, len(values), {"rows": rows})
