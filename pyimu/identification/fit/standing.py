"""Axes about which, or along which, a log shows no motion: there a reference is its own noise.

A scale factor fitted to that would go to where it leaves less of it, towards -1 (errors in
variables, Fuller 1987, "Measurement Error Models", section 1.1), and what moves there later would
be lost.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.incoherent import NOTHING, OVERLAP, Spectrum
from pyimu.identification.fit.sample_noise import without_information
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN
from pyimu.numerics.laws import chi2

CHANCE = 1e-4
"""Probability by chance below which sensor and reference show a motion in common."""


def standing(trial: Trial) -> list[int]:
    """The axes on which what the reference shows is nothing that the sensor shows on any axis."""
    bad = without_information(trial).astype(float)
    rows = in_band(trial, bad[:, None])[:, 0] <= 0.0
    x, y = (in_band(trial, v)[rows] for v in (trial.u[:, OWN[trial.kind]], trial.y))
    if len(x) <= y.shape[1]:
        return []
    x, y = x - x.mean(axis=0), y[:, list(trial.axes)]
    y = y - y.mean(axis=0)
    missed = x - y @ np.linalg.lstsq(y, x)[0]
    power, left = np.sum(x**2, axis=0), np.sum(missed**2, axis=0)
    limit = chi2.isf(CHANCE, y.shape[1])
    return [i for i in trial.axes if power[i] > 0.0 and len(x) * (power[i] / left[i] - 1) < limit]


def all_noise(seen: Spectrum) -> Spectrum:
    """The noise of a reference where nothing moves: all that it shows."""
    if seen.whole is None or seen.frames is None:
        return NOTHING
    count = seen.frames.left.shape[1] / OVERLAP
    return replace(seen, psd=seen.whole, std=seen.whole / np.sqrt(count))
