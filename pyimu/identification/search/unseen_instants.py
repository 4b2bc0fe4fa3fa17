"""Instants of events that lie in rows held out of the middle of a log: those before and after show
that something happened between them, and only the held-out rows when.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.mixture import REACH
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.confirm import evidence
from pyimu.identification.search.form import UNUSED, form_of, since_power_on
from pyimu.identification.search.instants import TRIED
from pyimu.identification.search.threshold import LIKELY
from pyimu.model.catalogue import CATALOGUE

UNSURE = 2.0
"""Standard errors of an instant within which it may lie in the rows that are held out."""


def with_unseen_instants(old: Fit, new: Fit, effect: str, held: Sequence[Trial]) -> Fit:
    """The ``new`` model with those events of an effect that may lie between fitted rows at the
    instants for which the held-out rows there speak most; their sizes stay the fitted rows'.
    """
    if not CATALOGUE[effect].has_events:
        return new
    name = form_of(CATALOGUE[effect])
    for k in np.flatnonzero(new.sensor.values[effect][name] < UNUSED):
        std = new.std.get(Coefficient(effect, name, (int(k),)), 0.0)
        for trial in held:
            gap = _gap(new, trial)
            at = float(new.sensor.values[effect][name][k])
            if gap and gap[0] - UNSURE * std <= at <= gap[1] + UNSURE * std:
                new = _placed(old, new, (effect, name, int(k)), trial, gap)
    return new


def _gap(fitted: Fit, held: Trial) -> tuple[float, float] | None:
    """From when to when, in s since power-on, rows are held out between a log's fitted ones; None
    where they are not.
    """
    of_log = (t for t in fitted.trials if t.name == held.parent)
    around = any(t.time[0] < held.time[0] and held.time[-1] < t.time[-1] for t in of_log)
    if not around or held.reduction is not None:
        return None
    return tuple(float(since_power_on(held, held.time[row])) for row in (0, -1))


def _placed(
    old: Fit, new: Fit, event: tuple[str, str, int], held: Trial, gap: tuple[float, float]
) -> Fit:
    """The model with one event at the likeliest of instants ever closer together, or where it is;
    ``event`` are effect, parameter and number.
    """
    effect, name, number = event
    first, last = gap
    best, most, std = new, _gained(old, new, held), np.inf
    while True:
        times = np.linspace(first, last, TRIED)
        moved = [_moved(new, event, time) for time in times]
        gained = np.array([_gained(old, m, held) for m in moved])
        if gained.max() > most:
            best, most = moved[int(np.argmax(gained))], gained.max()
        apart = float(times[1] - times[0])
        likely = times[gained > most - 0.5 * LIKELY]
        if len(likely):
            std = min(std, float(np.ptp(likely) + apart) / (2 * REACH))
        if apart <= held.h:
            key = Coefficient(effect, name, (number,))
            return best if best is new else replace(best, std={**best.std, key: std})
        at = float(best.sensor.values[effect][name][number])
        first, last = max(at - apart, gap[0]), min(at + apart, gap[1])


def _moved(fitted: Fit, event: tuple[str, str, int], time: float) -> Fit:
    effect, name, number = event
    values = np.array(fitted.sensor.values[effect][name])
    values[number] = time
    return replace(fitted, sensor=fitted.sensor.with_values(effect, **{name: values}))


def _gained(old: Fit, new: Fit, held: Trial) -> float:
    return float(evidence(old, new, [held]).gained.sum())
