"""How far the clock of a reference is from that of a log, where nothing but their turns tells."""

from __future__ import annotations

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.spatial.transform import Rotation

from pyimu.recording.recording import Recording

PERIOD = 0.05
"""s; the sizes of the two rates are compared in means over so long."""

OVERLAP = 0.5
"""Share of the shorter of the two that both must have."""

LEAST = 100
"""Periods that both must have."""

ALIKE = 0.8
"""Correlation from which on two turn alike."""

LONGEST = 10**7
"""Periods, six days: of longer logs one of the times is none."""

NEAR = 2.0
"""s; offsets nearer than that to the best one belong to its peak."""


def time_apart(log: Recording, reference: Recording) -> float | None:
    """s to add to the times of ``reference`` so that it turns when ``log`` does.

    The size of the rate counts, which no mounting changes. None where it is not known of both, and
    where they turn alike at no offset, or at several.
    """
    known, own = sizes_of_rate(reference), _own_sizes(log)
    if known is None or own is None:
        return None
    if max(np.ptp(known[0]), np.ptp(own[0])) > LONGEST * PERIOD:
        return None
    (x, mx), (y, my) = _in_periods(*known), _in_periods(*own)
    least = max(LEAST, OVERLAP * min(mx.sum(), my.sum()))
    lags = np.arange(1 - len(x), len(y))
    r = correlations(x, mx, y, my, lags, least)
    best = int(np.argmax(r))
    others = r[np.abs(lags - lags[best]) * PERIOD > NEAR].max(initial=0.0)
    if r[best] < ALIKE or 1 - r[best] > 0.5 * (1 - others):
        return None
    return float(own[0][0] - known[0][0] + lags[best] * PERIOD)


def sizes_of_rate(reference: Recording) -> tuple[np.ndarray, np.ndarray] | None:
    """Times (m,) s and sizes (m,) rad/s of the rate that a reference shows there; None for one
    without an attitude or a rate.
    """
    time, rate, q = reference.time, reference.ref_rate, reference.ref_q
    if rate is not None:
        seen = np.isfinite(rate).all(axis=1)
        return (time[seen], np.linalg.norm(rate[seen], axis=1)) if seen.sum() > 1 else None
    seen = None if q is None else np.flatnonzero(np.isfinite(q).all(axis=1))
    if seen is None or len(seen) < 2:
        return None
    attitude = Rotation.from_quat(q[seen], scalar_first=True)
    turned = (attitude[:-1].inv() * attitude[1:]).magnitude()
    return time[seen[1:]], turned / np.diff(time[seen])


def correlations(
    x: np.ndarray, mx: np.ndarray, y: np.ndarray, my: np.ndarray, lags: np.ndarray, least: float
) -> np.ndarray:
    """Correlation of ``x`` (n,) with ``y`` (m,) ``lags`` (k,) rows later, over the rows that both
    have by ``mx`` (n,) and ``my`` (m,), 1 or 0; -1 where these are fewer than ``least``.
    """
    size = next_fast_len(len(x) + len(y))
    x, y = ((v - v[m > 0].mean()) * m for v, m in ((x, mx), (y, my)))

    def cross(a, b):
        return irfft(np.conj(rfft(a, size)) * rfft(b, size), size)[lags % size]

    pairs = np.maximum(cross(mx, my), 1.0)
    power = cross(x * x, my) * cross(mx, y * y) / pairs**2
    covariance = cross(x, y) / pairs
    enough = pairs > least
    return np.where(enough, covariance / np.sqrt(np.maximum(power, 1e-300)), -1.0)


def _own_sizes(log: Recording) -> tuple[np.ndarray, np.ndarray] | None:
    """Times (m,) s of the samples of a log's gyro, and the sizes (m,) rad/s of its rate less the
    median; None without any.
    """
    seen = np.zeros(0, dtype=bool) if log.gyro is None else np.isfinite(log.gyro).all(axis=1)
    if not seen.any():
        return None
    rate = log.gyro[seen]
    return log.time[seen], np.linalg.norm(rate - np.median(rate, axis=0), axis=1)


def _in_periods(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Means (k,) of ``values`` (n,) over each period from the first time on, and 1 or 0 (k,) by
    whether there are any in it.
    """
    at = ((time - time[0]) / PERIOD).astype(int)
    count = np.bincount(at)
    return np.bincount(at, values) / np.maximum(count, 1), (count > 0).astype(float)
