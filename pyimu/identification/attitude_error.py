"""What a model is worth to the attitude filter: its error against a reference attitude."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude import run
from pyimu.identification.fit.clock import Clock
from pyimu.model.part import Part
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import attitude_at

LOST = 0.5
"""rad; root mean square from which on an attitude is lost: which of two lost ones is further off is
chance."""


@dataclass(frozen=True)
class AttitudeError:
    """Error of the filter's attitude from row ``start`` of a recording on, heading set right there.

    ``time`` (m,) s; ``total`` (m,) rad, angle of the error rotation; ``heading`` (m,) rad, its part
    about the vertical; both only at rows that the reference covers.
    """

    time: np.ndarray
    total: np.ndarray
    heading: np.ndarray

    @property
    def rms(self) -> float:
        return float(np.sqrt(np.mean(self.total**2))) if len(self.total) else float("nan")

    @property
    def is_lost(self) -> bool:
        return self.rms > LOST


def attitude_error(
    recording: Recording,
    part: Part,
    mounting: np.ndarray,
    start: int = 0,
    clock: Clock | None = None,
) -> AttitudeError:
    """Run the filter with ``part`` over a whole recording that has ``ref_q``, and compare.

    ``mounting`` (3, 3) turns the reference's body axes into the sensor's; ``clock`` is what was
    taken out of the reference's clock.
    """
    if clock is not None and clock.taken_out:
        recording = _on_own_clock(recording, clock)
    truth_known = np.isfinite(recording.ref_q).all(axis=1)
    rows = np.flatnonzero(truth_known & (np.arange(len(truth_known)) >= start))
    if not len(rows):
        return AttitudeError(*(np.zeros(0),) * 3)
    reference = (
        Rotation.from_quat(recording.ref_q[rows], scalar_first=True)
        * Rotation.from_matrix(mounting).inv()
    )
    first = reference[0].as_euler("ZYX")[0]
    found = run(recording, part, heading0=first if rows[0] == 0 else None)
    error = Rotation.from_quat(found.q[rows], scalar_first=True) * reference.inv()
    turn = Rotation.from_euler("z", -error[0].as_euler("ZYX")[0])
    error = turn * error
    return AttitudeError(
        recording.time[rows], error.magnitude(), np.unwrap(error.as_euler("ZYX")[:, 0])
    )


def _on_own_clock(recording: Recording, clock: Clock) -> Recording:
    """The recording with its reference attitude as late as its sensors."""
    source = recording if recording.reference is None else recording.reference
    time = recording.time - clock.at(recording.time)
    return replace(recording, ref_q=attitude_at(source, time))
