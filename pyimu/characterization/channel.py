"""One channel of one log: Allan, modified and Hadamard deviations over its stretches, and the
coefficients of its noise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.stats import chi2

from pyimu.characterization.allan.deviation import (
    hadamard_deviation,
    log_clusters,
    modified_deviation,
    octave_clusters,
    overlapping_deviation,
)
from pyimu.characterization.allan.pooled import longest, pooled_deviation
from pyimu.characterization.noise.fit import ChannelFit, fit_noise
from pyimu.characterization.samples import CHUNK, Samples
from pyimu.characterization.spectrum.lines import Line
from pyimu.characterization.store import Store
from pyimu.characterization.temperature.fit import ThermalFit
from pyimu.characterization.temperature.warm_up import WarmUp, find_warm_up

POINTS = 100
"""Cluster times of a curve, evenly in the logarithm; those an octave apart come on top of it."""

LEAST = 64
"""Samples without gap from which on a channel is characterised: six clusters an octave apart for
five terms."""


@dataclass(frozen=True)
class Curve:
    """Deviations (t,) in the unit of the samples at cluster times ``tau`` (t,) s."""

    tau: np.ndarray
    deviation: np.ndarray


@dataclass(frozen=True)
class AllanCurve(Curve):
    """Overlapping Allan deviations; ``freedom`` (t,) equivalent degrees of freedom, ``low`` and
    ``high`` (t,) the limits of the true one.
    """

    freedom: np.ndarray
    low: np.ndarray
    high: np.ndarray


@dataclass(frozen=True)
class Noise:
    """What a channel's clusters say: curves of the samples less what temperature and warm-up make
    of them, and the fit.

    ``raw`` is the Allan deviation of the samples as they are, None where nothing was taken off.
    """

    allan: AllanCurve
    modified: Curve
    hadamard: Curve
    raw: Curve | None
    fit: ChannelFit


def noise_of(
    samples: Samples,
    axis: int,
    compensated: np.ndarray | None,
    lines: Sequence[Line],
    level: float,
    store: Store,
    say: Callable[[str], None] = lambda text: None,
) -> Noise:
    """Curves and fit of one axis, or of it ``compensated`` (n,). Raises UserError where there is
    no noise.
    """
    column, raw, used = samples.columns[axis], None, longest(samples.stretches)
    lengths = [b - a for a, b in used]
    room = store.room("sums", max(lengths) + 1)
    m = np.union1d(octave_clusters(max(lengths)), log_clusters(max(lengths), POINTS))
    if compensated is not None:
        say("as measured")
        raw, column = (
            Curve(m * samples.h, _pooled(column, used, m, overlapping_deviation, 2, room)),
            compensated,
        )
    say("Allan deviation")
    deviation = _pooled(column, used, m, overlapping_deviation, 2, room)
    octaves = np.isin(m, octave_clusters(max(lengths)))
    sines = [(v.frequency, max(v.frequency_std, v.width), v.amplitude) for v in lines]
    fit = fit_noise(m[octaves], deviation[octaves], lengths, samples.h, level, sines)
    say("Hadamard deviation")
    hadamard = _curve(column, used, m, hadamard_deviation, samples.h, room)
    say("modified deviation")
    modified = _curve(column, used, m, modified_deviation, samples.h, room)
    return Noise(
        _with_limits(m, deviation, fit, lengths, samples.h, level), modified, hadamard, raw, fit
    )


def _pooled(
    column: np.ndarray,
    used: Sequence[tuple[int, int]],
    m: np.ndarray,
    deviation: Callable,
    order: int,
    room: np.ndarray,
) -> np.ndarray:
    return pooled_deviation(
        [column[a:b] for a, b in used], m, partial(deviation, store=room), order
    )


def _curve(
    column: np.ndarray,
    used: Sequence[tuple[int, int]],
    m: np.ndarray,
    deviation: Callable,
    h: float,
    room: np.ndarray,
) -> Curve:
    """Of one of the deviations that need three clusters in a stretch; they are drawn, and every
    other cluster time is enough for that.
    """
    m = m[3 * m <= max(b - a for a, b in used)][::2]
    return Curve(m * h, _pooled(column, used, m, deviation, 3, room))


def _with_limits(
    m: np.ndarray,
    deviation: np.ndarray,
    fit: ChannelFit,
    lengths: Sequence[int],
    h: float,
    level: float,
) -> AllanCurve:
    """Limits from a chi-square of the degrees of freedom that the fitted noise gives the estimate
    at each cluster time.
    """
    freedom, side = fit.freedom(m, lengths), (1 - level) / 2
    low, high = (
        deviation * np.sqrt(freedom / chi2.isf(tail, freedom)) for tail in (side, 1 - side)
    )
    return AllanCurve(m * h, deviation, freedom, low, high)


def compensated(
    samples: Samples, axis: int, thermal: ThermalFit | None, store: Store
) -> tuple[np.ndarray | None, WarmUp | None]:
    """The column less what temperature and warm-up make of its bias, None where that is nothing;
    and the warm-up.
    """
    column = None
    if thermal is not None and thermal.warranted:
        column = _less(
            samples, samples.columns[axis], thermal.effect, store.room("compensated", len(samples))
        )
    start, stop = samples.stretches[0]
    # In the first stretch, if it is a good part of the log. A warm-up by the temperature that was
    # logged is an effect of temperature.
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
    """The column less an effect at the times of the samples, in ``out``, which may be the
    column.
    """
    for a in range(0, len(samples), CHUNK):
        rows = slice(a, a + CHUNK)
        out[rows] = column[rows] - effect(samples.time[rows])
    return out
