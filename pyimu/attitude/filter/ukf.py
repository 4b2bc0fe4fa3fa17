"""The attitude filter of a part as a block: an unscented filter on attitude error and gyro bias.

For each sample it does the following, in this order: replace what is not finite by the last good
value; undo the sensors' own errors; turn by the measured rate less bias and Earth rate; correct by
the direction of gravity, by a heading, and by a zero rate. Gravity shows in the velocity of a body
that stays in its place; until the tilt is known it is a sample of the specific force while the body
is quasi-static, else the mean force. Sources: Hidalgo 2012, sections 4 and 5; Crassidis and Markley
2003; Groves 2013, section 15.3.

The sample of a rate stands for the period that ends with it. The bias is what remains of the
compensated rate.

The step is made of functions that run only where they are needed: nearly every sample is ordinary,
with no update but gravity's.
"""

from __future__ import annotations

from functools import lru_cache

import casadi as ca

from pyimu.attitude.filter import marginal
from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.field_update import after_others, by_field
from pyimu.attitude.filter.filter_block import (
    filter_block,
    inputs_of_the_sample,
    step_function,
)
from pyimu.attitude.filter.gravity_update import (
    INNOVATION_GATE,
    by_velocity,
    corrected,
    push,
    scaled_in_gravity,
)
from pyimu.attitude.filter.layout import GRAVITY, Flags, GravityMeasurement, Layout
from pyimu.attitude.filter.look import look
from pyimu.attitude.filter.memory import ESTIMATE, SCALED, WORKING, Memory
from pyimu.attitude.filter.passed import PASSED, Transition, passed
from pyimu.attitude.filter.prediction import (
    ARGUMENTS,
    Instant,
    added_noise,
    is_awake,
    is_calibrated,
    predicted,
    rest_of,
)
from pyimu.attitude.filter.sample import Sample, look_closely, read
from pyimu.attitude.filter.updates import (
    after_gravity,
    bounded_where_lost,
    by_zero_rate,
    finish,
    where,
)
from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.block.prepared import Prepared, taken_apart
from pyimu.block.structured import Structured
from pyimu.model.effect import Effect
from pyimu.model.part import Part
from pyimu.symbolic import quaternion

OPTIONS = {"cse": True}


def attitude_ukf(part: Part, shows_now: bool = True) -> Block:
    """The filter ``AttitudeUkf`` of a part, a block.

    The part has ``gyro`` and ``accel`` (``Sensor``) and ``sample_rate`` in Hz.

    Where the gyro's samples are late, the outputs are turned on over its delay, as
    ``pyimu.attitude.filter.ahead`` says; without ``shows_now`` they are those of the instants at
    which the samples were taken. What ``Sensor.left_in`` names beside is not undone, and the
    standard deviations do not contain it. The state begins with q (4), bias (3) and the
    upper triangle of the covariance (21); ``pyimu.attitude.filter.memory`` has the rest.

    The equations are those of ``pyimu.attitude.filter.sigma_point_filter`` in their marginalised
    form (``pyimu.attitude.filter.marginal``).
    """
    return _of(part, shows_now, part.gyro.effects, part.accel.effects)


@lru_cache(maxsize=16)
def _of(part: Part, shows_now: bool, *effects: tuple[Effect, ...]) -> Block:
    """The filter of a part with these ``effects``: parts are equal where their numbers are."""
    layout = Layout(Compensation(part, shows_now))
    return filter_block("AttitudeUkf", "Unscented attitude filter", layout, _step_of(layout))


def recorded_ukf(part: Part) -> Block:
    """The same filter whose outputs are the rows (``PASSED``,) that a smoother goes back over.

    They are what ``pyimu.attitude.filter.passed.Passed`` packs, at the instants of the samples.
    """
    return _recorded(part, part.gyro.effects, part.accel.effects)


@lru_cache(maxsize=16)
def _recorded(part: Part, *effects: tuple[Effect, ...]) -> Block:
    layout, title = Layout(Compensation(part, False)), "Unscented attitude filter, recorded"
    step = _step_of(layout, recorded=True)
    return filter_block("AttitudeRecorded", title, layout, step, PASSED)


def _step_of(layout: Layout, recorded: bool = False) -> Prepared:
    """The step of the filter; its outputs are those of the unit, or all that a smoother needs."""
    return _step(Structured(layout.compensation.structure, layout), recorded)


@lru_cache(maxsize=16)
def _step(made: Structured[Layout], recorded: bool) -> Prepared:
    layout = made.of
    s, _, p, h = symbols = layout.symbols(ca.MX, "s u p h")
    constants, predict = _predict(layout, recorded)
    u, c = inputs_of_the_sample(layout, symbols), ca.MX.sym("c", constants.numel_out(0))
    x, memory, motion, due, rate, gravity, flags, *transition = predict(
        s[:ESTIMATE], s[ESTIMATE : layout.rings], u, c
    )
    motion = where(due, look(layout), motion, x, p, h)
    estimate, yaw, y, field = _updates(layout)(flags[0], x, s, u, p, h, rate, gravity, flags)
    if recorded:
        y = passed(y, estimate, x, transition[0], Flags.unpack(flags))
    step = step_function(layout, symbols, estimate, memory, motion, yaw, field, y, c)
    return Prepared(constants, step)


# Prediction


def _predict(layout: Layout, recorded: bool = False) -> tuple[ca.Function, ca.Function]:
    """``p, h -> c`` and ``estimate, memory, u, c -> x, memory, motion, due, rate, gravity, flags``,
    as ``predicted`` has them.

    Where it is ``recorded``, the transition of the error follows.

    An ordinary sample is taken as it was read; any other is looked at number by number. Of an
    ordinary one of a body that is awake most questions of rest need not be asked, and where its
    gyro is calibrated, none of scale factors.
    """
    symbols = layout.symbols(ca.SX, ARGUMENTS)
    at = Instant.of(layout, symbols)
    given = (layout.compensation, at.memory, at.u, at.settings, at.h)
    sample, is_ordinary = read(*given)
    # What this reads is read again by the row: handed over, a processor would wait for it.
    chosen = is_ordinary * (1 + is_awake(at) + 2 * is_calibrated(at))
    which = ca.Function("which_row", symbols, [chosen])
    rows = [
        _row("other_row", at, look_closely(*given), symbols, recorded),
        _row("ordinary_row", at, sample, symbols, recorded),
        _row("awake_row", at.awake(), sample, symbols, recorded),
        _row("calibrated_row", at.calibrated(), sample, symbols, recorded),
        _row("awake_calibrated_row", at.awake().calibrated(), sample, symbols, recorded),
    ]
    constants, (which, *rows) = taken_apart([which, *rows], [3, 4])
    row = ca.Function.conditional("row", rows[:-1], rows[-1])
    given = [*layout.symbols(ca.MX, "estimate memory u"), ca.MX.sym("c", constants.numel_out(0))]
    outputs = row(which(*given), *given)
    return constants, plain_function("predict", given, list(outputs), {"always_inline": True})


def _row(
    name: str, at: Instant, sample: Sample, symbols: list[ca.SX], recorded: bool
) -> ca.Function:
    """The prediction of one sample, in functions of the C library, too: in plain arithmetic, what
    settings alone decide would be written out for each row.
    """
    rest = rest_of(at, sample)
    noise = added_noise(at, sample, rest)
    pushed = push(at.memory, sample, at.settings, at.h, rest.surely)
    turn = (sample.rate, at.earth, rest.moving)
    scale_std = at.settings.scalar["scale_std"]
    x, turned = marginal.propagate(rest.before, *turn, noise, pushed, scale_std, at.h)
    out = predicted(at, sample, rest, x, turned, noise)
    if recorded:
        _, own, leak = marginal.turned(rest.before, *turn, at.h)
        set_back = rest.before.bias - at.memory.estimate.bias
        out.append(Transition.of(own, leak, rest.before, x, pushed, noise, set_back).pack())
    return ca.Function(name, symbols, out)


# Updates


def _updates(layout: Layout) -> ca.Function:
    """``which, x, s, u, p, h, rate, gravity, flags -> estimate, yaw, y, field``: the updates.

    There is none, the velocity's alone or with those of a zero rate and of the field, or whichever
    are needed.

    The usual cases are one function each, because every call from one function to another copies
    the estimate, and so does an update that is passed by; where the gyro is calibrated, without
    what scale factors make.
    """
    names = "x s u p h rate gravity flags"
    finished, velocity = finish(), by_velocity(marginal.correct)
    zero_rate, field = by_zero_rate(layout, marginal.correct), by_field(layout)

    def every() -> ca.Function:
        x, s, u, p, h, rate, gravity, flags = symbols = layout.symbols(ca.MX, names)
        before, asked = x, Flags.unpack(flags)
        x = bounded_where_lost(x, asked)
        x = where(asked.gravity, _by_gravity(), x, gravity)
        x = where(asked.velocity, velocity, x, gravity)
        x = after_gravity(layout, zero_rate, x, s, u, p, h, rate, gravity, asked)
        x, kept = after_others(layout, field, x, before, s, u, p, h, rate, flags)
        return plain_function("every_update", symbols, [*finished(x, flags), kept])

    def usual_and(name: str, at_rest: bool, in_field: bool) -> ca.Function:
        before, s, u, p, h, rate, gravity, flags = symbols = layout.symbols(ca.MX, names)
        x, kept = velocity(before, gravity), s[layout.field :]
        if at_rest:
            x = zero_rate(x, rate, p, h, Flags.unpack(flags).rest)
        if in_field:
            both = field(ca.vertcat(x, kept), before, u, p, h, rate, flags)
            x, kept = both[:WORKING], both[WORKING:]
        return plain_function(name, symbols, [*finished(x, flags), kept])

    x, s, _, p, h, rate, gravity, flags = plain = layout.symbols(ca.SX, names)

    def usual(name: str, x, updated: bool, at_rest: bool = False) -> ca.Function:
        """With the velocity's update, or none; and with that of a zero rate."""
        if updated:
            x = velocity.call([x, gravity], True, False)[0]
        if at_rest:
            x = zero_rate.call([x, rate, p, h, Flags.unpack(flags).rest], True, False)[0]
        out = [*finished.call([x, flags], True, False), s[layout.field :]]
        return plain_function(name, plain, out, OPTIONS)

    without_more = [usual("no_update", x, False), usual("usual_update", x, True)]
    calibrated = ca.SX(x)
    calibrated[SCALED] = 0
    of_calibrated = [
        usual("no_update_calibrated", calibrated, False),
        usual("usual_update_calibrated", calibrated, True),
        usual("update_at_rest_calibrated", calibrated, True, True),
    ]
    with_more = [
        usual_and("update_at_rest", True, False),
        usual_and("update_in_field", False, True),
        usual_and("update_at_rest_in_field", True, True),
    ]
    chosen = [*without_more, *with_more, *of_calibrated]
    return ca.Function.conditional("updates", chosen, every())


def _by_gravity() -> ca.Function:
    """``x, gravity -> x``: the force against gravity in body axes, R_nb^T [0, 0, g]."""
    symbols = working, packed = [ca.SX.sym("x", WORKING), ca.SX.sym("gravity", GRAVITY)]
    x, given = Memory.attitude_of(working), GravityMeasurement.unpack(packed)
    axes = quaternion.to_matrix(x.q)
    mean, variance, cross = marginal.measure_gravity(x, axes, given.magnitude)
    after, nis, weight = marginal.correct(
        x,
        given.force - mean,
        variance + ca.diag(given.variance),
        cross,
        axes[2, :].T,
        INNOVATION_GATE,
        variance + ca.diag(given.sample_variance),
        seen=scaled_in_gravity(x, mean),
    )
    out = corrected(working, given, after, nis, weight)
    return plain_function("by_gravity", symbols, [out], OPTIONS)
