"""What a filter makes of a rate, and of the attitudes of a body that turns at it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.signal import butter, lfilter, sosfiltfilt
from scipy.spatial.transform import Rotation

from pyimu.recording.integration import integrated
from pyimu.recording.reference.attitude import one_sign
from pyimu.recording.reference.sampling import through

ORDER, PERIODS = 8, 12
"""Of the low-pass, and how many half periods of its cutoff it is led in over; run both ways it
takes 3e-5 of what is an octave below its cutoff."""

Filter = Callable[[np.ndarray], np.ndarray]
"""Of values (n, k), evenly apart."""


def seen_through(of: Filter, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
    """What is seen of a ``rate`` (n, 3) rad/s, ``h`` s apart, where its axes go through a filter,
    or the entries of the quaternions (n, 4) do that the body has ``turned`` by, before they are
    made unit quaternions again. From where it starts makes no difference: filters are linear.
    """
    return of(rate) if turned is None else seen_as(units(of(turned)), turned, rate, h)


def seen_as(q: np.ndarray, turned: np.ndarray, rate: np.ndarray, h: float) -> np.ndarray:
    """The rate (n, 3) of attitudes ``q`` (n, 4), ``h`` s apart, that became of those by which a
    body has ``turned`` at a ``rate``.
    """
    change = rate_of(q, h) - rate_of(turned, h)
    # The mean over two steps damps by (w h)^2 / 6 of it.
    change[1:-1] -= np.diff(change, 2, axis=0) / 6.0
    return rate + change


def low_passed(values: np.ndarray, rows: float) -> np.ndarray:
    """Values (n, k) behind a low-pass filter of first order with a time constant of so many
    ``rows``; what came before the first was like it.
    """
    # The filter's answer to lines from row to row, which are less than what is quick by w^2 / 12.
    values = np.array(values)
    values[1:-1] -= np.diff(values, 2, axis=0) / 12.0
    kept = np.exp(-1.0 / rows)
    mean = rows * (1.0 - kept)
    taps = [1.0 - mean, mean - kept]
    return lfilter(taps, [1.0, -kept], values, axis=0, zi=mean * values[:1])[0]


def below(values: np.ndarray, share: float) -> np.ndarray:
    """What values (n, k), evenly apart, have below a cutoff, a ``share`` of half their rate.

    Beyond the ends they are mirrored, not turned about the last of them: what was differentiated is
    mostly noise from row to row, and all that is about an end would go with the noise of that one
    row.
    """
    room = min(len(values) - 1, round(PERIODS / share))
    if share >= 1.0 or room <= 0:
        return np.array(values)
    low = butter(ORDER, share, output="sos")
    return sosfiltfilt(low, values, axis=0, padtype="even", padlen=room)


def below_hz(
    values: np.ndarray, segments: Sequence[tuple[int, int]], h: float, cutoff: float
) -> np.ndarray:
    """What values (n, k), ``h`` s apart, have below a ``cutoff`` in Hz, in each of ``segments``."""
    out = np.array(values)
    if cutoff < 0.5 / h:
        for a, b in segments:
            out[a:b] = below(values[a:b], 2.0 * h * cutoff)
    return out


def turned_by(rate: np.ndarray, h: float) -> np.ndarray:
    """Quaternions (n, 4) of a body that turns at ``rate`` (n, 3) rad/s, ``h`` s apart, without
    jumps of sign.

    A step is the integral of a spline of fifth degree, and what the axis turns by within it,
    h^2/12 w x w_next (Bortz 1971).
    """
    means = np.array(rate)
    if len(rate) > 2:
        means[1:] = np.diff(turns_of(rate)(np.arange(len(rate))), axis=0)
        means[1:] += h / 12.0 * np.cross(rate[:-1], rate[1:])
    return one_sign(integrated(means, h, Rotation.identity()).as_quat(scalar_first=True))


def turns_of(rate: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """The integral (m, 3) of a ``rate`` (n, 3) up to rows (m,), whole or not, in rows: a spline of
    fifth degree damps what comes with five rows a period by 0.03 %.
    """
    return through(np.arange(float(len(rate))), rate, 5).antiderivative()


def rate_of(q: np.ndarray, h: float) -> np.ndarray:
    """Rates (n, 3) rad/s of quaternions ``h`` s apart, as the mean of both steps beside each, less
    what its axis turns by within these.
    """
    (w, v), (w1, v1) = ((p[:, :1], p[:, 1:]) for p in (q[:-1], q[1:]))
    half = w * v1 - w1 * v - np.cross(v, v1)
    size = np.linalg.norm(half, axis=1, keepdims=True)
    cosine = np.sum(q[:-1] * q[1:], axis=1, keepdims=True)
    steps = half * 2.0 / h * np.arctan2(size, cosine) / np.maximum(size, 1e-300)
    before, after = np.vstack([steps[:1], steps]), np.vstack([steps, steps[-1:]])
    return 0.5 * (before + after) - h / 12.0 * np.cross(before, after)


def units(q: np.ndarray) -> np.ndarray:
    """Quaternions (n, 4) of length one."""
    return q / np.linalg.norm(q, axis=1, keepdims=True)
