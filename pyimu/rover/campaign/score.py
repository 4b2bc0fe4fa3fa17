"""A run as a row of the campaign's table: its draws, its errors, and how honest the filter was."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.rover.campaign.one_run import Drive, driven
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.specimen import drawn_values

ANGLES = ("roll", "pitch", "heading")
"""The angles of an attitude in the order of ``Truth.euler``."""

FREEDOM = {"attitude": 3, "heading": 1, "bias": 3}
"""Degrees of freedom of the normalised errors squared."""

Row = dict[str, Any]


def row_of(settings: Settings, number: int) -> Row:
    """The row of the run of that ``number``."""
    return row(driven(settings, number))


def row(drive: Drive) -> Row:
    """The row of a run, by the names of its columns."""
    draws, first = drive.draws, drive.truth.first
    start = draws.start_error * drive.system.start_std[:3]
    return (
        {
            "run": draws.number,
            "noise_seed": draws.noise_seed,
            "specimen_seed": draws.specimen_seed,
            "terrain": draws.terrain,
            "fault": drive.fault.name,
            "fault_time [s]": drive.fault.time,
            "fault_axis": drive.fault.axis,
            "start_roll_error [rad]": float(start[0]),
            "start_pitch_error [rad]": float(start[1]),
            "start_heading_error [rad]": float(start[2]),
            "steps": len(drive.errors),
            "status": int(np.bitwise_or.reduce(drive.status[first:])),
        }
        | draws.profile
        | _errors(drive, first)
        | _normalised(drive)
        | drawn_values(drive.system.part, drive.specimen)
    )


def _errors(drive: Drive, first: int) -> dict[str, float]:
    """The largest, the root mean square and the last error of each angle from ``first`` on."""
    out, found = {}, drive.errors[first:]
    for i, name in reversed(list(enumerate(ANGLES))):
        e = found[:, i]
        out |= {
            f"{name}_error_max [rad]": float(np.abs(e).max()),
            f"{name}_error_rms [rad]": float(np.sqrt(np.mean(e**2))),
            f"{name}_error_end [rad]": float(e[-1]),
        }
    return out


def _normalised(drive: Drive) -> dict[str, float]:
    """Normalised estimation errors squared, at the end and in the mean over the instants.

    Those of the attitude (3 degrees of freedom), of the heading about the vertical (1) and of the
    gyro's bias (3), by the filter's own covariance (Bar-Shalom, Li and Kirubarajan 2001, section
    5.4).
    """
    all_of = np.array(
        [
            _normalised_at(state, drive.truth.q[k - 1], bias, drive.system.constant_tilt)
            for k, state, bias in zip(drive.instants, drive.states, drive.bias, strict=True)
        ]
    )
    out = {}
    for i, name in enumerate(FREEDOM):
        out[f"nees_{name}_end [1]"] = float(all_of[-1, i])
        out[f"nees_{name}_mean [1]"] = float(all_of[:, i].mean())
    return out


def _normalised_at(
    state: np.ndarray, q: np.ndarray, bias: np.ndarray, constant_tilt: float
) -> tuple[float, ...]:
    estimate = Rotation.from_quat(state[:4], scalar_first=True)
    error = (estimate.inv() * Rotation.from_quat(q, scalar_first=True)).as_rotvec()
    covariance = np.zeros((6, 6))
    covariance[np.triu_indices(6)] = state[7:28]
    covariance += np.triu(covariance, 1).T
    up = estimate.as_matrix()[2]
    turning = covariance[:3, :3] + constant_tilt * (np.eye(3) - np.outer(up, up))
    of_bias = bias - state[4:7]
    return (
        _square(error, turning),
        float((up @ error) ** 2 / (up @ turning @ up)),
        _square(of_bias, covariance[3:, 3:]),
    )


def _square(error: np.ndarray, covariance: np.ndarray) -> float:
    """The square of an error (k,) by its covariance (k, k)."""
    scale = np.sqrt(np.diag(covariance))
    return float(
        error / scale @ np.linalg.solve(covariance / np.outer(scale, scale), error / scale)
    )
