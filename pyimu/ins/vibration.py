"""A body that vibrates at rest, as one with an engine does: its motion without the vibration.

An engine shakes a body to and fro at some tens of hertz. A sample of that is far beyond the
sensor's noise, beside which nothing rests then, while next to nothing is left of its mean over some
tenths of a second: taken for white noise of its size, it hides slow turns and gentle pushes. So it
is taken out. Behind a Gaussian low-pass the body moves as it does below some hertz, the noise has
its density at 0 Hz, and samples ``APART`` are those of a white noise again, but for lines of more
than half the sample rate, which seem to be slow: what of them is left is known of the rest before
it (``whitened``).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.linalg import solve_toeplitz
from scipy.ndimage import gaussian_filter1d

from pyimu.attitude.columns import NOISIER
from pyimu.attitude.rest import Rest, white_std
from pyimu.errors import Finding
from pyimu.ins.noise import Noise
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording, at_own_times, filled
from pyimu.recording.rest import rests

WIDTH = 0.03
"""s; standard deviation of the low-pass. It leaves a third at 8 Hz and 1e-3 at 20 Hz: what turns
and speeds up a vehicle is slower, an engine that idles faster."""

APART = 0.1
"""s; over which white noise behind it correlates by exp(-(APART / WIDTH)^2 / 4), 6 %."""

BAND = 1 / (2 * np.sqrt(np.pi) * WIDTH)
"""Hz, two-sided; the noise bandwidth of the low-pass."""

AT_REST = 0.3
"""s; the same as ``WIDTH`` for the samples of a rest, whose means alone count."""

LEAST_ROWS = 4
"""Samples in ``APART`` at least: with fewer there is hardly anything above the low-pass."""

ORDER = 6
"""Of the autoregression of what the low-pass leaves: two lines and what is white."""

FEWEST = 5 * ORDER
"""Of its samples at rest, from which it can be told."""


@dataclass(frozen=True)
class Vibration:
    """What shakes a body at rest: root mean squares of an axis, ``rate`` in rad/s and ``force`` in
    m/s^2.
    """

    rate: float
    force: float

    @property
    def finding(self) -> Finding:
        return Finding("shakes_at_rest", "", 1, {"rate": self.rate, "force": self.force})


def vibration_of(recording: Recording) -> Vibration | None:
    """What shakes a body wherever it may rest; None of one that rests without.

    Where it may rest is told by what is slow. In each second of that an axis must be shaken by more
    than ``NOISIER`` times the white noise that slow samples show: a body that is ever still is one
    that vibrates as it moves. Where nothing but that is seen, it may as well be one even drive.
    """
    if recording.sample_period * LEAST_ROWS > APART:
        return None
    calm = without_vibration(recording)
    slow, rows = slower(calm)
    found = rests(slow)
    second = round(1 / recording.sample_period)
    starts = [k for a, b in found for k in range(a * rows, b * rows - second + 1, second)]
    moves = len(recording) - rows * sum(b - a for a, b in found) > 2 * second
    if not starts or not moves:
        return None
    sizes, beyond = [], []
    for kind in ("gyro", "accel"):
        fast = getattr(recording, kind) - getattr(calm, kind)
        white = [white_std(getattr(slow, kind)[a:b]) ** 2 for a, b in found]
        noise = np.sqrt(np.nanmean(white, axis=0) / (BAND * recording.sample_period))
        shaken = np.array([np.nanstd(fast[k : k + second], axis=0) for k in starts])
        sizes.append(float(np.sqrt(np.nanmean(shaken**2))))
        beyond.append(shaken / np.maximum(noise, 1e-12))
    shakes = np.hstack(beyond).max(axis=1) > NOISIER
    return Vibration(*sizes) if shakes.all() else None


@dataclass(frozen=True)
class Samples:
    """A recording as it is looked for rests: ``calm``, without what shakes the body at rest, and of
    that ``seen``, one in so many ``rows``; where nothing shakes it, as it is.
    """

    vibration: Vibration | None
    calm: Recording
    seen: Recording
    rows: int

    @classmethod
    def of(cls, recording: Recording, may_shake: bool) -> Samples:
        vibration = vibration_of(recording) if may_shake else None
        if vibration is None:
            return cls(None, recording, recording, 1)
        calm = without_vibration(recording)
        return cls(vibration, calm, *slower(calm))

    @property
    def findings(self) -> list[Finding]:
        return [] if self.vibration is None else [self.vibration.finding]

    def white(self, rest: Rest, noise: Noise) -> tuple[Recording, Noise]:
        """What is seen with white noise at rest, and the size of that."""
        return (self.seen, noise) if self.vibration is None else whitened(self.seen, rest, noise)

    def without(self, recording: Recording, still: np.ndarray) -> Recording:
        """Another form of the recording without the vibration; ``still`` (n,) marks its rests."""
        return recording if self.vibration is None else without_vibration(recording, still)


def without_vibration(recording: Recording, still: np.ndarray | None = None) -> Recording:
    """The recording with gyro and accelerometer behind the low-pass; what is missing stays so.

    Where it is ``still`` (n,) they are means of the rest, over ``AT_REST``.
    """
    period = recording.sample_period
    slow: dict[str, Any] = {}
    for kind in ("gyro", "accel"):
        values: np.ndarray = getattr(recording, kind)
        whole, slow[kind] = filled(recording.time, values), np.empty(values.shape)
        for a, b in recording.segments:
            slow[kind][a:b] = _low_passed(whole[a:b], WIDTH / period)
        for a, b in [] if still is None else runs(still):
            slow[kind][a:b] = _low_passed(whole[a:b], AT_REST / period)
        slow[kind][~np.isfinite(values)] = np.nan
    return replace(recording, **slow)


def _low_passed(values: np.ndarray, width: float) -> np.ndarray:
    """Values (n, 3) behind a Gaussian of a ``width`` in rows, of those there are."""
    weight = gaussian_filter1d(np.ones(len(values)), width, mode="constant")
    return gaussian_filter1d(values, width, axis=0, mode="constant") / weight[:, None]


def slower(recording: Recording) -> tuple[Recording, int]:
    """One in so many rows, their middle, ``APART`` from the next, and how many they are."""
    rows = max(1, int(APART / recording.sample_period + 1e-6))
    at = slice(min(rows // 2, len(recording) - 1), None, rows)
    groups = ("gyro", "accel", "stationary", "speed")
    own: dict[str, Any] = {g: recording.groups[g][at] for g in groups if g in recording.groups}
    return at_own_times(recording, recording.time[at], **own), rows


def faster(marks: np.ndarray, rows: int, count: int) -> np.ndarray:
    """Marks (count,) of rows of which those (m,) are one in so many ``rows``."""
    return marks[np.minimum(np.arange(count) // rows, len(marks) - 1)]


def whitened(recording: Recording, rest: Rest, noise: Noise) -> tuple[Recording, Noise]:
    """The recording with white noise at rest, and the size of that where it is above ``noise``.

    An autoregression tells a sample at rest from those before it (Yule and Walker; Box, Jenkins and
    Reinsel 2008, section 3.2.3), and what it does not tell is white. Divided by its sum, the filter
    leaves a constant as it is: the noise of a mean is then that of the spectrum at 0 Hz. The rest
    is that at the start, else wherever it may be.
    """
    parts = [(rest.rows.start, rest.rows.stop)] if rest.seen else rests(recording)
    if sum(b - a for a, b in parts) < FEWEST:
        return recording, noise
    white: dict[str, Any] = {}
    stds: dict[str, Any] = {}
    for kind, name in (("gyro", "rate"), ("accel", "force")):
        values = getattr(recording, kind)
        white[kind] = _filtered(values, _whitening([values[a:b] for a, b in parts]))
        left = np.vstack([_without_mean(white[kind][a:b]) for a, b in parts])
        stds[name] = np.fmax(getattr(noise, name), np.sqrt(np.nanmean(left**2, axis=0)))
    return replace(recording, **white), replace(noise, **stds)


def _without_mean(values: np.ndarray) -> np.ndarray:
    return values - np.nanmean(values, axis=0)


def _whitening(parts: list[np.ndarray]) -> np.ndarray:
    """The filter (k,) that makes the noise of ``parts`` (n, 3) white and leaves their means."""
    own = [np.nan_to_num(_without_mean(part)) for part in parts]
    size = np.fmax(np.sum([np.sum(p**2, axis=0) for p in own], axis=0), 1e-30)
    lags = [
        np.mean(np.sum([np.sum(p[k:] * p[: len(p) - k], axis=0) for p in own], axis=0) / size)
        for k in range(ORDER + 1)
    ]
    taps = np.append(1.0, -solve_toeplitz(lags[:-1], lags[1:]))
    return taps / taps.sum()


def _filtered(values: np.ndarray, taps: np.ndarray) -> np.ndarray:
    """Values (n, 3) behind a filter, moved back by the delay of what is slow."""
    last = len(taps) - 1
    late = int(np.clip(round(float(np.arange(last + 1) @ taps)), 0, last))
    whole = np.pad(values, ((last - late, late), (0, 0)), mode="edge")
    return np.stack([np.convolve(column, taps, "valid") for column in whole.T], axis=1)
