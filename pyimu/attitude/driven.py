"""The measured speed of a recording: its standard deviation, and whether the forces agree."""

from __future__ import annotations

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.recording import Recording

SPEED_STD = 0.05
"""m/s; of a recorded speed that comes without a standard deviation."""

SIGMAS = 5.0
"""Standard errors by which the forces must contradict the sign of the speed."""

SPAN = 1.0
"""s; over which forces, rates and speeds are averaged before they are compared."""

LEAST_SPANS = 10
"""Of these, fewer than which say nothing."""


def recorded_speed(recording: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Speed (n,) and its standard deviation (n,) in m/s, NaN where there is none."""
    std = getattr(recording, "speed_std", None)
    return recording.speed, np.full(len(recording), SPEED_STD) if std is None else std


def speed_findings(recording: Recording) -> tuple[Finding, ...]:
    """A finding ``speed_sign`` where the forces say that the vehicle drives the other way.

    A vehicle that turns at the rate w about its z axis has the force w v along y, and one that
    speeds up has v' along x: the regression of a force on that is 1, and -1 for a speed of the
    wrong sign.
    """
    if getattr(recording, "speed", None) is None or recording.accel is None:
        return ()
    share, std = _along_the_forces(recording)
    if share + SIGMAS * std > 0 or share > -0.5:
        return ()
    return (Finding("speed_sign", "speed", len(recording), {"share": share, "std": std}),)


def _along_the_forces(r: Recording) -> tuple[float, float]:
    """The regression of a force on what the speed lets expect of it, and its standard error.

    That across or that along the drive, whichever is known better: a ramp is in the second, too.
    """
    known = np.isfinite(r.speed)
    if np.count_nonzero(known) < 3:
        return 1.0, np.inf
    v = np.interp(r.time, r.time[known], r.speed[known])
    groups = np.array_split(np.arange(len(r)), max(1, round((r.time[-1] - r.time[0]) / SPAN)))
    if len(groups) < LEAST_SPANS:
        return 1.0, np.inf
    force, rate, speed, time = (
        np.array([np.nanmean(x[g], axis=0) for g in groups]) for x in (r.accel, r.gyro, v, r.time)
    )
    turned = (rate[:, 2] - np.nanmedian(rate[:, 2])) * speed
    both = (_regression(force[:, 1], turned), _regression(force[:, 0], np.gradient(speed, time)))
    return min(both, key=lambda found: found[1])


def _regression(y: np.ndarray, x: np.ndarray) -> tuple[float, float]:
    """The slope of y (n,) over x (n,) beside a constant, and its standard error."""
    good = np.isfinite(x) & np.isfinite(y)
    x, y = x[good] - x[good].mean(), y[good] - y[good].mean()
    if not x @ x > 0:
        return 1.0, np.inf
    share = float(x @ y / (x @ x))
    return share, float(np.sqrt(np.mean((y - share * x) ** 2) / (x @ x)))
