"""Simulated drives for ``consistency.py``: the truth in closed form, the noise of the sensors, and
the initial error of the filter.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation

from pyimu.model.part import Part
from pyimu.model.sensor import Sensor

H, GRAVITY, LATITUDE = 0.01, 9.80665, 0.8
EARTH = 7.292115e-5 * np.array([0, np.cos(LATITUDE), np.sin(LATITUDE)])
N, K, N_ACCEL = 1e-3, 2e-5, 1e-2
STD0 = np.array([0.03, 0.03, 0.05, 0.003, 0.003, 0.003])
HEADING_STD = 0.02
CHUNK = 200_000
"""Samples that are made at a time."""

WHITE = {"accel_std": 0.0, "accel_correlation_time": 0.0, "rest_time": 0.0}
"""Settings under which a sample of specific force is gravity and white noise alone, and no rest is
looked for."""


@dataclass(frozen=True)
class Noise:
    """What sensors and motion add to the truth.

    ``n`` rad/sqrt(s) and ``k`` rad/s/sqrt(s) are the gyro's random walks. ``correlated`` is a
    Gauss-Markov process in the gyro, by its standard deviation in rad/s and its correlation time in
    s; ``force`` one in the body's acceleration, in m/s^2 and s. ``relative`` are the root densities
    in sqrt(s) of the relative error of the rate, of each axis by itself and over all axes. ``sway``
    is an oscillation of the body, by its acceleration in m/s^2 and velocity over acceleration in s.
    """

    n: float = N
    k: float = K
    correlated: tuple[float, float] = (0.0, 1.0)
    relative: tuple[float, float] = (0.0, 0.0)
    force: tuple[float, float] = (0.0, 1.0)
    sway: tuple[float, float] = (0.0, 1.0)


@dataclass(frozen=True)
class Scenario:
    """A motion with its noise, and the settings of the filter for it.

    A body that is ``moving`` turns in place after a ``rest`` of some s, else it rests level. There
    is a heading ``every`` so many s (0: none), which is ``late`` by some s. ``fixed`` are settings
    of the filter. ``bounded`` are the kinds whose errors may be smaller than the filter says, where
    its model is wider than the noise; of others the filter says nothing then.
    """

    name: str
    moving: bool = True
    rest: float = 0.0
    every: float = 0.0
    late: float = 0.0
    fixed: dict = field(default_factory=lambda: WHITE)
    noise: Noise = Noise()
    bounded: tuple[str, ...] = ()


def part(noise: Noise = Noise()) -> Part:
    """The part whose filter assumes that noise."""
    effects = {"angle_random_walk": {"N": noise.n}, "rate_random_walk": {"K": noise.k}}
    std, tau = noise.correlated
    if std:
        effects["gauss_markov"] = {"q": std * np.sqrt(2 / tau), "tau": tau}
    if noise.relative[0]:
        effects["rate_dependent_noise"] = {"k": noise.relative[0]}
    return Part(
        "matched",
        1 / H,
        Sensor("gyro", effects),
        Sensor("accel", {"angle_random_walk": {"N": N_ACCEL}}),
    )


class Drive:
    """One drive, made in pieces: the truth in closed form, the sensors' noise, and the error that
    the filter starts with.
    """

    def __init__(self, scenario: Scenario, seed: int) -> None:
        self.scenario, self.rng, self.sample = scenario, np.random.default_rng(seed), 0
        self.omega = self.rng.uniform(0.1, 0.8, (3, 2))
        self.size = scenario.moving * self.rng.uniform(0.1, 0.4, (3, 2))
        self.phase = self.rng.uniform(0, 2 * np.pi, (3, 2))
        error = STD0 * self.rng.standard_normal(6)
        self.bias = error[3:]
        self.attitude = self.at(np.zeros(1))[0]
        self.q0 = self.attitude * Rotation.from_rotvec(error[:3]).inv()
        std, slowness = scenario.noise.sway
        self.sway = (
            std * np.sqrt(2),
            self.rng.uniform(0.8, 1.25, 3) / slowness,
            self.rng.uniform(0, 2 * np.pi, 3),
        )
        self.slow = np.zeros((2, 3))

    def at(self, t: np.ndarray) -> Rotation:
        """The attitude (n) at ``t`` (n,) s: yaw, pitch and roll each of two sines, yaw turning on;
        at rest level.
        """
        t = np.maximum(t - self.scenario.rest, 0)
        angles = np.sum(self.size * np.sin(self.omega * t[:, None, None] + self.phase), axis=2)
        angles[:, 0] += self.scenario.moving * 0.2 * t
        return Rotation.from_euler("ZYX", angles)

    def rows(self, n: int) -> Iterator[tuple[np.ndarray, Rotation, np.ndarray]]:
        """Inputs (m, 18) of the next ``n`` samples in pieces, and attitude and bias (3,) at the end
        of each.
        """
        for start in range(0, n, CHUNK):
            yield self._piece(min(CHUNK, n - start))

    def _piece(self, n: int) -> tuple[np.ndarray, Rotation, np.ndarray]:
        k, own = self.sample + np.arange(n + 1), self.scenario.noise
        attitude = self.at(H * k)
        before, after = attitude[:-1], attitude[1:]
        rate = (before.inv() * after).as_rotvec() / H + before.apply(EARTH, inverse=True)
        noise = self.rng.standard_normal((3, n, 3))
        bias = self.bias + own.k * np.sqrt(H) * np.cumsum(noise[0], axis=0)
        # Of a bias that walks within a period the mean counts, and its noise is that of N; the
        # filter's Q has both.
        mean = np.vstack([self.bias, bias[:-1]]) / 2 + bias / 2
        u = np.zeros((n, 18))
        slow = self._correlated(0, n, *own.correlated)
        u[:, :3] = (
            rate
            + mean
            + slow
            + np.hypot(own.n / np.sqrt(H), own.k * np.sqrt(H / 12)) * noise[1]
            + self._relative(rate)
        )
        acceleration = self._correlated(1, n, *own.force) + self._swaying(H * k[1:])
        u[:, 3:6] = (
            after.apply(acceleration + [0, 0, GRAVITY], inverse=True)
            + N_ACCEL / np.sqrt(H) * noise[2]
        )
        u[:, 6] = 25.0
        self._headings(u, k[1:])
        self.sample, self.bias = self.sample + n, bias[-1]
        return u, after[-1], self.bias + slow[-1]

    def _correlated(self, which: int, n: int, std: float, tau: float) -> np.ndarray:
        """The next ``n`` samples (n, 3) of a Gauss-Markov process, which starts at zero as the
        initial bias error is drawn apart.
        """
        if not std:
            return np.zeros((n, 3))
        keep = np.exp(-H / tau)
        driven = std * np.sqrt(1 - keep**2) * self.rng.standard_normal((n, 3))
        out = lfilter([1.0], [1.0, -keep], driven, axis=0, zi=keep * self.slow[which][None])[0]
        self.slow[which] = out[-1]
        return out

    def _relative(self, rate: np.ndarray) -> np.ndarray:
        one, all_axes = self.scenario.noise.relative
        if not one and not all_axes:
            return np.zeros_like(rate)
        size = np.hypot(one * rate, all_axes * np.linalg.norm(rate, axis=1, keepdims=True))
        return size / np.sqrt(H) * self.rng.standard_normal(rate.shape)

    def _swaying(self, t: np.ndarray) -> np.ndarray:
        size, omega, phase = self.sway
        return size * np.sin(omega * t[:, None] + phase)

    def _headings(self, u: np.ndarray, k: np.ndarray) -> None:
        if not self.scenario.every:
            return
        late = round(self.scenario.late / H)
        told = (k % round(self.scenario.every / H) == 0) & (k > late)
        yaw = self.at(H * (k[told] - late)).as_euler("ZYX")[:, 0]
        u[told, 7] = yaw + HEADING_STD * self.rng.standard_normal(told.sum())
        u[told, 8], u[told, 9], u[told, 10] = HEADING_STD**2, 1, late * H
