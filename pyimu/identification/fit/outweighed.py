"""Coefficients of which a noisy reference tells less than is known of any part.

Where a motion is smaller than the noise of its reference, the column of a scale factor is that
noise mostly. Taking it out leaves the slope with an error of many times its prior, and a fit that
weighs both by the column's power alone would follow the error.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.errors_in_variables import equations, has_noise, residual_changes
from pyimu.identification.fit.fit import Fit, Last, departure, stepped
from pyimu.identification.fit.noise_floor import own_noise
from pyimu.identification.fit.normal import variances
from pyimu.identification.fit.whiten import RandomWalk

MOSTLY = 0.5
"""Share of a column's power that is motion, below which it is noise mostly."""


def without_outweighed(fit: Fit, fitted: bool = True) -> Fit:
    """The fit with those coefficients at their identity, and no longer free; they keep their
    prior. Before anything was ``fitted`` what is left is motion, and no noise to weigh rows by:
    they are weighed by the noise of sensor and reference alone.
    """
    if not has_noise(fit) or not fit.prior:
        return fit
    normal = equations(fit if fitted else replace(fit, noise=_known_noise(fit), last=Last()))
    variance = variances(normal.gram, normal.variance)
    motion, seen = np.diag(normal.gram), np.diag(normal.seen)
    out = [
        key
        for key, std in fit.prior.items()
        if key in fit.free
        and (n := normal.position.get(key)) is not None
        and motion[n] < MOSTLY * seen[n]
        and variance[n] > std**2
    ]
    back = np.array([-departure(fit, k) for k in out])
    return replace(stepped(fit, out, back), free=fit.free.difference(out)) if out else fit


def _known_noise(fit: Fit) -> dict[int, RandomWalk]:
    """The white noise by axis, in rows of the band, that sensor and reference have."""
    share = np.mean([np.sum(np.square(t.band.weights)) for t in fit.trials])
    changes = [one.residual for one in residual_changes(fit)]
    theirs = np.mean(np.concatenate(changes) ** 2, axis=0)
    return {i: RandomWalk(float(n.r * share + theirs[i]), 0.0) for i, n in own_noise(fit).items()}
