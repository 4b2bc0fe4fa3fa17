"""The filter of a part as the block ``StrapdownIns``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

import casadi as ca

from pyimu.attitude.filter.filter_block import left_in_words
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.updates import where
from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.block.structured import Structured
from pyimu.block.variables import Variable
from pyimu.ins.filter import prediction, rest_judged, rest_left, updates
from pyimu.ins.filter import start as beginning
from pyimu.ins.filter.layout import (
    BASE,
    GYRO_BIAS,
    RESTING,
    TURN,
    VELOCITY,
    Layout,
    Memory,
    State,
)
from pyimu.ins.filter.layout import POSITION as PLACE
from pyimu.ins.filter.variables import (
    OUTPUTS,
    POSITION,
    POSITION_VALID,
    POSITION_VARIANCE,
    SPEED,
    SPEED_VALID,
    SPEED_VARIANCE,
    VELOCITY_VALID,
    VELOCITY_VARIANCE,
)
from pyimu.ins.filter.variables import VELOCITY as MEASURED_VELOCITY
from pyimu.model.part import Part
from pyimu.symbolic import quaternion

OPTIONS = {"cse": True}

KINDS = ("zupt", "zaru", "nhc", "position", "velocity", "speed")
"""Updates whose normalised innovations squared are kept, in the order of the outputs."""

BITS = (2, 4, 8, 16, 32, 64)
"""Those of the status that say that one of them was weighed down."""

NO_VARIANCE = 128
"""That which says that a variance is none."""

FREEDOM = (3, 3, 2, 3, 3, 1)

REPORT = len(KINDS)
"""What goes with the estimate through the updates of a sample: their normalised innovations."""


def strapdown_ins(part: Part, nhc: bool = True, detects: bool = True) -> Block:
    """The block ``StrapdownIns`` of a part; with ``nhc`` it can take a vehicle's constraint, which
    then is the parameter of that name, at first off, and estimates what lasts of the errors of its
    wheels: of a measured speed and of the point that does not slip. Where it ``detects``, it finds
    rests by itself, and is told of others.

    Attitude, velocity and position from gyro and accelerometer by strapdown integration, corrected
    at rests (zero-velocity and zero-angular-rate updates), by a vehicle's wheels, and by a measured
    speed, velocity or position; 15 errors are estimated, and the scale factors and misalignments
    that the part leaves open.
    """
    return _block(Layout(part, nhc, detects, wheels=nhc), recorded=False, constrained=False)


@lru_cache(maxsize=16)
def ins_of_log(layout: Layout, recorded: bool = False) -> Block:
    """The block that runs over a log; where it is ``recorded``, with what a smoother needs."""
    return _block(layout, recorded, constrained=layout.nhc)


def _block(layout: Layout, recorded: bool, constrained: bool) -> Block:
    part = layout.part
    parameters = tuple(
        v if v.name != "nhc" or constrained else _started(v, 0.0) for v in layout.parameters
    )
    p = ca.SX.sym("p", len(parameters))
    u = ca.SX.sym("u", len(layout.inputs))
    settings = prediction.settings_of(layout, p)
    start = beginning.zero(layout, settings)
    state = ca.vertcat(layout.pack(start), prediction.empty(layout, settings).pack())
    names = (*OUTPUTS, *_recorded_names(layout)) if recorded else OUTPUTS
    shown = _outputs(layout, start, settings, ca.SX.zeros(REPORT), ca.SX(0), ca.SX(0))
    shown = ca.vertcat(shown, ca.SX.zeros(len(names) - len(OUTPUTS)))
    return Block(
        name="StrapdownIns",
        description=(
            "Attitude, velocity and position by strapdown integration, with zero-velocity and "
            f"zero-angular-rate updates, for the part {part.name}{left_in_words(part)}"
        ),
        step=_step(Structured(layout.structure, layout), recorded),
        initial=plain_function("initial", [u, p], [state, shown], ["u", "p"], ["s", "y"]),
        inputs=layout.inputs,
        parameters=parameters,
        outputs=names,
        noise=(),
        sample_period=1.0 / part.sample_rate,
    )


def _started(v: Variable, start: float) -> Variable:
    return replace(v, start=start)


def _recorded_names(layout: Layout) -> tuple[Variable, ...]:
    n = layout.errors
    sizes = {"before": layout.packed - layout.nominal, "after": layout.packed, "moved": n}
    sizes |= {"transition": n * n}
    return tuple(Variable(f"{name}[{i + 1}]") for name, size in sizes.items() for i in range(size))


@lru_cache(maxsize=16)
def _step(made: Structured[Layout], recorded: bool) -> ca.Function:
    layout = made.of
    sizes = {"s": layout.state, "u": len(layout.inputs), "p": len(layout.parameters), "h": 1}
    s, u, p, h = (ca.MX.sym(name, size) for name, size in sizes.items())
    found = _predict(layout)(s, u, p, h)
    x, memory, rate, force, status, rest, unturned, slow, *left, transition = found
    n, begun = layout.errors, s[layout.begun]
    starts = ca.logic_and(begun <= 0, memory[layout.begun - layout.packed] > 0)
    x = where(starts, _first(layout), x, memory, p)
    if layout.detects:
        both = ca.vertcat(x, transition)
        both = where(left[0] >= rest_judged.ANEW, _left(layout), both, *left, p)
        x, transition = both[: layout.packed], both[layout.packed :]
    work = ca.vertcat(x, ca.MX.zeros(REPORT + n))
    nominal_at = {v.name: i for i, v in enumerate(layout.parameters)}

    def setting(name: str):
        return p[nominal_at[name]] > 0

    still = ca.logic_and(rest > 0.5, begun > 0)
    stands = ca.logic_or(still, slow > 0)
    work = where(ca.logic_and(stands, setting("zupt")), _zupt(layout), work, slow, p, h)
    even = ca.logic_and(ca.logic_and(unturned > 0.5, begun > 0), status <= 0)
    work = where(ca.logic_and(even, setting("zaru")), _zaru(layout), work, rate, p, h)
    if layout.nhc:
        free = ca.logic_and(ca.logic_not(still), ca.logic_and(setting("nhc"), begun > 0))
        work = where(ca.logic_and(free, status <= 0), _nhc(layout), work, rate, p, h)
    measured = u[SPEED_VALID] + u[POSITION_VALID] + u[VELOCITY_VALID] > 0.5
    work = where(measured, _measured(layout), work, u, rate, force, p, h)
    after = work[: layout.packed]
    y = _finish(layout)(work, p, status, still)
    if recorded:
        before = x[layout.nominal : layout.packed]
        y = ca.vertcat(y, before, after, work[layout.packed + REPORT :], transition)
    return plain_function(
        "step",
        [s, u, p, ca.MX(0, 1), h],
        [ca.vertcat(after, memory), y],
        ["s", "u", "p", "w", "h"],
        ["s_next", "y"],
    )


def _predict(layout: Layout) -> ca.Function:
    """``s, u, p, h -> x, memory, rate, force, status, still, unturned, slow, left, transition``, to
    updates.

    The force is the mean one, empty without wheels.
    """
    s = ca.SX.sym("s", layout.state)
    u, p, h = (
        ca.SX.sym(name, size)
        for name, size in (("u", len(layout.inputs)), ("p", len(layout.parameters)), ("h", 1))
    )
    settings = prediction.settings_of(layout, p)
    x = layout.unpack(s)
    memory = Memory.unpack(s[layout.packed :], layout)
    sample = prediction.read(layout, memory, x.q, x.gyro_bias, u, settings, h)
    measured = u[SPEED_VALID] + u[POSITION_VALID] + u[VELOCITY_VALID] > 0.5
    sample = prediction.with_rest(layout, x, memory, sample, measured, settings, h)
    after, transition, motion = prediction.predicted(layout, x, memory, sample, settings, h)
    packed = ca.if_else(memory.begun > 0, layout.pack(after), s[: layout.packed])
    kept = prediction.remembered(memory, sample, motion, h).pack()
    return plain_function(
        "predict",
        [s, u, p, h],
        [
            *(packed, kept, sample.rate, motion[-1], sample.lost),
            *(sample.still, sample.unturned, sample.slow),
            *(ca.densify(v) for v in sample.left),
            ca.densify(transition[:]),
        ],
        OPTIONS,
    )


def _left(layout: Layout) -> ca.Function:
    """``x and transition, left, p -> x and transition`` of a body that has left its rest."""
    n = layout.errors
    both = ca.SX.sym("b", layout.packed + n * n)
    left = [ca.SX.sym(f"a{i}", size) for i, size in enumerate(rest_judged.SIZES)]
    p = ca.SX.sym("p", len(layout.parameters))
    x, transition = layout.unpack(both), ca.reshape(both[layout.packed :], n, n)
    seen, settings = rest_judged.Left(*left), prediction.settings_of(layout, p)
    change, x, transition = rest_left.corrected(layout, x, transition, seen, settings)
    out = ca.densify(ca.vertcat(layout.pack(updates.changed(layout, x, change)), transition[:]))
    return plain_function("left", [both, *left, p], [out], OPTIONS)


def _first(layout: Layout) -> ca.Function:
    """``x, memory, p -> x`` of the first sample with a force."""
    x = ca.SX.sym("x", layout.packed)
    packed = ca.SX.sym("memory", layout.state - layout.packed)
    p = ca.SX.sym("p", len(layout.parameters))
    force = Memory.unpack(packed, layout).force
    first = beginning.first(layout, force, prediction.settings_of(layout, p))
    return plain_function("first", [x, packed, p], [layout.pack(first)], OPTIONS)


def _update(layout: Layout, name: str, kind: str, correct: Callable, *sizes: int) -> ca.Function:
    """``work, ... -> work`` of an update; ``work`` is the estimate, the report, what was moved."""
    n, at = layout.errors, KINDS.index(kind)
    w = ca.SX.sym("w", layout.packed + REPORT + n)
    more = [ca.SX.sym(f"a{i}", size) for i, size in enumerate(sizes)]
    x, nis, change = correct(layout.unpack(w), *more)
    report = w[layout.packed : layout.packed + REPORT]
    report[at] = nis
    moved = w[layout.packed + REPORT :] + change
    out = ca.vertcat(layout.pack(x), report, moved)
    return plain_function(name, [w, *more], [ca.densify(out)], OPTIONS)


def _zupt(layout: Layout) -> ca.Function:
    def correct(x: State, slow, p, h):
        settings = prediction.settings_of(layout, p)
        return updates.by_zero_velocity(layout, x, slow, settings, h)

    return _update(layout, "by_zero_velocity", "zupt", correct, 1, len(layout.parameters), 1)


def _zaru(layout: Layout) -> ca.Function:
    def correct(x: State, rate, p, h):
        return updates.by_zero_rate(layout, x, rate, prediction.settings_of(layout, p), h)

    return _update(layout, "by_zero_rate", "zaru", correct, 3, len(layout.parameters), 1)


def _nhc(layout: Layout) -> ca.Function:
    def correct(x: State, rate, p, h):
        return updates.by_vehicle(layout, x, rate, prediction.settings_of(layout, p), h)

    return _update(layout, "by_vehicle", "nhc", correct, 3, len(layout.parameters), 1)


def _speed(layout: Layout) -> ca.Function:
    def correct(x: State, speed, variance, rate, force, p, h):
        settings = prediction.settings_of(layout, p)
        return updates.by_speed(layout, x, speed, variance, (rate, force), settings, h)

    sizes = 1, 1, 3, 3 * layout.wheels, len(layout.parameters), 1
    return _update(layout, "by_speed", "speed", correct, *sizes)


def _position(layout: Layout) -> ca.Function:
    def correct(x: State, position, variance, p):
        settings = prediction.settings_of(layout, p)
        return updates.by_position(layout, x, position, variance, settings)

    return _update(layout, "by_position", "position", correct, 3, 1, len(layout.parameters))


def _velocity(layout: Layout) -> ca.Function:
    def correct(x: State, velocity, variance, rate, p, h):
        settings = prediction.settings_of(layout, p)
        return updates.by_velocity(layout, x, velocity, variance, rate, settings, h)

    return _update(layout, "by_velocity", "velocity", correct, 3, 1, 3, len(layout.parameters), 1)


def _measured(layout: Layout) -> ca.Function:
    """``work, u, rate, force, p, h -> work`` of what was measured beside these."""
    work = begun = ca.MX.sym("w", layout.packed + REPORT + layout.errors)
    u = ca.MX.sym("u", len(layout.inputs))
    rate, force = ca.MX.sym("rate", 3), ca.MX.sym("force", 3 * layout.wheels)
    p, h = ca.MX.sym("p", len(layout.parameters)), ca.MX.sym("h")
    for valid, function, value, variance, more in (
        (SPEED_VALID, _speed, SPEED, SPEED_VARIANCE, (rate, force, p, h)),
        (VELOCITY_VALID, _velocity, MEASURED_VELOCITY, VELOCITY_VARIANCE, (rate, p, h)),
        (POSITION_VALID, _position, POSITION, POSITION_VARIANCE, (p,)),
    ):
        work = where(u[valid] > 0.5, function(layout), work, u[value], u[variance], *more)
    return plain_function("measured", [begun, u, rate, force, p, h], [work])


def _finish(layout: Layout) -> ca.Function:
    w = ca.SX.sym("w", layout.packed + REPORT + layout.errors)
    p = ca.SX.sym("p", len(layout.parameters))
    lost, still = ca.SX.sym("lost"), ca.SX.sym("still")
    report = w[layout.packed : layout.packed + REPORT]
    settings = prediction.settings_of(layout, p)
    y = _outputs(layout, layout.unpack(w), settings, report, lost, still)
    return plain_function("finish", [w, p, lost, still], [y], OPTIONS)


def _outputs(layout: Layout, x: State, settings: Settings, report, lost, still) -> ca.SX:
    """The outputs (``OUTPUTS``) as a column."""
    p, back = ca.SX(x.covariance), quaternion.to_matrix(quaternion.conjugate(x.q))
    p[GYRO_BIAS, GYRO_BIAS] = back @ p[GYRO_BIAS, GYRO_BIAS] @ back.T
    accel_bias, p[RESTING, RESTING] = beginning.bias_of(layout, x, settings)
    turned = prediction.about_the_centre(x.position - x.centre)
    for place, of_turn in ((VELOCITY, -ca.skew(x.velocity)), (PLACE, turned)):
        plain = ca.SX(3, layout.errors)
        plain[:, TURN], plain[:, place] = of_turn, ca.SX.eye(3)
        p[place, place] = plain @ x.covariance @ plain.T
    variances = ca.diag(p)[:BASE]
    std = ca.sqrt(ca.fmax(variances, 0))
    correlation = p[6, 7] / ca.fmax(std[6] * std[7], 1e-30)
    beyond = sum(
        (
            bit * (report[i] > updates.gate(freedom))
            for i, (bit, freedom) in enumerate(zip(BITS, FREEDOM, strict=True))
        ),
        lost + NO_VARIANCE * (ca.mmin(variances) < 0),
    )
    return ca.densify(
        ca.vertcat(
            x.q,
            quaternion.to_euler(x.q),
            x.velocity,
            x.position,
            x.gyro_bias,
            accel_bias,
            std,
            correlation,
            report,
            still,
            beyond,
        )
    )
