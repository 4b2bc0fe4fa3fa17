"""Counters of time that begin anew at a power of two, as those of microcontrollers do."""

from __future__ import annotations

import numpy as np

BITS = (16, 24, 32)
"""Widths of such counters."""

NEARLY = 0.9
"""A step back by more than this part of the counter's range may be its beginning anew."""

LATE = 10
"""Periods by which a sample may be late where the counter begins anew: one that is later is no sign
of a counter, but of a second log behind the first."""


class Unwrapped:
    """Makes the times of a log rise on where their counter began anew, piece by piece.

    ``count`` is how often it did, ``bits`` the counter's width, None where it never did.
    """

    def __init__(self) -> None:
        self.count = 0
        self.bits: int | None = None
        self._added, self._last, self._period = 0, None, 0.0

    def add(self, ticks: np.ndarray) -> np.ndarray:
        """``ticks`` (n,) as the file has them, with the ranges that went by added."""
        if not len(ticks):
            return ticks
        before = ticks[:-1] if self._last is None else np.append(self._last, ticks[:-1])
        lead = len(ticks) - len(before)
        step = ticks[lead:] - before
        rising = step[step > 0]
        if len(rising):
            self._period = float(np.median(rising))
        self._last = ticks[-1:]
        back = np.flatnonzero(step < 0)
        anew = [at for at in back if self._begins_anew(before[at], ticks[lead:][at])]
        if not anew and not self._added:
            return ticks
        added = np.full(len(ticks), self._added, dtype=ticks.dtype)
        for at in anew:
            added[at + lead :] += 2**self.bits
        self.count += len(anew)
        self._added = added[-1]
        return ticks + added

    def _begins_anew(self, before: float, after: float) -> bool:
        """Whether a counter of whole ticks ran over between two samples."""
        for bits in BITS:
            span = 2**bits
            late = after + span - before
            if before < span and before - after > NEARLY * span and late <= LATE * self._period:
                if self.bits not in (None, bits) or before != int(before):
                    return False
                self.bits = bits
                return True
        return False
