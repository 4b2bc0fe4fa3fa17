"""The samples that attitudes were interpolated from along a spline, where these are every second to
tenth row.

A spline has no jumps of the rate by which ``nodes`` finds samples. But the rows between are made of
them: a spline through the right rows leaves nothing of the others, one through any other rows what
lies between. Of a smooth motion every row is as good as any, and nothing is found.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.spatial.transform import Rotation

RATIOS = range(10, 1, -1)
"""Rows to a sample, the most first: a spline is one through more of its own rows, too."""

ROWS = 800
"""Rows in which the samples are looked for, and again elsewhere."""

ENDS = 12
"""Samples at either end in which a spline knows too little, or other ends than ours."""

FIRST, NOTHING = 0.2, 0.02
"""Share of what the other rows leave, of which the right ones leave less: by a spline that is
nearly the one that was taken, and by that one itself."""

Curve = Callable[[np.ndarray, Rotation, np.ndarray], Rotation]


def every(time: np.ndarray, attitude: Rotation) -> tuple[int, int] | None:
    """The first row, and rows from one sample to the next, of those in n attitudes at evenly spaced
    ``time`` (n,) s; None where there are none.
    """
    found = {_in_rows(time[a:b], attitude[a:b], a) for a, b in _sections(time, attitude)}
    return found.pop() if len(found) == 1 else None


def _sections(time: np.ndarray, attitude: Rotation) -> list[tuple[int, int]]:
    """The liveliest rows of either half of a log."""
    step = np.linalg.norm((attitude[:-1].inv() * attitude[1:]).as_rotvec(), axis=1)
    half, found = len(time) // 2, []
    count = min(ROWS, half - 1)
    for a in (0, half):
        power = np.append(0.0, np.cumsum(np.diff(step[a : a + half - 1]) ** 2))
        first = a + int(np.argmax(power[count - 1 :] - power[: len(power) - count + 1]))
        found.append((first, first + count))
    return found


def _in_rows(time: np.ndarray, attitude: Rotation, first: int) -> tuple[int, int] | None:
    for ratio in RATIOS:
        if len(time) < 4 * ENDS * ratio:
            continue
        phase = _phase(time, attitude, ratio, _along_quaternions, FIRST)
        if phase is not None:
            for curve in (_along_rotations, _along_quaternions):
                if _phase(time, attitude, ratio, curve, NOTHING) == phase:
                    return (first + phase) % ratio, ratio
    return None


def _phase(
    time: np.ndarray, attitude: Rotation, ratio: int, curve: Curve, share: float
) -> int | None:
    """The first of the rows from which a curve makes the others, None where no rows do so."""
    left = [_left(time, attitude, slice(p, None, ratio), curve) for p in range(ratio)]
    best = int(np.argmin(left))
    others = float(np.median(np.delete(left, best)))
    return best if left[best] < share * others else None


def _left(time: np.ndarray, attitude: Rotation, at: slice, curve: Curve) -> float:
    """Root mean square rad of what a curve through some rows leaves of the others."""
    own = time[at]
    inside = (time > own[ENDS]) & (time < own[-ENDS])
    made = curve(own, attitude[at], time[inside])
    return float(np.sqrt(np.mean((made.inv() * attitude[inside]).magnitude() ** 2)))


def _along_quaternions(own: np.ndarray, attitude: Rotation, time: np.ndarray) -> Rotation:
    from scipy.interpolate import CubicSpline  # a tenth of a second, and few logs need it

    q = attitude.as_quat()
    turned = np.append(False, np.sum(q[1:] * q[:-1], axis=1) < 0)
    q = np.where((np.cumsum(turned) % 2 == 1)[:, None], -q, q)
    return Rotation.from_quat(CubicSpline(own, q)(time))


def _along_rotations(own: np.ndarray, attitude: Rotation, time: np.ndarray) -> Rotation:
    from scipy.spatial.transform import RotationSpline

    return RotationSpline(own, attitude)(time)
