"""The fits that are tried on the noise of a real channel, and the one that is chosen."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from pyimu.characterization.allan.moments import TERMS, AllanMoments
from pyimu.characterization.allan.pooled import pooled_moments
from pyimu.characterization.noise.least_squares import Problem
from pyimu.characterization.noise.sines import Groups, free_variances, sine_variance
from pyimu.numerics.laws import chi2

CHANCE = 0.01
"""A misfit that chance makes more rarely than this is one of the model."""

LEAST = 8
"""Cluster sizes, an octave apart, that always stay in the fit."""

WIDEST = 2.0
"""Relative error of the five terms beyond which nothing is gained by making it larger."""

NEARLY = 1.25
"""How much larger than the least a relative error may be, so that more clusters are used."""


@dataclass(frozen=True)
class LooseMoments(AllanMoments):
    """Moments with independent errors of the model added to each Allan variance.

    ``error`` is relative to the variance of the five terms, ``ends`` (t,) are absolute.
    """

    error: float = 0.0
    ends: float | np.ndarray = 0.0

    def covariance(self, squares: np.ndarray) -> np.ndarray:
        """Covariance (t, t) of the Allan variances, the errors of the model included."""
        spread = super().covariance(squares)
        np.einsum("ii->i", spread)[...] += (self.error * (self.design @ squares)) ** 2 + np.square(
            self.ends
        )
        return spread


@dataclass(frozen=True)
class Candidate:
    """A fit to try: its clusters and its terms; ``free`` if it has the term of 1 / m^2."""

    problem: Problem
    lines: Groups
    free: bool

    @property
    def terms(self) -> list[int]:
        """Indices of the terms to look for: a free term takes the place of quantization."""
        return list(range(1 if self.free else 0, len(TERMS)))

    @property
    def misfit(self) -> float:
        """Weighted sum of squared residuals."""
        return self.problem.misfit(self.problem.fit(self.terms))

    @property
    def freedom(self) -> int:
        """Degrees of freedom of the residuals."""
        return len(self.problem.measured) - len(self.terms) - self.problem.nuisance.shape[1]


def choose(
    m: np.ndarray,
    measured: np.ndarray,
    lengths: Sequence[int],
    lines: Groups,
    memory: float = 0.0,
) -> Candidate:
    """The first of the candidates that describes its clusters.

    If none does, it is the first that needs about the least relative error, and has been granted
    it. Of noise with a ``memory``, in samples, all have the free term and no shorter clusters.
    """
    p = pooled_moments(tuple(int(k) for k in m), tuple(int(n) for n in lengths))
    base = LooseMoments(p.m, p.design, p.products, p.sums, ends=_ends(m, lines, max(lengths)))
    candidates = []
    for candidate in _candidates(base, measured, lines, memory):
        if candidate.misfit < chi2.isf(CHANCE, max(candidate.freedom, 1)):
            return candidate
        candidates.append(candidate)
    loose = [_with_error(c) for c in candidates]
    least = min(c.problem.moments.error for c in loose)
    return next(c for c in loose if c.problem.moments.error <= NEARLY * least)


def _ends(m: np.ndarray, lines: Groups, n: int) -> np.ndarray:
    """Errors (t,) of the lines' Allan variances, as a record is no whole number of half periods.

    The mean of the squared sine of angular frequency w over k terms is a half to 1 / (2 k sin w),
    whatever its phase. The record has ``n`` samples.
    """
    count, error = np.maximum(n - 2 * m + 1, 1), np.zeros(len(m))
    for line in (v for group in lines for v in group):
        error += sine_variance(m, line) * np.minimum(
            1 / (count * abs(np.sin(2 * np.pi * line.frequency)) + 1e-9), 1.0
        )
    return error


def _candidates(
    base: LooseMoments, measured: np.ndarray, lines: Groups, memory: float
) -> Iterator[Candidate]:
    """The fits to try, one after the other.

    First the five terms and the lines, then with the free term, then without the shortest clusters,
    one less each time.
    """
    last = max(len(measured) - LEAST, 0)
    if not memory:
        yield _candidate(base, measured, lines, False, 0)
    for first in range(min(int(np.searchsorted(base.m, memory)), last), last + 1):
        yield _candidate(base, measured, lines, True, first)


def _candidate(
    p: LooseMoments, measured: np.ndarray, lines: Groups, free: bool, first: int
) -> Candidate:
    """The fit of the clusters from the one at index ``first`` on."""
    rest = slice(first, None)
    cut = LooseMoments(
        p.m[rest],
        p.design[rest],
        p.products[:, :, rest, rest],
        p.sums[:, rest, rest],
        ends=p.ends[rest],
    )
    # As many columns as leave a cluster for each term and one more.
    kept = lines[: max(len(cut.m) - len(TERMS) - 2, 0)]
    problem = Problem(cut, measured[rest], free_variances(cut.m, kept, free))
    return Candidate(problem, kept, free)


def _with_error(candidate: Candidate) -> Candidate:
    """The candidate with the relative error of its terms that its misfit requires."""
    return replace(candidate, problem=loosened(candidate.problem, candidate.terms))


def loosened(problem: Problem, terms: Sequence[int]) -> Problem:
    """The problem with the relative error that the misfit of the fit of these terms requires."""
    freedom = max(len(problem.measured) - len(terms) - problem.nuisance.shape[1], 1)

    def granted(error: float) -> Problem:
        return replace(problem, moments=replace(problem.moments, error=error))

    def excess(logarithm: float) -> float:
        one = granted(float(np.exp(logarithm)))
        return one.misfit(one.fit(terms)) - freedom

    low, high = np.log(1e-4), np.log(WIDEST)
    if excess(high) >= 0:
        return granted(WIDEST)
    return granted(float(np.exp(low if excess(low) <= 0 else brentq(excess, low, high, xtol=0.02))))
