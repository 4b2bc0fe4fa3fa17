"""Inputs, outputs and own parameters of the heading filter's block."""

from __future__ import annotations

from pyimu.attitude.filter import variables as attitude
from pyimu.attitude.filter.variables import ABSURD, LARGEST_BIAS, array
from pyimu.block.variables import Variable
from pyimu.units import STANDARD_GRAVITY

STATUS = {
    1: "an input was not finite or absurd, and was not used",
    2: "a sample of the gyro was at its limit, or said of more than half a turn in a sample period",
    8: "the rate contradicted a declared rest, and was weighed less",
    64: "a heading contradicted the estimate, and was weighed less",
    128: "rest was called for without an accelerometer, by the gyro alone",
}
"""Bits of the output ``status`` and what each says, as far as there is one those of the attitude
filter; 0 is well."""

INPUTS = (
    Variable("gyro_z", "rad/s", "measured rate about the vertical, counter-clockwise above zero"),
    *array(
        "accel",
        "m/s^2",
        "measured specific force, body axes, which tells rest from motion; NaN where there is none",
        (0.0, 0.0, STANDARD_GRAVITY),
    ),
    Variable("temperature", "degC", "temperature of the part", 25.0),
    Variable("heading", "rad", "heading, counter-clockwise from east"),
    Variable("heading_valid", "1", "use the heading of this sample", kind="boolean"),
    Variable(
        "heading_variance", "rad^2", "variance of the heading", attitude.LEAST_HEADING_STD**2 * 1e6
    ),
    Variable("stationary", "1", "the body is declared to be at rest", kind="boolean"),
)
"""Those of a part's surroundings, which its errors may depend on, do not follow: a part that needs
more has those errors left in."""

OUTPUTS = (
    Variable("yaw", "rad", "heading, counter-clockwise from east, -pi to pi"),
    Variable("heading_std", "rad", "standard deviation of the heading"),
    Variable("bias", "rad/s", "bias of the compensated rate"),
    Variable("bias_std", "rad/s", "standard deviation of the bias"),
    Variable("scale_factor", "1", "scale factor error of the compensated rate"),
    Variable("scale_factor_std", "1", "standard deviation of the scale factor error"),
    Variable("rate", "rad/s", "rate of the sample less bias and scale factor, also in a rest"),
    Variable("turned", "rad", "the heading without wrapping: the turns since the start are in it"),
    Variable("at_rest", "1", "the body is at rest, as declared or detected", kind="boolean"),
    Variable(
        "status", "1", "; ".join(f"{bit}: {text}" for bit, text in STATUS.items()), kind="integer"
    ),
)
"""The heading is called ``yaw``, as that of the attitude filter, for ``heading`` is the measured
one: no two variables of a unit may have one name."""


def _start(name: str, unit: str, text: str, start: float, most: float, least: float) -> Variable:
    return Variable(name, unit, text, start, minimum=least, maximum=most, fixed=True)


START_VALUES = (
    _start("heading0", "rad", "heading before the first sample", 0.0, ABSURD, -ABSURD),
    _start("bias0", "rad/s", "bias before the first sample", 0.0, LARGEST_BIAS, -LARGEST_BIAS),
    _start("scale_factor0", "1", "scale factor error before the first sample", 0.0, 9.0, -0.9),
    _start("std0[1]", "rad", "standard deviation of heading0", 0.0, ABSURD, 0.0),
    _start("std0[2]", "rad/s", "standard deviation of bias0", 0.01, ABSURD, 0.0),
    _start("std0[3]", "1", "standard deviation of scale_factor0", 0.03, 1.0, 0.0),
    _start(
        "correlation0", "1", "correlation of the errors of bias0 and scale_factor0", 0.0, 1.0, -1.0
    ),
)
"""What the estimate is before the first sample; later it has no effect."""

_SHARED = {v.name: v for v in attitude.SETTINGS}

SETTINGS = (
    *(
        _SHARED[name]
        for name in (
            "rate_noise",
            "stationary_std",
            "rest_time",
            "rest_rate_tolerance",
            "rest_force_tolerance",
            "lost_rate_std",
        )
    ),
    Variable(
        "scale_factor_walk",
        "1/sqrt(s)",
        "random walk of the scale factor error",
        0.0,
        minimum=0.0,
    ),
)
"""Parameters that are one number; what they share with the attitude filter means the same there."""

OWN_PARAMETERS = START_VALUES + SETTINGS
"""The filter's own parameters; the coefficients of the part's sensors follow."""
