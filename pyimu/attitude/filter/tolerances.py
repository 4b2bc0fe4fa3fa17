"""What the tolerances of a part mean for the attitude filter, which knows the part and no specimen.

A tolerance says of a coefficient how far specimens lie from the part. The filter starts with the
gyro's bias as unsure as that, believes the sizes of gravity that specimens measure, says how far
their accelerometers tilt the attitude, and adds noise for the share of the rate that is wrong.
"""

from __future__ import annotations

import numpy as np

from pyimu.attitude.filter.variables import USUAL
from pyimu.model.part import Part
from pyimu.units import STANDARD_GRAVITY

TURN_TIME = 1.0
"""s; how long a body turns one way, by hand or on wheels. A rate that is wrong by its share s is
wrong by s w T after a turn of T at the rate w; noise of density s^2 T w^2 has that variance. So has
a bias that differs by s g from axis to axis, and turns on to another by the angle w T."""

BELIEVED = 3.0
"""Standard deviations of the size of gravity among specimens that ``gravity_tolerance`` allows."""


def start_values(part: Part, warmer: float = 0.0) -> dict[str, float]:
    """Parameters of the filter by name, for any specimen of a part; nothing without tolerances.

    ``warmer`` K is how far the temperature is from that at which the part has no thermal error.
    """
    if not part.tolerances:
        return {}
    gravity = gravity_std(part, warmer)
    bias = np.hypot([USUAL[f"std0[{i}]"] for i in (4, 5, 6)], bias_std(part, warmer))
    return {
        **{f"std0[{i + 4}]": float(v) for i, v in enumerate(bias)},
        "gravity_tolerance": USUAL["gravity_tolerance"] + BELIEVED * gravity,
        "accel_bias_std": accel_bias_std(part, warmer),
        "rate_noise": rate_share(part, warmer) * TURN_TIME**0.5,
        "scale_std": scale_std(part, warmer),
        "axes_std": axes_std(part, warmer),
        "bias_noise": float(np.sqrt(np.mean(_by_force(part) ** 2) * TURN_TIME)),
    }


REAL = {"accel_std": 0.01, "motion_share": 1.0}
"""Parameters of a filter of real sensors."""


def of_motion(rate_noise: float) -> dict[str, float]:
    """The parameters that say of what motion looks like, of a filter with this ``rate_noise``.

    Where something of the gyro is left out of the model, so it is of the accelerometer, and what
    that makes of motion lasts: an error turns with the body, a scale factor rectifies what shakes.
    On recordings 02, 11 and 26 of BROAD a share that the run shows makes the tilt too sure.
    """
    return REAL if rate_noise > 0 else {n: USUAL[n] for n in REAL}


def bias_std(part: Part, warmer: float = 0.0) -> np.ndarray:
    """Standard deviation (3,) rad/s of the gyro's bias among specimens, level and at rest."""
    own, thermal = (_std(part, "gyro", *k) for k in (TURN_ON, THERMAL))
    return np.sqrt(own**2 + (thermal * warmer) ** 2 + _by_force(part)[:, 2] ** 2)


def bias_walk(part: Part, warming: float) -> np.ndarray:
    """Strength (3,) in rad/s/sqrt(s) of a random walk that the gyro's bias has in a specimen whose
    temperature walks by ``warming`` K/sqrt(s).
    """
    return _std(part, "gyro", *THERMAL) * warming


def gravity_std(part: Part, warmer: float = 0.0) -> float:
    """Standard deviation m/s^2, among specimens, of what an upright accelerometer measures of the
    Earth's gravity, by its bias and its scale factor.
    """
    return float(
        np.hypot(_bias(part, warmer)[2], _scale(part, "accel", warmer)[2] * STANDARD_GRAVITY)
    )


def accel_bias_std(part: Part, warmer: float = 0.0) -> float:
    """Standard deviation m/s^2, among specimens, of what an accelerometer at rest measures across
    gravity; the root mean square over attitudes and axes.

    Beside the bias that is the share of gravity that an axis sees of another, and half the
    difference of two scale factors s_i and s_j at (s_i - s_j) g sin(2 a) / 2: over all angles a an
    eighth of the variance of the difference, a quarter of that of a scale factor.
    """
    bias, scale = _bias(part, warmer), _scale(part, "accel", warmer) * STANDARD_GRAVITY
    seen = _std(part, "accel", *MISALIGNED, shape=(3, 3)) * STANDARD_GRAVITY
    return float(np.sqrt(np.mean(bias**2 + scale**2 / 4) + np.sum(seen**2) / 6))


def rate_share(part: Part, warmer: float = 0.0) -> float:
    """Standard deviation, among specimens, of the share of the rate that is wrong about an axis.

    That of its own scale factor, and of two others' misalignment.
    """
    own, others = _scale(part, "gyro", warmer), _std(part, "gyro", *MISALIGNED, shape=(3, 3))
    return float(np.sqrt(np.mean(own**2) + np.sum(others**2) / 3))


def scale_std(part: Part, warmer: float = 0.0) -> float:
    """Standard deviation, among specimens, of the gyro's scale factor; the mean of its axes."""
    return float(np.sqrt(np.mean(_scale(part, "gyro", warmer) ** 2)))


def axes_std(part: Part, warmer: float = 0.0) -> float:
    """Standard deviation in rad, among specimens, of the angle about a horizontal axis between the
    vertical of an accelerometer at rest and the axis about which the gyro says that it turns.
    """
    others = _std(part, "gyro", *MISALIGNED, shape=(3, 3))
    tilted = accel_bias_std(part, warmer) / STANDARD_GRAVITY
    return float(np.hypot(tilted, np.sqrt(np.sum(others**2) / 6)))


TURN_ON, THERMAL = ("turn_on_bias", "b0"), ("thermal_bias", "kT")
SCALE, THERMAL_SCALE = ("scale_factor", "s"), ("thermal_scale_factor", "kS")
MISALIGNED = ("misalignment", "m")


def _by_force(part: Part) -> np.ndarray:
    """Standard deviation (3, 3) rad/s of the gyro's bias by gravity along each axis."""
    return _std(part, "gyro", "g_sensitivity", "G", shape=(3, 3)) * STANDARD_GRAVITY


def _bias(part: Part, warmer: float) -> np.ndarray:
    """Standard deviation (3,) m/s^2 of the accelerometer's bias."""
    return np.hypot(_std(part, "accel", *TURN_ON), _std(part, "accel", *THERMAL) * warmer)


def _scale(part: Part, kind: str, warmer: float) -> np.ndarray:
    """Standard deviation (3,) of a sensor's scale factor."""
    return np.hypot(_std(part, kind, *SCALE), _std(part, kind, *THERMAL_SCALE) * warmer)


def _std(part: Part, *key: str, shape: tuple[int, ...] = (3,)) -> np.ndarray:
    """Standard deviation of a coefficient among specimens, zero without a tolerance."""
    return next((t.std for t in part.tolerances if t.key == key), np.zeros(shape))
