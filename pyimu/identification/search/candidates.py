"""Which effects could explain a residual, and the columns by which each shows itself."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from pyimu.identification.fit.columns import in_log
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Key, Scanned, coefficients_of
from pyimu.identification.fit.normal import Normal
from pyimu.identification.fit.response import is_step, predict
from pyimu.identification.fit.trial import Trial, known_to_all
from pyimu.identification.search.form import Form, can_be_formed
from pyimu.model.arguments import Parameter
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.sensor import Sensor, candidates
from pyimu.recording.reference.unsmoothed import SMOOTHED

CONING = "coning"
"""The effect that is w x w' of the rate w."""

MOST_ENTRIES = 6
"""Entries of a row of which all combinations are looked at."""


@dataclass(frozen=True)
class Choice:
    """One way for an effect to explain part of the residual.

    Columns with their coefficients, and for a scan the value that it stands for.
    """

    columns: tuple[int, ...]
    value: float | None = None
    keys: tuple[Key, ...] = ()

    def at(self, place: Mapping[int, int]) -> Choice:
        """The same choice, its columns at another place."""
        return replace(self, columns=tuple(place[c] for c in self.columns))


@dataclass(frozen=True)
class Group:
    """The part of an effect that is let in or left out as one.

    An axis, or the whole where a coefficient is shared.
    """

    effect: str
    keys: tuple[Key, ...]
    choices: tuple[Choice, ...]

    def only(self, choice: Choice) -> Group:
        """The group with the coefficients of one of its choices."""
        return replace(self, keys=choice.keys or self.keys)

    @property
    def measure(self) -> str | None:
        """What the scan of this group counts in, None where there is none."""
        return next(
            (
                p.scan.measure
                for p in CATALOGUE[self.effect].parameters.values()
                if p.sought and self.choices[0].value
            ),
            None,
        )


def absent(fit: Fit) -> list[Effect]:
    """Deterministic effects that the model lacks, whose inputs every log knows and whose
    coefficients have slopes or a scan.

    A course shows no sensor's delay: a tracked point ``l`` ahead of the axle turns its course l / v
    before the vehicle turns, and the clock stands for that. Where a reference's clock is seen, a
    clock of the sensor that runs at another rate is the same, and where attitudes were smoothed,
    what their filter is off by is the same as coning.
    """
    known = known_to_all(fit.trials)
    present = {name for name in fit.sensor.values if not fit.sensor.is_off(name)}
    twins = set().union(*(equivalent(name) for name in present))
    timed = all(t.reference != "course" for t in fit.trials)
    clocked = any(t.clock is not None and t.clock.is_seen for t in fit.trials)
    smoothed = has_smoothed_attitudes(fit.trials)
    return [
        e
        for e in candidates(fit.sensor.kind, present | twins)
        if not e.per_power_on
        and (timed or e.delay is None)
        and not (e.clock and (clocked or not timed))
        and not (e.name == CONING and smoothed)
        and has_columns(e, fit.sensor.kind)
        and e.signals(fit.sensor.kind) <= known
    ]


def has_smoothed_attitudes(trials: Iterable[Trial]) -> bool:
    """Whether a filter was taken out of the attitudes of any of the trials."""
    found = (f for t in trials for f in t.findings)
    return any(f.kind == SMOOTHED and f.column == "ref_q" for f in found)


def has_columns(e: Effect, kind: str) -> bool:
    """Whether regression can find an effect.

    No noise, no staircase, and no form, nor a memory beyond a filter's, that cannot be tried.
    """
    if e.stochastic or is_step(e, kind):
        return False
    return can_be_formed(e, kind) or not (e.remembers or has_form(e))


def has_form(e: Effect) -> bool:
    """Whether coefficients of an effect only shape it."""
    return any(p.form for p in e.parameters.values())


def contestable(fit: Fit, declared: Iterable[str]) -> list[Effect]:
    """Deterministic effects of ``declared`` whose coefficients are still held.

    The data may contradict them.
    """
    names = set(declared)
    return [
        e
        for e in fit.sensor.effects
        if e.name in names
        and not fit.sensor.is_off(e.name)
        and not e.per_power_on
        and has_columns(e, fit.sensor.kind)
        and not has_form(e)
        and not coefficients_of(fit.sensor, e.name) & fit.free
    ]


def scanned(effect: Effect) -> Parameter | None:
    """The coefficient of an effect that must be scanned for, if any."""
    return next((p for p in effect.parameters.values() if p.sought), None)


def scan_columns(fit: Fit, effects: Iterable[Effect]) -> Callable:
    """Column maker for ``Fit.linearise``.

    What each scanned value of each effect would change in the output of the fitted model.
    """
    found = [(e, n, p) for e in effects for n, p in e.parameters.items() if p.sought]

    def add_all(trial: Trial, u: np.ndarray, y: np.ndarray, add: Callable) -> None:
        if trial.reference == "static" or trial.reduction is not None:
            return
        sensor = in_log(fit.sensor, fit.states[trial.name])
        for e, name, p in found:
            for number, value in enumerate(_grid(p, trial, y)):
                changed = (
                    predict(
                        sensor.with_values(e.name, **{name: np.full(p.shape, value)}),
                        u,
                        trial.segments,
                        trial.h,
                    )
                    - y
                )
                for i in range(3):
                    index = (i,) if p.shape else ()
                    add(Scanned(e.name, name, index, number, float(value)), i, changed[:, i])

    return add_all


def _grid(p: Parameter, trial: Trial, y: np.ndarray) -> np.ndarray:
    largest = np.abs(trial.y[:, list(trial.axes)]).max()
    return p.scan.values(trial.h, float(largest))


def groups(
    normal: Normal, sensor: Sensor, effects: Iterable[Effect], whole: bool = False
) -> list[Group]:
    """What selection chooses among, from the columns that are there (a column that no log excites
    is not); of ``whole`` rows the entries are not let in one by one.
    """
    out = []
    for e in effects:
        new = e.name not in sensor.values or sensor.is_off(e.name)
        out += (
            _scan_groups(normal, sensor, e)
            if scanned(e) and new
            else _linear_groups(normal, sensor, e, whole)
        )
    return out


def _scan_groups(normal: Normal, sensor: Sensor, e: Effect) -> list[Group]:
    by_index: dict[tuple, list[Key]] = {}
    for key in normal.keys:
        if isinstance(key, Scanned) and key.effect == e.name:
            by_index.setdefault(key.index, []).append(key)
    coefficients = coefficients_of(sensor, e.name)
    return [
        Group(
            e.name,
            tuple(sorted(k for k in coefficients if k.index == index)),
            tuple(Choice((normal.position[k],), k.value) for k in keys),
        )
        for index, keys in by_index.items()
    ]


def _linear_groups(normal: Normal, sensor: Sensor, e: Effect, whole: bool) -> list[Group]:
    """A group for each axis of an effect, in which each entry is let in or left out by itself,
    unless they are to go in as a ``whole``.
    """
    coefficients = coefficients_of(sensor, e.name)
    present = [k for k in normal.keys if k in coefficients]
    rows: dict[int, list[Key]] = {}
    for key in present:
        rows.setdefault(key.index[0] if key.index else -1, []).append(key)
    return [
        Group(e.name, tuple(keys), tuple(_choice(normal, some) for some in subsets(keys, whole)))
        for keys in rows.values()
    ]


def _choice(normal: Normal, keys: Sequence[Key]) -> Choice:
    return Choice(tuple(normal.position[k] for k in keys), None, tuple(keys))


def subsets(keys: Sequence[Key], whole: bool = False) -> list[tuple[Key, ...]]:
    """All of them together first, then all fewer ones; of a great many, those of one and two."""
    fewer = range(len(keys) - 1, 0, -1) if len(keys) <= MOST_ENTRIES else (2, 1)
    sizes = [] if whole else fewer
    return [tuple(keys), *(some for n in sizes for some in combinations(keys, n))]


def equivalent(name: str) -> set[str]:
    """Effects of one family with this one: other forms of the same error."""
    family = CATALOGUE[name].family
    return {e.name for e in CATALOGUE.values() if family and e.family == family} - {name}


def with_start(
    sensor: Sensor, group_values: dict[tuple, float], effect: str, form: Form | None = None
) -> Sensor:
    """Sensor with an effect put in, its scanned coefficients at the values given by index, its
    ``form`` as it was found, all else at the identity.

    An effect that is there already keeps its values.
    """
    if effect in sensor.values and not sensor.is_off(effect):
        return sensor
    e = CATALOGUE[effect]
    name = next((n for n, p in e.parameters.items() if p.sought), None)
    if name is None:
        return sensor.with_values(effect, **({} if form is None else form.values))
    array = np.array(e.start()[name])
    for index, value in group_values.items():
        array[index] = value
    return sensor.with_values(effect, **{name: array})
