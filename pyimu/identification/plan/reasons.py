"""Why no motion of the library shows a coefficient, and what no log tells an effect from."""

from __future__ import annotations

from collections.abc import Sequence

from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.trial import Trial
from pyimu.identification.model.as_part import si_of
from pyimu.identification.plan.choice import LONGEST
from pyimu.identification.plan.goals import Goal, told
from pyimu.identification.plan.information import Information
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.report.numbers import quantity


def not_planned(e: Effect) -> str:
    """Why no regressor of an effect follows from a motion; empty where one does."""
    if e.stochastic:
        return (
            "it is a noise, which needs no motion: let the part rest, the longer the better, and "
            "pyimu characterize gives it with its interval"
        )
    if e.per_power_on:
        return "it is drawn anew at each power-on, so any rest shows that of its log alone"
    if any(p.reads == "step" for p in e.parameters.values()):
        return "it is read off the raw samples of any log, and needs no motion"
    if any(p.unit == "s" and p.form and p.shape for p in e.parameters.values()):
        return "it is an event, which no motion calls forth"
    return ""


def not_known(e: Effect, kind: str, trial: Trial) -> str:
    """Which signals of an effect close does not have in a log; empty where it has all."""
    missing = sorted(e.signals(kind) - trial.known)
    if not missing:
        return ""
    names = " and ".join(m.replace("_", " ") for m in missing)
    return f"close does not follow the {names} in a log, so it does not look for this effect"


def hidden(goal: Goal, alone: Information, joint: Information, asked: Sequence[str]) -> str:
    """Why a coefficient is not shown by all motions of the library together."""
    key = goal.key
    if key not in alone.keys or not alone.gram[(i := alone.keys.index(key)), i] > 0.0:
        return _no_input(key)
    others = [n for n in asked if n != key.effect]
    if _shown(joint, key, [k for k in joint.keys if k.effect not in others]):
        return f"no motion of the library tells it from {told(others)}: ask for each alone"
    if _shown(joint, key, [key]):
        return "no motion of the library tells it from its effect's other coefficients"
    return "no motion of the library tells it from the bias or the mounting of the log"


def too_small(g: Goal, std: float) -> str:
    unit = si_of(g.key.effect, g.key.parameter, g.unit)
    of = "" if g.size is None else f" with its size of {quantity(g.size, unit, 2)}"
    return (
        f"too small{of}: {LONGEST / 3600:g} h of each motion would still leave a standard error of "
        f"{quantity(std, unit, 2)}"
    )


def _no_input(key: Coefficient) -> str:
    e = CATALOGUE[key.effect]
    if any(p.reads == "ceiling" for p in e.parameters.values()):
        return "no motion of the library goes beyond this limit: turn or shake harder"
    return "no motion of the library excites it"


def _shown(found: Information, key: Coefficient, keys: Sequence[Coefficient]) -> bool:
    return found.on(keys).errors()[key] < float("inf")


def confound_note(e: Effect) -> str:
    """What no log tells an effect from; empty where there is nothing."""
    if e.confound is None:
        return ""
    name = e.name.replace("_", " ")
    return f"{name}: no log tells it from {e.confound.of}; {e.confound.apart} would"
