"""Samples that firmware sets to zero where they are small: a dead zone of sensor or driver.

Phones and some gyros do so, that an orientation may stand still. Zeros in succession are no sensor
that hung then.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.errors import Finding

ZEROS = 20
"""Zeros of a column at least."""

DISTINCT = 4
"""Values between the least size and twice it, to a hundredth, at least: the zone is as many steps
wide. Of samples as coarse as the zone the least size is the step, and vectors of such steps have
sizes of 1, 1.41 and 1.73 of it, whatever the digits of a file make of them."""

FALSE_ALARMS = 1e-3
"""Probability of finding a zone where there is none."""


def least_size(values: np.ndarray) -> float | None:
    """The size below which samples (n,), or vectors (n, 3), are set to zero; None where none is."""
    found = zone(values)
    return None if found is None else found[0]


def zone(values: np.ndarray) -> tuple[float, float] | None:
    """The size below which samples (n,), or vectors (n, 3), are set to zero, and the log-likelihood
    [nat] by which they speak for that; None where none is.

    Where nothing is set to zero, of the samples up to twice a size a half is above it, of vectors
    seven eighths: their density is even about zero. That all of them are, and that zeros are there,
    is chance of that share to their number, but for the one by which the size was chosen.
    """
    known = values[np.isfinite(values).reshape(len(values), -1).all(axis=1)]
    size = np.abs(known) if values.ndim == 1 else np.linalg.norm(known, axis=1)
    above = size[size > 0]
    if len(size) - len(above) < ZEROS or not len(above):
        return None
    least = float(above.min())
    near = above[above < 2 * least]
    share = 0.5 if values.ndim == 1 else 7 / 8
    gain = -(len(near) - 1) * float(np.log(share))
    distinct = np.unique(np.round(near / least, 2))
    if np.exp(-gain) > FALSE_ALARMS or np.count_nonzero(distinct < 2) < DISTINCT:
        return None
    return least, gain


def zeroed_findings(name: str, values: np.ndarray) -> Iterator[Finding]:
    """A finding ``zeroed`` of the column or vector ``name``, with the ``least`` size that is not
    zero.
    """
    least = least_size(values)
    if least is not None:
        zeros = np.count_nonzero(np.all(values.reshape(len(values), -1) == 0, axis=1))
        yield Finding("zeroed", name, int(zeros), {"least": least})
