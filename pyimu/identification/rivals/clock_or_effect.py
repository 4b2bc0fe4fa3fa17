"""Whether a reference's clock drifts or wanders, or an effect makes it look so.

A clock that does so by less than a sample, and an effect that follows the motion, bend the lags of
a log alike. What the search finds beside each is the evidence. And a clock that drifts is set at no
instant that is known: a delay beside it is no more the sensor's than one that differs from log to
log.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from pyimu.identification.fit.clock import WIDE
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import LogClock
from pyimu.identification.fit.maximum_likelihood import advantage
from pyimu.identification.fit.score import tally
from pyimu.identification.fit.trial import Trial
from pyimu.identification.formula.effect import put
from pyimu.identification.formula.search import Look
from pyimu.identification.reference.align import ALIKE
from pyimu.identification.reference.track import WANDERS
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import CATALOGUE


def _is_doubtful(trial: Trial) -> bool:
    """Whether the clock of a trial's reference may only look as if it did not keep its lag."""
    return trial.clock is not None and trial.clock.doubtful


def _cost(trial: Trial) -> float:
    """What a clock that does not keep its lag has to explain more [nat]: a line is one coefficient,
    what wanders or slips must be ``WANDERS`` better.
    """
    if not _is_doubtful(trial):
        return 0.0
    return PENALTY if trial.clock.is_steady and not trial.clock.slips else WANDERS


def likelier_clock(one: Look, keeps: Callable[[], Look]) -> Look:
    """``one``, what was found beside a clock that drifts or wanders; where that is doubtful, and
    leaves something to find, the likelier of it and of what is found beside one that ``keeps`` its
    lag.
    """
    inv = one.investigation
    if _is_clean(one) or not any(map(_is_doubtful, (*inv.before.trials, *inv.held))):
        return one
    _forget(one)
    other = keeps()
    if _ahead(one, other) <= 0.0:
        return other
    _forget(other)
    if one.formula is not None:
        put(one.formula.effect)
    return one


def on_their_clocks(one: Look, taken_out: Callable[[], Look]) -> Look:
    """``one``, what was found where all that the sensor is late was left to it; where it is late by
    more in the course of a log, what is found with that ``taken_out`` as the clocks'.
    """
    inv = one.investigation
    named = any(CATALOGUE[s.effect].delay is not None for s in inv.steps)
    if not named or not any(_drifts(inv.after, t) for t in inv.after.trials):
        return one
    _forget(one)
    return taken_out()


def _drifts(fitted: Fit, trial: Trial) -> bool:
    """Whether the lag of a log that was left to the sensor changes in it, beyond chance and by more
    than a lag of the sensor does, which is another at each frequency.
    """
    change = fitted.states[trial.name].clock
    if trial.clock is None or not trial.clock.own or change is None:
        return False
    std = fitted.std.get(LogClock(trial.name, 1), np.inf)
    grows = abs(change.drift) * float(trial.time[-1] - trial.time[0])
    return abs(change.drift) > WIDE * std and grows > ALIKE * trial.clock.own


def _is_clean(look: Look) -> bool:
    inv = look.investigation
    return not (inv.steps or inv.refused or inv.unfit or look.unexplained or look.formula)


def _forget(look: Look) -> None:
    """Take its formula out of the catalogue: another may have its name."""
    if look.formula is not None:
        CATALOGUE.remove(look.formula.name)


def _ahead(one: Look, other: Look) -> float:
    """Log-likelihood [nat], penalised, by which a clock that does not keep its lag explains more
    with what was found beside it.
    """
    drifts, keeps = one.investigation, other.investigation
    clocks = sum(map(_cost, drifts.after.trials))
    more = drifts.brought_in - keeps.brought_in
    fitted = advantage(drifts.after, keeps.after) - PENALTY * more - clocks
    return fitted + _ahead_on_others(drifts, keeps)


def _ahead_on_others(drifts: Investigation, keeps: Investigation) -> float:
    """The same on logs that were not fitted, whose own clocks are doubtful."""
    apart = [t for t in drifts.held if t.parent is None and _is_doubtful(t)]
    others = {t.name: t for t in keeps.held}
    pairs = [(t, others[t.name]) for t in apart if t.name in others]
    gained = sum(
        tally(drifts.after, a).log_likelihood - tally(keeps.after, b).log_likelihood
        for a, b in pairs
    )
    return gained - sum(_cost(a) for a, _ in pairs)
