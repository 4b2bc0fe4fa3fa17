"""Where the samples of a table end: below them stand sums, means and remarks in many sheets."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from pyimu.recording.counter import LATE
from pyimu.recording.formats.reader import Columns

LAST = 20
"""Rows behind the last sample, at most, that are none. With more of them the table is not what it
was taken for."""

LEAST = 3
"""Rows before them, at least."""

Batches = Iterator[tuple[Columns, float]]


def without_end(batches: Batches, time: int, say: Callable[[int, int], None]) -> Batches:
    """``batches`` without the last rows that are no samples, whose position and number ``say``
    takes; the times are column ``time`` of them.

    A batch is held back until the next has come, which few rows join.
    """
    held: tuple[Columns, float] | None = None
    before = 0
    for columns, share in batches:
        if held is not None and len(columns[0]) <= LAST:
            columns = [np.concatenate(pair) for pair in zip(held[0], columns, strict=True)]
        elif held is not None:
            before += len(held[0][0])
            yield held
        held = columns, share
    if held is None:
        return
    columns, share = held
    end = end_of_samples(columns[time])
    if end < len(columns[time]):
        say(before + end, len(columns[time]) - end)
    yield [column[:end] for column in columns], share


def end_of_samples(time: np.ndarray) -> int:
    """How many rows with the times (n,) are samples: behind them rows lack their time, or have what
    is none, such as the mean of all.
    """
    known = np.isfinite(time.astype(float))
    first = max(len(time) - LAST, LEAST)
    for at in range(first, len(time)):
        if not known[:at].any():
            continue
        before = time[:at][known[:at]]
        if not known[at:].any() or _are_no_times(time[at:][known[at:]].astype(float), before):
            return at
    return len(time)


def _are_no_times(last: np.ndarray, before: np.ndarray) -> bool:
    """Whether the ``last`` numbers of a column go on neither from the times ``before`` nor from
    each other, as the times of a clock that began anew do.
    """
    if np.any(last >= before[-1]):
        return False
    steps = np.diff(before.astype(float))
    rising = steps[steps > 0]
    if not len(rising):
        return False
    period = float(np.median(rising))
    apart = np.diff(last)
    return bool(last[0] > LATE * period and not np.any((apart > 0) & (apart <= LATE * period)))
