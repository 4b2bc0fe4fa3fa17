r"""Warm-up: a bias that dies away after power-on, y = b + A exp(-t / tau), told from a random walk
by generalised least squares.

Means over blocks are regressed on a constant and the exponential in white noise and a random walk,
which are found with them (``walk``), for time constants from a hundredth to a third of the record;
the most significant one counts, times their number, and is then refined.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

from pyimu.characterization.temperature.averages import Blocks
from pyimu.characterization.temperature.regression import Regression, regress

BLOCKS = 200
CONSTANTS = np.geomspace(0.01, 0.33, 12)
"""Time constants, shares of the record."""

CHANCE = 1e-3
"""Probability of finding it where there is none."""

LEAST_SHARE = 0.05
"""A warm-up whose part of the variance of the means is below this is not worth a word."""


@dataclass(frozen=True)
class WarmUp:
    """A (``amplitude``, with standard error) in the samples' unit, ``tau`` s, and what is drawn:
    block means (m,) at ``time`` s and the fit.
    """

    amplitude: float
    std: float
    tau: float
    p_value: float
    time: np.ndarray
    means: np.ndarray
    fitted: np.ndarray

    def effect(self, time: np.ndarray) -> np.ndarray:
        """What is left of it (n,) at times (n,) s from its start."""
        return self.amplitude * np.exp(-np.asarray(time, dtype=float) / self.tau)


def _height(fit: Regression) -> float:
    """Of the exponential, in standard errors."""
    return float(abs(fit.mean[0]) / np.sqrt(fit.covariance[0, 0]))


def find_warm_up(column: np.ndarray, h: float) -> WarmUp | None:
    """The warm-up in samples (n,) without gap every ``h`` s, None where there is none or the record
    is shorter than two samples a block.
    """
    length = len(column) // BLOCKS
    if length < 2:
        return None
    means = column[: BLOCKS * length].reshape(BLOCKS, length).mean(axis=1)
    span = BLOCKS * length * h
    time = (np.arange(BLOCKS) + 0.5) / BLOCKS
    blocks = Blocks(time * span, np.zeros(BLOCKS), means[:, None], np.full(BLOCKS, length), h)

    def fit(constant: float) -> Regression:
        return regress(blocks, means, np.column_stack([np.exp(-time / constant), np.ones(BLOCKS)]))

    heights = [_height(fit(constant)) for constant in CONSTANTS]
    best = int(np.argmax(heights))
    above = fit(CONSTANTS[best]).tail(0, 0.0)
    p_value = min(2 * min(above, max(1 - above, 0.0)) * len(CONSTANTS), 1.0)
    if p_value > CHANCE:
        return None
    ends = np.log(CONSTANTS[[max(best - 1, 0), min(best + 1, len(CONSTANTS) - 1)]])
    constant = float(
        np.exp(
            minimize_scalar(
                lambda v: -_height(fit(np.exp(v))),
                bounds=ends,
                method="bounded",
                options={"xatol": 0.01},
            ).x
        )
    )
    refined = fit(constant)
    (amplitude, bias), std = refined.mean, float(np.sqrt(refined.covariance[0, 0]))
    fitted = bias + amplitude * np.exp(-time / constant)
    if np.var(fitted) < LEAST_SHARE * np.var(means):
        return None
    return WarmUp(
        float(amplitude), std, float(constant * span), float(p_value), time * span, means, fitted
    )
