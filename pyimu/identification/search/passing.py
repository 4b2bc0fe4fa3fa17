"""Events of which a few rows alone speak, as errors do whose size follows the motion."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.search.form import UNUSED, form_of, since_power_on
from pyimu.model.catalogue import CATALOGUE

FEW = 8
"""Rows that a level must last for to be one: fewer lie far off where noise is larger for a moment,
as that of a reference whose stamps scatter is in a quick turn."""

GOES = 0.5
"""Share of a step that is left after the next one, below which its level has gone again."""


def passing(fitted: Fit, effect: str) -> str:
    """Why the events of an effect are no steps of a bias, but a pulse; nothing where they may be.

    A level lasts from one event of an axis to its next. A bias that steps stays, or steps again
    after a while.
    """
    e = CATALOGUE[effect]
    if not e.has_events:
        return ""
    values, form = fitted.sensor.values[effect], form_of(e)
    times = np.array(values[form])
    sizes = next(np.array(values[n]) for n, p in e.parameters.items() if not p.form)
    for axis, own in enumerate(sizes):
        there = [k for k in np.argsort(times) if own[k] and times[k] < UNUSED]
        for k, after in pairwise(there):
            rows = sum(_rows_between(fitted, times[k], times[after]))
            if rows < FEW and abs(own[k] + own[after]) < GOES * abs(own[k]):
                return (
                    f"its level on {'xyz'[axis]} from {times[k]:.2f} to {times[after]:.2f} s is "
                    f"told by {rows} rows alone, and gone then: a pulse, and no bias"
                )
    return ""


def _rows_between(fitted: Fit, first: float, last: float) -> list[int]:
    """Of each log the rows between two times since power-on, s."""
    since = (since_power_on(t, t.row_time) for t in fitted.trials)
    return [int(np.count_nonzero((s >= first) & (s < last))) for s in since]
