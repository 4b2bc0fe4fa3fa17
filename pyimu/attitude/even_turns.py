"""Whether a log begins at rest or in an even turn about the vertical, as on a turntable.

Such a turn looks like a rest of a gyro with another bias, and no sample of it tells the two apart.
The rest of the log may: each span in which nothing moves has a level of the rate along the
vertical. A table that stops between two turns comes back to the same level, that of its gyro's
bias, while it hardly ever turns twice at the same rate. Most logs begin at rest, and one does whose
first level comes back as often as any other. Where two others come back more often, no gyro tells
which of them is the rest: the bias is off by the root of the mean square of both.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pyimu.attitude.columns import NOMINAL_K
from pyimu.attitude.rest import EvenTurn, Rest
from pyimu.errors import Finding
from pyimu.recording.recording import Recording
from pyimu.recording.rest import still_rows

LEAST = 2.0
"""s; of a span whose level counts, without the second at either end, in which a turn may begin."""

EDGE = 0.5
"""s; left out at either end of a span: a turn that begins shows within it."""

ALIKE, SIGMAS = 5e-4, 3.0
"""rad/s; levels of the same bias differ by less than a flicker of 100 deg/h and, beside it, three
standard deviations of the means' noise and of what the bias walks."""

LEAST_TURN = 2e-3
"""rad/s; a slower turn is not told from a bias: a consumer's gyro that warms by 5 K goes by
0.1 deg/s, and it may be the vertical one alone."""

LOOKED_AT = 600.0
"""s; of a log in which other rests are looked for: in more the bias of a gyro is another."""

SAME_UP = 0.02
"""rad; by which the mean force of a second may be off that of the first where a body turns about
the vertical alone."""

AXIAL = 4.0
"""By which factor the rate along the vertical must differ more than that across it: a bias that
drifts does so about all axes."""


@dataclass(frozen=True)
class Level:
    """The mean ``rate`` (3,) rad/s of a still span, and the instants in s of its ``first`` row and
    its ``last``.
    """

    rate: np.ndarray
    first: float
    last: float


def with_later_rests(rest: Rest, recording: Recording) -> Rest:
    """The rest with the even turn about the vertical that it is by the other rests of the log, of
    its first ``LOOKED_AT`` s and before gravity moves in the body's axes. A column ``stationary``
    or ``speed`` tells better.
    """
    told = getattr(recording, "stationary", None), getattr(recording, "speed", None)
    if not rest.seen or rest.sways or rest.force is None or any(v is not None for v in told):
        return rest
    up, noise = rest.force / np.linalg.norm(rest.force), np.mean(rest.rate_density**2)
    stop = _level_until(recording, up)
    if stop * recording.sample_period < LEAST:
        return rest
    looked_at = recording.slice(None, stop)
    return replace(rest, even=even_turn(looked_at, up, float(noise)))


def _level_until(recording: Recording, up: np.ndarray) -> int:
    """The row before which each second's mean force, where it has one, points to ``up`` (3,)."""
    stop = int(np.searchsorted(recording.time, recording.time[0] + LOOKED_AT))
    second = max(round(1 / recording.sample_period), 1)
    count = stop // second
    rows = recording.accel[: count * second].reshape(count, second, 3)
    means = np.ma.masked_invalid(rows).mean(axis=1).filled(np.nan)
    across = np.linalg.norm(np.cross(means, up), axis=1)
    moved = np.flatnonzero(across > SAME_UP * (means @ up))
    return int(moved[0]) * second if len(moved) else stop


def turn_findings(rest: Rest | None) -> tuple[Finding, ...]:
    """A finding ``even_turn`` where what looks like a rest at the start was a turn, or may be."""
    if rest is None or not rest.even.std:
        return ()
    detail = {"turn": rest.even.turn, "std": rest.even.std}
    return (Finding("even_turn", "gyro", 1, detail),)


def even_turn(recording: Recording, up: np.ndarray, noise: float) -> EvenTurn:
    """What the still spans of a log say of its first; in all of it ``up`` (3,) is the vertical.

    ``noise`` (rad/s)^2 s is the density of the gyro's white noise, the mean of its axes.
    """
    levels = _levels(recording, noise)
    if len(levels) < 2 or levels[0].first > recording.time[0] + EDGE + LEAST:
        return EvenTurn()
    off = np.array([v.rate - levels[0].rate for v in levels])
    spread = np.array([_spread(v, levels[0], noise) for v in levels])
    along, across = off @ up, np.linalg.norm(np.cross(off, up), axis=1)
    along = np.where(np.abs(along) > np.maximum(AXIAL * across, LEAST_TURN), along, 0.0)
    kinds = _kinds(along, spread)
    sizes = np.array([len(k) for k in kinds])
    own = next(i for i, k in enumerate(kinds) if 0 in k)
    others = np.delete(sizes, own)
    if not len(others) or sizes[own] >= others.max():
        return EvenTurn()
    best = np.flatnonzero(sizes == sizes.max())
    if len(best) == 1:
        members = kinds[best[0]]
        scatter = float(np.std(along[members])) / np.sqrt(len(members))
        return EvenTurn(-float(np.mean(along[members])), max(scatter, ALIKE))
    middles = np.array([np.mean(along[kinds[i]]) for i in best])
    return EvenTurn(0.0, float(np.sqrt(np.mean(middles**2))))


def _levels(recording: Recording, noise: float) -> list[Level]:
    """The levels of the still spans of a log, in time."""
    edge, found = round(EDGE / recording.sample_period), []
    for a, b in still_rows(recording):
        rows = slice(a + edge, b - edge)
        rate = recording.gyro[rows]
        if len(rate) * recording.sample_period < LEAST:
            continue
        if not np.isfinite(rate).any(axis=0).all():
            continue
        if not _is_even(rate, max(round(1 / recording.sample_period), 1), noise):
            continue
        ends = recording.time[rows][[0, -1]]
        found.append(Level(np.nanmean(rate, axis=0), *map(float, ends)))
    return found


def _is_even(rate: np.ndarray, second: int, noise: float) -> bool:
    """Whether the means of the seconds of a ``rate`` (n, 3), each of so many samples, scatter no
    more than ``noise`` and ``ALIKE`` make them.
    """
    means = np.nanmean(rate[: len(rate) // second * second].reshape(-1, second, 3), axis=1)
    return bool(np.all(np.var(means, axis=0) <= SIGMAS * noise + ALIKE**2))


def _spread(level: Level, first: Level, noise: float) -> float:
    """rad/s; by how much a level may differ from the ``first`` where the body rests in both."""
    white = noise * sum(1 / (v.last - v.first) for v in (level, first))
    walked = NOMINAL_K**2 * abs(level.last - first.first)
    return ALIKE + SIGMAS * float(np.sqrt(white + walked))


def _kinds(along: np.ndarray, spread: np.ndarray) -> list[list[int]]:
    """Which of the levels (n,) are the same, each within the ``spread`` (n,) of its neighbour."""
    order = np.argsort(along)
    kinds = [[int(order[0])]]
    for before, i in zip(order[:-1], order[1:], strict=True):
        if along[i] - along[before] <= max(spread[i], spread[before]):
            kinds[-1].append(int(i))
        else:
            kinds.append([int(i)])
    return kinds
