"""What jumps in a residual in place of slow noise: between two levels, or to new ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from pyimu.identification.noise.choose import Term
from pyimu.identification.noise.explained import Explained
from pyimu.identification.noise.levels import (
    MARKOV,
    NUMBERS,
    levels_likelihood,
    markov_likelihood,
)
from pyimu.identification.noise.rows import Rows
from pyimu.identification.noise.telegraph import FINE, RATES, telegraph_likelihood
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import WALK

POPCORN = "random telegraph (popcorn) noise"
LEVELS = "a bias of many levels"

JUMPS = {
    POPCORN: "it jumps between two levels at random instants",
    LEVELS: "it jumps to another level at random instants, and stays there until the next",
}
"""By name what is random and no effect, and how that looks."""


Likelihood = Callable[[Sequence[Rows], np.ndarray, np.ndarray], float]


class Jump(NamedTuple):
    """The log-likelihood [nat] by which jumps are likelier than slow noise, and their shape."""

    gain: float
    shape: str

    @property
    def chance(self) -> float:
        """Of a gain as large where there is nothing but noise."""
        return float(np.exp(-max(self.gain, 0.0)))


def jumps_of(found: Explained) -> dict[int, Jump]:
    """The axes whose residual jumps, in place of the slow noise that was chosen for them: each at
    instants of its own or all together.
    """
    jumping = Jumping(found)
    slow = [i for i in found.state.axes if jumping.wanders(i)]
    if not slow:
        return {}
    apart = {i: ahead for i in slow if (ahead := jumping.popcorn([i])) > 0.0}
    together = jumping.popcorn(slow) if len(slow) > 1 else 0.0
    if together > sum(apart.values()):
        apart = dict.fromkeys(slow, together / len(slow))
    levels = jumping.levels(slow)
    shape = POPCORN
    if levels > sum(apart.values()):
        apart, shape = dict.fromkeys(slow, levels / len(slow)), LEVELS
    if sum(apart.values()) <= SET_WIDTH:
        return {}
    return {i: Jump(gain, shape) for i, gain in apart.items()}


class _Log(NamedTuple):
    """Means of an axis in a log, the variance (n,) of their white noise, and the log-likelihood of
    the noise that was chosen.
    """

    seen: Rows
    white: np.ndarray
    smooth: float


@dataclass(frozen=True)
class Jumping:
    found: Explained
    seen: dict[int, list[_Log]] = field(default_factory=dict)

    def popcorn(self, axes: list[int]) -> float:
        """Log-likelihood [nat], penalised, by which jumps between two levels at the same instants
        are likelier than the slow noise of the axes.
        """
        return self.of(telegraph_likelihood, axes, RATES) - self.slow_noise(axes)

    def levels(self, axes: list[int]) -> float:
        """That of jumps to new levels, which have to be likelier than what is smooth and of the
        same spectrum, too: what was chosen may be another that comes near it.
        """
        jumping = self.of(levels_likelihood, axes, NUMBERS)
        ahead = jumping - self.slow_noise(axes)
        if ahead > SET_WIDTH:
            ahead = min(ahead, jumping - self.of(markov_likelihood, axes, MARKOV * len(axes)))
        return ahead

    def of(
        self,
        likelihood: Likelihood,
        axes: list[int],
        others: int,
        along: Callable[[Rows], Rows | None] = lambda one: one,
    ) -> float:
        """Largest log-likelihood of all logs, of a size for each axis and log and of so many
        ``others`` numbers for each log; ``along`` puts something in place of the time of each, and
        there is none where it cannot.
        """
        walk = np.array([self._walk(i) for i in axes])
        total = 0.0
        for logs in zip(*(self.logs(i) for i in axes), strict=True):
            white = np.column_stack([one.white for one in logs])
            seen = [moved for one in logs if (moved := along(one.seen)) is not None]
            if len(seen) < len(logs):
                return -np.inf
            total += likelihood(seen, white, walk) - PENALTY * (len(axes) + others)
        return total

    def slow_noise(self, axes: list[int]) -> float:
        total = sum(one.smooth for i in axes for one in self.logs(i))
        return total - PENALTY * sum(self._numbers(i) for i in axes)

    def logs(self, i: int) -> list[_Log]:
        """The fitted logs of an axis, each looked at once."""
        if i not in self.seen:
            noise = self.found.sizes(self.found.state, i)
            means = [one.seen().means(FINE) for one in self.found.logs[i] if one.fitted]
            self.seen[i] = [
                _Log(one, noise.variance(one), float(noise.likelihood(one).sum())) for one in means
            ]
        return self.seen[i]

    def wanders(self, i: int) -> bool:
        """Whether an axis has more slow noise than is known of it beforehand."""
        found = self.found
        loose = WALK[0] in found.loose(i)
        return bool(self._slow(i)) or (loose and found.fitted[i].k2 > 0.0)

    def _slow(self, i: int) -> list[Term]:
        laws = ((t, t.kind.effect.law) for t in self.found.state.found.get(i, ()))
        return [t for t, law in laws if law.walk or law.markov]

    def _numbers(self, i: int) -> int:
        """Of the slow noise of an axis, whose numbers are those of all logs."""
        loose = WALK[0] in self.found.loose(i)
        return loose + sum(1 + t.kind.scans for t in self._slow(i))

    def _walk(self, i: int) -> float:
        """The random walk that is known of an axis; none where it is left to the data, in which
        jumps make one.
        """
        if WALK[0] in self.found.loose(i):
            return 0.0
        return self.found.start.axes[i].had.get(WALK[0], 0.0) ** 2
