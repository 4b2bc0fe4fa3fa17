"""Up to which frequency samples of places show a motion, and beyond it their own noise alone.

That noise rises with the frequency as often as they are differentiated: where nothing moves any
more it is hundreds of times what a sensor shows below. Looked up between the samples its images
fold into rows, and turned into the body's axes by attitudes with noise of their own, it comes down
into what is slow.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.signal.windows import hann

FRAME = 2.0
"""s; of the frames of the spectrum: it is told to half a hertz."""

FEWEST = 8
"""Frames below which nothing is said: of their mean a third of an octave scatters by a quarter at
most where it is of two frequencies, and by less above."""

MOTION = 2.0
"""Times the least density of the samples that a density must be to show a motion."""

ROOM = 1.5
"""Times the highest frequency of a motion up to which nothing is taken out: a low-pass begins to
damp well below its cutoff."""


def shown_up_to(pieces: Sequence[np.ndarray], period: float, order: int) -> float:
    """The frequency [Hz] above which samples (n, d) of places in ``pieces``, ``period`` s apart,
    show nothing but white noise on any axis; infinite where that is not seen. ``order`` is how
    often they are to be differentiated, which makes the spectrum flat enough to be read.
    """
    length = round(FRAME / period)
    frames = [f for p in pieces for f in _frames(np.diff(p, n=order, axis=0), length)]
    if len(frames) < FEWEST or length < 2 * FEWEST:
        return np.inf
    power = np.mean([np.abs(np.fft.rfft(f, axis=0)) ** 2 for f in frames], axis=0)
    frequency = np.fft.rfftfreq(length, period)
    # Of white noise the same everywhere.
    shape = (2.0 * np.sin(np.pi * frequency[1:] * period)) ** (2 * order)
    ends = _thirds(len(frequency))
    level = np.add.reduceat(power[1:] / shape[:, None], ends[:-1] - 1, axis=0)
    level /= np.diff(ends)[:, None]
    moves = np.any(level > MOTION * level.min(axis=0), axis=1)
    last = int(np.flatnonzero(moves).max(initial=0))
    highest = ROOM * frequency[ends[last + 1] - 1]
    return float(highest) if highest < frequency[-1] else np.inf


def _frames(values: np.ndarray, length: int) -> list[np.ndarray]:
    """Frames (length, d) of values (n, d), half of each in the next, through a Hann window."""
    window = hann(length, sym=False)[:, None]
    starts = range(0, len(values) - length + 1, max(1, length // 2))
    return [window * (v - v.mean(axis=0)) for v in (values[s : s + length] for s in starts)]


def _thirds(count: int) -> np.ndarray:
    """Where thirds of an octave begin among frequencies 1 to ``count`` - 1 times the lowest, and
    the last one ends.
    """
    ends = [1]
    while ends[-1] < count:
        ends.append(min(count, max(ends[-1] + 1, round(ends[-1] * 2 ** (1 / 3)))))
    return np.array(ends)
