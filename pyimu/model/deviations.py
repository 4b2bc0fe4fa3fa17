"""Allan deviations in closed form (Hidalgo 2012, table 3; IEEE Std 952-2020, annex C).

Cluster times ``tau`` in s may be arrays. Where the sampled noise differs from the continuous one,
the sample period ``h`` [s] gives the deviation of means of n = tau / h samples, and zero the
field's continuous form; the others are exact for both.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import numpy as np

from pyimu.model.law import Law
from pyimu.symbolic.series import phi


def angle_quantization_deviation(Q: float, tau: np.ndarray) -> np.ndarray:
    """sqrt(3) Q / tau for an angle with an independent error Q in each sample.

    Q is a root mean square.

    Exact: the difference of two adjoining clusters is (2 e_n - e_0 - e_2n) / tau, of variance 6 Q^2
    / tau^2.
    """
    return np.sqrt(3) * Q / tau


def white_deviation(N: float, tau: np.ndarray) -> np.ndarray:
    """N / sqrt(tau) for white noise of the two-sided density N^2.

    Samples have the variance N^2 / h.
    """
    return N / np.sqrt(tau)


def flicker_floor(B: float) -> float:
    """sqrt(2 ln 2 / pi) B = 0.664 B, for the density B^2 / (2 pi f).

    The density must have that form over decades around 0.4 / tau.
    """
    return np.sqrt(2 * np.log(2) / np.pi) * B


def random_walk_deviation(K: float, tau: np.ndarray, h: float = 0.0) -> np.ndarray:
    """K sqrt(tau / 3); of samples sqrt(1 + 1 / (2 n^2)) times that, which is 1.22 at n = 1.

    A difference of adjoining clusters is the sum of 2 n - 1 increments K sqrt(h) w weighted by a
    triangle of height one, whose squares sum to (2 n^2 + 1) / (3 n).
    """
    return K * np.sqrt(tau / 3 * (1 + h**2 / (2 * tau**2)))


def ramp_deviation(R: float, tau: np.ndarray) -> np.ndarray:
    """R tau / sqrt(2); exact: the means of adjoining clusters differ by R tau."""
    return R * tau / np.sqrt(2)


def gauss_markov_deviation(q: float, tau_c: float, tau: np.ndarray) -> np.ndarray:
    """Deviation of exponentially correlated noise driven by white noise of density q^2.

    The correlation time is ``tau_c`` s, the noise continuous.

    sigma^2 = q^2 tau_c^2 / tau (1 - tau_c / (2 tau) (3 - 4 exp(-tau / tau_c) + exp(-2 tau /
    tau_c))), IEEE Std 952-2020, annex C; here with phi_3(z) = (1 - z + z^2/2 - exp(-z)) / z^3,
    since the print cancels where tau << tau_c. Samples of the process lie above, in the variance
    by a share of at most (h / (tau sqrt(2)) + h / (tau_c sqrt(12)))^2.
    """
    z = np.asarray(tau, dtype=float) / tau_c
    series = np.vectorize(lambda v: float(phi(3, v)))
    return q * np.sqrt(tau * (4 * series(2 * z) - 2 * series(z)))


def law_deviation(
    law: Law, coefficients: Mapping[str, float], tau: np.ndarray, h: float, x: float = 0.0
) -> np.ndarray:
    """Allan deviation (n,) of a noise with this law, of samples ``h`` s apart, where the axis's own
    input is ``x`` and does not change: the root of the sum of its parts' variances.
    """
    value = partial(law.value, coefficients=coefficients)
    white, walk, ramp = value("white", h=h, x=x, slope=0.0), value("walk"), value("ramp")
    rounding, markov = value("rounding"), value("markov")
    parts = [np.zeros(len(tau))]
    if white is not None:
        parts.append(white_deviation(np.sqrt(float(white)), tau))
    if walk is not None:
        parts.append(random_walk_deviation(np.sqrt(float(walk)), tau, h))
    if ramp is not None:
        parts.append(ramp_deviation(float(ramp), tau))
    if rounding is not None:
        parts.append(angle_quantization_deviation(float(rounding), tau))
    for variance, time in markov or ():
        if variance > 0:
            drive = float(np.sqrt(2 * variance / time))
            parts.append(gauss_markov_deviation(drive, float(time), tau))
    return np.sqrt(np.sum(np.square(parts), axis=0))
