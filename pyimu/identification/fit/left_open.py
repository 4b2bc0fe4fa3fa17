"""What coefficients that the fitted rows hardly show may add to the error on those held out.

An axis that turns in the held-out rows alone has the scale factor there that was thought likely
before any row was seen: of the error that this leaves, nothing is to be blamed on the model.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import Linear, linearise
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, carried, with_prior
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.normal import covariance
from pyimu.identification.fit.score import ErrorSums, held_state, sums
from pyimu.identification.fit.trial import Trial

Open = tuple[list[Coefficient], np.ndarray]
"""Coefficients, and changes of them (k, k) that make up what is not known of them: their covariance
is the sum of the squares of its columns."""


def what_is_open(fit: Fit) -> Open:
    """Of the coefficients of a model that nobody declared what the fitted rows leave open, or, of
    those that they do not show, their prior.
    """
    normal = with_prior(equations(fit), fit)
    seen = normal.variance if normal.seen is not None else None
    keys = sorted(fit.prior)
    shown = [n for n, k in enumerate(keys) if k in normal.position]
    at = [normal.position[keys[n]] for n in shown]
    out = np.diag([fit.prior[k] ** 2 for k in keys])
    out[np.ix_(shown, shown)] = covariance(normal.gram, seen)[np.ix_(at, at)]
    values, vectors = np.linalg.eigh(out)
    return keys, vectors * np.sqrt(np.maximum(values, 0.0))


def left_open(fit: Fit, trial: Trial, unsure: Open) -> ErrorSums:
    """Sums over the rows of a held-out trial of the squares that coefficients which are ``unsure``
    are expected to add to them.
    """
    keys, spread = unsure
    state, rest = held_state(fit, trial)
    rows = _bare(fit, rest, state, keys)
    # What they add to the rows from which the bias of a log of its own is known is in that.
    own = trial.parent is None and trial.reduction is None
    head = _bare(fit, trial.head()[0], state, keys) if own else None
    each = []
    for change in spread.T:
        added = carried(rows, keys, change).residual
        if head is not None and len(head.residual):
            added = added - carried(head, keys, change).residual.mean(axis=0)
        each.append(sums(rest, added))
    squares = (sum(getattr(e, name) for e in each) for name in ("squares", "angle_squares"))
    return ErrorSums(next(squares), each[0].rows, next(squares), each[0].windows)


def _bare(fit: Fit, trial: Trial, state: LogState, keys: list[Coefficient]) -> Linear:
    """The rows of a trial as coefficients change them, and nothing else."""
    linear = linearise(fit.sensor, trial, state, frozenset(keys))
    return replace(linear, residual=np.zeros(linear.residual.shape))
