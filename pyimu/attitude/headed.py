"""Whether a recording's headings turn as its gyro does: degrees called radians, a compass."""

from __future__ import annotations

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.recording import Recording

SPAN = 2.0
"""s; between the headings whose differences are compared with how far the gyro turned."""

LEAST_TURN, MOST_TURN = 0.03, 2.0
"""rad in a span: less is noise, and of more nobody knows how often it went round."""

LEAST_SPANS = 10
"""Spans that turn, fewer than which say nothing."""

AGREES, CONTRADICTS = 0.3, 0.7
"""Shares of the turns that headings are off by which agree with the gyro, and which do not: only
where one reading of the numbers agrees and the stated one does not is that called wrong."""

READINGS = {
    "compass": (1.0, -1.0),
    "degrees": (np.pi / 180, 1.0),
    "compass in degrees": (np.pi / 180, -1.0),
}
"""What headings are mistaken for: their factor to radians, and the sense in which they count."""


def heading_findings(recording: Recording) -> tuple[Finding, ...]:
    """A finding ``heading_reading`` where the headings are another reading of the gyro's turns.

    How far the body turned about the vertical is the sum of its rates along the measured force,
    which is gravity but for what moves the body.
    """
    if getattr(recording, "heading", None) is None or recording.accel is None:
        return ()
    headings, turns = _spans(recording)
    if len(turns) < LEAST_SPANS:
        return ()
    off = {
        name: _off(headings * factor, sense * turns) for name, (factor, sense) in READINGS.items()
    }
    best = min(off, key=lambda name: off[name])
    stated = _off(headings, turns)
    if off[best] > AGREES or stated < CONTRADICTS:
        return ()
    return (Finding("heading_reading", "heading", len(recording), {"as": best}),)


def _spans(r: Recording) -> tuple[np.ndarray, np.ndarray]:
    """How much the numbers of the headings change (m,), and the gyro's angle turns in rad (m,)."""
    known = np.flatnonzero(np.isfinite(r.heading))
    if len(known) < LEAST_SPANS:
        return np.zeros(0), np.zeros(0)
    size = np.linalg.norm(r.accel, axis=1)
    rate = np.sum(r.gyro * r.accel, axis=1) / np.where(size > 0, size, np.nan)
    period = np.diff(r.time, prepend=r.time[0])
    angle = np.cumsum(np.nan_to_num(rate - np.nanmedian(rate)) * period)
    at = np.arange(r.time[known[0]], r.time[known[-1]], SPAN)
    rows = np.unique(known[np.searchsorted(r.time[known], at)])
    turns = np.diff(angle[rows])
    turning = (np.abs(turns) > LEAST_TURN) & (np.abs(turns) < MOST_TURN)
    return np.diff(r.heading[rows])[turning], turns[turning]


def _off(headings: np.ndarray, turns: np.ndarray) -> float:
    """By which share of the turns the headings miss them, as a median of either's size."""
    away = np.angle(np.exp(1j * (headings - turns)))
    return float(np.median(np.abs(away)) / np.median(np.abs(turns)))
