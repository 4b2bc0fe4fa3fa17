"""Whether what is left against a reference is that reference's noise, or an effect left it.

Three things tell. What the sensor adds to a motion is in its own signal, and what the reference
adds is not. What an effect makes of a motion is large where the motion is, and the noise of a
reference is there in quiet too. And where there is hardly any motion a reference shows its noise.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.incoherent import (
    CLEARLY,
    DRIFTS,
    LEAKAGE,
    NOTHING,
    OVERLAP,
    Spectrum,
    thirds,
)
from pyimu.identification.fit.trial import Doubt

SHOWN = 1 / 3
"""Share of what a reference shows at some frequency that coloured noise of it must have there, on
one axis at least, to be beyond doubt."""

CERTAIN = float(np.log(100.0))
"""Log-likelihood [nat] by which all or nothing must be the likelier share."""


def doubted(found: Mapping[int, Spectrum]) -> dict[int, Spectrum]:
    """Spectra by axis of the noise of a reference, with how far the coloured ones are to be
    doubted; nothing where it is in the sensor's own signal.
    """
    coloured = [s for s in found.values() if s.coloured]
    if not coloured:
        return dict(found)
    all_in_signal = _all_or_nothing(*_in_signal(coloured))
    if all_in_signal > CERTAIN:
        return {i: NOTHING if s.coloured else s for i, s in found.items()}
    if any(s.shown >= SHOWN for s in coloured):
        return dict(found)
    likely = max(all_in_signal, _all_or_nothing(*_with_motion(coloured))) < -CERTAIN
    doubt = Doubt.LIKELY if likely else Doubt.OPEN
    return {i: replace(s, doubt=doubt) if s.coloured else s for i, s in found.items()}


def _all_or_nothing(share: float, std: float) -> float:
    """Log-likelihood [nat] of a share of one over none."""
    return (share - 0.5) / std**2


def _in_signal(spectra: list[Spectrum]) -> tuple[float, float]:
    """Share of what is left that is in the sensor's own signal, and its standard error: their
    product at each frequency, weighed by what it says. Infinite where nothing tells.
    """
    known, seen, scatter = 0.0, 0.0, 0.0
    for s in spectra:
        z, count = s.frames, s.frames.left.shape[1]
        product = np.mean(z.left.conj() * z.signal, axis=1).real - s.own
        powers = [np.mean(np.abs(v) ** 2, axis=1) for v in (z.left, z.signal)]
        variance = np.maximum(powers[0] * powers[1] * OVERLAP / (2.0 * count), 1e-300)
        for some in _clear(s):
            level = float(s.psd[some].mean())
            weight = level / variance[some]
            known += level * float(weight.sum())
            seen += float(weight @ product[some])
            scatter += level * float(weight.sum())
    return (seen / known, float(np.sqrt(LEAKAGE * scatter)) / known) if known else (0.0, np.inf)


def _with_motion(spectra: list[Spectrum]) -> tuple[float, float]:
    """By which power of a motion's density what is left of it grows, from the quieter half of the
    frames to the other, and its standard error; infinite where nothing tells.
    """
    power, product, variance = 0.0, 0.0, 0.0
    for s in spectra:
        for some in _clear(s):
            left, signal = (
                np.mean(np.abs(v[some]) ** 2, axis=0) for v in (s.frames.left, s.frames.signal)
            )
            order, half = np.argsort(signal), len(signal) // 2
            quiet, loud = order[:half], order[-half:]
            grows, moves = (np.log(v[loud].mean() / v[quiet].mean()) for v in (left, signal))
            weight = half * (some.stop - some.start) / (LEAKAGE * OVERLAP)
            power += weight * moves**2
            product += weight * grows * moves
            variance += 2.0 * weight * moves**2
    return (product / power, float(np.sqrt(variance)) / power) if power else (0.0, np.inf)


def _clear(s: Spectrum) -> list[slice]:
    """Thirds of octaves in which what is left is clearly more than the sensor's own noise."""
    every = thirds(len(s.psd), max(1, int(np.searchsorted(s.frequency, DRIFTS))))
    return [p for p in every if s.psd[p].mean() - CLEARLY * s.std_of_mean(p) > s.own[p].mean()]
