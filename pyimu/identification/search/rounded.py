"""Whether an effect is no more than what the rounding of a reference's numbers may make."""

from __future__ import annotations

from pyimu.identification.fit.columns import residual
from pyimu.identification.fit.digits import may_be_rounding
from pyimu.identification.fit.fit import Fit
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
