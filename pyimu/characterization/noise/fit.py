r"""The five coefficients of a real sensor, which has more in its noise than the five terms.

With millions of samples, what a real log has and the sum of five terms lacks would spoil every
coefficient. So the fit allows for it:

* A **band limit**. A low-pass in the sensor gives white noise a memory of a few samples. The sum
  of the rates then has, for all lags beyond that memory, the covariance of white noise plus a
  constant, which in the Allan variance is a term like quantization's, -3 c / tau^2, with the other
  sign. Where the data require it, a term of 1 / tau^2 of any sign is left free. Quantization cannot
  be told from it, and is then not looked for. Where the spectrum shows the low-pass, clusters
  within its memory are left out from the start: what the Allan variances cannot contradict there
  would still move N.

* **Lines**. A sine of amplitude A and frequency f adds A^2 sin^4(pi f tau) / (m sin(pi f h))^2.
  The amplitudes of the lines found in the spectrum are left free, too; the fourth power of the sine
  is averaged over the spread of the frequency.

* **Vibration** of no clear frequency. It shapes the clusters that are about as long as its period,
  and leaves the same 1 / tau^2 beyond. So where terms and lines do not describe all clusters, the
  shortest are left out of the fit, as many as necessary.

* **A drift that stops growing**, such as that of an accelerometer that follows the temperature of a
  room: Gauss-Markov noise of one or two correlation times, where the likelihood of the variances
  asks for it (``ranking``, which also decides between flicker and a random walk).

* **Anything else**. Where a misfit remains, each Allan variance is granted an independent relative
  error of the five terms, as large as the misfit requires: the mean of the weighted sum of squares
  is then its degrees of freedom. Intervals widen by that, and it is reported.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyimu.characterization.allan.moments import MARKOV, TERMS
from pyimu.characterization.noise.candidates import choose
from pyimu.characterization.noise.coefficients import Coefficient, NoiseFit, si_factors, solve
from pyimu.characterization.noise.ranking import Model, rank
from pyimu.characterization.noise.sines import Groups, Sine, free_variances, relevant
from pyimu.errors import UserError


@dataclass(frozen=True)
class GaussMarkov:
    """Gauss-Markov noise of a channel: its standard deviation ``sigma`` in the unit of the samples.

    ``time`` [s] is its correlation time, ``spread`` the standard error of that time's logarithm
    (nan where the data do not tell); the interval of ``sigma`` is for this time.
    """

    sigma: Coefficient
    time: float
    spread: float

    @property
    def drive(self) -> float:
        """Root q of the two-sided density of the noise that drives it, unit/sqrt(s)."""
        return self.sigma.value * np.sqrt(2 / self.time)


@dataclass(frozen=True)
class ChannelFit(NoiseFit):
    """The fit of a channel's noise, and what it had to allow for besides the five terms.

    ``free`` (k,) are the strengths of the groups of ``lines`` and, last, of the free term 1 / m^2,
    if there is one. ``shortest`` [s] is the first cluster time that was fitted; ``model_error`` is
    the relative error of an Allan variance that the terms had to be granted. ``models`` are those
    that were compared, the one taken first; ``spread`` (g,) is the standard error of the logarithm
    of each correlation time.
    """

    free: np.ndarray
    lines: Groups
    shortest: float
    model_error: float
    models: tuple[Model, ...]
    spread: tuple[float, ...]

    @property
    def markov(self) -> tuple[GaussMarkov, ...]:
        """The Gauss-Markov noise, slowest first."""
        found = (
            GaussMarkov(self[letter], time, spread)
            for letter, time, spread in zip(MARKOV, self.times, self.spread, strict=False)
        )
        return tuple(sorted(found, key=lambda g: -g.time))

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

        It is that of Q, N, B and K (Hidalgo 2012, table 3) and of Gauss-Markov noise, without the
        ramp and what was left free.
        """
        f, h = np.asarray(f, dtype=float), self.sample_period
        Q, N, B, K = (self.estimates.get(t, 0.0) for t in "QNBK")
        slope = 2 * np.sin(np.pi * np.minimum(f * h, 0.5)) / h
        density = N**2 + B**2 / (2 * np.pi * f) + (K / slope) ** 2 + (Q * slope) ** 2 * h
        for letter, time in zip(MARKOV, self.times, strict=False):
            # 1 - 2 a cos x + a^2 is (1 - a)^2 + a (2 sin(x / 2))^2, which does not cancel.
            a, lost = np.exp(-h / time), -np.expm1(-h / time)
            variance = self.estimates.get(letter, 0.0) ** 2
            density = density + variance * h * lost * (1 + a) / (lost**2 + a * (slope * h) ** 2)
        return density


def fit_noise(
    clusters: np.ndarray,
    deviation: np.ndarray,
    lengths: Sequence[int],
    h: float,
    level: float = 0.95,
    lines: Sequence[tuple[float, float, float]] = (),
    memory: float = 0.0,
) -> ChannelFit:
    """Coefficients from the pooled overlapping Allan deviations (t,) of a channel.

    ``clusters`` (t,) are sizes an octave apart, the segments have ``lengths`` samples every ``h``
    s, ``level`` is the probability of the intervals. ``lines`` are sines in the record: frequency
    and its spread [Hz], amplitude. ``memory`` [s] is that of the low-pass which the spectrum shows:
    the fit then has the free term, and no shorter clusters. Raises UserError where a deviation is
    zero, ValueError for fewer than six clusters.
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
    found = choose(m, measured / unit, lengths, groups, memory / h)
    best = rank(found.problem, found.problem.needed(found.terms), lengths)
    times = tuple(float(time) * h for time in best.times)
    si = unit * si_factors(h, len(times))
    chosen = sorted({*found.terms, *best.kept})
    fit = solve(best.problem, chosen, si, h, level, best.kept, times)
    if "Q" not in fit.coefficients:
        # The other terms only add to the variance that quantization alone would make.
        bound = float(np.min(np.sqrt(measured / 3) * m * h))
        quantization = {"Q": Coefficient(0.0, np.nan, 0.0, bound)}
        fit = replace(fit, coefficients=quantization | dict(fit.coefficients))
    return ChannelFit(
        **vars(fit),
        free=unit * best.problem.strengths(fit.squares / unit),
        lines=found.lines,
        shortest=float(found.problem.moments.m[0] * h),
        model_error=best.problem.moments.error,
        models=best.models,
        spread=best.spread,
    )
