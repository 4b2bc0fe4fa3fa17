"""What the noise of sensor and reference accounts for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from scipy.linalg import solve_toeplitz
from scipy.signal import lfilter

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.most_white import most_white
from pyimu.identification.fit.noise_fit import declared_variances
from pyimu.identification.fit.sample_noise import band_noise
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.numerics.laws import chi2

WINDOW = 64
"""Rows of the windows in which the quiet is looked for."""

QUIET = 0.25
"""Share of the windows that is taken for quiet."""

LAGS = 8
"""Rows over which what is left in the quiet is tried for correlation."""

DRAWN = 512
"""Windows that are drawn to see how quiet chance makes a quarter of them."""


def own_noise(fitted: Fit) -> dict[int, RandomWalk]:
    """The sensor's own noise at the sample rate.

    As declared, else its white part as its quiet rows show it, and no more of that than what is
    left of the reference.
    """
    white, walk = declared_variances(fitted.sensor, fitted.trials[0].h)
    if not white.any():
        white = np.mean([band_noise(t) for t in fitted.trials], axis=0) ** 2
        white = np.minimum(white, most_white(fitted) / fitted.trials[0].h)
    return {i: RandomWalk(float(white[i]), float(walk[i])) for i in fitted.noise}


def floor_noise(fit: Fit) -> dict[int, RandomWalk]:
    """Noise at the sample rate for the floor.

    As fitted, or the sensor's own where the reference is derived.
    """
    return (
        dict(fit.noise)
        if all(isinstance(n, RandomWalk) for n in fit.noise.values())
        else own_noise(fit)
    )


def reference_variance(fit: Fit, log: str = "") -> np.ndarray:
    """Variance (3,) in a row of the band that the reference adds to the sensor's own noise: that of
    a ``log`` where rows of it were fitted, else of all of them.

    Zero where the fitted noise holds both.

    It is read off the quietest quarter of the fitted windows, and is by as much more than these
    show as noise of one level would be.
    """
    if all(isinstance(n, RandomWalk) for n in fit.noise.values()):
        return np.zeros(3)
    return beyond_own(fit, log=log)


def beyond_own(fit: Fit, errors: float = 0.0, log: str = "") -> np.ndarray:
    """Variance (3,) in a row of the band that the quiet shows beyond the sensor's own noise, or the
    most that it may be, by so many standard ``errors``; that of a ``log`` where rows of it were
    fitted, else of all of them.
    """
    noise = np.zeros(3)
    own, each = own_noise(fit), list(zip(fit.trials, fit.residuals(), strict=True))
    residuals = [one for t, one in each if t.name == log] or [one for _, one in each]
    share = np.mean([np.sum(np.square(t.band.weights)) for t in fit.trials])
    for i in own:
        seen = [(one.residual[:, i], one.segments) for one in residuals if i in one.keys]
        pieces = np.concatenate([windows(*one) for one in seen])
        if len(pieces):
            level, rows = quiet(pieces) / lowness(pieces), QUIET * pieces.size
        else:
            # No stretch is as long as a window: the level that half of the rows stay below.
            squares = np.concatenate([r for r, _ in seen]) ** 2
            rows = len(squares)
            level = float(np.median(squares) / chi2.ppf(0.5, 1)) if rows else 0.0
        most = level * (1.0 + errors * np.sqrt(2.0 / max(rows, 1.0)))
        noise[i] = max(0.0, most - own[i].r * share)
    return noise


def quietest(pieces: np.ndarray, share: float) -> np.ndarray:
    """The quietest ``share`` of windows (k, m)."""
    return pieces[np.argsort(pieces.var(axis=1))[: max(1, int(len(pieces) * share))]]


def quiet(pieces: np.ndarray, share: float = QUIET) -> float:
    """Mean variance of the quietest ``share`` of windows (k, ``WINDOW``)."""
    return float(np.mean(quietest(pieces, share).var(axis=1)))


def colour(pieces: np.ndarray) -> tuple[float, ...]:
    """Coefficients of an autoregression over ``LAGS`` rows like windows (k, m), each in units of
    its own size, by their autocovariances (Yule and Walker).
    """
    v = pieces - pieces.mean(axis=1, keepdims=True)
    size = v.std(axis=1, keepdims=True)
    # What is constant to rounding has no colour.
    alive = size > 1e-12 * np.abs(pieces).max(axis=1, keepdims=True)
    v = np.where(alive, v / np.where(alive, size, 1.0), 0.0)
    products = np.array([np.sum(v[:, k:] * v[:, : v.shape[1] - k]) for k in range(LAGS + 1)])
    return tuple(solve_toeplitz(products[:-1], products[1:])) if products[0] > 0 else ()


def lowness(pieces: np.ndarray, share: float = QUIET, seed: int = 1) -> float:
    """What the quietest ``share`` of windows shows of the variance, if noise of the colour that
    windows (k, m) have in their quiet has one level.
    """
    taps = [1.0, *(-c for c in colour(quietest(pieces, QUIET)))]
    drawn = np.random.default_rng(seed).standard_normal(DRAWN * WINDOW)
    settled = lfilter([1.0], taps, drawn)[WINDOW:].reshape(-1, WINDOW)
    return quiet(settled, share) / float(np.mean(settled.var(axis=1)))


def windows(values: np.ndarray, segments: list[tuple[int, int]]) -> np.ndarray:
    """Whole windows (k, ``WINDOW``) of values (n,), none of which reaches over a gap."""
    parts = [values[a : a + (b - a) // WINDOW * WINDOW].reshape(-1, WINDOW) for a, b in segments]
    return np.concatenate(parts) if parts else np.zeros((0, WINDOW))


def unit_noise(
    axes: Iterable[int], time: np.ndarray, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """White noise of unit variance and a random walk that grows by one a second, (n, 3) each, at
    the sample rate; zero on other axes than ``axes``.
    """
    white, walk = np.zeros((len(time), 3)), np.zeros((len(time), 3))
    steps = np.sqrt(np.maximum(np.diff(time, prepend=time[:1]), 0.0))
    for i in axes:
        white[:, i] = rng.standard_normal(len(time))
        walk[:, i] = np.cumsum(steps * rng.standard_normal(len(time)))
    return white, walk


Processes = Mapping[int, Sequence[tuple[float, float]]]
"""By axis the variance and the correlation time [s] of each of its Gauss-Markov processes."""


def markov_noise(processes: Processes, time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Gauss-Markov processes (n, 3), stationary, at the sample rate; zero on other axes.

    A gap is passed over: rows across it are as close as any.
    """
    out = np.zeros((len(time), 3))
    h = float(np.median(np.diff(time))) if len(time) > 1 else 1.0
    for i, pairs in processes.items():
        for variance, tau in pairs:
            kept = np.exp(-h / tau)
            draw = np.sqrt(variance) * rng.standard_normal(len(time) + 1)
            new = np.sqrt(-np.expm1(-2.0 * h / tau)) * draw[1:]
            out[:, i] += lfilter([1.0], [1.0, -kept], new, zi=kept * draw[:1])[0]
    return out
