"""Coefficients as they are read off an Allan plot by eye (Hidalgo 2012, section 2.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.shaping import flicker_floor

N_AT, K_AT = 1.0, 3.0
"""Cluster times [s] at which the line of slope -1/2 has the height N, that of slope +1/2 K."""

CLEAR = 4.0
"""The line of slope +1/2 is fitted from so many times the cluster time of the floor on."""

FEW = 10.0
"""Clusters that must fit into the record for their deviation to be read."""

AFTER = 2.0
"""Times the cluster time of the floor up to which the curve must be read for it to be one: where a
curve falls to its end it scatters by a quarter, so that its lowest point is not always the last."""


@dataclass(frozen=True)
class Reading:
    """Coefficients as read off a plot, in SI units.

    K is nan where the record is too short to show its slope.
    """

    N: float
    K: float
    B: float


@dataclass(frozen=True)
class Floor:
    """The lowest Allan deviation, in the unit of the samples, and its cluster time ``tau`` [s].

    ``bound`` says that it is an upper bound alone: it lies so near the last cluster time that is
    read that the curve may go on falling.
    """

    deviation: float
    tau: float
    bound: bool = False

    @property
    def instability(self) -> float:
        """B as read off the floor, which is 0.664 B (Hidalgo 2012, table 3)."""
        return self.deviation / flicker_floor(1.0)


def read_coefficients(tau: np.ndarray, deviation: np.ndarray) -> Reading:
    """Read N, K and B off Allan deviations (t,) at rising cluster times (t,) s.

    The cluster times reach half the record. As in Hidalgo 2012, section 2.2, N is the height at 1 s
    (interpolated between cluster times), K the height at 3 s of the line of slope +1/2 through the
    long cluster times, and B the lowest point over 0.664. The paper does not say which times are
    long: here they start at ``CLEAR`` times that of the lowest point, where the variance of white
    noise is a sixteenth of the random walk's.

    Raises ValueError where 1 s is not between the cluster times.
    """
    tau, deviation = np.asarray(tau, dtype=float), np.asarray(deviation, dtype=float)
    if not tau[0] <= N_AT <= tau[-1]:
        raise ValueError(
            f"N is read at {N_AT:g} s, which is not between the cluster times {tau[0]:g} and "
            f"{tau[-1]:g} s"
        )
    lowest = floor(tau, deviation)
    rising = _legible(tau) & (tau >= CLEAR * lowest.tau)
    K = (
        np.exp(np.mean(np.log(deviation[rising] * np.sqrt(K_AT / tau[rising]))))
        if rising.any()
        else np.nan
    )
    N = np.exp(np.interp(np.log(N_AT), np.log(tau), np.log(deviation)))
    return Reading(float(N), float(K), lowest.instability)


def floor(tau: np.ndarray, deviation: np.ndarray) -> Floor:
    """The lowest of the Allan deviations (t,) that at least ``FEW`` clusters made.

    The cluster times ``tau`` (t,) s rise and reach half the record.
    """
    legible = _legible(tau)
    lowest = int(np.argmin(np.where(legible, deviation, np.inf)))
    bound = tau[lowest] > tau[legible][-1] / AFTER
    return Floor(float(deviation[lowest]), float(tau[lowest]), bool(bound))


def _legible(tau: np.ndarray) -> np.ndarray:
    """Mask (t,) of the cluster times of which enough clusters fit into the record."""
    return tau <= max(2 * tau[-1] / FEW, tau[0])


def crossing(N: np.ndarray, K: np.ndarray) -> np.ndarray:
    """The B that is read where there is only white noise N and random walk K.

    Their floor is sqrt(2 N K / sqrt(3)), at tau = sqrt(3) N / K; B is that over 0.664.
    """
    return np.sqrt(2 * N * K / np.sqrt(3)) / flicker_floor(1.0)
