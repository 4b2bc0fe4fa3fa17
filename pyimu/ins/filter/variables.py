"""Inputs, parameters and outputs of the block ``StrapdownIns``."""

from __future__ import annotations

import math
from dataclasses import replace

from pyimu.attitude.filter.variables import LATITUDE
from pyimu.block.variables import IMU, Variable, array, in_terminal
from pyimu.ins.detector import WINDOW
from pyimu.units import STANDARD_GRAVITY

NAN = math.nan

INPUTS = (
    *in_terminal(
        IMU,
        *array("gyro", "rad/s", "measured rate against inertial space, body axes"),
        *array(
            "accel",
            "m/s^2",
            "measured specific force, body axes",
            (0.0, 0.0, STANDARD_GRAVITY),
        ),
        Variable("temperature", "degC", "temperature of the part", 25.0),
    ),
    Variable("stationary", "1", "the body is at rest", kind="boolean"),
    Variable("speed_valid", "1", "there is a measured speed", kind="boolean"),
    Variable("speed", "m/s", "measured speed along the body's x axis"),
    Variable("speed_variance", "m^2/s^2", "variance of that speed", 1e-2, minimum=0.0),
    Variable("position_valid", "1", "there is a measured position", kind="boolean"),
    *array("position_measured", "m", "measured position: east, north, up; NaN is none"),
    Variable("position_variance", "m^2", "variance of that position, per axis", 1.0, minimum=0.0),
    Variable("velocity_valid", "1", "there is a measured velocity", kind="boolean"),
    *array("velocity_measured", "m/s", "measured velocity: east, north, up; NaN is none"),
    Variable(
        "velocity_variance", "m^2/s^2", "variance of that velocity, per axis", 1e-2, minimum=0.0
    ),
)
"""What every unit takes; signals on which the errors of a part depend follow."""

GYRO, ACCEL, TEMPERATURE = slice(0, 3), slice(3, 6), 6
STATIONARY, SPEED_VALID, SPEED, SPEED_VARIANCE, POSITION_VALID = range(7, 12)
POSITION, POSITION_VARIANCE, VELOCITY_VALID = slice(12, 15), 15, 16
VELOCITY, VELOCITY_VARIANCE = slice(17, 20), 20


def _fixed(name: str, unit: str, text: str, start: float, minimum: float | None = 0.0) -> Variable:
    return Variable(name, unit, text, start, minimum=minimum, fixed=True)


def _setting(name: str, unit: str, text: str, start: float, minimum: float = 0.0) -> Variable:
    return Variable(name, unit, text, start, minimum=minimum)


START_VALUES = (
    _fixed("heading0", "rad", "heading at the start, counter-clockwise from east", 0.0, None),
    _fixed("heading_std0", "rad", "standard deviation of that heading", 1e-3),
    _fixed("tilt0", "1", "1 where the start is in the roll and pitch given, 0: by its force", 0.0),
    _fixed("roll0", "rad", "roll at the start", 0.0, None),
    _fixed("pitch0", "rad", "pitch at the start", 0.0, None),
    _fixed(
        "tilt_std0",
        "rad",
        "standard deviation of roll and pitch at the start, by default those of the first force. "
        "Wide on purpose: what a rest shows of tilt and accelerometer bias together, and of each "
        "hardly anything, the first zero velocities tell with the right correlation",
        0.3,
    ),
    *(
        replace(v, fixed=True)
        for v in array("velocity0", "m/s", "velocity at the start: east, north, up")
    ),
    _fixed("velocity_std0", "m/s", "standard deviation of that velocity, to east and north", 1.0),
    _fixed("climb_std0", "m/s", "standard deviation of that velocity, upwards", 1.0),
    _fixed("position_std0", "m", "standard deviation of the position at the start, 0", 0.0),
    *(
        replace(v, fixed=True)
        for v in array("gyro_bias0", "rad/s", "gyro bias at the start, beside the part's")
    ),
    *(
        replace(v, minimum=0.0, fixed=True)
        for v in (
            *array(
                "gyro_bias_std0",
                "rad/s",
                "standard deviation of the gyro bias at the start",
                (0.1, 0.1, 0.1),
            ),
            *array(
                "accel_bias_std0",
                "m/s^2",
                "standard deviation of the accelerometer bias at the start",
                (0.5, 0.5, 0.5),
            ),
        )
    ),
)
"""What is known before the first sample; later it has no effect."""

SETTINGS = (
    _setting("zupt", "1", "a stationary body has no velocity: zero-velocity updates", 1.0),
    _setting("zaru", "1", "a stationary body does not turn: zero-angular-rate updates", 1.0),
    _setting(
        "zupt_std",
        "m/s",
        "standard deviation of the velocity of a body at rest, of each sample by itself",
        1e-3,
        1e-6,
    ),
    _setting(
        "detect",
        "1",
        "rests are also found in the samples, by the noise of the part; 0 where `stationary` says "
        "them all",
        1.0,
    ),
    _setting("rest_window", "s", "length of the windows by which rests are found", WINDOW, 1e-3),
    _setting("rest_noise", "1", "noise of a body at rest, as a multiple of the part's", 1.0, 1e-3),
    _setting(
        "nhc", "1", "a vehicle's wheels move neither sideways nor upwards: its constraint", 0.0
    ),
    _setting("nhc_std", "m/s", "standard deviation of the slip sideways and upwards", 0.02, 1e-6),
    _setting(
        "nhc_angle_std",
        "rad",
        "standard deviation of the angle by which tyres slip and springs pitch: a slip of so much "
        "of the speed",
        0.01,
    ),
    _setting("nhc_time", "s", "time for which a slip lasts", 0.1),
    *(
        replace(v, fixed=True)
        for v in array(
            "lever_arm",
            "m",
            "from the sensor to the point of the vehicle that does not slip, body axes",
        )
    ),
    *(
        replace(v, fixed=True)
        for v in array(
            "antenna",
            "m",
            "from the sensor to the antenna of which position and velocity are measured, body axes",
        )
    ),
    *(
        replace(v, minimum=0.0)
        for v in array(
            "clipped_rate_std",
            "rad/s",
            "standard deviation of the rates beyond the gyro's limit, as one that stays the same; "
            "0: `top_turn_rate`",
        )
    ),
    *(
        replace(v, minimum=0.0)
        for v in array(
            "clipped_force_std",
            "m/s^2",
            "standard deviation of the forces beyond the accelerometer's limit, likewise; 0: "
            "`top_acceleration`",
        )
    ),
    _setting("top_speed", "m/s", "largest speed; what a gap in the samples may hide", 2.0, 1e-3),
    _setting("top_acceleration", "m/s^2", "largest acceleration, likewise", 5.0, 1e-3),
    _setting("top_turn_rate", "rad/s", "largest turn rate, likewise", 2.0, 1e-3),
)

OWN_PARAMETERS = (
    LATITUDE,
    Variable("gravity", "m/s^2", "magnitude of gravity", STANDARD_GRAVITY, minimum=1e-3),
    *START_VALUES,
    *SETTINGS,
)
"""The filter's own parameters; the coefficients of the part's sensors follow."""

WHEELS = (
    _fixed("speed_scale_std", "1", "standard deviation of the measured speed's scale factor", 0.02),
    _fixed("speed_late_std", "s", "standard deviation of how late it is", 0.0),
    _fixed(
        "lever_arm_std",
        "m",
        "standard deviation of the lever arm's end, along and across the body",
        0.1,
    ),
    _setting("crab_std", "rad", "standard deviation of the angle by which the vehicle crabs", 0.01),
    _setting("crab_time", "s", "time constant with which that changes", 10.0, 1e-3),
)
"""Those of a filter that estimates what lasts of the errors of wheels. Worn or less inflated ones
are some percent smaller; a lever arm that is not told is 0 and some centimetres; a wheel that
is pushed to the side by 3 m/s^2 moves askew by a hundredth. Assumed."""

LASTING = (
    _setting("position_lasting_std", "m", "standard deviation of a position's lasting error", 1.0),
    _setting("position_lasting_time", "s", "time constant with which it is forgotten", 60.0, 1e-3),
)
"""Those of a filter that estimates what lasts of the errors of measured positions: a Gauss-Markov
process, of its own on each axis."""

OUTPUTS = (
    *array("q", "1", "attitude, body to east-north-up, scalar first", (1.0, 0.0, 0.0, 0.0)),
    Variable("roll", "rad", "roll of Rz(yaw) Ry(pitch) Rx(roll)"),
    Variable("pitch", "rad", "pitch, nose down is positive"),
    Variable("yaw", "rad", "yaw, counter-clockwise from east, from -pi to pi"),
    *array("velocity", "m/s", "velocity: east, north, up"),
    *array("position", "m", "position: east, north, up of the start"),
    *array("gyro_bias", "rad/s", "gyro bias"),
    *array("accel_bias", "m/s^2", "accelerometer bias"),
    *array("attitude_std", "rad", "standard deviation of the attitude about east, north, up"),
    *array("velocity_std", "m/s", "standard deviation of the velocity"),
    *array("position_std", "m", "standard deviation of the position"),
    *array("gyro_bias_std", "rad/s", "standard deviation of the gyro bias"),
    *array("accel_bias_std", "m/s^2", "standard deviation of the accelerometer bias"),
    Variable("position_correlation", "1", "correlation of the errors to the east and to the north"),
    Variable(
        "zupt_nis", "1", "normalised innovation squared of a zero velocity, 3 is right; else 0"
    ),
    Variable("zaru_nis", "1", "that of a zero turn rate, 3 is right; else 0"),
    Variable("nhc_nis", "1", "that of a vehicle's constraint, 2 is right; else 0"),
    Variable("position_nis", "1", "that of a measured position, 3 is right; else 0"),
    Variable("velocity_nis", "1", "that of a measured velocity, 3 is right; else 0"),
    Variable("speed_nis", "1", "that of a measured speed, 1 is right; else 0"),
    Variable("at_rest", "1", "the body is at rest, as was told or found", kind="boolean"),
    Variable("status", "1", "sum of the bits of the status; 0: nothing to report", kind="integer"),
)

STATUS_NAMES = {
    1: "samples were missing, stuck at a limit or no number: what the body may have done meanwhile "
    "is in the standard deviations",
    2: "a zero velocity contradicted the estimate and was weighed down",
    4: "a zero turn rate contradicted the estimate and was weighed down",
    8: "the vehicle's constraint contradicted the estimate and was weighed down",
    16: "a measured position contradicted the estimate and was weighed down",
    32: "a measured velocity contradicted the estimate and was weighed down",
    64: "a measured speed contradicted the estimate and was weighed down",
    128: "a variance was below zero, and its standard deviation is shown as 0",
}
"""What the bits of the status say."""
