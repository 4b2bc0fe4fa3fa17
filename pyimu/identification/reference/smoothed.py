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

NEAR, CLOSE = 1.1, 1e-3
"""The factor within which the size is looked for by all rows, and the share of it to which."""

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
    trial = replace(trial, band_hz=min(trial.band_hz, half))
    left = _alike(_busiest(trial))
    best = min((_finest(k, s, left) for k, s in _sizes(trial, -falls).items()), key=left)
    if not left(best) < MOSTLY * left(replace(best, size=NOTHING * best.size)):
        return None
    # What is off of it is seen by all rows.
    near = [best.size / NEAR, best.size, best.size * NEAR]
    return _finest(best.kind, near, _alike(trial))


def _busiest(trial: Trial) -> Trial:
    """The trial's longest segment, or of it the ``ROWS`` in which it turns most."""
    a, b = max(trial.segments, key=lambda s: s[1] - s[0])
    if b - a > ROWS:
        power = np.append(0.0, np.cumsum(np.sum(trial.u[a:b, OWN[trial.kind]] ** 2, axis=1)))
        a += int(np.argmax(power[ROWS:] - power[:-ROWS]))
        b = a + ROWS
    return replace(trial, segments=[(a, b)])


def _alike(trial: Trial) -> Left:
    """Of filters the power of what is left of a reference on which one is undone, by a linear map
    of the sensor's axes, that looks like what filters take away: of the two the reference has most
    of the noise, and a regression on it would be biased.
    """
    turned = [_turned(trial, a, b) for a, b in trial.segments]
    return cache(partial(_power_alike, trial, turned, _taken(trial)))


def _power_alike(
    trial: Trial, turned: list[np.ndarray | None], taken: np.ndarray, smoothing: Smoothing
) -> float:
    """``_alike`` of one filter; inf where it reaches too far."""
    reach, u, inner = smoothing.reach(trial.h), np.zeros((len(trial.u), 3)), []
    for (a, b), q in zip(trial.segments, turned, strict=True):
        if b - a > 3 * reach:
            u[a:b] = smoothing.rate(trial.u[a:b, OWN[trial.kind]], trial.h, q)
            inner.append((a + reach, b - reach))
    if _rows(inner) < SHARE * _rows(trial.segments):
        return np.inf
    known, axes = replace(trial, segments=inner), list(trial.axes)
    x, y = (in_band(known, v[:, axes]) for v in (trial.y, u))
    x = np.column_stack([np.ones(len(x)), x])
    total = 0.0
    for i, left in zip(axes, _less(y, x).T, strict=True):
        columns = _less(in_band(known, taken[:, i]), x)
        columns = columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
        total += float(np.sum((left - _less(left, columns)) ** 2))
    return total / len(x)


def _taken(trial: Trial) -> np.ndarray:
    """What filters without delay take away (n, 3, c): of each axis its second, fourth and sixth
    derivative, and what the others turn it by, to second order and to fourth.

    By the sensor itself, whose noise has nothing in common with the reference's: the power that is
    left would reward a filter that is too weak, as it leaves the noise of the reference as it is.
    """
    out, width = np.zeros((len(trial.u), 3, 5)), 0.1 / (trial.band_hz * trial.h)

    def slope(values: np.ndarray, times: int) -> np.ndarray:
        return slope(np.gradient(values, trial.h, axis=0), times - 1) if times else values

    for a, b in trial.segments:
        if b - a > 1:
            rate = gaussian_filter1d(np.nan_to_num(trial.y[a:b]), width, axis=0)
            product = np.cross(rate, slope(rate, 1))
            columns = (*(slope(rate, times) for times in (2, 4, 6)), product, slope(product, 2))
            out[a:b] = np.stack(columns, axis=2)
    return out


def _turned(trial: Trial, a: int, b: int) -> np.ndarray | None:
    """The attitude (b - a, 4) at rows, where attitudes were smoothed."""
    if trial.reference != "attitude":
        return None
    return turned_by(trial.u[a:b, OWN[trial.kind]], trial.h)


def _rows(segments: list[tuple[int, int]]) -> int:
    return sum(b - a for a, b in segments)


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
