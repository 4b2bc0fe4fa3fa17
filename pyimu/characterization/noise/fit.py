r"""The five coefficients of a real sensor, whose short clusters the five terms do not describe
exactly.

What a real log has and the sum of five terms lacks would else, with millions of samples, spoil
every coefficient:

* A **band limit**. A low-pass in the sensor gives white noise a memory of a few samples. The sum
  of the rates then has, for all lags beyond that memory, the covariance of white noise plus a
  constant, which in the Allan variance is a term like quantization's, -3 c / tau^2, with the other
  sign. Where the data ask for it a term of 1 / tau^2 of any sign is left free, and quantization,
  which it cannot be told from, is not looked for.

* **Lines**. A sine of amplitude A and frequency f adds A^2 sin^4(pi f tau) / (m sin(pi f h))^2.
  Of lines that the spectrum shows the amplitude is left free, too; over the spread of the frequency
  the fourth power of the sine is averaged.

* **Vibration** of no clear frequency. It shapes the clusters that are about as long as its period,
  and leaves the same 1 / tau^2 beyond. So where terms and lines do not describe all clusters, the
  shortest are left out of the fit, as many as it takes.

* **Anything else**. Where there is misfit still, the five terms are taken to describe each Allan
  variance but for an independent relative error, and this error is made as large as the misfit
  asks: the mean of the weighted sum of squares then is its degrees of freedom. Intervals widen by
  that, and it is reported.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq
from scipy.stats import chi2

from pyimu.characterization.allan.moments import TERMS, AllanMoments
from pyimu.characterization.allan.pooled import equivalent_freedom, pooled_moments
from pyimu.characterization.noise.coefficients import Coefficient, NoiseFit, si_factors, solve
from pyimu.characterization.noise.least_squares import Problem
from pyimu.errors import UserError

CHANCE = 0.01
"""A misfit that chance makes more rarely than this is one of the model."""

LEAST = 8
"""Cluster sizes, an octave apart, that are always left in the fit."""

LINES = 4
"""Amplitudes of lines that are left free: of those that matter most, and a common one, on top of
what is said of them, of all others."""

WIDEST = 2.0
"""Relative error of the five terms beyond which nothing is gained by making it larger."""

SLIGHT = 1e-4
"""A line that makes no more than this share of any Allan variance is left in it."""

NEARLY = 1.25
"""How much larger than the least a relative error may be, so that more clusters are used."""


Line = tuple[float, float, float]
Groups = tuple[tuple[Line, ...], ...]


@dataclass(frozen=True)
class LooseMoments(AllanMoments):
    """Moments under a model with an independent relative ``error`` of each Allan variance, and
    absolute ones ``ends`` (t,).
    """

    error: float = 0.0
    ends: float | np.ndarray = 0.0

    def covariance(self, squares: np.ndarray) -> np.ndarray:
        return super().covariance(squares) + np.diag(
            (self.error * (self.design @ squares)) ** 2 + np.square(self.ends)
        )


@dataclass(frozen=True)
class ChannelFit:
    """A ``NoiseFit`` and in which way it is one.

    ``free`` (k,) are the strengths of the groups of ``lines`` (frequency and its spread in cycles a
    sample, square of the amplitude) and, last, of the free term 1 / m^2, if there is one.
    ``shortest`` [s] is the first cluster time that was fitted; ``model_error`` the relative error
    of an Allan variance that the five terms had to be granted.
    """

    fit: NoiseFit
    free: np.ndarray
    lines: Groups
    shortest: float
    model_error: float

    def __getitem__(self, term: str) -> Coefficient:
        return self.fit[term]

    def variance(self, tau: np.ndarray) -> np.ndarray:
        """Allan variance (n,) of the fitted noise, what was left free included, at cluster times
        ``tau`` (n,) s; nan before ``shortest``.
        """
        tau = np.asarray(tau, dtype=float)
        whole = self.fit.deviation(tau) ** 2
        if len(self.free):
            whole = (
                whole
                + _columns(
                    tau / self.fit.sample_period, self.lines, len(self.free) > len(self.lines)
                )
                @ self.free
            )
        return np.where((tau > self.shortest * (1 - 1e-9)) & (whole > 0), whole, np.nan)

    @property
    def squares(self) -> np.ndarray:
        """Squares (5,) of the fitted terms for a sample period of one."""
        return self.fit.squares

    def freedom(self, m: np.ndarray, lengths: Sequence[int]) -> np.ndarray:
        """Equivalent degrees of freedom (t,) of the Allan variances of such noise at cluster sizes
        ``m``.
        """
        return equivalent_freedom(m, lengths, self.squares)

    def psd_two_sided(self, f: np.ndarray) -> np.ndarray:
        """Two-sided density of the samples at ``f`` > 0 in Hz, unit^2/Hz: Q, N, B and K (Hidalgo
        2012, table 3); no ramp, no free term.
        """
        f, h = np.asarray(f, dtype=float), self.fit.sample_period
        Q, N, B, K = (self.fit.estimates.get(t, 0.0) for t in "QNBK")
        slope = 2 * np.sin(np.pi * np.minimum(f * h, 0.5)) / h
        return N**2 + B**2 / (2 * np.pi * f) + (K / slope) ** 2 + (Q * slope) ** 2 * h


def fit_noise(
    clusters: np.ndarray,
    deviation: np.ndarray,
    lengths: Sequence[int],
    h: float,
    level: float = 0.95,
    lines: Sequence[tuple[float, float, float]] = (),
) -> ChannelFit:
    """Coefficients from pooled overlapping deviations (t,) at octaves ``clusters`` (t,) of
    stretches of ``lengths`` samples every ``h`` s.

    ``lines`` are sines in the record: frequency and its spread [Hz], amplitude. Raises UserError
    where a deviation is zero, ValueError for fewer than six clusters.
    """
    m, measured = np.asarray(clusters), np.asarray(deviation, dtype=float) ** 2
    if not np.all(measured > 0):
        raise UserError(
            f"the Allan deviation of clusters of {m[np.argmin(measured)]} samples is zero: there "
            "is no noise to characterise"
        )
    if len(m) <= len(TERMS):
        raise ValueError(f"{len(TERMS)} terms need more than {len(m)} cluster sizes")
    unit = np.exp(np.mean(np.log(measured)))
    found = _chosen(
        m,
        measured / unit,
        lengths,
        _relevant(m, measured / unit, [(f * h, spread * h, a**2 / unit) for f, spread, a in lines]),
    )
    fit = solve(found.problem, found.terms, unit * si_factors(h), h, level)
    if "Q" not in fit.coefficients:
        # No term makes the variance less than quantization alone.
        bound = float(np.min(np.sqrt(measured / 3) * m * h))
        fit = replace(
            fit, coefficients={"Q": Coefficient(0.0, np.nan, 0.0, bound), **fit.coefficients}
        )
    return ChannelFit(
        fit,
        unit * _strengths(found.problem, fit, unit),
        found.lines,
        float(found.problem.moments.m[0] * h),
        found.problem.moments.error,
    )


def _relevant(m: np.ndarray, measured: np.ndarray, lines: Sequence[Line]) -> Groups:
    """Groups of lines (frequency and spread in cycles a sample, square of the amplitude), by their
    share of any Allan variance.
    """
    share = np.array([np.max(_line(m, v) / measured) for v in lines])
    order = [lines[i] for i in np.argsort(-share) if share[i] > SLIGHT]
    single = LINES if len(order) <= LINES else LINES - 1
    return tuple((v,) for v in order[:single]) + (
        (tuple(order[single:]),) if order[single:] else ()
    )


def _line(m: np.ndarray, line: Line) -> np.ndarray:
    """Allan variance (t,) of a line at cluster sizes (t,)."""
    f, spread, square = line
    x, s = np.pi * f * m, np.pi * spread * m
    fourth = 3 / 8 - np.cos(2 * x) * np.exp(-2 * s**2) / 2 + np.cos(4 * x) * np.exp(-8 * s**2) / 8
    return square * fourth / (m * np.sin(np.pi * f)) ** 2


def _columns(m: np.ndarray, lines: Groups, free: bool) -> np.ndarray:
    """Allan variances (t, k) at cluster sizes ``m`` (t,) of each group of lines, and of the free
    term.
    """
    m = np.asarray(m, dtype=float)
    columns = [sum(_line(m, v) for v in group) for group in lines]
    return np.column_stack([*columns, *([1 / m**2] if free else []), np.empty((len(m), 0))])


@dataclass(frozen=True)
class _Candidate:
    """A fit to try: the clusters, the terms, and what is left free."""

    problem: Problem
    lines: Groups
    free: bool

    @property
    def terms(self) -> list[int]:
        """Indices of the terms to look for: a free term takes the place of quantization."""
        return list(range(1 if self.free else 0, len(TERMS)))

    @property
    def misfit(self) -> float:
        return self.problem.misfit(self.problem.fit(self.terms))

    @property
    def freedom(self) -> int:
        return len(self.problem.measured) - len(self.terms) - self.problem.nuisance.shape[1]

    def granted(self, error: float) -> _Candidate:
        """The same with a relative error of the five terms."""
        return replace(
            self, problem=replace(self.problem, moments=replace(self.problem.moments, error=error))
        )


def _chosen(
    m: np.ndarray, measured: np.ndarray, lengths: Sequence[int], lines: Groups
) -> _Candidate:
    """The first of the candidates that describes its clusters; if none does, one with about the
    least error, and granted it.
    """
    p = pooled_moments(tuple(int(k) for k in m), tuple(int(n) for n in lengths))
    base = LooseMoments(p.m, p.design, p.products, p.sums, ends=_ends(m, lines, max(lengths)))
    candidates = []
    for candidate in _candidates(base, measured, lines):
        if candidate.misfit < chi2.isf(CHANCE, max(candidate.freedom, 1)):
            return candidate
        candidates.append(candidate)
    loose = [_with_error(c) for c in candidates]
    least = min(c.problem.moments.error for c in loose)
    return next(c for c in loose if c.problem.moments.error <= NEARLY * least)


def _ends(m: np.ndarray, lines: Groups, n: int) -> np.ndarray:
    """Errors (t,) of the lines' Allan variances: their record is no whole number of half periods.

    The mean of the square of a sine of frequency w over k terms is a half to 1 / (2 k sin w),
    whatever its phase.
    """
    count, error = np.maximum(n - 2 * m + 1, 1), np.zeros(len(m))
    for f, spread, square in (v for group in lines for v in group):
        error += _line(m, (f, spread, square)) * np.minimum(
            1 / (count * abs(np.sin(2 * np.pi * f)) + 1e-9), 1.0
        )
    return error


def _candidates(base: LooseMoments, measured: np.ndarray, lines: Groups) -> Iterator[_Candidate]:
    """The five terms and the lines; then with the free term; then without the shortest clusters,
    one after the other.
    """
    yield _candidate(base, measured, lines, False, 0)
    for first in range(max(len(measured) - LEAST, 0) + 1):
        yield _candidate(base, measured, lines, True, first)


def _candidate(
    p: LooseMoments, measured: np.ndarray, lines: Groups, free: bool, first: int
) -> _Candidate:
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
    return _Candidate(Problem(cut, measured[rest], _columns(cut.m, kept, free)), kept, free)


def _with_error(candidate: _Candidate) -> _Candidate:
    """The candidate with the relative error of the five terms that its misfit asks for."""

    def excess(logarithm: float) -> float:
        return candidate.granted(float(np.exp(logarithm))).misfit - max(candidate.freedom, 1)

    low, high = np.log(1e-4), np.log(WIDEST)
    if excess(high) >= 0:
        return candidate.granted(WIDEST)
    return candidate.granted(
        float(np.exp(low if excess(low) <= 0 else brentq(excess, low, high, xtol=0.02)))
    )


def _strengths(problem: Problem, fit: NoiseFit, unit: float) -> np.ndarray:
    """The best estimates (k,) of what was left free, given the coefficients."""
    squares = fit.squares / unit
    root = np.linalg.cholesky(problem.moments.covariance(squares))
    left = np.linalg.solve(
        root,
        np.column_stack([problem.nuisance, problem.measured - problem.moments.design @ squares]),
    )
    return np.linalg.lstsq(left[:, :-1], left[:, -1], rcond=None)[0]
