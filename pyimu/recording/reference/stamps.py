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
