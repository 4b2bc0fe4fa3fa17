"""A plan in words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from pyimu.identification.model.as_part import SENSORS, si_of
from pyimu.identification.plan.goals import told
from pyimu.identification.plan.outcome import Outcome, Predicted
from pyimu.model.catalogue import CATALOGUE
from pyimu.report.numbers import joined, number, quantity


def lasting(seconds: float) -> str:
    """A duration as people say it."""
    if seconds < 5400:
        return f"{number(seconds / 60, 2 if seconds < 600 else 3)} min"
    return f"{number(seconds / 3600, 2)} h"


def headline(p: Outcome) -> str:
    """What to do, for how long, and what it shows."""
    if not p.logs:
        return f"No motion of the library shows {told(p.effects)} of the {SENSORS[p.kind]}."
    shown = dict.fromkeys(q.goal.key.effect for q in p.predicted if q.goal.wanted and q.reached)
    least = min((q.sigmas for q in p.predicted if q.reached and np.isfinite(q.sigmas)), default=0)
    done = f"{lasting(p.duration)[0].upper()}{lasting(p.duration)[1:]} would show "
    said = f"{told(list(shown))} of the {SENSORS[p.kind]}" if shown else "less than is wanted"
    level = f", each coefficient at {number(least, 2)} standard errors or more" if least else ""
    return f"{done}{said}{level}{_but(p)}."


def _but(p: Outcome) -> str:
    left = sum(not q.reached or bool(q.reason and q.goal.wanted) for q in p.predicted)
    return f"; {left} of {len(p.predicted)} coefficients less well than is wanted" if left else ""


def in_lines(p: Outcome) -> str:
    """For a terminal."""
    lines = [f"plan for {p.part}, {SENSORS[p.kind]}: {headline(p)}"]
    for s in p.steps:
        times = f"{s.times} times " if s.times > 1 else ""
        lines.append(f"  {lasting(s.duration)}: {times}{s.motion.text}")
    lines += [f"  {line}" for line in _of_effects(p.predicted)]
    lines += [f"  {note}" for note in p.notes]
    noise = f"noise {p.noise}, the reference has none"
    return "\n".join([*lines, f"{noise}; sizes of a {p.of_class} part where none declared"])


def _of_effects(predicted: Sequence[Predicted]) -> Iterable[str]:
    for effect in dict.fromkeys(q.goal.key.effect for q in predicted):
        own = [q for q in predicted if q.goal.key.effect == effect]
        known = [q for q in own if np.isfinite(q.std) and not q.reason]
        for name in dict.fromkeys(q.goal.key.parameter for q in known):
            worst = max((q for q in known if q.goal.key.parameter == name), key=lambda q: q.std)
            said = f"±{error(worst)} (standard error){_sized(worst)}{_missed(worst)}"
            yield f"{effect} {name}: {said}"
        for reason, ones in by_reason(own).items():
            yield f"{effect}{_which(ones, own)}: {reason}"


def error(q: Predicted) -> str:
    return quantity(q.std, si_unit(q), 2)


def si_unit(q: Predicted) -> str:
    return si_of(q.goal.key.effect, q.goal.key.parameter, q.goal.unit)


def _sized(q: Predicted) -> str:
    if q.goal.size is None:
        return ""
    size = quantity(q.goal.size, si_unit(q), 2)
    return f", {number(q.sigmas, 2)} of them in its {q.goal.source} size of {size}"


def _missed(q: Predicted) -> str:
    return "" if q.reached else f"; wanted were ±{quantity(q.goal.wanted, si_unit(q), 2)}"


def by_reason(predicted: Iterable[Predicted]) -> dict[str, list[Predicted]]:
    found: dict[str, list[Predicted]] = {}
    for q in predicted:
        if q.reason:
            found.setdefault(q.reason, []).append(q)
    return found


def place(q: Predicted) -> str:
    """A coefficient's name: ``G x from y``."""
    key = q.goal.key
    where = CATALOGUE[key.effect].parameters[key.parameter].place(key.index) if key.index else ""
    return f"{key.parameter} {where}".rstrip()


def _which(ones: Sequence[Predicted], own: Sequence[Predicted]) -> str:
    if len(ones) == len(own):
        return ""
    return f" {joined([place(q) for q in ones])}"
