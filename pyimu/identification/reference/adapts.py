"""Whether a reference lags less where it turns faster, as one behind a filter that adapts does.

No sensor lags so, and no clock: the lag of a bandwidth is the same however fast a body turns.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from scipy.optimize import minimize

from pyimu.identification.fit.columns import band_time, in_band
from pyimu.identification.fit.damping import slopes
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.align import SIGNIFICANT
from pyimu.identification.reference.behind import Filter, Undo, likeliest
from pyimu.identification.reference.clock import WINDOW, shifted
from pyimu.identification.reference.judged import Judge
from pyimu.identification.reference.moving import LEAST_ROWS, in_own_band, moving_rows
from pyimu.model.kinds import OWN
from pyimu.recording.reference.adapting import SPEED, Adapting
from pyimu.recording.reference.filters import low_passed
from pyimu.recording.reference.unlagged import unlagged

LEAST = 1e-3
"""s for each e-fold of the rate; less than a tenth of a sample is nothing that is worth undoing."""

SLOWEST = 0.05
"""Quantile of the rates below which all count as slow: the logarithm of none has no end."""

SIZES = 0.5 * 2.0 ** -np.arange(0.0, 5.0, 0.5)
"""s; time constants at rest that are tried first: cut-offs of 0.3 to 7 Hz."""

HALVES = 0.1 * 2.0 ** np.arange(0.0, 5.0, 0.5)
"""rad/s; rates at which they are half as long: of cut-offs that rise by 0.1 to 70 Hz for each."""

WIDER, CLOSE, TRIES = 2.0, 1e-3, 100
"""Times the time constant that is found first, at most, how near to the best is enough, of its
numbers and as a share of what is left, and how many are tried."""

FIRST = 0.3 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
"""Logarithms of its numbers over those that are found first, of the three tried first."""


def without_adapting(trial: Trial) -> Undo | None:
    """What takes a filter that adapts out of the reference of a trial's log; None where there is
    none.
    """
    if trial.reference != "attitude" or trial.clock is None or not trial.clock.is_seen:
        return None
    trial = in_own_band(_on_one_clock(trial))
    if not lags_less_where_fast(trial):
        return None
    kinds: list[tuple[Callable[..., Filter], list[float]]] = [
        (partial(Adapting, halves=float(h), steps=steps), SIZES[::-1].tolist())
        for steps in (True, False)
        for h in HALVES
    ]
    found = likeliest(trial, kinds, lambda _: False, plainest=lambda _, alike: alike[0])
    if found is None:
        return None
    return partial(unlagged, lag=_refined(trial, found), motion=trial.band_hz)


def _refined(trial: Trial, found: Adapting) -> Adapting:
    """The filter near to the one that was ``found``, of either form, that leaves least of the
    reference.

    Where a body turns at one rate mostly its two numbers make one lag there, whichever of the
    first ones is taken; what they make of the others, and of a form, differs.
    """
    forms = [replace(found, steps=steps) for steps in (True, False)]
    judge = Judge(trial, [replace(f, size=WIDER * f.size) for f in forms])
    if not judge.any_short:
        return found

    def near(form: Adapting, x: np.ndarray) -> Adapting:
        size, halves = np.exp(x) * (form.size, form.halves)
        return replace(form, size=float(min(size, WIDER * form.size)), halves=float(halves))

    tried, least = [found], CLOSE * judge.left(found)
    enough = {"xatol": CLOSE, "fatol": least, "maxfev": TRIES, "initial_simplex": FIRST}
    for form in forms:
        best = minimize(
            lambda x, form=form: judge.left(near(form, x)),
            np.zeros(2),
            method="Nelder-Mead",
            options=enough,
        )
        tried.append(near(form, best.x))
    return min(tried, key=judge.left)


def _on_one_clock(trial: Trial) -> Trial:
    """The trial with its reference on one clock, the mean of one that was found to change: a lag
    that follows the rate looks like that.
    """
    clock = trial.clock
    if clock is None or clock.keeps_step or not clock.taken_out:
        return trial
    one = clock.kept_in_step()
    return replace(shifted(shifted(trial, clock.back()), one), clock=one)


def lags_less_where_fast(trial: Trial) -> bool:
    """Whether a reference lags behind the sensor, and by less where it turns faster."""
    found = lag_by_rate(trial)
    if found is None:
        return False
    falls, std = found
    return falls > max(LEAST, SIGNIFICANT * std)


def lag_by_rate(trial: Trial) -> tuple[float, float] | None:
    """By how many s the lag of the reference falls where the sensor turns e times as fast, and the
    standard error of that; None where too few rows move.

    The lag is the coefficient of -dx/dt, x being the reference's rate, in the sensor's, as one
    number and one by the logarithm of the rate; the sensor's own slope, whose noise is another, is
    the instrument (Fuller 1987, "Measurement Error Models", section 1.4). The products of windows
    tell how they scatter (White 1980, Econometrica 48).
    """
    axes, rows = list(trial.axes), moving_rows(trial)
    x, y = trial.u[:, OWN[trial.kind]][:, axes], trial.y[:, axes]
    steady = low_passed(y - np.median(y, axis=0), 1.0 / (2.0 * np.pi * SPEED * trial.h))
    speed = np.linalg.norm(steady, axis=1, keepdims=True)
    both = (x, slopes(trial, x), y, slopes(trial, y), speed)
    x, slope, y, seen, speed = (in_band(trial, v)[rows] for v in both)
    if len(x) < 4 * LEAST_ROWS:
        return None
    known = np.column_stack([np.ones(len(x)), x])
    gain = np.linalg.lstsq(known, y)[0]
    left, by = y - known @ gain, slope @ gain[1:]
    least = max(float(np.quantile(speed, SLOWEST)), 1e-300)
    basis = np.column_stack([np.ones(len(x)), np.log(np.maximum(speed[:, 0], least))])
    power, product = np.sum(seen * by, axis=1), -np.sum(seen * left, axis=1)
    inverse = np.linalg.pinv((basis * power[:, None]).T @ basis)
    late = inverse @ (basis.T @ product)
    scores = basis * (product - power * (basis @ late))[:, None]
    window = ((band_time(trial)[rows] - trial.time[0]) / WINDOW).astype(int)
    sums = np.add.reduceat(scores, np.flatnonzero(np.diff(window, prepend=-1)))
    spread = inverse @ (sums.T @ sums) @ inverse.T
    return float(late[1]), float(np.sqrt(spread[1, 1]))
