"""The instants of samples whose stamps scatter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.signal import savgol_filter

from pyimu.errors import Finding
from pyimu.recording.recording import Recording

OVER = 10.0
"""s; a line is laid through the stamps of so long: an oscillator keeps its rate, a computer that
stamps what it gets does not keep its delay."""

LEAST = 8
"""Rows of a segment below which its stamps are left alone."""

TIMES = {False: "its stamps", True: "even times"}

SURE = 5.0
"""Standard errors by which a share of stamps that are right and one of even times are apart."""

SCATTER = 0.01
"""Root mean square of the stamps about the line, in periods, below which they are taken as they
are."""


def even_times(recording: Recording) -> np.ndarray | None:
    """The times (n,) s at which the samples of a recording were taken if they were so evenly, by
    the lines through their stamps; None where the stamps hardly scatter about these.
    """
    time, h = recording.time, recording.sample_period
    even = np.array(time)
    for a, b in recording.segments:
        if b - a < LEAST:
            continue
        grid = time[a] + h * np.arange(b - a)
        window = min(max(round(OVER / h), LEAST), b - a)
        window -= 1 - window % 2
        even[a:b] = grid + savgol_filter(time[a:b] - grid, window, 1, mode="interp")
    scatter = float(np.sqrt(np.mean((time - even) ** 2)))
    return even if scatter > SCATTER * h and np.all(np.diff(even) > 0) else None


def evenly_sampled(recording: Recording, values: np.ndarray) -> np.ndarray | None:
    """The even times (n,) s of the rows of a recording, whose stamps scatter, where ``values``
    (n, k) in these rows show that they were sampled so; None where they follow the stamps, or are
    too noisy to tell.

    Of values sampled at the stamps the second differences hold the slope times those of what the
    stamps are off; of values sampled evenly none of it. Noise in the slope would make the share
    small: that across other rows is the instrument (Fuller 1987, "Measurement Error Models",
    section 1.4).
    """
    even = even_times(recording)
    if even is None:
        return None
    h, sums = recording.sample_period, []
    for a, b in recording.segments:
        if b - a >= LEAST:
            v = values[a:b]
            near = (v[5:-1] - v[1:-5]) / (4 * h)
            far = (v[6:] - v[:-6]) / (6 * h)
            off = np.diff(recording.time[a:b] - even[a:b], 2)[2:-2, None]
            sums.append(np.stack([np.diff(v, 2, axis=0)[2:-2], near * off, far * off]))
    known = np.concatenate(sums, axis=1).reshape(3, -1) if sums else np.zeros((3, 0))
    bend, by, to = known[:, np.isfinite(known).all(axis=0)]
    power = float(to @ by)
    if power <= 0.0:
        return None
    share = float(to @ bend) / power
    std = float(np.linalg.norm(to * (bend - share * by))) / power
    return even if share < 0.5 and share + SURE * std < 1.0 else None


def at_times(recording: Recording, time: np.ndarray) -> Recording:
    """The recording with other times (n,) for its rows, and the gaps that it had."""
    gaps = np.array([a for a, _ in recording.segments[1:]], dtype=int)
    return replace(recording, time=time, period=recording.sample_period, gaps=gaps)


def jitter_of(
    recording: Recording, even: np.ndarray | None, sensor: bool, reference: bool
) -> Finding:
    """The finding that stamps scatter: about even times (n,), by how much, and which times were
    used for ``sensor`` and ``reference``: even ones where true.
    """
    off = recording.time - (recording.time if even is None else even)
    detail = {
        "rms": float(np.sqrt(np.mean(off**2))),
        "period": recording.sample_period,
        "sensor_at": TIMES[sensor],
        "reference_at": TIMES[reference],
    }
    return Finding("jitter", "time", len(off), detail)
