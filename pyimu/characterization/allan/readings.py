"""Coefficients as they are read off an Allan plot by eye: Hidalgo 2012, section 2.2."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.shaping import flicker_floor

N_AT, K_AT = 1.0, 3.0
"""Cluster times [s] at which a line of slope -1/2 has the height N and one of slope +1/2 the height
K."""

CLEAR, FEW = 4.0, 10.0
"""The line of slope +1/2 is laid through cluster times of so many times that of the floor and more;
no cluster is read that fits into the record less often than this."""


@dataclass(frozen=True)
class Reading:
    """Coefficients as read off a plot, in SI units; nan for K where the record is too short to show
    its slope.
    """

    N: float
    K: float
    B: float


def read_coefficients(tau: np.ndarray, deviation: np.ndarray) -> Reading:
    """Read Allan deviations (t,) at cluster times (t,) s, rising, that reach half the record, as
    Hidalgo 2012, section 2.2, does.

    N is the height at 1 s (between cluster times along the line that joins them), K that at 3 s of
    the line of slope +1/2 through the long cluster times, B the lowest point over 0.664. Which
    times are long is not said there: here those from ``CLEAR`` times that of the lowest point on,
    where white noise is a sixteenth of the random walk's variance.

    Raises ValueError where 1 s is not among the cluster times.
    """
    tau, deviation = np.asarray(tau, dtype=float), np.asarray(deviation, dtype=float)
    if not tau[0] <= N_AT <= tau[-1]:
        raise ValueError(
            f"N is read at {N_AT:g} s, which is not between the cluster times {tau[0]:g} and "
            f"{tau[-1]:g} s"
        )
    legible = tau <= max(2 * tau[-1] / FEW, tau[0])
    lowest = int(np.argmin(deviation[legible]))
    rising = legible & (tau >= CLEAR * tau[lowest])
    K = (
        np.exp(np.mean(np.log(deviation[rising] * np.sqrt(K_AT / tau[rising]))))
        if rising.any()
        else np.nan
    )
    N = np.exp(np.interp(np.log(N_AT), np.log(tau), np.log(deviation)))
    return Reading(float(N), float(K), float(deviation[lowest] / flicker_floor(1.0)))


def crossing(N: np.ndarray, K: np.ndarray) -> np.ndarray:
    """B that the floor of white noise and random walk alone reads as: sqrt(2 N K / sqrt(3)), at tau
    = sqrt(3) N / K, over 0.664.
    """
    return np.sqrt(2 * N * K / np.sqrt(3)) / flicker_floor(1.0)
