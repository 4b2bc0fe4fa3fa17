"""By how much a gyro's bias drifts between the first rests of a log, beyond what its part says.

A gyro that has just been switched on warms up. The filter learns of its drift at the second rest,
and until then no standard deviation has what that makes of attitude and bias. A log tells it
beforehand: its mean rate differs from rest to rest. A drift that fades is fastest at the start, so
that the density of its walk is the largest that any number of the first pairs of rests has on
average.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import casadi as ca
import numpy as np

from pyimu.attitude.alignment import compensated_means
from pyimu.attitude.even_turns import AXIAL, EDGE, LEAST, LEAST_TURN, LOOKED_AT
from pyimu.attitude.filter.compensation import noise_of
from pyimu.attitude.filter.drift import EXCEEDS, SHORTEST, WHOLE
from pyimu.attitude.rest import Rest, finite_rows, sways
from pyimu.errors import Finding
from pyimu.model.part import Part
from pyimu.recording.recording import Recording
from pyimu.recording.rest import rests, still_rows

COMES_BACK = 2
"""Levels beside that after a change about the vertical by which it was a drift and no turn."""

LARGEST = 0.01
"""rad/s; the largest change about the vertical that is taken for a drift: a consumer's gyro that
warms by 20 K (LSM6DSO, BMI270: 0.02 to 0.03 deg/s/K)."""


@dataclass(frozen=True)
class Level:
    """The mean compensated ``rate`` (3,) rad/s over ``length`` s about the instant ``time`` s of a
    body at rest, and the vertical ``up`` (3,) there.
    """

    rate: np.ndarray
    up: np.ndarray
    time: float
    length: float


def early_drift(recording: Recording, part: Part, rest: Rest) -> float:
    """Root density in rad/s/sqrt(s) of the walk of the gyro's bias at the start of a recording,
    beyond that of its ``part``; 0 where no rests show more. ``rest`` is that at the start.
    """
    if rest.sways or rest.even.std or recording.accel is None:
        return 0.0
    stop = int(np.searchsorted(recording.time, recording.time[0] + LOOKED_AT))
    noise = noise_of(part.gyro, ca.SX(ca.DM(part.gyro.p)), 1 / part.sample_rate)
    white, walk = (
        float(np.mean(np.square(np.array(ca.evalf(v), dtype=float))))
        for v in (noise.white, noise.walk)
    )
    square, time, density = 0.0, 0.0, 0.0
    levels = _levels(recording.slice(None, stop), part, white)
    for i, (before, after) in enumerate(pairwise(levels), 1):
        if _turns(levels, i):
            continue
        apart = max(after.time - before.time, SHORTEST)
        by_part = 3 * (white * (1 / before.length + 1 / after.length) + walk * apart)
        off = float(np.sum((after.rate - before.rate) ** 2))
        square += (off - by_part) * (off > EXCEEDS * by_part)
        time += apart
        density = max(density, square / (3 * time))
    return float(np.sqrt(density))


def drift_findings(walk: float) -> tuple[Finding, ...]:
    """A finding ``gyro_drifts`` where there is such a drift: its root density ``walk`` in
    rad/s/sqrt(s), and what it makes of the bias in a minute.
    """
    if not walk > 0:
        return ()
    detail = {"walk": walk, "in_a_minute": walk * float(np.sqrt(60.0))}
    return (Finding("gyro_drifts", "gyro", 1, detail),)


def _levels(recording: Recording, part: Part, white: float) -> list[Level]:
    """The levels of a log in time: one of each rest, of a long one at its start and at its end.

    ``white`` (rad/s)^2 s is the density of the gyro's white noise.
    """
    period, found = recording.sample_period, []
    edge, whole = round(EDGE / period), round(WHOLE / period)
    # At any phase of a second rests are a little longer, and take ten times as long to find.
    still = still_rows if recording.stationary is None else rests
    for a, b in still(recording):
        first, last = a + edge, b - edge
        ends = [(first, last)]
        if last - first > 2 * whole:
            ends = [(first, first + whole), (last - whole, last)]
        for start, stop in ends:
            if (stop - start) * period >= LEAST:
                found.append(_level(recording, part, slice(start, stop), white))
    return [v for v in found if v is not None]


def _level(recording: Recording, part: Part, rows: slice, white: float) -> Level | None:
    """The level of these rows; None where samples are missing, or the body may sway."""
    piece = recording.slice(rows.start, rows.stop)
    rate, force = (finite_rows(v, len(piece)) for v in (piece.gyro, piece.accel))
    length = len(rate) * recording.sample_period
    if length < LEAST or not len(force) or sways(rate, recording.sample_period, white):
        return None
    means = rate.mean(axis=0), force.mean(axis=0)
    size = float(np.linalg.norm(means[1]))
    known, _ = compensated_means(part, recording, rows, *means)
    middle = float(piece.time[len(piece) // 2])
    return Level(known, means[1] / size, middle, length) if size > 0 else None


def _turns(levels: list[Level], i: int) -> bool:
    """Whether a level and the next, ``i``, differ by an even turn about the vertical of either.

    It is none if it is no faster than a bias may be, and all levels before lie on the one side of
    it and all that follow, two or more, on the other: what turns stops again.
    """
    before, after = levels[i - 1], levels[i]
    off = after.rate - before.rate
    square = off @ off
    axes = np.linalg.qr(np.column_stack([before.up, after.up]))[0]
    along = float(np.sum((off @ axes) ** 2))
    if along <= max(AXIAL**2 * (square - along), LEAST_TURN**2):
        return False
    passed = [(v.rate - before.rate) @ off > square / 2 for v in levels]
    stays = not any(passed[:i]) and all(passed[i:]) and len(passed) - i > COMES_BACK
    return bool(square > LARGEST**2 or not stays)
