"""Samples at an accelerometer's limit, of axes that were corrected by each other after it.

A calibration turns the end of a range into a plane: the samples at it are no more equal, but the
corrected axis plus a hundredth or so of the two others is, to the last digit. Three samples tell
the plane, and no fourth lies in it by chance.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.columns import column_names
from pyimu.recording.quality.clipping import touched_level
from pyimu.recording.quality.resolution import resolution
from pyimu.recording.recording import Recording

CROSS = 0.1
"""Largest part of another axis in a correction."""

DIGITS = 1e-6
"""Share of the limit by which samples in the plane may be off it: numbers of 32 bits."""

MOVED = 0.03
"""Share of a limit by which a correction may move it: a triad's axes have one range, and samples so
near to it are too few for a plane on some."""

COARSE = 1e-5
"""Share of the limit; sums of columns of coarser steps are equal by chance."""

OUTERMOST, AMONG = 14, 200
"""Of so many samples any three may tell the plane, which so many may lie in."""

LEAST = 8
"""Samples that must lie in a plane with none beyond it. Of 364 planes, and 200 samples over a third
of the range, five more lie in one by chance in 1 of 1e7 logs."""


def with_equal_limits(recording: Recording) -> Recording:
    """The recording, of which the forces at a limit that a correction moved are equal, as they
    would be without it, with a finding ``clipping`` of each that has none; itself where no limit is
    seen so.
    """
    known = {(f.column, f.detail.get("side")) for f in recording.findings if f.kind == "clipping"}
    accel, limits, found = recording.accel.copy(), [], []
    for axis, name in enumerate(column_names("accel")):
        for sign, side in ((-1.0, "low"), (1.0, "high")):
            force = sign * recording.accel
            rows = _in_plane(force, axis)
            if rows.any():
                limits.append(np.nanmax(force[:, axis]))
                accel[rows, axis] = level = sign * limits[-1]
                detail = {"side": side, "level": float(level)}
                if (name, side) not in known:
                    found.append(Finding("clipping", name, int(rows.sum()), detail))
    if not limits:
        return recording
    limit = min(limits)
    for column in accel.T:
        size = np.abs(column)
        if np.nanmax(size) <= (1 + MOVED) * limit:
            at = size >= (1 - MOVED) * limit
            column[at] = np.sign(column[at]) * limit
    return replace(recording, accel=accel, findings=(*recording.findings, *found))


def _in_plane(force: np.ndarray, axis: int) -> np.ndarray:
    """Marks (n,) of the rows of ``force`` (n, 3) that lie in a plane at the upper end of an axis.

    Of a coarse converter samples lie in many planes: the outermost is that of a limit if it has
    more of them than those below have (``touched_level``).
    """
    own, others = force[:, axis], np.delete(force, axis, axis=1)
    none, whole = np.zeros(len(own), dtype=bool), np.flatnonzero(np.isfinite(force).all(axis=1))
    if len(whole) < AMONG:
        return none
    rows = whole[np.argsort(-own[whole])[:AMONG]]
    top, step = own[rows[0]], resolution(own)
    near = DIGITS * top + 2 * step
    if not own[rows[-1]] > 0 or step > COARSE * top:
        return none
    cross = _cross_of_plane(own[rows], others[rows], near)
    if cross is None:
        return none
    sums = own + others @ cross
    level = touched_level(np.round(sums / (2 * near)))[1]
    return none if level is None else sums >= np.nanmax(sums) - 2 * near


def _cross_of_plane(own: np.ndarray, others: np.ndarray, near: float) -> np.ndarray | None:
    """What of the ``others`` (m, 2) is in an axis (m,), the largest first: of the plane with most
    samples to ``near`` and none beyond it; None where there are few.
    """
    best, most = None, LEAST - 1
    for three in map(list, combinations(range(OUTERMOST), 3)):
        sides = np.column_stack([others[three], -np.ones(3)])
        if abs(np.linalg.det(sides)) < near * own[0]:
            continue
        *cross, level = np.linalg.solve(sides, -own[three])
        off = own + others @ cross - level
        count = np.sum(off >= -near)
        if max(map(abs, cross)) <= CROSS and np.all(off <= near) and count > most:
            best, most = np.array(cross), count
    return best
