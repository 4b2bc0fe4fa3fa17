"""The true motion of a campaign's drives: made once for each ground, kept in the process."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.rover.trajectory import Manoeuvre, ackermann, drive, stop, straight, turn_on_spot

BEFORE = 60.0
"""s that a rover stands before it drives; what the filter is of its start is not scored."""

AFTER = 5.0
"""s that it stands behind its drive."""

SOL = "sol"

SOL_DURATION = 88775.0
"""s; a mean solar day of Mars, 24.6 h (Hidalgo 2012, section 7; Allison and McEwen 2000: 88775.244
s)."""

MORNING = 10 * 3600.0
"""s from local midnight, where a sol begins here, until the rover drives."""

LEGS = 20
"""Straight lines of 5 m in a sol: 100 m, in the "2-4 h traveling" of Hidalgo 2012, section 7."""

TURNS = np.deg2rad([45.0, -60.0, 30.0, -45.0, 60.0, -30.0])
"""rad by which it turns on the spot between them, one after the other and again."""

LATITUDE = np.deg2rad(52.22)
"""rad; Noordwijk, where the paper's rover drove."""

KEPT = 6
"""Motions that a process keeps."""


def _sol() -> list[Manoeuvre]:
    """A sol: the night, the morning, 100 m in legs with turns between them, and the evening."""
    parts = [stop(MORNING)]
    for i in range(LEGS):
        angle = TURNS[i % len(TURNS)]
        turn = Manoeuvre("turn", abs(angle) / 0.02, turn=np.sign(angle) * 0.02)
        parts += [turn, stop(10.0), *straight(), stop(10.0)]
    driven = sum(m.duration for m in parts)
    return [*parts, stop(SOL_DURATION - driven)]


def _short(manoeuvres: Callable[[], Sequence[Manoeuvre]]) -> Callable[[], list[Manoeuvre]]:
    return lambda: [stop(BEFORE), *manoeuvres(), stop(AFTER)]


DRIVES: dict[str, Callable[[], list[Manoeuvre]]] = {
    "turn-on-spot": _short(turn_on_spot),
    "straight": _short(straight),
    "ackermann": _short(ackermann),
    SOL: _sol,
}
"""The drives of a campaign: those of Hidalgo 2012, section 6.1, and a sol."""


@dataclass(frozen=True)
class Truth:
    """True motion: of n samples of the sensors what they measure, of m of the filter the attitude.

    ``rate`` rad/s and ``force`` m/s^2 (n, 3); every ``every``-th sample is one of the filter:
    ``q`` (m, 4), ``euler`` (m, 3) rad roll, pitch, yaw, ``standing`` (m,). ``first`` is the
    filter's sample with which the drive begins, ``period`` s that of the sensors.
    """

    rate: np.ndarray
    force: np.ndarray
    q: np.ndarray
    euler: np.ndarray
    standing: np.ndarray
    first: int
    every: int
    period: float

    @property
    def time(self) -> np.ndarray:
        """s (m,) of the filter's samples."""
        return np.arange(1, len(self.q) + 1) * self.every * self.period


@lru_cache(maxsize=KEPT)
def truth(name: str, ground: int, rate: float, every: int) -> Truth:
    """The drive ``name`` over the ``ground`` of that number, at ``rate`` Hz."""
    motion = drive(DRIVES[name](), rate, LATITUDE, ground)
    rows = slice(every - 1, len(motion.time) // every * every, every)
    attitude = Rotation.from_quat(motion.q[rows], scalar_first=True)
    standing = motion.standing[rows]
    return Truth(
        motion.rate,
        motion.force,
        motion.q[rows],
        attitude.as_euler("ZYX")[:, ::-1].copy(),
        standing,
        int(np.argmax(standing == 0)),
        every,
        1.0 / rate,
    )
