"""Functions of attitude and of a rover's drives, printed from the package's own."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from pyimu.modelica.functions import Function, array, function
from pyimu.modelica.names import camel
from pyimu.modelica.text import GENERATED, capital, rendered
from pyimu.plant.rover_drive import rover_drive
from pyimu.plant.rover_variables import DRIVES
from pyimu.symbolic import earth, mrp, quaternion

CHOSEN = {
    "straight": ("cruise_speed", "length"),
    "obstacle": ("cruise_speed", "length"),
    "ackermann": ("cruise_speed", "radius", "angle"),
    "turn_on_spot": ("spot_turn_rate", "angle", "pause"),
}
"""Parameters of each drive that stay parameters, beside those of all."""

SHOWN = {"q": 4, "rate": 3, "specific_force": 3, "position": 3}
"""Outputs of the drives in the order of the functions' results, and their sizes."""

EVERY = ("start_time", "heading0", "ramp_time", "latitude", "gravity")


def attitude_texts() -> dict[str, str]:
    """Name to text of the functions of attitude."""
    q, r, rate = ca.SX.sym("q", 4), ca.SX.sym("r", 4), ca.SX.sym("rate", 3)
    v, p, error = ca.SX.sym("v", 3), ca.SX.sym("p", 3), ca.SX.sym("error", 3)
    angles = [ca.SX.sym(name) for name in ("roll", "pitch", "yaw")]
    latitude, force = ca.SX.sym("latitude"), ca.SX.sym("force", 3)
    across = ca.sqrt(force[1] * force[1] + force[2] * force[2])
    levelled = quaternion.from_euler(
        ca.atan2(force[1], force[2]), ca.atan2(-force[0], across), angles[2]
    )
    q_, r_, rate_ = _vector("q", q), _vector("r", r), _vector("rate", rate)
    found = [
        _attitude(
            "quaternionProduct",
            "q r, the rotation by r followed by that by q",
            [q_, r_],
            quaternion.product(q, r),
        ),
        _attitude(
            "quaternionConjugate", "The inverse of a unit quaternion", [q_], quaternion.conjugate(q)
        ),
        _attitude("quaternionNormalized", "q at unit length", [q_], quaternion.normalized(q)),
        _attitude(
            "quaternionRotate",
            "A vector of the body in world axes",
            [q_, _vector("v", v)],
            quaternion.rotate(q, v),
        ),
        _attitude(
            "quaternionDerivative",
            "Derivative of q of a body that turns at a rate in body axes",
            [q_, rate_],
            quaternion.derivative(q, rate),
        ),
        _attitude(
            "quaternionFromEuler",
            "The quaternion of Rz(yaw) Ry(pitch) Rx(roll)",
            [_scalar(str(a), a) for a in angles],
            quaternion.from_euler(*angles),
        ),
        _attitude("quaternionToEuler", "Roll, pitch, yaw", [q_], quaternion.to_euler(q)),
        _attitude(
            "mrpFromQuaternion",
            "Modified Rodrigues parameters, in rad for small angles",
            [q_],
            mrp.from_quaternion(q),
        ),
        _attitude(
            "mrpToQuaternion",
            "The quaternion of modified Rodrigues parameters",
            [_vector("p", p)],
            mrp.to_quaternion(p),
        ),
        _attitude(
            "mrpErrorDerivative",
            "Derivative of the attitude error p of an estimate that "
            "turns at a rate which is wrong by rateError",
            [_vector("p", p), rate_, _vector("rateError", error)],
            mrp.error_derivative(p, rate, error),
        ),
        _attitude(
            "earthRate",
            "The Earth's rotation in world axes, rad/s",
            [_scalar("latitude", latitude)],
            earth.earth_rate(latitude),
        ),
        _attitude(
            "levelled",
            "Attitude of a body at rest by its specific force, with a given yaw",
            [_vector("force", force), _scalar("yaw", angles[2])],
            levelled,
        ),
    ]
    return {f.name: _text("PyImu.Attitude.Functions", f) for f in found}


def _vector(name: str, symbol: ca.SX):
    return array(name, (symbol.numel(),), symbol)


def _scalar(name: str, symbol: ca.SX):
    return array(name, (), symbol)


def _attitude(name: str, text: str, arguments: Sequence, expression: ca.SX) -> Function:
    size = expression.numel()
    return function(name, text, arguments, expression, (size,), f"function {name}")


def drive_texts() -> dict[str, str]:
    """Name to text of the motion of each of the test drives."""
    return {f.name: _text("PyImu.Rover.Functions", f) for f in map(_drive, CHOSEN)}


def _drive(name: str) -> Function:
    """Attitude, rate, specific force and position (13,) at a time of a drive on level ground."""
    block = rover_drive(1.0, name)
    time = ca.SX.sym("time")
    free = {n: ca.SX.sym(n) for n in (*EVERY, *CHOSEN[name])}
    fixed = {"drive": DRIVES[name], "roughness": 0.0}
    p = [free.get(v.name, ca.SX(fixed.get(v.name, v.start))) for v in block.parameters]
    at = ca.vertcat(time - 1, ca.SX.zeros(block.n_state - 1))
    _, shown = block.step(at, ca.SX.zeros(2), ca.vertcat(*p), ca.SX(0, 1), 1.0)
    columns = [v.name.partition("[")[0] for v in block.outputs]
    rows = [i for i, column in enumerate(columns) if column in SHOWN]
    arguments = [_scalar("t", time), *(_scalar(camel(n), symbol) for n, symbol in free.items())]
    return function(
        f"{camel(name)}Motion",
        f"{capital(name.replace('_', ' '))}: attitude (4), rate (3), specific force (3), position "
        "(3) at the time t",
        arguments,
        shown[rows],
        (len(rows),),
        f"drive {name}",
        positive={"rampTime"},
    )


def _text(within: str, f: Function) -> str:
    return GENERATED + rendered("functions.mo", within=within, f=f, documentation="")
