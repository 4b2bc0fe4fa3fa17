"""The measured speed of a recording: how well it is known, and whether the forces agree."""

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

ASKEW = 0.1
"""rad; a larger angle between the body's x axis and where it drives is said: the velocity across is
then a tenth of the speed."""

UNITS = {name: parse(name).factor for name in ("m/s", "km/h", "kn", "mph", "cm/s", "mm/s")}
"""m/s; one of the units in which speeds are logged."""


def recorded_speed(recording: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Speed (n,) and its standard deviation (n,) in m/s, NaN where there is none."""
    std = getattr(recording, "speed_std", None)
    return recording.speed, np.full(len(recording), SPEED_STD) if std is None else std


def speed_findings(recording: Recording) -> tuple[Finding, ...]:
    """A finding ``speed_sign``, ``speed_axis`` or ``speed_unit`` where the forces contradict a
    vehicle's speed.

    A vehicle that turns at the rate w about its z axis has the force w v along y, and one that
    speeds up has v' along x: the regression of a force on that is 1, -1 for a speed of the wrong
    sign, and one over the ``factor`` by which a speed is too large. It is read ``as`` the units
    that the slope allows: errors of the speed make the slope too flat, others of the force that of
    the inverse regression, so that the right one is between the two. A body that drives along
    another axis has both forces turned, by the ``angle`` in rad to the left of x.
    """
    seen = _by_the_forces(recording)
    if seen is None:
        return ()
    slope, angle, std = seen
    if ASKEW < abs(angle) - SIGMAS * std and abs(angle) + SIGMAS * std < np.pi - ASKEW:
        return (Finding("speed_axis", "speed", len(recording), {"angle": angle, "std": std}),)
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


def speed_share(recording: Recording) -> float:
    """The share by which the forces show that the accelerations are others than the speed says.

    By its size, and by an angle between x axis and drive; 0 where they allow that both are right.
    """
    seen = _by_the_forces(recording)
    if seen is None:
        return 0.0
    slope, angle, std = seen
    allowed = slope.bounds[0] <= 1 <= slope.bounds[1]
    size = 0.0 if allowed else np.sqrt(slope.share * slope.inverse) - 1
    return float(np.hypot(size, angle if abs(angle) > SIGMAS * std else 0.0))


@dataclass(frozen=True)
class Expected:
    """Means over ``SPAN``: the ``force`` (n, 2) along and across in m/s^2, and the accelerations
    ``pushed`` and ``turned`` (n,) that the speed lets expect there.
    """

    force: np.ndarray
    pushed: np.ndarray
    turned: np.ndarray

    def slope(self) -> Slope | None:
        """The regression of a force on what is expected of it.

        That across or that along the drive, whichever is known better: a ramp is in the second,
        too.
        """
        along, across = self.force.T
        both = (_regression(across, self.turned), _regression(along, self.pushed))
        there = [slope for slope in both if slope is not None]
        return min(there, key=lambda slope: slope.std / abs(slope.share), default=None)

    def turned_by(self) -> tuple[float, float]:
        """The angle in rad from what is expected to the forces, and its standard error.

        It is that of the slope of two complex numbers, along and across their parts. Of a slope
        that is noise the angle may be any, and its error is then infinite.
        """
        seen = self.force[:, 0] + 1j * self.force[:, 1]
        told = self.pushed + 1j * self.turned
        good = np.isfinite(seen) & np.isfinite(told)
        seen, told = seen[good] - seen[good].mean(), told[good] - told[good].mean()
        size = float(np.sum(np.abs(told) ** 2))
        slope = np.sum(seen * told.conj()) / size
        left = np.mean(np.abs(seen - slope * told) ** 2) / 2
        std = float(np.sqrt(left / size) / np.abs(slope))
        return float(np.angle(slope)), std if SIGMAS * std < 1 else np.inf


def _by_the_forces(r: Recording) -> tuple[Slope, float, float] | None:
    """The slope of the forces on what the speed lets expect, and the angle between the two in rad
    with its standard error; None where the speed does not say.
    """
    expected = _expected(r)
    slope = None if expected is None else expected.slope()
    return None if expected is None or slope is None else (slope, *expected.turned_by())


def _expected(r: Recording) -> Expected | None:
    """What the speed lets expect of the forces, None where it does not say."""
    if getattr(r, "speed", None) is None or r.accel is None or r.gyro is None:
        return None
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
    return Expected(force[:, :2], pushed, turned)


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
