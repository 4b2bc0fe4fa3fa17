"""What signals explain of one another by the few rows about each, taken out before any window.

The transform of a window of y(t - d) is that of y turned by the delay d, but for what enters and
leaves the window at its ends: a share d / T of it, T the window's length, which looks like noise.
Beside a reference of little noise that is more than the noise (leakage errors of a frequency
response: Pintelon and Schoukens 2012, "System Identification", chapter 2).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

REACH = 2
"""Rows either way: a band's rows are at least three times as many as its highest frequency, and a
sensor's delay or lag a row or two."""

SHIFTS = range(-REACH, REACH + 1)


@dataclass(frozen=True)
class Short:
    """What is ``beyond`` (m, k) what signals explain of k others by ``taps`` (signal, row, k)."""

    beyond: np.ndarray
    taps: np.ndarray

    def response(self, frequency: np.ndarray, signal: int, other: int) -> np.ndarray:
        """In-phase gain (f,) of a signal on another, at ``frequency`` in cycles a row."""
        return np.cos(2 * np.pi * np.outer(frequency, SHIFTS)) @ self.taps[signal, :, other]


def short_memory(
    left: np.ndarray, signals: list[np.ndarray], segments: list[tuple[int, int]], bad: np.ndarray
) -> Short:
    """What is beyond what ``signals`` (m,) explain of what is ``left`` (m, k), by least squares in
    the rows that are not ``bad`` (m,).

    The first and last rows of segments are not fitted, and worse than the others: windows fade out
    there.
    """
    rows = np.column_stack([_shifted(s, d, segments) for s in signals for d in SHIFTS])
    inside = np.zeros(len(left), dtype=bool)
    for a, b in segments:
        inside[a + REACH : b - REACH] = True
    inside &= ~bad
    count = rows.shape[1]
    if np.count_nonzero(inside) <= 2 * count:
        return Short(left, np.zeros((len(signals), len(SHIFTS), left.shape[1])))
    about = rows - rows[inside].mean(axis=0)
    taps = np.linalg.lstsq(about[inside], left[inside] - left[inside].mean(axis=0))[0]
    grown = np.sqrt(1.0 + count / (np.count_nonzero(inside) - count))
    shape = len(signals), len(SHIFTS), left.shape[1]
    return Short((left - about @ taps) * grown, taps.reshape(shape))


def _shifted(signal: np.ndarray, by: int, segments: list[tuple[int, int]]) -> np.ndarray:
    """A signal (m,) so many rows later, its first or last row held at the ends of segments."""
    out = np.array(signal)
    for a, b in segments:
        out[a:b] = signal[np.clip(np.arange(a, b) - by, a, b - 1)]
    return out
