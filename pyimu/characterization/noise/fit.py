r"""The five coefficients of a real sensor, which has more in its noise than the five terms.

With millions of samples, what a real log has and the sum of five terms lacks would spoil every
coefficient. So the fit allows for it:

* A **band limit**. A low-pass in the sensor gives white noise a memory of a few samples. The sum
  of the rates then has, for all lags beyond that memory, the covariance of white noise plus a
  constant, which in the Allan variance is a term like quantization's, -3 c / tau^2, with the other
  sign. Where the data require it, a term of 1 / tau^2 of any sign is left free. Quantization cannot
  be told from it, and is then not looked for.

* **Lines**. A sine of amplitude A and frequency f adds A^2 sin^4(pi f tau) / (m sin(pi f h))^2.
  The amplitudes of the lines found in the spectrum are left free, too; the fourth power of the sine
  is averaged over the spread of the frequency.

* **Vibration** of no clear frequency. It shapes the clusters that are about as long as its period,
  and leaves the same 1 / tau^2 beyond. So where terms and lines do not describe all clusters, the
  shortest are left out of the fit, as many as necessary.

* **Anything else**. Where a misfit remains, each Allan variance is granted an independent relative
  error of the five terms, as large as the misfit requires: the mean of the weighted sum of squares
  is then its degrees of freedom. Intervals widen by that, and it is reported.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyimu.characterization.allan.moments import TERMS
from pyimu.characterization.noise.candidates import choose
from pyimu.characterization.noise.coefficients import Coefficient, NoiseFit, si_factors, solve
from pyimu.characterization.noise.least_squares import Problem
from pyimu.characterization.noise.sines import Groups, Sine, free_variances, relevant
from pyimu.errors import UserError


@dataclass(frozen=True)
class ChannelFit(NoiseFit):
    """The fit of a channel's noise, and what it had to allow for besides the five terms.

    ``free`` (k,) are the strengths of the groups of ``lines`` and, last, of the free term 1 / m^2,
    if there is one. ``shortest`` [s] is the first cluster time that was fitted; ``model_error`` is
    the relative error of an Allan variance that the five terms had to be granted.
    """

    free: np.ndarray
    lines: Groups
    shortest: float
    model_error: float

    @property
    def filtered(self) -> bool:
        """Whether a free term 1 / m^2 was needed, as for a filter in the sensor."""
        return len(self.free) > len(self.lines)

    @property
    def line_frequencies(self) -> tuple[float, ...]:
        """Frequencies [Hz] of the lines that were allowed for, rising."""
        return tuple(sorted(v.frequency / self.sample_period for g in self.lines for v in g))

    def variance(self, tau: np.ndarray) -> np.ndarray:
        """Allan variance (n,) of the fitted noise at cluster times ``tau`` (n,) s.

        What was left free is included. It is nan before ``shortest``.
        """
        tau = np.asarray(tau, dtype=float)
        whole = super().variance(tau)
        if len(self.free):
            columns = free_variances(tau / self.sample_period, self.lines, self.filtered)
            whole = whole + columns @ self.free
        return np.where((tau > self.shortest * (1 - 1e-9)) & (whole > 0), whole, np.nan)

    def psd_two_sided(self, f: np.ndarray) -> np.ndarray:
        """Two-sided density (m,) of the samples, unit^2/Hz, at ``f`` (m,) > 0 in Hz.

        It is that of Q, N, B and K (Hidalgo 2012, table 3), without the ramp and what was left
        free.
        """
        f, h = np.asarray(f, dtype=float), self.sample_period
        Q, N, B, K = (self.estimates.get(t, 0.0) for t in "QNBK")
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
    """Coefficients from the pooled overlapping Allan deviations (t,) of a channel.

    ``clusters`` (t,) are sizes an octave apart, the segments have ``lengths`` samples every ``h``
    s, ``level`` is the probability of the intervals. ``lines`` are sines in the record: frequency
    and its spread [Hz], amplitude. Raises UserError where a deviation is zero, ValueError for fewer
    than six clusters.
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
    sines = [Sine(f * h, spread * h, a**2 / unit) for f, spread, a in lines]
    groups = relevant(m, measured / unit, sines)
    found = choose(m, measured / unit, lengths, groups)
    fit = solve(found.problem, found.terms, unit * si_factors(h), h, level)
    if "Q" not in fit.coefficients:
        # The other terms only add to the variance that quantization alone would make.
        bound = float(np.min(np.sqrt(measured / 3) * m * h))
        quantization = {"Q": Coefficient(0.0, np.nan, 0.0, bound)}
        fit = replace(fit, coefficients=quantization | dict(fit.coefficients))
    return ChannelFit(
        **vars(fit),
        free=unit * _strengths(found.problem, fit, unit),
        lines=found.lines,
        shortest=float(found.problem.moments.m[0] * h),
        model_error=found.problem.moments.error,
    )


def _strengths(problem: Problem, fit: NoiseFit, unit: float) -> np.ndarray:
    """The best estimates (k,) of the strengths of what was left free, given the coefficients."""
    squares = fit.squares / unit
    root = np.linalg.cholesky(problem.moments.covariance(squares))
    left = np.linalg.solve(
        root,
        np.column_stack([problem.nuisance, problem.measured - problem.moments.design @ squares]),
    )
    return np.linalg.lstsq(left[:, :-1], left[:, -1], rcond=None)[0]
