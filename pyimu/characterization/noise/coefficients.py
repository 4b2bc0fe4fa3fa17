r"""Noise coefficients with intervals: a weighted fit of the five terms to an Allan deviation.

With coefficients Q [rad], N [rad/sqrt(s)], B [rad/s], K [rad/s/sqrt(s)], R [rad/s^2] (for an
accelerometer, m/s in place of rad)

    sigma^2(tau) = 3 Q^2 / tau^2 + N^2 / tau + (2 ln 2 / pi) B^2 + K^2 tau / 3 + R^2 tau^2 / 2

(Hidalgo 2012, table 3; IEEE Std 952-2020, annex C), the random walk's as its samples have it, K^2
tau / 3 (1 + h^2 / (2 tau^2)). The overlapping estimates at all cluster times are made of the same
samples. So the fit is one of generalised least squares, linear in the squares of the coefficients,
which are kept from being negative. Its weights are the covariance of the estimates (``moments``)
that the fitted noise has; the fit is repeated until they no longer change.

Why not maximum likelihood on the samples: for N and K it is a local-level Kalman filter, but
flicker and a rounded angle have no such short filter. The Allan variances are some twenty numbers
however long the log is, and can be looked at beside the fit.

A term is needed where two things hold: noise of the other terms would look as if it had as much of
it with a probability of at most one in a thousand, by the first moments of the Allan variances; and
no other term may be in its place. Of 1500 simulated logs of a thousand samples of white noise one
had a false term. Of as many of 64 and of 256 samples, whose estimates have heavier tails, nine in a
thousand had a false quantization and four in a thousand a false flicker. Terms that are not needed
are left out one after the other, the least needed first.

A term that is needed has an interval: its square counts as a chi-square with the degrees of freedom
that its variance has, 2 (square)^2 / variance. A term that is not needed has an upper bound: the
value with which its estimate would come out as low as it did in one log of twenty (for a level of
95 %). What is not needed may be there all the same, and have its share of a term that is: flicker
and a random walk of a short log look alike. So the interval of a term is extended to that of the
fits with each of the terms not needed, on the side to which they move the estimate.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from pyimu.characterization.allan.moments import MARKOV, RAMP, TERMS, design, moments
from pyimu.characterization.estimate import Estimate
from pyimu.characterization.noise.least_squares import Problem, has_noise
from pyimu.errors import UserError
from pyimu.numerics.laws import chi2, norm


@dataclass(frozen=True)
class Coefficient(Estimate):
    """One coefficient in SI units: estimate, standard error and interval, or an upper bound.

    A coefficient that is not needed, or whose part another term may have as well, has the value
    zero, no standard error (nan), and the interval from zero to its bound.
    """

    @property
    def needed(self) -> bool:
        """Whether it has a value, and not only a bound."""
        return self.value > 0


@dataclass(frozen=True)
class NoiseFit:
    """The ``coefficients`` that were asked for, by their letters, and how the fit went.

    ``estimates`` are the values of the terms that make up the fitted curve, including those that
    others might replace and that only have a bound for this reason; ``covariance`` (k, k) is
    theirs, in their order. ``misfit`` is the weighted sum of squared residuals of the fit; its mean
    is ``freedom`` where the noise has the terms asked for and no other. ``sample_period`` is in s,
    and so are the correlation ``times`` (g,) of Gauss-Markov noise, whose coefficients are its
    standard deviations.
    """

    coefficients: Mapping[str, Coefficient]
    estimates: Mapping[str, float]
    covariance: np.ndarray
    misfit: float
    freedom: int
    sample_period: float
    times: tuple[float, ...]

    def __getitem__(self, term: str) -> Coefficient:
        return self.coefficients[term]

    @property
    def needed(self) -> str:
        """Letters of the coefficients that are needed."""
        return "".join(t for t, c in self.coefficients.items() if c.needed)

    @property
    def replaceable(self) -> str:
        """Letters of the terms of the curve that others might replace."""
        return "".join(t for t in self.estimates if not self[t].needed)

    @property
    def letters(self) -> str:
        """Letters of the terms that the fit may have."""
        return TERMS + MARKOV[: len(self.times)]

    @property
    def squares(self) -> np.ndarray:
        """Squares (k,) of the estimates for a sample period of one."""
        estimates = np.array([self.estimates.get(t, 0.0) for t in self.letters])
        return estimates**2 / si_factors(self.sample_period, len(self.times))

    @property
    def times_in_samples(self) -> tuple[float, ...]:
        """The correlation times in sample periods."""
        return tuple(time / self.sample_period for time in self.times)

    def variance(self, tau: np.ndarray) -> np.ndarray:
        """Allan variance (n,) of the fitted noise at cluster times (n,) s."""
        return self._design(tau) @ self.squares

    def deviation(self, tau: np.ndarray) -> np.ndarray:
        """Allan deviation (n,) of the fitted noise at cluster times (n,) s."""
        return np.sqrt(self.variance(tau))

    def term_variances(self, tau: np.ndarray) -> np.ndarray:
        """Allan variances (n, k) of each of ``letters`` by itself at cluster times (n,) s."""
        return self._design(tau) * self.squares

    def _design(self, tau: np.ndarray) -> np.ndarray:
        return design(np.asarray(tau, dtype=float) / self.sample_period, self.times_in_samples)


def fit_coefficients(
    clusters: np.ndarray,
    deviation: np.ndarray,
    n: int,
    h: float,
    terms: str = TERMS,
    level: float = 0.95,
) -> NoiseFit:
    """Coefficients from overlapping Allan deviations (t,) at cluster sizes (t,) in samples.

    The record has ``n`` rates every ``h`` s. ``terms`` are the letters of those that may be needed;
    the noise is taken to have no other. ``level`` is the probability of the intervals. Sizes an
    octave apart (``octave_clusters``) hold nearly all the information; much nearer neighbours add
    hardly any, and make the weights singular.

    Raises ValueError for an unknown term, sizes that do not fit the record, and more terms than
    sizes; UserError where the record has no noise.
    """
    m, measured = np.atleast_1d(clusters), np.atleast_1d(np.asarray(deviation, dtype=float)) ** 2
    chosen = [TERMS.index(t) for t in TERMS if t in terms]
    if len(chosen) != len(terms) or not chosen:
        raise ValueError(f"terms are some of {TERMS}, each once, not {terms!r}")
    if m.shape != measured.shape or len(m) <= len(chosen):
        raise ValueError(
            f"{len(chosen)} terms need more than as many cluster sizes, and a deviation for each: "
            f"{m.shape} and {measured.shape}"
        )
    if not np.all(measured > 0):
        raise UserError(
            f"the Allan deviation of clusters of {m[np.argmin(measured)]} samples is zero: a "
            "record without noise has no coefficients"
        )
    # In units of the deviations, because the squares of small rates are tiny.
    unit = np.exp(np.mean(np.log(measured)))
    return solve(Problem(moments(m, n), measured / unit), chosen, unit * si_factors(h), h, level)


LOST = 5.0
"""A square whose standard error is so many times itself counts as none. The estimate of a single
noise from one degree of freedom has 1.4 times."""


def si_factors(h: float, markov: int = 0) -> np.ndarray:
    """Factors (k,) of the squares of coefficients from a sample period of one to one of h s.

    So many of ``markov``, which are standard deviations, stand behind those of ``TERMS``.
    """
    return float(h) ** np.array([2, 1, 0, -1, -2, *[0] * markov])


def solve(
    problem: Problem,
    chosen: list[int],
    si: np.ndarray,
    h: float,
    level: float,
    kept: list[int] | None = None,
    times: tuple[float, ...] = (),
) -> NoiseFit:
    """The fit of a problem with the ``chosen`` terms, given as indices of ``TERMS`` + ``MARKOV``.

    ``si`` (k,) converts squares in the units of the problem to those of coefficients in SI.
    ``kept`` are the terms that are needed, None to find out; ``times`` [s] those of the
    Gauss-Markov terms. Raises UserError where the record has no noise.
    """
    kept = problem.needed(chosen) if kept is None else kept
    squares = problem.fit(kept)
    # One beside which another explains all has no interval of its own, but a bound.
    kept = [i for i in kept if squares[i] > 0] or kept
    covariance = (
        problem.covariance(kept, squares)
        if has_noise(squares)
        else np.full((len(kept), len(kept)), np.inf)
    )
    stds = dict(zip(kept, np.sqrt(np.diag(covariance)), strict=True))
    if all(stds[i] > LOST * squares[i] for i in kept if i != RAMP):
        raise UserError("there is no noise of the five kinds in it, only lines or a ramp")
    found = {}
    for i in chosen:
        interval = (
            _extended_interval(problem, i, kept, chosen, level)
            if i in kept
            else (0.0, problem.bound(i, kept, squares, level))
        )
        found[(TERMS + MARKOV)[i]] = _coefficient(squares[i], stds.get(i), interval, np.sqrt(si[i]))
    estimates = {(TERMS + MARKOV)[i]: float(np.sqrt(squares[i] * si[i])) for i in kept}
    slope = np.sqrt(si[kept] / squares[kept]) / 2
    freedom = len(problem.measured) - len(kept) - problem.nuisance.shape[1]
    covariance, misfit = covariance * np.outer(slope, slope), problem.misfit(squares)
    return NoiseFit(found, estimates, covariance, misfit, freedom, h, times)


def _coefficient(
    square: float, std: float | None, interval: tuple[float, float], factor: float
) -> Coefficient:
    """The coefficient of a square, its standard error (None if not kept) and its interval.

    ``factor`` converts the coefficient to SI.
    """
    needed = std is not None and interval[0] > 0
    value, error = (np.sqrt(square), std / (2 * np.sqrt(square))) if needed else (0.0, np.nan)
    return Coefficient(*(float(v) for v in np.array([value, error, *np.sqrt(interval)]) * factor))


def _extended_interval(
    problem: Problem, i: int, kept: Sequence[int], chosen: Sequence[int], level: float
) -> tuple[float, float]:
    """Interval of the square of term ``i``, extended for the terms that are not needed.

    ``i`` is one of the terms ``kept``. The interval reaches as far as that of the fit with any one
    more of those ``chosen``, on the side to which this one moves the estimate.
    """
    estimate, std = _marginal(problem, i, kept)
    low, high = _interval(estimate, std, level)
    for j in (j for j in chosen if j not in kept):
        with_j = [*kept, j]
        if problem.fit(with_j)[j] > 0:
            # Two terms that look alike share what is there: the estimate is then a difference,
            # which is normal, and not a sum of squares.
            other, std = _marginal(problem, i, with_j)
            half = std * norm.isf((1 - level) / 2)
            low, high = (
                (max(min(low, other - half), 0.0), high)
                if other < estimate
                else (low, max(high, other + half))
            )
    return low, high


def _marginal(problem: Problem, i: int, terms: Sequence[int]) -> tuple[float, float]:
    """Square of term ``i`` in a fit of ``terms``, and its standard error."""
    squares = problem.fit(terms)
    if squares[i] == 0:
        return 0.0, 0.0
    there = [k for k in terms if squares[k] > 0]
    return float(squares[i]), float(
        np.sqrt(problem.covariance(there, squares)[there.index(i), there.index(i)])
    )


def _interval(square: float, std: float, level: float) -> tuple[float, float]:
    """Interval of a square that counts as a chi-square.

    Its degrees of freedom are those that give the standard error ``std``.
    """
    freedom = 2 * (square / std) ** 2
    side = (1 - level) / 2
    # Where there is hardly any degree of freedom the upper limit is infinite.
    with np.errstate(divide="ignore"):
        return square * freedom / chi2.isf(side, freedom), float(
            square * freedom / np.float64(chi2.ppf(side, freedom))
        )


REACH = 0.1
"""Share of an interval's half from which on a limit counts as extended beyond what the standard
error alone makes of it."""


def mean_coefficient(
    tests: Sequence[Coefficient], level: float = 0.95
) -> tuple[Coefficient, float]:
    """Mean of one coefficient over independent logs of a part, and the logs' standard deviation.

    The standard deviation, nan for a single log, checks the standard errors: where the logs scatter
    more than these allow, standard error and interval of the mean are those of the scatter
    (Student's law). What an interval was extended by, because another term may be there, is the
    same in all logs, and the mean does not reduce it. Where a log does not need the coefficient
    there is no mean, and the bound is the largest that any log gives.
    """
    if len(tests) == 1:
        return tests[0], np.nan
    if not all(c.needed for c in tests):
        return Coefficient(0.0, np.nan, 0.0, max(c.high for c in tests)), np.nan
    values = np.array([c.value for c in tests])
    std = float(np.sqrt(np.sum([c.std**2 for c in tests]))) / len(tests)
    # In squares, as for one log: the mean has the degrees of freedom of all logs together.
    low, high = _unextended(values.mean(), std, level)
    spread = float(values.std(ddof=1))
    half = -stdtrit(len(tests) - 1, (1 - level) / 2) * spread / np.sqrt(len(tests))
    low, high = min(low, float(values.mean() - half)), max(high, float(values.mean() + half))
    std = max(std, float(spread / np.sqrt(len(tests))))
    below, above = np.mean([_extension(c, level) for c in tests], axis=0)
    return Coefficient(
        float(values.mean()), std, float(max(low - below, 0.0)), float(high + above)
    ), spread


def _unextended(value: float, std: float, level: float) -> tuple[float, float]:
    """The interval of a coefficient that its standard error alone makes."""
    low, high = np.sqrt(_interval(value**2, 2 * value * std, level))
    return float(low), float(high)


def _extension(c: Coefficient, level: float) -> tuple[float, float]:
    """How far a coefficient's interval goes below and above the unextended one."""
    low, high = _unextended(c.value, c.std, level)
    below, above = low - c.low, c.high - high
    return (below if below > REACH * (c.value - low) else 0.0), (
        above if above > REACH * (high - c.value) else 0.0
    )
