"""A reference attitude that is written in another order, or with other signs, than its columns
say."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.clock import measure, shifted
from pyimu.identification.reference.moving import moving_pair, turned_onto
from pyimu.identification.reference.place import placed
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.band import COHERENCE
from pyimu.recording.reference.orders import (
    ORDERS,
    is_of_angles,
    orders_of_angles,
    read_as,
    units_of_angles,
)
from pyimu.recording.turning import busiest

LONGEST = 120.0
"""s; of a longer log so much is looked at, where the gyro turns most."""

AROUND = 60.0
"""s; of the reference before and behind that: clocks may be off by half of it."""

ALIKE = float(np.radians(10.0))
"""rad; readings that are turned by so much more against the gyro are of the same body, where others
differ by a quarter of a turn."""


def other_order(logs: Iterable[Recording]) -> str:
    """The orders of ``ref_q``, or of the angles that it was read from, that fit the gyro where the
    one that the columns say does not.

    Nothing where none does.
    """
    for r in logs:
        if r.ref_q is None or r.gyro is None:
            continue
        part = _part(r)
        if _fit(part)[0] >= COHERENCE:
            continue
        said = _of_angles(part) if is_of_angles(r) else _of_quaternion(part)
        if said:
            whose = r.name if r.reference is None else r.reference.name
            return f"the attitude of {whose} fits if {said}"
    return ""


def _of_quaternion(r: Recording) -> str:
    fits = [name for name, turned in ORDERS.items() if _fit(read_as(r, turned))[0] >= COHERENCE]
    return f"ref_q is read as {' or as '.join(fits)}" if fits else ""


def _of_angles(r: Recording) -> str:
    for name, turned in units_of_angles().items():
        if _fit(read_as(r, turned))[0] >= COHERENCE:
            return f"roll, pitch and yaw {name}"
    turns: list[tuple[float, str]] = []
    for alike in orders_of_angles():
        if _fit(read_as(r, next(iter(alike.values()))))[0] >= COHERENCE:
            turns += [(_fit(read_as(r, turned))[1], name) for name, turned in alike.items()]
    # These differ by the mounting: who wrote the file took the body's axes.
    return _simplest(turns)


def _simplest(turns: list[tuple[float, str]]) -> str:
    """What is said of the reading that is turned least against the gyro; of several such, of that
    with the fewest signs.
    """
    if not turns:
        return ""
    least = min(angle for angle, _ in turns)
    names = [name for angle, name in turns if angle < least + ALIKE]
    return f"roll, pitch and yaw are {min(names, key=lambda n: (n.count('-'), len(n)))}"


def _part(recording: Recording) -> Recording:
    """The recording, or of a long one the part in which the gyro turns most."""
    start, stop = busiest(recording, LONGEST)
    part, source = recording.slice(start, stop), recording.reference
    if source is None:
        return part
    ends = part.time[0] - AROUND, part.time[-1] + AROUND
    return replace(part, reference=source.slice(*np.searchsorted(source.time, ends).tolist()))


def _fit(recording: Recording) -> tuple[float, float]:
    """Share of the gyro's power that the reference accounts for, and by how much it is turned
    against the gyro, rad.
    """
    trial = gyro_trial(recording)
    clock = None if trial is None else measure(trial, Sensor("gyro"))
    if trial is None or clock is None:
        return 0.0, np.inf
    x, y = moving_pair(placed(shifted(trial, clock)))
    if x.shape[1] < 3:
        return clock.explained, np.inf
    turn = turned_onto(x - x.mean(axis=0), y - y.mean(axis=0))
    return clock.explained, float(Rotation.from_matrix(turn).magnitude())
