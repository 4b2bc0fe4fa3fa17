"""A sensor with what its part declares and what it does not: one effect after another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from generators.instrument import Triad
from scipy.optimize import brentq

from effect_logs import bias_terms, gain_terms, motion_terms, nameless, noise_terms, strange
from effect_logs.scene import Scene
from effect_logs.term import Case, Term
from effect_logs.whitening import grams

INPUT = (
    *motion_terms.TERMS,
    *gain_terms.TERMS,
    *bias_terms.TERMS,
    *nameless.TERMS,
    *strange.TERMS,
)
NOISE, OUTPUT = noise_terms.TERMS, noise_terms.OUTPUT

TERMS: Mapping[str, Term] = {t.name: t for t in (*INPUT, *NOISE, *OUTPUT)}
"""Every effect of this package by name, in the order in which they act."""

NAMED = tuple(t for t in TERMS.values() if t.answer != "")

BELIEVED = 5.0
"""Times the consumer's size up to which an effect is drawn: twice as large is beyond belief."""

QUIETEST = 1e-11
"""Root density (SI) that a sensor may be given at least: its noise at 100 Hz is then a hundred
times the last decimal of a reference. An effect that asks for less is the rounding of numbers.
"""


class NotShown(ValueError):
    """An effect does not show in a log, or not at the size that is wanted."""


@dataclass(frozen=True)
class Chain:
    """One sensor of a kind in a scene. ``triad`` is what its part declares, ``free`` whether scale
    factor and misalignment are estimated; ``seed`` makes its noise. ``attitude`` is the standard
    deviation [rad] of each attitude of a reference that has no rate.
    """

    kind: str
    scene: Scene
    triad: Triad
    seed: int
    free: bool = False
    attitude: float = 0.0

    @cached_property
    def _noise(self) -> np.ndarray:
        """White noise and random walk (n, 3), each of unit density."""
        rng, n = np.random.default_rng([self.seed, 3]), len(self.scene.time)
        return rng.standard_normal((2, n, 3))

    def noise(self) -> np.ndarray:
        """Of the sensor as declared, with its bias (n, 3)."""
        white, walk = self._noise
        h = self.scene.h
        moved = np.cumsum(self.triad.k * np.sqrt(h) * walk, axis=0)
        return self.triad.bias + self.triad.n / np.sqrt(h) * white + moved

    def case(self, c, form) -> Case:
        return Case(self.kind, self.scene, c, form, self.seed)

    def measure(self, effects: Mapping[str, Case]) -> np.ndarray:
        """What it shows (n, 3) of the scene with effects by name: one that the part declares, too,
        is by how much the declared value is off.
        """
        own = {"misalignment": self.triad.skew, "scale_factor": self.triad.scale}
        y = self.scene.own(self.kind)
        for term in INPUT:
            case = effects.get(term.name)
            if term.name in own:
                off = 0.0 if case is None else case.c
                case = self.case(own[term.name] + off, {})
            if case is not None:
                y = term.apply(y, case)
        y = y + self.noise()
        for term in (*NOISE, *OUTPUT):
            if term.name in effects:
                y = term.apply(y, effects[term.name])
        return y

    def size(self, term: Term, case: Case) -> float:
        """Of one effect over the fitted rows, in sigmas."""
        if term.gain is not None:
            return term.gain(case, self.triad, self.free)
        return self.size_of(self.error({term.name: case}))

    def error(self, effects: Mapping[str, Case]) -> np.ndarray:
        """What effects change (n, 3) of what it shows."""
        return self.measure(effects) - self.measure({})

    def size_of(self, error: np.ndarray) -> float:
        return float(np.sqrt(sum(g[0, 0] for g in self.grams(error[:, :, None]))))

    def grams(self, errors: np.ndarray) -> list[np.ndarray]:
        """Products (k, k) of errors (n, 3, k) over the fitted rows, whitened, by axis."""
        rows = self.scene.fitted
        free = self.scene.own(self.kind)[:rows] if self.free else np.zeros((rows, 0))
        return grams(errors[:rows], self.triad, self.scene.h, free, self.attitude)

    def quieter(self, share: float) -> Chain:
        """Raises NotShown where it would be quieter than ``QUIETEST``."""
        if share * self.triad.n.min() < QUIETEST:
            raise NotShown("it shows to a sensor alone that has no noise")
        triad = replace(self.triad, n=share * self.triad.n, k=share * self.triad.k)
        return replace(self, triad=triad, attitude=share * self.attitude)


def size_of_all(chains: Sequence[Chain], term: Term, case: Case) -> float:
    """Of one effect over the fitted rows of several logs of one sensor, in sigmas."""
    return float(np.linalg.norm([c.size(term, c.case(case.c, case.form)) for c in chains]))


def tuned(
    chains: Sequence[Chain], term: Term, direction, form, sigmas: float
) -> tuple[list[Chain], Case]:
    """The logs of a sensor and the effect's case in the first of them, at which the effect is
    ``sigmas`` large over all of them.

    The coefficient is scaled up to ``BELIEVED`` times the consumer's; if more is wanted, or the
    effect knows but one size, the sensor is made quieter instead.
    """
    chains, typical = list(chains), term.sizes[chains[0].kind]
    most = np.log(typical if term.known else BELIEVED * typical)

    def at(log_size: float) -> Case:
        return chains[0].case(np.exp(log_size) * direction, form)

    for _ in range(8):
        largest = size_of_all(chains, term, at(most))
        if not largest > 0:
            raise NotShown(f"{term.name} does not show in this log")
        if not term.known and largest >= sigmas:
            break
        if abs(np.log(largest / sigmas)) < 0.005:
            return chains, at(most)
        share = largest / sigmas * (1.0 if term.known else 0.9)
        chains = [c.quieter(share) for c in chains]
    return chains, at(_root(lambda s: size_of_all(chains, term, at(s)), most, sigmas))


def _root(size, high: float, sigmas: float) -> float:
    """The logarithm of the coefficient, at most ``high``, at which ``size`` of it is ``sigmas``, to
    a thousandth; where the size jumps over that, the place of the jump.
    """

    def miss(at: float) -> float:
        return float(np.log(max(size(at), 1e-30) / sigmas))

    low, above = high, miss(high)
    while above > 0 and low > high - 40.0:
        low, above = low - max(1.01 * above, 0.1), miss(low - max(1.01 * above, 0.1))
    if above > 0:
        raise NotShown("the size jumps over the one that is wanted")
    return high if low == high else brentq(miss, low, high, xtol=1e-3)


def at_typical(
    chains: Sequence[Chain], term: Term, direction, form, least: float
) -> tuple[list[Chain], Case]:
    """The effect at the consumer's size, the sensor so quiet that this is ``least`` sigmas."""
    chains = list(chains)
    case = chains[0].case(term.sizes[chains[0].kind] * direction, form)
    for _ in range(8):
        size = size_of_all(chains, term, case)
        if size >= 0.995 * least or not term.by_size:
            break
        chains = [c.quieter(max(size / least, 1e-3)) for c in chains]
    return chains, case
