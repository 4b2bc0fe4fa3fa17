"""Functions of attitude and of a rover's drives, printed from the package's own."""

from __future__ import annotations

import html
import inspect
import re
from collections.abc import Callable, Mapping

import casadi as ca

from pyimu.modelica.functions import Function, array, function
from pyimu.modelica.names import camel
from pyimu.modelica.text import GENERATED, capital, rendered
from pyimu.plant.rover_drive import by_name, on_level_ground, rover_drive
from pyimu.plant.rover_variables import DRIVES
from pyimu.symbolic import earth, mrp, quaternion

CHOSEN = {
    "straight": ("cruise_speed", "length"),
    "obstacle": ("cruise_speed", "length"),
    "ackermann": ("cruise_speed", "radius", "angle"),
    "turn_on_spot": ("spot_turn_rate", "angle", "pause"),
}
"""Parameters of each drive that stay parameters, beside those of all."""

SHOWN = ("q", "rate", "specific_force", "position")
"""Outputs of the drives, in the order of the functions' results."""

DRIVE = (
    "<p>Hidalgo 2012, section 6.1. The speed rises and falls along 10 x^3 - 15 x^4 + 6 x^5. The "
    "rate contains the Earth's rotation, the force gravity and Coriolis' force; printed "
    "from the unit RoverDrive, on level ground and without vibration.</p>"
)

EVERY = ("start_time", "heading0", "ramp_time", "latitude", "gravity")
"""Parameters that stay parameters of all drives."""


def _levelled(force: ca.SX, yaw: ca.SX) -> ca.SX:
    """The attitude at rest of this specific force (3,), which shows roll and pitch.

    Groves 2013, section 5.6.2 (levelling), in forward-left-up axes.
    """
    across = ca.sqrt(force[1] * force[1] + force[2] * force[2])
    return quaternion.from_euler(ca.atan2(force[1], force[2]), ca.atan2(-force[0], across), yaw)


ATTITUDE: Mapping[str, tuple[str, Callable[..., ca.SX], Mapping[str, int]]] = {
    "quaternionProduct": (
        "q r, the rotation by r followed by that by q",
        quaternion.product,
        {"q": 4, "r": 4},
    ),
    "quaternionConjugate": ("The inverse of a unit quaternion", quaternion.conjugate, {"q": 4}),
    "quaternionNormalized": ("q at unit length", quaternion.normalized, {"q": 4}),
    "quaternionRotate": (
        "A vector of the body in world axes",
        quaternion.rotate,
        {"q": 4, "v": 3},
    ),
    "quaternionDerivative": (
        "Derivative of q of a body that turns at a rate in body axes",
        quaternion.derivative,
        {"q": 4, "rate": 3},
    ),
    "quaternionFromEuler": (
        "The quaternion of Rz(yaw) Ry(pitch) Rx(roll)",
        quaternion.from_euler,
        {"roll": 1, "pitch": 1, "yaw": 1},
    ),
    "quaternionToEuler": ("Roll, pitch, yaw", quaternion.to_euler, {"q": 4}),
    "mrpFromQuaternion": (
        "Modified Rodrigues parameters, in rad for small angles",
        mrp.from_quaternion,
        {"q": 4},
    ),
    "mrpToQuaternion": (
        "The quaternion of modified Rodrigues parameters",
        mrp.to_quaternion,
        {"p": 3},
    ),
    "mrpErrorDerivative": (
        "Derivative of the attitude error p of an estimate whose rate is wrong by rateError",
        mrp.error_derivative,
        {"p": 3, "rate": 3, "rateError": 3},
    ),
    "earthRate": ("The Earth's rotation in world axes, rad/s", earth.earth_rate, {"latitude": 1}),
    "levelled": (
        "Attitude of a body at rest by its specific force, with a given yaw",
        _levelled,
        {"force": 3, "yaw": 1},
    ),
}
"""Functions of attitude: what each gives, the function, its arguments and their sizes."""


def attitude_texts() -> dict[str, str]:
    """Name to text of the functions of attitude."""
    found = {}
    for name, (text, of, sizes) in ATTITUDE.items():
        symbols = {n: ca.SX.sym(n, size) for n, size in sizes.items()}
        expression = of(*symbols.values())
        arguments = [
            array(n, (sizes[n],) if sizes[n] > 1 else (), symbol) for n, symbol in symbols.items()
        ]
        size = (expression.numel(),)
        found[name] = function(name, text, arguments, expression, size, f"function {name}")
    return {
        name: _text("PyImu.Attitude.Functions", f, _page(ATTITUDE[name][1]))
        for name, f in found.items()
    }


def _page(of: Callable[..., ca.SX]) -> str:
    """The docstring of a function as paragraphs, its arguments named as Modelica has them."""
    text = (inspect.getdoc(of) or "").replace("``", "")
    text = re.sub(r"\b[a-z]+_[a-z_]+\b", lambda found: camel(found[0]), text)
    paragraphs = (html.escape(" ".join(p.split()), quote=False) for p in text.split("\n\n"))
    return "\n".join(f"<p>{p}</p>" for p in paragraphs)


def drive_texts() -> dict[str, str]:
    """Name to text of the motion of each of the test drives."""
    return {f.name: _text("PyImu.Rover.Functions", f, DRIVE) for f in map(_drive, CHOSEN)}


def _drive(name: str) -> Function:
    """Attitude, rate, specific force and position (13,) at a time of a drive on level ground."""
    block = rover_drive(1.0, name)
    time = ca.SX.sym("time")
    free = {n: ca.SX.sym(n) for n in (*EVERY, *CHOSEN[name])}
    fixed = {"drive": DRIVES[name], "roughness": 0.0}
    p = [free.get(v.name, ca.SX(fixed.get(v.name, v.start))) for v in block.parameters]
    shown = on_level_ground(time, by_name(block.parameters, ca.vertcat(*p)))
    columns = [v.name.partition("[")[0] for v in block.outputs]
    rows = [i for i, column in enumerate(columns) if column in SHOWN]
    arguments = [array("t", (), time), *(array(camel(n), (), x) for n, x in free.items())]
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


def _text(within: str, f: Function, documentation: str) -> str:
    return GENERATED + rendered("functions.mo", within=within, f=f, documentation=documentation)
