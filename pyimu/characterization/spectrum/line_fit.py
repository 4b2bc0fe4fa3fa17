r"""Frequency and amplitude of a line, from the few bins of a Welch estimate that it reaches.

A sine of amplitude A at bin kappa, on noise of density B, has at bin k the expected density

    P_k = B + A^2 / (3 D) g(k - kappa),    g(d) = (sinc(d) / (1 - d^2))^2

for Hann's window; D is the width of a bin in Hz. The fit weights by the covariance of the P_k:
that of the noise alone, and that of its product with the sine, between bins and between overlapping
windows, in which the sine goes on without a break.

A line whose frequency wanders by more than a bin, and a narrow band of noise, have another shape.
They are measured by their moments: the power is the sum of the density above the noise, the
frequency its mean, the width its standard deviation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.characterization.spectrum.background import Background, Scale
from pyimu.characterization.spectrum.cascade import hann
from pyimu.characterization.spectrum.psd import SHORTEST
from pyimu.numerics.laws import chi2

HALF = 3
"""Bins on either side of the highest one that are fitted."""

ROUNDS = 12
"""The most steps of the fit."""

PURE = 2e-3
"""Relative error of g. No line is so pure, and no transform of so few samples so smooth, that g
describes it better."""

SHARP = 1e-3
"""Probability with which a sharp line is called broad, because it fits badly by chance."""

BAND = 3
"""The frequency of a line more than that many groups wide is that of its upper half."""

QUIET = 3
"""A broad line ends where that many groups in a row have faded into the noise."""


@dataclass(frozen=True)
class Fitted:
    """Frequency and power of a line, with standard errors.

    ``frequency`` is in Hz, ``power`` is A^2 in the square of the samples' unit. ``width`` [Hz] is
    zero if the line is sharp; ``low`` and ``high`` [Hz] are its ends.
    """

    frequency: float
    frequency_std: float
    power: float
    power_std: float
    width: float
    low: float
    high: float


def leak(d: np.ndarray) -> np.ndarray:
    """g(d): density of a sine at a distance of ``d`` bins, relative to that at its frequency."""
    d = np.asarray(d, dtype=float)
    near_one = np.abs(np.abs(d) - 1) < 1e-6
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(near_one, 0.25, (np.sinc(d) / (1 - np.where(near_one, 0.0, d) ** 2)) ** 2)


def fit_line(scale: Scale, under: Background, peak: int) -> Fitted:
    """The line whose highest group is the one at index ``peak``."""
    if scale.bins > 1:
        return _moments(scale, under, peak)
    near = slice(max(0, peak - HALF), peak + HALF + 1)
    noise = under.density[peak]
    shape = _sharp(
        scale.k[near],
        scale.density[near] / noise,
        under.density[near] / noise,
        under.error[peak],
        under.windows,
        scale.k[peak],
    )
    if shape is None:
        return _moments(scale, under, peak)
    kappa, strength, covariance = shape
    width = scale.level.resolution
    unit, std = 3 * width * noise, np.sqrt(np.diag(covariance))
    ends = scale.k[near][[0, -1]] * width
    return Fitted(
        kappa * width,
        std[0] * width,
        strength * unit,
        std[1] * unit,
        0.0,
        ends[0] - width / 2,
        ends[1] + width / 2,
    )


def _sharp(
    k: np.ndarray, density: np.ndarray, noise: np.ndarray, error: float, windows: float, peak: int
) -> tuple[float, float, np.ndarray] | None:
    """Bin and strength of a sharp line and their covariance (2, 2); None for a bad fit.

    The strength is A^2 / (3 D) over the density of the noise. Bins ``k`` (m,), their ``density``
    (m,) and the ``noise`` beneath (m,) are fitted by generalised least squares.
    """
    around = np.maximum(density - noise, 0.0) * (np.abs(k - peak) <= 1)
    kappa, strength = float(around @ k / around.sum()), float(around.sum() / 1.5)
    for _ in range(ROUNDS):
        slope = (leak(k - kappa - 1e-4) - leak(k - kappa + 1e-4)) / 2e-4
        jacobian = np.column_stack([strength * slope, leak(k - kappa)])
        covariance = covariance_of_bins(k - peak, kappa - peak, strength, windows) + error**2
        weight = np.linalg.inv(covariance + np.diag((PURE * strength * leak(k - kappa)) ** 2))
        normal = jacobian.T @ weight @ jacobian
        rest = density - noise - strength * leak(k - kappa)
        step = np.linalg.solve(normal, jacobian.T @ weight @ rest)
        kappa = float(np.clip(kappa + np.clip(step[0], -0.5, 0.5), peak - 1.5, peak + 1.5))
        strength = float(max(strength + step[1], strength / 4))
        if abs(step[0]) < 1e-6 and abs(step[1]) < 1e-6 * strength:
            break
    misfit = float(rest @ weight @ rest)
    if misfit > chi2.isf(SHARP, len(k) - 2):
        return None
    return kappa, strength, np.linalg.inv(normal)


def covariance_of_bins(k: np.ndarray, kappa: float, strength: float, windows: float) -> np.ndarray:
    """Covariance (m, m) of Welch's estimates at bins ``k`` (m,) in noise of unit density.

    There is a sine at ``kappa`` of ``strength`` A^2 / (3 D). Bins may be counted from any even one.
    With s the transform of the sine and c the covariance of that of the noise, a window and a pair
    of windows m halves apart contribute |c|^2 + 2 Re(conj(s_j) s_k exp(i pi (kappa - k) m) c_jk).
    """
    w, t, half = hann(SHORTEST), np.arange(SHORTEST), SHORTEST // 2
    sine = np.sqrt(strength) * np.exp(-2j * np.pi * np.outer(k - kappa, t) / SHORTEST) @ w / w.sum()
    apart = np.exp(-2j * np.pi * (k[:, None] - k)[:, :, None] * t / SHORTEST)
    earlier, later = np.append(w[half:], np.zeros(half)), np.append(np.zeros(half), w[:half])
    total = np.zeros((len(k), len(k)))
    for m, shifted in ((-1, earlier), (0, w), (1, later)):
        noise = apart @ (w * shifted) / np.sum(w**2)
        crossed = np.conj(sine)[:, None] * sine * np.exp(1j * np.pi * (kappa - k) * m) * noise
        total += max(windows - abs(m), 0.0) / windows**2 * (np.abs(noise) ** 2 + 2 * crossed.real)
    return total


def _moments(scale: Scale, under: Background, peak: int) -> Fitted:
    """A broad line by its moments, out to where it has faded into the noise.

    The frequency of a band is that of its upper half.
    """
    over = ~under.faded(scale.density)
    inside = slice(
        peak - _until_quiet(over[: peak + 1][::-1]), peak + _until_quiet(over[peak:]) + 1
    )
    step = scale.level.resolution * scale.bins
    f, density, noise = scale.frequency[inside], scale.density[inside], under.density[inside]
    excess = density - noise
    total = excess.sum()
    width = np.sqrt(
        max(excess @ (f - excess @ f / total) ** 2 / total - scale.level.resolution**2 / 3, 0.0)
    )
    # Skirts and shoulders of a band do not count for its frequency.
    band = scale.bins > 1 and width > BAND * step
    top = np.where(excess >= excess.max() / 2, excess, 0.0) if band else excess
    middle = top @ f / top.sum()
    # Neighbours are correlated, and the curve beneath is off by the same factor everywhere.
    spread = density * np.sqrt(scale.repeated / under.averages)
    std = np.hypot(np.linalg.norm(spread), (under.error[inside] * noise).sum())
    middle_std = np.linalg.norm((spread * (f - middle))[top != 0]) / top.sum()
    if band or (scale.bins > 1 and width < step):
        # The ends of a band are known to half a group, and a line within one group to its width.
        middle_std = np.hypot(middle_std, step / np.sqrt(12))
    return Fitted(
        middle,
        middle_std,
        2 * step * total,
        2 * step * std,
        width,
        f[0] - step / 2,
        f[-1] + step / 2,
    )


def _until_quiet(over: np.ndarray) -> int:
    """Places from the peak to the last one above the noise, before ``QUIET`` that are not."""
    last = 0
    for i, high in enumerate(over):
        if high:
            last = i
        elif i - last >= QUIET:
            break
    return last
