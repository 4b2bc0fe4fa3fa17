"""The attitude that a filter makes of a model, beside a reference attitude."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude import run
from pyimu.attitude.error import AttitudeError, error_against
from pyimu.identification.fit.clock import Clock
from pyimu.model.part import Part
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import attitude_at

Compared = tuple[np.ndarray, np.ndarray, Rotation]
"""Time (m,) s of the rows that both cover, the filter's attitude (m, 4) and the reference's (m,),
both of the sensor's axes."""


def attitude_error(
    recording: Recording,
    part: Part,
    mounting: np.ndarray,
    start: int = 0,
    clock: Clock | None = None,
) -> AttitudeError:
    """How far apart the two are that ``beside`` gives, for a reference whose world is level."""
    return error_against(*beside(recording, part, mounting, start, clock))


def beside(
    recording: Recording,
    part: Part | None,
    mounting: np.ndarray,
    start: int = 0,
    clock: Clock | None = None,
    stop: int | None = None,
) -> Compared:
    """Run the filter with ``part`` over a whole recording that has ``ref_q``, to compare.

    It is given from row ``start`` on, up to ``stop``. ``mounting`` (3, 3) turns the reference's
    body axes into the sensor's; ``clock`` is what was taken out of the reference's clock.
    """
    if clock is not None and clock.taken_out:
        recording = on_own_clock(recording, clock)
    truth_known = np.isfinite(recording.ref_q).all(axis=1)
    rows = np.flatnonzero(truth_known[:stop])
    rows = rows[rows >= start]
    if not len(rows):
        return np.zeros(0), np.zeros((0, 4)), Rotation.identity(0)
    reference = (
        Rotation.from_quat(recording.ref_q[rows], scalar_first=True)
        * Rotation.from_matrix(mounting).inv()
    )
    first = reference[0].as_euler("ZYX")[0]
    # The reference's north need not be the magnetic one.
    found = run(recording, part, heading0=first if rows[0] == 0 else None, magnetometer=False)
    return recording.time[rows], found.q[rows], reference


def on_own_clock(recording: Recording, clock: Clock) -> Recording:
    """The recording with its reference attitude as late as its sensors."""
    source = recording if recording.reference is None else recording.reference
    time = recording.time - clock.at(recording.time)
    return replace(recording, ref_q=attitude_at(source, time))
