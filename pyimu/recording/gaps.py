"""The gaps of a log: where samples are missing, told from stamps that came late."""

from __future__ import annotations

import numpy as np

WIDE, NEAR = 16, 4
"""Steps on each side of a long one over which the stamps are compared. Half of the wider ones must
be late for a gap to be seen where none is; the nearer ones tell the long step at a gap from a late
stamp beside it."""

LATE = 0.5
"""Stamps that stay late by more than this part of the period show that a sample is missing."""

MOST = 1 << 15
"""Long steps that are looked at in one go."""


class GapFinder:
    """Finds the gaps in times that come in pieces; the result does not depend on the pieces.

    A step above ``longest`` [s] is a gap where the stamps stay late: with r_k = t_k - k ``period``,
    the median of r over the samples after the step is above that before it by half a period. A
    stamp that is late by itself moves one r, not the median. At the ends of a log there are fewer
    samples to compare, at last those of the step alone.
    """

    def __init__(self, period: float, longest: float) -> None:
        self.period, self.longest = period, longest
        self.settled = 0
        """Rows, counted from the first, of which it is known whether a gap lies before them."""
        self._times = np.empty(0)
        self._first = 0

    def add(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Add ``time`` (n,) s, which follows what was added before.

        Gives the rows (m,) that follow a gap, and the steps (m,) s there, as far as they are
        settled.
        """
        self._times = np.concatenate((self._times, time))
        return self._settle(max(self._first + len(self._times) - WIDE, self.settled))

    def end(self) -> tuple[np.ndarray, np.ndarray]:
        """What the last rows show; nothing can be added after."""
        return self._settle(self._first + len(self._times))

    def _settle(self, stop: int) -> tuple[np.ndarray, np.ndarray]:
        start = max(self.settled - self._first, 1)
        step = np.diff(self._times[start - 1 : max(stop - self._first, start)])
        rows = np.flatnonzero(step > self.longest) + start
        rows = rows[self._lasting(rows)]
        found = rows + self._first, step[rows - start]
        self.settled = stop
        drop = max(stop - self._first - WIDE - 1, 0)
        self._times, self._first = self._times[drop:].copy(), self._first + drop
        return found

    def _lasting(self, rows: np.ndarray) -> np.ndarray:
        """Mask of the ``rows`` (positions in the held times) from which the stamps stay late."""
        inside = (rows > WIDE) & (rows + WIDE < len(self._times))
        lasting = np.zeros(len(rows), bool)
        for places in (np.flatnonzero(inside)[k : k + MOST] for k in range(0, len(rows), MOST)):
            lasting[places] = self._stays(
                self._times[rows[places, None] + np.arange(-WIDE - 1, WIDE + 1)], WIDE + 1
            )
        for place in np.flatnonzero(~inside):
            low = max(rows[place] - WIDE - 1, 0)
            lasting[place] = self._stays(
                self._times[None, low : rows[place] + WIDE + 1], rows[place] - low
            )[0]
        return lasting

    def _stays(self, time: np.ndarray, middle: int) -> np.ndarray:
        """Whether the stamps ``time`` (m, k) stay late from ``middle`` on."""
        r = time - time[:, middle : middle + 1] - self.period * (np.arange(time.shape[1]) - middle)
        wide = np.median(r[:, middle:], axis=1) - np.median(r[:, :middle], axis=1)
        near = np.median(r[:, middle : middle + NEAR + 1], axis=1) - np.median(
            r[:, max(middle - NEAR - 1, 0) : middle], axis=1
        )
        return np.minimum(wide, near) > LATE * self.period


def gap_rows(time: np.ndarray, period: float, longest: float) -> np.ndarray:
    """Rows (m,) of the times (n,) before which a gap lies; see ``GapFinder``."""
    finder = GapFinder(period, longest)
    return np.concatenate((finder.add(time)[0], finder.end()[0]))
