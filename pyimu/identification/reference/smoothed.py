"""A reference that was smoothed without delay, or lags by more of its noise than of its motion:
how, from what the sensor shows beside it.

What a filter damps of a reference the sensor shows, with a share that rises with the square of the
frequency or faster, and is no sensor's: those damp, or ring far above what a reference shows. An
effect that knows the rate would take it for the sensor's own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import minimize_scalar

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.damping import damping, slopes
from pyimu.identification.fit.interpolated import TAPS, delayed
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.align import fitted_structure
from pyimu.identification.reference.lagging import may_lag
from pyimu.identification.reference.moving import in_own_band
from pyimu.identification.reference.track import WANDERS
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.unlagged import FILTERED, unlagged, unlagged_rate
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

TRIED, LAGS = range(-4, 9), range(-2, 3)
"""Steps from the size that the slope says, which says too little of a long filter; and from the
time constant by which the sensor is early."""

SLOWEST, QUICKEST = 0.5, 0.25
"""Cut-offs of a Butterworth filter: Hz, and as a share of the rate of the rows."""

SHARE = 0.5
"""Of the rows that must be left by a filter which is undone."""

NEAR, CLOSE = 1.1, 1e-3
"""The factor within which the size is looked for by all rows, and the share of it to which."""

ROWS = 6000
"""Of a log that are looked at to choose a filter; where it turns most."""


@dataclass(frozen=True)
class Lag:
    """A low-pass filter of first order with a time constant of ``size`` s, whose delay was taken
    for the clock's.
    """

    size: float

    def rate(self, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
        """The ``rate`` (n, 3) rad/s of a reference before the filter, on the clock on which it is;
        of attitudes where it has ``turned`` (n, 4) by it.
        """
        kind = "rate" if turned is None else "attitude"
        quick = unlagged_rate(h * np.arange(len(rate)), rate, self.size, kind)
        return delayed(quick, self.size / h)

    def reach(self, h: float) -> int:
        """Rows at either end that have no neighbours to be moved by."""
        return int(np.ceil(self.size / h)) + TAPS


Filter = Smoothing | Lag
Left = Callable[[Filter], float]


def without_filter(trial: Trial, sensor: Sensor) -> Callable[[Recording], Recording] | None:
    """What takes a filter out of the reference of a trial's log; None where it is behind none."""
    found = _filter(trial, sensor) if _may_be(trial) else None
    if found is None:
        return None
    if isinstance(found, Lag):
        return partial(unlagged, lag=found.size)
    return partial(unsmoothed, smoothing=found)


def _may_be(trial: Trial) -> bool:
    return trial.reference in FILTERED and trial.clock is not None


def _filter(trial: Trial, sensor: Sensor) -> Filter | None:
    """The filter that a trial's reference is behind; None where it is behind none."""
    early = -trial.clock.mean if may_lag(trial) else 0.0
    trial = in_own_band(trial)
    fitted = fitted_structure(trial, sensor)
    # What the reference damps by the motion that it shows is no less than what it does damp.
    gain, falls = damping(fitted)
    sure = falls < -LEAST and gain > WANDERS
    if not sure and early:
        gain, falls = damping(fitted, by_sensor=True)
    if falls > -LEAST or gain < WANDERS:
        return None
    half = HALF / (2.0 * np.pi * np.sqrt(-falls))
    trial = replace(trial, band_hz=min(trial.band_hz, half))
    left = _alike(_busiest(trial))
    kinds = [(partial(Smoothing, k), s) for k, s in _sizes(trial, -falls).items() if sure]
    if early:
        kinds.append((Lag, _times(early, LAGS)))
    best = min((_finest(make, sizes, left) for make, sizes in kinds), key=left)
    if not left(best) < MOSTLY * left(replace(best, size=NOTHING * best.size)):
        return None
    # What is off of it is seen by all rows.
    near = [best.size / NEAR, best.size, best.size * NEAR]
    return _finest(partial(replace, best), near, _alike(trial))


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
    trial: Trial, turned: list[np.ndarray | None], taken: np.ndarray, one: Filter
) -> float:
    """``_alike`` of one filter; inf where it reaches too far."""
    reach, u, inner = one.reach(trial.h), np.zeros((len(trial.u), 3)), []
    for (a, b), q in zip(trial.segments, turned, strict=True):
        if b - a > 3 * reach:
            u[a:b] = one.rate(trial.u[a:b, OWN[trial.kind]], trial.h, q)
            inner.append((a + reach, b - reach))
    if _rows(inner) < SHARE * _rows(trial.segments):
        return np.inf
    known, axes = replace(trial, segments=inner), list(trial.axes)
    # The clock is as it was measured beside the filter.
    slope = slopes(trial, trial.y)
    x, moved, y = (in_band(known, v[:, axes]) for v in (trial.y, slope, u))
    x = np.column_stack([np.ones(len(x)), x, moved])
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
    width = 0.1 / (trial.band_hz * trial.h)
    rate = np.zeros(trial.y.shape)
    for a, b in trial.segments:
        rate[a:b] = gaussian_filter1d(trial.y[a:b], width, axis=0)

    def slope(values: np.ndarray, times: int) -> np.ndarray:
        return slope(slopes(trial, values), times - 1) if times else values

    product = np.cross(rate, slope(rate, 1))
    columns = (*(slope(rate, times) for times in (2, 4, 6)), product, slope(product, 2))
    return np.stack(columns, axis=2)


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
            sizes[name] = _times(np.sqrt(2.0 * half_variance / kind.variance), TRIED)
        else:
            sizes[name] = _times(quick, range(count))
    return sizes


def _times(start: float, steps: range) -> list[float]:
    return [float(start * STEP**k) for k in steps]


def _finest(make: Callable, sizes: list[float], left: Left) -> Filter:
    """The filter that leaves least of those that ``make`` makes of a ``size`` within ``sizes``."""
    tried = [make(size=size) for size in sizes]
    at = min(range(len(tried)), key=lambda i: left(tried[i]))
    near = sizes[max(at - 1, 0)], sizes[min(at + 1, len(sizes) - 1)]
    found = minimize_scalar(
        lambda x: left(make(size=float(np.exp(x)))),
        bounds=tuple(np.log(near)),
        method="bounded",
        options={"xatol": CLOSE},
    )
    return min((tried[at], make(size=float(np.exp(found.x)))), key=left)
