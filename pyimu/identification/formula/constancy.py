"""Whether a named effect is the same everywhere in the logs, as an effect of a sensor is.

An error that has no name is given that of the effect which it resembles most. What tells them apart
is that an effect's coefficients are constants: its share of the output, times slow functions of
time, drawn as another function of itself, or as it was a while ago, explains nothing more. Nyblom
(1989), "Testing for the constancy of parameters over time", JASA 84, asks the first of these of any
regression; all three are asked here as terms of a formula are, whitened, beside the model.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter

import numpy as np

from pyimu.identification.fit.columns import in_log
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import before, reference_input
from pyimu.identification.fit.keys import Shape
from pyimu.identification.fit.limited import without_limit
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.trial import Trial
from pyimu.identification.formula.memory import low_passed
from pyimu.identification.formula.screen import UNEXPLAINED, Scored, scored
from pyimu.identification.formula.terms import Term
from pyimu.identification.search.inexact import left_by_forms
from pyimu.identification.search.investigation import Investigation, Step
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.search.taken_back import without
from pyimu.model.arguments import AXES
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor

SLOW = 6
"""Half waves over all logs of the fastest change in time: 100 s each in ten minutes of logs."""

BENT = 12
"""Half waves over the range of an effect's share of the output: six stairs."""

AGO = (0.3, 1.0, 3.0, 10.0)
"""s; over which a share of the output is remembered."""

ENDS = (0.005, 0.995)
"""Quantiles of a share of the output between which it is bent."""

ANOTHER = 0.25
"""Share of what an effect explains from which on what its inconstancy does makes another error of
it: half of its amplitude."""

REST = 0.05
"""Share of it from which on it is said: less than a fifth of its amplitude is a matter of form."""


@dataclass(frozen=True)
class Variation(Term):
    """The columns of an ``effect`` that is inconstant in one ``way``."""

    effect: str = ""
    way: str = ""


WAYS: Mapping[str, int] = {
    "of another size from minute to minute": 2 * SLOW,
    "not in proportion to what drives it": BENT,
    "with a memory of what went before": 2 + 2 * len(AGO),
}
"""How an effect may be inconstant, and how many columns tell."""


@dataclass(frozen=True)
class Constancy:
    """An investigation less what only resembled its effects, and what is ``unexplained`` by it."""

    investigation: Investigation
    unexplained: tuple[Unexplained, ...] = ()


def less_inconstant(inv: Investigation, formula: str = "") -> Constancy:
    """An investigation less each effect that is another from minute to minute, is bent, or has a
    memory, by so much that it is not what it is called; with what is inconstant in any. A
    ``formula`` is not asked: it has no name that would say more than it does.
    """
    seen: dict[str, Unexplained] = {}
    while (worst := _least_constant(inv, {formula, *seen})) is not None:
        effect, way = worst.found.term.effect, worst.found.term.way
        # A lag of another order, or beside a clock that slips, is a lag all the same.
        taken_back = worst.share > ANOTHER and CATALOGUE[effect].stage != "dynamics"
        said = f"an error like {effect}, but {way}" if taken_back else f"a rest of {effect}, {way}"
        kind, axis = inv.after.sensor.kind, AXES[worst.found.axis]
        seen[effect] = Unexplained(kind, axis, (), worst.chance, said)
        if taken_back:
            inv = without(inv, effect, f"it is {way}")
    return Constancy(inv, tuple(seen.values()))


@dataclass(frozen=True)
class _Inconstant:
    """A variation that was ``found`` beyond chance, by which ``chance`` of all that were asked, and
    which ``share`` of what its effect explains it does.
    """

    found: Scored
    chance: float
    share: float


def _least_constant(inv: Investigation, known: set[str]) -> _Inconstant | None:
    """How the effect that is inconstant most clearly but for those ``known`` is; None where all are
    constant.
    """
    steps = {s.effect: s for s in inv.steps if _is_asked(s) and s.effect not in known}
    if inv.after.is_reduced or not steps:
        return None
    declared = inv.after.as_declared()
    # By the noise that the residual shows, too: one that wanders follows any slow column by chance.
    fits = (inv.after,) if declared is inv.after else (declared, inv.after)
    first, *rest = (_found(f, list(steps)) for f in fits)
    chance = attrgetter("p_value")
    less_clear = [max([s, *(r[t] for r in rest if t in r)], key=chance) for t, s in first.items()]
    of_form = left_by_forms(inv.after, inv.steps)
    for found in sorted(less_clear, key=chance):
        in_all, gain = found.p_value * len(AXES) * len(less_clear), steps[found.term.effect].gain
        if in_all < UNEXPLAINED and found.excess > max(REST * gain, of_form):
            return _Inconstant(found, in_all, found.excess / gain)
    return None


def _is_asked(step: Step) -> bool:
    """Whether an effect has a share of the output of its own: one that was declared has been seen
    in other logs, and what samples show beyond squares is no matter of size.
    """
    return not (step.declared or step.as_sampled or CATALOGUE[step.effect].stochastic)


def _found(fit: Fit, effects: Sequence[str]) -> dict[str, Scored]:
    """By text what each way in which each effect may be inconstant explains beside a model."""
    shares = _shares(fit, effects)

    def columns_of(kind: str, terms: Sequence[Variation]) -> Callable:
        def add_all(trial: Trial, u: np.ndarray, add: Callable) -> None:
            # Made of the inputs as they come: beside a noisy reference these are moved.
            added = _added(fit, trial, u, {t.effect for t in terms})
            for term in terms:
                for i in range(3):
                    each = shares[term.effect].columns(term.way, trial, added[term.effect][:, i], i)
                    for n, column in enumerate(each):
                        add(Shape(term.text, n, i), i, column)

        return add_all

    terms = [_variation(e, way) for e in effects for way in WAYS]
    return {s.term.text: s for s in scored(fit, terms, columns_of).terms}


def _variation(effect: str, way: str) -> Variation:
    columns = ("",) * WAYS[way]
    text = f"{effect} {way}"
    return Variation(text, columns, columns, columns, frozenset(), 1, effect=effect, way=way)


@dataclass(frozen=True)
class _Share:
    """Of what an effect adds to the output the ``ends`` (2, 3) of its range, and by log the time
    [0..1] that has passed in all logs, one after another.
    """

    ends: np.ndarray
    passed: Mapping[str, np.ndarray]

    def columns(self, way: str, trial: Trial, share: np.ndarray, axis: int) -> Iterator[np.ndarray]:
        """The columns (n,) of one way in which what is added (n,) to an axis may be inconstant."""
        if not share.any():
            return
        change = np.gradient(share, trial.h)
        in_time, bent, _ = WAYS
        if way == in_time:
            # Times its rate, too: that of a line, and what is late, is another phase.
            for wave in _waves(self.passed[trial.name], SLOW):
                yield share * wave
                yield change * wave
        elif way == bent:
            low, high = self.ends[:, axis]
            if high > low:
                yield from _waves(np.clip((share - low) / (high - low), 0.0, 1.0), BENT)
        else:
            yield change
            yield share * np.sign(change)
            for seconds in AGO:
                yield low_passed(share, trial.h / seconds)
                yield low_passed(np.abs(share), trial.h / seconds)


def _waves(x: np.ndarray, count: int) -> Iterator[np.ndarray]:
    """Cosines of 1 to ``count`` half waves over a range of numbers from 0 to 1."""
    return (np.cos(np.pi * k * x) for k in range(1, count + 1))


def _shares(fit: Fit, effects: Sequence[str]) -> dict[str, _Share]:
    inputs = ((t, reference_input(t, fit.states[t.name])) for t in fit.trials)
    added, passed = [_added(fit, t, u, effects) for t, u in inputs], _passed(fit.trials)
    every = {e: np.concatenate([one[e] for one in added]) for e in effects}
    return {e: _Share(np.quantile(v, ENDS, axis=0), passed) for e, v in every.items()}


def _added(
    fit: Fit, trial: Trial, u: np.ndarray, effects: Collection[str]
) -> dict[str, np.ndarray]:
    """What each effect adds (n, 3) to the output of a model of inputs ``u``."""
    state = fit.states[trial.name]
    earlier = before(trial, state)
    sensor = without_limit(in_log(fit.sensor, state), trial)[0]

    def output(one: Sensor) -> np.ndarray:
        return predict(one, u, trial.segments, trial.h, earlier)

    whole = output(sensor)
    return {e: whole - output(sensor.without(e)) for e in effects}


def _passed(trials: Sequence[Trial]) -> dict[str, np.ndarray]:
    lengths = np.array([t.time[-1] - t.time[0] + t.h for t in trials])
    begins = np.cumsum(lengths) - lengths
    every = zip(trials, begins, strict=True)
    return {t.name: (at + t.time - t.time[0]) / lengths.sum() for t, at in every}
