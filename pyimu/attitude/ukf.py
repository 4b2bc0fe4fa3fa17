"""The attitude filter of a part as a block: an unscented filter on attitude error and gyro bias.

One sample does the following, in this order: hold what is not finite; undo the sensors' own errors;
turn by the measured rate less bias and Earth rate; correct by gravity's direction, by a heading,
and by a zero rate. Gravity is a sample of the specific force while quasi-static, else the mean
force. Sources: Hidalgo 2012, sections 4 and 5; Crassidis and Markley 2003.

The sample of a rate stands for the period that ends with it. The bias is what remains of the
compensated rate.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import casadi as ca

from pyimu.attitude import correction, late_heading
from pyimu.attitude.compensation import Compensation
from pyimu.attitude.memory import ESTIMATE, WORKING, Memory, n_state, start
from pyimu.attitude.prediction import FLAGS, predict
from pyimu.attitude.variables import INPUTS, OUTPUTS, OWN_PARAMETERS
from pyimu.block.block import Block
from pyimu.model.part import Part
from pyimu.symbolic import quaternion

Form = Literal["marginal", "reference"]


def attitude_ukf(part: Part, form: Form = "marginal") -> Block:
    """The filter ``AttitudeUkf`` of a part with ``gyro`` and ``accel`` (``Sensor``) and
    ``sample_rate`` in Hz.

    ``form`` "marginal" is fast (``pyimu.attitude.marginal``), "reference" the plain filter of 13
    points (``pyimu.attitude.unscented``); both make the same estimates. What ``Sensor.left_in``
    names, such as a lag or a delay, is not undone: the estimate is late by it, and its standard
    deviations say nothing of that. The state begins with q (4), bias (3) and the upper triangle of
    the covariance (21); ``pyimu.attitude.memory`` has the rest.
    """
    compensation = Compensation(part)
    inputs = (*INPUTS, *compensation.extra_inputs)
    parameters = (*OWN_PARAMETERS, *part.gyro.variables, *part.accel.variables)
    p = ca.SX.sym("p", len(parameters))
    estimate, state = start(compensation, p)
    initial = ca.Function("initial", [p], [state, _shown(estimate, 0, 0, 0)], ["p"], ["s", "y"])
    return Block(
        name="AttitudeUkf",
        description=_description(part),
        step=_step(compensation, len(inputs), len(parameters), form),
        initial=initial,
        inputs=inputs,
        parameters=parameters,
        outputs=OUTPUTS,
        noise=(),
        sample_period=1.0 / part.sample_rate,
    )


def _description(part: Part) -> str:
    """One line, with what of the sensors' errors the filter leaves in."""
    left = [
        f"{name} of the {sensor.kind}"
        for sensor in (part.gyro, part.accel)
        for name in sensor.left_in
    ]
    stays = (
        f"; not undone, and in no standard deviation but that of rounding: {', '.join(left)}"
        if left
        else ""
    )
    return f"Unscented attitude filter of the part {part.name}{stays}"


def _step(compensation: Compensation, n_inputs: int, n_parameters: int, form: Form) -> ca.Function:
    """The step out of functions that are called where they are needed: a heading that is not there
    takes no time.
    """
    n = n_state(compensation)
    ring = n - 2 * late_heading.SLOTS
    s, u, p, h = (
        ca.MX.sym(name, size)
        for name, size in (("s", n), ("u", n_inputs), ("p", n_parameters), ("h", 1))
    )
    x, kept, rate, gravity, flags = predict(compensation, n_inputs, n_parameters, form)(
        s[:ESTIMATE], s[ESTIMATE:ring], u, p, h
    )
    x, yaw, y = _updates(compensation, n_inputs, n_parameters, form)(
        flags[0], x, s, u, p, h, rate, gravity, flags
    )
    rings = s[ring:]
    rings.nz[kept[-2] + ca.DM([0, late_heading.SLOTS])] = ca.vertcat(yaw, kept[-3])
    return ca.Function(
        "step",
        [s, u, p, ca.MX(0, 1), h],
        [ca.vertcat(x, kept, rings), y],
        ["s", "u", "p", "w", "h"],
        ["s_next", "y"],
    )


def _updates(
    compensation: Compensation, n_inputs: int, n_parameters: int, form: Form
) -> ca.Function:
    """``which, x, s, u, p, h, rate, gravity, flags -> estimate, yaw, y``: no update, gravity's
    alone, or what more is wanted.

    What is usual stands in one function each, as every call from one to another copies the
    estimate.
    """
    sizes = {
        "x": WORKING,
        "s": n_state(compensation),
        "u": n_inputs,
        "p": n_parameters,
        "h": 1,
        "rate": 3,
        "gravity": correction.GRAVITY,
        "flags": FLAGS,
    }
    x, _, _, _, _, _, gravity, flags = plain = [
        ca.SX.sym(name, size) for name, size in sizes.items()
    ]
    corrected, finish = correction.by_gravity(form), _finish()
    none, usual = (
        ca.Function(name, plain, finish.call([value, flags], True, False), {"cse": True})
        for name, value in (
            ("no_update", x),
            ("usual_update", corrected.call([x, gravity], True, False)[0]),
        )
    )
    x, s, u, p, h, rate, gravity, flags = given = [
        ca.MX.sym(name, size) for name, size in sizes.items()
    ]
    _, use_gravity, _, lost, heading, still, *_ = ca.vertsplit(flags)
    x = _where(
        lost * use_gravity, correction.bounding_tilt(), _where(lost, correction.bounding(), x)
    )
    x = _where(use_gravity, corrected, x, gravity)
    x = _where(
        heading,
        correction.by_heading(compensation, n_inputs, n_parameters),
        x,
        s,
        u,
        p,
        h,
        rate,
        flags[-1],
    )
    x = _where(still, correction.by_zero_rate(compensation, n_parameters), x, rate, p, h)
    every = ca.Function("every_update", given, finish(x, flags))
    return ca.Function.conditional("updates", [none, usual], every)


def _where(condition, function: ca.Function, values, *more):
    """``function(values, *more)`` where ``condition`` holds, else ``values``; the function runs
    only then.
    """
    symbols = [ca.MX.sym(f"i{i}", function.numel_in(i)) for i in range(function.n_in())]
    same = ca.Function(f"without_{function.name()}", symbols, [symbols[0]])
    return ca.Function.if_else(f"perhaps_{function.name()}", function, same)(
        condition, values, *more
    )


def _finish() -> ca.Function:
    """The estimate at unit length, its yaw as the ring keeps it, and the outputs."""
    given, flags = ca.SX.sym("x", WORKING), ca.SX.sym("flags", FLAGS)
    x = Memory.estimate_of(given)
    q = quaternion.normalized(x.q)
    nis, doubted, old, refused, held_back, contradicted = ca.vertsplit(given[ESTIMATE:])
    quasi_static, missing, status = flags[2], flags[6], flags[7]
    no_variance = 1 - ca.mmin(ca.diag(x.covariance) > 0)
    status += (
        missing
        + refused
        - missing * refused
        + 8 * doubted
        + 16 * old
        + 32 * held_back
        + 64 * contradicted
        + 128 * no_variance
    )
    y = _shown(replace(x, q=q), quasi_static, nis * quasi_static, status)
    level = (1 - 2 * (q[2] * q[2] + q[3] * q[3])) ** 2 + (
        2 * (q[1] * q[2] + q[0] * q[3])
    ) ** 2 > correction.LEVEL**2
    yaw = ca.if_else(level, y[6] - given[ESTIMATE - 1], late_heading.NEVER)
    return ca.Function(
        "finish", [given, flags], [ca.vertcat(q, given[4:ESTIMATE]), yaw, y], {"cse": True}
    )


def _shown(x, quasi_static, nis, status) -> ca.SX:
    std = [ca.sqrt(ca.fmax(x.covariance[i, i], 0)) for i in range(6)]
    return ca.densify(
        ca.vertcat(x.q, quaternion.to_euler(x.q), x.bias, *std, quasi_static, nis, status)
    )
