"""A reference attitude whose quaternion is written in another order than its columns say."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.trial import gyro_trial
from pyimu.identification.reference.clock import measure
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.band import COHERENCE

ORDERS = {
    "scalar last (x, y, z, w)": lambda q: np.roll(q, 1, axis=1),
    "world to body": lambda q: q * [1.0, -1.0, -1.0, -1.0],
}
"""What a quaternion may be that is not body to world, scalar first, and how it becomes that.

A gyro tells neither from the other: one is the other between two constant turns, of the world and
of the mounting."""


def other_order(logs: Iterable[Recording]) -> str:
    """The orders of ``ref_q`` that fit the gyro where the one that the columns say does not.

    Nothing where none does.
    """
    for r in logs:
        if r.ref_q is None or r.gyro is None:
            continue
        fits = [
            name
            for name, turned in ORDERS.items()
            if _explained(replace(r, ref_q=turned(r.ref_q))) >= COHERENCE
        ]
        if fits:
            return f"the attitude of {r.name} fits if ref_q is read as {' or as '.join(fits)}"
    return ""


def _explained(recording: Recording) -> float:
    trial = gyro_trial(recording)
    clock = None if trial is None else measure(trial, Sensor("gyro"))
    return 0.0 if clock is None else clock.explained
