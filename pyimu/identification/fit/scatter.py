"""How much the output of a sensor changes from one stretch of a log to the next beyond its white
noise: flicker, the strain of another position, what no coefficient describes.

It is estimated beside a model in which all that the rows can show first is free, so that an effect
which the model lacks is not taken for noise (as the full model's variance in Mallows 1973), and is
only as sure as the few rows that are left over make it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import block_diag, cho_factor, cho_solve, null_space
from scipy.special import logsumexp

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import WANDERS_LESS, Fit, Last, begin, gauss_newton
from pyimu.identification.fit.mixture import standard_error
from pyimu.identification.fit.normal import normal_equations
from pyimu.identification.fit.structure import prior_of, with_structure
from pyimu.identification.fit.trial import Trial
from pyimu.model.sensor import Sensor
from pyimu.model.typical import CLASSES, magnitudes
from pyimu.numerics.laws import beta, chi2
from pyimu.symbolic.earth import EARTH_RATE

WANDER = "bias_instability"
"""The effect whose typical size a sensor's output wanders by from rest to rest."""

STEPS = 8
"""Of Gauss and Newton, to the model beside which the wander is estimated."""

PRIOR_ROWS = 1.0
"""How many rows the typical wander weighs as much as: few, for parts differ."""

GRID = np.geomspace(1e-2, 1e4, 121)
"""Times the typical wander that are tried."""

LEAST_CHANCE = 1e-300
"""Probability below which a gain by chance is not told from a smaller one."""

RANK = 1e-6
"""Singular value of the scaled slopes below which a direction of coefficients is not shown."""


def typical_wander(kind: str) -> float:
    """By how much a consumer part wanders from rest to rest [SI].

    A gyro's output follows the Earth's rate, too, whose direction nobody knows.
    """
    own = magnitudes(WANDER, kind)[CLASSES[-1]].si
    return float(np.hypot(own, EARTH_RATE)) if kind == "gyro" else own


def weighed(trials: Sequence[Trial], sensor: Sensor) -> list[Trial]:
    """The trials with the wander that they show together."""
    sensor, free = with_structure(sensor)
    prior = prior_of(sensor, free)
    for _ in range(2):
        fitted = gauss_newton(begin(sensor, free, trials, prior), STEPS)
        trials = list(reweighed(fitted).trials)
    return list(trials)


def reweighed(fit: Fit) -> Fit:
    """The model beside the wander that it leaves."""
    size, _ = _wander(_Contrasts.of(fit), fit.sensor.kind)
    return replace(fit, trials=tuple(with_wander(t, size) for t in fit.trials), last=Last())


def with_wander(trial: Trial, size: float) -> Trial:
    """The trial, each of whose rows wanders by ``size`` [the sensor's unit]."""
    wander = size**2 * np.eye(len(trial.reduction.wander))
    return replace(trial, reduction=replace(trial.reduction, wander=wander))


def with_less_wander(fit: Fit) -> Fit:
    """The model beside less wander than it leaves: an effect that is missing is taken for it."""
    trials = (with_wander(t, WANDERS_LESS * wander_of(t)) for t in fit.trials)
    return replace(fit, trials=tuple(trials), last=Last())


def wander_of(trial: Trial) -> float:
    """By how much each row of a trial wanders."""
    return float(np.sqrt(trial.reduction.wander[0, 0]))


def explained_beside_wander(larger: Fit, smaller: Fit, coefficients: int) -> float:
    """Log-likelihood [nat] that ``coefficients`` of a ``larger`` model gain over a ``smaller`` one,
    the wander of each as it leaves it.

    So few rows hardly know their wander, and chance gains more by it than where noise is known:
    given is what as likely a gain amounts to there (the test of a share of a sum of squares: Seber
    and Lee 2003, "Linear Regression Analysis", chapter 4).
    """
    was, now = _Contrasts.of(smaller), _Contrasts.of(smaller, larger)
    count = len(was.left)
    if count <= coefficients:
        return 0.0
    kind = smaller.sensor.kind
    apart = max(0.0, _wander(now, kind)[1] - _wander(was, kind)[1])
    shape = coefficients / 2, (count - coefficients) / 2
    chance = max(float(beta.sf(-np.expm1(-2 * apart / count), *shape)), LEAST_CHANCE)
    return 0.5 * float(chi2.isf(chance, coefficients))


@dataclass(frozen=True)
class _Contrasts:
    """Contrasts of rows in which none of a model's coefficients is left: what is ``left`` (d,) in
    them, and the covariance (d, d) that is ``known`` of them, and of ``unit`` wander; ``white`` is
    the variance of a row.
    """

    left: np.ndarray
    known: np.ndarray
    unit: np.ndarray
    white: float

    @classmethod
    def of(cls, fit: Fit, other: Fit | None = None) -> _Contrasts:
        """Those of a fit, and what is left in them by the ``other`` model, if there is one."""
        linears, each = fit.linearise(), [t.reduction for t in fit.trials]
        over = _over(linears, fit)
        known, unit = (
            over.T @ block_diag(*parts) @ over
            for parts in (
                [r.white + r.common for r in each],
                [np.eye(len(r.white)) for r in each],
            )
        )
        fitted = fit if other is None else other
        pairs = zip(fitted.residuals(), fitted.trials, strict=True)
        left = np.concatenate([t.reduction.root @ one.residual[:, 0] for one, t in pairs])
        white = float(np.median(np.concatenate([np.diag(r.white) for r in each])))
        return cls(over.T @ left, known, unit, white)


def _over(linears: Sequence[Linear], fit: Fit) -> np.ndarray:
    """Contrasts (m, d) of all rows of a fit that no coefficient changes."""
    normal = normal_equations(linears, fit.noise)
    slopes = []
    for one, trial in zip(linears, fit.trials, strict=True):
        full = np.zeros((len(one.time), len(normal.keys)))
        columns = trial.reduction.root @ np.asarray(one.columns[0])
        full[:, [normal.position[k] for k in one.keys[0]]] = columns
        slopes.append(full)
    together = np.concatenate(slopes)
    together = together / np.maximum(np.linalg.norm(together, axis=0), 1e-300)
    return null_space(together.T, rcond=RANK)


def _wander(seen: _Contrasts, kind: str) -> tuple[float, float]:
    """The wander that gives intervals their length, and the largest likelihood [nat] of any.

    The likelihood is that of Patterson and Thompson 1971; the prior is a scaled inverse chi-square.
    """
    typical = typical_wander(kind)
    tried = typical * GRID
    likely = np.array([_log_likelihood(seen.left, seen.known + s**2 * seen.unit) for s in tried])
    likely -= PRIOR_ROWS * (np.log(GRID) + 0.5 / GRID**2)
    weight = np.exp(likely - logsumexp(likely))
    std = standard_error(weight, np.zeros(len(tried)), np.sqrt(seen.white + tried**2))
    return float(np.sqrt(max(std**2 - seen.white, tried[0] ** 2))), float(likely.max())


def _log_likelihood(left: np.ndarray, covariance: np.ndarray) -> float:
    if not len(left):
        return 0.0
    factor = cho_factor(covariance, lower=True)
    determinant = 2 * float(np.sum(np.log(np.diag(factor[0]))))
    return -0.5 * (determinant + float(left @ cho_solve(factor, left)))
