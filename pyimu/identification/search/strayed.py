"""By how much held-out squares rise because what was added is known only so well.

An effect changes b on held-out rows by its fitted coefficients and b0 by the true ones. It promises
to lower the sum of squares by b'b; beside noise n it lowers it by that less 2 b'(b - b0) - 2 b'n.
The first is drawn: of a line whose frequency is fitted the phase strays with time, and it is no
multiple of the coefficients' errors.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyimu.identification.fit.columns import in_band, residual
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, stepped, with_prior
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.normal import solve
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial

DRAWS = 32
"""Of the coefficients: the standard deviation is known to 1 in 8 then."""


def strayed(old: Fit, new: Fit, held: Sequence[Trial]) -> tuple[float, float]:
    """Mean and variance of 2 b'(b - b0), in squares of the sensor's unit, by the covariance that
    the fitted rows leave the coefficients that ``new`` has more than ``old``.
    """
    normal = with_prior(equations(new), new)
    more = sorted(k for k in new.free - old.free if isinstance(k, Coefficient))
    at = [normal.position[k] for k in more if k in normal.position]
    keys = [normal.keys[i] for i in at]
    trials = [t for t in held if t.reduction is None]
    if not keys or not trials:
        return 0.0, 0.0
    covariance = solve(normal.gram, np.eye(len(normal.keys)))[np.ix_(at, at)]
    values, vectors = np.linalg.eigh((covariance + covariance.T) / 2)
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    changes = np.random.default_rng(0).standard_normal((DRAWS, len(keys))) @ root.T
    others = [stepped(new, keys, change) for change in changes]
    total = np.zeros(DRAWS)
    for trial in trials:
        (before, _), (state, rest) = held_state(old, trial), held_state(new, trial)
        own = _left(new, rest, state)
        adds = _left(old, rest, before) - own
        total += [2.0 * float(np.sum(adds * (_left(f, rest, state) - own))) for f in others]
    return float(total.mean()), float(total.var(ddof=1))


def _left(fit: Fit, rest: Trial, state: LogState) -> np.ndarray:
    """Residual (m, 3) of held-out rows in their band."""
    return in_band(rest, residual(fit.sensor, rest, state))
