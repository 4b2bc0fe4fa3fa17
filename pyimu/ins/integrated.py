"""The methods that integrate alone, over a recording: the paper's, and the exact one."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.alignment import tilt_of
from pyimu.errors import Finding, UserError
from pyimu.ins.job import Job
from pyimu.ins.strapdown import Path, strapdown, strapdown_wongwirat
from pyimu.ins.track import Track
from pyimu.symbolic.earth import earth_rate


def integrated(name: str, job: Job, heading0: float, findings: list[Finding]) -> Track | None:
    """The track by integration alone; None, with a finding, where samples are missing."""
    recording = job.recording
    try:
        if name == "paper":
            q0 = _level(heading0, None)
            path = strapdown_wongwirat(recording, q0, gravity=job.gravity)
        else:
            path = _strapdown(job, heading0)
    except UserError as error:
        findings.append(Finding("not_integrated", "", 1, {"method": name, "reason": str(error)}))
        return None
    return Track(name, recording.time, path.q, path.velocity, path.position - path.position[0])


def _strapdown(job: Job, heading0: float) -> Path:
    """Exact integration of the compensated samples, less the nulls of the rest."""
    recording = job.clean
    latitude = job.latitude if abs(job.latitude) <= np.pi / 2 else None
    rows = job.rest.rows
    force = np.nanmean(recording.accel[rows], axis=0)
    q0 = _level(heading0, force)
    if job.rest.seen:
        back = Rotation.from_quat(q0, scalar_first=True).inv()
        earth = _earth(latitude)
        null = np.nanmean(recording.gyro[rows], axis=0) - back.apply(earth)
        size = np.linalg.norm(force) - job.gravity
        recording = replace(
            recording,
            gyro=recording.gyro - null,
            accel=recording.accel - size * force / np.linalg.norm(force),
        )
    return strapdown(recording, q0, latitude=latitude, gravity=job.gravity)


def _earth(latitude: float | None) -> np.ndarray:
    """The Earth's rate (3,) rad/s in the world; zero without a latitude."""
    if latitude is None:
        return np.zeros(3)
    return np.array(ca.DM(earth_rate(latitude))).ravel()


def _level(heading0: float, force: np.ndarray | None) -> np.ndarray:
    """The attitude (4,) of a body whose accelerometer shows ``force`` (3,), level without one."""
    roll, pitch = (0.0, 0.0) if force is None else tilt_of(force)
    q = Rotation.from_euler("ZYX", [heading0, pitch, roll])
    return q.as_quat(scalar_first=True)
