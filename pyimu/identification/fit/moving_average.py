"""What differentiating makes of noise: a moving average of first order, x_k = z_k - theta z_(k-1).

Its theta is 1 where nothing else is in it, and less the more of the low frequencies the sensor's
own noise has (Box and Jenkins 1976, "Time series analysis", section 3.3). It is taken out of a
series by its innovations (Brockwell and Davis 1991, "Time series: theory and methods", section
5.2).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numba import njit
from scipy.linalg import solve_toeplitz

Segments = list[tuple[int, int]]

APART = 10**0.25
"""From one 1 - theta that is tried to the next."""

WORTH = 1.0
"""nat within which the data do not tell two moving averages apart (two units of Akaike's criterion,
Burnham and Anderson 2002, section 2.6)."""


@njit(cache=True)
def _innovations(values, starts, first, theta, state, out):
    """Fill ``out`` (m, c) with the innovations of ``values`` (m, c), rows ``first`` and on, of unit
    variance where that of z is; anew at each of ``starts`` (s,). ``state`` (1 + c,) is the variance
    of the last innovation and these themselves.
    """
    m, c = values.shape
    for k in range(m):
        anew = False
        for s in starts:
            anew = anew or s == first + k
        if anew:
            state[0] = np.inf
            state[1:] = 0.0
        share = theta / state[0]
        state[0] = 1.0 + theta * theta - theta * share
        root = 1.0 / np.sqrt(state[0])
        for j in range(c):
            v = values[k, j] + share * state[1 + j]
            state[1 + j] = v if abs(v) > 1e-200 else 0.0
            out[k, j] = v * root


def log_determinant(theta: float, rows: int, left_out: int) -> float:
    """Sum of the logarithms of the variances of innovations of so many ``rows``, less those of the
    first that are ``left_out``.
    """
    variance = np.empty(max(rows, 1))
    variance[0] = 1.0 + theta**2
    for k in range(1, len(variance)):
        variance[k] = 1.0 + theta**2 - theta**2 / variance[k - 1]
        if abs(variance[k] - variance[k - 1]) < 1e-12:
            variance[k:] = variance[k]
            break
    return float(np.sum(np.log(variance[left_out:rows])))


class Innovations:
    """What takes a moving average out of columns, block after block of their rows."""

    def __init__(self, theta: float, segments: Segments) -> None:
        self.theta, self.row = theta, 0
        self.starts = np.array([0, *(a for a, _ in segments)])
        self.state = np.zeros(0)

    def next(self, values: np.ndarray) -> np.ndarray:
        """The next rows (k, c)."""
        if not self.row:
            self.state = np.append(np.inf, np.zeros(values.shape[1]))
        out = np.empty(values.shape)
        inside = (self.starts >= self.row) & (self.starts < self.row + len(values))
        _innovations(values, self.starts[inside], self.row, self.theta, self.state, out)
        self.row += len(values)
        return out


def likeliest(pieces: Sequence[np.ndarray], order: int, least: float) -> float:
    """The least theta of pieces (m,) whose z is an autoregression of an ``order`` beside which none
    is likelier by ``WORTH``, by Whittle's likelihood of the frequencies of at least so many cycles
    a row: what was taken out of the slower ones is no noise.
    """
    powers = [np.abs(np.fft.rfft(v)) ** 2 / len(v) for v in pieces]
    number = int(np.log(1.0 / (2.0 * np.pi * least)) / np.log(APART))
    away = [float(APART**-k) for k in range(max(number, 0) + 1)]
    lost = [_lost(pieces, powers, least, order, 1.0 - a) for a in away]
    # An autoregression can take back what is too much of a moving average, and never quite.
    return 1.0 - next(a for a, one in zip(away, lost, strict=True) if one <= min(lost) + WORTH)


def _lost(
    pieces: Sequence[np.ndarray],
    powers: Sequence[np.ndarray],
    least: float,
    order: int,
    theta: float,
) -> float:
    """Negative log-likelihood [nat] of the ``powers`` of pieces by frequency, where z is an
    autoregression by its autocovariances (Yule and Walker).
    """
    products = np.zeros(order + 1)
    for v in pieces:
        z = Innovations(theta, []).next(v[:, None])[order:, 0] if theta else v
        products += [z[k:] @ z[: len(z) - k] for k in range(order + 1)]
    taps = np.append(1.0, -solve_toeplitz(products[:-1], products[1:]))
    seen, densities = [], []
    for v, power in zip(pieces, powers, strict=True):
        shown = np.fft.rfftfreq(len(v)) > least
        of_average, of_taps = (np.fft.rfft(t, len(v))[shown] for t in ([1.0, -theta], taps))
        densities.append(np.abs(of_average / of_taps) ** 2)
        seen.append(power[shown])
    power, density = np.concatenate(seen), np.concatenate(densities)
    return len(power) * float(np.log(np.mean(power / density))) + float(np.sum(np.log(density)))
