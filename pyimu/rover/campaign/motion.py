"""The true motion of a campaign's drives: made once for each ground, kept in the process."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from pyimu.plant.bodies import BODIES
from pyimu.plant.rover_variables import CRUISE_SPEED, LATITUDE, SPOT_TURN_RATE
from pyimu.rover.drives import drive, free_drive

BEFORE = 60.0
"""s that a rover stands before it drives; what the filter is of its start is not scored."""

AFTER = 5.0
"""s that it stands behind its drive."""

SOL = "sol"

SOL_DURATION = BODIES["Mars"].solar_day
"""s of a sol, 24.6 h."""

MORNING = 10 * 3600.0
"""s from local midnight, where a sol begins here, until the rover drives."""

LEGS, LEG, PAUSE = 20, 5.0, 10.0
"""A sol's drive: so many straight lines of so many m, a turn on the spot before each, with rests of
so many s: 100 m, in the "2-4 h traveling" of Hidalgo 2012, section 7,
with the speeds of section 6.1."""

TURNS = np.deg2rad([45.0, -60.0, 30.0, -45.0, 60.0, -30.0])
"""rad by which it turns, one after the other and again: no way leads straight on among rocks."""

TEST_DRIVES = {
    "turn-on-spot": "turn_on_spot",
    "straight": "straight",
    "obstacle": "obstacle",
    "ackermann": "ackermann",
}
"""The test drives of Hidalgo 2012, section 6.1, and their names in ``RoverDrive``."""

DRIVES = (*TEST_DRIVES, SOL)

KEPT = 6
"""Motions that a process keeps."""


@dataclass(frozen=True)
class Truth:
    """True motion: of n samples of the sensors what they measure, of m of the filter the attitude.

    ``rate`` rad/s and ``force`` m/s^2 (n, 3); every ``every``-th sample is one of the filter:
    ``q`` (m, 4), ``euler`` (m, 3) rad roll, pitch, yaw, ``standing`` (m,). With the filter's sample
    ``first`` the drive begins; ``period`` is that of the sensors in s, ``latitude`` in rad.
    """

    rate: np.ndarray
    force: np.ndarray
    q: np.ndarray
    euler: np.ndarray
    standing: np.ndarray
    first: int
    every: int
    period: float
    latitude: float

    @property
    def time(self) -> np.ndarray:
        """s (m,) of the filter's samples."""
        return np.arange(1, len(self.q) + 1) * self.every * self.period


def sol_commands() -> np.ndarray:
    """The commands (k, 3) of a sol: time s, speed m/s, turn rate rad/s."""
    rows, time = [], MORNING
    for i in range(LEGS):
        angle = TURNS[i % len(TURNS)]
        for duration, speed, turn_rate in (
            (abs(angle) / SPOT_TURN_RATE, 0.0, np.sign(angle) * SPOT_TURN_RATE),
            (PAUSE, 0.0, 0.0),
            (LEG / CRUISE_SPEED, CRUISE_SPEED, 0.0),
            (PAUSE, 0.0, 0.0),
        ):
            rows.append((time, speed, turn_rate))
            time += duration
    return np.array([*rows, (time, 0.0, 0.0)])


@lru_cache(maxsize=KEPT)
def truth(name: str, ground: int, rate: float, every: int, body: str) -> Truth:
    """The drive ``name`` over the ground of that number on a ``body``, at ``rate`` Hz."""
    if name == SOL:
        commands = sol_commands()
        rest = SOL_DURATION - commands[-1, 0]
        motion = free_drive(commands, sample_rate=rate, body=body, rest=rest, terrain=ground)
    else:
        given = {"terrain": ground, "start_time": BEFORE}
        motion = drive(TEST_DRIVES[name], sample_rate=rate, body=body, rest=AFTER, **given)
    rows = slice(every - 1, len(motion.time) // every * every, every)
    standing = motion.standing[rows].copy()
    return Truth(
        motion.rate.copy(),
        motion.specific_force.copy(),
        motion.q[rows].copy(),
        np.column_stack([motion.roll, motion.pitch, motion.yaw])[rows],
        standing,
        int(np.argmax(standing == 0)),
        every,
        1.0 / rate,
        LATITUDE,
    )
