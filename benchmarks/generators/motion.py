"""Motions: a rate table, a tumble by hand, a rover's drive, a slow calibration dance, a shaker, a
thermal cycle with turns, rest.

A motion is given by the slopes of roll, pitch and yaw and by the body's acceleration as cubic
splines. The angles are their integrals, so that attitude and rate agree to rounding at any time,
before and after the log as well.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline
from scipy.signal import butter, sosfiltfilt

from generators import rotation

GRAVITY = 9.80665
KNOTS = 50.0
"""Hz; knots of the splines."""

BEYOND = 5.0
"""s; so far a motion goes on before and after the log, at least."""


@dataclass(frozen=True)
class Motion:
    """A body's motion: ``slopes`` of roll, pitch and yaw in rad/s, ``acceleration`` in the world in
    m/s^2, ``speed`` in m/s, each a spline over time.
    """

    name: str
    slopes: BSpline
    acceleration: BSpline
    speed: BSpline

    @cached_property
    def _angles(self) -> BSpline:
        return self.slopes.antiderivative()

    def angles(self, time: np.ndarray) -> np.ndarray:
        """Roll, pitch and yaw (n, 3)."""
        return self._angles(time)

    def attitude(self, time: np.ndarray) -> np.ndarray:
        return rotation.from_angles(self._angles(time))

    def rate(self, time: np.ndarray) -> np.ndarray:
        """rad/s, (n, 3) in body axes."""
        return rotation.body_rate(self._angles(time), self.slopes(time))

    def force(self, time: np.ndarray) -> np.ndarray:
        """Specific force (n, 3) in body axes, m/s^2."""
        up = np.array([0.0, 0.0, GRAVITY])
        return rotation.in_body(self.attitude(time), self.acceleration(time) + up)


def grid(duration: float) -> np.ndarray:
    return np.arange(-BEYOND, duration + BEYOND, 1 / KNOTS)


def motion_of(name: str, t: np.ndarray, slopes, acceleration=None, speed=None) -> Motion:
    """The motion through slopes (n, 3), acceleration (n, 3) and speed (n,) at the times ``t``."""
    acceleration = np.zeros((len(t), 3)) if acceleration is None else acceleration
    speed = np.linalg.norm(slopes, axis=1) if speed is None else speed
    return Motion(name, *(make_interp_spline(t, v, k=3) for v in (slopes, acceleration, speed)))


def smooth_noise(rng, t: np.ndarray, columns: int, low: float, high: float) -> np.ndarray:
    """Noise (n, columns) of unit variance between ``low`` and ``high`` Hz; low 0 has no limit."""
    band, kind = ((low, high), "bandpass") if low > 0 else (high, "lowpass")
    sos = butter(2, band, kind, fs=KNOTS, output="sos")
    out = sosfiltfilt(sos, rng.standard_normal((len(t), columns)), axis=0)
    return out / out.std(axis=0)


def eased(t: np.ndarray, spans: list[tuple[float, float]], ramp: float = 0.6) -> np.ndarray:
    """1 inside spans (start, stop), 0 outside, by raised cosines of ``ramp`` seconds."""
    out = np.zeros_like(t)
    for a, b in spans:
        x = np.clip(np.minimum(t - a, b - t) / ramp, 0.0, 1.0)
        out = np.maximum(out, 0.5 - 0.5 * np.cos(np.pi * x))
    return out


def busy_spans(rng, duration: float, busy, rest) -> list[tuple[float, float]]:
    """Spans that move, of lengths from ``busy`` (low, high) s, between rests from ``rest``."""
    spans, at = [], float(rng.uniform(*rest))
    while at < duration + BEYOND:
        end = at + float(rng.uniform(*busy))
        spans.append((at, end))
        at = end + float(rng.uniform(*rest))
    return spans


# The motions


def table(rng, duration: float) -> Motion:
    """A rate table: one axis after another, by turns a sinusoid and constant rates to and fro."""
    t = grid(duration)
    slopes = np.zeros((len(t), 3))
    length = (duration - 3.0) / 3
    for k, axis in enumerate(rng.permutation(3)):
        start = 2.0 + k * length
        third = (length - 2.0) / 3
        wave = rng.uniform(1.0, 2.5) * np.sin(2 * np.pi * rng.uniform(0.3, 1.2) * (t - start))
        fast = rng.uniform(0.6, 2.0) * rng.choice([-1, 1])
        spans = [(start + i * third, start + (i + 1) * third - 1.0) for i in range(3)]
        shares = [eased(t, [s], 0.8) for s in spans]
        slopes[:, axis] += shares[0] * wave + fast * (shares[1] - shares[2])
    return motion_of("table", t, slopes)


def tumble(rng, duration: float) -> Motion:
    """Turned by hand: smooth random rates of 1 to 4 rad/s on all axes, with rests."""
    t = grid(duration)
    busy = eased(t, busy_spans(rng, duration, (8, 20), (1.5, 4)))[:, None]
    slopes = rng.uniform(0.8, 1.6) * smooth_noise(rng, t, 3, 0.0, rng.uniform(0.8, 2.0)) * busy
    pushed = rng.uniform(0.3, 1.5) * smooth_noise(rng, t, 3, 0.2, 2.5) * busy
    return motion_of("tumble", t, slopes, pushed)


def rover(rng, duration: float) -> Motion:
    """Driven over the ground: turns about z, ripples of pitch and roll, stops."""
    t = grid(duration)
    drives = eased(t, busy_spans(rng, duration, (15, 30), (2, 5)), 1.0)
    turn = rng.uniform(0.3, 0.7) * smooth_noise(rng, t, 1, 0.0, rng.uniform(0.3, 0.8))[:, 0]
    ripple = rng.uniform(0.03, 0.15) * smooth_noise(rng, t, 2, 1.0, 6.0)
    slopes = np.column_stack([ripple, turn]) * drives[:, None]
    speed = drives * (rng.uniform(0.5, 1.5) + 0.2 * smooth_noise(rng, t, 1, 0.0, 0.3)[:, 0])
    yaw = np.cumsum(slopes[:, 2]) / KNOTS
    velocity = np.column_stack([speed * np.cos(yaw), speed * np.sin(yaw), np.zeros_like(speed)])
    pushed = np.gradient(velocity, t, axis=0)
    pushed += rng.uniform(0.1, 0.5) * smooth_noise(rng, t, 3, 1.0, 8.0) * drives[:, None]
    return motion_of("rover", t, slopes, pushed, speed)


def dance(rng, duration: float) -> Motion:
    """A calibration by hand: from one position to the next, 0.5 to 1.5 rad/s, with a rest in
    each.
    """
    t = grid(duration)
    slopes = np.zeros((len(t), 3))
    for a, b in busy_spans(rng, duration, (1.5, 4), (1.5, 3)):
        axis = rng.standard_normal(3)
        axis /= np.linalg.norm(axis)
        slopes += rng.uniform(0.5, 1.5) * eased(t, [(a, b)])[:, None] * axis
    shaken = 0.05 * smooth_noise(rng, t, 3, 0.5, 6.0) * (np.abs(slopes).sum(axis=1) > 0)[:, None]
    return motion_of("dance", t, slopes + shaken, 4 * shaken)


def shaker(rng, duration: float) -> Motion:
    """Shaken on a table in one tilted position: a sinusoid that sweeps from 2 to 10 Hz, along one
    direction after another, and random vibration, with pauses; it hardly turns.
    """
    t = grid(duration)
    spans = busy_spans(rng, duration, (15, 30), (3, 6))
    swept = 2 * np.pi * np.cumsum(6 + 4 * np.sin(2 * np.pi * t / rng.uniform(25, 60))) / KNOTS
    pushed = rng.uniform(0.5, 2.0) * smooth_noise(rng, t, 3, 2.0, 12.0)
    share = np.zeros_like(t)
    for span in spans:
        direction = rng.standard_normal(3)
        direction *= rng.uniform(2.0, 8.0) / np.linalg.norm(direction)
        on = eased(t, [span], 1.0)
        pushed += on[:, None] * np.sin(swept)[:, None] * direction
        share = np.maximum(share, on * rng.uniform(0.2, 1.0))
    wobble = 0.02 * smooth_noise(rng, t, 3, 2.0, 12.0) * share[:, None]
    return motion_of("shaker", t, wobble + _tilt(rng, t), pushed * share[:, None])


def _tilt(rng, t: np.ndarray) -> np.ndarray:
    """Slopes (n, 3) that turn roll and pitch by up to 0.6 rad before the log begins."""
    turned = eased(t, [(-BEYOND + 0.5, -BEYOND + 2.5)])
    return turned[:, None] * np.append(rng.uniform(-0.6, 0.6, 2), 0.0) / (turned.sum() / KNOTS)


def static(rng, duration: float) -> Motion:
    """At rest in a tilted position."""
    t = grid(duration)
    return motion_of("static", t, _tilt(rng, t))


def thermal_cycle(rng, duration: float) -> Motion:
    """In a chamber: at rest, and every two minutes turned to and fro about each axis."""
    t = grid(duration)
    slopes, at = _tilt(rng, t), float(rng.uniform(5, 15))
    while at < duration:
        for axis in rng.permutation(3):
            fast = rng.uniform(0.3, 1.5) * rng.choice([-1, 1])
            shares = eased(t, [(at, at + 5)]) - eased(t, [(at + 5, at + 10)])
            slopes[:, axis] += fast * shares
            at += 11.0
        at += float(rng.uniform(70, 100))
    return motion_of("thermal_cycle", t, slopes)


MOTIONS: tuple[Callable[..., Motion], ...] = (table, tumble, rover, dance)


def any_motion(rng, duration: float) -> Motion:
    return MOTIONS[rng.integers(len(MOTIONS))](rng, duration)
