"""The times of a log: its sample period, its gaps, and whether it keeps one rate."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pyimu.errors import Finding

GAP = 1.5
"""A step of the time above so many sample periods is a gap, but for what rounding does to it."""

WINDOW = 512
"""Steps of a window in which the rate is measured."""

OTHER_RATE = 0.1
"""A window whose period is off by more than this part is at another rate.  The median of 512 steps that scatter by half a
period (one standard deviation) is off by 0.028 of the period (1.25 / sqrt(512) of the scatter), a third of that."""

COARSE = 0.49
"""Times rounded to more than this part of the period have steps of two lengths, too far apart to be one by their size."""

LEAST_ROUNDED = 32
"""So many steps of the rarer length tell rounded times from lost samples."""


@dataclass(frozen=True)
class Cadence:
    """``period`` between samples [s]; a step of the time above ``longest`` [s] is a gap."""

    period: float
    longest: float

    @classmethod
    def of_period(cls, period: float) -> Cadence:
        return cls(period, GAP * period)


def cadence_of(time: np.ndarray) -> Cadence:
    """That of the times (n,): the median step, refined by the mean of the steps that are no gap (a file's times are rounded)."""
    step = np.diff(time)
    if not len(step):
        return Cadence.of_period(math.nan)
    median = float(np.median(step))
    unit = _rounding(step, median)
    if unit:
        longest = median + 1.01 * unit
        period = float(step[step <= longest].mean())
        return Cadence(period, max(longest, GAP * period))
    regular = step[np.abs(step - median) < (GAP - 1) * median]
    return Cadence.of_period(float(regular.mean()) if len(regular) > 0.9 * len(step) else median)


def period_of(time: np.ndarray) -> float:
    """s; the sample period of the times (n,)."""
    return cadence_of(time).period


def _rounding(step: np.ndarray, median: float) -> float:
    """The unit u [s] to which the times were rounded where that is ``COARSE``, else 0: 976 Hz in ms has steps of 1 and 2 ms.

    Lost samples make long steps too.  But the time over m steps of rounded times scatters by u^2 / 4 at most, of lost
    samples by u^2 for each one in it: m is chosen to have eight of the rarer steps.
    """
    off = np.abs(step - median)
    odd = off[(off > 1e-3 * median) & (off < 1.01 * median)]
    unit = float(np.median(odd)) if len(odd) >= LEAST_ROUNDED else 0.0
    if unit < COARSE * median:
        return 0.0
    known = step <= median + 1.01 * unit
    drift = np.cumsum(np.where(known, step - step[known].mean(), 0.0))
    m = math.ceil(8 * len(step) / len(odd))
    return unit if np.var(drift[m:] - drift[:-m]) < unit**2 / 2 else 0.0


def segments(time: np.ndarray, longest: float) -> list[tuple[int, int]]:
    """Index ranges (start, stop) of ``time`` (n,) without a step above ``longest`` [s]."""
    edges = [0, *map(int, np.flatnonzero(np.diff(time) > longest) + 1), len(time)]
    return list(pairwise(edges))


class Clock:
    """Watches the times of a log, piece by piece, against its ``cadence``; the result does not depend on the pieces."""

    def __init__(self, cadence: Cadence) -> None:
        self.cadence = cadence
        self._gaps, self._longest, self._total = 0, 0.0, 0.0
        self._times = np.empty(0)
        self._others: list[float] = []
        self._first = math.nan

    def add(self, time: np.ndarray) -> None:
        """``time`` (n,) follows what was added before."""
        known = len(self._times)
        times = np.concatenate((self._times, time))
        step = np.diff(times[max(known - 1, 0):])
        self._count_gaps(step[step > self.cadence.longest])
        whole = max(len(times) - 1, 0) // WINDOW
        for k in self._suspects(times[:whole * WINDOW + 1]):
            window = times[k * WINDOW:(k + 1) * WINDOW + 1]
            self._compare(window[0], period_of(window))
        self._times = times[whole * WINDOW:]

    def _count_gaps(self, gaps: np.ndarray) -> None:
        self._gaps += len(gaps)
        for gap in gaps.tolist():  # one by one, for the sum of rounded numbers depends on its order
            self._longest, self._total = max(self._longest, gap), self._total + gap

    def _suspects(self, times: np.ndarray) -> list[int]:
        """The windows whose median step is off."""
        if len(times) <= WINDOW:
            return []
        median = np.median(np.diff(times).reshape(-1, WINDOW), axis=1)
        return np.flatnonzero(self._is_other(median)).tolist()

    def _compare(self, start: float, period: float) -> None:
        if self._is_other(period):
            self._first = start if not self._others else self._first
            self._others.append(period)

    def _is_other(self, period):
        return np.abs(period - self.cadence.period) > OTHER_RATE * self.cadence.period

    def findings(self) -> list[Finding]:
        """``gaps``; and ``two_rates``: how many samples have another rate than the log, the typical one of these, since when."""
        found = []
        if self._gaps:
            found.append(Finding("gaps", "time", self._gaps, {"longest": self._longest, "total": self._total}))
        if self._others:
            detail = {"rate": 1 / self.cadence.period, "other_rate": 1 / float(np.median(self._others)), "first": float(self._first)}
            found.append(Finding("two_rates", "time", len(self._others) * WINDOW, detail))
        return found
