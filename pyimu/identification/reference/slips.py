"""The instants at which a reference's clock slips.

Windows of some seconds show that it does, and by how much. When it does the samples show: before it
they follow the reference by one lag, and after it by the other.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.clock import Clock, Slip
from pyimu.identification.fit.columns import band_time, in_band
from pyimu.identification.fit.response import through_dynamics
from pyimu.identification.fit.trial import Trial, marked
from pyimu.identification.reference.clock import rebanded, shifted
from pyimu.identification.reference.moving import moving_rows
from pyimu.identification.reference.track import EDGE
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.clock import runs

AROUND = 1.0
"""s beyond the windows between which a clock was seen to slip, in which the instant is sought."""

UNSURE = 4.0
"""nat by which an instant may be less likely than the best one, and still be the right one."""

MIXED = 0.5
"""s before and after a slip in which stamps that jitter are of either side: by 50 us where two
clocks are 1e-4 apart."""


def placed_slips(trial: Trial, clock: Clock | None, sensor: Sensor) -> Clock | None:
    """The clock with each of its slips at the instant that the samples show, and ``unsure`` of
    what is near it.
    """
    if clock is None or not clock.slips:
        return clock
    levels = np.append(0.0, np.cumsum([s.size for s in clock.slips]))
    distinct, number = np.unique(np.round(levels, 9), return_inverse=True)
    time, left = _left_by_level(trial, clock, distinct, sensor)
    if not len(time):
        return clock
    width = max(float(np.median(left.min(axis=0))), 1e-300)
    spans = _spans(time, np.log1p(left / width)[number], _allowed(clock.slips))
    if spans is None:
        return clock
    slips = [
        Slip(float(np.mean(s)), float(np.ptp(s)) / np.sqrt(12.0), was.size)
        for s, was in zip(spans, clock.slips, strict=True)
    ]
    unsure = tuple((a - MIXED, b + MIXED) for a, b in spans)
    return replace(_with_slips(clock, slips), unsure=unsure)


def _allowed(slips: tuple[Slip, ...]) -> list[tuple[float, float]]:
    """The times between which each slip is sought."""
    reach = [float(np.sqrt(3.0) * s.std + AROUND) for s in slips]
    return [(s.time - r, s.time + r) for s, r in zip(slips, reach, strict=True)]


def _with_slips(clock: Clock, slips: list[Slip]) -> Clock:
    """The clock with its slips, in their order, at other instants."""
    edges = np.repeat([s.time for s in slips], 2) + np.tile([-EDGE, EDGE], len(slips))
    nodes = np.unique(np.concatenate([clock.time[[0, -1]], edges]))
    stepped = sum(s.size * (nodes > s.time) for s in slips)
    late = clock.late[0] + clock.skew[0] * (nodes - clock.time[0]) + stepped
    return replace(clock, time=nodes, late=late, slips=tuple(slips))


def _left_by_level(
    trial: Trial, clock: Clock, levels: np.ndarray, sensor: Sensor
) -> tuple[np.ndarray, np.ndarray]:
    """Times (m,) of the rows in the band, and squares (levels, m) of what the reference, turned and
    scaled as it is seen, leaves there, being later all the time by one of the ``levels`` than the
    clock is before it slips.
    """
    ends = clock.time[[0, -1]]
    line = clock.late[0] + clock.skew[0] * (ends - ends[0])
    moved = [shifted(trial, replace(clock, time=ends, late=line + v)) for v in levels]
    as_seen = shifted(trial, clock)
    same = np.all([marked(t.segments, len(t.time)) for t in (as_seen, *moved)], axis=0)
    band_hz = rebanded(as_seen).band_hz
    as_seen, *moved = (replace(t, segments=runs(same), band_hz=band_hz) for t in (as_seen, *moved))
    # Of a reference that is late by one of the levels all the time most rows may tell nothing.
    known, y = _known(as_seen, sensor)
    seen = moving_rows(as_seen)
    gain = np.linalg.lstsq(known[seen], y[seen])[0]
    left = [np.sum((y - _known(t, sensor)[0] @ gain) ** 2, axis=1) for t in moved]
    return band_time(as_seen), np.array(left)


def _known(trial: Trial, sensor: Sensor) -> tuple[np.ndarray, np.ndarray]:
    """A constant beside what the reference shows (m, 1 + axes), and what the sensor does (m, axes),
    in the band.
    """
    axes = list(trial.axes)
    own = through_dynamics(sensor, trial.u[:, OWN[trial.kind]], trial.segments, trial.h)
    x, y = (in_band(trial, v[:, axes]) for v in (own, trial.y))
    return np.column_stack([np.ones(len(x)), x]), y


def _spans(
    time: np.ndarray, cost: np.ndarray, allowed: list[tuple[float, float]]
) -> list[tuple[float, float]] | None:
    """The times between which each slip lies, by the ``cost`` (slips + 1, m) of each row before the
    first slip, between two, and after the last; None where that is nowhere.

    A slip costs nothing within the times ``allowed`` for it, and is nowhere else. Its cheapest
    place, the others being where they fit it best, is that of two passes (Viterbi 1967).
    """
    first, last = np.array(allowed).T[:, :, None]
    late = (time > first) & (time <= last)  # (slips, m): a slip may come right before this row
    ahead = _ahead(cost, late)
    back = _ahead(cost[::-1, ::-1], np.roll(late, -1, axis=1)[::-1, ::-1])[::-1, ::-1]
    best, spans = ahead[-1, -1], []
    if not np.isfinite(best):
        return None
    for k in range(len(allowed)):
        through = np.where(late[k, 1:], ahead[k, :-1] + back[k + 1, 1:], np.inf)
        likely = np.flatnonzero(through <= best + UNSURE)
        spans.append((float(time[likely[0]]), float(time[likely[-1] + 1])))
    return spans


def _ahead(cost: np.ndarray, late: np.ndarray) -> np.ndarray:
    """Cost (slips + 1, m) of the cheapest way to each row and number of slips."""
    out = np.full(cost.shape, np.inf)
    now = np.full(len(cost), np.inf)
    now[0] = 0.0
    for r in range(cost.shape[1]):
        if r:
            now[1:] = np.where(late[:, r], np.minimum(now[1:], now[:-1]), now[1:])
        now = now + cost[:, r]
        out[:, r] = now
    return out
