"""A reference's attitude between its samples."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, partial

import numpy as np
from scipy.spatial.transform import Rotation, RotationSpline

from pyimu.recording.recording import Recording
from pyimu.recording.reference.filled import measured
from pyimu.recording.reference.jumps import jumps
from pyimu.recording.reference.nodes import own_samples
from pyimu.recording.reference.sampling import through
from pyimu.recording.reference.track import Track

KEPT = 1 << 17
"""Samples of a curve that is kept for the next time, some 30 MB; a longer one is made anew."""


def attitude_track(source: Recording) -> Track:
    """The samples of ``ref_q`` that can be differentiated."""
    own, findings = measured(one_sign(source.ref_q), "ref_q", _turns)
    track = Track(source.time, own, partial(steps_of, source.ref_q))
    track.findings += findings
    return track


def cut_at_jumps(track: Track, source: Recording, recording: Recording) -> None:
    """Leave out of the samples of ``ref_q`` what lies near a jump that the gyro does not share."""
    if recording.gyro is None:
        return
    found = [(nodes, _jumps(source, nodes, recording)) for nodes in track.segments]
    rows = np.concatenate([nodes[at] for nodes, (at, _) in found] or [np.zeros(0, dtype=int)])
    track.cut(rows, np.concatenate([angles for _, (_, angles) in found] or [np.zeros(0)]))


def _jumps(source: Recording, nodes: np.ndarray, recording: Recording):
    steps = steps_of(source.ref_q, nodes)
    return jumps(recording.time, steps, source.time[nodes], recording.gyro)


def _turns(q: np.ndarray) -> np.ndarray:
    """Rotation vectors (m, 3) rad from each of attitudes (m, 4) to the next, added up."""
    return np.vstack([np.zeros(3), np.cumsum(steps_of(q, np.arange(len(q))), axis=0)])


def steps_of(q: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Rotation vectors (m - 1, 3) rad between the attitudes ``q`` at rows ``nodes`` (m,)."""
    attitude = Rotation.from_quat(q[nodes], scalar_first=True)
    return (attitude[:-1].inv() * attitude[1:]).as_rotvec()


def attitude_curve(source: Recording, nodes: np.ndarray) -> RotationSpline:
    """The attitude through the samples ``nodes`` (m,) of ``ref_q``, body to world."""
    made = _curve if len(nodes) <= KEPT else _curve.__wrapped__
    return made(source.time[nodes].tobytes(), source.ref_q[nodes].tobytes())


@lru_cache(maxsize=1)
def _curve(time: bytes, q: bytes) -> RotationSpline:
    """The curve through attitudes (m, 4), which takes long to make, and is asked for of one log
    again and again.
    """
    attitude = Rotation.from_quat(np.frombuffer(q).reshape(-1, 4), scalar_first=True)
    return RotationSpline(np.frombuffer(time), attitude)


def rate_through(source: Recording, nodes: np.ndarray) -> Callable[..., np.ndarray]:
    """The rate (n, 3) rad/s at times (n,) of the attitude through the samples ``nodes`` (m,).

    A cubic spline damps what comes four times as slowly as its samples, by 4.5 % where they are.
    What one of fifth degree makes better of their turns, added up, is little, and in which axes
    these are is of second order then.
    """
    curve, time = attitude_curve(source, nodes), source.time[nodes]
    turns = _turns(source.ref_q[nodes])
    cubic, fifth = through(time, turns), through(time, turns, 5)
    return lambda at, order: curve(at, order) + fifth(at, order) - cubic(at, order)


def attitude_at(source: Recording, time: np.ndarray) -> np.ndarray:
    """The attitude (n, 4) at times (n,), NaN where the reference does not cover them."""
    q, source = np.full((len(time), 4), np.nan), own_samples(source)
    for nodes in attitude_track(source).segments:
        rows = within(time, source.time[nodes])
        if len(rows):
            q[rows] = attitude_curve(source, nodes)(time[rows]).as_quat(scalar_first=True)
    return q


def within(time: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Which times (n,) lie between the first and the last of ``nodes`` (m,), as row numbers."""
    return np.flatnonzero((time >= nodes[0]) & (time <= nodes[-1]))


def one_sign(q: np.ndarray) -> np.ndarray:
    """Attitudes (n, 4) without jumps of sign from one known one to the next."""
    out, known = np.array(q), np.flatnonzero(np.isfinite(q).all(axis=1))
    turned = np.sum(out[known[1:]] * out[known[:-1]], axis=1) < 0.0
    out[known] *= np.where(np.cumsum(np.append(False, turned)) % 2, -1.0, 1.0)[:, None]
    return out
