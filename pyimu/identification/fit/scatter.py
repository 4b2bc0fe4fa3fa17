"""How much the output of a sensor changes from one stretch of a log to the next beyond its white
noise: flicker, the strain of another position, what no coefficient describes.

It is estimated beside a model in which all that the rows can show first is free, so that an effect
which the model lacks is not taken for noise (as the full model's variance in Mallows 1973), and is
only as sure as the few rows that are left over make it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.linalg import block_diag, cho_factor, cho_solve, null_space
from scipy.special import logsumexp

from pyimu.identification.fit.fit import Fit, begin, gauss_newton
from pyimu.identification.fit.mixture import standard_error
from pyimu.identification.fit.normal import normal_equations
from pyimu.identification.fit.structure import prior_of, with_structure
from pyimu.identification.fit.trial import Trial
from pyimu.model.sensor import Sensor

STEPS = 8
"""Of Gauss and Newton, to the model beside which the wander is estimated."""

PRIOR_ROWS = 1.0
"""How many rows the typical wander weighs as much as: few, for parts differ."""

GRID = np.geomspace(1e-2, 1e4, 121)
"""Times the typical wander that are tried."""

RANK = 1e-6
"""Singular value of the scaled slopes below which a direction of coefficients is not shown."""


def weighed(trials: Sequence[Trial], sensor: Sensor, typical: float) -> list[Trial]:
    """The trials, whose ``wander`` is that of a ``typical`` sensor [its unit], with the wander that
    they show together.
    """
    sensor, free = with_structure(sensor)
    prior = prior_of(sensor, free)
    shapes = [t.reduction.wander / typical**2 for t in trials]
    for _ in range(2):
        fitted = gauss_newton(begin(sensor, free, trials, prior), STEPS)
        size = _wander(fitted, shapes, typical)
        trials = [scaled(t, size**2 * shape) for t, shape in zip(trials, shapes, strict=True)]
    return list(trials)


def scaled(trial: Trial, wander: np.ndarray) -> Trial:
    """The trial with another covariance ``wander`` (m, m)."""
    return replace(trial, reduction=replace(trial.reduction, wander=wander))


def _wander(fit: Fit, shapes: list[np.ndarray], typical: float) -> float:
    """The wander that the residual of a fit shows."""
    linears, each = fit.linearise(), [t.reduction for t in fit.trials]
    normal = normal_equations(linears, fit.noise)
    slopes, left = [], []
    for one, r in zip(linears, each, strict=True):
        full = np.zeros((len(one.time), len(normal.keys)))
        full[:, [normal.position[k] for k in one.keys[0]]] = r.root @ np.asarray(one.columns[0])
        slopes.append(full)
        left.append(r.root @ one.residual[:, 0])
    together = np.concatenate(slopes)
    together = together / np.maximum(np.linalg.norm(together, axis=0), 1e-300)
    over = null_space(together.T, rcond=RANK)
    known, unit = (
        over.T @ block_diag(*parts) @ over for parts in ([r.white + r.common for r in each], shapes)
    )
    usual = [np.diag(r.white) / np.diag(shape) for r, shape in zip(each, shapes, strict=True)]
    left_over = over.T @ np.concatenate(left)
    return _size(left_over, known, unit, float(np.median(np.concatenate(usual))), typical)


def _size(
    left: np.ndarray, known: np.ndarray, unit: np.ndarray, white: float, typical: float
) -> float:
    """The wander that gives intervals their length, given contrasts (d,) of rows
    in which no coefficient is left, with covariance ``known`` + wander^2 ``unit``.

    Its likelihood is that of Patterson and Thompson 1971; the prior is a scaled inverse chi-square.
    """
    tried = typical * GRID
    likely = np.array([_log_likelihood(left, known + s**2 * unit) for s in tried])
    prior = -PRIOR_ROWS * (np.log(GRID) + 0.5 / GRID**2)
    weight = np.exp(likely + prior - logsumexp(likely + prior))
    std = standard_error(weight, np.zeros(len(tried)), np.sqrt(white + tried**2))
    return float(np.sqrt(max(std**2 - white, tried[0] ** 2)))


def _log_likelihood(left: np.ndarray, covariance: np.ndarray) -> float:
    if not len(left):
        return 0.0
    factor = cho_factor(covariance, lower=True)
    determinant = 2 * float(np.sum(np.log(np.diag(factor[0]))))
    return -0.5 * (determinant + float(left @ cho_solve(factor, left)))
