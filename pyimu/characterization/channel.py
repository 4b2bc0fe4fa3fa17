"""The noise of one channel of one log: its deviations over the segments, and the fit to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Self

import numpy as np

from pyimu.characterization.allan.deviation import (
    hadamard_deviation,
    log_clusters,
    modified_deviation,
    octave_clusters,
    overlapping_deviation,
)
from pyimu.characterization.allan.pooled import (
    Deviation,
    Segment,
    equivalent_freedom,
    pooled_deviation,
    used_segments,
)
from pyimu.characterization.allan.readings import floor
from pyimu.characterization.noise.fit import ChannelFit, fit_noise
from pyimu.characterization.outcome import AllanCurve, Curve, NoiseAnalysis
from pyimu.characterization.samples import PIECE, Samples
from pyimu.characterization.spectrum.lines import Line
from pyimu.characterization.store import Store
from pyimu.characterization.temperature.fit import ThermalFit
from pyimu.characterization.temperature.warm_up import WarmUp, find_warm_up
from pyimu.display.silent import silent
from pyimu.numerics.laws import chi2

POINTS = 100
"""Cluster times of a curve, evenly spaced in the logarithm; those an octave apart are added."""

LEAST = 64
"""Samples without gap that a channel needs: they give six clusters an octave apart for the five
terms."""


def analyse_noise(
    samples: Samples,
    axis: int,
    compensated: np.ndarray | None,
    lines: Sequence[Line],
    level: float,
    store: Store,
    say: Callable[[str], None] = silent,
) -> NoiseAnalysis:
    """Deviations and fit of one axis, or of its samples ``compensated`` (n,) if these are given.

    ``lines`` are those of its spectrum, ``level`` is the probability of the intervals. Raises
    UserError where there is no noise.
    """
    pool, column, as_measured = _Pool.of(samples, store), samples.columns[axis], None
    m = np.union1d(octave_clusters(pool.longest), log_clusters(pool.longest, POINTS))
    if compensated is not None:
        say("as measured")
        as_measured = Curve(m * samples.h, pool.deviation(column, m, overlapping_deviation, 2))
        column = compensated
    say("Allan deviation")
    deviation = pool.deviation(column, m, overlapping_deviation, 2)
    fit = _fit(pool, m, deviation, lines, level)
    say("Hadamard deviation")
    hadamard = pool.third_order(column, m, hadamard_deviation)
    say("modified deviation")
    modified = pool.third_order(column, m, modified_deviation)
    tau, terms = m * samples.h, np.sqrt(fit.term_variances(m * samples.h))
    return NoiseAnalysis(
        allan=_with_limits(m, deviation, fit, pool, level),
        modified=modified,
        hadamard=hadamard,
        as_measured=as_measured,
        fit=fit,
        fitted=fit.deviation(tau),
        terms={t: terms[:, i] for i, t in enumerate(fit.letters) if t in fit.estimates},
        floor=floor(tau, deviation),
    )


def fit_again(
    noise: NoiseAnalysis, samples: Samples, lines: Sequence[Line], level: float, memory: float
) -> NoiseAnalysis:
    """The analysis with a fit for noise that a low-pass gives a ``memory`` [s].

    Other arguments are those of ``analyse_noise``.
    """
    pool = _Pool(used_segments(samples.stretches), samples.h, np.empty(0))
    tau, deviation = noise.allan.tau, noise.allan.deviation
    m = np.rint(tau / samples.h).astype(int)
    fit = _fit(pool, m, deviation, lines, level, memory)
    terms = np.sqrt(fit.term_variances(tau))
    return replace(
        noise,
        allan=_with_limits(m, deviation, fit, pool, level),
        fit=fit,
        fitted=fit.deviation(tau),
        terms={t: terms[:, i] for i, t in enumerate(fit.letters) if t in fit.estimates},
    )


def _fit(
    pool: _Pool,
    m: np.ndarray,
    deviation: np.ndarray,
    lines: Sequence[Line],
    level: float,
    memory: float = 0.0,
) -> ChannelFit:
    """The fit to the deviations (t,) at clusters ``m`` (t,) that are octaves apart."""
    octaves = np.isin(m, octave_clusters(pool.longest))
    sines = [(v.frequency, max(v.frequency_std, v.width), v.amplitude) for v in lines]
    return fit_noise(m[octaves], deviation[octaves], pool.lengths, pool.h, level, sines, memory)


@dataclass(frozen=True)
class _Pool:
    """The segments over which deviations are pooled, and ``room`` (n,) to make them in."""

    segments: Sequence[Segment]
    h: float
    room: np.ndarray

    @classmethod
    def of(cls, samples: Samples, store: Store) -> Self:
        """The segments of a sensor that are used."""
        used = used_segments(samples.stretches)
        return cls(used, samples.h, store.room("sums", max(b - a for a, b in used) + 1))

    @property
    def lengths(self) -> list[int]:
        """Samples of each segment."""
        return [b - a for a, b in self.segments]

    @property
    def longest(self) -> int:
        """Samples of the longest segment."""
        return max(self.lengths)

    def deviation(
        self, column: np.ndarray, m: np.ndarray, deviation: Deviation, order: int
    ) -> np.ndarray:
        """A deviation (t,) of the column (n,), of ``order`` clusters in a row."""
        records = [column[a:b] for a, b in self.segments]
        return pooled_deviation(records, m, partial(deviation, work=self.room), order)

    def third_order(self, column: np.ndarray, m: np.ndarray, deviation: Deviation) -> Curve:
        """A deviation that needs three clusters in a segment.

        It is only drawn, and every other cluster time is enough for that.
        """
        m = m[3 * m <= self.longest][::2]
        return Curve(m * self.h, self.deviation(column, m, deviation, 3))


def _with_limits(
    m: np.ndarray, deviation: np.ndarray, fit: ChannelFit, pool: _Pool, level: float
) -> AllanCurve:
    """The Allan deviations (t,) with limits from a chi-square.

    Its degrees of freedom are those that the fitted noise gives the estimate at each cluster time.
    """
    freedom = equivalent_freedom(m, pool.lengths, fit.squares, fit.times_in_samples)
    side = (1 - level) / 2
    low, high = (
        deviation * np.sqrt(freedom / chi2.isf(tail, freedom)) for tail in (side, 1 - side)
    )
    return AllanCurve(m * pool.h, deviation, freedom, low, high)


def compensate(
    samples: Samples, axis: int, thermal: ThermalFit | None, store: Store
) -> tuple[np.ndarray | None, WarmUp | None]:
    """The column (n,) less the effect of temperature and warm-up, and the warm-up.

    The column is None where there is neither. A warm-up is looked for in the first stretch, if that
    is more than half of the log; one that follows the logged temperature is an effect of
    temperature.
    """
    column = None
    if thermal is not None and thermal.warranted:
        room = store.room("compensated", len(samples))
        column = _less(samples, samples.columns[axis], thermal.effect, room)
    start, stop = samples.stretches[0]
    if 2 * (stop - start) <= len(samples):
        return column, None
    before = samples.columns[axis] if column is None else column
    warm_up = find_warm_up(before[start:stop], samples.h)
    if warm_up is not None:
        first = samples.time[start]
        out = store.room("compensated", len(samples)) if column is None else column
        column = _less(samples, before, lambda time: warm_up.effect(time - first), out)
    return column, warm_up


def _less(
    samples: Samples,
    column: np.ndarray,
    effect: Callable[[np.ndarray], np.ndarray],
    out: np.ndarray,
) -> np.ndarray:
    """Fill ``out`` with the column less an effect at the times of the samples.

    ``out`` may be the column.
    """
    for a in range(0, len(samples), PIECE):
        rows = slice(a, a + PIECE)
        out[rows] = column[rows] - effect(samples.time[rows])
    return out
