"""From one sample to the next: the row without the sensors' errors, the strapdown step, the noise.

The error state is what the truth has beyond the estimate: q_true = exp(phi) q in world axes,
v_true = exp(phi) (v + e), the differences of position p and gains M, and those of the biases turned
into world axes, d = R (b_true - b). Of rates and forces measured = (1 + M) true + bias + noise,
with the Earth's rate w_e and gravity g, which points down,

    phi' = -d_g - R (d_M w + n_g) - w_e x phi,
    e' = g x phi + v x phi' - d_a - R (d_M f + n_a) - 2 w_e x e,
    p' = e + phi x v,    d' = (R w) x d.

It is the error of the invariant filter (Barrau and Bonnabel 2017), with biases turned along. In
body axes and with the plain difference of velocities (Groves 2013, section 14.2.4), what cannot be
told apart has a direction in the state that follows the estimate: a tilt from a bias of the
accelerometer at rest, a yaw from the direction of the velocity. Each correction then turns it, and
the filter seems to see it from several sides and learns from nothing: within 10 s at rest a bias
known to 50 mg became one known to 19 mg by its own noise. Here these directions, phi x g = d_a and
phi upright, stay.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.model.signals import SIGNALS
from pyimu.navigation.filter import rest_window
from pyimu.navigation.filter.layout import (
    ACCEL_BIAS,
    BASE,
    GYRO_BIAS,
    POSITION,
    TURN,
    VELOCITY,
    Layout,
    Memory,
    State,
)
from pyimu.navigation.filter.mechanisation import moved, turned
from pyimu.navigation.filter.variables import (
    ACCEL,
    GYRO,
    INPUTS,
    OWN_PARAMETERS,
    STATIONARY,
    TEMPERATURE,
)
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import symmetric
from pyimu.symbolic.missing import is_finite

ABSURD = 1e6
"""rad/s and m/s^2; what is larger is no number of a sensor."""

OPTIONS = {"cse": True}

MEAN_TIME = 0.3
"""s; of the means of rate and force in the transition. With the samples themselves there, whose
noise the transition would take for motion, the filter would learn from noise what only motion
shows: the tilt apart from the accelerometer's bias, and the gains. Their integrals over a manoeuvre
are those of the samples."""


LASTS = 10.0
"""s; a leg or a rest. Over it random walks stand for the part's correlated noise, of which a rest
takes off what came before. And over it what is not linear in the tilt acts the same way: as
white noise of that density it grows as a constant does over that time. It matters as long as the
bias of the accelerometer is not told from the tilt, 3 deg for 50 mg: the vertical acceleration then
is off by 13 mm/s^2, and the vertical channel, which knows its own bias to 1 mm/s^2 after a rest,
would take that for a motion."""


@dataclass(frozen=True)
class Sample:
    """A row: what was measured, in place of a missing number its last good one (``held``); ``rate``
    and ``force`` (3,) without the part's errors; whether gyro and accelerometer are ``lost``, 0 or
    1; whether the body is at rest (``still``); the compensation's memory, and the window's.
    """

    held: ca.SX
    rate: ca.SX
    force: ca.SX
    gyro_lost: ca.SX
    accel_lost: ca.SX
    still: ca.SX
    sensors: ca.SX
    window: ca.SX


def settings_of(layout: Layout, p) -> Settings:
    return Settings.of(layout.compensation, p, OWN_PARAMETERS, LASTS)


def read(layout: Layout, memory: Memory, q, u, settings: Settings, h) -> Sample:
    """The sample of the inputs ``u``; ``q`` is the attitude as it was."""
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
    lost = [
        1 - ca.mmin(good[rows]) * (ca.mmax(ca.densify(mark)) <= 0.5)
        for rows, mark in ((GYRO, gyro_lost), (ACCEL, accel_lost))
    ]
    still = is_finite(u[STATIONARY]) * (u[STATIONARY] > 0.5)
    return Sample(held, rate, force, *lost, still, sensors, memory.window)


def with_rest(
    layout: Layout, x: State, memory: Memory, sample: Sample, settings: Settings, h
) -> Sample:
    """The sample with what the window says of rest, where the filter looks for it."""
    if not layout.detects:
        return sample
    lost = ca.fmax(sample.gyro_lost, sample.accel_lost)
    found = rest_window.followed(memory.window, sample.rate, sample.force, lost, settings, h)
    back = quaternion.to_matrix(quaternion.conjugate(x.q))
    of_bias = back @ x.covariance[GYRO_BIAS, GYRO_BIAS] @ back.T
    even = rest_window.is_no_turn(found, back @ settings.earth + x.gyro_bias, of_bias, settings, h)
    asked = settings.scalar["detect"] > 0
    still = ca.fmax(sample.still, asked * memory.begun * found.alike * even)
    return replace(sample, still=still, window=found.memory)


def corrected(layout: Layout, x: State, rate, force) -> tuple:
    """Rate and force (3,) less the estimated errors; of (1 + M)^-1 the terms up to M^2."""
    out = []
    for kind, measured, bias in (("gyro", rate, x.gyro_bias), ("accel", force, x.accel_bias)):
        m, raw = layout.matrix(x.gains, kind), measured - bias
        out.append(raw - m @ (raw - m @ raw))
    return tuple(out)


def predicted(
    layout: Layout, x: State, memory: Memory, sample: Sample, settings: Settings, h
) -> tuple[State, ca.SX, tuple]:
    """The estimate a sample later, the transition matrix (n, n) of its error, and the mean rate and
    force with which that was made.

    A body at rest at both samples has not turned: what the gyro shows is then of its bias alone.
    """
    rest = memory.still * sample.still * (settings.scalar["zaru"] > 0)
    blind = [ca.if_else(lost, 1, 0) for lost in (sample.gyro_lost, sample.accel_lost)]
    before, after = (
        corrected(layout, x, *pair)
        for pair in ((memory.rate, memory.force), (sample.rate, sample.force))
    )
    turning = (1 - rest) * (1 - blind[0])
    earth = settings.earth
    still_rate = quaternion.rotate(quaternion.conjugate(x.q), earth)
    rates = tuple(ca.if_else(turning, w, still_rate) for w in (before[0], after[0]))
    q = turned(x.q, rates, earth, h)
    gravity = ca.vertcat(0, 0, settings.scalar["gravity"])
    forces = tuple(
        ca.if_else(blind[1], quaternion.rotate(quaternion.conjugate(at), gravity), f)
        for at, f in ((x.q, before[1]), (q, after[1]))
    )
    velocity, position, force = moved(
        (x.q, q), forces, x.velocity, x.position, earth, settings.scalar["gravity"], h
    )
    axes = (quaternion.to_matrix(x.q) + quaternion.to_matrix(q)) / 2
    means = _means(memory, (rates[0] + rates[1]) / 2, force, (still_rate, gravity), rest, h)
    mean = means[0], axes.T @ means[1]
    spin = quaternion.to_matrix(q) @ quaternion.to_matrix(x.q).T
    felt = turning, 1 - blind[1]
    between = (x.velocity + velocity) / 2
    transition = _transition(layout, axes, spin, mean, between, settings, felt, h)
    noise = _noise(layout, axes, between, settings, felt, h)
    bent = h * LASTS * _bent(x.covariance[TURN, TURN], settings.scalar["gravity"])
    noise[VELOCITY, VELOCITY] = noise[VELOCITY, VELOCITY] + ca.diag(bent)
    both = transition @ x.covariance @ transition.T + noise
    covariance = symmetric(layout.errors, lambda i, j: both[i, j])
    x = replace(x, q=q, velocity=velocity, position=position, covariance=covariance)
    return _unseen(x, memory, sample, settings, h), transition, means


def _means(memory: Memory, rate, force, at_rest: tuple, rest, h) -> tuple:
    """The mean rate and force (3,) a sample later; of a body at rest they are known."""
    share = 1 - ca.exp(-h / MEAN_TIME)
    found = (memory.mean_rate, rate), (memory.mean_force, force)
    return tuple(
        ca.if_else(rest, known, before + share * (now - before))
        for known, (before, now) in zip(at_rest, found, strict=True)
    )


def _transition(
    layout: Layout, axes, spin, mean: tuple, velocity, settings: Settings, felt: tuple, h
) -> ca.SX:
    """F (n, n).

    ``axes`` (3, 3) is R, ``spin`` (3, 3) by what the body has turned, in world axes; ``mean`` are
    rate and force (3,) in body axes; ``felt`` says whether gyro and accelerometer count.
    """
    rate, body_force = mean
    earth, gravity = settings.earth, ca.vertcat(0, 0, -settings.scalar["gravity"])
    halfway = (ca.SX.eye(3) + spin) / 2
    f = ca.SX.eye(layout.errors)
    turn = h * felt[0] * axes
    push = h * felt[1] * axes
    f[TURN, TURN] = ca.SX.eye(3) - h * ca.skew(earth)
    f[TURN, GYRO_BIAS] = -h * felt[0] * halfway
    f[VELOCITY, TURN] = h * felt[1] * ca.skew(gravity) - h * ca.skew(velocity) @ ca.skew(earth)
    f[VELOCITY, GYRO_BIAS] = ca.skew(velocity) @ f[TURN, GYRO_BIAS]
    f[VELOCITY, VELOCITY] = ca.SX.eye(3) - 2 * h * ca.skew(earth)
    f[VELOCITY, ACCEL_BIAS] = -h * felt[1] * halfway
    f[GYRO_BIAS, GYRO_BIAS] = f[ACCEL_BIAS, ACCEL_BIAS] = spin
    gains = slice(BASE, BASE + len(layout.gains))
    if layout.gains:
        f[TURN, gains] = -turn @ layout.slopes("gyro", rate)
        f[VELOCITY, gains] = ca.skew(velocity) @ f[TURN, gains]
        f[VELOCITY, gains] = f[VELOCITY, gains] - push @ layout.slopes("accel", body_force)
    f[POSITION, TURN] = -h * ca.skew(velocity) + h / 2 * (f[VELOCITY, TURN])
    f[POSITION, VELOCITY] = h * ca.SX.eye(3)
    f[POSITION, ACCEL_BIAS] = h / 2 * f[VELOCITY, ACCEL_BIAS]
    return ca.sparsify(f)


def _bent(turn, gravity):
    """Mean squares (3,) of the acceleration phi x (phi x g) / 2, which F leaves out.

    The attitude error phi is normal with the covariance ``turn`` (3, 3).
    """
    xx, yy, zz = (turn[i, i] for i in range(3))
    xy, xz, yz = turn[0, 1], turn[0, 2], turn[1, 2]
    vertical = 3 * xx * xx + 3 * yy * yy + 2 * xx * yy + 4 * xy * xy
    level = xx * zz + 2 * xz * xz, yy * zz + 2 * yz * yz
    return gravity * gravity / 4 * ca.vertcat(*level, vertical)


def _noise(layout: Layout, axes, velocity, settings: Settings, felt: tuple, h) -> ca.SX:
    """Q (n, n): white noise and random walks of the part (Groves 2013, eq. 14.82)."""
    q = ca.SX(layout.errors, layout.errors)
    turn, push = (
        felt[i] * axes @ ca.diag(noise.white**2) @ axes.T
        for i, noise in enumerate((settings.gyro, settings.accel))
    )
    q[TURN, TURN] = h * turn
    along = ca.skew(velocity)
    q[VELOCITY, TURN] = h * along @ turn
    q[TURN, VELOCITY] = q[VELOCITY, TURN].T
    q[VELOCITY, VELOCITY] = h * (push + along @ turn @ along.T)
    q[VELOCITY, POSITION] = q[POSITION, VELOCITY] = h * h / 2 * push
    q[POSITION, POSITION] = h * h * h / 3 * push
    for place, noise in ((GYRO_BIAS, settings.gyro), (ACCEL_BIAS, settings.accel)):
        q[place, place] = h * axes @ ca.diag(noise.walk**2) @ axes.T
    return q


def _unseen(x: State, memory: Memory, sample: Sample, settings: Settings, h) -> State:
    """The estimate, less sure by what the body may have done while sensors were lost.

    After T s without a rate the attitude may be off by the top turn rate times T, half a turn at
    most; without a force the velocity by the top acceleration times T, and once that is the top
    speed, nothing is known of the velocity but that: the position is then off by T times it.
    """
    at, p = settings.scalar, x.covariance
    gone = [(before + h) * lost for before, lost in _lost(memory, sample)]
    grown = [ca.if_else(t > 0, h * (2 * t - h), 0) for t in gone]
    angle = at["top_turn_rate"] * gone[0]
    wider = ca.if_else(angle < ca.pi, at["top_turn_rate"] ** 2 * grown[0], 0)
    along = ca.skew(x.velocity)
    p[TURN, TURN] = p[TURN, TURN] + wider * ca.SX.eye(3)
    p[VELOCITY, TURN] = p[VELOCITY, TURN] + wider * along
    p[TURN, VELOCITY] = p[VELOCITY, TURN].T
    p[VELOCITY, VELOCITY] = p[VELOCITY, VELOCITY] + wider * along @ along.T
    most = at["top_speed"]
    anew = at["top_acceleration"] * gone[1] >= most
    wider = ca.if_else(anew, 0, at["top_acceleration"] ** 2 * grown[1])
    p[VELOCITY, VELOCITY] = p[VELOCITY, VELOCITY] + wider * ca.SX.eye(3)
    keep = 1 - anew
    for i in range(3, 6):
        for j in range(p.shape[0]):
            p[i, j] = p[j, i] = keep * p[i, j] + (most**2 * anew if i == j else 0)
    far = ca.if_else(anew, most**2 * grown[1], 0)
    p[POSITION, POSITION] = p[POSITION, POSITION] + far * ca.SX.eye(3)
    return replace(x, velocity=keep * x.velocity, covariance=p)


def _lost(memory: Memory, sample: Sample) -> tuple:
    return (memory.gyro_lost, sample.gyro_lost), (memory.accel_lost, sample.accel_lost)


def first(layout: Layout, sample: Sample, settings: Settings) -> State:
    """The estimate at the first sample: level by its force, at the origin, without velocity."""
    at = settings.scalar
    fx, fy, fz = ca.vertsplit(sample.force)
    roll, pitch = ca.atan2(fy, fz), ca.atan2(-fx, ca.sqrt(fy * fy + fz * fz))
    q, x = quaternion.from_euler(roll, pitch, at["heading0"]), zero(layout, settings)
    axes, p = quaternion.to_matrix(q), ca.SX(x.covariance)
    for place in (GYRO_BIAS, ACCEL_BIAS):
        p[place, place] = axes @ p[place, place] @ axes.T
    return replace(x, q=q, covariance=p)


def zero(layout: Layout, settings: Settings) -> State:
    """The estimate before the first sample."""
    at, n = settings.scalar, layout.errors

    def three(name: str) -> list:
        return [at[f"{name}[{i}]"] for i in (1, 2, 3)]

    std = ca.vertcat(
        *[at["tilt_std0"]] * 2,
        at["heading_std0"],
        *[at["velocity_std0"]] * 3,
        *[at["position_std0"]] * 3,
        *three("gyro_bias_std0"),
        *three("accel_bias_std0"),
        *[gain.std for gain in layout.gains],
        *[layout.mounting_std] * (2 * layout.nhc),
    )
    none = ca.SX.zeros(3)
    return State(
        quaternion.from_euler(0, 0, at["heading0"]),
        none,
        none,
        none,
        none,
        ca.SX.zeros(len(layout.gains)),
        ca.SX.zeros(n - layout.mounting.start),
        ca.densify(ca.diag(std**2)),
    )


def remembered(memory: Memory, sample: Sample, means: tuple, h) -> Memory:
    """The memory after a sample, with the ``means`` of rate and force."""
    gone = [(before + h) * lost for before, lost in _lost(memory, sample)]
    rate = ca.if_else(sample.gyro_lost, memory.rate, sample.rate)
    force = ca.if_else(sample.accel_lost, memory.force, sample.force)
    begun = ca.fmax(memory.begun, 1 - sample.accel_lost)
    kept = sample.sensors, sample.window
    return Memory(sample.held, rate, force, *means, sample.still, *gone, begun, *kept)


def empty(layout: Layout, settings: Settings) -> Memory:
    """The memory before the first sample."""
    held = [v for name in layout.compensation.extra for v in SIGNALS[name].start]
    gravity = settings.scalar["gravity"]
    return Memory(
        ca.vertcat(0, 0, 0, 0, 0, gravity, 25, *held),
        ca.SX.zeros(3),
        ca.vertcat(0, 0, gravity),
        ca.SX.zeros(3),
        ca.vertcat(0, 0, gravity),
        *[ca.SX(0)] * 4,
        ca.SX(ca.DM(layout.compensation.start)),
        ca.SX.zeros(rest_window.SIZE * layout.detects),
    )
