"""The band in which a derived reference can be trusted."""

from __future__ import annotations

import numpy as np

from pyimu.recording.quality.clipping import clipped

COHERENCE = 0.9
"""Squared coherence between gyro and reference above which the reference is trusted."""


LEAST_BAND = 1.0
"""Hz; the band of a reference that is trusted in none."""


FRAMES = (2.0, 1.0, 0.5)
"""s; lengths of the frames of the coherence estimate, the longest of which there are enough: a
resolution of 1 to 4 Hz."""


LEAST_FRAMES = 30
"""Least number of frames (three inputs explain 3/30 of noise by chance)."""


TOGETHER = 1 << 16
"""Numbers of which frames are transformed at once: as many as the cache holds."""


def trusted_band(
    time: np.ndarray, gyro: np.ndarray | None, rate: np.ndarray, limit: float
) -> float:
    """The highest frequency [Hz], at most ``limit``, up to which ``rate`` (n, 3) explains ``gyro``.

    ``gyro`` is (n, 3); ``rate`` may have columns behind these, of what may explain it, too.

    The share of the gyro's power that a linear filter of the reference's axes explains, the
    multiple coherence tr(S_gr S_rr^-1 S_rg) / tr(S_gg) (Bendat and Piersol 2010, chapter 7), must
    stay above ``COHERENCE``; weighting the axes by power leaves out those without motion, and using
    all axes at once makes it blind to an unknown mounting and to a constant delay. Frames with a
    missing or clipped sample are left out. At least ``LEAST_BAND``, or ``limit`` if that is less.
    """
    least = min(LEAST_BAND, limit)
    if gyro is None:
        return least
    axes = np.isfinite(rate).any(axis=0)
    unclipped = np.column_stack([np.where(clipped(column), np.nan, column) for column in gyro.T])
    frequency, share = coherence(time, unclipped[:, axes[: gyro.shape[1]]], rate[:, axes])
    if share is None:
        return least
    low = np.flatnonzero((share < COHERENCE) & (frequency >= least))
    band = frequency[max(low[0] - 1, 0)] if len(low) else frequency[-1]
    return float(min(max(band, least), limit))


def coherence(
    time: np.ndarray, y: np.ndarray, x: np.ndarray
) -> tuple[np.ndarray, np.ndarray | None]:
    """Frequencies (f,) Hz, and the share (f,) of the power of ``y`` that ``x`` explains.

    ``y`` is (n, p), ``x`` is (n, q).

    The share is None where there are too few frames.
    """
    for seconds in FRAMES:
        frequency, share, _ = passed(time, y, x, seconds, LEAST_FRAMES)
        if len(frequency):
            return frequency, share
    return np.zeros(0), None


def passed(
    time: np.ndarray, y: np.ndarray, x: np.ndarray, seconds: float, least: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same frequencies (f,) and share (f,), and the gain (f,) of the linear filter of ``x``
    that explains most of ``y``, sqrt(tr(S_yx S_xx^-1 S_xy) / tr(S_xx)); by frames of so many
    ``seconds``, empty where there are fewer than the ``least`` number.
    """
    period = float(np.median(np.diff(time)))
    both = np.column_stack([y, x])
    length, p = max(16, round(seconds / period)), y.shape[1]
    starts = _starts(time, both, length, period)
    if len(starts) < least:
        return np.zeros(0), np.zeros(0), np.zeros(0)
    s = _cross_spectra(both, starts, length)
    by_x = s[:, :p, p:] @ np.linalg.pinv(s[:, p:, p:], hermitian=True) @ s[:, p:, :p]
    explained, total, given = (
        np.trace(one, axis1=1, axis2=2).real for one in (by_x, s[:, :p, :p], s[:, p:, p:])
    )
    share = explained / np.where(total > 0, total, np.inf)
    gain = np.sqrt(np.maximum(explained, 0.0) / np.where(given > 0, given, np.inf))
    return np.fft.rfftfreq(length, period), share, gain


def _cross_spectra(values: np.ndarray, starts: np.ndarray, length: int) -> np.ndarray:
    """Sums (f, c, c) over frames of the products of the columns' transforms, the first conjugated;
    as many frames at once as the cache holds.
    """
    columns = np.ascontiguousarray(values.T)
    frames = np.lib.stride_tricks.sliding_window_view(columns, length, axis=1)
    window, many = np.hanning(length), max(1, TOGETHER // (length * len(columns)))
    s = np.zeros((length // 2 + 1, len(columns), len(columns)), dtype=complex)
    for first in range(0, len(starts), many):
        pieces = frames[:, starts[first : first + many]]
        pieces -= pieces.mean(axis=-1, keepdims=True)
        pieces *= window
        z = np.ascontiguousarray(np.fft.rfft(pieces).transpose(2, 0, 1))
        s += z.conj() @ z.transpose(0, 2, 1)
    return s


def _starts(time: np.ndarray, values: np.ndarray, length: int, period: float) -> np.ndarray:
    """First rows (k,) of half-overlapping frames without gap and without missing sample."""
    starts = np.arange(0, max(len(time) - length + 1, 0), length // 2)
    good = np.concatenate(([0], np.cumsum(~np.all(np.isfinite(values), axis=1))))
    whole = good[starts + length] == good[starts]
    regular = (
        np.abs(time[starts + length - 1] - time[starts] - (length - 1) * period) < 0.5 * period
    )
    return starts[whole & regular]
