r"""Noise coefficients from an Allan deviation: a weighted fit of the sum of the five terms, with intervals; and the readings by eye.

With coefficients Q [rad], N [rad/sqrt(s)], B [rad/s], K [rad/s/sqrt(s)], R [rad/s^2] (for an accelerometer, m/s in place of rad)

    sigma^2(tau) = 3 Q^2 / tau^2 + N^2 / tau + (2 ln 2 / pi) B^2 + K^2 tau / 3 + R^2 tau^2 / 2

(Hidalgo 2012, table 3; IEEE Std 952-2020, annex C), the random walk's as its samples have it, K^2 tau / 3 (1 + h^2 / (2 tau^2)).
The overlapping estimates at all cluster times are made of the same samples.  So the fit is one of generalised least squares,
linear in the squares of the coefficients, which are kept from being negative; it weights by the covariance of the estimates
(``moments``) that the fitted noise has, and is done again until it stays.

Why not maximum likelihood on the samples: for N and K it is a local-level Kalman filter, but flicker and a rounded angle have
no such short filter.  The Allan variances are some twenty numbers however long the log is, and can be looked at beside the fit.

A term is needed where, added to the others, its square is ``NEEDED`` standard errors from zero, those of a log without it.  It
has an interval: its square counts as a chi-square with the degrees of freedom that its variance has, 2 (square)^2 / variance.
Of terms not needed the least is left out first.  Each has an upper bound: the value with which its estimate would come out as
low as it did in one log of twenty (for a level of 95 %).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import nnls
from scipy.stats import chi2, gamma, norm

from pyimu.characterize.moments import TERMS, AllanMoments, design, moments
from pyimu.errors import UserError
from pyimu.shaping import flicker_floor

CHANCE = 1e-3
"""A term is needed where noise without it would look as if it had as much of it with at most this probability."""

RAMP = TERMS.index("R")
"""The terms before it are noise."""

ROUNDS, CLOSE = 40, 1e-6
"""Repetitions at most, and the relative change that ends them."""


@dataclass(frozen=True)
class Coefficient:
    """One coefficient in SI units: estimate, standard error and interval; where it is not needed a bound from above.

    A coefficient that is not needed has the value zero, no standard error (nan), and the interval from zero to its bound.
    """

    value: float
    std: float
    low: float
    high: float

    @property
    def needed(self) -> bool:
        return self.value > 0

    def holds(self, value: float) -> bool:
        """Whether the interval contains it."""
        return self.low <= value <= self.high


@dataclass(frozen=True)
class NoiseFit:
    """Coefficients by their letters, those that were asked for, and how the fit went.

    ``covariance`` (k, k) is that of the needed coefficients, in the order of ``needed``.  ``misfit`` is the weighted sum of
    squares of what the fit leaves; its mean is ``freedom`` where the noise has the terms asked for and no other.
    """

    coefficients: Mapping[str, Coefficient]
    covariance: np.ndarray
    misfit: float
    freedom: int
    sample_period: float

    def __getitem__(self, term: str) -> Coefficient:
        return self.coefficients[term]

    @property
    def needed(self) -> str:
        return "".join(t for t, c in self.coefficients.items() if c.needed)

    def deviation(self, tau: np.ndarray) -> np.ndarray:
        """Allan deviation (n,) of the fitted noise at cluster times (n,) s."""
        squares = np.array([self[t].value ** 2 if t in self.coefficients else 0.0 for t in TERMS])
        return np.sqrt(design(np.asarray(tau, dtype=float) / self.sample_period) @ (squares / _si(self.sample_period)))


def fit_coefficients(clusters: np.ndarray, deviation: np.ndarray, n: int, h: float, terms: str = TERMS, level: float = 0.95) -> NoiseFit:
    """Coefficients from overlapping Allan deviations (t,) at cluster sizes (t,) in samples, of a record of ``n`` rates every ``h`` s.

    ``terms`` are the letters of those that may be needed; the noise is taken to have no other.  Sizes an octave apart
    (``octave_clusters``) say nearly all; much nearer neighbours say the same, and make the weights singular.

    Raises ValueError for an unknown term, sizes that do not fit the record, and more terms than sizes; UserError where the
    record has no noise.
    """
    m, measured = np.atleast_1d(clusters), np.atleast_1d(np.asarray(deviation, dtype=float)) ** 2
    chosen = [TERMS.index(t) for t in TERMS if t in terms]
    if len(chosen) != len(terms) or not chosen:
        raise ValueError(f"terms are some of {TERMS}, each once, not {terms!r}")
    if m.shape != measured.shape or len(m) <= len(chosen):
        raise ValueError(f"{len(chosen)} terms need more than as many cluster sizes, and a deviation for each: {m.shape} and {measured.shape}")
    if not np.all(measured > 0):
        raise UserError(f"the Allan deviation of clusters of {m[np.argmin(measured)]} samples is zero: a record without noise has no coefficients")
    # In units of the deviations, as the squares of small rates are tiny.
    unit = np.exp(np.mean(np.log(measured)))
    return _report(_Problem(moments(m, n), measured / unit), chosen, unit * _si(h), h, level)


def _si(h: float) -> np.ndarray:
    """What squares of coefficients for a sample period of one are multiplied by, (5,), for one of h s."""
    return float(h) ** np.array([2, 1, 0, -1, -2])


def _report(problem: _Problem, chosen: list[int], si: np.ndarray, h: float, level: float) -> NoiseFit:
    kept = problem.needed(chosen)
    squares = problem.fit(kept)
    covariance = problem.covariance(kept, squares)
    stds = dict(zip(kept, np.sqrt(np.diag(covariance)), strict=True))
    found = {}
    for i in chosen:
        interval = _interval(squares[i], stds[i], level) if i in kept else (0.0, problem.bound(i, kept, squares, level))
        std = stds[i] / (2 * np.sqrt(squares[i])) if i in kept else np.nan
        found[TERMS[i]] = Coefficient(*(float(v) for v in np.array([np.sqrt(squares[i]), std, *np.sqrt(interval)]) * np.sqrt(si[i])))
    slope = np.sqrt(si[kept] / squares[kept]) / 2
    return NoiseFit(found, covariance * np.outer(slope, slope), problem.misfit(squares), len(problem.measured) - len(kept), h)


def _interval(square: float, std: float, level: float) -> tuple[float, float]:
    """Of a square that counts as a chi-square with the degrees of freedom of its standard error."""
    freedom = 2 * (square / std) ** 2
    side = (1 - level) / 2
    return square * freedom / chi2.isf(side, freedom), square * freedom / chi2.ppf(side, freedom)


@dataclass(frozen=True)
class _Problem:
    """Allan variances ``measured`` (t,) and their moments; squares of coefficients are (5,), for a sample period of one."""

    moments: AllanMoments
    measured: np.ndarray

    def fit(self, kept: Sequence[int]) -> np.ndarray:
        """Squares of the terms ``kept``, none negative, zero of the others, under the weights that they themselves make."""
        root = np.diag(self.measured * np.sqrt(self.moments.m))
        squares = np.zeros(len(TERMS))
        for _ in range(ROUNDS):
            before = squares
            squares = self._non_negative(kept, root)
            if np.all(np.abs(squares - before) <= CLOSE * (squares + before)) or not np.any(squares[:RAMP]):
                break
            root = np.linalg.cholesky(self.moments.covariance(squares))
        return squares

    def _non_negative(self, kept: Sequence[int], root: np.ndarray) -> np.ndarray:
        """Least squares under the covariance root root^T."""
        # Not a triangular solve: libraries share even such small ones among processors, and wait for them a hundred times longer.
        white = np.linalg.solve(root, np.column_stack([self.moments.design[:, kept], self.measured]))
        size = np.linalg.norm(white[:, :-1], axis=0)
        squares = np.zeros(len(TERMS))
        squares[kept] = nnls(white[:, :-1] / size, white[:, -1])[0] / size
        return squares

    def functionals(self, terms: Sequence[int], squares: np.ndarray) -> np.ndarray:
        """Rows (k, t) whose products with Allan variances are the estimates, of any sign, of ``terms`` under the weights of given squares."""
        x = self.moments.design[:, terms]
        weighted = cho_solve(cho_factor(self.moments.covariance(squares), lower=True), x).T
        size = 1 / np.sqrt(np.sum(weighted.T * x, axis=0))
        return size[:, None] * np.linalg.solve(weighted @ x * np.outer(size, size), size[:, None] * weighted)

    def covariance(self, kept: Sequence[int], squares: np.ndarray) -> np.ndarray:
        """Of the estimates (k, k) of the terms ``kept``, which have these squares."""
        rows = self.functionals(kept, squares)
        return rows @ self.moments.covariance(squares) @ rows.T

    def misfit(self, squares: np.ndarray) -> float:
        left = self.measured - self.moments.design @ squares
        return float(left @ cho_solve(cho_factor(self.moments.covariance(squares), lower=True), left))

    def needed(self, chosen: Sequence[int]) -> list[int]:
        """Those of the terms that are left when, one after the other, the least needed has gone."""
        kept = list(chosen)
        while len(kept) > 1:
            squares = self.fit(kept)
            chances = [self._chance(i, kept, squares) for i in kept]
            if max(chances) <= CHANCE:
                break
            kept.pop(int(np.argmax(chances)))
        return kept

    def _chance(self, i: int, kept: Sequence[int], squares: np.ndarray) -> float:
        """Probability, at most, that noise of the other terms gives term i an estimate as large as it has.

        Once under the weights of that noise, which are the sharpest for a small term but put a random walk into the
        longest cluster alone; and once under those of the fit ``squares`` of all ``kept``.
        """
        others = self.fit([j for j in kept if j != i])
        if not np.any(others[:RAMP]):
            return 0.0
        chances = [self._tail(i, others, others)]
        if squares[i] > 0:
            chances.append(self._tail(i, squares, others))
        return len(chances) * min(chances)

    def _tail(self, i: int, weights: np.ndarray, others: np.ndarray) -> float:
        row = self.functionals([i, *(j for j in np.flatnonzero(weights) if j != i)], weights)[0]
        std, shape = self._spread(row, others)
        excess = row @ (self.measured - self.moments.design @ others) / std
        return float(gamma.sf(shape + excess * np.sqrt(shape), shape))

    def _spread(self, row: np.ndarray, squares: np.ndarray) -> tuple[float, float]:
        """Standard deviation of the product of ``row`` with the Allan variances, and the shape of a gamma distribution as skew.

        Its skewness is taken for the mean of those of the Allan variances, in proportion to what they contribute to its variance.
        """
        covariance = self.moments.covariance(squares)
        shares = row * (covariance @ row)
        variance = np.sum(shares)
        skewness = np.abs(shares) / variance @ (2 * np.sqrt(np.diag(covariance)) / (self.moments.design @ squares))
        return float(np.sqrt(variance)), float(4 / skewness ** 2)

    def bound(self, i: int, kept: Sequence[int], squares: np.ndarray, level: float) -> float:
        """Square of term i, added to those ``kept``, below which its estimate lies with the probability 1 - ``level`` as far as it does."""
        bound, squares = 0.0, squares.copy()
        for _ in range(ROUNDS):
            squares[i], before = bound, bound
            row = self.functionals([i, *kept], squares)[0]
            std, _ = self._spread(row, squares)
            bound = max(row @ self.measured, 0.0) + std * norm.ppf(level)
            bound = max(bound, before)
            if bound - before <= CLOSE * bound:
                return bound
        return np.inf


def mean_coefficient(tests: Sequence[Coefficient], level: float = 0.95) -> tuple[Coefficient, float]:
    """Mean of one coefficient over independent logs of a part, with an interval from their standard errors; and their standard deviation.

    The second, nan for a single log, is what the logs themselves say of the first's standard errors.  Where a log does not
    need the coefficient there is no mean, and the bound is the largest that any log gives.
    """
    if not all(c.needed for c in tests):
        return Coefficient(0.0, np.nan, 0.0, max(c.high for c in tests)), np.nan
    values = np.array([c.value for c in tests])
    std = float(np.sqrt(np.sum([c.std ** 2 for c in tests]))) / len(tests)
    # In squares, as for one log: the mean has as many times its degrees of freedom as there are logs.
    low, high = np.sqrt(_interval(values.mean() ** 2, 2 * values.mean() * std, level))
    return Coefficient(float(values.mean()), std, float(low), float(high)), float(values.std(ddof=1)) if len(values) > 1 else np.nan


# What is read off the plot

N_AT, K_AT = 1.0, 3.0
"""Cluster times [s] at which a line of slope -1/2 has the height N and one of slope +1/2 the height K."""

CLEAR, FEW = 4.0, 10.0
"""The line of slope +1/2 is laid through cluster times of so many times that of the floor and more; no cluster is read that
fits into the record less often than this."""


@dataclass(frozen=True)
class Reading:
    """Coefficients as read off a plot, in SI units; nan for K where the record is too short to show its slope."""

    N: float
    K: float
    B: float


def read_coefficients(tau: np.ndarray, deviation: np.ndarray) -> Reading:
    """Read Allan deviations (t,) at cluster times (t,) s, rising, that reach half the record, as Hidalgo 2012, section 2.2, does.

    N is the height at 1 s (between cluster times along the line that joins them), K that at 3 s of the line of slope +1/2
    through the long cluster times, B the lowest point over 0.664.  Which times are long is not said there: here those from
    ``CLEAR`` times that of the lowest point on, where white noise is a sixteenth of the random walk's variance.

    Raises ValueError where 1 s is not among the cluster times.
    """
    tau, deviation = np.asarray(tau, dtype=float), np.asarray(deviation, dtype=float)
    if not tau[0] <= N_AT <= tau[-1]:
        raise ValueError(f"N is read at {N_AT:g} s, which is not between the cluster times {tau[0]:g} and {tau[-1]:g} s")
    legible = tau <= max(2 * tau[-1] / FEW, tau[0])
    lowest = int(np.argmin(deviation[legible]))
    rising = legible & (tau >= CLEAR * tau[lowest])
    K = np.exp(np.mean(np.log(deviation[rising] * np.sqrt(K_AT / tau[rising])))) if rising.any() else np.nan
    N = np.exp(np.interp(np.log(N_AT), np.log(tau), np.log(deviation)))
    return Reading(float(N), float(K), float(deviation[lowest] / flicker_floor(1.0)))


def crossing(N: np.ndarray, K: np.ndarray) -> np.ndarray:
    """B that the floor of white noise and random walk alone reads as: sqrt(2 N K / sqrt(3)), at tau = sqrt(3) N / K, over 0.664."""
    return np.sqrt(2 * N * K / np.sqrt(3)) / flicker_floor(1.0)
