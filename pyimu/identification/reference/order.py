"""A reference attitude whose quaternion is written in another order than its columns say."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from pyimu.identification.fit.trial import gyro_trial
from pyimu.identification.reference.clock import measure
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.band import COHERENCE
from pyimu.recording.reference.orders import ORDERS


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
