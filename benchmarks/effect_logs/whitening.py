"""How large an error is, in standard deviations of the noise.

A sensor's noise is white noise of variance r a sample and a random walk that grows by k2 a second.
With a bias that nobody knows, all that samples e_k tell of anything else stands in their
differences, whose covariance T is tridiagonal: 2 r + k2 h, and -r beside. So the norm of an error
after the innovations filter, less what the bias could explain of it, is the root of
d' T^-1 d with d the differences of e; and free columns X are projected out by the Gram matrix of
[e X] under T^-1 (generalised least squares). A rate that was made of attitudes has the differences
of their noise in it: those of e have its second differences, whose covariance is 6, -4, 1 times
their variance.

An error that is random has no shape. Its size is the root of twice the log-likelihood that the true
law is expected to gain over the declared one, which of an error with a shape is its norm; of
spectra it follows after Whittle (1953).
"""

from __future__ import annotations

import numpy as np
from generators.instrument import Triad
from scipy.linalg import lstsq, solveh_banded
from scipy.optimize import minimize


def grams(
    errors: np.ndarray, triad: Triad, h: float, free: np.ndarray, attitude: float = 0.0
) -> list[np.ndarray]:
    """Products (k, k) of errors (n, 3, k) in a sensor's noise, by axis: of one error its squared
    size in sigmas.

    ``free`` (n, p) are columns with free coefficients on every axis; a bias always is free.
    ``attitude`` is the standard deviation [rad] of attitudes whose differences they are beside.
    """
    axes = zip(errors.transpose(1, 0, 2), triad.n**2 / h, triad.k**2 * h, strict=True)
    turned = (attitude / h) ** 2
    return [_gram(e, r, step, turned, free) for e, r, step in axes]


def _gram(e: np.ndarray, r: float, step: float, turned: float, free: np.ndarray) -> np.ndarray:
    d = np.diff(np.column_stack([e, free]), axis=0)
    diagonals = turned, -r - 4 * turned, 2 * r + step + 6 * turned
    band = np.vstack([np.full(len(d), v) for v in diagonals])
    gram = d.T @ solveh_banded(band, d, check_finite=False)
    k = e.shape[1]
    own, cross, other = gram[:k, :k], gram[k:, :k], gram[k:, k:]
    if not len(cross):
        return own
    scale = np.sqrt(np.maximum(np.diag(other), 1e-300))
    cross = cross / scale[:, None]
    share = lstsq(other / np.outer(scale, scale), cross, cond=1e-9)[0]
    left = own - cross.T @ share
    left[np.diag_indices(k)] = np.maximum(np.diag(left), 0.0)
    return left


def gain_of_variance(extra: np.ndarray, triad: Triad, h: float) -> float:
    """Size in sigmas of white noise whose variance is larger by ``extra`` (n, 3) in each row, over
    white noise of the same mean: where the variance does not change nothing tells the two apart.
    """
    ratio = 1 + extra / (triad.n**2 / h)
    return float(np.sqrt(max(np.sum(np.log(ratio.mean(axis=0)) - np.log(ratio)), 0.0)))


def frequencies(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Of ``n`` samples 2 pi k / n below pi, and how many of them each stands for: the first 64 each
    for itself, the others for a fiftieth of an octave.
    """
    edges = [64]
    while edges[-1] < n // 2:
        edges.append(max(edges[-1] + 1, round(edges[-1] * 2**0.02)))
    ends = np.minimum(np.array(edges), n // 2)
    count = np.concatenate([np.ones(63), np.diff(ends)])
    middle = np.concatenate([np.arange(1.0, 64.0), 0.5 * (ends[:-1] + ends[1:] - 1)])
    return 2 * np.pi * middle / n, count


def gain_of_spectrum(
    extra: np.ndarray, n: int, triad: Triad, h: float, free: bool = False
) -> float:
    """Size in sigmas, over ``n`` samples, of noise that adds ``extra`` (m, 3) to the two-sided
    density per sample at the m ``frequencies``.

    With ``free`` the white noise and the random walk are those that suit the sum best.
    """
    total = 0.0
    for axis in range(3):
        r, step = triad.n[axis] ** 2 / h, triad.k[axis] ** 2 * h
        total += _whittle(extra[:, axis], frequencies(n), r, step, free)
    return float(np.sqrt(max(2 * total, 0.0)))


def _whittle(extra, at, r: float, step: float, free: bool) -> float:
    """Nat that the true spectrum gains over white noise and random walk, on one axis."""
    omega, count = at
    turn = 4 * np.sin(omega / 2) ** 2
    truth = turn * (r + extra) + step

    def lost(logs) -> tuple[float, np.ndarray]:
        parts = np.array([turn * np.exp(logs[0]), np.full(len(turn), np.exp(logs[1]))])
        ratio = truth / parts.sum(axis=0)
        slope = parts / parts.sum(axis=0) @ (count * (1 - ratio))
        return float(count @ (ratio - 1 - np.log(ratio))), slope

    start = np.log([r, step])
    if not free:
        return lost(start)[0]
    bounds = [(start[0] - 1, start[0] + 10), (start[1] - 5, start[1] + 60)]
    starts = (start + [0.0, more] for more in (0.0, 3.0, 7.0, 15.0, 25.0))
    return min(minimize(lost, s, jac=True, method="L-BFGS-B", bounds=bounds).fun for s in starts)
