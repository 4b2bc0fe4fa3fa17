"""Whether a recording's headings turn as its gyro does: degrees called radians, a compass."""

from __future__ import annotations

import numpy as np

from pyimu.attitude.columns import recorded_age
from pyimu.errors import Finding
from pyimu.recording.recording import Recording
from pyimu.recording.turning import carried, drawn

SPAN, LONGEST = 2.0, 10.0
"""s; between the headings whose differences are compared with how far the gyro turned, and at most
where headings are rare: a gyro's bias turns it meanwhile."""

MOST_SPANS = 500
"""Spans that are looked at, from all of a long log."""

LEAST_TURN, MOST_TURN = 0.03, 2.0
"""rad in a span: less is noise, and of more nobody knows how often it went round."""

LEVEL = 0.3
"""Least horizontal part of the body's x axis: one that points up or down has no heading."""

AGREES = 0.5
"""Share of the turns by which headings may miss them and still be a reading of them. Chance misses
them by all of them or more."""

BY_CHANCE = 1e-6
"""Likelihood of the numbers as stated over that of the best other reading, below which the other is
believed."""

READINGS = {
    "compass": (1.0, -1.0),
    "degrees": (np.pi / 180, 1.0),
    "compass in degrees": (np.pi / 180, -1.0),
}
"""What headings are mistaken for: their factor to radians, and the sense in which they count."""


def heading_findings(recording: Recording) -> tuple[Finding, ...]:
    """A finding ``heading_reading`` where the headings are another reading of the gyro's turns.

    Each reading misses the turns of the m spans by some rad. By errors with the density of Laplace,
    of a size that nobody knows, its likelihood is the m-th power of one over their sum: a few wild
    headings decide nothing, and one that misses them all no less than another is not believed.
    """
    if getattr(recording, "heading", None) is None or recording.accel is None:
        return ()
    headings, turns = _spans(recording)
    # A bias of the gyro turns it evenly, as a steady turn does: neither tells a reading.
    away = np.abs(turns - np.median(turns)) if len(turns) else turns
    turning = away > LEAST_TURN
    if not turning.any():
        return ()
    missed = {
        name: float(np.sum(_missed(headings * factor, sense * turns)[turning]))
        for name, (factor, sense) in READINGS.items()
    }
    best = min(missed, key=lambda name: missed[name])
    stated = float(np.sum(_missed(headings, turns)[turning]))
    likelier = np.count_nonzero(turning) * np.log(stated / max(missed[best], 1e-12))
    if missed[best] > AGREES * np.sum(away[turning]) or likelier < -np.log(BY_CHANCE):
        return ()
    return (Finding("heading_reading", "heading", len(recording), {"as": best}),)


def _missed(headings: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """By how many rad (m,) the headings miss the turns, beside an even turn."""
    off = _wrapped(headings - turns)
    return np.abs(_wrapped(off - np.median(off)))


def _wrapped(angle: np.ndarray) -> np.ndarray:
    return np.angle(np.exp(1j * angle))


def _spans(r: Recording) -> tuple[np.ndarray, np.ndarray]:
    """How much the numbers of the headings change (m,), and by how many rad the yaw does (m,)."""
    known = np.flatnonzero(np.isfinite(r.heading))
    if len(known) < 2:
        return np.zeros(0), np.zeros(0)
    at = np.arange(r.time[known[0]], r.time[known[-1]], SPAN)
    rows = np.unique(known[np.searchsorted(r.time[known], at)])
    true_at = np.minimum(np.searchsorted(r.time, r.time[rows] - recorded_age(r)[rows]), rows)
    near = np.flatnonzero(np.diff(r.time[true_at]) < LONGEST)
    near = near[drawn(len(near), MOST_SPANS)]
    turns, usable = _turns(r, true_at[near], true_at[near + 1])
    return np.diff(r.heading[rows])[near][usable], turns[usable]


def _turns(r: Recording, first: np.ndarray, last: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """By how many rad the heading of the body's x axis turns from the ``first`` rows to the last.

    Beside it which of them can be used. Within a span the gyro tells how the body turns; the
    forces, turned back to where it began, have the vertical as their mean, as what moves a body to
    and fro has none.
    """
    lengths = np.maximum(last - first, 0)
    row = first + np.arange(1, max(lengths, default=0) + 1)[:, None]
    row = np.minimum(row, last)
    step = np.diff(r.time, prepend=r.time[0])
    angle = np.nan_to_num(r.gyro)[row] * step[row][:, :, None]
    turned, sums = carried(angle, np.stack([np.nan_to_num(r.accel)[row], angle], axis=3), lengths)
    up, along = sums[:, :, 0], sums[:, :, 1]
    up = up / np.maximum(np.linalg.norm(up, axis=1, keepdims=True), 1e-12)
    start = np.tile([1.0, 0.0, 0.0], (len(first), 1))
    end = turned.apply(start)
    level = [v - np.sum(v * up, axis=1, keepdims=True) * up for v in (start, end)]
    ahead = np.sum(level[0] * level[1], axis=1)
    aside = np.sum(up * np.cross(*level), axis=1)
    usable = np.abs(np.sum(along * up, axis=1)) < MOST_TURN
    for v in level:
        usable &= np.linalg.norm(v, axis=1) > LEVEL
    return np.arctan2(aside, ahead), usable
