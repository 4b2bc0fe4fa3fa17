"""The unit ``RoverDrive``: the true motion of a six-wheel rover, and what surrounds it."""

from __future__ import annotations

from collections.abc import Mapping

import casadi as ca
import numpy as np

from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.block.variables import Limits, Variable
from pyimu.errors import UserError
from pyimu.plant import ground, sky, vibration
from pyimu.plant.bodies import BODIES, CelestialBody
from pyimu.plant.commanded import SPREAD, courses, displaced, follow
from pyimu.plant.manoeuvre import chord, out_and_back
from pyimu.plant.pose import motion
from pyimu.plant.rover_variables import DRIVES, INPUTS, OUTPUTS, parameters
from pyimu.plant.suspension import Rocker
from pyimu.symbolic import quaternion
from pyimu.symbolic.missing import is_finite

STANDSTILL = 1e-6
"""m/s; wheels slower than this, which would also be in a ``ramp_time`` more, stand."""

FREE = 12
"""Numbers that a free drive remembers: speed and turn rate with two derivatives each, distance,
heading, east, north, and the last commands."""


def rover_drive(
    sample_period: float,
    drive: str = "turn_on_spot",
    body: CelestialBody | str = "Earth",
    rocker: Rocker | None = None,
) -> Block:
    """The block of a rover's true motion, sampled every ``sample_period`` s.

    ``drive`` and ``body``, by their names in ``DRIVES`` and ``BODIES``, are start values of
    parameters; the lengths of the suspension, ``rocker``, are part of the block. Raises UserError
    for an unknown name.
    """
    _known("drive", drive, DRIVES)
    if isinstance(body, str):
        _known("body", body, BODIES)
        body = BODIES[body]
    rocker = rocker or Rocker()
    variables = parameters(drive, body)
    p, u = ca.SX.sym("p", len(variables)), ca.SX.sym("u", len(INPUTS))
    named = by_name(variables, p)
    return Block(
        name="RoverDrive",
        description=(
            f"True motion of a six-wheel rover with rocker suspension on {body.name}: the test "
            "drives of Hidalgo 2012 and free ones"
        ),
        step=_step(named, p, u, rocker),
        initial=_initial(named, p, u, rocker),
        inputs=INPUTS,
        parameters=variables,
        outputs=OUTPUTS,
        noise=(),
        sample_period=sample_period,
        limits=_limits(named, p, rocker),
    )


def _known(what: str, name: str, names: Mapping[str, object]) -> None:
    if name not in names:
        raise UserError(f"{what} '{name}': unknown; known are {', '.join(names)}")


def end_of_drive(block: Block, values: np.ndarray) -> float:
    """When a drive of the block with parameters ``values`` (np,) is over, in s from the start.

    Of a free drive, which its commands end, it is 0.
    """
    p = by_name(block.parameters, ca.DM(values))
    if p["drive"] == DRIVES["free"]:
        return 0.0
    once = float(_pace(p)[2] + p["ramp_time"])
    back = float(p["pause"]) + once if p["drive"] == DRIVES["turn_on_spot"] else 0.0
    return float(p["start_time"]) + once + back


def by_name(variables: tuple[Variable, ...], p) -> dict:
    """The numbers ``p`` by the names of the variables; those of an array as one column."""
    found: dict = {}
    for i, variable in enumerate(variables):
        base = variable.name.partition("[")[0]
        found[base] = ca.vertcat(found[base], p[i]) if base in found else p[i]
    return found


def on_level_ground(time, p: dict):
    """The outputs of a drive that is not free, on ground without waves, at the ``time`` in s.

    ``p`` are the parameters by their names (``by_name``).
    """
    level = ca.SX.zeros(4 * ground.WAVES)
    return _shown(time, _plane(time, ca.SX.zeros(FREE), p), level, p, Rocker())


def _step(named: dict, p, u, rocker: Rocker) -> ca.Function:
    count, found = ca.SX.sym("count"), ca.SX.sym("ground", 4 * ground.WAVES)
    free, h = ca.SX.sym("free", FREE), ca.SX.sym("h")
    time = (count + 1) * h
    following = _free(free, u, named, h)
    planes = _plane(time, following, named)
    shown = _shown(time, planes, found, named, rocker)
    following, shown = ca.cse([following, shown])
    return plain_function(
        "step",
        [ca.vertcat(count, found, free), u, p, ca.SX(0, 1), h],
        [ca.vertcat(count + 1, found, following), shown],
        ["s", "u", "p", "w", "h"],
        ["s_next", "y"],
    )


def _initial(named: dict, p, u, rocker: Rocker) -> ca.Function:
    found = ground.waves(named["terrain"])
    free = ca.vertcat(ca.SX.zeros(7), named["heading0"], ca.SX.zeros(FREE - 8))
    shown = _shown(ca.SX(0), _plane(ca.SX(0), free, named), found, named, rocker)
    state = ca.vertcat(0, found, free)
    return plain_function("initial", [u, p], ca.cse([state, shown]), ["u", "p"], ["s", "y"])


def _free(free, u, p: dict, h):
    """What a free drive remembers, a sample later. A command that is no number is the last one."""
    commands = [ca.if_else(is_finite(u[i]), u[i], free[10 + i]) for i in range(2)]
    lag = SPREAD * p["ramp_time"]
    speed, gone = follow(free[0:3], commands[0], lag, h)
    turn_rate, turned = follow(free[3:6], commands[1], lag, h)
    heading = free[7] + turned
    before = courses(free[0:3], free[3:6], free[7])
    after = courses(speed, turn_rate, heading)
    places = [free[8 + i] + displaced(before[i], after[i], h) for i in range(2)]
    return ca.vertcat(speed, turn_rate, free[6] + gone, heading, *places, *commands)


def _plane(time, free, p: dict) -> tuple:
    """The motion in the plane, and its first two derivatives, (``PLANE``,) each."""
    is_free = p["drive"] == DRIVES["free"]
    speed, turn_rate, path, turned = _scripted(time, p)
    east, north = chord(path, turned, p["heading0"])
    heading = ca.if_else(is_free, free[7], p["heading0"] + turned)
    speed = ca.if_else(is_free, free[0:3], speed)
    turn_rate = ca.if_else(is_free, free[3:6], turn_rate)
    to_east, to_north = courses(speed, turn_rate, heading)
    place = ca.vertcat(
        ca.if_else(is_free, free[8], east), ca.if_else(is_free, free[9], north), heading
    )
    distance = ca.if_else(is_free, free[6], path)
    return (
        ca.vertcat(place, distance, speed[0], turn_rate[0], time),
        ca.vertcat(to_east[0], to_north[0], turn_rate[0], speed[0], speed[1], turn_rate[1], 1),
        ca.vertcat(to_east[1], to_north[1], turn_rate[1], speed[1], speed[2], turn_rate[2], 0),
    )


def _pace(p: dict) -> tuple:
    """Of drives 1 to 4: speed m/s, turn rate rad/s, and s at them; those of drive 0 are unused."""
    drive = p["drive"]
    on_spot, bent = drive == DRIVES["turn_on_spot"], drive == DRIVES["ackermann"]
    speed = ca.if_else(on_spot, 0, p["cruise_speed"])
    turn_rate = ca.if_else(
        on_spot, p["spot_turn_rate"], ca.if_else(bent, p["cruise_speed"] / p["radius"], 0)
    )
    duration = ca.if_else(
        on_spot,
        p["angle"] / p["spot_turn_rate"],
        ca.if_else(bent, p["angle"] * p["radius"], p["length"]) / p["cruise_speed"],
    )
    return speed, turn_rate, duration


def _scripted(time, p: dict) -> tuple:
    """Speed and turn rate (3,) of drives 1 to 4, with derivatives, and path m and angle rad."""
    speed, turn_rate, duration = _pace(p)
    done, *pace = out_and_back(
        time - p["start_time"],
        duration,
        p["ramp_time"],
        p["pause"],
        p["drive"] == DRIVES["turn_on_spot"],
    )
    shares = ca.vertcat(*pace)
    return speed * shares, turn_rate * shares, speed * done, turn_rate * done


def _shown(time, planes: tuple, found, p: dict, rocker: Rocker):
    """The outputs at a motion in the plane."""
    body = motion(planes, found, p, rocker)
    back = quaternion.conjugate(body.q)
    angle = sky.hour_angle(time, p["hour_angle"], p["solar_day"])
    sun = sky.sun_direction(angle, p["solar_declination"], p["latitude"])
    field = sky.magnetic_field(p["field_strength"], p["field_dip"], p["field_declination"])
    warmth = sky.temperature(
        time,
        angle,
        p["start_temperature"],
        p["warm_up"],
        p["warm_up_time"],
        p["temperature_swing"],
        p["warmest_hour_angle"],
    )
    return ca.densify(
        ca.vertcat(
            body.q,
            quaternion.to_euler(body.q),
            body.rate,
            body.force,
            body.position,
            body.speed,
            planes[0][5],
            warmth,
            quaternion.rotate(back, sun),
            sun[2] > 0,
            quaternion.rotate(back, field),
            _standing(planes, p, rocker),
        )
    )


def _standing(planes: tuple, p: dict, rocker: Rocker):
    """Whether the wheels neither turn nor are about to."""
    speeds = vibration.wheel_speeds(planes[0][4], planes[0][5], rocker.track)
    gains = vibration.wheel_speeds(planes[1][4], planes[1][5], rocker.track)
    soon = [p["ramp_time"] * x for x in gains]
    return sum((x * x for x in (*speeds, *soon)), 0) < STANDSTILL * STANDSTILL


def _limits(p: dict, symbols, rocker: Rocker) -> Limits:
    """What the parameters must keep together."""
    h = ca.SX.sym("h")
    waves = p["roughness"] * (2 * ground.WAVES) ** 0.5
    high = 2 * waves + ca.sum1(p["boulder_height"])
    broken = {
        f"roughness and boulders are too high for the suspension, which can follow {rocker.reach:g}"
        " m between two wheels": high >= rocker.reach,
        "the drive is shorter than its ramp_time; make it slower or longer": ca.logic_and(
            p["drive"] != DRIVES["free"], _pace(p)[2] < p["ramp_time"]
        ),
    }
    function = plain_function(
        "limits", [symbols, h], [ca.densify(ca.vertcat(*broken.values()))], ["p", "h"], ["broken"]
    )
    return Limits(tuple(broken), function)
