"""What the noise of a gyro makes of a heading that nothing corrects, after a rest.

With white noise N and a bias that walks with K, d(heading)/dt = b + N w1, db/dt = K w2. At rest the
rate is known to be nought, and of a bias that was unknown before the variance after R s is, by
Riccati's equation dP/dt = K^2 - P^2/N^2,

    P(R) = N K coth(K R / N)

(Kalman and Bucy 1961, example 1), which soon is N K. From there, T s later,

    var(heading) = N^2 T + P(R) T^2 + K^2 T^3 / 3

(the integrals of the shaping filters of Hidalgo 2012, section 3.2; its Q_k has the first and the
last for one sample). What the rest leaves of the heading itself is set right with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

DRAWS = 4000
"""Drives that are drawn; the standard error of a share of one half is 0.8 %."""

STEP = 1.0
"""s between the instants at which a drawn heading is looked at."""


@dataclass(frozen=True)
class HeadingNoise:
    """The heading's error over ``duration`` s after ``rest`` s at rest, by N and K alone.

    ``N`` in rad/sqrt(s) and ``K`` in rad/s/sqrt(s) are those of the gyro about the vertical.
    """

    N: float
    K: float
    rest: float
    duration: float

    @property
    def bias_variance(self) -> float:
        """(rad/s)^2 at the start of the drive; infinite without a rest."""
        if not self.rest:
            return np.inf
        if self.K * self.rest < 1e-6 * self.N:
            return self.N**2 / self.rest
        return self.N * self.K / np.tanh(self.K * self.rest / self.N)

    def std(self, time: np.ndarray) -> np.ndarray:
        """Standard deviation in rad after ``time`` s of the drive."""
        t = np.asarray(time, dtype=float)
        return np.sqrt(self.N**2 * t + self.bias_variance * t**2 + self.K**2 * t**3 / 3)

    @cached_property
    def time(self) -> np.ndarray:
        """Instants (m,) in s at which ``draws`` are given."""
        return np.linspace(0.0, self.duration, max(2, round(self.duration / STEP) + 1))

    @cached_property
    def draws(self) -> np.ndarray:
        """Errors (DRAWS, m) in rad, exact at their instants: of a step the covariance of heading
        and bias is that of ``pyimu.symbolic.process_noise``, with a plus off its diagonal as the
        bias is added here.
        """
        rng, h = np.random.default_rng(2012), float(self.time[1])
        white, walk = rng.standard_normal((2, DRAWS, len(self.time) - 1))
        start = np.sqrt(self.bias_variance) * rng.standard_normal((DRAWS, 1))
        bias_step = self.K * np.sqrt(h) * walk
        bias = start + np.cumsum(bias_step, axis=1) - bias_step
        # Given the step of the bias, the heading has half of it, and K^2 h^3/12 around that.
        around = np.sqrt(self.N**2 * h + self.K**2 * h**3 / 12) * white
        heading = np.cumsum(h * (bias + bias_step / 2) + around, axis=1)
        return np.hstack([np.zeros((DRAWS, 1)), heading])

    def largest(self, more: np.ndarray | float = 0.0) -> np.ndarray:
        """Largest error (DRAWS,) in rad of each drive, with ``more`` (m,) in rad added to it."""
        return np.abs(self.draws + more).max(axis=1)

    def share_below(self, limit: float, more: np.ndarray | float = 0.0) -> float:
        """Share of the drives whose largest error stays within ``limit`` rad."""
        return float(np.mean(self.largest(more) <= limit))


def largest_walk(noise: HeadingNoise, limit: float) -> float:
    """K in rad/s/sqrt(s) with which half of the drives stay within ``limit`` rad, else 0.

    The draws are the same for every K, so that their share falls steadily with it.
    """

    def share(k: float) -> float:
        return HeadingNoise(noise.N, k, noise.rest, noise.duration).share_below(limit)

    low, high = 0.0, max(noise.K, 1e-12)
    if share(high) >= 0.5:
        return high
    if share(low) < 0.5:
        return 0.0
    for _ in range(12):
        middle = (low + high) / 2
        low, high = (middle, high) if share(middle) >= 0.5 else (low, middle)
    return low


def scale_factor_for(noise: HeadingNoise, turned: np.ndarray, limit: float) -> float:
    """Scale factor error with which the median of the largest error is ``limit`` rad.

    ``turned`` (m,) rad is the angle turned at the instants of ``noise``. Negative as that of the
    paper's rover, which turned less far by its gyros; by symmetry its size is the same.
    """
    low, high = 0.0, 2 * limit / float(np.abs(turned).max())
    for _ in range(20):
        middle = (low + high) / 2
        below = noise.share_below(limit, -middle * turned) >= 0.5
        low, high = (middle, high) if below else (low, middle)
    return -low
