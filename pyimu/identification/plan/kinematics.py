"""Rates, attitudes and forces of a body that is moved piece by piece."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.units import STANDARD_GRAVITY

Piece = tuple[np.ndarray, np.ndarray]
"""Rate (n, 3) in rad/s and acceleration (n, 3) in m/s^2, both in body axes."""

TURN_OVER = 4.0
"""s; from one face to another, by hand."""

RUN = 32
"""Turns of which the product is taken one after another."""

RAMP = 1.0
"""s in which a steady rate is reached and left."""


def times(duration: float, h: float) -> np.ndarray:
    """Middles (n,) of the sample periods of a piece: what is moved in one is its middle's rate."""
    return (np.arange(round(duration / h)) + 0.5) * h


def rests(duration: float, h: float) -> Piece:
    nothing = np.zeros((round(duration / h), 3))
    return nothing, nothing


def turns(axis: int, rate: np.ndarray) -> Piece:
    """A rate (n,) about one axis of the body."""
    return np.outer(rate, np.eye(3)[axis]), np.zeros((len(rate), 3))


def sine(axis: int, peak: float, period: float, duration: float, h: float) -> Piece:
    """To and fro; whole periods end where they began."""
    return turns(axis, peak * np.sin(2 * np.pi * times(duration, h) / period))


def steps(axis: int, levels: Sequence[float], each: float, h: float) -> Piece:
    """One steady rate after another, each for as long."""
    t = times(each, h)
    share = 0.5 - 0.5 * np.cos(np.pi * np.clip(np.minimum(t, each - t) / RAMP, 0.0, 1.0))
    return turns(axis, np.concatenate([level * share for level in levels]))


def turned_over(up: np.ndarray, wanted: np.ndarray, h: float) -> Piece:
    """From one direction of the body being up to another, by the shortest way."""
    axis, cosine = np.cross(up, wanted), float(up @ wanted)
    if cosine < -0.999:
        axis = np.roll(up, 1)
    angle = np.arctan2(np.linalg.norm(np.cross(up, wanted)), cosine)
    t = times(TURN_OVER, h)
    rate = angle * (1 - np.cos(2 * np.pi * t / TURN_OVER)) / TURN_OVER
    # What is seen from the body turns the other way.
    rate = -np.outer(rate, axis / max(np.linalg.norm(axis), 1e-12))
    return rate, np.zeros_like(rate)


def joined_pieces(pieces: Sequence[Piece]) -> Piece:
    rate, push = (np.concatenate(v) for v in zip(*pieces, strict=True))
    return rate, push


def attitude(rate: np.ndarray, h: float) -> Rotation:
    """Body to world, after each sample period, of a body that begins level: the product of the
    turns of all periods before.
    """
    return _running(Rotation.from_rotvec(rate * h))


def _running(turns: Rotation) -> Rotation:
    """The product of each turn with all before it: within runs of ``RUN`` turns, all runs at once,
    and of the runs by the same.
    """
    count = -(-len(turns) // RUN)
    if count <= 1:
        return _within(turns, 1)
    missing = count * RUN - len(turns)
    padded = Rotation.concatenate([turns, Rotation.identity(missing)]) if missing else turns
    # The first turns of all runs, then the second ones, and so on.
    order = np.arange(count * RUN).reshape(count, RUN).T.ravel()
    within = _within(padded[order], count)
    before = Rotation.concatenate([Rotation.identity(1), _running(within[-count:])[:-1]])
    return (before[order // RUN] * within)[np.argsort(order)][: len(turns)]


def _within(turns: Rotation, count: int) -> Rotation:
    """The running products of ``count`` runs, whose turns follow each other ``count`` apart."""
    parts = [turns[:count]]
    for k in range(count, len(turns), count):
        parts.append(parts[-1] * turns[k : k + count])
    return Rotation.concatenate(parts)


def force(q: Rotation, push: np.ndarray) -> np.ndarray:
    """Specific force (n, 3) in body axes."""
    return q.inv().apply([0.0, 0.0, STANDARD_GRAVITY]) + push
