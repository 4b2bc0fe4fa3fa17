"""Times that begin anew: counters at a power of two, as those of microcontrollers do, and those of
a second, a minute, an hour, a day or a GPS week at its end.
"""

from __future__ import annotations

import numpy as np

BITS = (8, 16, 24, 32)
"""Widths of such counters."""

CALENDAR = {"second": 1.0, "minute": 60.0, "hour": 3600.0, "day": 86400.0, "GPS week": 604800.0}
"""s after which times begin anew that count from the start of a second, of a day, or of a week
(IS-GPS-200)."""

FINE = 999
"""Ticks that these have at least: what begins anew each second and counts in s are trials."""

SHORT = ("8 bits", "second", "minute", "hour")
"""Ranges of which times go back by about as much for other reasons, too."""

NEARLY = 0.9
"""A step back by more than this part of the counter's range may be its beginning anew."""

LATE = 10
"""Periods by which a sample may be late where the counter begins anew: one that is later is no sign
of a counter, but of a second log behind the first."""


class Unwrapped:
    """Makes the times of a log rise on where they began anew, piece by piece.

    ``seconds`` are in one of their ticks, any of them where their unit is not known. ``count`` is
    how often they did, ``after`` is what they count up to ("32 bits", "GPS week"), empty where they
    never began anew.
    """

    def __init__(self, *seconds: float) -> None:
        self.count = 0
        self.after = ""
        self._spans = spans(*seconds)
        self._added, self._ticks, self._last, self._period = 0, 0, None, 0.0

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
            added[at + lead :] += self._ticks
        self.count += len(anew)
        self._added = added[-1]
        return ticks + added

    def _begins_anew(self, before: float, after: float) -> bool:
        """Whether the times began anew between two samples: a counter is one of whole ticks."""
        for span, name in self._spans.items():
            late = after + span - before
            if before < span and before - after > NEARLY * span and late <= LATE * self._period:
                whole = name in CALENDAR or before == int(before)
                if self._ticks not in (0, span) or not whole:
                    return False
                self._ticks, self.after = span, name
                return True
        return False


def spans(*seconds: float) -> dict[int, str]:
    """Ticks that times may count up to, of so many ``seconds``, and what they are called."""
    calendar = {
        round(s / u): name for u in seconds for name, s in CALENDAR.items() if s >= FINE * u
    }
    return {2**bits: f"{bits} bits" for bits in BITS} | calendar
