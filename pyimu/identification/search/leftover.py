"""What remains once no effect of the catalogue helps: dependence on inputs (looked for by
``formula.search``), more noise than declared.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.whiten import RandomWalk, power_less_bias

DRIFT_GATE = 5.0
"""Log-likelihood [nat] by which a larger random walk must beat the declared one on some axis: 1 %
in three one-sided tests."""


@dataclass(frozen=True)
class Unexplained:
    """A term of inputs on which a residual depends although no effect of the model says so.

    Or the ``shape`` of what is random in it, which is no effect either.
    """

    sensor: str
    axis: str
    depends_on: tuple[str, ...]
    p_value: float
    shape: str = ""

    def as_dict(self) -> dict[str, Any]:
        return asdict(self) | {"depends_on": list(self.depends_on)}


@dataclass(frozen=True)
class NoiseFigure:
    """N and K of one axis with their standard errors (SI)."""

    N: float
    N_std: float
    K: float
    K_std: float


def noise_figures(fit: Fit) -> dict[int, NoiseFigure] | None:
    """White noise and random walk of each axis as the residual shows them; None where the reference
    was differentiated.
    """
    if any(not isinstance(n, RandomWalk) for n in fit.seen.values()):
        return None
    h, rows, residuals = fit.trials[0].h, sum(t.count for t in fit.trials), fit.residuals()
    return {
        i: NoiseFigure(
            np.sqrt(n.r * h), np.sqrt(n.r * h / (2 * rows)), np.sqrt(n.k2), _k_std(residuals, i, n)
        )
        for i, n in fit.seen.items()
    }


def _k_std(residuals: list[Linear], axis: int, noise: RandomWalk) -> float:
    """Standard error of K from the curvature of the likelihood in log K; infinite where it is
    flat.
    """
    if noise.k2 == 0.0:
        return np.inf
    step = 0.2
    low, mid, high = (
        axis_likelihood(residuals, axis, RandomWalk(noise.r, noise.k2 * np.exp(2 * d)))
        for d in (-step, 0.0, step)
    )
    curvature = (2 * mid - low - high) / step**2
    return float(np.sqrt(noise.k2 / curvature)) if curvature > 0 else np.inf


def axis_likelihood(residuals: list[Linear], axis: int, noise: RandomWalk) -> float:
    """Log-likelihood [nat] of one axis of the residuals under a noise, with the bias of each log
    that suits it best.
    """
    total = 0.0
    for one in residuals:
        white = noise.whiten(
            np.column_stack([one.residual[:, axis], np.ones(len(one.time))]), one.time, one.segments
        )
        total -= 0.5 * (power_less_bias(white) + noise.log_det(one.time, one.segments))
    return total


def walk_gain(fit: Fit, declared: np.ndarray) -> np.ndarray:
    """Log-likelihood [nat] by which the fitted random walk beats the declared one on each axis,
    (3,).
    """
    residuals, out = fit.residuals(), np.full(3, np.nan)
    for i, n in fit.seen.items():
        out[i] = axis_likelihood(residuals, i, n) - axis_likelihood(
            residuals, i, RandomWalk(n.r, float(declared[i] ** 2))
        )
    return out


def drift(fit: Fit, declared_k: np.ndarray) -> dict[int, float]:
    """Axes on which the random walk is larger than declared beyond chance, and the gain [nat] of
    letting it be.
    """
    gain = walk_gain(fit, declared_k)
    return {
        i: float(gain[i])
        for i, n in fit.seen.items()
        if n.k2 > declared_k[i] ** 2 and gain[i] > DRIFT_GATE
    }
