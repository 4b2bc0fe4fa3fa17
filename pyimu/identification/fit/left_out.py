"""Each row of a trial against what all the others predict of it.

With P = V^-1 - V^-1 X (X^T V^-1 X)^-1 X^T V^-1, of rows with covariance V and slopes X, a group of
rows misses the prediction of the rest by P_gg^-1 (P e)_g with covariance P_gg^-1 (Cook and Weisberg
1982, section 2.2, for V of any kind; Rasmussen and Williams 2006, eq. 5.12): the fit to the others,
to first order in the coefficients, without being made anew.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from pyimu.identification.fit.columns import linearise
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.normal import normal_equations, solve
from pyimu.identification.fit.scatter import wander_of, with_wander
from pyimu.identification.fit.score import ErrorSums, held_state
from pyimu.identification.fit.trial import Trial
from pyimu.model.sensor import Sensor

LEAST = 1e-6
"""Share of a row that the others must leave open; of one that alone shows a coefficient, nothing is
left to be judged by."""


@dataclass(frozen=True)
class LeftOut:
    """Of each row (m,) of a trial the error that the fit to the others leaves, NaN where these
    predict nothing, its variance, and how much of that white noise and wander make; ``along``
    (m, 3) is the direction of the error.
    """

    error: np.ndarray
    variance: np.ndarray
    white: np.ndarray
    wander: np.ndarray
    along: np.ndarray

    @property
    def log_likelihood(self) -> float:
        """Of the errors that can be judged [nat], row by row."""
        terms = self.error**2 / self.variance + np.log(2 * np.pi * self.variance)
        return -0.5 * float(np.nansum(terms))

    def sums(self, squares: np.ndarray) -> ErrorSums:
        """Sums of ``squares`` (m,) by axis, each row counted once, where its direction lies."""
        share = self.along**2 * np.isfinite(self.error)[:, None]
        return ErrorSums(share.T @ np.nan_to_num(squares), share.sum(axis=0))


def left_out(fit: Fit, trial: Trial) -> LeftOut:
    """The errors of a trial's rows, each judged by a fit to the others.

    Of a log that was not fitted only what belongs to the log is estimated. The rows of one that was
    wander as they do in the fit.
    """
    fitted, state = trial.name in fit.states, held_state(fit, trial)[0]
    if fitted:
        trial = with_wander(trial, wander_of(fit.trials[0]))
    linear = linearise(fit.sensor, trial, state, fit.free if fitted else ())
    together = fit.linearise() if fitted else [linear]
    normal = normal_equations(together, fit.noise)
    normal = with_prior(normal, fit) if fitted else normal
    rows = trial.rows(fit.sensor, state.bias)
    slopes = np.zeros((len(linear.time), len(normal.keys)))
    slopes[:, [normal.position[k] for k in linear.keys[0]]] = np.asarray(linear.columns[0])
    taken = slopes @ solve(normal.gram, slopes.T)
    root = trial.reduction.root
    left = linear.residual[:, 0] - slopes @ solve(normal.gram, normal.score)
    open_ = _unwhitened(root, _unwhitened(root, np.eye(len(root)) - taken).T)
    return _judged(trial, open_, _unwhitened(root, left), rows.along)


def _unwhitened(root: np.ndarray, values: np.ndarray) -> np.ndarray:
    return solve_triangular(root, values, lower=True, trans="T")


def _judged(trial: Trial, open_: np.ndarray, left: np.ndarray, along: np.ndarray) -> LeftOut:
    """``open_`` is P and ``left`` P e of the trial's rows."""
    r = trial.reduction
    out = np.full((4, len(left)), np.nan)
    for g in np.unique(r.group):
        at = np.flatnonzero(r.group == g)
        least = LEAST / np.diag(r.white + r.wander + r.common)[at]
        values, vectors = np.linalg.eigh(open_[np.ix_(at, at)])
        if values.min() < least.min():
            continue
        inverse = vectors / values @ vectors.T
        gain = inverse @ open_[at]
        parts = (gain @ part @ gain.T for part in (r.white, r.wander))
        out[:, at] = [inverse @ left[at], np.diag(inverse), *map(np.diag, parts)]
    return LeftOut(*out, along)


def as_measured(trial: Trial) -> np.ndarray:
    """The errors (m,) of a trial's rows with the sensor's output taken as it is, less a bias that
    is plain.
    """
    return trial.rows(Sensor(trial.kind), trial.reduction.bias).residual
