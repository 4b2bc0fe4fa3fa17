"""What the rounding of a reference's numbers may make: an effect, or a residual."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import residual
from pyimu.identification.fit.digits import may_be_rounding
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial, marked
from pyimu.model.kinds import OWN

OF_DIGITS = "is no more than the rounding of the reference's numbers may do"
"""The reason for which an effect is refused that such rounding may make."""


def within_digits(old: Fit, new: Fit) -> bool:
    """Whether two models differ by no more than the rounding of the references may do, in all
    logs.
    """
    return all(_within(old, new, t) for t in new.trials)


def _within(old: Fit, new: Fit, trial: Trial) -> bool:
    if not any(trial.digits):
        return False
    counts = marked(trial.row_segments, len(trial.time))
    was, now = (residual(f.sensor, trial, f.states[trial.name])[counts] for f in (old, new))
    return may_be_rounding(now - was, trial.u[counts][:, OWN[trial.kind]], trial.digits)


def without_rounding(fit: Fit) -> Fit | None:
    """A model beside the logs without what the rounding of their references may have made, with the
    noise that is left then; None where no reference's digits show.
    """
    if not any(any(t.digits) for t in fit.trials):
        return None
    return replace(fit, trials=tuple(less_rounding(fit, t) for t in fit.trials)).with_noise()


def less_rounding(fit: Fit, trial: Trial) -> Trial:
    """A log without the mean of its residual at each digit of its reference, of half a step at
    most: a digit that stays keeps its error, which is as slow as the motion is, and follows it.
    """
    if not any(trial.digits):
        return trial
    state = fit.states[trial.name] if trial.name in fit.states else held_state(fit, trial)[0]
    left, x = residual(fit.sensor, trial, state), trial.u[:, OWN[trial.kind]]
    counts = marked(trial.row_segments, len(trial.time))
    each = zip(left.T, x.T, trial.digits, strict=True)
    errors = [_of_digits(r, at, step, counts) for r, at, step in each]
    return replace(trial, y=trial.y - np.column_stack(errors))


def _of_digits(r: np.ndarray, x: np.ndarray, step: float, counts: np.ndarray) -> np.ndarray:
    """The error (n,) of each row's digit by the rows that count."""
    if not step:
        return np.zeros(len(r))
    digits = np.unique(np.rint(x / step), return_inverse=True)[1]
    sums = np.bincount(digits[counts], r[counts], digits.max() + 1)
    number = np.bincount(digits[counts], minlength=digits.max() + 1)
    return np.clip(sums / np.maximum(number, 1), -0.5 * step, 0.5 * step)[digits]
