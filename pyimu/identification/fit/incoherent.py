"""The noise of a reference by its spectrum: what is left against it and the sensor does not show.

What an effect leaves is in the sensor's own signal, and at each frequency coherent with it; the
noise of the reference is not (Bendat and Piersol 2010, Random Data, chapter 7: the residual
spectrum of a multiple-input model). An attitude that wanders has its noise far below the band's
end, where the high differences of a reference show nothing of it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement

import numpy as np
from scipy.fft import next_fast_len, rfft
from scipy.signal import freqz
from scipy.signal.windows import hann

from pyimu.identification.fit.columns import Linear, in_band
from pyimu.identification.fit.sample_noise import without_information
from pyimu.identification.fit.short_memory import short_memory
from pyimu.identification.fit.trial import Doubt, Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.signals import COLUMNS
from pyimu.numerics.laws import chi2

WINDOWS = 8
"""Windows that a log is cut into, half of each in the next one: enough to tell the three axes of
the sensor from noise, and as long as that allows."""

FOR_EACH = 2
"""Windows for each further signal that what is left is compared with."""

OVERLAP = 1.06
"""Windows of Hann's form that overlap by half, over independent ones of as much weight: neighbours
correlate by 1/6 (Welch 1967, "The use of fast Fourier transform for the estimation of power
spectra")."""

LEAKAGE = 1.0 + 2.0 * ((2 / 3) ** 2 + (1 / 6) ** 2)
"""Variance of a mean of periodograms at neighbouring frequencies over that of as many independent
ones: Hann's form makes the amplitudes of the next correlate by 2/3, of the next but one by 1/6."""

DRIFTS = 1.0
"""Hz; below it a sensor may drift: the Allan deviation of inertial sensors still falls at 0.1 s."""

NOT_CHANCE = 1e-4
"""Probability by chance below which there is noise of a reference, and below which that is not
white."""

CLEARLY = 2.0
"""Standard errors by which a density must be more than another one."""

CHANCE = 4.0
"""Standard errors by which a density or a variance may be more than it seems."""

FOLDS = 3
"""Multiples of the rate of rows from about which noise is folded into them: of what lies beyond,
the band lets a few millionths through."""

ROUNDING, PLAINLY = 1e-12, 1e-2
"""Share of the power of signals below which what they differ by is rounding, and part of the
reciprocal up to which it plainly is none."""

TOGETHER, BLOCK = 16, 256
"""Frames that are transformed at once, and frequencies of which matrices are made at once."""

FEWEST_ROWS = 32
"""Rows of a window, of which there must be one frequency within the band at least."""


@dataclass(frozen=True)
class Frames:
    """Transforms (f, n) of what is ``left`` and of the sensor's own ``signal``, frame by frame:
    their squares are one-sided densities.
    """

    left: np.ndarray
    signal: np.ndarray


@dataclass(frozen=True)
class Spectrum:
    """One-sided density ``psd`` (f,) of rows in a band, at ``frequency`` (f,) in Hz.

    ``std`` (f,) are its standard errors; it may lie below zero by them. ``common`` is the standard
    error of all of it together, over it; ``whole`` (f,) the density of all that the reference
    shows, over which no noise of it can be, ``own`` (f,) that of the sensor's own noise, ``shown``
    the largest share of ``whole`` that it has where it is more than ``own``; ``coloured`` says that
    noise is known not to be white, ``doubt`` that it may be none of the reference; ``frames`` is
    what it was read from.
    """

    frequency: np.ndarray
    psd: np.ndarray
    std: np.ndarray
    common: float = 0.0
    whole: np.ndarray | None = None
    own: np.ndarray | None = None
    shown: float = 0.0
    coloured: bool = False
    doubt: Doubt = Doubt.NONE
    frames: Frames | None = None

    @property
    def variance(self) -> float:
        """The variance of such rows; zero where there is no spectrum."""
        return float(np.sum(self.psd) * self.frequency[1]) if len(self.psd) > 1 else 0.0

    @property
    def error(self) -> float:
        """Standard error of the variance, over it; infinite where that is none."""
        total = float(np.sum(self.psd))
        if total <= 0.0:
            return np.inf
        return float(np.hypot(np.linalg.norm(self.std) / total, self.common))

    def beyond(self, known: np.ndarray) -> np.ndarray:
        """The density (f,) beyond one that is ``known`` (f,), where there clearly is any; none
        where all of it together is no more than chance leaves.

        It is averaged over a third of an octave: cut off at zero, what single frequencies scatter
        would add up.
        """
        left, out, pieces = self.psd - known, np.zeros(len(self.psd)), thirds(len(self.psd))
        together = 0.0
        for some in pieces:
            mean, std = float(left[some].mean()), self.std_of_mean(some)
            if mean > CLEARLY * std:
                out[some] = mean
            if mean > 0.0:
                together += (mean / std) ** 2 if std > 0.0 else np.inf
        return out if together > chi2.isf(NOT_CHANCE, len(pieces)) else np.zeros(len(out))

    def std_of_mean(self, some: slice) -> float:
        """Standard error of the mean density over neighbouring frequencies."""
        return float(np.sqrt(LEAKAGE) * np.linalg.norm(self.std[some])) / len(self.std[some])


def thirds(count: int, first: int = 1) -> list[slice]:
    """Thirds of an octave, of frequencies ``first`` to ``count`` - 1 times the lowest."""
    out = []
    while first < count:
        out.append(slice(first, min(count, max(first + 1, round(first * 2 ** (1 / 3))))))
        first = out[-1].stop
    return out


NOTHING = Spectrum(np.zeros(0), np.zeros(0), np.zeros(0))


def unseen_spectra(trial: Trial, one: Linear, own: Mapping[int, RandomWalk]) -> dict[int, Spectrum]:
    """Densities by axis of what is left and is not coherent with the sensor, less what its ``own``
    noise has of that; none where there are too few rows.

    Of a reference that is no derivative neither with the signals that bend it: what an effect
    leaves is no noise of a reference, and no narrow band hides it.
    """
    axes = list(one.keys)
    inputs, bad = _known(trial)
    count = len(inputs)
    length, starts = _frames(one, bad, max(WINDOWS, FOR_EACH * (count - len(trial.axes))))
    if length < FEWEST_ROWS or len(starts) < 2 * count:
        return {}
    signal = in_band(trial, trial.u[:, OWN[trial.kind]][:, axes])
    short = short_memory(one.residual[:, axes], inputs[: len(trial.axes)], one.segments, bad)
    every = [*short.beyond.T, *inputs, *signal.T, *one.residual[:, axes].T]
    interval = trial.h * trial.band.stride
    frequency, averaged = np.fft.rfftfreq(length, interval), len(starts) / OVERLAP - count
    seen_in = _means(every, starts, length, interval, (len(axes), len(trial.axes), count))
    inverse, by, power = _inverse(seen_in.gram), seen_in.by, seen_in.power
    found = {}
    for k, axis in enumerate(axes):
        at = trial.axes.index(axis)
        gain = np.einsum("fij,fj->fi", inverse, by[:, :, k])
        seen = np.einsum("fi,fi->f", by[:, :, k].conj(), gain).real
        unseen = np.maximum(power[:, k] - seen, 0.0) * (1.0 + count / averaged)
        mine = _own(trial, own[axis], frequency)
        # The sensor's own noise is in its signal as well: that share of it is not left.
        share = np.clip(gain[:, at].real + short.response(frequency * interval, at, k), 0.0, 1.0)
        of_share = mine * np.sqrt(unseen * np.maximum(inverse[:, at, at].real, 0.0))
        psd, std = unseen - mine * (1.0 - share), np.hypot(unseen, of_share) / np.sqrt(averaged)
        psd[0] = std[0] = 0.0
        frames = Frames(seen_in.left[:, k], seen_in.own[:, at])
        shown = seen_in.whole[:, k]
        found[axis] = Spectrum(frequency, psd, std, whole=shown, own=mine, frames=frames)
    return found


def _known(trial: Trial) -> tuple[list[np.ndarray], np.ndarray]:
    """The signals (m,), in rows, that a residual is compared with, and the rows (m,) in which they
    say nothing.
    """
    signals, bad = [trial.y[:, i] for i in trial.axes], np.zeros(len(trial.y))
    if trial.band_hz is None:
        signals += _bending(trial)
        bad = without_information(trial).astype(float)
    *rows, unknown = (in_band(trial, v[:, None])[:, 0] for v in (*signals, bad))
    return rows, unknown > 0.0


def _frames(one: Linear, bad: np.ndarray, count: int) -> tuple[int, list[int]]:
    """Length and starts of frames, half of each in the next, as many as ``count`` if there are no
    gaps; none holds a ``bad`` row.

    A length of small factors, some hundredths less at most: one with a large prime among them
    takes five times longer to transform.
    """
    half = sum(b - a for a, b in one.segments) // count // 2
    length = next((2 * n for n in range(half, 0, -1) if next_fast_len(n) == n), 0)
    every = (s for a, b in one.segments for s in range(a, b - length + 1, max(1, length // 2)))
    return length, [s for s in every if not bad[s : s + length].any()]


@dataclass(frozen=True)
class _Means:
    """Means over n frames of what transforms of signals are together: products ``gram`` (f, c, c)
    of those that are known, conjugated, with each other and ``by`` (f, c, k) with what is beyond a
    short memory of them, squares ``power`` (f, k) of the latter and ``whole`` (f, k) of all that
    the reference shows; beside them the transforms of what is ``left`` (f, k, n) and of the
    sensor's ``own`` signal (f, s, n).
    """

    gram: np.ndarray
    by: np.ndarray
    power: np.ndarray
    whole: np.ndarray
    left: np.ndarray
    own: np.ndarray


def _means(
    every: list[np.ndarray],
    starts: list[int],
    length: int,
    interval: float,
    counts: tuple[int, int, int],
) -> _Means:
    """The ``_Means`` of signals (m,): of ``counts`` k, s, c the k that are beyond, the c that are
    known, of which the first s are the sensor's own, and k each of the whole and of what is left.

    A few frames after another: together those of all signals would be most of what a run has in
    memory.
    """
    (k, s, c), count = counts, length // 2 + 1
    products, squares = np.zeros((count, c, k + c), dtype=complex), np.zeros((count, k, 2))
    left, own = (np.empty((count, n, len(starts)), dtype=complex) for n in (k, s))
    for first in range(0, len(starts), TOGETHER):
        some = starts[first : first + TOGETHER]
        z = _transforms(every, some, length, interval)
        for a in range(0, count, BLOCK):
            known = z[a : a + BLOCK, k : k + c]
            both = z[a : a + BLOCK, : k + c].transpose(0, 2, 1)
            products[a : a + BLOCK] += known.conj() @ both
        squares[:, :, 0] += np.sum(np.abs(z[:, :k]) ** 2, axis=2)
        squares[:, :, 1] += np.sum(np.abs(z[:, k + c : -k]) ** 2, axis=2)
        at = slice(first, first + len(some))
        left[:, :, at], own[:, :, at] = z[:, -k:], z[:, k : k + s]
    products /= len(starts)
    squares /= len(starts)
    return _Means(products[:, :, k:], products[:, :, :k], *squares.transpose(2, 0, 1), left, own)


def _transforms(
    every: list[np.ndarray], starts: list[int], length: int, interval: float
) -> np.ndarray:
    """Transforms (f, k, n) of k signals (m,) in their n frames, whose squares are one-sided
    densities.
    """
    window = hann(length, sym=False)
    window *= np.sqrt(2 * interval / (window @ window))
    z = np.empty((length // 2 + 1, len(every), len(starts)), dtype=complex)
    for k, signal in enumerate(every):
        pieces = np.array([signal[s : s + length] for s in starts])
        pieces -= pieces.mean(axis=1, keepdims=True)
        pieces *= window
        z[:, k] = rfft(pieces, axis=1, overwrite_x=True).T
    return z


def _inverse(matrices: np.ndarray) -> np.ndarray:
    """The inverses of Hermitian matrices (f, c, c) of signals that differ much in size, in the
    directions that are more than rounding.
    """
    size = np.sqrt(np.maximum(np.diagonal(matrices, axis1=1, axis2=2).real, 1e-300))
    out = np.empty(matrices.shape, dtype=complex)
    for a in range(0, len(out), BLOCK):
        some = slice(a, a + BLOCK)
        scale = size[some, :, None] * size[some, None, :]
        out[some] = _inverse_of_alike(matrices[some] / scale) / scale
    return out


def _inverse_of_alike(matrices: np.ndarray) -> np.ndarray:
    """The same of signals of one size. All directions are plainly more than rounding mostly, since
    no eigenvalue is less than one over the norm of the inverse; eigenvectors take four times longer
    than that does.
    """
    with suppress(np.linalg.LinAlgError):
        found = np.linalg.inv(matrices)
        size = np.linalg.norm(found, axis=(1, 2)) * np.trace(matrices, axis1=1, axis2=2).real
        if np.all(size < PLAINLY / ROUNDING):
            return found
    return np.linalg.pinv(matrices, rcond=ROUNDING, hermitian=True)


def _bending(trial: Trial) -> list[np.ndarray]:
    """Signals (n,) as effects make them of what a sensor shows: the other triad's, absolute values,
    and products of two.
    """
    other = {"gyro": KINDS["accel"].own, "accel": KINDS["gyro"].own}[trial.kind]
    beside = [*trial.u[:, COLUMNS[other]].T] if other in trial.known else []
    # Of a sensor that never turns by more than its bias the absolute value would be its signal.
    own = [trial.y[:, i] - np.median(trial.y[:, i]) for i in trial.axes]
    every = [*own, *beside]
    products = (a * b for a, b in combinations_with_replacement(every, 2))
    return [*beside, *map(np.abs, own), *products]


def of_reference(
    seen: Spectrum,
    high: float = np.inf,
    error: float = 0.0,
    shape: np.ndarray | None = None,
) -> Spectrum:
    """The noise of a reference that is no derivative, by what is ``seen`` beyond the sensor's own
    and the density ``high`` that it shows itself by its high differences, if it does, with the
    ``error`` of that over it; ``shape`` (f,) is what white noise of density one is in the rows.

    White, with what the sensor drifts beside it as a random walk, where these two account for all
    above ``DRIFTS``, else as seen. Below it is level: there nothing tells a reference that wanders
    from a sensor that does, and sensors do. White noise is known better by the reference itself,
    where that is no more than may be. Nothing where there may be none.
    """
    first = int(np.searchsorted(seen.frequency, DRIFTS))
    pieces = thirds(len(seen.psd), max(first, 1))
    if len(pieces) < 4:
        return NOTHING
    shape = np.ones(len(seen.psd)) if shape is None else shape
    mean, std, at, white = np.array(
        [
            (seen.psd[p].mean(), seen.std_of_mean(p), seen.frequency[p].mean(), shape[p].mean())
            for p in pieces
        ]
    ).T
    if not np.all(std > 0.0):
        return NOTHING
    columns = np.column_stack([np.ones(len(at)), at**-2.0]) * (white / std)[:, None]
    inverse = np.linalg.inv(columns.T @ columns)
    found = inverse @ (columns.T @ (mean / std))
    missed = float(np.sum((mean / std - columns @ found) ** 2))
    if missed <= chi2.isf(NOT_CHANCE, len(at) - 2):
        level, doubt = float(found[0]), float(np.sqrt(inverse[0, 0]))
        if high <= level + CHANCE * doubt:
            level, doubt = high, high * error
        if level <= CLEARLY * doubt:
            return NOTHING
        return Spectrum(seen.frequency, level * shape, np.zeros(len(shape)), doubt / level)
    share = _shown_by_itself(seen, pieces, mean, std)
    psd, std = np.array(seen.psd), np.array(seen.std)
    psd[: pieces[0].start], std[: pieces[0].start] = psd[pieces[0]].mean(), std[pieces[0]].mean()
    found = replace(seen, psd=psd, std=std, shown=share, coloured=True)
    return found if CLEARLY * found.error < 1.0 else NOTHING


def _shown_by_itself(
    seen: Spectrum, pieces: list[slice], mean: np.ndarray, std: np.ndarray
) -> float:
    """The largest share that noise of densities ``mean`` (k,) in ``pieces`` has of what the
    reference shows itself, where it is clearly more than the sensor's own noise; nothing where it
    would be more than the reference shows anywhere.

    Of less than its own a sensor tells little: where a motion fades into the sensor's noise, what
    of that seems not to be in its signal is off by some tenths of it.
    """
    if seen.whole is None or seen.own is None:
        return 0.0
    most, own = (np.array([v[p].mean() for p in pieces]) for v in (seen.whole, seen.own))
    clear = mean - CLEARLY * std > own
    if np.any(mean > most + CHANCE * std):
        return 0.0
    return float(np.max(mean[clear] / most[clear], initial=0.0))


def _own(trial: Trial, own: RandomWalk, frequency: np.ndarray) -> np.ndarray:
    """Density of white noise and random walk in the band; zero at no frequency."""

    def density(f: np.ndarray) -> np.ndarray:
        return 2 * (own.r * trial.h + own.k2 / (2 * np.pi * f) ** 2)

    return np.where(frequency > 0.0, in_rows(trial, np.maximum(frequency, 1e-9), density), 0.0)


def of_white_attitude(trial: Trial, frequency: np.ndarray, variance: float) -> np.ndarray:
    """Density (f,) in the band of white noise that was differenced over two samples, as often as
    the trial's reference was, and had that ``variance`` then.
    """
    power = 2 * trial.derivatives
    mean = {2: 1 / 2, 4: 3 / 8}[power]  # of the sine's power over its half turn
    return in_rows(
        trial,
        frequency,
        lambda f: 2 * trial.h * variance / mean * np.sin(2 * np.pi * f * trial.h) ** power,
    )


def in_rows(
    trial: Trial, frequency: np.ndarray, density: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """What a one-sided ``density`` at the sample rate becomes in the rows of the band, with what
    the band lets through above half their rate.
    """
    rate = 1.0 / (trial.h * trial.band.stride)
    folded = [frequency]
    for k in range(1, FOLDS + 1):
        folded += [k * rate - frequency, k * rate + frequency]
    # The highest may be half the sample rate, give or take its rounding.
    inside = (f for f in folded if f.max() * trial.h <= 0.5 + ROUNDING)
    return sum(density(f) * response(trial, f) ** 2 for f in inside)


def response(trial: Trial, frequency: np.ndarray) -> np.ndarray:
    """Gain (f,) of the trial's band at ``frequency`` in Hz."""
    return np.abs(freqz(trial.band.weights, worN=frequency, fs=1.0 / trial.h)[1])


def drawn(
    trial: Trial, at: np.ndarray, density: np.ndarray, rng: np.random.Generator
) -> np.ndarray:
    """Noise (n,) at the sample rate that has a ``density`` (f,) in the trial's band, ``at`` so many
    Hz, and nothing above.
    """
    n = len(trial.y)
    frequency = np.fft.rfftfreq(n, trial.h)
    psd = np.interp(frequency, at, density / response(trial, at) ** 2, right=0.0)
    if trial.differs:
        # What was differentiated has less of the lowest frequencies than a straight line.
        psd *= np.minimum(frequency / at[1], 1.0)
    # Of one size at each frequency: what a draw scatters would be one more thing not known.
    turned = np.exp(2j * np.pi * rng.random(len(frequency)))
    return np.fft.irfft(turned * np.sqrt(n * psd / (2 * trial.h)), n)
