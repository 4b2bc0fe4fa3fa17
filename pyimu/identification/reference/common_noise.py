"""Whether a reference has the gyro's own noise in it: it was computed from this gyro then.

Where nothing moves two instruments have nothing in common, whatever noise each has; what was made
of the gyro has its noise, smoothed or with other noise beside it. In the quietest windows, and at
the frequencies at which the gyro shows no more than its white noise, the part of its signal that
the reference has is near zero of another instrument, and of its own output what a smoother leaves.
That part is S_yu / S_yy, a gain, of which noise of the reference is no part; it scatters by that.

A rate that was measured beside the gyro shows what shakes both, and where that looks like white
noise nothing tells it from the gyro's. But the gyro has noise of its own beside it, so that the
gain is clearly below one; of what was made of it, it is one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.fft import rfft
from scipy.signal.windows import hann

from pyimu.identification.fit.sample_noise import rest_density
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.same_output import LEAST as LEAST_NOISE
from pyimu.model.kinds import OWN

SECONDS = 1.0
"""Length of the windows; the quietest quarter of them is looked at."""

LEAST = 16
"""Quiet windows that there must be."""

LOWEST, HIGHEST = 2.0, 0.45
"""Hz, and share of the sample rate, between which is looked, by octaves: below, windows have less
than the mean of them and its leakage leave."""

INDEPENDENT = 0.66
"""Values of which two neighbours in a Hann window's spectrum are worth one each."""

NOISE = 0.5, 1.4
"""Times the white noise between which the gyro's signal lies, on each axis, where it is noise
alone: of a motion in it another instrument shows 0.4 / 1.4 = 0.29 at most."""

OCTAVES = 2
"""Octaves in which it must be so: what is left of a motion falls by more from one to the next."""

SHOWN = 0.5
"""Gain that is exceeded by three standard errors where a reference has the gyro's noise."""

KNOWN = 0.1, 0.02
"""Standard errors of the gain, of an attitude on all axes together and of a measured rate on each,
from which on it is known: of no gain the mean size on three axes is 2.2 of the former."""

SURE = 3.0
"""Standard errors by which a gain is more than another, or may be off one: a gyro whose own noise
is a sixteenth of what shakes both is farther from it, in the power of the quiet windows of two
minutes."""


class Octave(NamedTuple):
    """From ``low`` Hz to its double: by axis the gyro's power over that of its white noise
    (``level``), the ``gain`` with which the reference has its signal, and the standard error of
    that (``std``).
    """

    low: float
    level: np.ndarray
    gain: np.ndarray
    std: np.ndarray

    @property
    def is_noise(self) -> bool:
        """Whether the gyro shows its noise alone."""
        return bool(np.all((self.level > NOISE[0]) & (self.level < NOISE[1])))


def shows_noise_of_gyro(trial: Trial) -> bool:
    """Whether the reference of a gyro's trial, an attitude or a rate, has the gyro's own noise."""
    derived = trial.reference == "attitude" and trial.band_limit is not None
    if trial.kind != "gyro" or not (derived or trial.reference == "rate"):
        return False
    quiet = [o for o in octaves(trial) if o.is_noise]
    if len(quiet) < OCTAVES:
        return False
    return any(map(_is_shown, quiet)) if derived else _is_all_of_it(quiet)


def _is_shown(octave: Octave) -> bool:
    """Whether the noise is in the reference on each axis, and on all of them beyond doubt."""
    mean, std = octave.gain.mean(), np.sqrt(np.mean(octave.std**2) / len(octave.std))
    return bool(std < KNOWN[0] and mean - SURE * std > SHOWN and np.all(octave.gain > octave.std))


def _is_all_of_it(quiet: list[Octave]) -> bool:
    """Whether the gain is one on each axis, as of the gyro's output with other noise beside it."""
    weight = np.array([o.std**-2 for o in quiet])
    gain = np.sum(weight * np.array([o.gain for o in quiet]), axis=0) / weight.sum(axis=0)
    std = weight.sum(axis=0) ** -0.5
    return bool(np.all(std < KNOWN[1]) and np.all(np.abs(gain - 1) < SURE * std))


def octaves(trial: Trial) -> list[Octave]:
    """What gyro and reference have in common in the quietest windows, by octaves; none where these
    are too few, or hardly any noise is in them.
    """
    axes, length = list(trial.axes), round(SECONDS / trial.h)
    density = rest_density(trial)[axes]
    signals = np.hstack([trial.y[:, axes], trial.u[:, OWN[trial.kind]][:, axes]])
    starts = [s for a, b in trial.segments for s in range(a, b - length + 1, length)]
    if len(starts) < 4 * LEAST or not np.all(density > LEAST_NOISE[trial.kind]):
        return []
    pieces = np.array([signals[s : s + length] for s in starts])
    quiet = np.argsort(pieces[:, :, : len(axes)].var(axis=1).sum(axis=1))[: len(starts) // 4]
    pieces = pieces[quiet] - pieces[quiet].mean(axis=1, keepdims=True)
    window = hann(length, sym=False)
    z = rfft(pieces * window[:, None], axis=1)
    frequency = np.fft.rfftfreq(length, trial.h)
    white = density**2 / trial.h * (window @ window)
    found, low = [], LOWEST
    while low < HIGHEST / trial.h:
        inside = (frequency >= low) & (frequency < min(2 * low, HIGHEST / trial.h))
        if inside.any():
            found.append(_octave(low, z[:, inside], white))
        low *= 2
    return found


def _octave(low: float, z: np.ndarray, white: np.ndarray) -> Octave:
    """Of spectra (windows, frequencies, 2 k), those of the gyro before those of the reference."""
    y, x = np.split(z, 2, axis=2)
    yy, xx = (np.maximum(np.mean(np.abs(v) ** 2, axis=(0, 1)), 1e-300) for v in (y, x))
    gain = np.abs(np.mean(y.conj() * x, axis=(0, 1))) / yy
    # Of what the gyro does not explain of the reference.
    left = np.maximum(xx - gain**2 * yy, 1e-12 * xx)
    count = INDEPENDENT * y.shape[0] * y.shape[1]
    return Octave(low, yy / white, gain, np.sqrt(left / yy / 2 / count))
