"""A plain multiplicative extended Kalman filter of attitude and gyro bias, the textbook's peer.

Lefferts, Markley and Shuster 1982; gravity as in Groves 2013, section 14.2. Nothing in it adapts:
it is told how much the body accelerates and for how long, and takes that for white noise of the
same density.
"""

from __future__ import annotations

import numba
import numpy as np


def mekf(log, n: float, k: float, n_accel: float, pushed: tuple[float, float], gravity: float):
    """Attitude (m, 4) of a log whose first half second is at rest or nearly."""
    h = float(np.median(np.diff(log.time)))
    size, lasting = pushed
    variance = n_accel**2 / h + 2 * size**2 * lasting / h
    heading = log.heading.get("heading", np.full(len(log.time), np.nan))
    std = log.heading.get("heading_std", np.full(len(log.time), np.nan))
    first = np.nanmean(log.accel[: round(0.5 / h)], axis=0)
    resting = np.nanmean(log.gyro[: round(2.0 / h)], axis=0)
    return _run(
        np.nan_to_num(log.gyro), log.accel, heading, std, first, resting, h, n, k, variance, gravity
    )


@numba.njit(cache=True)
def _run(gyro, accel, heading, std, first, resting, h, n, k, variance, gravity):
    f = first / np.linalg.norm(first)
    roll, pitch = np.arctan2(f[1], f[2]), np.arctan2(-f[0], np.hypot(f[1], f[2]))
    yaw = heading[0] if np.isfinite(heading[0]) else 0.0
    r = _euler(roll, pitch, yaw)
    bias, p, out = resting.copy(), np.zeros((6, 6)), np.empty((len(gyro), 4))
    for i in range(3):
        p[i, i], p[i + 3, i + 3] = 0.05**2, 0.01**2
    gain = np.zeros((6, 3))
    for row in range(len(gyro)):
        angle = (gyro[row] - bias) * h
        turn = _turn(angle)
        r = r @ turn
        a = np.zeros((6, 6))
        a[:3, :3] = turn.T
        for i in range(3):
            a[i, i + 3] = -h
            a[i + 3, i + 3] = 1.0
        p = a @ p @ a.T
        for i in range(3):
            p[i, i] += n * n * h
            p[i + 3, i + 3] += k * k * h
        if np.isfinite(accel[row].sum()):
            up = np.ascontiguousarray(r[2])
            slope = np.zeros((3, 6))
            slope[:, :3] = gravity * _cross(up)
            s = slope @ p @ slope.T + variance * np.eye(3)
            gain = p @ slope.T @ np.linalg.inv(s)
            r, bias, p = _corrected(r, bias, p, gain, slope, accel[row] - gravity * up)
        if np.isfinite(heading[row]):
            up = np.ascontiguousarray(r[2])
            line = np.zeros((1, 6))
            line[0, :3] = up
            s = (line @ p @ line.T)[0, 0] + std[row] ** 2
            own = p @ line.T / s
            left = heading[row] - np.arctan2(r[1, 0], r[0, 0])
            left = (left + np.pi) % (2 * np.pi) - np.pi
            r, bias, p = _corrected(r, bias, p, own, line, np.array([left]))
        out[row] = _quaternion(r)
    return out


@numba.njit(cache=True)
def _corrected(r, bias, p, gain, slope, innovation):
    change = gain @ innovation
    p = p - gain @ slope @ p
    return r @ _turn(change[:3]), bias + change[3:], 0.5 * (p + p.T)


@numba.njit(cache=True)
def _cross(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


@numba.njit(cache=True)
def _turn(angle):
    size = np.sqrt(angle @ angle)
    a = _cross(angle)
    if size < 1e-9:
        return np.eye(3) + a
    return np.eye(3) + np.sin(size) / size * a + (1 - np.cos(size)) / size**2 * (a @ a)


@numba.njit(cache=True)
def _euler(roll, pitch, yaw):
    cr, sr, cp, sp = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch)
    cy, sy = np.cos(yaw), np.sin(yaw)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


@numba.njit(cache=True)
def _quaternion(r):
    """By the largest of the four, which is never small (Shepperd 1978)."""
    squares = np.array(
        [
            1 + r[0, 0] + r[1, 1] + r[2, 2],
            1 + r[0, 0] - r[1, 1] - r[2, 2],
            1 - r[0, 0] + r[1, 1] - r[2, 2],
            1 - r[0, 0] - r[1, 1] + r[2, 2],
        ]
    )
    most = np.argmax(squares)
    d = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    s = np.array([r[1, 0] + r[0, 1], r[0, 2] + r[2, 0], r[2, 1] + r[1, 2]])
    if most == 0:
        q = np.array([squares[0], d[0], d[1], d[2]])
    elif most == 1:
        q = np.array([d[0], squares[1], s[0], s[1]])
    elif most == 2:
        q = np.array([d[1], s[0], squares[2], s[2]])
    else:
        q = np.array([d[2], s[1], s[2], squares[3]])
    return q / np.linalg.norm(q)
