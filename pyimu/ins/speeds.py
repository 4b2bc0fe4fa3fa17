"""Which of the stretches that look still are driven at a constant speed.

No inertial sensor tells one from a rest within the stretch. What lies between two of them does:
the force there, less that of both ends, is the change of the velocity. A stretch to which a speed
came after a rest, and from which it went again before the next, is no rest: two changes that cancel
are neither noise nor a fault of the sensor. Of a change that nothing takes back, the filter judges.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.ins.detector import FORCE_STAYS, FORCE_TURNED, STEADY_GATE, WINDOW, Noise, way_of
from pyimu.laws import chi2
from pyimu.recording.clock import runs
from pyimu.units import STANDARD_GRAVITY

LEAST_SPEED = 0.03
"""m/s; a body that settles after a stop shows less. Assumed."""

LONGEST = 60.0
"""s; of what lies between two stretches: after more nothing is known of a change of velocity."""

MOST_STRETCHES = 12
"""So many stretches may follow each other until the speed has gone again."""

RETURNED = 0.5
"""Of the speeds in between: the least that must have gone where a stretch is called a rest."""

NONE = float(chi2.isf(1e-3, 3))
"""Square of a speed over its variance, up to which it is none by chance: of two changes that are
known to their errors more than half of the first may be left, and one that is lost in its errors
comes to light by the next."""

APART, LONG = 2 * WINDOW, 2.0
"""s; stretches that are nearer to each other than the first are one that a window parted by chance,
as it does in a gentle push. What is shorter than the second may then be pushed all along, as it is
where its force is another than that of a longer one beside it: its force is not that of a rest."""


@dataclass(frozen=True)
class _Stretch:
    """Rows ``start`` to ``stop`` that look still, the mean ``rate`` and ``force`` (3,) there."""

    start: int
    stop: int
    rate: np.ndarray
    force: np.ndarray

    @property
    def rows(self) -> int:
        return self.stop - self.start


@dataclass(frozen=True)
class _Change:
    """Of the velocity between two stretches, m/s in body axes of the first: after each of the rows
    between them (n, 3), with the ``variance`` of each axis, and the ``turn`` from the second's axes
    to the first's.
    """

    rows: slice
    velocity: np.ndarray
    variance: float
    turn: Rotation

    @property
    def moves(self) -> bool:
        """Whether the velocity is another at the end."""
        return _is_speed(self.velocity[-1], self.variance)


@dataclass(frozen=True)
class _Leg:
    """A change, and the ``velocity`` (3,) m/s and ``variance`` with which it begins, in axes to
    which ``turn`` brings its own.
    """

    change: _Change
    velocity: np.ndarray
    variance: float
    turn: Rotation

    def at(self, row: int) -> tuple[np.ndarray, float]:
        """Velocity (3,) and variance after a row."""
        own = self.change.velocity[row - self.change.rows.start]
        return self.velocity + self.turn.apply(own), self.variance + self.change.variance

    def moves(self, row: int) -> bool:
        return _is_speed(*self.at(row))


def _is_speed(velocity: np.ndarray, variance: float) -> bool:
    """Whether a velocity (3,) of that variance of each axis is none of a body at rest."""
    return bool(velocity @ velocity > LEAST_SPEED**2 + (STEADY_GATE + 3) * variance)


def driven(
    time: np.ndarray,
    gyro: np.ndarray,
    accel: np.ndarray,
    still: np.ndarray,
    noise: Noise,
    period: float,
) -> list[tuple[int, int]]:
    """The stretches (start, stop) of ``still`` (n,) that are driven at a constant speed.

    The first is a rest. ``gyro`` rad/s and ``accel`` m/s^2 are (n, 3), ``period`` is in s.
    """
    every = [
        _Stretch(a, b, gyro[a:b].mean(axis=0), accel[a:b].mean(axis=0)) for a, b in runs(still)
    ]
    inside = [
        _is_inside(k, every, period)
        or any(_differs(gyro, every[k], other, noise, period) for other in _beside(k, every))
        for k in range(len(every))
    ]
    stretches = [s for s, within in zip(every, inside, strict=True) if not within]
    short = [s for s, within in zip(every, inside, strict=True) if within]

    def change(k: int) -> _Change:
        return _change(time, gyro, accel, (stretches[k], stretches[k + 1]), noise, period)

    out, at = [], 0
    while at < len(stretches) - 1:
        after, legs = _next_rest(stretches, at, change, period)
        out += [(s.start, s.stop) for s in stretches[at + 1 : after]]
        for leg in legs:
            rows = leg.change.rows
            own = [s for s in short if rows.start <= s.start and s.stop <= rows.stop]
            out += [(s.start, s.stop) for s in own if leg.moves((s.start + s.stop) // 2)]
        at = after
    return sorted(out)


def _beside(k: int, every: list[_Stretch]) -> list[_Stretch]:
    """The stretches before and after the one of that number."""
    return every[max(k - 1, 0) : k] + every[k + 1 : k + 2]


def _is_inside(k: int, every: list[_Stretch], period: float) -> bool:
    """Whether a stretch is short and so near to another that the two are one."""
    own = every[k]
    gaps = [max(s.start - own.stop, own.start - s.stop) for s in _beside(k, every)]
    return own.rows * period < LONG and min(gaps, default=np.inf) * period < APART


def _differs(gyro: np.ndarray, own: _Stretch, other: _Stretch, noise: Noise, period: float) -> bool:
    """Whether a short stretch beside a long one has another force: it is pushed."""
    if own.rows * period >= LONG or other.rows * period < LONG:
        return False
    between = slice(min(own.stop, other.stop), max(own.start, other.start))
    way = way_of(gyro[between] - other.rate, max(1, round(WINDOW / period)), period)
    white = float(np.mean(noise.force**2)) * (1 / own.rows + 1 / other.rows)
    off = float(np.sum((own.force - other.force) ** 2))
    return off > (STEADY_GATE + 3) * (FORCE_STAYS**2 + white + (FORCE_TURNED * way) ** 2)


def _next_rest(
    stretches: list[_Stretch], at: int, change: Callable[[int], _Change], period: float
) -> tuple[int, list[_Leg]]:
    """Which stretch is the next rest after that ``at``, one behind the last where none is, and the
    legs until then. A speed that may be one by chance is one where the next change takes it back.
    """
    velocity, variance, turn = np.zeros(3), 0.0, Rotation.identity()
    speeds, legs, last = [], [], len(stretches) - 1
    moves = perhaps = False
    for k in range(at, min(at + MOST_STRETCHES, last)):
        if k > at:
            variance += (FORCE_STAYS * stretches[k].rows * period) ** 2
        leg = _Leg(change(k), velocity, variance, turn)
        if not np.isfinite(leg.change.variance):
            break
        legs.append(leg)
        end = leg.change.rows.stop - 1
        (velocity, variance), turn = leg.at(end), turn * leg.change.turn
        speed = float(np.linalg.norm(velocity))
        back = moves and leg.change.moves and speed**2 <= NONE * variance
        moves = leg.moves(end)
        if k == at and not moves:
            perhaps = at + 1 < last and speed**2 > LEAST_SPEED**2 + NONE * variance
            if not perhaps:
                break
        elif not moves and (speed < RETURNED * min(speeds) or back):
            return k + 1, legs
        elif perhaps:
            break
        if moves and at + 1 == last:
            return last + 1, legs
        speeds.append(speed)
    return at + 1, legs[:1]


def _change(
    time: np.ndarray,
    gyro: np.ndarray,
    accel: np.ndarray,
    ends: tuple[_Stretch, _Stretch],
    noise: Noise,
    period: float,
) -> _Change:
    """The change of the velocity between two stretches.

    Gravity there goes from what the first shows to what the second does, evenly: what the gyro's
    errors tip is known at both ends, and its noise leaves g^2 N^2 T^3 / 12 of the integral. Of what
    the accelerometer's errors do in between, half counts for that reason.
    """
    first, second = ends
    rows = slice(first.stop, second.start)
    seconds = float(time[second.start] - time[first.stop - 1])
    n = rows.stop - rows.start
    if not seconds < min(LONGEST, 2 * (n + 1) * period):
        return _Change(rows, np.zeros((n, 3)), np.inf, Rotation.identity())
    rates = gyro[rows] - (first.rate + second.rate) / 2
    way = way_of(rates, max(1, round(WINDOW / period)), period)
    if not np.isfinite(way) or not np.isfinite(accel[rows]).all():
        return _Change(rows, np.zeros((n, 3)), np.inf, Rotation.identity())
    turns = _turns(rates * period)
    share = ((np.arange(n) + 0.5) / n)[:, None]
    weight = (1 - share) * first.force + share * turns[-1].apply(second.force)
    velocity = np.cumsum(turns.apply(accel[rows]) - weight, axis=0) * period
    white = float(np.mean(noise.force**2))
    tipped = STANDARD_GRAVITY**2 * float(np.mean(noise.rate**2)) * period * seconds**3 / 12
    unknown = (FORCE_STAYS**2 + (FORCE_TURNED * way) ** 2) * (seconds / 2) ** 2
    of_ends = white * seconds**2 * (1 / first.rows + 1 / second.rows) / 3
    variance = white * period * seconds + of_ends + tipped + unknown
    return _Change(rows, velocity, variance, turns[-1])


def _turns(steps: np.ndarray) -> Rotation:
    """The turns (n,) up to each of the rotation vectors (n, 3) rad that follow each other."""
    turns, by = Rotation.from_rotvec(steps), 1
    while by < len(turns):
        turns = Rotation.concatenate([turns[:by], turns[:-by] * turns[by:]])
        by *= 2
    return turns
