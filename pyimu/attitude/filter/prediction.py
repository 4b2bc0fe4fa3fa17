"""What the predictions of both filters share: a sample's added noise, and the flags for updates."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca

from pyimu.attitude.filter import drift, late_heading, turning
from pyimu.attitude.filter.field import is_magnetometer
from pyimu.attitude.filter.gravity_update import (
    Body,
    Inclination,
    constant_variance,
    inclination,
    is_pushed,
    is_tilt_known,
    scaled_tilt,
    vertical,
    white_variance,
)
from pyimu.attitude.filter.layout import CALIBRATED, EVERY, Flags, Layout
from pyimu.attitude.filter.memory import ESTIMATE, FADING, HOLD, REPORTED, Memory
from pyimu.attitude.filter.quasi_static import MEAN_TIME, where
from pyimu.attitude.filter.sample import Sample, unknown_turn
from pyimu.attitude.filter.settings import Settings
from pyimu.attitude.filter.stillness import (
    CALM,
    SLOW,
    UNKNOWN,
    Stillness,
    begins,
    calmer,
    is_rest,
    is_still,
    passes,
    share_of_noise,
    soon_drifts,
    stands,
    sway,
    sways,
    turns,
    turns_unseen,
    wrong_bias,
)
from pyimu.attitude.filter.stillness import followed as still_followed
from pyimu.attitude.filter.stillness import kept as still_kept
from pyimu.attitude.filter.timing import clock_error
from pyimu.attitude.filter.unscented import (
    AXES,
    LARGEST_STD,
    LARGEST_TILT_STD,
    WHOLE,
    Estimate,
)
from pyimu.attitude.filter.variables import ABSURD, INPUTS, LEAST_K, LEAST_N, MAG
from pyimu.attitude.filter.velocity import Motion, with_sample
from pyimu.symbolic import quaternion
from pyimu.symbolic.linear import reciprocal
from pyimu.symbolic.missing import faded
from pyimu.symbolic.process_noise import process_noise

STATIONARY, HEADING_VALID, SPEED, SPEED_VARIANCE, SPEED_VALID = (
    [v.name for v in INPUTS].index(name)
    for name in ("stationary", "heading_valid", "speed", "speed_variance", "speed_valid")
)

ASKED = [STATIONARY, HEADING_VALID, SPEED_VALID]
"""Inputs beyond 0.5 of which there is more to do than with samples of the sensors."""

DRIVES = 0.2
"""m/s; a body of which speeds say more is not at rest, however even its drive. One whose velocity
is not known to that may drive."""

PUSHED = 0.05
"""m/s; a drift (``velocity.Motion``) beyond which a body was pushed for long. A tilt that is wrong
by three standard deviations at the start looks like less. Chosen on runs 100 to 129 of the vehicles
of ``benchmarks/attitude_honesty.py``."""


SCALE_TIME = 0.3
"""s; in which the tilt that the gyro's scale factors may have made becomes as unsure to the gains
as it is, while that shows (``velocity.Bounded``): they know nothing of the scale factors, which
turn the tilt on where a body swings about all its axes, and gravity may correct that. The time of a
swing of a hand; the arms of seed 95 (``bodies.AS_BOUGHT`` of ``benchmarks/attitude_honesty.py``)
would do with 50 s, with which hands whose gyro is 2 % off are a fifth further off and cameras twice
as far (``benchmarks/attitude_untold.py --only scale --seed 200 --runs 4``). On recordings of BROAD,
whose gyros are calibrated, it makes no difference."""

SCALES = ("scale_std", "axes_std")
"""Settings of errors that ``Estimate.scaled`` has."""

ARGUMENTS = "estimate memory u p h"
"""Of a prediction, by their names in ``Layout``."""


@dataclass(frozen=True)
class Instant:
    """What there is when a sample comes.

    The ``estimate`` as a column, the memory, the settings, the inputs ``u``, and the period ``h``
    in s by the gyro's clock as the part knows it. ``sleeps`` says whether the body may be at rest,
    ``scales`` whether the gyro's scale factors have a part in any error; where that is not so, it
    is known beforehand and costs nothing in the generated code.
    """

    estimate: ca.SX
    memory: Memory
    settings: Settings
    u: ca.SX
    h: ca.SX
    sleeps: bool = True
    scales: bool = True

    @classmethod
    def of(cls, layout: Layout, symbols: list[ca.SX]) -> Instant:
        """From the symbols of ``ARGUMENTS``."""
        estimate, memory, u, p, h = symbols
        compensation = layout.compensation
        kept = Memory.unpack(estimate, memory, compensation)
        settings = Settings.of(compensation, p)
        clock = clock_error(compensation.part.gyro, settings.gyro_p)
        return cls(estimate, kept, settings, u, h * (1 + clock))

    def awake(self) -> Instant:
        """The same where ``is_awake`` holds, with the numbers that are then known."""
        u = ca.SX(self.u)
        u[ASKED] = 0
        still = replace(self.memory.stillness, rests=ca.SX(0))
        return replace(self, u=u, memory=replace(self.memory, stillness=still), sleeps=False)

    def calibrated(self) -> Instant:
        """The same where ``is_calibrated`` holds, with the numbers that are then known."""
        kept, scalar = self.memory, self.settings.scalar
        x = replace(kept.estimate, scaled=ca.SX(WHOLE, AXES))
        kept = replace(kept, estimate=x, by_scale=ca.SX.zeros(3), scales=ca.SX(0))
        settings = replace(self.settings, scalar=scalar | {n: ca.SX(0) for n in SCALES})
        return replace(self, memory=kept, settings=settings, scales=False)

    @property
    def stationary(self):
        """Whether the body is called stationary, 0 or 1."""
        return self.u[STATIONARY] > 0.5

    @property
    def has_speed(self):
        """Whether a speed is given that is one, 0 or 1."""
        usable = (ca.fabs(self.u[SPEED]) <= ABSURD) * (ca.fabs(self.u[SPEED_VARIANCE]) <= ABSURD)
        usable *= self.u[SPEED_VARIANCE] >= 0
        return (self.u[SPEED_VALID] > 0.5) * usable

    def driven(self, speed_for):
        """Whether the body is driven, 0 or 1, of which a speed was given ``speed_for`` s ago."""
        return speed_for < HOLD if self.sleeps else ca.SX(0)

    @property
    def earth(self):
        """The Earth's rate (3,) in body axes, rad/s."""
        world_to_body = quaternion.conjugate(self.memory.estimate.q)
        return quaternion.rotate(world_to_body, self.settings.earth)


def is_awake(at: Instant):
    """Whether the body is in no rest, and cannot be found in one, nor to sway, with this sample;
    whether there is nothing beside samples of the sensors.

    That is so of nearly every sample of a body in motion.
    """
    before = at.memory.stillness
    soon = before.span + 2 * at.h >= ca.fmin(at.settings.scalar["rest_time"], SLOW)
    # What is asked for may be NaN, which asks for nothing.
    asked = sum(at.u[i] > 0.5 for i in ASKED)
    return (soon + passes(before.span, before.span + at.h) + ca.fabs(before.rests) + asked) <= 0


def is_calibrated(at: Instant):
    """Whether the gyro's scale factors have no part in any error, before and after the sample."""
    return at.memory.scales + _scales(at) <= 0


def _scales(at: Instant):
    """Whether the settings give the gyro's scale factors and axes a part in the errors, 0 or 1."""
    return sum(at.settings.scalar[n] for n in SCALES) > 0


@dataclass(frozen=True)
class Rest:
    """What a sample says of rest.

    How ``still`` the body has been, whether it is ``resting``, whether that is ``sure`` because the
    body did not drive before or shook, whether there is ``doubt``, because its velocity is not
    known either or because it sways, and which share of the measured turn is one (``moving``): none
    where the body is called stationary, at rest without doubt what is not noise. These are factors:
    casadi would draw a choice into every product. ``before`` is the estimate before the sample:
    where a rest ends, with the bias as it was before its last samples. By ``forgotten`` (3,) the
    variance of the bias was larger then, or is by what it took of a turn that was so slow that it
    looked like rest, and by ``unseen`` (3,) that of the attitude. ``safe``, ``later``, ``calm``,
    ``known`` and ``drift`` are those of ``Memory``.
    """

    still: Stillness
    resting: ca.SX
    sure: ca.SX
    doubt: ca.SX
    moving: ca.SX
    before: Estimate
    forgotten: ca.SX
    unseen: ca.SX
    safe: ca.SX
    later: ca.SX
    calm: ca.SX
    known: ca.SX
    drift: drift.Drift

    @property
    def surely(self):
        """Whether the body is resting, and that is sure, 0 or 1."""
        return self.resting * self.sure


def rest_of(at: Instant, sample: Sample) -> Rest:
    """The rest as the sample shows it; a body is at rest from the sample after the first that may
    be one.
    """
    settings, before, scalar = at.settings, at.memory.stillness, at.settings.scalar
    x = at.memory.estimate
    tolerance = scalar["rest_rate_tolerance"], scalar["rest_force_tolerance"]
    noise = settings.gyro.white**2 * reciprocal(at.h), white_variance(settings, at.h)
    alike = is_still(before, sample.rate, sample.force, tolerance, noise, at.h)
    drives = at.driven(at.memory.speed_for) * (ca.sumsqr(x.velocity) > DRIVES**2)
    alike = where(sample.force_valid, alike) * (1 - drives)
    if sample.gyro_lost is not False:
        alike = alike * (1 - ca.mmax(sample.gyro_lost))
    variance = ca.diag(x.covariance)[3:6]
    still = still_followed(before, sample.rate, sample.force, alike, at.h)
    known = ca.vertcat(x.bias, variance)
    safe, later = at.memory.safe, at.memory.later
    if at.sleeps:
        safe, later = still_kept(before, still, safe, later, known)
    wanted = scalar["rest_time"] > 0
    rests = wanted * (before.rests > 0) * (1 - at.stationary)
    resting = alike * rests
    velocity = ca.trace(x.covariance[6:, 6:]) + ca.sumsqr(x.velocity)
    pushed = is_pushed(before.slow_force, x, settings, at.h)
    motion = at.memory.motion
    left = motion.long.velocity(scalar["motion_time"])
    drove, unknown = _drove(motion, left), (ca.fmax(velocity, left) > DRIVES**2) + pushed > 0
    unsure = drove * (at.memory.calm > CALM)
    doubt = 1 - (1 - unsure * unknown) * (1 - sways(still, _density(settings)))
    kept = 1 - resting * (1 - doubt) * share_of_noise(still, _density(settings))
    turned = (before.rests < 0) * (1 - at.stationary)
    ends = (rests > resting) + turned > 0
    x = replace(x, bias=ca.if_else(ends, safe[:3], x.bias))
    up = vertical(x)

    def not_turned_on(bias):
        rate = before.slow - bias - at.earth
        return (rate - doubt * ca.dot(up, rate) * up) ** 2

    unseen = turned * not_turned_on(at.memory.estimate.bias)
    by_noise = _density(settings) / (2 * SLOW)
    begun = (ends - turned) * ca.fmax(not_turned_on(x.bias) - by_noise, 0)
    taken = ca.fmin(variance * SLOW / ca.fmax(before.density, _density(settings)), 1)
    forgotten = ends * ca.fmax(safe[3:] - variance, 0) + taken**2 * unseen
    moving = (1 - at.stationary) * kept
    # What a push has left goes on, though the filter, which follows it, measures no velocity.
    may_drive = drove * (ca.fmax(ca.fmax(velocity, motion.drift), left) > DRIVES**2)
    calm = calmer(at.memory.calm, before, alike, may_drive, at.h)
    before_it, hidden = _hidden_turn(at, still, x)
    unseen, both = SLOW**2 * (unseen + begun) + still.span**2 * hidden, (1 - unsure, doubt)
    drifts, less_known = _drift(at, x, resting, doubt)
    forgotten = forgotten + hidden + less_known
    if at.sleeps:
        wrong = resting * _wrong_bias(at, before, x)
        forgotten, unseen = forgotten + wrong, unseen + still.span**2 * wrong
    kept = safe, later, calm, before_it, drifts
    return Rest(still, resting, *both, moving, x, forgotten, unseen, *kept)


def _hidden_turn(at: Instant, still: Stillness, x: Estimate):
    """The variance of the bias about the vertical before the body was ``still`` or while it stood,
    and that (3,) which the bias gets once the body shows that it sways, (rad/s)^2.
    """
    before, up = at.memory.stillness, vertical(x)
    own = ca.dot(up, x.covariance[3:6, 3:6] @ up)
    noise = _density(at.settings)
    if not at.sleeps:
        return ca.if_else(before.span > 0, at.memory.known, own), ca.SX.zeros(3)
    anew = 1 - (before.span > 0) * (1 - stands(before, noise))
    known = ca.if_else(anew, own, at.memory.known)
    return known, turns_unseen(before, still, noise, known, own) * up**2


def _drift(at: Instant, x: Estimate, resting, doubt):
    """``drift.followed`` of the memory; in doubt the bias about the vertical is not looked at."""
    kept = at.memory.drift
    if not at.sleeps:
        return replace(kept, since=kept.since + at.h), ca.SX(0)
    before, up, known = at.memory.stillness, vertical(x), x.covariance[3:6, 3:6]
    off, span = before.slow - x.bias - at.earth, ca.fmin(before.span, drift.WHOLE)
    white = ca.fmax(before.density, _density(at.settings)) * reciprocal(ca.fmax(span, at.h))
    axes = 3 - doubt
    square = ca.sumsqr(off) - doubt * ca.dot(up, off) ** 2
    own = ca.trace(known) - doubt * ca.dot(up, known @ up)
    noise = axes * white
    found, less_known = drift.followed(
        kept, before, resting, square, own + noise, noise, axes, at.h
    )
    return replace(found, since=(1 - at.stationary) * found.since), less_known


def _wrong_bias(at: Instant, still: Stillness, x: Estimate):
    """``wrong_bias`` of the estimate ``x``, by the samples of a body that is ``still``."""
    density = ca.fmax(still.density, _density(at.settings))
    noise, rate = white_variance(at.settings, at.h), still.slow - x.bias - at.earth
    known, gravity = x.covariance[3:6, 3:6], at.settings.scalar["gravity"]
    return wrong_bias(still, rate, known, density, gravity, noise, at.h)


def _drove(motion: Motion, left):
    """Whether a body that looks still may drive on, 0 or 1: it was fast, or was pushed for long.

    ``left`` (m/s)^2 is ``LongPush.velocity``.
    """
    slowly = (motion.drift <= PUSHED**2) * (left <= DRIVES**2)
    return motion.across > DRIVES**2 * slowly


def _density(settings: Settings):
    """Density in (rad/s)^2 s of the gyro's white noise, the mean of its axes."""
    return ca.sumsqr(settings.gyro.white) * (1 / 3) + LEAST_N**2


def _decided(at: Instant, x: Estimate, rest: Rest) -> Stillness:
    """The stillness, which while it is long enough is a rest or none by the estimate ``x``.

    A turn that has begun so slowly that each sample is like those before shows in their mean.
    """
    if not at.sleeps:
        return rest.still
    still, span = rest.still, ca.fmin(rest.still.span, 2 * SLOW)
    rate, noise = still.slow - x.bias - at.earth, ca.fmax(still.density, _density(at.settings))
    up, known, scalar = vertical(x), x.covariance[3:6, 3:6], at.settings.scalar
    believed = known + _wrong_bias(at, still, x) * ca.SX.eye(3)
    drifts = soon_drifts(_density(at.settings))
    found = is_rest(rate, believed, up, noise, span, still.rests > 0, drifts)
    unknown = ca.dot(up, known @ up) > UNKNOWN**2
    moves = turns(still, scalar["gravity"], white_variance(at.settings, at.h), at.h)
    now = begins(at.memory.stillness, still, scalar["rest_time"], unknown, moves, at.h)
    goes_on = (still.rests > 0) * (2 * found - 1) * (still.span > 0)
    return replace(still, rests=ca.if_else(now, found, goes_on))


def added_noise(at: Instant, sample: Sample, rest: Rest):
    """Variance (3,) that a sample adds to the attitude, to attitude and bias together, to the bias.

    To that of the gyro's noise come the noises that grow with the rate, the angle about an axis
    whose gyro is lost, and what scale factors may have made of the tilt. A body that is called
    stationary does not turn by the gyro, and its attitude has the noise of ``stationary_std``. What
    a ``rest`` had found of the bias in its last samples is not known any more once it has ended.
    """
    settings, h, moving = at.settings, at.h, rest.moving
    noise = process_noise(settings.gyro.white, settings.gyro.walk, h)
    square = sample.rate**2
    angle = ca.sum1(square) * h
    relative = settings.scalar["rate_noise"] ** 2 * angle + settings.gyro.relative**2 * square * h
    still, least = (h * settings.scalar["stationary_std"]) ** 2, LEAST_N**2 * h
    turned = ca.diag(noise[:3, :3]) + relative
    if sample.gyro_lost is not False:
        lost = settings.scalar["lost_rate_std"] ** 2 * unknown_turn(
            at.memory.lost_for, sample.lost_for
        )
        turned = turned + ca.if_else(sample.gyro_lost, lost, 0)
    turned = turned + at.memory.by_scale * h
    before, after = at.memory.turning, _turning(at, sample, rest)
    std = settings.scalar["motion_bias"]
    in_motion = turning.bias_variance(before, after, rest.surely, std, h)
    return (
        least + (1 - moving) * at.stationary * still + moving * turned + rest.unseen,
        moving * ca.diag(noise[:3, 3:]),
        ca.diag(noise[3:, 3:])
        + (LEAST_K**2 + at.memory.drift.density) * h
        + settings.scalar["bias_noise"] ** 2 * angle
        + in_motion
        + rest.forgotten,
    )


def _turning(at: Instant, sample: Sample, rest: Rest):
    """How much the body turns, with this sample: ``Memory.turning``."""
    x = at.memory.estimate
    rate = sample.rate - x.bias
    return turning.followed(at.memory.turning, rate, vertical(x), rest.surely, at.h)


def _place(at: Instant):
    """Where the newest entry stands in the rings, with this sample: ``Memory.place``."""
    slot, within = at.memory.place[0], at.memory.place[1]
    span = at.settings.scalar["heading_memory"]
    return ca.vertcat(*late_heading.following(slot, within, span, at.h))


def predicted(at: Instant, sample: Sample, rest: Rest, x: Estimate, turned, noise) -> list[ca.SX]:
    """The outputs of a prediction, each as a column.

    The working estimate, the memory after the sample but for the motion, the motion and whether it
    is to be looked at (``pyimu.attitude.filter.look``), the compensated rate, the measurement of
    gravity, and the flags.

    ``x`` is the propagated estimate, ``turned`` (3, 3) the turn in inertial space from old body
    axes to new, ``noise`` that of ``added_noise``.
    """
    scalar, kept = at.settings.scalar, at.memory
    known = is_tilt_known(x, kept, scalar)
    speed = at.has_speed * known
    speed_for = ca.if_else(speed, 0, kept.speed_for + at.h)
    driven = at.driven(speed_for)
    goes_on = known * (1 - rest.resting) * (1 - driven)
    used = where(sample.force_valid, goes_on)
    may = (1 - rest.surely) * (1 - at.stationary) * (1 - driven)
    moves = scalar["accel_std"] > 0
    pushes = where(sample.force_valid, may * moves)
    motion, bounded = with_sample(
        kept.motion, x, sample.force, used, pushes, goes_on, may * moves, moves, at.h
    )
    field = ca.fmax(kept.field, is_magnetometer(at.u[MAG], at.settings))
    turns_by = _turning(at, sample, rest)
    body = _body(at, rest, driven, field, turns_by)
    force = inclination(kept, sample, x, bounded, turned, at.settings, at.h, body)
    still = _decided(at, x, rest)
    vertical_noise = at.memory.vertical_noise + _about_the_vertical(x, noise[0])
    after = Memory(
        x,
        force.quasi,
        force.size,
        force.mean,
        motion,
        still,
        rest.drift,
        rest.safe,
        rest.later,
        sample.held,
        sample.lost_for,
        sample.same_for,
        sample.sensors,
        speed_for,
        rest.calm,
        turns_by,
        rest.known,
        ca.sum2(scaled_tilt(x, vertical(x)) ** 2) * (motion.by_scale / SCALE_TIME),
        ca.fmax(kept.scales, _scales(at)),
        vertical_noise,
        _place(at),
        field,
    )
    working = ca.vertcat(Memory.pack_estimate(x), at.estimate[ESTIMATE - 1], ca.SX.zeros(REPORTED))
    if sample.faded:
        working[FADING] = faded(working[FADING])
    flags = _flags(at, sample, rest, x, force, field, vertical_noise)
    was = at.driven(kept.speed_for)
    flags = flags.with_speed(speed, driven, was + driven - 2 * was * driven)
    return [
        working,
        *after.pack_memory(sample.faded),
        motion.gathered.is_due(scalar["motion_time"], at.h),
        sample.rate,
        force.measurement.pack(),
        flags.pack(),
    ]


def _body(at: Instant, rest: Rest, driven, field, turns_by) -> Body:
    """What is known of the body; ``turns_by`` (5,) is what ``turning.followed`` keeps."""
    rests = (rest.resting + at.stationary > 0) * (rest.still.span >= MEAN_TIME)
    # With a magnetometer the bias about the vertical shows in the heading.
    false = (1 - field) * turning.false_rate(turns_by, at.settings.scalar["rate_noise"])
    return Body(rests, rest.still.slow_force, rest.sure, driven, false, turns_by[2:])


def _flags(
    at: Instant, sample: Sample, rest: Rest, x: Estimate, force: Inclination, field, vertical_noise
) -> Flags:
    heading, stationary = at.u[HEADING_VALID] > 0.5, at.stationary
    if sample.gyro_lost is not False:
        stationary = ca.logic_and(stationary, ca.logic_not(ca.mmax(sample.gyro_lost)))
    lost = sum((x.covariance[i, i] > LARGEST_TILT_STD**2 for i in range(3)), 0) > 0
    at_rest, other = stationary + rest.resting > 0, lost + heading + force.usable > 0
    usual, asked = force.velocity * (1 - other), other + at_rest + field > 0
    off = force.size.off(at.settings.scalar["gravity"])
    calibrated = off <= at.settings.scalar["gravity_tolerance"]
    uncalibrated = 1 - calibrated * (1 - force.size.in_doubt())
    which = usual * (1 + at_rest + 2 * field) + (1 - usual) * asked * EVERY
    if not at.scales:
        which = which + (which <= 2) * CALIBRATED
    return Flags(
        which=which,
        gravity=force.usable,
        velocity=force.velocity,
        quasi_static=force.quasi_static,
        lost=lost,
        heading=heading,
        stationary=stationary,
        resting=rest.resting,
        doubt=rest.resting * rest.doubt,
        sway=rest.resting * sway(rest.still, _density(at.settings)) * reciprocal(at.h),
        missing=sample.missing,
        faults=2 * sample.at_limit + 4 * sample.stuck + 512 * uncalibrated,
        speed=ca.SX(0),
        driven=ca.SX(0),
        anew=ca.SX(0),
        field=field,
        moving=rest.moving,
        constant=constant_variance(force.size, at.settings),
        vertical_noise=vertical_noise,
    )


def _about_the_vertical(x: Estimate, added):
    """The part about the vertical of a variance (3,) that a sample adds to the attitude.

    It is at most what an angle can have.
    """
    variance, most = ca.dot(vertical(x) ** 2, added), LARGEST_STD**2
    return ca.if_else(variance < most, variance, most)
