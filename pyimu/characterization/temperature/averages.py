"""Averages of a long record over intervals of equal length, in bounded memory.

They hold what is slow in it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SHORTEST = 1.0
"""Length of an interval [s] at first; it doubles as the record grows."""


@dataclass(frozen=True)
class Averages:
    """Averages over ``count`` (m,) samples each, which are ``h`` s apart.

    ``time`` (m,) is in s, ``temperature`` (m,) in degC, ``values`` (m, c) in the samples' unit.
    """

    time: np.ndarray
    temperature: np.ndarray
    values: np.ndarray
    count: np.ndarray
    h: float

    @property
    def duration(self) -> np.ndarray:
        """Time (m,) in s that the samples of each average stand for."""
        return self.count * self.h

    @property
    def gap(self) -> np.ndarray:
        """Time (m,) in s between the samples of an average and those of the one before.

        It is zero for the first.
        """
        end, start = self.time + self.duration / 2, self.time - self.duration / 2
        return np.append(0.0, np.maximum(start[1:] - end[:-1], 0.0))

    def between(self, begin: float, end: float) -> Averages:
        """Those of which all samples lie from a time to another, s."""
        half = self.duration / 2
        inside = (self.time - half >= begin) & (self.time + half <= end)
        columns = (c[inside] for c in (self.time, self.temperature, self.values, self.count))
        return Averages(*columns, self.h)


def interval_averages(
    time: np.ndarray, temperature: np.ndarray, values: np.ndarray, h: float, target: int = 2000
) -> Averages:
    """Averages of whole arrays (n,), (n,) and (n, c) or (n,); see ``AverageAccumulator``."""
    accumulator = AverageAccumulator(h, target)
    accumulator.add(time, temperature, values)
    return accumulator.result()


class AverageAccumulator:
    """Averages of a record that comes in pieces, in the order of time.

    Gaps may lie between rows. The intervals have a length of 1 s, or of a sample ``h`` [s] where
    that is longer, which doubles whenever there are more than 2 ``target`` of them. Rows with a
    missing cell are left out.
    """

    def __init__(self, h: float, target: int = 2000) -> None:
        self.h, self.target, self.length = float(h), target, max(SHORTEST, float(h))
        self._start: float | None = None
        self._index, self._count = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
        self._sums = np.empty((0, 0))

    def add(self, time: np.ndarray, temperature: np.ndarray, values: np.ndarray) -> None:
        """Add the next rows: (k,) s, (k,) degC and (k, c) or (k,)."""
        given = [time, temperature, *np.reshape(values, (len(time), -1)).T]
        columns = [np.asarray(column, dtype=float) for column in given]
        whole = np.logical_and.reduce([np.isfinite(column) for column in columns])
        if not whole.all():
            columns = [column[whole] for column in columns]
        if not len(columns[0]):
            return
        if self._start is None:
            # Half a sample before the first, so that samples do not lie on the edges.
            self._start, self._sums = columns[0][0] - self.h / 2, np.empty((0, len(columns)))
        columns[0] = columns[0] - self._start
        index = np.floor(columns[0] / self.length).astype(np.int64)
        first = np.flatnonzero(np.diff(index, prepend=index[0] - 1))
        sums = np.column_stack([np.add.reduceat(column, first) for column in columns])
        self._append(index[first], np.diff(first, append=len(index)), sums)
        while len(self._index) > 2 * self.target:
            self.length *= 2
            halved, count, sums = self._index // 2, self._count, self._sums
            self._index, self._count, self._sums = self._index[:0], count[:0], sums[:0]
            self._append(halved, count, sums)

    def _append(self, index: np.ndarray, count: np.ndarray, sums: np.ndarray) -> None:
        """Add sums over ``count`` samples each to the intervals of these indices."""
        if len(self._index):
            # The last interval may go on.
            index, count = np.append(self._index[-1], index), np.append(self._count[-1], count)
            sums = np.concatenate([self._sums[-1:], sums])
        first = np.flatnonzero(np.diff(index, prepend=index[0] - 1))
        self._index = np.append(self._index[:-1], index[first])
        self._count = np.append(self._count[:-1], np.add.reduceat(count, first))
        self._sums = np.concatenate([self._sums[:-1], np.add.reduceat(sums, first, axis=0)])

    def result(self) -> Averages:
        """The averages so far; more rows may be added afterwards."""
        means = self._sums / self._count[:, None]
        if self._start is None:
            return Averages(np.empty(0), np.empty(0), np.empty((0, 0)), self._count, self.h)
        return Averages(
            means[:, 0] + self._start, means[:, 1], means[:, 2:], self._count.copy(), self.h
        )
