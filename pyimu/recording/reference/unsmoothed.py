"""A reference without the smoothing that it went through: a filter without delay, such as a
tracker's software or a script lays over what was seen.

Of a smoothed attitude it is undone on the attitude. The rate of one that was smoothed over a
variance of s^2 in time is less than the body's by s^2/2 (w'' + w x w'), to second order; undone
axis by axis on the rate, the product would be left and look like an effect of the sensor.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import brentq
from scipy.signal import butter, sosfiltfilt

from pyimu.errors import Finding
from pyimu.numerics.columns import columns_at
from pyimu.recording.recording import Recording, at_own_times
from pyimu.recording.reference.attitude import (
    attitude_at,
    attitude_curve,
    attitude_track,
    one_sign,
)
from pyimu.recording.reference.file import TRUTHS, at_log
from pyimu.recording.reference.filters import seen_through, units
from pyimu.recording.reference.nodes import own_samples
from pyimu.recording.reference.sampling import extended
from pyimu.recording.reference.track import LEAST_NODES, Track, fresh, known_axes
from pyimu.recording.reference.unlagged import HIGHEST

SMOOTHED = "reference_smoothed"
"""The finding of a reference that was smoothed."""

CLEARLY = 0.3
"""A frequency of which less passes is not used: the noise, and what is wrong of a filter that was
taken for another, would be three times as large."""

ROUNDS = 16
"""After so many, what passes ``CLEARLY`` or more is restored to 0.01 %."""


def _steps() -> np.ndarray:
    """By how much of what is missing, smoothed once more, is given back in each round: Richardson's
    iteration on the normal equations, as a moving average turns some frequencies round, with the
    steps of Chebyshev, under which the largest error of shares from ``CLEARLY`` to 1 is least
    (Saad 2003, "Iterative Methods for Sparse Linear Systems", sections 8.1 and 12.3.1); the largest
    steps between small ones, so that no round has much to put right.
    """
    least = CLEARLY**2
    angle = np.pi * (np.arange(ROUNDS) + 0.5) / ROUNDS
    steps = 1.0 / (0.5 * (1.0 + least) + 0.5 * (1.0 - least) * np.cos(angle))
    half = ROUNDS // 2
    return np.column_stack([steps[:half], steps[::-1][:half]]).ravel()


STEPS = _steps()


def _mean(values: np.ndarray, rows: float) -> np.ndarray:
    """Mean over ``rows`` about each, a whole number or not."""
    more = int(rows / 2) + 1
    sums = np.cumsum(np.vstack([np.zeros(values.shape[1]), extended(values, more)]), axis=0)
    edge, at = np.arange(len(sums)), more + np.arange(len(values)) + 0.5
    before, after = (columns_at(at + side * rows / 2, edge, sums) for side in (-1, 1))
    return (after - before) / rows


def _gaussian(values: np.ndarray, rows: float) -> np.ndarray:
    more = int(4.0 * rows) + 1
    return gaussian_filter1d(extended(values, more), rows, axis=0)[more:-more]


def _butterworth(order: int, values: np.ndarray, rows: float) -> np.ndarray:
    low = butter(order, min(1.0 / (np.pi * rows), 0.99), output="sos")
    return sosfiltfilt(low, values, axis=0, padlen=min(int(3 * np.pi * rows), len(values) - 1))


@dataclass(frozen=True)
class Kind:
    """A way to smooth values (n, k) by a size in rows.

    From ``reach`` sizes on a row does not feel that what lies beyond an end is unknown. ``clear``
    is the frequency, in one over the size, up to which ``CLEARLY`` passes. ``variance`` is in
    squared sizes, 0 of a filter whose gain falls with more than the square of the frequency.
    """

    words: str
    of: Callable[[np.ndarray, float], np.ndarray]
    reach: float
    clear: float
    variance: float = 0.0


def _both_ways(order: int, reach: float) -> Kind:
    """Butterworth's filter, run forwards and backwards."""
    words = f"a Butterworth filter of order {order} run both ways, with a time constant of"
    clear = (1.0 / CLEARLY - 1.0) ** (0.5 / order) / (2.0 * np.pi)
    return Kind(words, partial(_butterworth, order), reach, clear)


KINDS = {
    "moving_average": Kind(
        "a moving average of",
        _mean,
        reach=6.0,
        clear=brentq(lambda x: np.sinc(x) - CLEARLY, 0.0, 1.0),
        variance=1 / 12,
    ),
    "gaussian": Kind(
        "a Gaussian filter with a standard deviation of",
        _gaussian,
        reach=12.0,
        clear=np.sqrt(-2.0 * np.log(CLEARLY)) / (2.0 * np.pi),
        variance=1.0,
    ),
    "butterworth_2": _both_ways(2, 6.0 * np.pi),
    "butterworth_4": _both_ways(4, 9.0 * np.pi),
}


@dataclass(frozen=True)
class Smoothing:
    """A filter of a kind of ``KINDS`` and a ``size`` in s: length, standard deviation, or time
    constant of the cut-off frequency.
    """

    kind: str
    size: float

    def as_detail(self) -> dict[str, str | float]:
        """For a finding."""
        kind = KINDS[self.kind]
        flat = {} if kind.variance else {"cutoff_frequency": 1.0 / (2.0 * np.pi * self.size)}
        known = {"filter": kind.words, "seconds": self.size, **flat}
        return {**known, HIGHEST: self.up_to}

    @classmethod
    def of_detail(cls, detail: Mapping[str, Any]) -> Smoothing:
        """That of a finding."""
        kind = next(name for name, kind in KINDS.items() if kind.words == detail["filter"])
        return cls(kind, float(detail["seconds"]))

    @property
    def up_to(self) -> float:
        """The frequency [Hz] up to which what was smoothed can be restored."""
        return float(KINDS[self.kind].clear / self.size)

    def smoothed(self, q: np.ndarray, h: float) -> np.ndarray:
        """Quaternions (n, 4), ``h`` s apart, entry by entry, and unit quaternions again."""
        return units(self._of(one_sign(q), h))

    def attitudes(self, smoothed: np.ndarray, h: float) -> np.ndarray:
        """The quaternions (n, 4), ``h`` s apart, that ``smoothed`` ones were smoothed from, entry
        by entry, before they were made unit quaternions again.
        """
        found = smoothed = one_sign(smoothed)
        for step in STEPS:
            q = self._of(found, h)
            missed = smoothed * np.linalg.norm(q, axis=1, keepdims=True) - q
            found = units(found + step * self._of(missed, h))
        return found

    def vectors(self, smoothed: np.ndarray, h: float) -> np.ndarray:
        """The values (n, k), ``h`` s apart, that ``smoothed`` ones were smoothed from."""
        found = smoothed
        for step in STEPS:
            found = found + step * self._of(smoothed - self._of(found, h), h)
        return found

    def lost(self, values: np.ndarray, h: float) -> np.ndarray:
        """What of values (n, k), ``h`` s apart, is not given back once they were smoothed."""
        return values - self.vectors(self._of(values, h), h)

    def seen(self, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
        """What is seen of a ``rate`` (n, 3) rad/s that was smoothed, or of attitudes (n, 4) that
        were, by which the body has ``turned``.
        """
        return seen_through(lambda values: self._of(values, h), rate, h, turned)

    def reach(self, h: float) -> int:
        """Rows at either end that nobody can restore: what was smoothed with them is unknown."""
        return int(np.ceil(KINDS[self.kind].reach * self.size / h)) + 1

    def _of(self, values: np.ndarray, h: float) -> np.ndarray:
        return KINDS[self.kind].of(values, self.size / h)


def unsmoothed(recording: Recording, smoothing: Smoothing) -> Recording:
    """The recording with the reference that was smoothed: its ``ref_rate``, or its ``ref_q``, at
    samples of its own, less those near an end; as it is where no segment reaches further.
    """
    source = recording if recording.reference is None else recording.reference
    rate = source.ref_rate is not None
    sharp = _rates(source, smoothing) if rate else _attitude(source, smoothing)
    if sharp is None:
        return recording
    found = Finding(SMOOTHED, "ref_rate" if rate else "ref_q", 1, smoothing.as_detail())
    return at_log(recording, replace(sharp, findings=(*sharp.findings, found)))


TURNING = frozenset({"ref_rate", "ref_q"})
"""What of a reference a rate follows from."""


def restored_up_to(source: Recording | None, places: bool = False) -> float:
    """Highest frequency [Hz] at which a reference may be used, inf where nothing was undone: its
    rate, or what its ``places`` make beside it.
    """
    findings = () if source is None else source.findings
    used = (f for f in findings if places or f.column in TURNING)
    return min((f.detail[HIGHEST] for f in used if HIGHEST in f.detail), default=np.inf)


def _rates(source: Recording, smoothing: Smoothing) -> Recording | None:
    out, axes = np.full_like(source.ref_rate, np.nan), known_axes(source.ref_rate)
    seen = source.ref_rate[:, axes]
    track = Track(source.time, fresh(seen), lambda n: np.diff(seen[n], axis=0), np.inf)
    for nodes in track.segments:
        h = float(np.median(np.diff(source.time[nodes])))
        kept, inner = _inner(nodes, smoothing.reach(h))
        if len(kept):
            out[np.ix_(kept, axes)] = smoothing.vectors(seen[nodes], h)[inner]
    return replace(source, ref_rate=out) if np.isfinite(out).any() else None


def _attitude(source: Recording, smoothing: Smoothing) -> Recording | None:
    """At even times between its samples, where the rate of these is even or not."""
    own = own_samples(source)
    times, sharp = [], []
    for nodes in attitude_track(own).segments:
        first, last = own.time[nodes[[0, -1]]]
        count = round((last - first) / float(np.median(np.diff(own.time[nodes]))))
        time = np.linspace(first, last, count + 1)
        h = (last - first) / count
        kept, inner = _inner(time, smoothing.reach(h))
        if len(kept):
            q = attitude_curve(own, nodes)(time).as_quat(scalar_first=True)
            times.append(kept)
            sharp.append(smoothing.attitudes(q, h)[inner])
    if not times:
        return None
    found = at_own_times(own, np.concatenate(times), ref_q=np.concatenate(sharp))
    if all(getattr(source, g) is None for g in TRUTHS if g != "ref_q"):
        return found
    return replace(source, ref_q=attitude_at(found, source.time))


def _inner(rows: np.ndarray, reach: int) -> tuple[np.ndarray, slice]:
    """The ``rows`` (n,) that lie ``reach`` from either end, and where; none of too few."""
    inner = slice(reach, len(rows) - reach)
    return (rows[inner], inner) if len(rows) >= 2 * reach + LEAST_NODES else (rows[:0], inner)
