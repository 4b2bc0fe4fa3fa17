"""From one sample to the next: the row without the sensors' errors, the strapdown step, the noise.

The error state is what the truth has beyond the estimate: q_true = exp(phi) q in world axes,
v_true = exp(phi) (v + e), p_true = c + exp(z) (p - c + o), where z is the upright part of phi, the
difference of gains M, and those of gyro bias b and resting force s turned into world axes,
d = R (b_true - b), r = R (s_true - s). The resting force is what the accelerometer would show at
rest in the present attitude, b_a + (1 + M) R^T c, where c is gravity's reaction, upwards. Of rates
and forces measured = (1 + M) true + bias + noise, with the Earth's rate w_e, A = R (1 + M) R^T and
a = (1 + M)^-1 (f - s),

    phi' = -d - R (d_M w + n_g) - w_e x phi,
    e' = v x phi' - r - R (d_M a + n_a) - 2 w_e x e,
    o' = e + (phi - z) x v + (p - c) x z',    d' = (R w) x d,
    r' = (R w) x r - A ((R w) x (c x phi) - c x phi') - R d_M (w x R^T c).

At rest, where the estimate stands still in the world whatever its heading is, phi' = 0.

It is the error of the invariant filter (Barrau and Bonnabel 2017), with the sensors' errors turned
along. In body axes and with the plain difference of velocities (Groves 2013, section 14.2.4), what
cannot be told apart has a direction in the state that follows the estimate: a tilt from a bias of
the accelerometer at rest, a yaw from the direction of the velocity. Each correction then turns it,
and the filter seems to see it from several sides and learns from nothing: within 10 s at rest a
bias known to 50 mg became one known to 19 mg by its own noise. Here these directions stay.

A rest tells s, and of tilt, bias and gains only that together they make it. As s is a state, what a
rest knows is one number of the state, whatever the tilt: at rest and along a straight leg all of
it is linear, however large the errors. With the bias as the state, the weight of a body tilted by
phi is wrong by c phi^2 / 2, 13 mm/s^2 for 3 deg, where the rest knows it to 1 mm/s^2. Linear in
small angles alone is what a turn does: see ``weight``. And what of a tilt comes up on the way, by
the gyro's errors, bends the weight once more: see ``_bending`` and ``updates``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.filter import rest_judged, rest_level, rest_window
from pyimu.ins.filter.layout import (
    BASE,
    GYRO_BIAS,
    HEADING,
    PLANE,
    POSITION,
    RESTING,
    TURN,
    UP,
    VELOCITY,
    Layout,
    Memory,
    State,
)
from pyimu.ins.filter.mechanisation import moved, turned
from pyimu.ins.filter.rest_hidden import Hidden
from pyimu.ins.filter.rest_judged import Judged
from pyimu.ins.filter.variables import (
    ACCEL,
    GYRO,
    INPUTS,
    POSITION_VALID,
    STATIONARY,
    TEMPERATURE,
)
from pyimu.ins.filter.weight import (
    TINY,
    Wander,
    bowed,
    earth_by_turn,
    followed,
    in_world,
    upright_of,
)
from pyimu.ins.pushes import FORCE_STAYS, LEAST_SPEED
from pyimu.model.signals import SIGNALS
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import symmetric
from pyimu.symbolic.missing import is_finite

ABSURD = 1e6
"""rad/s and m/s^2; what is larger is no number of a sensor."""

OPTIONS = {"cse": True}

MEAN_TIME = 0.3
"""s; of the mean rate by which the transition knows a turn. With the samples themselves there, the
filter would learn from their noise what only a turn shows: the tilt apart from the accelerometer's
bias."""


TURN_TIME = 1.0
"""s; so long a turn is taken to last on during which the gyro was lost: of an axis without numbers
the last rate fades out in that time."""

SHOCK = 0.1
"""s; so long a force may be beyond the accelerometer's range, as that of a step or a stone is: what
stays there longer is stuck, and no number. Assumed."""

LASTS = (10 / 3, 10.0)
"""s; a rest and a leg. Over them white noise and random walk stand for the part's correlated noise,
of which a rest takes off what came before."""


@dataclass(frozen=True)
class Sample:
    """A row: what was measured, in place of a missing number its last good one (``held``); ``rate``
    and ``force`` (3,) without the part's errors; which axes of gyro and accelerometer (3,) are
    ``lost``, 0 or 1, and which have a number (``rate_there``, ``force_there``): the lost ones among
    them are beyond their range; whether the body is at rest (``still``), does not turn
    (``unturned``), or is now seen to have ``left`` a rest; the square of the speed of a drive of
    which no more is known than that it is ``slow``, else 0, and what variance of the position a
    rest ``hides``; whether its position is measured (``placed``); the compensation's memory, the
    window's, and what judges it.
    """

    held: ca.SX
    rate: ca.SX
    force: ca.SX
    gyro_lost: ca.SX
    accel_lost: ca.SX
    rate_there: ca.SX
    force_there: ca.SX
    still: ca.SX
    unturned: ca.SX
    left: rest_judged.Left
    slow: ca.SX
    hides: ca.SX
    placed: ca.SX
    sensors: ca.SX
    window: ca.SX
    level: ca.SX
    judged: ca.SX
    hidden: ca.SX

    @property
    def lost(self):
        """Whether anything of it is lost, 0 or 1."""
        return ca.fmax(ca.mmax(self.gyro_lost), ca.mmax(self.accel_lost))

    @property
    def blind(self):
        """Whether an axis of the accelerometer has no number, 0 or 1."""
        return 1 - ca.mmin(self.force_there)


def settings_of(layout: Layout, p) -> Settings:
    return Settings.of(layout.compensation, p, layout.own_parameters, LASTS)


def read(layout: Layout, memory: Memory, q, bias, u, settings: Settings, h) -> Sample:
    """The sample of the inputs ``u``; ``q`` and the gyro's ``bias`` (3,) are as they were."""
    extra, at = [], len(INPUTS)
    for name in layout.compensation.extra:
        extra.append(u[at : at + SIGNALS[name].size])
        at += SIGNALS[name].size
    raw = ca.vertcat(u[GYRO], u[ACCEL], u[TEMPERATURE], *extra)
    good = ca.logic_and(is_finite(raw), ca.fabs(raw) <= ABSURD)
    held = ca.if_else(good, raw, memory.held)
    known = {
        "rate": held[GYRO],
        "specific_force": held[ACCEL],
        "temperature": held[6],
        "attitude": q,
        "latitude": settings.latitude,
        "latitude_known": settings.known,
    }
    row = 7
    for name in layout.compensation.extra:
        known[name] = held[row : row + SIGNALS[name].size]
        row += SIGNALS[name].size
    sensors, rate, force, gyro_lost, accel_lost = layout.compensation.apply(
        memory.sensors, known, settings.gyro_p, settings.accel_p, h
    )
    fades = ca.if_else(good[GYRO], 1, ca.exp(-memory.gyro_lost / TURN_TIME))
    gyro_lost = 1 - good[GYRO] * (ca.densify(gyro_lost) <= 0.5)
    accel_lost = 1 - good[ACCEL] * (ca.densify(accel_lost) <= 0.5)
    still = is_finite(u[STATIONARY]) * (u[STATIONARY] > 0.5)
    rate = bias + fades * (rate - bias)
    kept = sensors, memory.window, memory.level, memory.judged, memory.hidden
    placed = u[POSITION_VALID] > 0.5
    there = good[ACCEL] * (memory.accel_lost < SHOCK)
    lost = gyro_lost, accel_lost, good[GYRO], there
    nothing = rest_judged.NOTHING, ca.SX(0), ca.SX(0)
    return Sample(held, rate, force, *lost, still, still, *nothing, placed, *kept)


def with_rest(
    layout: Layout, x: State, memory: Memory, sample: Sample, measured, settings: Settings, h
) -> Sample:
    """The sample with what the window says of rest, where the filter looks for it; ``measured``
    says whether a position, a velocity or a speed is, 0 or 1.
    """
    if not layout.detects:
        return sample
    found = rest_window.followed(memory.window, sample.rate, sample.force, sample.lost, settings, h)
    back = quaternion.to_matrix(quaternion.conjugate(x.q))
    of_bias = back @ x.covariance[GYRO_BIAS, GYRO_BIAS] @ back.T
    even = rest_window.is_no_turn(found, back @ settings.earth + x.gyro_bias, of_bias, settings, h)
    looks = (settings.scalar["detect"] > 0) * memory.begun * found.alike * even
    before, rate = Judged.unpack(memory.judged), sample.rate - x.gyro_bias
    parts = rest_level.Level.unpack(memory.level), rate, sample.force, sample.lost
    slow = rest_level.followed(*parts, before.kept * (before.driven <= 0), settings, h)
    motion = rest_judged.Motion(x.velocity, x.covariance[VELOCITY, VELOCITY], x.q)
    seen = rest_judged.Seen(found, slow, looks, sample.still, rate)
    verdict, after, level = rest_judged.judged(before, motion, seen, settings, h)
    alone = verdict.rest * (1 - sample.still)
    hidden = Hidden.unpack(memory.hidden)
    hidden, hides = hidden.after(verdict.ends, alone, measured, h)
    # A drive that looks still does not turn either.
    unturned = ca.fmax(verdict.rest, looks)
    kept = {"window": found.memory, "level": level.pack(), "judged": after.pack()}
    kept |= {"hidden": hidden.pack(), "left": verdict.left, "slow": verdict.slow, "hides": hides}
    return replace(sample, still=verdict.rest, unturned=unturned, **kept)


def without_gains(layout: Layout, x: State, kind: str, measured):
    """What a triad would measure (3,) without its gains; of (1 + M)^-1 the terms up to M^2."""
    m = layout.matrix(x.gains, kind)
    return measured - m @ (measured - m @ measured)


def predicted(
    layout: Layout, x: State, memory: Memory, sample: Sample, settings: Settings, h
) -> tuple[State, ca.SX, tuple]:
    """The estimate a sample later, the transition matrix (n, n) of its error, and the mean rate and
    the velocity that counts with which that was made, and the mean force.

    A body that does not turn at both samples has not turned: what the gyro shows is then of its
    bias alone.
    """
    x, shifted = _centred(x, sample)
    rest = memory.unturned * sample.unturned * (settings.scalar["zaru"] > 0)
    blind = ca.if_else(sample.blind, 1, 0)
    turning = 1 - rest
    earth = settings.earth
    still_rate = quaternion.rotate(quaternion.conjugate(x.q), earth)
    rates = tuple(
        ca.if_else(turning, without_gains(layout, x, "gyro", w - x.gyro_bias), still_rate)
        for w in (memory.rate, sample.rate)
    )
    q = turned(x.q, rates, earth, h)
    upright = upright_of(settings)
    weights = tuple(quaternion.rotate(quaternion.conjugate(at), upright) for at in (x.q, q))
    shift = weights[1] - weights[0]
    resting = x.resting + shift + layout.matrix(x.gains, "accel") @ shift
    forces = tuple(
        weight + ca.if_else(blind, 0, without_gains(layout, x, "accel", f - s))
        for weight, f, s in zip(
            weights, (memory.force, sample.force), (x.resting, resting), strict=True
        )
    )
    velocity, position = moved(
        (x.q, q), forces, x.velocity, x.position, earth, settings.scalar["gravity"], h
    )
    rate = (rates[0] + rates[1]) / 2
    mean_rate = _mean_rate(memory, rate, still_rate, rest, h)
    known = _counted(x, memory, velocity, sample)
    axes = quaternion.to_matrix(q)
    wander = Wander.of(layout, x, mean_rate - still_rate, axes, MEAN_TIME, settings)
    felt = turning, 1 - blind
    step = Step.of(layout, x, q, (memory.counted + known) / 2, settings, felt, wander)
    by_gains = wander.by_gains(layout, rate, axes)
    changes = by_gains, known - memory.counted, wander.by_turn(shift)
    transition = _transition(layout, step, changes, settings, h)
    transition[POSITION, HEADING] += shifted
    fades = _fades(layout, settings, h)
    for place, share in fades.items():
        transition[place, place] = share
    both = transition @ x.covariance @ transition.T + _noise(layout, step, settings, h)
    both[UP, UP] = both[UP, UP] + _bending(x.covariance, both, settings)
    both[PLANE, PLANE] = both[PLANE, PLANE] + h * _bow(x, step)
    if layout.detects:
        both[PLANE, PLANE] = both[PLANE, PLANE] + sample.hides * ca.SX.eye(2)
        # What a push did before it was seen: a speed, and a part of it taken for a bias.
        moves = sample.left.kind == rest_judged.MOVED
        for place, size in ((VELOCITY, LEAST_SPEED), (RESTING, FORCE_STAYS)):
            both[place, place] = both[place, place] + moves * size**2 * ca.SX.eye(3)
    covariance = symmetric(layout.errors, lambda i, j: both[i, j])
    moves = {"q": q, "velocity": velocity, "position": position, "resting": resting}
    x = _faded(layout, replace(x, **moves, covariance=covariance), fades)
    motion = mean_rate, known, _mean_force(layout, memory, sample, settings, h)
    return _unseen(x, step, memory, sample, settings, h), transition, motion


def _centred(x: State, sample: Sample) -> tuple[State, ca.SX]:
    """The estimate with the centre where it is, if its position is measured, and what an error of
    the heading then adds to that of the position (3,).

    A position that is known turns about no place far off: there a heading that is put right by z
    at a distance r moves it by r z^2 / 2, which no linear error has, 12 cm for 1 deg at 800 m.
    What is not measured turns about the last place that was.
    """
    centre = ca.if_else(sample.placed, x.position, x.centre)
    return replace(x, centre=centre), about_the_centre(centre - x.centre)[:, 2]


def _bending(before, after, settings: Settings):
    """Variance that the resting force gains upwards in a step, as the tilt's grows from the
    covariance ``before`` to that ``after``: that of c phi^2 / 2, of second order, is c^2 P^2 / 2 of
    each axis, with the P of what came up since the last rest.

    A tilt that was there at the rest is in the force that this showed. What came up since makes a
    force to the side, c x phi, so that P is at most the variance of that force over c^2.
    """
    square, sides = settings.scalar["gravity"] ** 2, (RESTING.start + 1, RESTING.start)
    return sum(
        ca.fmin(square * before[tilt, tilt], before[side, side])
        * ca.fmax(after[tilt, tilt] - before[tilt, tilt], 0)
        for tilt, side in enumerate(sides)
    )


def _bow(x: State, step: Step):
    """Density of the noise (2, 2) m^2/s that a heading of which little is known makes of a way: one
    that is off by z leaves the way shorter by 1 - cos z. It does so all along a leg, as white noise
    of that density does over one of the usual length.
    """
    plane = step.velocity[:2]
    return LASTS[1] * bowed(x.covariance[HEADING, HEADING]) * plane @ plane.T


def _mean_rate(memory: Memory, rate, at_rest, rest, h):
    """The mean rate (3,) a sample later; that of a body at rest is known."""
    share = 1 - ca.exp(-h / MEAN_TIME)
    return ca.if_else(rest, at_rest, memory.mean_rate + share * (rate - memory.mean_rate))


def _mean_force(layout: Layout, memory: Memory, sample: Sample, settings: Settings, h):
    """The mean force (3,) a sample later, of the time by which a measured speed may be late; empty
    without wheels.
    """
    if not layout.wheels:
        return memory.mean_force
    share = 1 - ca.exp(-h / ca.fmax(settings.scalar["speed_late_std"], TINY))
    return memory.mean_force + share * (sample.force - memory.mean_force)


def _counted(x: State, memory: Memory, velocity, sample: Sample):
    """The velocity (3,) that counts a sample later, none at rest, whatever the estimate is."""
    return ca.if_else(sample.still, 0, followed(memory.counted, velocity, _of_velocity(x)))


def _of_velocity(x: State):
    """Variance of the velocity per axis."""
    return ca.trace(x.covariance[VELOCITY, VELOCITY]) / 3


def about_the_centre(away):
    """What an attitude error makes of a position that is ``away`` (3,) of the centre, (3, 3): its
    upright part turns it.
    """
    turns = ca.SX(3, 3)
    turns[:, 2] = -ca.skew(away)[:, 2]
    return turns


@dataclass(frozen=True)
class Step:
    """What a sample makes of errors: ``axes`` (3, 3) is R in the middle of the step, ``spin``
    (3, 3) by what the body has turned, in world axes; ``velocity`` (3,) is that between the
    samples, as far as it counts; ``felt`` says whether gyro and accelerometer count; ``by_turn``
    (n, 3) is what an attitude error that comes up in the step makes of the error state, ``by_tilt``
    (3, 3) what one before it makes of the error of the resting force, by how the weight
    ``wander``s, ``by_earth`` (3, 3) what it makes of the Earth's rate.
    """

    axes: ca.SX
    spin: ca.SX
    velocity: ca.SX
    felt: tuple
    by_turn: ca.SX
    by_tilt: ca.SX
    by_earth: ca.SX
    wander: Wander

    @classmethod
    def of(
        cls, layout: Layout, x: State, q, velocity, settings: Settings, felt: tuple, wander: Wander
    ) -> Step:
        upright = upright_of(settings)
        before, after = quaternion.to_matrix(x.q), quaternion.to_matrix(q)
        spin, triad = after @ before.T, in_world(layout, x, after)
        by_turn = ca.SX(layout.errors, 3)
        by_turn[TURN, :] = ca.SX.eye(3)
        # as far as it still counts: of a gyro that is lost a half turn would be told by the stop
        by_turn[VELOCITY, :] = ca.skew(followed(0, velocity, _of_velocity(x)))
        by_turn[POSITION, :] = -about_the_centre(x.position - x.centre)
        by_turn[RESTING, :] = triad @ ca.skew(upright)
        by_tilt = triad @ wander.by_tilt(spin, upright)
        by_earth = earth_by_turn(x, settings.earth)
        return cls((before + after) / 2, spin, velocity, felt, by_turn, by_tilt, by_earth, wander)


def _transition(layout: Layout, step: Step, changes: tuple, settings: Settings, h) -> ca.SX:
    """F (n, n); ``changes`` is what the gyro's gains make of the rate (3, g), by how much the
    velocity (3,) changes, both in world axes, and by how much the weight (3,) in body axes, as far
    as they count.
    """
    by_gains, faster, shift = changes
    axes, earth = step.axes, settings.earth
    halfway = (ca.SX.eye(3) + step.spin) / 2
    gains = slice(BASE, BASE + len(layout.gains))
    turn = ca.SX(3, layout.errors)
    turn[:, TURN] = -h * step.felt[0] * step.by_earth
    turn[:, GYRO_BIAS] = -h * step.felt[0] * halfway
    turn[:, gains] = -h * step.felt[0] * by_gains
    f = ca.SX.eye(layout.errors) + step.by_turn @ turn
    f[GYRO_BIAS, GYRO_BIAS] = f[RESTING, RESTING] = step.spin
    f[RESTING, TURN] = f[RESTING, TURN] + step.by_tilt
    f[RESTING, gains] = f[RESTING, gains] + axes @ layout.slopes("accel", shift)
    push = h * step.felt[1]
    f[VELOCITY, VELOCITY] = f[VELOCITY, VELOCITY] - 2 * h * ca.skew(earth)
    f[VELOCITY, RESTING] = -push * halfway
    for errors in (TURN, GYRO_BIAS, gains):
        f[VELOCITY, errors] = f[VELOCITY, errors] - push / 2 * f[RESTING, errors]
    by_change = axes @ layout.slopes("accel", axes.T @ faster)
    f[VELOCITY, gains] = f[VELOCITY, gains] - step.felt[1] * by_change
    f[POSITION, TURN.start : 2] = f[POSITION, TURN.start : 2] - h * ca.skew(step.velocity)[:, :2]
    f[POSITION, VELOCITY] = h * ca.SX.eye(3)
    f[POSITION, RESTING] = h / 2 * f[VELOCITY, RESTING]
    return ca.sparsify(f)


def _noise(layout: Layout, step: Step, settings: Settings, h) -> ca.SX:
    """Q (n, n): white noise and random walks of the part (Groves 2013, eq. 14.82)."""
    axes = step.axes
    turn, push = (
        step.felt[i] * axes @ ca.diag(noise.white**2) @ axes.T
        for i, noise in enumerate((settings.gyro, settings.accel))
    )
    q = h * step.by_turn @ turn @ step.by_turn.T
    q[VELOCITY, VELOCITY] = q[VELOCITY, VELOCITY] + h * push
    q[POSITION, POSITION] = q[POSITION, POSITION] + h * h * h / 3 * push
    q[VELOCITY, POSITION] = q[VELOCITY, POSITION] + h * h / 2 * push
    q[POSITION, VELOCITY] = q[VELOCITY, POSITION].T
    for place, noise in ((GYRO_BIAS, settings.gyro), (RESTING, settings.accel)):
        q[place, place] = q[place, place] + h * axes @ ca.diag(noise.walk**2) @ axes.T
    q[UP, UP] = q[UP, UP] + h * step.wander.noise
    sizes = {"position_lasting": range(layout.of_positions.start, layout.of_positions.stop)}
    sizes |= {"crab": [layout.crabs]} if layout.wheels else {}
    fades = _fades(layout, settings, h)
    for name, places in sizes.items():
        for place in places:
            q[place, place] = settings.scalar[f"{name}_std"] ** 2 * (1 - fades[place] ** 2)
    return q


def _fades(layout: Layout, settings: Settings, h) -> dict:
    """By its place the share that is left, after a step, of each error that is forgotten."""
    places = {}
    if layout.wheels:
        places[layout.crabs] = ca.exp(-h / settings.scalar["crab_time"])
    if layout.lasting:
        share = ca.exp(-h / settings.scalar["position_lasting_time"])
        of_positions = range(layout.of_positions.start, layout.of_positions.stop)
        places |= dict.fromkeys(of_positions, share)
    return places


def _faded(layout: Layout, x: State, fades: dict) -> State:
    """The estimate with what is forgotten of it in a step."""
    changed = {}
    if layout.wheels:
        changed["wheels"] = ca.vertcat(x.wheels[:-1], fades[layout.crabs] * x.wheels[-1])
    if layout.lasting:
        changed["lasting"] = fades[layout.of_positions.start] * x.lasting
    return replace(x, **changed)


def _unseen(x: State, step: Step, memory: Memory, sample: Sample, settings: Settings, h) -> State:
    """The estimate, less sure by what the body may have done while sensors were lost.

    After T s without the rate of an axis the attitude may be off about it by the top turn rate
    times T, half a turn at most, and beyond the range by T times what the rates there may be off;
    without a force the velocity by the top acceleration times T, and
    once that is the top speed, nothing is known of the velocity but that: the position is then off
    by T times it. Beyond the accelerometer's range the velocity is off along its axis by T times
    what the forces there may be off.
    """
    at, p = settings.scalar, x.covariance
    turned, pushed = _gone_for(memory, sample, h)
    rate = _beyond("clipped_rate_std", "top_turn_rate", sample.rate_there, settings)
    wider = ca.if_else(rate * turned < ca.pi, rate**2 * _growth(turned, h), 0)
    # An axis that lies askew by a degree or two makes a tilt of a large turn. As one error the
    # two would let a tilt that is seen at the next rest tell the turn, fifty times as large.
    wider = (step.axes**2) @ wider
    p = p + step.by_turn @ ca.diag(wider) @ step.by_turn.T
    force = _beyond("clipped_force_std", "top_acceleration", sample.force_there, settings)
    wider = (1 - sample.blind) * force**2 * _growth(pushed, h)
    p[VELOCITY, VELOCITY] = p[VELOCITY, VELOCITY] + step.axes @ ca.diag(wider) @ step.axes.T
    gone = ca.mmax(pushed * (1 - sample.force_there))
    most, grown = at["top_speed"], _growth(gone, h)
    anew = at["top_acceleration"] * gone >= most
    wider = ca.if_else(anew, 0, at["top_acceleration"] ** 2 * grown)
    p[VELOCITY, VELOCITY] = p[VELOCITY, VELOCITY] + wider * ca.SX.eye(3)
    keep = 1 - anew
    for i in range(3, 6):
        for j in range(p.shape[0]):
            p[i, j] = p[j, i] = keep * p[i, j] + (most**2 * anew if i == j else 0)
    far = ca.if_else(anew, most**2 * grown, 0)
    p[POSITION, POSITION] = p[POSITION, POSITION] + far * ca.SX.eye(3)
    return replace(x, velocity=keep * x.velocity, covariance=p)


def _beyond(name: str, top: str, there, settings: Settings):
    """How far off each axis (3,) of a sensor that is lost may be: where it is ``there``, beyond its
    range, as the parameter of that ``name`` says, else by the ``top`` of the body.
    """
    off = ca.vertcat(*[settings.scalar[f"{name}[{i}]"] for i in (1, 2, 3)])
    return ca.if_else(there * (off > 0), off, settings.scalar[top])


def _growth(gone, h):
    """By how much the square of the ``gone`` s has grown in the sample; 0 where nothing is lost."""
    return ca.if_else(gone > 0, h * (2 * gone - h), 0)


def _gone_for(memory: Memory, sample: Sample, h) -> tuple:
    """For how many s each axis (3,) of gyro and accelerometer has been lost."""
    lost = (memory.gyro_lost, sample.gyro_lost), (memory.accel_lost, sample.accel_lost)
    return tuple((before + h) * now for before, now in lost)


def remembered(memory: Memory, sample: Sample, motion: tuple, h) -> Memory:
    """The memory after a sample, with the ``motion``: mean rate, velocity that counts, and mean
    force.
    """
    force = ca.if_else(sample.blind, memory.force, sample.force)
    begun = ca.fmax(memory.begun, 1 - ca.mmax(sample.accel_lost))
    gone = _gone_for(memory, sample, h)
    kept = sample.sensors, sample.window, sample.level, sample.judged, sample.hidden
    unturned = sample.unturned
    return Memory(sample.held, sample.rate, force, *motion, unturned, *gone, begun, *kept)


def empty(layout: Layout, settings: Settings) -> Memory:
    """The memory before the first sample."""
    held = [v for name in layout.compensation.extra for v in SIGNALS[name].start]
    gravity = settings.scalar["gravity"]
    return Memory(
        ca.vertcat(0, 0, 0, 0, 0, gravity, 25, *held),
        ca.SX.zeros(3),
        ca.vertcat(0, 0, gravity),
        ca.SX.zeros(3),
        ca.SX.zeros(3),
        ca.vertcat(0, 0, gravity)[: 3 * layout.wheels],
        ca.SX(0),
        ca.SX.zeros(3),
        ca.SX.zeros(3),
        ca.SX(0),
        ca.SX(ca.DM(layout.compensation.start)),
        ca.SX.zeros(rest_window.SIZE * layout.detects),
        *(ca.SX.zeros(kept.size() * layout.detects) for kept in (rest_level.Level, Judged, Hidden)),
    )
