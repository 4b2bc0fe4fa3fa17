"""The times of a log: its sample period, its gaps, and whether it keeps one rate."""

from __future__ import annotations

import math
from copy import copy
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.gaps import GapFinder, gap_rows

GAP = 1.5
"""A step of the time above so many sample periods is a gap, but for late stamps (``gaps``) and what
rounding does to it."""

WINDOW = 512
"""Steps of a window in which the rate is measured."""

OTHER_RATE = 0.005
"""A window whose period is off by more than this part is at another rate, where times scatter so
little that this can be told."""

PARTS, SIGMAS = 16, 6.0
"""The period of a window is known to the scatter of that of its parts, over the root of their
number. Six standard deviations lie between a window and the log's rate by chance once in 5e8
windows."""

COARSE = 0.49
"""Times rounded to more than this part of the period have steps of two lengths, too far apart to be
one by their size."""

MOSTLY = 0.9
"""The share of the steps that must be whole periods for their mean to be taken, not their median.
"""

TWO = 0.4
"""Of two rates the windows make two heaps, and between them lies so much of their range, or, with a
window that holds both, half of it; of one rate that wanders the windows fill the range."""

FEW = 16
"""Windows of a log, fewer than which are too few to fill a range: their parts tell then."""

RATES = (1e-3, 1e6)
"""Hz; no inertial sensor is sampled more slowly or faster: such a rate is one of a wrong unit."""

LIKELY = (0.99, 10100.0)
"""Hz; inertial sensors are seldom sampled more slowly than once a second, or faster than 10 kHz: a
unit of the times that is wrong by a thousand brings 100 Hz out of this range."""

LEAST_ROUNDED = 32
"""So many steps of the rarer length tell rounded times from lost samples."""


@dataclass(frozen=True)
class Cadence:
    """The sample period ``period`` [s] and the step ``longest`` [s] above which there may be a gap.

    A longer step is a gap if the stamps stay late after it.
    """

    period: float
    longest: float

    @classmethod
    def of_period(cls, period: float) -> Cadence:
        return cls(period, GAP * period)


def cadence_of(time: np.ndarray) -> Cadence:
    """The cadence of the times (n,).

    The period is the time between gaps over its steps; of two rates it is that of most windows.
    """
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
    rough = Cadence.of_period(
        float(regular.mean()) if len(regular) > MOSTLY * len(step) else median
    )
    kept = np.ones(len(step), bool)
    kept[gap_rows(time, rough.period, rough.longest) - 1] = False
    # What is late by chance catches up: without it the steps that are left are short.
    return Cadence.of_period(_typical(step[kept])) if kept.sum() > MOSTLY * len(step) else rough


def _typical(step: np.ndarray) -> float:
    """The mean step [s], but of two rates that of most windows."""
    mean, count = float(step.mean()), len(step) // WINDOW
    if count < 2:
        return mean
    windows = np.sort(step[: count * WINDOW].reshape(count, WINDOW).mean(axis=1))
    if not _two_heaps(windows):
        return mean
    # The middle one alone may lie across the change of the rate.
    near = max(
        (np.abs(windows / windows[k * (count - 1) // 4] - 1) < OTHER_RATE for k in (1, 2, 3)),
        key=np.count_nonzero,
    )
    return mean if near.all() else float(windows[near].mean())


def _two_heaps(sorted_values: np.ndarray) -> bool:
    """Whether values in order make two heaps, and do not fill the range between."""
    span = float(sorted_values[-1] - sorted_values[0])
    return float(np.diff(sorted_values).max(initial=0.0)) >= TWO * span


def period_of(time: np.ndarray) -> float:
    """s; the sample period of the times (n,)."""
    return cadence_of(time).period


def _rounding(step: np.ndarray, median: float) -> float:
    """The unit u [s] to which the times were rounded where that is ``COARSE``, else 0.

    Times of 976 Hz in ms, for example, have steps of 1 and 2 ms.

    Lost samples make long steps too. But the time over m steps of rounded times scatters by u^2 /
    4 at most, of lost samples by u^2 for each one in it: m is chosen to have eight of the rarer
    steps.
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


def runs(flags: np.ndarray) -> list[tuple[int, int]]:
    """Ranges (start, stop) of true flags."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], flags.astype(np.int8), [0]])))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def segments(gaps: np.ndarray, count: int) -> list[tuple[int, int]]:
    """Index ranges (start, stop) of ``count`` rows between the ``gaps`` (m,).

    ``gaps`` are the rows that follow a gap.
    """
    edges = [0, *map(int, gaps[gaps > 0]), count]
    return list(pairwise(edges))


def unlikely_rate(rate: float) -> list[Finding]:
    """That a sample rate [Hz] is outside of ``LIKELY``, and what it is by the next unit."""
    if not rate < LIKELY[0] and not rate > LIKELY[1]:
        return []
    way, other = ("smaller", 1000 * rate) if rate < LIKELY[0] else ("larger", rate / 1000)
    detail = {"rate": rate, "other_rate": other, "way": way}
    return [Finding("unlikely_rate", "time", 1, detail)]


class Clock:
    """The sample rate and the gaps of a log, checked piece by piece against its ``cadence``.

    The result does not depend on how the log is cut into pieces.
    """

    def __init__(self, cadence: Cadence) -> None:
        self.cadence = cadence
        self._finder = GapFinder(cadence.period, cadence.longest)
        self._gaps, self._longest, self._total = 0, 0.0, 0.0
        self._times, self._first = np.empty(0), 0
        self._after = np.empty(0, dtype=np.int64)
        self._variance, self._windows = 0.0, 0
        self._others: list[tuple[float, float]] = []
        self._periods: list[float] = []
        self._parts: list[float] = []

    def add(self, time: np.ndarray) -> None:
        """``time`` (n,) follows what was added before."""
        self._times = np.concatenate((self._times, time))
        self._look(*self._finder.add(time))

    def _look(self, rows: np.ndarray, steps: np.ndarray) -> None:
        """Go on to where the gaps are known, among them those before ``rows`` (m,)."""
        self._gaps += len(rows)
        for (
            gap
        ) in steps.tolist():  # one by one, for the sum of rounded numbers depends on its order
            self._longest, self._total = (
                max(self._longest, gap),
                self._total + gap - self.cadence.period,
            )
        self._after = np.append(self._after, rows)
        whole = max(self._finder.settled - self._first - 1, 0) // WINDOW
        if not whole:
            return
        kept = np.ones(whole * WINDOW, bool)
        places = self._after - self._first - 1
        kept[places[places < len(kept)]] = False
        self._windows_of(self._times[: whole * WINDOW + 1], kept.reshape(whole, WINDOW))
        self._after, self._times = (
            self._after[places >= len(kept)],
            self._times[whole * WINDOW :].copy(),
        )
        self._first += whole * WINDOW

    def _windows_of(self, times: np.ndarray, kept: np.ndarray) -> None:
        """Windows whose steps are (m, WINDOW), those ``kept`` without gap."""
        step = np.where(kept, np.diff(times).reshape(kept.shape), 0.0)
        parts, count = (v.reshape(len(kept), PARTS, -1).sum(axis=2) for v in (step, kept))
        whole = count.sum(axis=1)
        period = np.where(2 * whole > WINDOW, step.sum(axis=1) / np.maximum(whole, 1), np.nan)
        rate = np.where(count > 0, parts / np.maximum(count, 1), period[:, None])
        for k, (value, variance) in enumerate(
            zip(period.tolist(), (rate.var(axis=1) / (PARTS - 1)).tolist())
        ):
            if not math.isnan(value):
                if len(self._periods) < FEW:
                    self._parts += rate[k].tolist()
                self._periods.append(value)
                self._variance, self._windows = self._variance + variance, self._windows + 1
            if not self._off(value) <= OTHER_RATE:
                # At another rate the log's period does not tell late stamps from gaps.
                self._others.append(
                    (float(times[k * WINDOW]), period_of(times[k * WINDOW : (k + 1) * WINDOW + 1]))
                )

    def _off(self, period: float) -> float:
        return abs(period / self.cadence.period - 1)

    def findings(self) -> list[Finding]:
        """The findings ``unlikely_rate``, ``gaps``, ``two_rates`` and ``rate_wanders``, as far as
        the log was added.

        ``gaps`` has the ``longest`` step and the ``total`` time lost [s]; ``two_rates`` how many
        samples have another rate than the log, the typical one of these, and since when;
        ``rate_wanders`` how many are off a rate that changes slowly, and between which it does.
        """
        done = copy(self)  # more may be added, and tell of the last rows
        done._finder, done._others = copy(self._finder), self._others.copy()
        done._periods, done._parts = self._periods.copy(), self._parts.copy()
        done._look(*done._finder.end())
        return done._found()

    def _found(self) -> list[Finding]:
        found = unlikely_rate(1 / self.cadence.period)
        if self._gaps:
            found.append(
                Finding(
                    "gaps", "time", self._gaps, {"longest": self._longest, "total": self._total}
                )
            )
        least = SIGMAS * math.sqrt(self._variance / max(self._windows, 1)) / self.cadence.period
        others = [
            (start, period)
            for start, period in self._others
            if self._off(period) > max(OTHER_RATE, least)
        ]
        heaps = self._parts if len(self._periods) < FEW else self._periods
        # At a second rate below two thirds of the first every step is a gap, and in no window.
        seldom = [p for _, p in others if p > (1 + OTHER_RATE) * max(self._periods, default=p)]
        if 2 * len(seldom) < len(others) and self._periods and not _two_heaps(np.sort(heaps)):
            periods = (self.cadence.period, *self._periods)
            detail = {
                "rate": 1 / self.cadence.period,
                "least_rate": 1 / max(periods),
                "largest_rate": 1 / min(periods),
            }
            found.append(Finding("rate_wanders", "time", len(others) * WINDOW, detail))
        elif others:
            other = sorted(period for _, period in others)[len(others) // 2]
            detail = {
                "rate": 1 / self.cadence.period,
                "other_rate": 1 / other,
                "first": others[0][0],
            }
            found.append(Finding("two_rates", "time", len(others) * WINDOW, detail))
        return found
