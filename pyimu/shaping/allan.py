"""The Allan deviation of a noise from its density, by the integral."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from scipy.integrate import quad

LOBES = 2000
"""Lobes of the Allan kernel that are integrated one by one; beyond them sin^4 counts with its mean,
3/8."""

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)

DEPTH = 30
"""Powers of e below the first zero of the kernel at which the integral starts; even a random walk
has but 1e-13 below."""


def allan_deviation(
    psd: Callable[[np.ndarray], np.ndarray], tau: np.ndarray, sample_period: float | None = None
) -> np.ndarray:
    """Allan deviation at cluster times ``tau`` (n,) s of a noise with two-sided density ``psd(f)``.

    f > 0 is in Hz.

    Without ``sample_period`` the noise is continuous: sigma^2 = 4 int_0^inf S sin^4(pi f tau) / (pi
    f tau)^2 df (Hidalgo 2012, section 2.1; IEEE Std 952-2020, annex C). With it, clusters are
    means of n = tau / h samples, and (pi f tau)^2 becomes (n sin(pi f h))^2 with the integral up to
    Nyquist: exact for sampled noise. Raises ValueError where tau is not positive, or not a
    multiple of the sample period.
    """
    tau = np.atleast_1d(np.asarray(tau, dtype=float))
    if np.any(tau <= 0):
        raise ValueError("cluster times must be positive")
    if sample_period is None:
        return np.sqrt([_continuous_variance(psd, t) for t in tau])
    return np.sqrt([_sampled_variance(psd, k, sample_period) for k in clusters(tau, sample_period)])


def clusters(tau: np.ndarray, sample_period: float) -> np.ndarray:
    """Samples in each cluster (n,).

    Raises ValueError where a time is not a positive multiple of the sample period.
    """
    tau = np.atleast_1d(np.asarray(tau, dtype=float))
    n = np.rint(tau / sample_period).astype(int)
    if np.any(n < 1) or np.any(np.abs(n * sample_period - tau) > 1e-6 * sample_period * n):
        raise ValueError(
            f"cluster times must be multiples of the sample period {sample_period:g} s"
        )
    return n


def _sampled_variance(psd: Callable, n: int, h: float) -> float:
    x, weights = _sampled_rule(n)
    return float(np.sum(psd(x / (np.pi * h)) * weights)) * 4 / (np.pi * h)


@lru_cache(maxsize=64)
def _sampled_rule(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes x = pi f h in (0, pi/2) and weights for the integral with sin^4(n x) / (n sin(x))^2.

    Below the first zero of sin(n x) panels even in the logarithm, for poles far below 1 / tau; then
    lobe by lobe; beyond ``LOBES`` of them again in the logarithm, where the mean of sin^4 leaves
    out what falls with the cube of their number.
    """
    end, last = np.pi / 2, min(n / 2, LOBES)
    first = np.pi / n if n > 1 else end
    parts = [_panels(first * np.exp(np.arange(-DEPTH, 1.0)))]
    if n > 1:
        parts.append(_panels(np.pi / n * np.append(np.arange(1.0, last), last)))
    x, weights = (np.concatenate(p) for p in zip(*parts, strict=True))
    weights = weights * np.sin(n * x) ** 4
    if n / 2 > LOBES:
        start = np.pi * LOBES / n
        more, its = _panels(
            start * (end / start) ** np.linspace(0, 1, 2 + int(2 * np.log(end / start)))
        )
        x, weights = np.append(x, more), np.append(weights, its * 3 / 8)
    return x, weights / (n * np.sin(x)) ** 2


def _panels(edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Gauss-Legendre nodes and weights of all the panels between adjoining ``edges``."""
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (NODES + 1)).ravel(), (half * WEIGHTS).ravel()


def _continuous_variance(psd: Callable, tau: float) -> float:
    """The Allan variance of continuous noise.

    The integral is logarithmic below the first lobe, then lobe by lobe, then with the mean of
    sin^4, as in ``_sampled_rule``.
    """
    x, weights = (
        np.concatenate(p)
        for p in zip(
            _panels(np.pi * np.exp(np.arange(-DEPTH, 1.0))),
            _panels(np.pi * np.arange(1.0, LOBES + 1)),
            strict=True,
        )
    )
    lobes = np.sum(psd(x / (np.pi * tau)) * np.sin(x) ** 4 / x**2 * weights)
    rest = quad(
        lambda v: 0.375 * float(psd(np.array(1 / (v * np.pi * tau)))), 0, 1 / (np.pi * LOBES)
    )[0]
    return 4 / (np.pi * tau) * float(lobes + rest)
