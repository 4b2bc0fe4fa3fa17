"""Inputs, outputs and own parameters of an attitude filter's block, and the numbers it accepts."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

from pyimu.attitude.filter.status import STATUS
from pyimu.block.variables import IMU, Variable, array, in_terminal
from pyimu.model.signals import SURROUNDINGS
from pyimu.units import STANDARD_GRAVITY

UNKNOWN_LATITUDE = 10.0
"""rad; stands for "not known", as does every finite value outside -pi/2 to pi/2. No Earth rate is
then subtracted. NaN and infinity are refused like those of every parameter."""

ABSURD = 1e6
"""SI; a larger input is treated like one that is not finite, because its square might not be."""

LARGEST_BIAS = 100.0
"""rad/s; the largest gyro bias before the first sample."""

LEAST_N = 1e-9
"""rad/sqrt(s); least angle random walk of the process noise. Together with ``LEAST_K`` it keeps the
covariance definite for a part without noise."""

LEAST_K = 1e-10
"""rad/s/sqrt(s); least rate random walk of the process noise."""

LEAST_ACCEL_STD = 1e-4
"""m/s^2; least standard deviation of a sample of specific force."""

LEAST_SPEED_STD = 1e-6
"""m/s; least standard deviation of a speed and of the slip."""

LEAST_HEADING_STD = 1e-6
"""rad; least standard deviation of a heading."""

EXTRA_INPUTS = tuple(n for n in SURROUNDINGS if n != "temperature")
"""Signals that become inputs of the filter where effects of the part depend on them."""


INPUTS = (
    *in_terminal(
        IMU,
        *array("gyro", "rad/s", "measured rate against inertial space, body axes"),
        *array(
            "accel", "m/s^2", "measured specific force, body axes", (0.0, 0.0, STANDARD_GRAVITY)
        ),
        Variable("temperature", "degC", "temperature of the part", 25.0),
    ),
    *in_terminal(
        "heading",
        Variable("heading", "rad", "heading, counter-clockwise from east"),
        Variable("heading_variance", "rad^2", "variance of the heading, above zero"),
        Variable("heading_valid", "1", "use the heading of this sample", kind="boolean"),
        Variable(
            "heading_age",
            "s",
            "time since the heading was true, counted in whole samples; at most heading_memory. An "
            "age of some tenths of a second takes no heading more precise than about 1e-3 rad many "
            "times a second: what is left out then adds up, and std is too small",
        ),
    ),
    Variable("stationary", "1", "the body does not turn against the Earth", kind="boolean"),
    *in_terminal(
        "speed",
        Variable(
            "speed", "m/s", "speed over the ground along the body's x axis, backwards below zero"
        ),
        Variable("speed_variance", "m^2/s^2", "variance of the speed"),
        Variable("speed_valid", "1", "use the speed of this sample", kind="boolean"),
    ),
    *in_terminal(
        IMU, *array("mag", "T", "measured magnetic flux density, body axes; zeros or NaN: none")
    ),
)
"""The inputs for every part; ``EXTRA_INPUTS`` follow where the part needs them."""

MAG = slice(len(INPUTS) - 3, len(INPUTS))
"""Where the inputs have the magnetometer."""

OUTPUTS = in_terminal(
    "attitude",
    *array(
        "q",
        "1",
        "attitude, body to world (east-north-up), Hamilton, scalar first",
        (1.0, 0.0, 0.0, 0.0),
    ),
    Variable("roll", "rad", "roll"),
    Variable("pitch", "rad", "pitch, nose up is negative"),
    Variable("yaw", "rad", "yaw, counter-clockwise from east"),
    *array("gyro_bias", "rad/s", "bias of the compensated rate"),
    *array("std", "rad", "standard deviation of the attitude error, body axes"),
    *(Variable(f"std[{i}]", "rad/s", "standard deviation of the gyro bias") for i in (4, 5, 6)),
    Variable("quasi_static", "1", "the accelerometer is used as an inclinometer", kind="boolean"),
    Variable(
        "nis",
        "1",
        "normalised innovation squared of this sample's quasi-static update, 0 without one; "
        "chi-squared of 3 degrees of freedom, "
        "white where accel_std is 0, else correlated over accel_correlation_time and less on a "
        "body that accelerates less than accel_std",
    ),
    Variable(
        "status", "1", "; ".join(f"{bit}: {text}" for bit, text in STATUS.items()), kind="integer"
    ),
    Variable(
        "heading_std",
        "rad",
        "standard deviation of the attitude error about the vertical, however the body is tilted",
    ),
    Variable(
        "at_rest", "1", "the body does not move, as the input or the run says", kind="boolean"
    ),
)
"""The outputs of every filter, in the order of the block."""

FOUND = [
    [v.name for v in OUTPUTS].index(name) for name in ("quasi_static", "nis", "status", "at_rest")
]
"""Which of the outputs are no estimates, but what the filter found on its way to them."""


def _bounded(
    variables: Iterable[Variable], minimum: float, maximum: float = ABSURD
) -> tuple[Variable, ...]:
    """The same with bounds, outside which and for NaN a value is refused."""
    return tuple(replace(v, minimum=minimum, maximum=maximum) for v in variables)


def _setting(name: str, unit: str, text: str, start: float) -> Variable:
    """A parameter that is not below zero."""
    return Variable(name, unit, text, start, minimum=0.0)


FIELD_SETTINGS = (
    Variable(
        "declination",
        "rad",
        "declination of the magnetic field, positive to the east: yaw is against true north",
        minimum=-math.pi,
        maximum=math.pi,
    ),
    _setting(
        "field_strength",
        "T",
        "strength of the place's magnetic field; 0: not known, the run learns it with the dip from "
        "its samples alone",
        0.0,
    ),
    Variable(
        "field_dip",
        "rad",
        "dip of that field below the horizon",
        minimum=-math.pi / 2,
        maximum=math.pi / 2,
    ),
    _setting(
        "field_strength_std",
        "T",
        "standard deviation of the horizontal and of the vertical part of that field; what the "
        "samples show is weighed against it",
        1.4e-7,
    ),
    _setting(
        "field_std",
        "T",
        "standard deviation of what the place's field has across its horizontal direction: the "
        "error of the declination, and the surroundings",
        2e-7,
    ),
    _setting("field_time", "s", "correlation time of that difference", 300.0),
    _setting(
        "field_turning_std",
        "T",
        "standard deviation of a component of what differs from one attitude of the body to "
        "another, as the magnetometer's bias does, before the run itself shows it; 0: nothing "
        "does",
        1e-6,
    ),
    _setting("field_noise", "T*sqrt(s)", "root density of the magnetometer's white noise", 1e-7),
    _setting(
        "field_tolerance",
        "1",
        "share of the field's strength by which strength or dip may differ from what the run has "
        "learnt of them; 0: no magnetometer is used",
        0.13,
    ),
)
"""Parameters of the magnetometer's update (``pyimu.attitude.filter.field_update``)."""

SETTINGS = (
    _setting("gravity", "m/s^2", "magnitude of gravity", STANDARD_GRAVITY),
    _setting(
        "accel_std",
        "m/s^2",
        "standard deviation of the acceleration that a body has beside its bounded velocity, and "
        "beside the pushes that the run shows; 0: the body never accelerates. The errors of a real "
        "accelerometer in motion are such an acceleration: a run over a log takes 0.01 m/s^2 where "
        "rate_noise is not 0",
        1e-4,
    ),
    _setting(
        "accel_bias_std",
        "m/s^2",
        "standard deviation of a component of the accelerometer's constant error, which tilts the "
        "attitude by its share of gravity: std has that, no matter how long it is averaged, and "
        "what the size of gravity at rest says of it",
        0.0,
    ),
    _setting(
        "accel_correlation_time",
        "s",
        "correlation time of that acceleration; 0 is white from sample to sample",
        0.5,
    ),
    _setting(
        "gravity_walk",
        "m/s^2/sqrt(s)",
        "random walk of the magnitude in the quasi-static estimator",
        0.2,
    ),
    _setting(
        "gravity_tolerance",
        "m/s^2",
        "quasi-static: largest difference of the estimated magnitude and of gravity as it was "
        "measured at rest; beyond, that is called another than gravity",
        0.25,
    ),
    _setting(
        "motion_tolerance",
        "m/s^2",
        "quasi-static: largest difference of a sample's magnitude and the estimated one",
        1.0,
    ),
    _setting(
        "steady_tolerance",
        "m/s^2",
        "quasi-static: largest root mean square of the force against its mean, beside white noise",
        0.3,
    ),
    _setting(
        "motion_time",
        "s",
        "correlation time of the velocity of a body that stays in its place. How large that is the "
        "run finds out, over eight times this time",
        1.0,
    ),
    _setting(
        "push_std",
        "m/s^2",
        "standard deviation of an axis of pushes that last, as of a vehicle or an aircraft that is "
        "on its way before the first sample, until the run shows how large they are; its velocity "
        "then is that of so large a push over 6 s. A log that begins in motion shows it",
        0.0,
    ),
    Variable(
        "motion_share",
        "1",
        "least share that the density of that velocity has at low frequency of one of that "
        "correlation time, as far as the run shows less. The errors of a real accelerometer in "
        "motion look like a slow velocity: a run over a log takes 1, which does not ask the run, "
        "where rate_noise is not 0",
        1e-4,
        minimum=0.0,
        maximum=1.0,
    ),
    _setting(
        "rate_noise",
        "sqrt(s)",
        "root density of the relative error of the rate, which leaks onto all axes",
        0.0,
    ),
    _setting(
        "scale_std",
        "1",
        "standard deviation of the scale factor of each of the gyro's axes, of which the run "
        "learns nothing: std has what that makes of a turn that goes on, and of the bias; gravity "
        "corrects the tilt that much sooner, and heading and bias are estimated the same",
        0.0,
    ),
    _setting(
        "axes_std",
        "rad",
        "standard deviation of the angle, about each axis, between the vertical of the "
        "accelerometer and the axis about which the gyro says that a body turns whose speed is "
        "given: a bias of the accelerometer, axes of either. It turns with the body, and nothing "
        "is learnt of it",
        0.0,
    ),
    _setting(
        "bias_noise",
        "1/sqrt(s)",
        "root density of the walk of the bias over the rate: a gyro that feels forces has another "
        "bias when it has turned over",
        0.0,
    ),
    _setting(
        "bias_drift",
        "rad/s/sqrt(s)",
        "root density of the walk of the bias beyond that of the part, as of a gyro that warms up, "
        "until rests show how large it is. A log with several rests tells it from the start",
        0.0,
    ),
    _setting(
        "motion_bias",
        "rad/s",
        "standard deviation by which the bias of the gyro is another while the body turns fast, by "
        "0.5 rad/s and more over 10 s, than at rest; its share of that where it turns less. As "
        "much again it changes in 100 s of motion. What the model of a gyro lacks shows in motion",
        0.0,
    ),
    _setting(
        "stationary_std",
        "rad/s",
        "standard deviation of the rate of a body that is called stationary",
        1e-5,
    ),
    _setting(
        "rest_time",
        "s",
        "a body of which no sample differs from the others for so long is at rest, or for 2.5 s "
        "where its bias about the vertical is not known to 2e-3 rad/s; 0: never",
        1.5,
    ),
    _setting(
        "rest_rate_tolerance",
        "rad/s",
        "largest difference of a sample's rate from the others' mean at rest, beside white noise",
        0.005,
    ),
    _setting(
        "rest_force_tolerance",
        "m/s^2",
        "largest difference of a sample's force from the mean at rest, beside white noise",
        0.2,
    ),
    _setting(
        "slip_std",
        "m/s",
        "standard deviation of the velocity across and upwards of a body whose speed is given",
        0.1,
    ),
    _setting(
        "speed_tolerance",
        "1",
        "standard deviation of the share by which the accelerations of a body whose speed is given "
        "are others than the speed says: size of the wheels, scale factors",
        0.01,
    ),
    _setting(
        "lost_rate_std",
        "rad/s",
        "standard deviation of the rate along an axis whose gyro is lost",
        1.0,
    ),
    _setting(
        "stuck_time",
        "s",
        "equal samples of a triad for so long mean that it is stuck; 0: never",
        0.0,
    ),
    *_bounded(
        array(
            "axis_stuck_time",
            "s",
            "equal samples of an axis (gyro, then accelerometer) for so long, while the others of "
            "its triad change, mean that it is stuck; 0: never",
            (0.0,) * 6,
        ),
        0.0,
    ),
    _setting(
        "heading_memory",
        "s",
        "largest heading_age; beyond 63 samples the course in between is interpolated",
        0.5,
    ),
    *FIELD_SETTINGS,
)
"""Parameters that are one number. Those of accelerations were chosen on hand-held recordings of
``benchmarks/attitude_real.py``, and say what is not motion; how much a body moves, the run finds
out."""

START_VALUES = tuple(
    replace(v, fixed=True)
    for v in (
        *_bounded(
            array("q0", "1", "attitude before the first sample", (1.0, 0.0, 0.0, 0.0)), -ABSURD
        ),
        *_bounded(
            array("bias0", "rad/s", "gyro bias before the first sample"),
            -LARGEST_BIAS,
            LARGEST_BIAS,
        ),
        *_bounded(
            array(
                "std0",
                "rad",
                "standard deviation of the attitude before the first sample",
                (0.1, 0.1, 0.1),
            ),
            0.0,
        ),
        *_bounded(
            (
                Variable(
                    f"std0[{i}]",
                    "rad/s",
                    "standard deviation of the bias before the first sample",
                    0.01,
                )
                for i in (4, 5, 6)
            ),
            0.0,
        ),
    )
)
"""What the estimate is before the first sample; later it has no effect."""

LATITUDE = Variable(
    "latitude",
    "rad",
    "latitude; a finite value outside -pi/2 to pi/2 is unknown: no Earth rate",
    UNKNOWN_LATITUDE,
)

OWN_PARAMETERS = (
    LATITUDE,
    *START_VALUES,
    *SETTINGS,
)
"""The filter's own parameters; the coefficients of the part's sensors follow."""

USUAL = {v.name: v.start for v in OWN_PARAMETERS}
"""What they are where neither the part nor the log says more, by name."""
