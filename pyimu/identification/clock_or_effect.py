"""Whether a reference's clock drifts, or an effect makes it look so.

A clock that drifts by less than a sample, and an effect that follows the motion, bend the lags of a
log alike. What the search finds beside each is the evidence.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from pyimu.identification.fit.maximum_likelihood import advantage
from pyimu.identification.fit.trial import Trial
from pyimu.identification.formula.effect import put
from pyimu.identification.formula.search import Look
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import CATALOGUE


def _is_doubtful(trials: Iterable[Trial]) -> bool:
    """Whether some clock may only look as if it drifted."""
    return any(t.clock is not None and t.clock.doubtful for t in trials)


def likelier_clock(one: Look, keeps: Callable[[], Look]) -> Look:
    """``one``, what was found beside a clock that drifts; where that is doubtful and leaves
    something to find, the likelier of it and of what is found beside one that ``keeps`` its lag.
    """
    inv = one.investigation
    if _is_clean(one) or not _is_doubtful([*inv.before.trials, *inv.held]):
        return one
    _forget(one)
    other = keeps()
    if _ahead(one, other) <= 0.0:
        return other
    _forget(other)
    if one.formula is not None:
        put(one.formula.effect)
    return one


def _is_clean(look: Look) -> bool:
    inv = look.investigation
    return not (inv.steps or inv.refused or inv.unfit or look.unexplained or look.formula)


def _forget(look: Look) -> None:
    """Take its formula out of the catalogue: another may have its name."""
    if look.formula is not None:
        CATALOGUE.remove(look.formula.name)


def _ahead(one: Look, other: Look) -> float:
    """Log-likelihood [nat], penalised, by which a clock that drifts explains more with what was
    found beside it; its offset is one coefficient of each log that is fitted.
    """
    lines = sum(t.clock is not None and t.clock.doubtful for t in one.investigation.after.trials)
    count, others = (sum(len(s.keys) for s in v.investigation.steps) for v in (one, other))
    apart = advantage(one.investigation.after, other.investigation.after)
    return apart - PENALTY * (count + lines - others)
