"""By how much gyro and accelerometer of measured recordings are late against their reference.

``python benchmarks/sensor_timing.py [--data FOLDER]``, with the recordings of BROAD (Laidig,
Caruso, Cereatti and Seel 2021), whose reference has attitude and position. The gyro is compared
with the rate of the reference's attitude at an instant, the accelerometer with the second
derivative of its positions and gravity, turned by its attitude; the matrix and bias that fit best,
and for the accelerometer its place against the positions', are fitted beside the delay. Printed in
ms: both delays, that of the filter's estimate, which is half a period less than the gyro's
(``pyimu.attitude.filter.timing``), and by how much the accelerometer is later than that.

Last, in ms with its standard error, the same from gyro and accelerometer alone: what a regression
of the force on rate times gravity says, beside a lever arm, a bias and a drift, in segments of 4 s.
It has the motion's own acceleration for an error wherever that goes along with the rate, which no
scatter shows: it is not used.
"""

from __future__ import annotations

import numpy as np
from attitude_real import SCORED, folder, moving_rows
from scipy.optimize import minimize_scalar
from scipy.signal import butter, filtfilt, savgol_filter
from scipy.spatial.transform import Rotation, Slerp

import pyimu
from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY

CUTOFF = 10.0
"""Hz; both sides of a comparison are seen through the same low-pass of no delay."""

FILTERED = 31
"""Rows of the polynomials of fourth order by which positions are differentiated."""

LATEST = 0.02
"""s."""

SEGMENT, BLOCK = 4.0, 1 / 60
"""s; of a segment of the regression, and over which its samples are averaged."""


def main() -> None:
    paths = [folder() / f"{name}.csv.gz" for name in SCORED]
    if missing := [p.name for p in paths if not p.exists()]:
        print(f"{', '.join(missing)} not in {folder()}: --data FOLDER says where they are")
        return
    print(
        f"{'late, in ms':52s}{'gyro':>8s}{'accel':>8s}{'estimate':>9s}{'accel to it':>12s}   alone"
    )
    found = []
    for path in paths:
        log = pyimu.read_recording(path)
        gyro, accel = delays(log)
        estimate = gyro - log.sample_period / 2
        found.append(1e3 * np.array([gyro, accel, estimate, accel - estimate]))
        alone, std = (1e3 * v for v in by_gravity(log))
        print(
            f"{path.name.split('.')[0]:52s}{_row(found[-1])}{alone:8.1f} +- {std:.1f}", flush=True
        )
    print(f"{'mean':52s}{_row(np.mean(found, axis=0))}")
    print(f"{'standard deviation over the recordings':52s}{_row(np.std(found, axis=0, ddof=1))}")


def _row(ms) -> str:
    return "{:8.2f}{:8.2f}{:9.2f}{:12.2f}".format(*ms)


def delays(log: Recording) -> tuple[float, float]:
    """By how many s gyro and accelerometer are later than the reference."""
    h, rows = log.sample_period, np.arange(len(log.time))
    track = np.column_stack([log.ref_east, log.ref_north, log.ref_up])
    seen = np.isfinite(log.ref_q).all(axis=1) & np.isfinite(track).all(axis=1)
    known, within = rows[seen], np.clip(rows, rows[seen][0], rows[seen][-1])
    attitude = Slerp(known, Rotation.from_quat(log.ref_q[seen], scalar_first=True))(within)
    track = np.column_stack([np.interp(within, known, v[seen]) for v in track.T])
    far = np.convolve(~seen, np.ones(2 * FILTERED - 1), "same") < 0.5
    used = far & moving_rows(log)
    turns = (attitude[:-2].inv() * attitude[2:]).as_rotvec() / (2 * h)
    rate = _smooth(np.vstack([turns[:1], turns, turns[-1:]]), h)
    moved = savgol_filter(track, FILTERED, 4, deriv=2, delta=h, axis=0)
    force = attitude.inv().apply(_smooth(moved + [0, 0, STANDARD_GRAVITY], h))
    lever = _lever(np.gradient(rate, h, axis=0), rate)
    none = np.zeros((len(rows), 3, 0))
    return (
        _latest(_smooth(log.gyro, h), rate, none, used, h),
        _latest(_smooth(log.accel, h), force, lever, used, h),
    )


def _smooth(values: np.ndarray, h: float) -> np.ndarray:
    return filtfilt(*butter(3, CUTOFF * 2 * h), values, axis=0)


def _lever(change: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """The accelerations (..., 3, 3) of points at a metre on each axis, a column each."""
    ends = (np.cross(change, e) + np.cross(rate, np.cross(rate, e)) for e in np.eye(3))
    return np.stack(list(ends), axis=-1)


def _latest(measured, true, lever, used, h: float) -> float:
    """The delay in s of the ``measured`` against the ``true`` values, both (n, 3).

    Beside it a matrix, a bias and the coefficients of ``lever`` (n, 3, m) are fitted.
    """
    rows, m = np.arange(len(true)), lever.shape[-1]
    right = measured[used].T.ravel()

    def left(delay: float) -> float:
        def late(v):
            return np.interp(rows - delay / h, rows, v)[used]

        own = np.column_stack([*(late(v) for v in true.T), np.ones(used.sum())])
        beside = [
            np.column_stack([late(lever[:, i, j]) for j in range(m)] or [own[:, :0]])
            for i in range(3)
        ]
        left_over = [v - own @ np.linalg.lstsq(own, v)[0] for v in (*np.split(right, 3), *beside)]
        y, x = np.concatenate(left_over[:3]), np.vstack(left_over[3:])
        return float(np.sum((y - x @ np.linalg.lstsq(x, y)[0]) ** 2)) if m else float(y @ y)

    return minimize_scalar(left, bounds=(-LATEST, LATEST), method="bounded").x


def by_gravity(log: Recording) -> tuple[float, float]:
    """By how many s the accelerometer is later than the attitude of the integrated gyro.

    The slopes of the segments by their information, and the error by their scatter.
    """
    h = log.sample_period
    block = round(BLOCK / h)
    length = round(SEGMENT / h / block) * block
    parts = [slice(i, i + length) for i in range(0, len(log.time) - length, length)]
    information, score = np.transpose([_segment(log, rows, block) for rows in parts])
    slope = score.sum() / information.sum()
    left = score - information * slope
    return slope, float(np.sqrt(np.sum(left**2)) / information.sum())


def _segment(log: Recording, rows: slice, block: int) -> tuple[float, float]:
    """The information of a segment on the delay, 1/s^2, and that times the delay, 1/s."""
    h, now, later = log.sample_period, log.gyro[rows], log.gyro[rows.start + 1 : rows.stop + 1]
    turns, attitude = Rotation.from_rotvec(h * now), [Rotation.identity()]
    for turn in turns:
        attitude.append(attitude[-1] * turn)
    matrix = Rotation.concatenate(attitude[1:]).as_matrix()
    rate = (now + later) / 2
    force = np.einsum("nij,nj->ni", matrix, log.accel[rows])
    late = np.cross(np.einsum("nij,nj->ni", matrix, rate), force.mean(axis=0))
    lever = matrix @ _lever((later - now) / h, rate)
    drift = np.linspace(-1, 1, len(now))[:, None, None] * np.eye(3)
    constant = np.broadcast_to(np.eye(3), drift.shape)
    beside = np.concatenate([constant, drift, lever, matrix], axis=-1)
    beside, late, force = (
        v.reshape(-1, block, 3, v.shape[-1] if v.ndim == 3 else 1).mean(axis=1)
        for v in (beside, late, force)
    )
    x, y, others = (v.reshape(-1, v.shape[-1]) for v in (late, force, beside))
    basis = np.linalg.svd(others, full_matrices=False)[0]
    x, y = (v - basis @ (basis.T @ v) for v in (x, y))
    left = y - x * (np.sum(x * y) / np.sum(x * x))
    weight = len(y) / np.sum(left**2)
    return float(weight * np.sum(x * x)), float(weight * np.sum(x * y))


if __name__ == "__main__":
    main()
