r"""Which noise it is, by the likelihood of the Allan variances: the models that were compared.

Flicker and a random walk look alike at the end of a record, and a drift that stops growing
(Gauss-Markov noise: an accelerometer that follows the temperature of a room) looks like either. So
beside the terms that are needed (``coefficients``) the model with flicker in the place of a random
walk and the other way round is tried, and those with one and with two Gauss-Markov terms in place
of, and beside, a random walk. White noise and flicker that are needed stay.

The likelihood has for each variance the chi-square law with the degrees of freedom that the model
gives it, 2 mean^2 / variance, and between them the correlations that the model gives the variances
(``moments``), taken as those of a Gaussian copula: Song, Scand. J. Statist. 27 (2000), 305-320.

A term costs as many nat as it would gain once in a thousand where it is not there: half of the
quantile of a chi-square of one degree of freedom of which half the mass is at zero, because a
square is not negative. A correlation time costs the logarithm of the octaves that it is looked for
in, as one that is as likely in each. ``benchmarks/characterize_ranking.py`` counts on simulated
logs what comes of it: in none of 60 logs of white noise, or of it and flicker, a Gauss-Markov term;
in 5 of 60 with a random walk one in place of that.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from scipy.optimize import nnls
from scipy.special import ndtri_exp

from pyimu.characterization.allan.moments import MARKOV, TERMS
from pyimu.characterization.allan.pooled import pooled_moments
from pyimu.characterization.noise.candidates import CHANCE, LooseMoments, loosened
from pyimu.characterization.noise.least_squares import CHANCE as GATE
from pyimu.characterization.noise.least_squares import Problem, has_noise, without
from pyimu.numerics.laws import chi2

STEP = np.sqrt(2.0)
"""Ratio of the correlation times that are tried."""

PEAK = 1.89
"""Cluster time over correlation time at which the Allan variance of Gauss-Markov noise is largest
(IEEE Std 952-2020, annex C): it must lie in the record."""

FINE = 0.05
"""Where there is no drift and chance makes the misfit more often, no Gauss-Markov term is tried."""

COST = float(chi2.isf(2 * GATE, 1)) / 2
"""What a square costs [nat]."""

B, K, R = (TERMS.index(t) for t in "BKR")


@dataclass(frozen=True)
class Model:
    """A model: its ``terms`` by letter, the correlation ``times`` of its Gauss-Markov terms.

    ``nats`` is its log-likelihood, ``cost`` what its terms cost, in nat. ``error`` is the relative
    error of each Allan variance that it needs besides. Times are in sample periods.
    """

    terms: str
    times: tuple[float, ...]
    nats: float
    cost: float
    error: float

    @property
    def score(self) -> float:
        """The log-likelihood less the cost."""
        return self.nats - self.cost


@dataclass(frozen=True)
class Ranking:
    """The chosen model as a ``problem`` and its terms ``kept``, and ``models``, best first.

    These are the best with each set of terms.
    ``spread`` (g,) is the standard error of the logarithm of each correlation time, nan where the
    likelihood does not tell.
    """

    problem: Problem
    kept: list[int]
    models: tuple[Model, ...]
    spread: tuple[float, ...] = ()

    @property
    def times(self) -> tuple[float, ...]:
        """Correlation times of the chosen model, in sample periods."""
        return self.models[0].times


def rank(problem: Problem, kept: Sequence[int], lengths: Sequence[int]) -> Ranking:
    """The best model of the variances of a ``problem`` in which the terms ``kept`` are needed."""
    base = _Tried.of(problem, kept)
    tried = [base, *_exchanged(problem, base.kept)]
    drift = {B, K, R} & set(base.kept)
    if drift or base.problem.moments.error or base.misfit > chi2.isf(FINE, base.freedom):
        tried += _with_markov(problem, base, lengths)
    # The first of the best: what is needed by its own law stays where nothing is better.
    best, spread = max(tried, key=lambda t: t.model.score), ()
    if best.times:
        best, spread = _refined(problem, best, lengths)
    others: dict[str, Model] = {}
    for t in sorted(tried, key=lambda t: -t.model.score):
        others.setdefault(t.model.terms, t.model)
    others.pop(best.model.terms, None)
    return Ranking(best.problem, best.kept, (best.model, *others.values()), spread)


@dataclass(frozen=True)
class _Tried:
    """A model fitted: its ``problem`` holds the moments of its own terms only."""

    problem: Problem
    kept: list[int]
    squares: np.ndarray
    times: tuple[float, ...]
    model: Model

    @classmethod
    def of(
        cls,
        problem: Problem,
        kept: Iterable[int],
        octaves: float = 1,
        times: tuple[float, ...] = (),
    ) -> _Tried:
        """A model as it is, or with an error of its variances where that is the better one."""
        plain = cls._as_it_is(problem, list(kept), octaves, times)
        if problem.moments.error or plain.misfit <= chi2.isf(CHANCE, plain.freedom):
            return plain
        loose = cls._as_it_is(loosened(problem, plain.kept), plain.kept, octaves, times)
        return max(plain, loose, key=lambda t: t.model.score)

    @classmethod
    def _as_it_is(
        cls, problem: Problem, kept: list[int], octaves: float, times: tuple[float, ...]
    ) -> _Tried:
        squares = problem.fit(kept)
        there = [k for k in kept if squares[k] > 0]
        error = problem.moments.error
        cost = COST * (len(there) + (error > 0)) + len(times) * float(np.log(max(octaves, 1)))
        letters = "".join((TERMS + MARKOV)[k] for k in there)
        model = Model(letters, times, log_likelihood(problem, squares), cost, error)
        return cls(problem, there, squares, times, model)

    @property
    def misfit(self) -> float:
        return self.problem.misfit(self.squares)

    @property
    def freedom(self) -> int:
        p = self.problem
        return max(len(p.measured) - len(self.kept) - p.nuisance.shape[1], 1)


def log_likelihood(problem: Problem, squares: np.ndarray) -> float:
    """Log-likelihood [nat] of the variances in noise of these ``squares`` (k,), but a constant."""
    if not has_noise(squares):
        return -np.inf
    covariance = problem.moments.covariance(squares)
    variance = problem.moments.design @ squares + problem.nuisance @ problem.strengths(squares)
    if np.any(variance <= 0):
        return -np.inf
    root = np.sqrt(np.diag(covariance))
    freedom = 2 * (variance / root) ** 2
    x = freedom * problem.measured / variance
    below, above = chi2.logcdf(x, freedom), chi2.logsf(x, freedom)
    z = np.where(below < above, ndtri_exp(below), -ndtri_exp(above))
    correlation = np.linalg.cholesky(covariance / np.outer(root, root))
    white = np.linalg.solve(correlation, z)
    copula = (np.sum(z**2) - np.sum(white**2)) / 2 - np.sum(np.log(np.diag(correlation)))
    nats = np.sum(chi2.logpdf(x, freedom) + np.log(freedom / variance)) + copula
    return float(nats) if np.isfinite(nats) else -np.inf


def _exchanged(problem: Problem, kept: list[int]) -> Iterator[_Tried]:
    """The model with flicker for a random walk or the other way round, where it has one of them."""
    if (B in kept) != (K in kept):
        yield _Tried.of(_exact(problem), sorted({*kept, B, K} - ({B} if B in kept else {K})))


def _exact(problem: Problem) -> Problem:
    """The problem without an error of the model: each model is granted its own."""
    return replace(problem, moments=replace(problem.moments, error=0.0))


def _with_markov(problem: Problem, base: _Tried, lengths: Sequence[int]) -> list[_Tried]:
    """The models with Gauss-Markov terms beside and in place of the drift of ``base``."""
    m = problem.moments.m
    low, high = 2 * m[0], m[-1] / PEAK
    if high <= low:
        return []
    count = int(np.log(high / low) / np.log(STEP)) + 1
    times, octaves = tuple(float(low * STEP**k) for k in range(count)), np.log2(high / low)
    wide = _extended(problem, lengths, times)
    steady = [k for k in base.kept if k not in (K, R)]
    loose = [k for k in (B, K) if k not in steady]
    sets = [[*steady, *more] for size in range(3) for more in combinations(loose, size)]
    tried = []
    for markov in (1, 2):
        found = [
            _Tried.of(_of(wide, chosen), _kept(terms, markov), octaves, _times(times, chosen))
            for terms in sets
            for chosen in _scanned(wide, base, terms, tried, markov)
        ]
        # What came out as nothing makes another model, or leaves out what is needed.
        tried += [
            t for t in found if {*steady, *range(len(TERMS), len(TERMS) + markov)} <= set(t.kept)
        ]
    return tried


def _kept(terms: Sequence[int], markov: int) -> list[int]:
    return [*terms, *range(len(TERMS), len(TERMS) + markov)]


def _times(times: tuple[float, ...], chosen: Sequence[int]) -> tuple[float, ...]:
    return tuple(times[k] for k in chosen)


def _scanned(
    wide: Problem, base: _Tried, terms: Sequence[int], tried: Sequence[_Tried], markov: int
) -> list[tuple[int, ...]]:
    """The correlation times, by number, with which ``terms`` fit best, and their neighbours.

    The weights are those of ``base``, or of the best model with one Gauss-Markov term; a second one
    is looked for beside the first of that.
    """
    first: tuple[int, ...] = ()
    weights = base
    count = wide.moments.design.shape[1] - len(TERMS)
    if markov == 2:
        ones = [t for t in tried if len(t.times) == 1]
        if not ones:
            return []
        weights = max(ones, key=lambda t: t.model.score)
        own, all_own = weights.problem.moments.design[:, -1], wide.moments.design[:, len(TERMS) :]
        first = (int(np.argmin(np.abs(all_own.T - own).sum(axis=1))),)
    root = np.linalg.cholesky(weights.problem.moments.covariance(weights.squares))
    white = np.linalg.solve(
        root, np.column_stack([wide.nuisance, wide.moments.design, wide.measured])
    )
    free = wide.nuisance.shape[1]
    white = without(white[:, :free], white[:, free:])
    white /= np.append(np.linalg.norm(white[:, :-1], axis=0), 1.0)
    columns = [*terms, *(len(TERMS) + k for k in first)]
    misfits = [
        nnls(white[:, [*columns, len(TERMS) + k]], white[:, -1])[1] if k not in first else np.inf
        for k in range(count)
    ]
    best = int(np.argmin(misfits))
    near = [k for k in (best - 1, best, best + 1) if 0 <= k < count and k not in first]
    return [(*first, k) for k in near]


def _extended(problem: Problem, lengths: Sequence[int], times: tuple[float, ...]) -> Problem:
    """The problem with Gauss-Markov noise of these correlation times, and no error of the model."""
    sizes = tuple(int(k) for k in problem.moments.m)
    p = pooled_moments(sizes, tuple(int(n) for n in lengths), times)
    moments = LooseMoments(p.m, p.design, p.products, p.sums, ends=problem.moments.ends)
    return replace(problem, moments=moments)


def _of(wide: Problem, chosen: Sequence[int]) -> Problem:
    """The problem with the five terms and the Gauss-Markov noise of these numbers only."""
    p, noise = wide.moments, [*range(len(TERMS) - 1), *(len(TERMS) - 1 + k for k in chosen)]
    return replace(
        wide,
        moments=replace(
            p,
            design=p.design[:, [*range(len(TERMS)), *(len(TERMS) + k for k in chosen)]],
            products=p.products[np.ix_(noise, noise)],
            sums=p.sums[noise],
        ),
    )


def _refined(
    problem: Problem, best: _Tried, lengths: Sequence[int]
) -> tuple[_Tried, tuple[float, ...]]:
    """The best model with its correlation times at the top of a parabola, and their spread.

    The parabola goes through the log-likelihoods at a time and its neighbours, in its logarithm.
    """
    times, spread, step = list(best.times), [], np.log(STEP)
    for k, time in enumerate(best.times):
        near = []
        for factor in (1 / STEP, STEP):
            moved = (*times[:k], time * factor, *times[k + 1 :])
            near.append(log_likelihood(*_refitted(problem, best, lengths, moved)))
        middle = log_likelihood(*_refitted(problem, best, lengths, tuple(times)))
        bend = near[0] + near[1] - 2 * middle
        if np.isfinite(bend) and bend < 0:
            times[k] = time * np.exp(np.clip((near[0] - near[1]) / (2 * bend), -0.5, 0.5) * step)
            spread.append(float(step / np.sqrt(-bend)))
        else:
            spread.append(np.nan)
    refined, squares = _refitted(problem, best, lengths, tuple(times))
    model = replace(best.model, times=tuple(times), nats=log_likelihood(refined, squares))
    return _Tried(refined, best.kept, squares, tuple(times), model), tuple(spread)


def _refitted(
    problem: Problem, best: _Tried, lengths: Sequence[int], times: tuple[float, ...]
) -> tuple[Problem, np.ndarray]:
    moved = _extended(problem, lengths, times)
    moved = replace(moved, moments=replace(moved.moments, error=best.problem.moments.error))
    return moved, moved.fit(best.kept)
