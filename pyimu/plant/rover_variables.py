"""Inputs, parameters and outputs of the block ``RoverDrive``."""

from __future__ import annotations

import math

from pyimu.block.variables import MOTION, Variable, array, in_terminal
from pyimu.plant.bodies import CelestialBody
from pyimu.plant.ground import PRIME

DRIVES = {
    "free": 0,
    "straight": 1,
    "obstacle": 2,
    "ackermann": 3,
    "turn_on_spot": 4,
}
"""The drives by name, and their number in the parameter ``drive``. The last four are those of
Hidalgo 2012, section 6.1."""

CRUISE_SPEED, RADIUS, SPOT_TURN_RATE = 0.01, 1.25, 0.02
"""m/s, m and rad/s of those drives, as they are named among the parameters."""

BOULDERS = 3
"""Boulders that may lie on the ground."""

LATITUDE = math.radians(52.22)
"""rad; Noordwijk, where the paper's rover drove."""

INPUTS = (
    Variable("speed_command", "m/s", "free drive: speed forward to be driven"),
    Variable("turn_rate_command", "rad/s", "free drive: turn rate to be driven, counter-clockwise"),
)

OUTPUTS = (
    *array("q", "1", "attitude, body to east-north-up, scalar first", (1.0, 0.0, 0.0, 0.0)),
    Variable("roll", "rad", "roll of Rz(yaw) Ry(pitch) Rx(roll)"),
    Variable("pitch", "rad", "pitch, nose down is positive"),
    Variable("yaw", "rad", "yaw, counter-clockwise from east, from -pi to pi"),
    *in_terminal(
        MOTION,
        *array("rate", "rad/s", "rate against inertial space, body axes"),
        *array("specific_force", "m/s^2", "specific force at the sensor, body axes"),
    ),
    *array("position", "m", "position of the body's origin: east, north, up of the start"),
    Variable("speed", "m/s", "speed of the body's origin along the body's x axis"),
    Variable("turn_rate", "rad/s", "turn rate about the vertical"),
    Variable("temperature", "degC", "temperature of the sensor", terminal=MOTION),
    *array("sun", "1", "unit vector to the sun, body axes, also where it is below the horizon"),
    Variable("sun_visible", "1", "the sun is above the horizon", kind="boolean"),
    *in_terminal(
        MOTION, *array("mag", "T", "magnetic flux density, body axes; zeros where there is none")
    ),
    Variable("standing", "1", "the rover stands", kind="boolean"),
)


def _fixed(name: str, unit: str, text: str, start: float, minimum=None, maximum=None) -> Variable:
    return Variable(name, unit, text, start, minimum=minimum, maximum=maximum, fixed=True)


def _whole(name: str, text: str, start: int, maximum: int) -> Variable:
    return Variable(
        name, "1", text, float(start), "integer", minimum=0.0, maximum=float(maximum), fixed=True
    )


LEAST = 1e-3
"""Least value of a duration in s, a length in m or a frequency in Hz that is divided by."""

LEAST_SPEED = 1e-6
"""m/s and rad/s; least speed and turn rate of a drive."""


def _drive(drive: str) -> tuple[Variable, ...]:
    """What is driven, and when."""
    names = ", ".join(f"{number} {name.replace('_', ' ')}" for name, number in DRIVES.items())
    return (
        _whole("drive", f"which drive: {names}", DRIVES[drive], len(DRIVES) - 1),
        _fixed(
            "start_time",
            "s",
            "rest before the drive, not before a free one. After 60 s at rest a gyro of 0.2 "
            "deg/sqrt(h) has its bias to 1.5 deg/h",
            60.0,
            0.0,
        ),
        _fixed("heading0", "rad", "heading at the start, counter-clockwise from east", 0.0),
        _fixed("cruise_speed", "m/s", "speed of drives 1 to 3", CRUISE_SPEED, LEAST_SPEED),
        _fixed("length", "m", "length of drives 1 and 2", 5.0, LEAST),
        _fixed("radius", "m", "radius of drive 3, to the left", RADIUS, LEAST),
        _fixed("angle", "rad", "angle of drives 3 and 4", math.pi, LEAST),
        _fixed("spot_turn_rate", "rad/s", "turn rate of drive 4", SPOT_TURN_RATE, LEAST_SPEED),
        _fixed("pause", "s", "rest of drive 4 between its way out and its way back", 0.0, 0.0),
        _fixed(
            "ramp_time",
            "s",
            "time in which a drive reaches its speed, and in which it stops; a free drive follows "
            "its commands as slowly",
            2.0,
            0.01,
        ),
    )


def _ground() -> tuple[Variable, ...]:
    """The ground: waves, and boulders that are in the way of the left and of the right wheels.

    The paper says nothing of its ground. The waves are assumed to be those of raked sand; the
    boulders are three fifths as high as what the Mars Exploration Rovers were made to climb, 0.25 m
    (Lindemann et al. 2006), of whose size the suspension is.
    """
    height, width, forward, left = (
        "height of the boulders as a wheel feels it, 0: none",
        "width of the boulders as a wheel feels it",
        "how far ahead of the start the boulders lie",
        "how far to the left of the start the boulders lie",
    )
    return (
        _fixed("roughness", "m", "root mean square height of the ground's waves", 0.005, 0.0),
        _whole("terrain", "number of the ground: another number, another ground", 0, PRIME - 2),
        Variable(
            "boulders",
            "1",
            "the boulders lie on the ground in every drive, not in drive 2 alone",
            kind="boolean",
            fixed=True,
        ),
        *array("boulder_height", "m", height, (0.15, 0.15, 0.0), minimum=0.0, fixed=True),
        *array("boulder_width", "m", width, (0.6, 0.6, 0.6), minimum=LEAST, fixed=True),
        *array("boulder_forward", "m", forward, (1.5, 3.0, 4.0), fixed=True),
        *array("boulder_left", "m", left, (0.6, -0.6, 0.0), fixed=True),
    )


def _place(body: CelestialBody) -> tuple[Variable, ...]:
    """The planet or moon, the sun, and the magnetic field."""
    return (
        _fixed("gravity", "m/s^2", "gravity", body.gravity, 0.0),
        _fixed("rotation_rate", "rad/s", "rotation against inertial space", body.rotation_rate),
        _fixed("latitude", "rad", "latitude", LATITUDE, -math.pi / 2, math.pi / 2),
        _fixed("solar_day", "s", "time from noon to noon", body.solar_day, 1.0),
        _fixed(
            "solar_declination",
            "rad",
            "declination of the sun; 0 is an equinox",
            0.0,
            -math.pi / 2,
            math.pi / 2,
        ),
        _fixed(
            "hour_angle",
            "rad",
            "local solar time at the start as hour angle of the sun: 0 noon, afternoons above",
            0.0,
        ),
        _fixed("field_strength", "T", "strength of the magnetic field", body.field_strength, 0.0),
        _fixed(
            "field_dip",
            "rad",
            "dip of the magnetic field below the horizontal",
            body.field_dip,
            -math.pi / 2,
            math.pi / 2,
        ),
        _fixed(
            "field_declination",
            "rad",
            "declination of the magnetic field to the east",
            body.field_declination,
        ),
    )


def _sensor() -> tuple[Variable, ...]:
    """Where the sensor is, its temperature, and how it is shaken.

    Nothing shakes unless it is asked for: no source gives amplitudes of the paper's rover.
    """
    motor, wheel = "of the motors' line", "of the line of the wheels' treads at cruise_speed"
    return (
        *array(
            "lever_arm",
            "m",
            "place of the sensor in the body: forward, left, up of its origin, the middle of the "
            "rockers' axle",
            fixed=True,
        ),
        _fixed("start_temperature", "degC", "temperature at the start, less swing", 20.0),
        _fixed("warm_up", "K", "rise by the sensor's own heat", 6.0),
        _fixed("warm_up_time", "s", "time constant of that rise", 500.0, LEAST),
        _fixed("temperature_swing", "K", "amplitude of the day's temperature", 0.0, 0.0),
        _fixed(
            "warmest_hour_angle",
            "rad",
            "hour angle of the sun when the day is warmest",
            math.pi / 6,
        ),
        _fixed(
            "motor_frequency",
            "Hz",
            "frequency of the motors' line; above half the sample rate it folds",
            80.0,
            LEAST,
        ),
        *array("motor_rate", "rad/s", f"amplitude {motor} in rate", fixed=True, minimum=0.0),
        *array(
            "motor_force", "m/s^2", f"amplitude {motor} in specific force", fixed=True, minimum=0.0
        ),
        _fixed("tread_spacing", "m", "distance of the treads on the wheels", 0.02, LEAST),
        *array("tread_rate", "rad/s", f"amplitude {wheel} in rate", fixed=True, minimum=0.0),
        *array(
            "tread_force", "m/s^2", f"amplitude {wheel} in specific force", fixed=True, minimum=0.0
        ),
    )


def parameters(drive: str, body: CelestialBody) -> tuple[Variable, ...]:
    """All of them, with the start values of a ``drive`` on a ``body``.

    They are fixed: a motion cannot have another start while it is under way.
    """
    return (*_drive(drive), *_ground(), *_place(body), *_sensor())
