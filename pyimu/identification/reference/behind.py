"""The filter behind which a reference is, from what the sensor shows beside it.

One without delay, as software lays it over a recording, or a low-pass filter whose delay was taken
for the clock's. What it damps of a reference the sensor shows, with a share that rises with the
square of the frequency or faster, and is no sensor's: those damp, or ring far above what a
reference shows. An effect that knows the rate would take it for the sensor's own.

The sensor's motion is sent through filters, and the reference judges what comes out: its own noise,
which is the larger by far, is the same then whatever the filter. Undone on the reference it would
be made larger by one filter than by another, and the weakest be rewarded.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np
from scipy.optimize import minimize_scalar

from pyimu.identification.fit.damping import beyond_noise, damping
from pyimu.identification.fit.digits import may_be_rounding
from pyimu.identification.fit.interpolated import TAPS, delayed
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.align import SIGNIFICANT, fitted_structure
from pyimu.identification.reference.judged import Judge
from pyimu.identification.reference.moving import in_own_band
from pyimu.identification.reference.track import WANDERS
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.filters import low_passed, seen_through
from pyimu.recording.reference.unlagged import unlagged
from pyimu.recording.reference.unsmoothed import KINDS, Smoothing, unsmoothed

FILTERED = ("rate", "attitude")
"""Kinds of reference that a filter may lie over."""

LEAST = 3e-5
"""s^2; half the variance of a smoothing that is looked for, that of a moving average of 27 ms: a
sensor that rings at 30 Hz looks like less."""

SLIGHT = 0.1 * LEAST
"""Of a filter whose gain falls with more than the square of the frequency, as no ring does."""

LEAST_LAG = 0.05
"""Sample periods; a low-pass filter that is quicker changes nothing of what such rows show."""

MOSTLY = 0.25
"""Share of what looks like a filter that one may leave."""

STEP = 2.0**0.25
"""From size to size of those that are tried first."""

TRIED = range(-4, 9)
"""Steps from the size that the slope says, which says too little of a long filter."""

SLOWEST, QUICKEST = 0.5, 0.25
"""Cut-offs of a Butterworth filter: Hz, and as a share of the rate of the rows."""

NEAR, CLOSE = range(-2, 3), 1e-3
"""Steps within which the size is looked for by all rows, and the share of it to which."""

ROWS = 6000
"""Of a log that are looked at to choose a filter; where it turns most."""

SHOWABLE = 2.0
"""Times the highest frequency at which attitudes are used that their samples can show: of these
there are four a period."""

SETTLED = 8.0
"""Time constants after which what was before the first row is forgotten, to 0.03 %."""

Undo = Callable[[Recording], Recording]


class Filter(Protocol):
    """A filter of a ``size`` in s."""

    size: float

    def seen(self, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
        """What is seen of a ``rate`` (n, 3) rad/s behind the filter, or of attitudes (n, 4) behind
        it, by which the body has ``turned``.
        """

    def reach(self, h: float) -> int:
        """Rows at either end that are not as they would be between others."""


@dataclass(frozen=True)
class Lag:
    """A low-pass filter of first order with a time constant of ``size`` s, on a clock that makes up
    for its delay.
    """

    size: float

    def seen(self, rate: np.ndarray, h: float, turned: np.ndarray | None) -> np.ndarray:
        """As ``Filter.seen``."""
        rows = self.size / h
        late = seen_through(lambda values: low_passed(values, rows), rate, h, turned)
        return delayed(late, -rows)

    def reach(self, h: float) -> int:
        """As ``Filter.reach``."""
        return int(np.ceil(SETTLED * self.size / h)) + TAPS


def without_filter(trial: Trial, sensor: Sensor) -> Undo | None:
    """What takes a filter out of the reference of a trial's log; None where it is behind none."""
    found = _filter(trial, sensor) if _may_be(trial) else None
    if found is None or _is_rounding(trial, found) or _is_of_curve(trial, found):
        return None
    if isinstance(found, Lag):
        return partial(unlagged, lag=found.size, motion=in_own_band(trial).band_hz)
    return partial(unsmoothed, smoothing=found)


def _is_rounding(trial: Trial, found: Filter) -> bool:
    """Whether a filter changes no more than the rounding of the reference's numbers may."""
    x = trial.u[:, OWN[trial.kind]]
    return may_be_rounding(x - found.seen(x, trial.h, None), x, trial.digits)


def _is_of_curve(trial: Trial, found: Filter) -> bool:
    """Whether a filter passes all that the samples of an attitude can show: of a motion that is
    nearly as quick as they are the curve through them shows as much less.
    """
    if trial.band_limit is None or not isinstance(found, Smoothing):
        return False
    return found.up_to > SHOWABLE * trial.band_limit


def _may_be(trial: Trial) -> bool:
    return trial.reference in FILTERED and trial.clock is not None


def _may_lag(trial: Trial) -> bool:
    """Whether the sensor is early: where it is late, a lag is its own."""
    clock = trial.clock
    return clock.taken_out and clock.keeps_step and clock.mean < -SIGNIFICANT * clock.std


def _filter(trial: Trial, sensor: Sensor) -> Filter | None:
    """The filter that a trial's reference is behind; None where it is behind none."""
    early = _may_lag(trial)
    trial = in_own_band(trial)
    # What the reference damps by the motion that it shows is no less than what it does damp.
    fitted = fitted_structure(trial, sensor)
    gain, falls = damping(fitted)
    smooth = falls < -SLIGHT and gain > WANDERS
    if not smooth:
        # What moves above the band comes through its window, and not into what stands out within.
        clear = beyond_noise(fitted)
        gain, falls = clear.gain, clear.falls
        smooth = falls < -SLIGHT and gain > WANDERS
    if not smooth:
        gain, falls = damping(fitted, by_sensor=True) if early else (0.0, 0.0)
    half_variance = -falls
    if gain < WANDERS or half_variance < 0.5 * (LEAST_LAG * trial.h) ** 2:
        return None
    kinds: list[tuple[Callable[..., Filter], list[float]]] = []
    if early:
        kinds.append((Lag, _times(np.sqrt(2.0 * half_variance), TRIED)))
    if smooth:
        kinds += [(partial(Smoothing, k), s) for k, s in _sizes(trial, half_variance).items()]
    return likeliest(trial, kinds, lambda _: falls > -LEAST)


def likeliest(
    trial: Trial,
    kinds: Sequence[tuple[Callable[..., Filter], list[float]]],
    slight: Callable[[Filter], bool],
    judged: Callable[[Trial, Sequence[Filter]], Judge] = Judge,
    plainest: Callable[[Judge, list[Filter]], Filter] = lambda _, alike: _lag_or_first(alike),
) -> Filter | None:
    """Of filters of ``kinds`` the one behind which the sensor explains the reference best, if that
    is what the reference is behind: of those that say as much, best first, the ``plainest``. One
    that is ``slight`` may be a sensor's ring.
    """
    judge = judged(_busiest(trial), [make(size=s) for make, sizes in kinds for s in sizes])
    # No filter explains more than what looks like one.
    if not judge.any_short or judge.alike(None) < 2.0 * WANDERS:
        return None
    found = [_finest(make, sizes, judge.left) for make, sizes in kinds]
    found = sorted(found, key=judge.left)
    alike = [f for f in found if judge.left(f) - judge.left(found[0]) < 2.0 * WANDERS]
    best = plainest(judge, alike)
    if slight(best) and not isinstance(best, Lag) and any(map(_looks_like_a_ring, alike)):
        return None
    # How far it goes, all rows say.
    sizes, make = _times(best.size, NEAR), partial(replace, best)
    judge = judged(trial, [make(size=s) for s in sizes])
    if not judge.any_short:
        return None
    best = _finest(make, sizes, judge.left)
    explains = judge.gain(best) > 2.0 * WANDERS
    return best if explains and judge.alike(best) < MOSTLY * judge.alike(None) else None


def _lag_or_first(alike: list[Filter]) -> Filter:
    """Where a low-pass filter says as much, the clock's delay is explained with it."""
    return next((f for f in alike if isinstance(f, Lag)), alike[0])


def _looks_like_a_ring(one: Filter) -> bool:
    return isinstance(one, Smoothing) and KINDS[one.kind].variance > 0.0


def _busiest(trial: Trial) -> Trial:
    """The trial's longest segment, or of it the ``ROWS`` in which it moves most."""
    a, b = max(trial.segments, key=lambda s: s[1] - s[0])
    if b - a > ROWS:
        moved = trial.u[:, OWN[trial.kind]] if trial.place is None else trial.place.across
        power = np.append(0.0, np.cumsum(np.sum(moved[a:b] ** 2, axis=1)))
        a += int(np.argmax(power[ROWS:] - power[:-ROWS]))
        b = a + ROWS
    return replace(trial, segments=[(a, b)])


def _sizes(trial: Trial, half_variance: float) -> dict[str, list[float]]:
    """Sizes of each kind of smoothing to begin with, rising."""
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


def _finest(make: Callable[..., Filter], sizes: list[float], left: Callable) -> Filter:
    """The filter that leaves least of those that ``make`` makes of a ``size`` within ``sizes``, as
    far as these can be judged.
    """
    sizes = [size for size in sizes if np.isfinite(left(make(size=size)))] or sizes[:1]
    tried = [make(size=size) for size in sizes]
    if len(tried) == 1:
        return tried[0]
    at = min(range(len(tried)), key=lambda i: left(tried[i]))
    near = sizes[max(at - 1, 0)], sizes[min(at + 1, len(sizes) - 1)]
    found = minimize_scalar(
        lambda x: left(make(size=float(np.exp(x)))),
        bounds=tuple(np.log(near)),
        method="bounded",
        options={"xatol": CLOSE},
    )
    return min((tried[at], make(size=float(np.exp(found.x)))), key=left)
