"""Bodies in the cases that attitude filters are bad at, by numpy and scipy alone.

Truth, samples and reference filters share no code with the package: motions are splines of
``generators.motion``, samples of the gyro are the turns between their instants over the period, and
sensors have white noise, a bias and a random walk that the filter is told of.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from drives import bodies
from drives.log import Log
from generators import rotation
from generators.instrument import Triad
from generators.motion import (
    GRAVITY,
    KNOTS,
    Motion,
    busy_spans,
    eased,
    grid,
    motion_of,
    smooth_noise,
)
from scipy.signal import lfilter

H = 0.01
N, K, BIAS = 3e-4, 1e-5, 0.005
"""rad/sqrt(s), rad/s/sqrt(s), rad/s: white noise, random walk and turn-on bias of a consumer's
gyro."""

N_ACCEL = 1e-3
"""m/s^2 sqrt(s); of its accelerometer."""

EARTH = 7.292115e-5
HEADING_STD = 0.035


@dataclass(frozen=True)
class Case:
    """How a log is made, and what is looked at.

    ``make(rng)`` gives a log; ``since`` s of it are not scored. ``pushed`` (m/s^2, s) is by how
    much the body accelerates and for how long, for the plain filter beside, which is told so.
    ``headed`` says that headings come, so that the error of heading is scored as it is, else
    against the heading at ``since``. By ``default`` the filter is told nothing of the sensors.
    """

    name: str
    make: Callable[[np.random.Generator], Log]
    pushed: tuple[float, float] = (0.05, 0.1)
    since: float = 10.0
    headed: bool = False
    default: bool = False


# Samples


def record(
    rng,
    motion: Motion,
    duration: float,
    times: np.ndarray | None = None,
    stamps: np.ndarray | None = None,
    n: float = N,
    latitude: float | None = None,
    gravity: float = GRAVITY,
    **told,
) -> Log:
    """Samples of a motion at ``times`` (m,) that are recorded as ``stamps`` (m,)."""
    times = np.arange(0, duration, H) if times is None else times
    stamps = times if stamps is None else stamps
    before = np.append(2 * times[0] - times[1], times)
    q, period = motion.attitude(before), np.diff(before)
    if latitude is not None:
        # The Earth turns below: the body's turn against inertial space has that as well.
        world = EARTH * np.array([0, np.cos(latitude), np.sin(latitude)])
        turned = rotation.product(rotation.from_vector(world * before[:, None]), q)
    else:
        turned = q
    rate = rotation.to_vector(rotation.product(rotation.inverse(turned[:-1]), turned[1:]))
    rate /= period[:, None]
    up = np.array([0.0, 0.0, gravity])
    force = rotation.in_body(q[1:], motion.acceleration(times) + up)
    walk = np.cumsum(K * np.sqrt(period)[:, None] * rng.standard_normal((len(times), 3)), axis=0)
    bias = BIAS * rng.standard_normal(3) + walk
    white = n / np.sqrt(period)[:, None] * rng.standard_normal((len(times), 3))
    accel = Triad(np.zeros(3), np.full(3, N_ACCEL), np.zeros(3)).measure(rng, force, H)
    return Log(stamps, rate + bias + white, accel, q[1:], bias, told=told)


def yaw_of(q: np.ndarray) -> np.ndarray:
    w, x, y, z = q.T
    return np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def with_headings(rng, log: Log, every: float = 1.0, since: float = 0.0, age: float = 0.0) -> Log:
    """The log with headings ``every`` s that were true ``age`` s before."""
    rows = np.zeros(len(log.time), dtype=bool)
    rows[:: round(every / H)] = True
    rows &= (log.time >= since) & (log.time >= age)
    late = round(age / H)
    truth = np.roll(yaw_of(log.q), late)
    heading = np.where(rows, truth + HEADING_STD * rng.standard_normal(len(rows)), np.nan)
    columns = {"heading": heading, "heading_std": np.where(rows, HEADING_STD, np.nan)}
    if age:
        columns["heading_age"] = np.where(rows, late * H, np.nan)
    return Log(log.time, log.gyro, log.accel, log.q, log.bias, columns, log.told)


def off_scale(make: Callable[..., Log], share: float = 0.02) -> Callable[..., Log]:
    """A log of a gyro whose scale factors are off by a ``share`` drawn for each axis."""

    def scaled(rng) -> Log:
        log = make(rng)
        return replace(log, gyro=log.gyro * (1 + share * rng.standard_normal(3)))

    return scaled


# Motions


def still_start(t: np.ndarray, until: float = 5.0) -> np.ndarray:
    """0 for a rest at the start, 1 after it."""
    return eased(t, [(until, t[-1] + 10.0)], 1.0)[:, None]


def turning(rng, duration: float, speed: float = 0.5) -> tuple[np.ndarray, np.ndarray]:
    """Times, and slopes (n, 3) of a body that turns in place after a rest."""
    t = grid(duration)
    slopes = speed * smooth_noise(rng, t, 3, 0.02, 0.5) * [0.5, 0.5, 1.0] * still_start(t)
    return t, slopes


def pushed_by_hand(rng, duration: float, size: float, low: float, high: float, turn: float):
    t, slopes = turning(rng, duration, turn)
    pushed = size * smooth_noise(rng, t, 3, low, high) * still_start(t)
    return motion_of("hand", t, slopes, pushed)


def tapped(rng, duration: float):
    """Taps of some 0.1 s, one or two a second, each of which is there and back."""
    t, slopes = turning(rng, duration, 0.1)
    hits = np.zeros((len(t), 3))
    for at in np.arange(8.0, duration, 0.8):
        first = int((at + rng.uniform(0, 0.5) + 5.0) * KNOTS)
        hits[first : first + 6] += np.outer([1, 1, -1, -1, 0, 0], rng.normal(0, 4.0, 3))
    return motion_of("tapped", t, slopes, hits)


def vehicle(rng, duration: float, push: float, lasting: tuple[float, float], speed0: float = 8.0):
    """A car on flat ground: along-track accelerations of ``push`` m/s^2 that last so many s, turns
    with their centripetal force.
    """
    t = grid(duration)
    along, at = np.zeros_like(t), 6.0
    while at < duration:
        span = rng.uniform(*lasting)
        along += push * rng.choice([-1, 1]) * eased(t, [(at, at + span)], 0.5)
        at += span + rng.uniform(1.0, 4.0)
    driving = still_start(t)
    along *= driving[:, 0]
    speed = np.cumsum(along) / KNOTS
    # Not through standstill.
    speed += max(speed0, 2.0 - speed.min())
    turn = 0.04 * smooth_noise(rng, t, 1, 0.0, 0.1) * driving
    yaw = np.cumsum(turn[:, 0]) / KNOTS
    heading = np.column_stack([np.cos(yaw), np.sin(yaw), np.zeros_like(yaw)])
    across = np.column_stack([-np.sin(yaw), np.cos(yaw), np.zeros_like(yaw)])
    pushed = along[:, None] * heading + (speed * turn[:, 0])[:, None] * across
    slopes = np.column_stack([0 * t, 0 * t, turn[:, 0]])
    return motion_of("vehicle", t, slopes, pushed, speed)


def with_speed(rng, push: float, lasting: tuple[float, float]) -> Log:
    """The car with the speed of its wheels, ten times a second, to 0.05 m/s."""
    motion = vehicle(rng, 180.0, push, lasting)
    log = record(rng, motion, 180.0)
    speed = motion.speed(log.time) + 0.05 * rng.standard_normal(len(log.time))
    speed[np.arange(len(speed)) % 10 > 0] = np.nan
    return replace(log, heading={"speed": speed})


def with_stops(rng, duration: float):
    """A car on a rough road that stops for 8 to 15 s every half minute or so.

    It shakes while it drives: 0.3 m/s^2 of force and 0.02 rad/s of turn between 2 and 12 Hz.
    """
    t = grid(duration)
    drives = eased(t, busy_spans(rng, duration, (15, 30), (8, 15)), 6.0)
    speed = rng.uniform(5.0, 10.0) * drives
    turn = 0.1 * smooth_noise(rng, t, 1, 0.0, 0.1)[:, 0] * drives
    yaw = np.cumsum(turn) / KNOTS
    velocity = np.column_stack([speed * np.cos(yaw), speed * np.sin(yaw), np.zeros_like(t)])
    rough = np.minimum(speed, 1.0)[:, None]
    pushed = np.gradient(velocity, t, axis=0) + 0.3 * smooth_noise(rng, t, 3, 2.0, 12.0) * rough
    slopes = 0.02 * smooth_noise(rng, t, 3, 2.0, 12.0) * rough
    slopes[:, 2] += turn
    return motion_of("stops", t, slopes, pushed, speed)


def markov(rng, t: np.ndarray, size: float, tau: float) -> np.ndarray:
    """A Gauss-Markov process (n, 3)."""
    keep = np.exp(-1 / (KNOTS * tau))
    drawn = size * np.sqrt(1 - keep**2) * rng.standard_normal((len(t), 3))
    return lfilter([1.0], [1.0, -keep], drawn, axis=0)


def driven_by_noise(rng, duration: float, size: float, tau: float):
    """A body whose acceleration is a Gauss-Markov process: its velocity has no bound."""
    t, slopes = turning(rng, duration, 0.3)
    return motion_of("noise-like", t, slopes, markov(rng, t, size, tau) * still_start(t))


def resting_between(rng, duration: float):
    """Turned by hand for 10 to 30 s, then put down for 10 to 20 s, again and again."""
    t = grid(duration)
    busy = eased(t, busy_spans(rng, duration, (10, 30), (10, 20)))[:, None]
    slopes = 0.8 * smooth_noise(rng, t, 3, 0.02, 0.8) * [0.3, 0.3, 1.0] * busy
    return motion_of("rests", t, slopes, 0.5 * smooth_noise(rng, t, 3, 0.3, 2.0) * busy)


def one_way(rng, duration: float):
    """Turned about the vertical, 0.5 rad/s one way after a rest, with slow turns beside it."""
    t, slopes = turning(rng, duration)
    return motion_of("one way", t, 0.3 * slopes + [0.0, 0.0, 0.5] * still_start(t))


def slow_start(rng, duration: float):
    """No rest at the start: a slow turn instead, of 0.5 to 3 deg/s about an axis of its own."""
    t, slopes = turning(rng, duration, 0.5)
    axis = rng.standard_normal(3)
    axis *= np.deg2rad(rng.uniform(0.5, 3.0)) / np.linalg.norm(axis)
    return motion_of("slow start", t, slopes + (1 - still_start(t, 12.0)) * axis)


# Cases


def turned_one_way(rng) -> Log:
    return record(rng, one_way(rng, 160.0), 160.0)


def matched(rng, duration: float = 120.0, **more) -> Log:
    t, slopes = turning(rng, duration)
    return record(rng, motion_of("turning", t, slopes), duration, **more)


def still(rng) -> Log:
    t = grid(120.0)
    return record(rng, motion_of("still", t, np.zeros((len(t), 3))), 120.0)


def hand(size: float, low: float, high: float, turn: float) -> Callable[..., Log]:
    return lambda rng: record(rng, pushed_by_hand(rng, 120.0, size, low, high, turn), 120.0)


def car(push: float, lasting: tuple[float, float]) -> Callable[..., Log]:
    return lambda rng: record(rng, vehicle(rng, 180.0, push, lasting), 180.0)


def lost_yaw(rng) -> Log:
    log = with_headings(rng, matched(rng))
    log.gyro[4000:4200] = np.nan
    return log


def unknown_yaw(rng) -> Log:
    return with_headings(rng, matched(rng), since=10.0)


def wandering_rate(rng) -> Log:
    share = np.cumsum(rng.standard_normal(13_000)) * 0.002
    period = H * (1 + 0.1 * np.sin(share))
    times = np.cumsum(period)
    return matched(rng, times=times[times < 119.0])


def jittered(rng) -> Log:
    """The samples are taken evenly, their stamps are late by up to 0.4 of a period."""
    times = np.arange(0, 120.0, H)
    return matched(rng, times=times, stamps=times + H * rng.uniform(0, 0.4, len(times)))


def elsewhere(gravity: float) -> Callable[..., Log]:
    return lambda rng: matched(rng, gravity=gravity, settings={"gravity": gravity})


def stuck_axis(rng) -> Log:
    log = with_headings(rng, matched(rng))
    axis = rng.integers(3)
    log.gyro[5000:, axis] = log.gyro[5000, axis]
    return log


def clipped(rng) -> Log:
    """The gyro's range is left now and then, by a third of its size, and nobody declared it."""
    t, slopes = turning(rng, 120.0, 2.0)
    log = with_headings(rng, record(rng, motion_of("clipped", t, slopes), 120.0))
    level = 0.75 * np.nanmax(np.abs(log.gyro))
    np.clip(log.gyro, -level, level, out=log.gyro)
    return log


def warming(rng) -> Log:
    """The gyro warms up by 0.1 to 0.3 deg/s in minutes, and nobody declared it."""
    log = record(rng, resting_between(rng, 600.0), 600.0)
    away = rng.standard_normal(3)
    away *= np.deg2rad(rng.uniform(0.1, 0.3)) / np.linalg.norm(away)
    drift = (1 - np.exp(-log.time / rng.uniform(15.0, 150.0)))[:, None] * away
    return replace(log, gyro=log.gyro + drift, bias=log.bias + drift)


def late_headings(rng) -> Log:
    return with_headings(rng, matched(rng), age=0.5)


def untold_latitude(rng) -> Log:
    return with_headings(rng, matched(rng, n=1e-5, latitude=0.8), every=5.0)


def _bend(*how) -> Callable[..., Log]:
    return lambda rng: bodies.aircraft(rng, *how)


ORDINARY = (
    Case("aircraft, turns at 50 m/s", _bend(50.0, 0.44, (40.0, 80.0)), (3.0, 20.0)),
    Case("aircraft, turns at 18 m/s", _bend(18.0, 0.52, (20.0, 60.0)), (3.0, 20.0)),
    Case("the same, in the air at the start", _bend(18.0, 0.52, (20.0, 60.0), ()), (3.0, 20.0)),
    Case(
        "car, bends of 2 m/s^2", lambda rng: bodies.long_bends(rng, 2.0, (15.0, 40.0)), (2.0, 20.0)
    ),
    Case(
        "car, bends of 0.7 m/s^2",
        lambda rng: bodies.long_bends(rng, 0.7, (20.0, 40.0)),
        (0.7, 20.0),
    ),
    Case("turntable, after 20 s at rest", lambda rng: bodies.turntable(rng, 20.0)),
    Case("turntable, from the start", lambda rng: bodies.turntable(rng, -5.0)),
    Case("ship at anchor", bodies.at_anchor),
    Case("camera that pans", bodies.panned),
    Case("arm of a robot", bodies.arm, (3.0, 0.2)),
    Case("swinging link", bodies.swung, (3.0, 0.2)),
    Case("drone, motors of 0 uT", lambda rng: bodies.drone(rng, 0.0), (3.0, 1.0), headed=True),
    Case("drone, motors of 3 uT", lambda rng: bodies.drone(rng, 3e-6), (3.0, 1.0), headed=True),
    Case("drone, motors of 8 uT", lambda rng: bodies.drone(rng, 8e-6), (3.0, 1.0), headed=True),
    Case("phone, shaken at 10 m/s^2", lambda rng: bodies.shaken(rng, 10.0), (10.0, 0.1)),
    Case("phone, shaken at 25 m/s^2", lambda rng: bodies.shaken(rng, 25.0), (25.0, 0.1)),
)
"""Of ``drives.bodies``, whose sensors the filter is told nothing of."""

AT_SEA = tuple(
    Case(f"boat, {period:g} s, {height:g} m", partial(bodies.at_sea, period=period, height=height))
    for period, height in ((3.0, 0.15), (8.0, 0.15), (8.0, 0.5), (12.0, 1.0))
)
"""The same of boats in waves, which never rest."""

CASES = (
    Case("rest", still),
    Case("turning in place", matched),
    Case("turning, headings", lambda rng: with_headings(rng, matched(rng)), headed=True),
    Case("hand turns and sways", hand(0.1, 0.2, 1.0, 0.3), (0.1, 0.3)),
    Case("hand translates", hand(2.0, 0.3, 2.0, 0.2), (2.0, 0.1)),
    Case("hand turns fast", hand(1.0, 0.3, 2.0, 2.0), (1.0, 0.1)),
    Case("taps", lambda rng: record(rng, tapped(rng, 120.0), 120.0), (1.0, 0.02)),
    Case("vibration", hand(3.0, 8.0, 20.0, 0.2), (3.0, 0.01)),
    Case("vehicle, 0.5 m/s^2 for 3 to 8 s", car(0.5, (3.0, 8.0)), (0.5, 3.0)),
    Case("vehicle, 0.5 m/s^2 for 20 s", car(0.5, (18.0, 22.0)), (0.5, 10.0)),
    Case(
        "vehicle with its speed, 3 to 8 s",
        lambda rng: with_speed(rng, 0.5, (3.0, 8.0)),
        (0.5, 3.0),
    ),
    Case(
        "vehicle with its speed, 20 s",
        lambda rng: with_speed(rng, 0.5, (18.0, 22.0)),
        (0.5, 10.0),
    ),
    Case(
        "driven like noise, 0.5 m/s^2, 1 s",
        lambda rng: record(rng, driven_by_noise(rng, 120.0, 0.5, 1.0), 120.0),
        (0.5, 1.0),
    ),
    Case(
        "10 min with rests",
        lambda rng: record(rng, resting_between(rng, 600.0), 600.0),
        (0.5, 0.2),
    ),
    Case("the same, a gyro that warms up, undeclared", warming, (0.5, 0.2)),
    Case("slow turn at the start", lambda rng: record(rng, slow_start(rng, 120.0), 120.0)),
    Case("yaw lost for 2 s", lost_yaw, since=42.5, headed=True),
    Case("heading after 10 s", unknown_yaw, since=10.5, headed=True),
    Case("headings 0.5 s late", late_headings, headed=True),
    Case("rate wanders by 10 %", wandering_rate),
    Case("stamps jitter by 40 %", jittered),
    Case("Mars", elsewhere(3.71)),
    Case("Moon", elsewhere(1.62)),
    Case("an axis sticks", stuck_axis, since=51.0, headed=True),
    Case("undeclared clip", clipped, headed=True),
    Case("latitude not told", untold_latitude, headed=True),
    Case(
        "vehicle that stops",
        lambda rng: record(rng, with_stops(rng, 300.0), 300.0),
        (1.0, 4.0),
    ),
    *(replace(c, default=True) for c in (*ORDINARY, *AT_SEA)),
)
