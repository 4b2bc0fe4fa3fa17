"""The noise of a derived reference by its spectrum: what is left against it and the sensor does not
show.

What an effect leaves is in the sensor's own signal, and at each frequency coherent with it; the
noise of the reference is not (Bendat and Piersol 2010, Random Data, chapter 7: the residual
spectrum of a multiple-input model). An attitude that wanders has its noise far below the band's
end, where the high differences of a reference show nothing of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import freqz
from scipy.signal.windows import hann

from pyimu.identification.fit.columns import Linear, in_band
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk

WINDOWS = 8
"""Windows that a log is cut into, half of each in the next one: enough to tell the three axes of
the sensor from noise, and as long as that allows."""

FEWEST_ROWS = 32
"""Rows of a window, of which there must be one frequency within the band at least."""


@dataclass(frozen=True)
class Spectrum:
    """One-sided density ``psd`` (f,) of rows in a band, at ``frequency`` (f,) in Hz."""

    frequency: np.ndarray
    psd: np.ndarray

    @property
    def variance(self) -> float:
        return float(np.sum(self.psd) * self.frequency[1]) if len(self.psd) > 1 else 0.0


NOTHING = Spectrum(np.zeros(0), np.zeros(0))


def unseen_spectrum(trial: Trial, one: Linear, axis: int, own: RandomWalk) -> Spectrum:
    """Density of what is left on an ``axis`` and is not coherent with the sensor, less what its
    ``own`` noise has of that.
    """
    measured = in_band(trial, trial.y[:, list(trial.axes)])
    rows = sum(b - a for a, b in one.segments)
    length = 2 * (rows // WINDOWS // 2)
    starts = [s for a, b in one.segments for s in range(a, b - length + 1, max(1, length // 2))]
    inputs = measured.shape[1]
    if length < FEWEST_ROWS or len(starts) < 2 * inputs:
        return NOTHING
    both = np.column_stack([one.residual[:, axis], measured])
    window, interval = hann(length, sym=False), trial.h * trial.band.stride
    pieces = np.array([both[s : s + length] for s in starts])
    pieces -= pieces.mean(axis=1, keepdims=True)
    z = np.fft.rfft(pieces * window[:, None], axis=1)
    # (f, 1 + inputs, 1 + inputs): residual first.
    cross = np.einsum("kfi,kfj->fij", z.conj(), z) * (
        2 * interval / len(starts) / (window @ window)
    )
    r, by, yy = cross[:, 0, 0].real, cross[:, 1:, 0], cross[:, 1:, 1:]
    shown = np.einsum("fi,fij,fj->f", by.conj(), np.linalg.pinv(yy, hermitian=True), by).real
    left = np.maximum(r - shown, 0.0) * len(starts) / (len(starts) - inputs)
    frequency = np.fft.rfftfreq(length, interval)
    at = trial.axes.index(axis)
    mine = _own(trial, own, frequency)
    # The sensor's own noise is in its signal as well, and as much of it is left as that moves.
    moves = 1.0 - mine / np.maximum(yy[:, at, at].real, 1e-300)
    psd = np.maximum(left - mine * np.maximum(moves, 0.0), 0.0)
    psd[0] = 0.0
    return Spectrum(frequency, psd)


def _own(trial: Trial, own: RandomWalk, frequency: np.ndarray) -> np.ndarray:
    """Density of white noise and random walk in the band; zero at no frequency."""
    turns = 2 * np.pi * np.where(frequency > 0.0, frequency, np.inf)
    return 2 * (own.r * trial.h + own.k2 / turns**2) * response(trial, frequency) ** 2


def response(trial: Trial, frequency: np.ndarray) -> np.ndarray:
    """Gain (f,) of the trial's band at ``frequency`` in Hz."""
    return np.abs(freqz(trial.band.weights, worN=frequency, fs=1.0 / trial.h)[1])


def drawn(trial: Trial, spectrum: Spectrum, rng: np.random.Generator) -> np.ndarray:
    """Noise (n,) at the sample rate that has a spectrum in the trial's band, and nothing above."""
    if not spectrum.variance > 0.0:
        return np.zeros(len(trial.y))
    n = len(trial.y)
    frequency = np.fft.rfftfreq(n, trial.h)
    before = spectrum.psd / response(trial, spectrum.frequency) ** 2
    psd = np.interp(frequency, spectrum.frequency, before, right=0.0)
    white = np.fft.rfft(rng.standard_normal(n))
    return np.fft.irfft(white * np.sqrt(psd / (2 * trial.h)), n)
