"""Which of the stretches that look still are driven at a constant speed.

No inertial sensor tells one from a rest within the stretch. What lies between two of them does:
the force there, less that of both ends, is the change of the velocity. Of all choices of rests and
drives that is the one in which most rests have none left: a speed that comes up after a rest and
goes before the next one was driven in between, and one that a log begins with, too. Where the force
is another than that of the stretches beside it, turned as the gyro says, it is pushed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from pyimu.ins.between import BESIDE, Change, change_of_velocity
from pyimu.ins.detector import WINDOW
from pyimu.ins.noise import Noise
from pyimu.ins.pushes import FORCE_STAYS, STEADY_GATE
from pyimu.ins.short_rests import SWUNG
from pyimu.ins.shoves import SETTLES
from pyimu.numerics.laws import chi2
from pyimu.recording.clock import runs

BETWEEN = 300.0
"""s; of what lies between two stretches: after more nothing is known of a change of velocity."""

MISSING = 0.01
"""Share of the samples between them that may be missing."""

MOST_STRETCHES = 30
"""So many stretches may follow each other until the speed has gone again."""

MOST_PUSHED = 10
"""So many that follow each other may be pushed."""

RETURNED = 0.5
"""Of the speeds in between: the least that must have gone where a stretch is called a rest."""

UNLIKELY = float(np.log(1e-6))
"""Log of how likely it is that a change of the velocity is off beyond its errors. Assumed."""

DRIVES_AT_FIRST = PUSHED = float(np.log(0.05))
"""That a log whose start looks still begins with a drive, and that what is shorter than ``LONG`` is
pushed; of what is longer, less by its length, as few pushes are even for long. Assumed."""

REST = float(np.log(2.0))
"""Log of how likely a rest is beside a drive where nothing tells; of what is shorter than ``LONG``,
less by its length. Assumed."""

DRIFTS = 0.2
"""Of a speed, by which it may change while it looks constant. Assumed."""

TURNS = 2 * SWUNG
"""rad/s; beside faster turns the gyro's gains and limits are no small errors."""

ONE_MORE = 10.0
"""Log of how much likelier a choice may be beside which another is possible: that of one rest more,
as a log has that begins and ends at rest."""

UNSURE = float(chi2.isf(1e-3, 3))
"""Square of a speed over its variance that is left at a rest by chance in one of a thousand."""

TURNED = 0.1
"""rad; a body that has turned by more and has the velocity that it had, has none."""

APART, LONG = 2 * WINDOW, 2.0
"""s; stretches that are nearer to each other than the first are one that a window parted by chance,
as it does in a gentle push. A push is seldom even for more than the second, and a rest shorter."""


@dataclass(frozen=True)
class _Stretch:
    """Rows ``start`` to ``stop`` that look still, the mean ``rate`` and ``force`` (3,) there, and
    whether it is known that it ``moves``.
    """

    start: int
    stop: int
    rate: np.ndarray
    force: np.ndarray
    moves: bool = False

    @classmethod
    def of(
        cls, gyro: np.ndarray, accel: np.ndarray, start: int, stop: int, moves: bool = False
    ) -> _Stretch:
        means = (values[start:stop].mean(axis=0) for values in (gyro, accel))
        return cls(start, stop, *means, moves)

    @property
    def rows(self) -> int:
        return self.stop - self.start


@dataclass(frozen=True)
class _Since:
    """What is known of the velocity at a stretch since the last rest: ``velocity`` (3,) m/s in axes
    of that rest, its ``variance``, the matrix ``turn`` (3, 3) to these axes, the log of how likely
    what lies in between is, its ``score``, and whether the body has ``moved``. Where it has not
    since the stretch before, it rests or drives as it did there, and another choice is unlikely by
    the log ``tied``; the ``first`` follows the rest itself.
    """

    velocity: np.ndarray
    variance: float
    turn: np.ndarray
    score: float
    moved: bool = False
    tied: float = 0.0
    first: bool = False

    def then(self, change: Change, drift: float, score: float, top: float, first: bool) -> _Since:
        """After a change of so much ``score``, with a ``drift`` m/s during the stretch before it,
        of a body of up to ``top`` m/s.
        """
        moves = change.most**2 > SETTLES**2 + UNSURE * change.variance
        moves = bool(moves) or change.angle > TURNED
        as_before = 0.0 if moves else max(_beside_drives(change.velocity, change.variance, top), 0)
        return _Since(
            self.velocity + self.turn @ change.velocity,
            self.variance + drift**2 + change.variance,
            self.turn @ change.turn,
            self.score + score + min(max((3 - change.apart) / 2, UNLIKELY), 0.0),
            self.moved or moves,
            as_before,
            first,
        )

    @property
    def most_drift(self) -> float:
        """m/s; by which a speed may change within a stretch: no drive goes on as evenly."""
        return (SETTLES + DRIFTS * float(np.linalg.norm(self.velocity))) / 3

    def rests(self, top: float) -> float:
        """Log of how likely a rest is, with that velocity left, beside a drive of up to ``top``
        m/s. Where the body has not moved it rests or drives as it did before.
        """
        score = self.score - (0.0 if self.first else self.tied)
        if not self.moved:
            return score
        return score + max(_beside_drives(self.velocity, self.variance, top), UNLIKELY)

    @property
    def drives(self) -> float:
        """Log of how likely a drive is, likewise."""
        return -self.tied if self.first else 0.0

    @property
    def off(self) -> float:
        """Square of the velocity that is left over its variance."""
        return _off(self.velocity, self.variance)


def _off(velocity: np.ndarray, variance: float) -> float:
    """Square of a velocity (3,) m/s that is left over its variance."""
    return float(velocity @ velocity) / _spread(variance)


def _spread(variance: float) -> float:
    return variance + (SETTLES / 3) ** 2


def _beside_drives(velocity: np.ndarray, variance: float, top: float) -> float:
    """Log of how likely a velocity (3,) m/s of such a variance is of a rest, beside a drive of up
    to ``top`` m/s: normally distributed with the variance of what is anywhere within that.
    """
    own = top**2 / 5
    share = own / (own + _spread(variance))
    return -1.5 * float(np.log1p(-share)) - share * _off(velocity, variance) / 2


def driven(
    time: np.ndarray,
    gyro: np.ndarray,
    accel: np.ndarray,
    still: np.ndarray,
    noise: Noise,
    period: float,
    moves: np.ndarray | None = None,
    told: dict[tuple[int, ...], Change | None] | None = None,
) -> tuple[list[tuple[int, int]], int, list[int]]:
    """The stretches (start, stop) of ``still`` (n,) that are driven at a constant speed; how many
    may as well be the rests: where a body drives at one speed again and again, only the start of a
    log tells that from its rests; and the first rows of the rests that are unsure, as a speed seems
    to be left since the one before.

    ``gyro`` rad/s and ``accel`` m/s^2 are (n, 3), ``period`` is in s. Rows that ``moves`` (n,)
    marks are known to be no rest, and are not among them. What is ``told`` of the change of the
    velocity between two stretches, by their rows, is kept for a second call.
    """
    known = np.zeros(len(still), dtype=bool) if moves is None else moves & still
    parts = [(*run, own) for own in (False, True) for run in runs(still & (known == own))]
    stretches = [_Stretch.of(gyro, accel, *part) for part in sorted(parts)]
    told, changes = {} if told is None else told, {}
    for i, one in enumerate(stretches):
        for k, other in enumerate(stretches[i + 1 : i + 1 + MOST_PUSHED], i + 1):
            rows = one.start, one.stop, other.start, other.stop
            if rows not in told:
                told[rows] = _change(time, gyro, accel, (one, other), noise, period)
            if (found := told[rows]) is not None:
                changes[i, k] = found
    if not stretches:
        return [], 0, []
    rests, best = _rests_of(stretches, changes, period)
    drives = [s for k, s in enumerate(stretches) if k not in rests and not s.moves]
    without = [replace(s, moves=s.moves or k in rests) for k, s in enumerate(stretches)]
    others, score = _rests_of(without, changes, period)
    doubt = len(others) > 1 and score - DRIVES_AT_FIRST > max(best - ONE_MORE, 0.0)
    unsure = [stretches[k].start for k in _unsure(rests, stretches, changes, period)]
    return [(s.start, s.stop) for s in drives], len(others) if doubt else 0, unsure


def _unsure(
    rests: set[int],
    stretches: list[_Stretch],
    changes: dict[tuple[int, int], Change],
    period: float,
) -> Iterator[int]:
    """Which of the rests have a speed left since the one before, beyond ``UNSURE``."""
    for last, k in pairwise(sorted(rests)):
        since = _since(last, stretches[: k + 1], changes, period, SETTLES)
        if k in since and since[k].moved and since[k].off > UNSURE:
            yield k


def _rests_of(
    stretches: list[_Stretch], changes: dict[tuple[int, int], Change], period: float
) -> tuple[set[int], float]:
    """Which stretches are rests in the likeliest of all choices, by dynamic programming over the
    rests, and the log of how likely it is.
    """
    speeds = [c.speed for c in changes.values()]
    # Of a change that is hardly known the speed is mostly error.
    known = [c.speed for c in changes.values() if c.speed**2 > (STEADY_GATE + 3) * c.variance]
    top = max(known or speeds, default=SETTLES)
    best = [(score, -1) for score in _at_first(stretches, changes, period)]
    # Where a rest that the body has not left since begins: small steps of its force add up.
    stays = list(range(len(stretches)))
    # Behind the last stretch that a rest tells of, it says the same of all.
    ends, behind = [], [(-np.inf, -1)] * (len(stretches) + 1)
    for at in range(len(stretches)):
        behind[at] = max(behind[at], behind[at - 1]) if at else behind[at]
        best[at] = (-np.inf, -1) if stretches[at].moves else max(best[at], behind[at])
        since = _since(at, stretches, changes, period, top)
        last = max(since)
        ends.append(best[at][0] + since[last].score)
        behind[last + 1] = max(behind[last + 1], (ends[at] + REST, at))
        for k in range(at + 1, last + 1):
            unmoved = k in since and not since[k].moved
            score = since[k].rests(top) if k in since else UNLIKELY
            if unmoved and _is_pushed(changes.get((stays[at], k))):
                score = UNLIKELY
            short = float(np.log(min(stretches[k].rows * period / LONG, 1.0)))
            way = best[at][0] + max(score, UNLIKELY) + REST + short, at
            if way > best[k]:
                best[k], stays[k] = way, stays[at] if unmoved else k
    at = int(np.argmax(ends)) if np.isfinite(ends).any() else -1
    found, score = set(), max(ends)
    while at >= 0:
        found.add(at)
        at = best[at][1]
    return found, score


def _is_pushed(change: Change | None) -> bool:
    """Whether the forces of both ends of a change are too far apart for chance."""
    return change is not None and change.apart > STEADY_GATE + 3


def _since(
    at: int,
    stretches: list[_Stretch],
    changes: dict[tuple[int, int], Change],
    period: float,
    top: float,
    rested: bool = True,
) -> dict[int, _Since]:
    """What is known of the velocity at each stretch after the rest ``at``, or a drive where it is
    not ``rested``, as long as something is, by the likeliest choice of what is pushed in between.
    ``SETTLES`` and ``FORCE_STAYS`` are limits, and count as three standard deviations.
    """
    found = {at: _Since(np.zeros(3), 0.0, np.eye(3), 0.0)}
    for k in range(at + 1, min(at + MOST_STRETCHES, len(stretches))):
        ways = []
        for i in range(k - 1, max(at, k - MOST_PUSHED) - 1, -1):
            if i in found and (i, k) in changes:
                seconds = stretches[i].rows * period if i > at else 0.0
                drift = min(FORCE_STAYS / 3 * seconds, found[i].most_drift)
                score = _pushed(stretches[i + 1 : k], period) + found[i].drives
                ways.append(found[i].then(changes[i, k], drift, score, top, i == at and rested))
        if ways:
            found[k] = max(ways, key=lambda way: way.score)
    return found


def _at_first(
    stretches: list[_Stretch], changes: dict[tuple[int, int], Change], period: float
) -> Iterator[float]:
    """Log of how likely it is that all that lies before each stretch is driven or pushed."""
    since = _since(0, stretches, changes, period, SETTLES, rested=False)
    yield 0.0
    for at in range(1, len(stretches)):
        driven = since[at].score if at in since else UNLIKELY
        yield DRIVES_AT_FIRST + max(driven, _pushed(stretches[:at], period))


def _pushed(stretches: list[_Stretch], period: float) -> float:
    """Log of how likely it is that all of these are pushed: one push may be several of them."""
    if not stretches:
        return 0.0
    return PUSHED + float(np.log(min(LONG / max(s.rows * period for s in stretches), 1.0)))


def _change(
    time: np.ndarray,
    gyro: np.ndarray,
    accel: np.ndarray,
    ends: tuple[_Stretch, _Stretch],
    noise: Noise,
    period: float,
) -> Change | None:
    """The change of the velocity between two stretches; None where nothing is known of it: samples
    are missing, or the body swings.
    """
    rows = slice(ends[0].stop, ends[1].start)
    seconds = float(time[rows.stop] - time[rows.start - 1])
    whole = (rows.stop - rows.start + 1) * period
    known = whole > period and np.isfinite(gyro[rows]).all() and np.isfinite(accel[rows]).all()
    if not known or not seconds < min(BETWEEN, (1 + MISSING) * whole + period / 2):
        return None
    if np.linalg.norm(gyro[rows] - ends[0].rate, axis=1).max() > TURNS:
        return None
    near = round(BESIDE / period)
    rates = gyro[max(ends[0].start, rows.start - near) : rows.start], gyro[rows.stop :]
    beside = rates[0].mean(axis=0), rates[1][: min(ends[1].rows, near)].mean(axis=0)
    moments = replace(ends[0], rate=beside[0]), replace(ends[1], rate=beside[1])
    return change_of_velocity(gyro[rows], accel[rows], moments, noise, period)
