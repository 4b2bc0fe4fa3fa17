"""Attitudes that were computed from the gyro that they are compared with: the orientation that a
phone, or a unit with a filter of its own, gives beside its samples.

What such a one shows is what its gyro shows, noise and all, but for what gravity or a field puts
right slowly. Where nothing moves two instruments have nothing in common; these have the noise.
"""

from __future__ import annotations

import numpy as np
from scipy.fft import rfft
from scipy.signal.windows import hann

from pyimu.identification.fit.sample_noise import rest_noise
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN

SECONDS = 1.0
"""Length of the windows; the quietest quarter of them is looked at."""

LEAST = 16
"""Quiet windows that there must be: of unrelated noise so many cohere by a sixteenth."""

IN_COMMON = 0.75
"""Coherence on each axis from which on the noise is one: simulated phones have 0.90 to 0.99, arms,
cameras and trackers up to 0.23."""

WHITE = 2.0
"""Times the white noise of the gyro's samples that both signals have in the windows at most, or
something moves in them, or the reference has noise of its own.
"""

BETWEEN = 0.8, 1.6
"""Times the highest frequency to which a reference is used, between which is looked: below, hands
tremble, and filters put right."""


def is_of_itself(trial: Trial) -> bool:
    """Whether the reference's attitude shows the gyro's own noise on every axis."""
    if trial.kind != "gyro" or trial.reference != "attitude" or trial.band_limit is None:
        return False
    axes, length = list(trial.axes), round(SECONDS / trial.h)
    signals = np.hstack([trial.y[:, axes], trial.u[:, OWN[trial.kind]][:, axes]])
    starts = [s for a, b in trial.segments for s in range(a, b - length + 1, length)]
    if len(starts) < 4 * LEAST:
        return False
    pieces = np.array([signals[s : s + length] for s in starts])
    quiet = np.argsort(pieces[:, :, : len(axes)].var(axis=1).sum(axis=1))[: len(starts) // 4]
    pieces = pieces[quiet] - pieces[quiet].mean(axis=1, keepdims=True)
    window = hann(length, sym=False)
    z = rfft(pieces * window[:, None], axis=1)
    frequency = np.fft.rfftfreq(length, trial.h)
    low, high = (share * trial.band_limit for share in BETWEEN)
    z = z[:, (frequency > low) & (frequency <= high)]
    if not z.shape[1]:
        return False
    y, x = np.split(z, 2, axis=2)
    powers = [np.mean(np.abs(v) ** 2, axis=0) for v in (y, x)]
    product = np.abs(np.mean(y.conj() * x, axis=0)) ** 2
    coherence = np.mean(product / np.maximum(powers[0] * powers[1], 1e-300), axis=0)
    white = WHITE * rest_noise(trial)[axes] ** 2 * (window @ window)
    small = all(np.all(p.mean(axis=0) < white) for p in powers)
    return bool(np.all(coherence > IN_COMMON) and small)
