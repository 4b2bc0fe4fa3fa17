"""Coefficients of which a noisy reference tells less than is known of any part.

Where a motion is smaller than the noise of its reference, the column of a scale factor is that
noise mostly. Taking it out leaves the slope with an error of many times its prior, and a fit that
weighs both by the column's power alone would follow the error.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.errors_in_variables import equations, has_noise
from pyimu.identification.fit.fit import Fit, departure, stepped
from pyimu.identification.fit.normal import variances

MOSTLY = 0.5
"""Share of a column's power that is motion, below which it is noise mostly."""


def without_outweighed(fit: Fit) -> Fit:
    """The fit with those coefficients at their identity, and no longer free; they keep their
    prior.
    """
    if not has_noise(fit) or not fit.prior:
        return fit
    normal = equations(fit)
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
