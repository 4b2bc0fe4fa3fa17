"""Where a body that looks still is pushed: so gently that no window of its samples shows it.

A stretch that looks still is parted into pieces over which the force stays or changes evenly: a
constant or a line on each axis, beside white noise. Of all partings that is taken which is
likeliest where each mean and each slope has its price (Jackson et al. 2005, An algorithm for
optimal partitioning of data on an interval). What stays is at rest, at a constant speed or in an
even push; that it does not tell.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from pyimu.numerics.laws import chi2

STEADY_GATE = 25.0
"""Squared difference of mean rate and bias over its variance, beyond which a still window is one of
a steady turn, and of mean force and that of the rest before, beyond which it is one of a steady
push."""

FORCE_STAYS, FOLLOWED = 0.005, 30.0
"""m/s^2, s; by how much the mean force of a body that rests may change, three standard deviations,
and the time over which it is the mean before: over minutes a temperature may change it more."""

MOMENT, SETTLED = 1.5, 10.0
"""s; for less the force of a body that drives may be that at rest, between speeding up and slowing
down, and for longer it has no other one."""

LEAST_SPEED, COMES_UP = 0.03, 5.0
"""m/s; a body that settles after a stop shows less. Assumed. And s, over which it may come up."""

SLOPE = float(chi2.isf(1e-3, 3))
"""Twice the log of how much likelier than a mean a line must be; that of a rest is so once in a
thousand. Another mean must be so by ``STEADY_GATE``, as it may begin anywhere."""

LEAST = 2 * MOMENT
"""s; of what stays at a force, at least, between two pushes. Assumed."""


@dataclass(frozen=True)
class _Piece:
    """Blocks ``start`` to ``stop`` of a stretch, their ``mean`` (3,) m/s^2 and whether it stays."""

    start: int
    stop: int
    mean: np.ndarray
    stays: bool


def unpushed(force: np.ndarray, noise: np.ndarray, rows: int, period: float) -> np.ndarray:
    """Marks (n,) of a still stretch, less where its ``force`` (n, 3) m/s^2 of so much ``noise``
    (3,) changes from one mean to another, as blocks of half of ``rows`` show it. Each run of them
    stays at one force.
    """
    block = max(1, rows // 2)
    means, bounds = _means(force, block)
    spread = noise**2 / block + (FORCE_STAYS / 3) ** 2
    marks = np.zeros(len(force), dtype=bool)
    for piece in _joined(_pieces(means, spread, FOLLOWED / (block * period)), spread):
        # A push begins and ends within the blocks beside it.
        first = bounds[piece.start + (piece.start > 0)]
        last = bounds[piece.stop - (piece.stop < len(means))]
        at_end = piece.start == 0 or piece.stop == len(means)
        if piece.stays and last > first and (at_end or (last - first) * period >= LEAST):
            marks[first:last] = True
            own = force[first:last]
            marks[first : first + _gained(own[::-1], noise, period)] = False
            marks[last - _gained(own, noise, period) : last] = False
    return marks


def _gained(force: np.ndarray, noise: np.ndarray, period: float) -> int:
    """How many of the last forces (n, 3), less those before them, gain a speed."""
    count = min(len(force) // 2, round(COMES_UP / period))
    if count < 1:
        return 0
    before = force[-count - round(SETTLED / period) : -count]
    speed = np.cumsum(force[-count:] - before.mean(axis=0), axis=0) * period
    of_noise = float(np.mean(noise**2)) * period**2 * count * (1 + count / len(before))
    least = np.sqrt(LEAST_SPEED**2 + (STEADY_GATE + 3) * of_noise)
    size = np.linalg.norm(speed, axis=1)
    if size[-1] <= least:
        return 0
    return count - int(np.flatnonzero(np.append(0.0, size) <= least / 2)[-1])


def _means(force: np.ndarray, block: int) -> tuple[np.ndarray, np.ndarray]:
    """Means (m, 3) of forces (n, 3) over blocks, the last with what is left, and their first rows
    and n (m + 1,).
    """
    bounds = block * np.arange(max(1, len(force) // block) + 1)
    bounds[-1] = len(force)
    return np.add.reduceat(force, bounds[:-1], axis=0) / np.diff(bounds)[:, None], bounds


def _pieces(means: np.ndarray, spread: np.ndarray, longest: float) -> list[_Piece]:
    """The likeliest pieces, of so many at the ``longest``, of means (m, 3) whose noise has the
    variance ``spread`` (3,). A line that changes by less than ``FORCE_STAYS`` stays.
    """
    scaled = (means - means.mean(axis=0)) / np.sqrt(spread)
    begins, slopes = _parted(scaled, max(3, round(longest)), STEADY_GATE, SLOPE)
    pieces, stop = [], len(means)
    while stop > 0:
        start = int(begins[stop])
        change = slopes[stop] * np.sqrt(spread) * (stop - start)
        stays = float(np.linalg.norm(change)) <= FORCE_STAYS
        pieces.append(_Piece(start, stop, means[start:stop].mean(axis=0), stays))
        stop = start
    return pieces[::-1]


@njit(cache=True)
def _parted(
    values: np.ndarray, longest: int, gate: float, slope: float
) -> tuple[np.ndarray, np.ndarray]:
    """For each count of the first values (m, 3), of unit variance, where the last piece of their
    likeliest parting begins (m + 1,) and its slope on each axis (m + 1, 3), 0 where it stays.
    """
    n, axes = values.shape
    best, begins, slopes = np.zeros(n + 1), np.zeros(n + 1, dtype=np.int64), np.zeros((n + 1, axes))
    for stop in range(1, n + 1):
        best[stop] = np.inf
        total, moment, square = np.zeros(axes), np.zeros(axes), 0.0
        for start in range(stop - 1, max(stop - longest, 0) - 1, -1):
            k = stop - start
            level, line = 0.0, 0.0
            for a in range(axes):
                total[a] += values[start, a]
                moment[a] += k * values[start, a]
                square += values[start, a] ** 2
                level += total[a] ** 2 / k
                line += (moment[a] - (k + 1) / 2 * total[a]) ** 2
            cost = best[start] + square - level + gate
            if cost < best[stop]:
                best[stop], begins[stop], slopes[stop] = cost, start, 0.0
            spread = k * (k**2 - 1) / 12
            if k > 2 and cost + slope - line / spread < best[stop]:
                best[stop], begins[stop] = cost + slope - line / spread, start
                for a in range(axes):
                    slopes[stop, a] = ((k + 1) / 2 * total[a] - moment[a]) / spread
    return begins, slopes


def _joined(pieces: list[_Piece], spread: np.ndarray) -> list[_Piece]:
    """The pieces, where two that follow each other and stay at one force are one."""
    found = pieces[:1]
    for piece in pieces[1:]:
        last = found[-1]
        counts = last.stop - last.start, piece.stop - piece.start
        variance = (FORCE_STAYS / 3) ** 2 + spread * (1 / counts[0] + 1 / counts[1])
        off = float(np.sum((piece.mean - last.mean) ** 2 / variance))
        if last.stays and piece.stays and off <= STEADY_GATE + 3:
            # the force of the last of them is what the next one is held to
            found[-1] = _Piece(last.start, piece.stop, piece.mean, True)
        else:
            found.append(piece)
    return found
