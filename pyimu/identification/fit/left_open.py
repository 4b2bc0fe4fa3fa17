"""What coefficients that the fitted rows hardly show may add to the error on those held out.

An axis that turns in the held-out rows alone has the scale factor there that was thought likely
before any row was seen: of the error that this leaves, nothing is to be blamed on the model.
"""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.columns import linearise
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Key
from pyimu.identification.fit.normal import covariance
from pyimu.identification.fit.score import ErrorSums, held_state, sums
from pyimu.identification.fit.trial import Trial


def left_open(fit: Fit, trial: Trial) -> ErrorSums:
    """Sums over the rows of a held-out trial of the squares that the coefficients which nobody
    declared are expected to add to them: by what the fitted rows leave open of them, or, of those
    that they do not show, by their prior.
    """
    state, rest = held_state(fit, trial)
    keys, unsure = _left(fit)
    values, vectors = np.linalg.eigh(unsure)
    spread = vectors * np.sqrt(np.maximum(values, 0.0))
    linear = linearise(fit.sensor, rest, state, frozenset(keys))
    each = [sums(rest, _rows(linear, keys, direction)) for direction in spread.T]
    squares = (sum(getattr(e, name) for e in each) for name in ("squares", "angle_squares"))
    return ErrorSums(next(squares), each[0].rows, next(squares), each[0].windows)


def _left(fit: Fit) -> tuple[list[Key], np.ndarray]:
    """The coefficients that have a prior, and their covariance."""
    normal = with_prior(equations(fit), fit)
    seen = normal.variance if normal.seen is not None else None
    keys = sorted(fit.prior)
    shown = [n for n, k in enumerate(keys) if k in normal.position]
    at = [normal.position[keys[n]] for n in shown]
    out = np.diag([fit.prior[k] ** 2 for k in keys])
    out[np.ix_(shown, shown)] = covariance(normal.gram, seen)[np.ix_(at, at)]
    return keys, out


def _rows(linear, keys: list[Key], change: np.ndarray) -> np.ndarray:
    """What a ``change`` of the coefficients ``keys`` makes of a trial's rows (m, 3)."""
    by_key, out = dict(zip(keys, change, strict=True)), np.zeros(linear.residual.shape)
    for i, stack in linear.columns.items():
        for key, column in zip(linear.keys[i], stack.arrays, strict=True):
            out[:, i] += by_key.get(key, 0.0) * column
    return out
