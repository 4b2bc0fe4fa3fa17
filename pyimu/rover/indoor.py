"""The drive of an indoor robot: a known start-up motion, then straights, quarter turns and stops.

Hong and Park 2008 give neither the motion nor its length. What stands here are assumptions, so
chosen that the published heading errors come out (``examples/hong2008_heading.py`` prints them
beside each other): 3 min, of which 20 s are the start-up motion; turns at 30 deg/s; 30 % of the
drive at rest; ten quarter turns, seven to the left and three to the right, so that a scale factor
acts on 360 deg in the end.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY

TURN_RATE = np.radians(30.0)
"""rad/s."""

START_UP = ((2.0, 0.0), (6.0, 1.0), (2.0, 0.0), (6.0, -1.0), (4.0, 0.0))
"""Seconds and share of the turn rate: half a turn to the left, half a turn back."""

TURNS = (1, 1, -1, 1, 1, -1, 1, 1, -1, 1)
"""Sense of the quarter turns, counter-clockwise above zero."""

CYCLE = (4.8, 8.2, 3.0)
"""s of stop, straight and quarter turn, ten times: 160 s, of which 30 % are stops."""

RAMP = 0.3
"""s over which a turn begins and ends."""

WANDER_TIME = 1.2
"""s; correlation time of the heading's wander while the robot drives, that of its steering."""

SHAKE = 0.5
"""m/s^2; RMS of what wheels and floor do to the accelerometer while the robot drives."""


@dataclass(frozen=True)
class Indoor:
    """The motion of an indoor robot at n samples.

    ``time`` s, ``rate`` rad/s the true mean rate of the period that ends with each row, ``heading``
    rad its sum, ``nominal`` rad the heading that the known motion is said to have, ``force`` (n, 3)
    m/s^2 in body axes, ``standing`` (n,), ``start_up`` the rows of the known motion.
    """

    time: np.ndarray
    rate: np.ndarray
    heading: np.ndarray
    nominal: np.ndarray
    force: np.ndarray
    standing: np.ndarray
    start_up: int

    def recording(self, gyro_z: np.ndarray, known: bool = False, name: str = "indoor") -> Recording:
        """The drive as a log with this gyro (n,) rad/s.

        Its reference is the true heading; with ``known`` only the start-up motion, and its
        reference the nominal one.
        """
        rows = slice(0, self.start_up if known else len(self.time))
        gyro = np.zeros((len(self.time), 3))
        gyro[:, 2] = gyro_z
        return Recording.from_arrays(
            name=name,
            time=self.time[rows],
            gyro=gyro[rows],
            accel=self.force[rows],
            ref_heading=(self.nominal if known else self.heading)[rows],
            stationary=self.standing[rows],
        )


def indoor(
    sample_rate: float = 50.0,
    *,
    slip: float = 0.0,
    wander: float = np.radians(0.037),
    wander_time: float = WANDER_TIME,
    seed: int = 0,
) -> Indoor:
    """The drive at ``sample_rate`` Hz.

    ``slip`` is the share by which the start-up motion turns farther than the reference of it says;
    ``wander`` rad/s the RMS of the heading's rate while the robot drives, after the start-up, an
    exponentially correlated one of ``wander_time`` s. ``seed`` draws wander and shaking.
    """
    h, rng = 1.0 / sample_rate, np.random.default_rng(seed)
    cycles = [(t, n) for sense in TURNS for t, n in zip(CYCLE, (0.0, 0.0, sense), strict=True)]
    parts = [*START_UP, *cycles]
    moves = [share != 0.0 for _, share in START_UP] + [False, True, True] * len(TURNS)
    counts = [round(t * sample_rate) for t, _ in parts]
    n, start_up = sum(counts) + 1, sum(counts[: len(START_UP)]) + 1
    turn = np.repeat([TURN_RATE * share for _, share in parts], counts)
    # A Gaussian of a sixth of the ramp ends within it: where it is cut off the robot stands.
    turn = gaussian_filter1d(turn, RAMP / 6 / h, truncate=3.0)
    turn, moving = np.append(0.0, turn), np.append(False, np.repeat(moves, counts))
    standing = ~moving & (turn == 0.0)
    rate = turn * (1.0 + slip * (np.arange(n) < start_up))
    drives = ~standing & (np.arange(n) >= start_up)
    keep = np.exp(-h / wander_time)
    slow = lfilter([np.sqrt(1 - keep**2)], [1.0, -keep], rng.standard_normal(n + 1000))[1000:]
    rate = rate + wander * slow * drives
    shake = SHAKE * rng.standard_normal((n, 3)) * ~standing[:, None]
    return Indoor(
        np.arange(n) * h,
        rate,
        np.cumsum(rate) * h,
        np.cumsum(turn) * h,
        shake + np.array([0.0, 0.0, STANDARD_GRAVITY]),
        standing.astype(float),
        start_up,
    )
