"""The shortest set of motions that tells enough."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.plan.information import Information

LONGEST = 8 * 3600.0
"""s; of a plan: a day's work."""

HIDDEN = 50.0
"""Lack [nat] of a coefficient that is not shown at all."""


@dataclass(frozen=True)
class Question:
    """Coefficients that are estimated together, and the standard errors wanted of some."""

    keys: tuple[Coefficient, ...]
    wanted: Mapping[Coefficient, float]

    def lack(self, found: Information) -> float:
        """By how much the wanted errors are missed, the logarithms of their ratios added up."""
        errors = found.on(self.keys).errors()
        with np.errstate(divide="ignore"):
            ratios = np.log([errors[k] / w for k, w in self.wanted.items()])
        return float(np.clip(ratios, 0.0, HIDDEN).sum())


@dataclass(frozen=True)
class Chooser:
    """Looks for the shortest set of motions, each given by its information and its duration in s,
    that answers all questions.
    """

    found: Sequence[Information]
    durations: Sequence[float]
    questions: Sequence[Question]

    def lack(self, counts: Sequence[float]) -> float:
        done = [i.times(n) for i, n in zip(self.found, counts, strict=True) if n]
        if not done:
            return HIDDEN * sum(len(q.wanted) for q in self.questions)
        total = sum(done[1:], done[0])
        return sum(q.lack(total) for q in self.questions)

    def duration(self, counts: Sequence[float]) -> float:
        return float(np.dot(counts, self.durations))

    def shortest(self) -> list[int] | None:
        """How often to do each motion; None where no set of at most ``LONGEST`` answers all."""
        best: list[int] | None = None
        for support in self._supports():
            best = self._better(best, self._within(support, self._left(best)))
        return self._better(best, self._greedy(self._left(best)))

    def _left(self, best: list[int] | None) -> float:
        return LONGEST if best is None else self.duration(best)

    def _better(self, one: list[int] | None, other: list[int] | None) -> list[int] | None:
        if one is None or (other is not None and self.duration(other) < self.duration(one)):
            return other
        return one

    def _supports(self) -> list[tuple[int, ...]]:
        """One motion and two, those that can be enough however often they are done."""
        every = range(len(self.found))
        some = [s for n in (1, 2) for s in combinations(every, n)]
        return [s for s in some if self.lack(self._most(s)) == 0.0]

    def _most(self, support: Sequence[int]) -> list[float]:
        counts = [0.0] * len(self.found)
        for i in support:
            counts[i] = LONGEST / self.durations[i]
        return counts

    def _within(self, support: tuple[int, ...], left: float) -> list[int] | None:
        """The shortest with these motions alone, in less than ``left`` s."""
        best, (first, *second) = None, support
        for n in _counts(left / self.durations[first]):
            counts = [0] * len(self.found)
            counts[first] = n
            if second:
                most = int((left - n * self.durations[first]) / self.durations[second[0]])
                counts = self._fewest(counts, second[0], most)
            if counts and self.duration(counts) < left and self.lack(counts) == 0.0:
                best, left = counts, self.duration(counts)
                if not second:
                    break
        return best

    def _fewest(self, counts: list[int], which: int, most: int) -> list[int]:
        """The counts with the fewest of one motion that is enough, at most ``most``, by halving."""
        low, high = 0, most
        if high < 1 or self.lack(_put(counts, which, high)) > 0.0:
            return []
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (
                (low, middle) if self.lack(_put(counts, which, middle)) == 0.0 else (middle, high)
            )
        return _put(counts, which, high)

    def _greedy(self, left: float) -> list[int] | None:
        """What lowers the lack most a second, one after the other, less what is not needed then."""
        counts, lack = [0] * len(self.found), np.inf
        while self.duration(counts) < left:
            lack = self.lack(counts)
            if lack == 0.0:
                return self._pruned(counts)
            grown = max(1, sum(counts) // 8)
            steps = [_put(counts, i, n + grown) for i, n in enumerate(counts)]
            gains = [
                (lack - self.lack(c)) / (self.duration(c) - self.duration(counts)) for c in steps
            ]
            if not max(gains) > 0.0:
                return None
            counts = steps[int(np.argmax(gains))]
        return None

    def _pruned(self, counts: list[int]) -> list[int]:
        for i in np.argsort(self.durations)[::-1]:
            while counts[i] and self.lack(_put(counts, i, counts[i] - 1)) == 0.0:
                counts = _put(counts, i, counts[i] - 1)
        return counts


def _put(counts: Sequence[int], which: int, value: int) -> list[int]:
    return [value if i == which else n for i, n in enumerate(counts)]


def _counts(most: float) -> list[int]:
    """1, 2, 3 and so on, later in steps of an eighth, up to ``most``."""
    out, n = [], 1
    while n <= most:
        out.append(n)
        n += max(1, n // 8)
    return out
