"""Rows of a reference that show once more what the row before shows, because its sample was lost.

Cameras that lose a frame, or the body for seconds, leave their last answer where it was. What is
measured anew never repeats to the last bit, but where its digits are few or it stands still without
any noise: repeats there lie among others, and no step makes up for them.
"""

from __future__ import annotations

import numpy as np

from pyimu.recording.clock import runs

NEAR = 16
"""Rows to either side of one that are near it."""

SELDOM = 0.3
"""Share of the rows near a repeat that repeat as well, below which such rows are no rule there."""

LOST = 5
"""Rows in a row that repeat: fewer are frames, more are a body that was not seen or that rests."""

CATCHES_UP = 5.0
"""Times the usual step near a body that was not seen, by which it is elsewhere once it is: where
one rests without noise it goes on from where it was."""


def without_repeats(values: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Those of the ``rows`` (k,) of a reference (n, d), known there, that show a sample of their
    own.
    """
    if len(rows) < 2 * NEAR:
        return rows
    step = np.linalg.norm(np.diff(values[rows], axis=0), axis=1)
    same = np.append(False, step == 0.0)
    if not same.any():
        return rows
    lost = np.zeros(len(rows), dtype=bool)
    for first, stop in runs(same):
        lost[first:stop] = _is_lost(step, same, first, stop)
    return rows[~lost]


def _is_lost(step: np.ndarray, same: np.ndarray, first: int, stop: int) -> bool:
    """Whether the rows from ``first`` to ``stop``, the ``same`` (k,) as the row before, lost their
    samples; ``step`` (k - 1,) lies between each row and the next.
    """
    if stop == len(same):
        return False
    if stop - first < LOST:
        near = np.r_[max(first - NEAR, 1) : first, stop + 1 : stop + 1 + NEAR]
        return bool(np.mean(same[near[near < len(same)]]) < SELDOM)
    new = np.flatnonzero(~same[1:])
    at = np.searchsorted(new, stop - 1)
    usual = np.median(step[np.append(new[max(at - NEAR, 0) : at], new[at + 1 : at + 1 + NEAR])])
    return bool(step[stop - 1] > CATCHES_UP * usual)
