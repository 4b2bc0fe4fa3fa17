"""A reference that was smoothed without delay: how, from what the sensor shows beside it.

What a filter damps of a reference the sensor shows, with a share that rises with the square of the
frequency or faster, and is no sensor's: those damp, or ring far above what a reference shows. An
effect that knows the rate would take it for the sensor's own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import minimize_scalar

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.damping import damping
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.align import fitted_structure
from pyimu.identification.reference.moving import in_own_band
from pyimu.identification.reference.track import WANDERS
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.unlagged import FILTERED
from pyimu.recording.reference.unsmoothed import KINDS, Smoothing, turned_by, unsmoothed

LEAST = 3e-5
"""s^2; half the variance of a smoothing that is looked for, that of a moving average of 27 ms: a
sensor that rings at 30 Hz looks like less."""

MOSTLY = 0.25
"""Share of what looks like smoothing that undoing a filter may leave."""

NOTHING = 1e-3
"""Of its size a filter that takes nothing away."""

HALF = np.sqrt(np.log(2.0))
"""The kinds of filter are compared up to the frequency at which half of it passes a Gaussian one;
there all of them may be undone."""

STEP = 2.0**0.25
"""From size to size of those that are tried first."""

TRIED = range(-4, 9)
"""Steps from the size that the slope says: it says too little of a long filter."""

SLOWEST, QUICKEST = 0.5, 0.25
"""Cut-offs of a Butterworth filter: Hz, and as a share of the rate of the rows."""

SHARE = 0.5
"""Of the rows that must be left by a filter which is undone."""

CLOSE = 1e-4
"""The size is looked for to this share of itself."""

ROWS = 6000
"""Of a log that are looked at to choose a filter; where it turns most."""


Left = Callable[[Smoothing], float]


def unsmoothed_logs(
    trials: tuple[list[Trial], list[Trial]],
    sensor: Sensor,
    logs: list[Recording],
    others: list[Recording],
) -> tuple[list[Recording], list[Recording]] | None:
    """``logs`` and ``others`` with references as they were before they were smoothed; None where
    none was. ``trials`` are the gyro's of both, their references on the sensor's clock.
    """
    found = {t.name: _smoothing(t, sensor) for ts in trials for t in ts if _may_be(t)}
    if not any(found.values()):
        return None
    fitted, apart = ([_without(r, found.get(r.name)) for r in rs] for rs in (logs, others))
    return fitted, apart


def _without(recording: Recording, smoothing: Smoothing | None) -> Recording:
    return recording if smoothing is None else unsmoothed(recording, smoothing)


def _may_be(trial: Trial) -> bool:
    return trial.reference in FILTERED and trial.clock is not None


def _smoothing(trial: Trial, sensor: Sensor) -> Smoothing | None:
    """The filter that a trial's reference is behind; None where it is behind none."""
    trial = in_own_band(trial)
    gain, falls = damping(fitted_structure(trial, sensor))
    if falls > -LEAST or gain < WANDERS:
        return None
    half = HALF / (2.0 * np.pi * np.sqrt(-falls))
    trial = _busiest(replace(trial, band_hz=min(trial.band_hz, half)))
    left = cache(partial(_alike, trial, _turned(trial), _taken(trial)))
    sizes = _sizes(trial, -falls)
    best = min((_finest(k, s, left) for k, s in sizes.items()), key=left)
    none = replace(best, size=NOTHING * best.size)
    return best if left(best) < MOSTLY * left(none) else None


def _busiest(trial: Trial) -> Trial:
    """The trial's longest segment, or of it the ``ROWS`` in which it turns most."""
    a, b = max(trial.segments, key=lambda s: s[1] - s[0])
    if b - a > ROWS:
        power = np.append(0.0, np.cumsum(np.sum(trial.u[a:b, OWN[trial.kind]] ** 2, axis=1)))
        a += int(np.argmax(power[ROWS:] - power[:-ROWS]))
        b = a + ROWS
    return replace(trial, segments=[(a, b)])


def _taken(trial: Trial) -> np.ndarray:
    """What filters without delay take away (n, 3, c): of each axis its second, fourth and sixth
    derivative, and what the others turn it by, to second order and to fourth.

    By the sensor itself, whose noise has nothing in common with the reference's: the power that is
    left would reward a filter that is too weak, as it leaves the noise of the reference as it is.
    """
    (rows,) = (slice(a, b) for a, b in trial.segments)
    out = np.zeros((len(trial.u), 3, 5))
    rate = gaussian_filter1d(np.nan_to_num(trial.y[rows]), 0.1 / (trial.band_hz * trial.h), axis=0)

    def slope(values: np.ndarray, times: int) -> np.ndarray:
        return slope(np.gradient(values, trial.h, axis=0), times - 1) if times else values

    product = np.cross(rate, slope(rate, 1))
    columns = (*(slope(rate, times) for times in (2, 4, 6)), product, slope(product, 2))
    out[rows] = np.stack(columns, axis=2)
    return out


def _alike(
    trial: Trial, turned: np.ndarray | None, taken: np.ndarray, smoothing: Smoothing
) -> float:
    """The power of what is left of a reference on which a filter is undone, by a linear map of the
    sensor's axes, that looks like what filters have ``taken``: of the two the reference has most
    of the noise, and a regression on it would be biased.
    """
    ((a, b),) = trial.segments
    reach = smoothing.reach(trial.h)
    if (b - a) - 2 * reach < SHARE * (b - a):
        return np.inf
    u, axes = np.zeros((len(trial.u), 3)), list(trial.axes)
    u[a:b] = smoothing.rate(trial.u[a:b, OWN[trial.kind]], trial.h, turned)
    inner = replace(trial, segments=[(a + reach, b - reach)])
    x, y = (in_band(inner, v[:, axes]) for v in (trial.y, u))
    x = np.column_stack([np.ones(len(x)), x])
    total = 0.0
    for i, left in zip(axes, _less(y, x).T, strict=True):
        columns = _less(in_band(inner, taken[:, i]), x)
        columns = columns / np.linalg.norm(columns, axis=0)
        total += float(np.sum((left - _less(left, columns)) ** 2))
    return total / len(x)


def _less(y: np.ndarray, x: np.ndarray) -> np.ndarray:
    """What columns x (m, c) leave of y (m, ...)."""
    return y - x @ np.linalg.lstsq(x, y)[0]


def _sizes(trial: Trial, half_variance: float) -> dict[str, list[float]]:
    """Sizes of each kind of filter to begin with, rising."""
    quick = trial.h / (2.0 * np.pi * QUICKEST)
    count = int(np.log(1.0 / (2.0 * np.pi * SLOWEST * quick)) / np.log(STEP)) + 1
    sizes = {}
    for name, kind in KINDS.items():
        if kind.variance:
            start, steps = float(np.sqrt(2.0 * half_variance / kind.variance)), TRIED
        else:
            start, steps = quick, range(count)
        sizes[name] = [start * STEP**k for k in steps]
    return sizes


def _finest(kind: str, sizes: list[float], left: Left) -> Smoothing:
    """The filter of a kind, its size within ``sizes``, that leaves least."""
    tried = [Smoothing(kind, size) for size in sizes]
    at = min(range(len(tried)), key=lambda i: left(tried[i]))
    near = sizes[max(at - 1, 0)], sizes[min(at + 1, len(sizes) - 1)]
    found = minimize_scalar(
        lambda x: left(Smoothing(kind, float(np.exp(x)))),
        bounds=tuple(np.log(near)),
        method="bounded",
        options={"xatol": CLOSE},
    )
    return min((tried[at], Smoothing(kind, float(np.exp(found.x)))), key=left)


def _turned(trial: Trial) -> np.ndarray | None:
    """The attitude (k, 4) at a trial's rows, where attitudes were smoothed."""
    ((a, b),) = trial.segments
    if trial.reference != "attitude":
        return None
    return turned_by(trial.u[a:b, OWN[trial.kind]], trial.h)
