"""The measured speed of a recording: its standard deviation, and whether the forces agree."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.recording import Recording
from pyimu.units import parse

SPEED_STD = 0.05
"""m/s; of a recorded speed that comes without a standard deviation."""

SIGMAS = 5.0
"""Standard errors by which the forces must contradict the sign of the speed."""

SPAN = 1.0
"""s; over which forces, rates and speeds are averaged before they are compared."""

LEAST_SPANS = 10
"""Of these, fewer than which say nothing."""


LEANS = 1.25
"""By which factor the forces may contradict the size of a speed: a body that leans in turns, and
squats where it speeds up, feels a share of gravity that grows with them."""

UNITS = {name: parse(name).factor for name in ("m/s", "km/h", "kn", "mph", "cm/s", "mm/s")}
"""m/s; one of the units in which speeds are logged."""


def recorded_speed(recording: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Speed (n,) and its standard deviation (n,) in m/s, NaN where there is none."""
    std = getattr(recording, "speed_std", None)
    return recording.speed, np.full(len(recording), SPEED_STD) if std is None else std


def speed_findings(recording: Recording) -> tuple[Finding, ...]:
    """A finding ``speed_sign`` or ``speed_unit`` where the forces contradict a vehicle's speed.

    A vehicle that turns at the rate w about its z axis has the force w v along y, and one that
    speeds up has v' along x: the regression of a force on that is 1, -1 for a speed of the wrong
    sign, and one over the ``factor`` by which a speed is too large. It is read ``as`` the units
    that the slope allows: errors of the speed make the slope too flat, others of the force that of
    the inverse regression, so that the right one is between the two.
    """
    if getattr(recording, "speed", None) is None or recording.accel is None:
        return ()
    slope = _along_the_forces(recording)
    if slope is None:
        return ()
    if slope.share + SIGMAS * slope.std <= 0 and slope.share <= -0.5:
        detail = {"share": slope.share, "std": slope.std}
        return (Finding("speed_sign", "speed", len(recording), detail),)
    low, high = slope.bounds
    if low <= LEANS and high >= 1 / LEANS:
        return ()
    stated = parse(recording.stated.get("speed", "m/s")).factor
    shares = {unit: one / stated for unit, one in UNITS.items()}
    middle = np.log(slope.share * slope.inverse) / 2
    fits = [unit for unit, share in shares.items() if low / LEANS < share < high * LEANS]
    fits.sort(key=lambda unit: abs(np.log(shares[unit]) - middle))
    found = {"factor": float(np.exp(-middle)), "as": " or ".join(fits)}
    return (Finding("speed_unit", "speed", len(recording), found),)


@dataclass(frozen=True)
class Slope:
    """The slope ``share`` of y over x with its standard error ``std``, and the ``inverse``.

    That is one over the slope of x over y, which has the standard error ``back``.
    """

    share: float
    std: float
    inverse: float
    back: float

    @property
    def bounds(self) -> tuple[float, float]:
        """Within which the slope is, whichever of x and y has the errors."""
        steepest = 1 / self.inverse - SIGMAS * self.back
        low = self.share - SIGMAS * self.std
        return (low, 1 / steepest) if low > 0 and steepest > 0 else (-np.inf, np.inf)


def _along_the_forces(r: Recording) -> Slope | None:
    """The regression of a force on what the speed lets expect of it.

    That across or that along the drive, whichever is known better: a ramp is in the second, too.
    """
    known = np.isfinite(r.speed)
    if np.count_nonzero(known) < 3:
        return None
    v = np.interp(r.time, r.time[known], r.speed[known])
    count = max(1, round((r.time[-1] - r.time[0]) / SPAN))
    if count < LEAST_SPANS:
        return None
    bounds = np.linspace(0, len(r) - 1, count + 1).astype(int)
    groups = [slice(a, max(b, a + 1)) for a, b in pairwise(bounds)]
    force, rate, speed = (
        np.array([np.nanmean(x[g], axis=0) for g in groups]) for x in (r.accel, r.gyro, v)
    )
    turned = (rate[:, 2] - np.nanmedian(rate[:, 2])) * speed
    pushed = np.diff(v[bounds]) / np.diff(r.time[bounds])
    both = (_regression(force[:, 1], turned), _regression(force[:, 0], pushed))
    there = [slope for slope in both if slope is not None]
    return min(there, key=lambda slope: slope.std / abs(slope.share), default=None)


def _regression(y: np.ndarray, x: np.ndarray) -> Slope | None:
    """The slope of y (n,) over x (n,) beside a constant; None where there is none."""
    good = np.isfinite(x) & np.isfinite(y)
    x, y = x[good] - x[good].mean(), y[good] - y[good].mean()
    xx, xy, yy = float(x @ x), float(x @ y), float(y @ y)
    if not (xx > 0 and yy > 0 and xy):
        return None
    left = yy - xy**2 / xx, xx - xy**2 / yy
    std, back = (np.sqrt(max(v, 0.0) / len(x) / of) for v, of in zip(left, (xx, yy), strict=True))
    return Slope(xy / xx, float(std), yy / xy, float(back))
