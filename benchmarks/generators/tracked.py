"""Motions in front of cameras, whose places are known: a wand in a hand, a foot that walks, a
quadrotor.

The place of the body is a spline of fifth degree, and its acceleration the second slope of that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline
from scipy.signal import butter, sosfiltfilt

from generators.motion import BEYOND, GRAVITY, KNOTS, Motion, busy_spans, eased, grid, smooth_noise

QUICK = 200.0
"""Hz; knots of a foot's splines: it is stopped within some hundredths of a second."""


@dataclass(frozen=True)
class Tracked(Motion):
    """A motion with its ``place`` in m, east, north and up."""

    place: BSpline

    def position(self, time: np.ndarray) -> np.ndarray:
        """Where the body is (n, 3), m."""
        return self.place(time)


def _tracked(name: str, t: np.ndarray, angles: np.ndarray, places: np.ndarray) -> Tracked:
    """The motion through roll, pitch and yaw (n, 3) and places (n, 3) at the times ``t``."""
    place, turn = (make_interp_spline(t, v, k=5) for v in (places, angles))
    speed = make_interp_spline(t, np.linalg.norm(place(t, 1), axis=1), k=3)
    return _Turned(name, turn.derivative(), place.derivative(2), speed, place, turn)


@dataclass(frozen=True)
class _Turned(Tracked):
    """One whose ``turn``, roll, pitch and yaw, is given, and not begun at zero."""

    turn: BSpline

    @property
    def _angles(self) -> BSpline:
        return self.turn


def wand(rng, duration: float) -> Tracked:
    """Waved and turned by hand in all directions, with rests."""
    t = grid(duration)
    busy = eased(t, busy_spans(rng, duration, (8, 20), (1.5, 4)))[:, None]
    slopes = rng.uniform(0.8, 1.6) * smooth_noise(rng, t, 3, 0.0, rng.uniform(0.8, 2.0)) * busy
    way = rng.uniform(0.03, 0.08) * smooth_noise(rng, t, 3, 0.3, rng.uniform(1.5, 2.5)) * busy
    return _tracked("wand", t, np.cumsum(slopes, axis=0) / KNOTS, way + [0.0, 0.0, 1.2])


def quadrotor(rng, duration: float) -> Tracked:
    """Flown to and fro in a room: it leans into where it is pushed, and turns slowly."""
    t = grid(duration)
    flies = eased(t, busy_spans(rng, duration, (25, 40), (3, 6)), 1.5)[:, None]
    way = smooth_noise(rng, t, 3, 0.05, rng.uniform(0.3, 0.6))
    way *= rng.uniform(1.0, 2.5) / np.gradient(np.gradient(way, t, axis=0), t, axis=0).std(axis=0)
    places = way * flies * [1.0, 1.0, 0.5] + [0.0, 0.0, 1.5] * flies
    # Nothing is pushed at once.
    places = sosfiltfilt(butter(2, 3.0, fs=KNOTS, output="sos"), places, axis=0)
    push = make_interp_spline(t, places, k=5)(t, 2)
    yaw = rng.uniform(0.3, 1.0) * smooth_noise(rng, t, 1, 0.0, 0.3)[:, 0] * flies[:, 0]
    along = push[:, 0] * np.cos(yaw) + push[:, 1] * np.sin(yaw)
    across = push[:, 1] * np.cos(yaw) - push[:, 0] * np.sin(yaw)
    lean = np.column_stack([-across, along]) / (push[:, 2:] + GRAVITY)
    lean += 0.01 * smooth_noise(rng, t, 2, 1.0, 4.0) * flies
    return _tracked("quadrotor", t, np.column_stack([lean, yaw]), places)


def foot(rng, duration: float) -> Tracked:
    """A foot that walks to and fro: it swings, strikes the ground, and rests on it."""
    t = np.arange(-BEYOND, duration + BEYOND, 1 / QUICK)
    angles, places = np.zeros((2, len(t), 3))
    stride, swing, forward = rng.uniform(1.0, 1.3), rng.uniform(0.38, 0.45), 1.0
    at, begins, length = float(rng.uniform(1, 3)), 0.0, rng.uniform(0.8, 1.3)
    while at < duration + BEYOND - 2.0:
        share = np.clip((t - at) / swing, 0.0, 1.0)
        gone = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
        size, arch = rng.uniform(0.9, 1.1), (share * (1.0 - share)) ** 3
        places[:, 0] += forward * size * length * gone
        places[:, 2] += rng.uniform(0.08, 0.16) * 64.0 * arch
        angles[:, 1] += forward * rng.uniform(60.0, 90.0) * arch * np.cos(np.pi * share)
        angles[:, :2] += 0.1 * 64.0 * arch[:, None] * rng.standard_normal(2)
        places += _strike(rng, t - at - swing)
        at += stride * rng.uniform(0.95, 1.05)
        if abs(places[-1, 0] - begins) > 5.0:
            share = np.clip((t - at) / 1.0, 0.0, 1.0)
            angles[:, 2] += np.pi * share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
            forward, begins, at = -forward, places[-1, 0], at + 1.5
    return _tracked("foot", t, angles, places)


def _strike(rng, since: np.ndarray) -> np.ndarray:
    """What the ground does to a foot (n, 3), m: it rings for some hundredths of a second, by some
    tens of m/s^2.
    """
    turn = 2.0 * np.pi * rng.uniform(12.0, 22.0)
    size = rng.uniform(10.0, 40.0) / turn**2 * rng.normal(size=3) * [0.6, 0.3, 1.0]
    late = np.maximum(since, 0.0)
    shape = (1.0 - np.exp(-late / 0.01)) ** 5 * np.exp(-late / 0.03) * np.sin(turn * late)
    return shape[:, None] * size


TRACKED = (wand, quadrotor, foot)


def any_tracked(rng, duration: float) -> Tracked:
    return TRACKED[rng.integers(len(TRACKED))](rng, duration)
