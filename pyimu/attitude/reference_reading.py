"""Whether a reference attitude is in another order, or in other axes, than its columns say."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.error import AttitudeError, error_against, root_mean_square
from pyimu.errors import Finding
from pyimu.recording.reference.orders import other_readings
from pyimu.recording.turning import drawn

BETTER = 5.0
"""By which factor another reading must lower the error to be believed. Chance does not: of two
unlike attitudes one is as far off as the other."""

WINDOW = 10.0
"""s; over which the heading may be off: it drifts by the gyro's bias, in any order."""

MOST_ROWS = 20_000
"""Rows that are looked at."""


def reference_findings(
    time: np.ndarray, q: np.ndarray, reference: np.ndarray
) -> tuple[Finding, ...]:
    """A finding ``reference_order`` where ``reference`` (m, 4) fits as something else.

    ``time`` (m,) s and the estimated ``q`` (m, 4) are those of its rows; details are what it is
    read ``as`` then, and the ``rms`` rad of the error so.
    """
    if not len(time):
        return ()
    rows = drawn(len(time), MOST_ROWS)
    time, q, reference = time[rows], q[rows], reference[rows]
    stated = _rms(_error(time, q, reference))
    found = {n: _error(time, q, other) for n, other in other_readings(reference).items()}
    least = min(map(_rms, found.values()))
    if BETTER * least > stated:
        return ()
    # Of readings that are one but for rounding the first, which is the simplest.
    best = next(name for name, error in found.items() if _rms(error) <= 1.01 * least)
    detail = {"as": best, "rms": found[best].rms}
    return (Finding("reference_order", "ref_q", len(time), detail),)


def _error(time: np.ndarray, q: np.ndarray, reference: np.ndarray) -> AttitudeError:
    return error_against(time, q, Rotation.from_quat(reference, scalar_first=True))


def _rms(error: AttitudeError) -> float:
    return root_mean_square(error.in_windows(WINDOW).total)
