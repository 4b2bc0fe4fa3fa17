"""Bodies that attitude filters are used on, with the sensors that are in them, by numpy alone.

Aircraft and cars in bends, turntables, arms of robots, drones with motors near a magnetometer, and
phones that are shaken. None of it shares code with the package or with ``generators``: the truth is
angles and places on a grid of ``FINE`` Hz, differentiated there, and a sample of the gyro is the
turn since the one before.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from drives.log import Log

GRAVITY = 9.80665

RATE, FINE = 100, 400
"""Hz; of the samples, and of the truth."""


@dataclass(frozen=True)
class Sensors:
    """Standard deviations among specimens, and root densities of the noise.

    ``n`` rad/sqrt(s), ``k`` rad/s/sqrt(s), ``bias`` rad/s, ``scale`` 1 and ``askew`` rad are the
    gyro's; ``force_n`` m/s^2 sqrt(s), ``force_bias`` m/s^2 and ``force_scale`` 1 the
    accelerometer's.
    """

    n: float = 1.2e-4
    k: float = 2e-5
    bias: float = 0.0087
    scale: float = 0.0
    askew: float = 0.0
    force_n: float = 1e-3
    force_bias: float = 0.0
    force_scale: float = 0.0


CALIBRATED = Sensors()
AS_BOUGHT = Sensors(scale=0.01, askew=0.005, force_bias=0.1, force_scale=0.005)
"""A consumer's, calibrated by somebody and as it is sold: 1 %, 0.3 deg, 10 mg."""


def clock(duration: float) -> np.ndarray:
    """Times (n,) s of the truth."""
    return np.arange(-FINE // RATE, round(duration * FINE)) / FINE


def smooth(rng, t: np.ndarray, time: float, columns: int = 1) -> np.ndarray:
    """Noise (n, columns) of unit variance through a window of the shape of a bell, ``time`` s wide
    to either side.
    """
    reach = round(3 * time * FINE)
    bell = np.exp(-0.5 * (np.arange(-reach, reach + 1) / (time * FINE)) ** 2)
    bell /= np.linalg.norm(bell)
    drawn = rng.standard_normal((columns, len(t) + 2 * reach))
    return np.column_stack([np.convolve(row, bell, "valid") for row in drawn])


def steps(t: np.ndarray, edges: list[tuple[float, float]], ramp: float) -> np.ndarray:
    """(n,): from 0 to each value at its time, over ``ramp`` s without a jump of the slope."""
    out, before = np.zeros_like(t), 0.0
    for at, value in edges:
        share = np.clip((t - at) / ramp, 0.0, 1.0)
        out += (value - before) * (0.5 - 0.5 * np.cos(np.pi * share))
        before = value
    return out


def integral(values: np.ndarray) -> np.ndarray:
    """Of (n, ...) over time, zero at the first row, by the trapezoidal rule."""
    means = (values[1:] + values[:-1]) / (2 * FINE)
    return np.concatenate([np.zeros_like(values[:1]), np.cumsum(means, axis=0)])


def slope(values: np.ndarray) -> np.ndarray:
    return np.gradient(values, 1 / FINE, axis=0)


# Samples


def axes_of(yaw: np.ndarray, pitch: np.ndarray, roll: np.ndarray) -> np.ndarray:
    """Matrices (n, 3, 3) from body to world: about z, then y, then x."""
    (cy, sy), (cp, sp), (cr, sr) = ((np.cos(a), np.sin(a)) for a in (yaw, pitch, roll))
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def turns_of(axes: np.ndarray) -> np.ndarray:
    """Rotation vectors (n - 1, 3) in body axes from each attitude to the next, of less than a
    quarter turn each.
    """
    step = np.swapaxes(axes[:-1], 1, 2) @ axes[1:]
    twice = np.stack([step[:, i, j] - step[:, j, i] for i, j in ((2, 1), (0, 2), (1, 0))], axis=-1)
    sine = np.linalg.norm(twice, axis=1, keepdims=True) / 2
    return twice / 2 / np.sinc(np.arcsin(np.clip(sine, 0, 1)) / np.pi)


def quaternions_of(axes: np.ndarray) -> np.ndarray:
    """Hamilton's quaternions (n, 4), scalar first, by the largest of the four each (Shepperd)."""
    d = np.stack([axes[:, i, i] for i in range(3)], axis=-1)
    trace = d.sum(axis=1, keepdims=True)
    squares = np.concatenate([1 + trace, 1 + 2 * d - trace], axis=1)
    m = np.zeros((len(axes), 4, 4))
    m[:, range(4), range(4)] = squares
    for i, (a, b) in enumerate(((1, 2), (2, 0), (0, 1))):
        m[:, 0, i + 1] = m[:, i + 1, 0] = axes[:, b, a] - axes[:, a, b]
        m[:, a + 1, b + 1] = m[:, b + 1, a + 1] = axes[:, a, b] + axes[:, b, a]
    best = np.argmax(squares, axis=1)
    q = m[np.arange(len(axes)), best]
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def measured(
    rng,
    axes: np.ndarray,
    acceleration: np.ndarray,
    sensors: Sensors = CALIBRATED,
    shake: np.ndarray | None = None,
    **more,
) -> Log:
    """The samples of a body with attitudes (n, 3, 3) and accelerations (n, 3) in world axes at
    ``FINE`` Hz, and with a further acceleration ``shake`` (m, 3) in body axes, a row a sample.
    """
    every, period = FINE // RATE, 1 / RATE
    axes, acceleration = axes[::every], acceleration[::every]
    rate = turns_of(axes) * RATE
    axes, acceleration = axes[1:], acceleration[1:]
    n = len(rate)
    force = np.einsum("nji,nj->ni", axes, acceleration + [0.0, 0.0, GRAVITY])
    force += 0.0 if shake is None else shake[:n]
    drawn = rng.standard_normal

    def triad(values, scale, askew):
        m = np.eye(3) + np.diag(scale * drawn(3)) + askew * drawn((3, 3)) * (1 - np.eye(3))
        return values @ m.T

    walk = np.cumsum(sensors.k * np.sqrt(period) * drawn((n, 3)), axis=0)
    bias = sensors.bias * drawn(3) + walk
    gyro = triad(rate, sensors.scale, sensors.askew) + bias + sensors.n * RATE**0.5 * drawn((n, 3))
    accel = triad(force, sensors.force_scale, sensors.force_scale)
    accel += sensors.force_bias * drawn(3) + sensors.force_n * RATE**0.5 * drawn((n, 3))
    time = np.arange(n) * period
    return Log(time, gyro, accel, quaternions_of(axes), bias, **more)


# Bends


def aircraft(
    rng, speed: float, bank: float, lasting: tuple[float, float], start=(15.0, 20.0), **more
):
    """It stands and takes off, ``start`` s each, then turns one way or the other, banked so that it
    does not slip, for so many s, with 10 to 20 s of straight flight in between, in slight
    turbulence. Without a ``start`` it flies from the first sample on.
    """
    t = clock(duration := 240.0)
    flies = steps(t, [(start[0], 1.0)], start[1]) if start else np.ones_like(t)
    edges, at = [], (sum(start) if start else 0.0) + 20.0
    while at < duration:
        end = at + rng.uniform(*lasting)
        edges += [(at, bank * rng.uniform(0.7, 1.1) * rng.choice([-1, 1])), (end, 0.0)]
        at = end + rng.uniform(10.0, 20.0)
    roll = steps(t, edges, 3.0)
    yaw = rng.uniform(-3, 3) - integral(GRAVITY * np.tan(roll) / speed)
    velocity = speed * flies[:, None] * np.column_stack([np.cos(yaw), np.sin(yaw), 0 * yaw])
    gusts = 0.01 * smooth(rng, t, 0.5, 3) * flies[:, None]
    pushed = slope(velocity + 0.3 * smooth(rng, t, 0.5, 3) * flies[:, None])
    axes = axes_of(yaw + gusts[:, 0], -0.03 * flies + gusts[:, 1], roll + gusts[:, 2])
    return measured(rng, axes, pushed, **more)


def long_bends(rng, push: float, lasting: tuple[float, float], duration=240.0, **more):
    """A car on flat ground, still for 10 s, then at 10 to 20 m/s, in bends of ``push`` m/s^2 for so
    many s.
    """
    t = clock(duration)
    top, edges, at = rng.uniform(10.0, 20.0), [], 30.0
    while at < duration:
        end = at + rng.uniform(*lasting)
        edges += [(at, push * rng.uniform(0.7, 1.1) * rng.choice([-1, 1])), (end, 0.0)]
        at = end + rng.uniform(10.0, 20.0)
    across, speed = steps(t, edges, 2.0), steps(t, [(10.0, top)], 12.0)
    yaw = rng.uniform(-3, 3) + integral(across / np.maximum(speed, 5.0))
    velocity = speed[:, None] * np.column_stack([np.cos(yaw), np.sin(yaw), 0 * yaw])
    rough = np.minimum(speed, 5.0)[:, None] / 5
    pushed = slope(velocity) + rough * 0.3 * smooth(rng, t, 0.03, 3)
    jolts = 0.004 * smooth(rng, t, 0.1, 2) * rough
    return measured(rng, axes_of(yaw, jolts[:, 0], jolts[:, 1]), pushed, **more)


# Slow turns


def turntable(rng, first: float, duration=240.0, **more):
    """Level or askew by 3 deg, it turns about the vertical at 0.3 to 2 deg/s one way or the other
    for 20 to 60 s and stands for 5 to 20 s, from ``first`` s on.
    """
    t = clock(duration)
    edges, at = [], first
    while at < duration:
        end = at + rng.uniform(20.0, 60.0)
        edges += [(at, np.radians(rng.uniform(0.3, 2.0)) * rng.choice([-1, 1])), (end, 0.0)]
        at = end + rng.uniform(5.0, 20.0)
    yaw = integral(steps(t, edges, 1.0))
    off = np.radians(3.0) * rng.standard_normal(2)
    # The axis of the table is vertical, the body stands askew on it.
    axes = axes_of(yaw, 0 * t, 0 * t) @ axes_of(*np.array([[0.0], off[:1], off[1:]]))
    return measured(rng, axes, np.zeros((len(t), 3)), **more)


def at_anchor(rng, duration=300.0, **more):
    """A ship that swings about its anchor by 20 deg in two to four minutes, and hardly rolls."""
    t = clock(duration)
    w = 2 * np.pi / rng.uniform(120.0, 240.0)
    yaw = np.radians(20.0) * np.sin(w * t + rng.uniform(0, 2 * np.pi))
    roll = np.radians(0.05) * np.sin(2 * np.pi / 8.0 * t + rng.uniform(0, 2 * np.pi))
    return measured(rng, axes_of(yaw, 0 * t, roll), np.zeros((len(t), 3)), **more)


def at_sea(rng, period: float, height: float, duration=150.0, **more):
    """A boat in waves of ``period`` s that lift it by some ``height`` m and sway it by half of
    that, and under way all the time: it never rests.
    """
    t = clock(duration)

    def wave(seconds: float, size: float) -> np.ndarray:
        """Of a narrow sea: twelve sines within 15 % (1 sigma), of the root mean square ``size``."""
        frequencies, phases = rng.normal(1.0, 0.15, 12) / seconds, rng.uniform(0, 2 * np.pi, 12)
        waves = np.sin(2 * np.pi * frequencies * t[:, None] + phases)
        return size * np.sqrt(2 / 12) * waves.sum(axis=1)

    course = 0.03 * integral(smooth(rng, t, 8.0))[:, 0]
    roll, pitch = wave(0.75 * period, 0.1), wave(0.9 * period, 0.05)
    sizes = (0.5 * height, 0.5 * height, height)
    place = np.column_stack([wave(period, size) for size in sizes])
    axes = axes_of(course + wave(1.1 * period, 0.02), pitch, roll)
    return measured(rng, axes, slope(slope(place)), **more)


def panned(rng, duration=240.0, **more):
    """A camera's head that pans and tilts, an even turn of 0.3 to 2 deg/s after another, with
    pauses.
    """
    t = clock(duration)
    rates = []
    for ramp in (0.5, 1.0):
        edges, at, angle = [], 8.0, 0.0
        while at < duration:
            span, rate = rng.uniform(10.0, 30.0), np.radians(rng.uniform(0.3, 2.0))
            rate *= -np.sign(angle) if abs(angle) > 0.3 else rng.choice([-1, 1])
            edges += [(at, rate), (at + span, 0.0)]
            angle, at = angle + rate * span, at + span + rng.uniform(2.0, 10.0)
        rates.append(steps(t, edges, ramp))
    yaw, pitch = (integral(r) for r in rates)
    return measured(rng, axes_of(yaw, pitch, 0 * t), np.zeros((len(t), 3)), **more)


# Arms, drones, phones


def arm(rng, duration=240.0, **more):
    """The end of an arm of two links of 0.5 m upright in a plane, on a base that turns; each joint
    swings evenly, all the time.
    """
    t = clock(duration)
    begun = steps(t, [(8.0, 1.0)], 2.0)

    def joint(size):
        w = 2 * np.pi * rng.uniform(0.2, 0.6)
        return begun * size * np.sin(w * t + rng.uniform(0, 2 * np.pi))

    base, upper, lower = joint(0.8), 0.6 + joint(0.5), -1.2 + joint(0.7)
    first, second = upper, upper + lower
    reach = 0.5 * (np.cos(first) + np.cos(second))
    place = np.column_stack(
        [reach * np.cos(base), reach * np.sin(base), 0.5 * (np.sin(first) + np.sin(second))]
    )
    return measured(rng, axes_of(base, -second, 0 * t), slope(slope(place)), **more)


def swung(rng, duration=240.0, **more):
    """A link of 0.7 m that hangs and swings to and fro about one axis, by 40 deg."""
    t = clock(duration)
    w = 2 * np.pi * rng.uniform(0.4, 0.7)
    angle = steps(t, [(8.0, 0.7)], 2.0) * np.sin(w * t + rng.uniform(0, 2 * np.pi))
    place = 0.7 * np.column_stack([np.sin(angle), 0 * t, -np.cos(angle)])
    return measured(rng, axes_of(0 * t, -angle, 0 * t), slope(slope(place)), **more)


FIELD = np.array([0.0, 19e-6, -45e-6])
"""T; east, north, up."""


def leaning(yaw: np.ndarray, thrust: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pitch and roll (n,) of a body whose upward axis lies along its ``thrust`` (n, 3)."""
    ahead = thrust[:, 0] * np.cos(yaw) + thrust[:, 1] * np.sin(yaw)
    left = thrust[:, 1] * np.cos(yaw) - thrust[:, 0] * np.sin(yaw)
    pitch = np.arctan2(ahead, thrust[:, 2])
    return pitch, -np.arctan2(left, np.hypot(ahead, thrust[:, 2]))


def drone(rng, current: float, duration=180.0, **more):
    """It stands for 10 s, then flies about by leaning, with motors whose field of ``current`` T in
    hover grows with the thrust, whose vibration of 2 m/s^2 is faster than the samples.
    """
    t = clock(duration)
    flies = steps(t, [(10.0, 1.0)], 2.0)
    velocity = flies[:, None] * smooth(rng, t, 1.5, 3) * [4.0, 4.0, 1.0]
    pushed = slope(velocity)
    yaw = rng.uniform(-3, 3) + integral(flies * 0.4 * smooth(rng, t, 1.0)[:, 0])
    whole = pushed + [0.0, 0.0, GRAVITY]
    pitch, roll = leaning(yaw, whole)
    wobble = 0.02 * smooth(rng, t, 0.05, 3) * flies[:, None]
    axes = axes_of(yaw + wobble[:, 0], pitch + wobble[:, 1], roll + wobble[:, 2])
    every = FINE // RATE
    on, thrust = flies[::every][1:, None], np.linalg.norm(whole, axis=1)[::every][1:] / GRAVITY
    shake = 2.0 * on * rng.standard_normal((len(on), 3))
    log = measured(rng, axes, pushed, shake=shake, **more)
    wire = rng.standard_normal(3)
    field = np.einsum("nji,j->ni", axes[::every][1:], FIELD)
    field += current * on * thrust[:, None] * wire / np.linalg.norm(wire)
    log.heading["mag"] = field + 3e-7 * rng.standard_normal(field.shape)
    return log


def shaken(rng, size: float, duration=120.0, **more):
    """A phone: held for 5 s, then shaken at 2 to 4 Hz by ``size`` m/s^2 along a direction of the
    hand, turned along about the wrist, for 5 to 15 s with 2 to 5 s in between.
    """
    t = clock(duration)
    edges, at = [], 5.0
    while at < duration:
        end = at + rng.uniform(5.0, 15.0)
        edges += [(at, 1.0), (end, 0.0)]
        at = end + rng.uniform(2.0, 5.0)
    on = steps(t, edges, 0.5)
    phase = integral(2 * np.pi * (3.0 + 0.5 * smooth(rng, t, 1.0)[:, 0]))
    w = 2 * np.pi * 3.0
    held = 0.3 * smooth(rng, t, 1.0, 3)
    direction = np.array([1.0, 0.3, 0.5]) + 0.3 * smooth(rng, t, 2.0, 3)
    swing = (on * np.sin(phase))[:, None]
    place = size / w**2 * swing * direction + 0.02 * smooth(rng, t, 0.5, 3) * on[:, None]
    turned = (
        held + 0.3 * swing * rng.standard_normal(3) + 0.1 * on[:, None] * smooth(rng, t, 0.1, 3)
    )
    return measured(rng, axes_of(*turned.T), slope(slope(place)), **more)
