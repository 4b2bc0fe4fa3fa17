"""By how much the velocity of a body changes between two moments at which nothing pushes it.

With T the turn from a sample's axes to those of the first moment, w its rate, f its force, c
gravity's reaction and b the accelerometer's bias, in axes of the first moment,

    f_1 = c + b,    T f = a + c + T b,    T_2 f_2 = c + T_2 b,

so that the velocity gains the sum of T f - f_1 - (T - 1) b. What the second moment shows beside the
first tells b as far as the body has turned, and how the gyro's errors have tipped gravity: gains M
turn it by phi = sum of T M w, and noise by what grows evenly, of which a bridge is left. With these
as Gaussian errors x of the priors below, T_2 f_2 - f_1 = B x + e and the velocity is off by A x: it
is corrected by what the first tells of x (Bishop 2006, eqs. 2.81 and 2.82).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numba import njit
from scipy.spatial.transform import Rotation

from pyimu.ins.detector import FORCE_KEPT, kept_for
from pyimu.ins.noise import Noise
from pyimu.ins.pushes import FORCE_STAYS
from pyimu.units import STANDARD_GRAVITY

BIAS = 0.5
"""m/s^2; standard deviation of the null of an accelerometer that nobody calibrated (50 mg)."""

BESIDE = 10.0
"""s; over which the mean rate of a moment is taken at most: a bias stays so long."""

GAIN = 0.02
"""That of a scale factor and a misalignment of a gyro, and of an accelerometer, likewise."""


TURNED = 0.1
"""rad; a body that has turned by more shows other errors of its accelerometer."""


class Moment(Protocol):
    """The mean ``force`` (3,) of so many ``rows`` at which nothing pushes, and the mean ``rate``
    (3,) of those that are within ``BESIDE`` of what lies between.
    """

    @property
    def rate(self) -> np.ndarray: ...

    @property
    def force(self) -> np.ndarray: ...

    @property
    def rows(self) -> int: ...


@dataclass(frozen=True)
class Change:
    """What the ``velocity`` (3,) m/s has gained, in axes of the first moment, its ``variance`` in
    the direction in which that is largest, the matrix ``turn`` (3, 3) from the axes of the second
    and its ``angle`` rad, and the square over its variance by which the forces of the two are
    ``apart``, that is chi-square distributed with 3 degrees of freedom where nothing pushes at
    either. ``most`` m/s is the largest gain in between.
    """

    velocity: np.ndarray
    variance: float
    turn: np.ndarray
    angle: float
    apart: float
    most: float

    @property
    def speed(self) -> float:
        """m/s; the size of what is gained."""
        return float(np.linalg.norm(self.velocity))


def change_of_velocity(
    gyro: np.ndarray, accel: np.ndarray, ends: tuple[Moment, Moment], noise: Noise, period: float
) -> Change:
    """The change between two moments, of which ``gyro`` rad/s and ``accel`` m/s^2 (n, 3) lie in
    between, one sample a ``period`` s.
    """
    first, second = ends
    of_ends = float(np.mean(noise.force**2)) * (1 / first.rows + 1 / second.rows)
    noise, n = _shaken(gyro, accel, noise), len(gyro)
    share = np.arange(1, n + 1) / n
    rates = gyro - first.rate - share[:, None] * (second.rate - first.rate)
    turns = _products(Rotation.from_rotvec(rates * period).as_matrix())
    force = np.einsum("nij,nj->ni", turns, accel)
    velocity = np.cumsum(force - first.force, axis=0) * period
    shown, of_gains = turns[-1] @ second.force, _times(turns, rates)
    told = np.hstack(
        [
            turns[-1] - np.eye(3),
            _skew(shown) @ of_gains.sum(axis=0) * period,
            _skew(shown),
            np.eye(3),
        ]
    )
    last = _at_last(turns, of_gains, force, share, period)
    of_rates = sum(noise.of_mean(min(m.rows, round(BESIDE / period)), period) for m in ends)
    prior = _prior(noise, of_rates, period, n)
    own = told * prior @ told.T + of_ends * np.eye(3)
    gain = np.linalg.solve(own, told * prior).T
    known = np.diag(prior) - gain @ own @ gain.T
    off = shown - first.force
    velocity = velocity - _by_errors(gain @ off, turns, rates, force, share, period)
    spread = float(np.linalg.eigvalsh(last @ known @ last.T).max())
    spread += _left(noise, of_ends, velocity, rates, period)
    # Of a body that turned meanwhile, what an accelerometer's error changes by in one attitude.
    turned = np.trace(turns, axis1=1, axis2=2).min() < 1 + 2 * np.cos(TURNED)
    kept = FORCE_KEPT if turned else kept_for(n * period)
    apart = float(off @ np.linalg.solve(own + kept**2 * np.eye(3), off))
    most = float(np.linalg.norm(velocity, axis=1).max())
    angle = float(Rotation.from_matrix(turns[-1]).magnitude())
    return Change(velocity[-1], spread, turns[-1], angle, apart, most)


def _at_last(
    turns: np.ndarray, of_gains: np.ndarray, force: np.ndarray, share: np.ndarray, period: float
) -> np.ndarray:
    """A (3, 18): what the errors make of the velocity in the end.

    Of gains, the sum over k of T f x (the sum over j <= k of T w) is that over j of the forces from
    j on, times T w.
    """
    n = len(turns)
    after = _skew(np.cumsum(force[::-1], axis=0)[::-1]).reshape(n, 9)
    crossed = (after.T @ of_gains.reshape(n, 27)).reshape(3, 3, 3, 9)
    return -np.hstack(
        [
            (turns.sum(axis=0) - n * np.eye(3)) * period,
            np.einsum("ijje->ie", crossed) * period**2,
            _skew((share[:, None] * force).sum(axis=0)) * period,
            np.eye(3) * share.sum() * period,
        ]
    )


def _by_errors(
    x: np.ndarray,
    turns: np.ndarray,
    rates: np.ndarray,
    force: np.ndarray,
    share: np.ndarray,
    period: float,
) -> np.ndarray:
    """What errors x (18,) take off the velocity (n, 3) at each sample."""
    bias, gains, turned, stays = x[:3], x[3:12].reshape(3, 3), x[12:15], x[15:]
    by_gains = np.cumsum(np.einsum("nij,nj->ni", turns, rates @ gains.T), axis=0) * period
    tipped = by_gains + share[:, None] * turned
    off = turns @ bias - bias + np.cross(force, tipped) + share[:, None] * stays
    return np.cumsum(off, axis=0) * period


def _shaken(gyro: np.ndarray, accel: np.ndarray, noise: Noise) -> Noise:
    """The noise with what shakes a body on its way, and what lies between two samples of it."""
    steps = (np.sqrt(np.mean(np.diff(v, axis=0) ** 2 / 2, axis=0)) for v in (gyro, accel))
    rate, force = steps if len(gyro) > 1 else (noise.rate, noise.force)
    return replace(noise, rate=np.maximum(noise.rate, rate), force=np.maximum(noise.force, force))


def _prior(noise: Noise, of_rates: np.ndarray, period: float, n: int) -> np.ndarray:
    """Variances (18,) of the bias, the gyro's gains, what its noise and its bias turn in all, that
    is known at the ends to ``of_rates`` (3,), and the change of the accelerometer's error.
    """
    seconds = n * period
    turned = noise.rate**2 * period * seconds + of_rates * seconds**2 / 4
    turned = turned + noise.walk**2 * seconds**3 / 12
    sizes = [np.full(3, BIAS**2), np.full(9, GAIN**2), turned, np.full(3, FORCE_STAYS**2)]
    return np.concatenate(sizes)


def _left(
    noise: Noise, of_ends: float, velocity: np.ndarray, rates: np.ndarray, period: float
) -> float:
    """Variance per axis of what both ends do not tell: white noise, the bridge of what noise has
    tipped, the means at the ends, errors of the accelerometer that come and go, and its gains where
    the body has turned, which a push and its end do not cancel.
    """
    white, seconds = float(np.mean(noise.force**2)), len(rates) * period
    tipped = float(np.mean(noise.rate**2)) * period * seconds**3 / 12
    tipped = STANDARD_GRAVITY**2 * (tipped + float(np.mean(noise.walk**2)) * seconds**5 / 720)
    stays = (FORCE_STAYS * seconds / 2) ** 2
    way = min(float(np.sum(np.linalg.norm(rates, axis=1))) * period, 1.0)
    by_gains = (GAIN * way * float(np.linalg.norm(velocity, axis=1).max())) ** 2
    return white * period * seconds + tipped + of_ends * seconds**2 / 3 + stays + by_gains


def _times(turns: np.ndarray, rates: np.ndarray) -> np.ndarray:
    """What each entry of M, row by row, makes of T M w: (n, 3, 9)."""
    return np.einsum("nij,nk->nijk", turns, rates).reshape(len(turns), 3, 9)


def _skew(v: np.ndarray) -> np.ndarray:
    """The matrices (..., 3, 3) of the cross products v x."""
    return -np.cross(v[..., None, :], np.eye(3))


@njit(cache=True)
def _products(steps: np.ndarray) -> np.ndarray:
    """The products (n, 3, 3) of matrices (n, 3, 3) that follow each other, up to each."""
    out = np.empty_like(steps)
    out[0] = steps[0]
    for k in range(1, len(steps)):
        for i in range(3):
            for j in range(3):
                a, b = out[k - 1], steps[k]
                out[k, i, j] = a[i, 0] * b[0, j] + a[i, 1] * b[1, j] + a[i, 2] * b[2, j]
    return out
