"""What a residual may remember of the motion: turns or pushes that are over, fading with time.

A formula is made of signals at one instant. An error that each turn feeds and that fades after it
(moisture, creep, heat of a motor nearby) follows none of them, and looks like slow noise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.signal import lfilter

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient, Key, Shape
from pyimu.identification.fit.normal import solve
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.formula.screen import UNEXPLAINED, scored
from pyimu.identification.formula.terms import SAID, Term, usable
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.search.screen import PENALTY, is_slow
from pyimu.identification.search.taken_back import without
from pyimu.model.arguments import AXES
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.signals import COLUMNS

TIMES = (3.0, 10.0, 30.0, 100.0)
"""s; how long it takes to fade to 1/e. A column whose time is off by the root of ten still explains
two thirds of one that a motion of turns and rests fed."""

FINER = (0.56, 0.75, 1.0, 1.33, 1.78)
"""Times the best of these that are tried between them."""

WALKS = 9
"""Sizes of the walk that are tried beside a memory."""


@dataclass(frozen=True)
class Memory(Term):
    """A low-passed number: a ``component`` of a vector ``signal``, or its size, over ``tau`` s."""

    signal: str = ""
    component: int | None = None
    tau: float = 0.0


@dataclass(frozen=True)
class Remembered:
    """The memory that explains most of a residual: its penalised ``gain`` [nat] over the noise as
    declared, a walk of any size beside it, and ``likelihood`` with that; how it is said, axis by
    axis.
    """

    gain: float
    likelihood: float
    unexplained: tuple[Unexplained, ...]

    @property
    def said(self) -> str:
        return self.unexplained[0].shape


def remembered(fit: Fit) -> Remembered | None:
    """What a fit's residual remembers of the motion beside the walk that it shows, most clearly;
    None where it is nothing.
    """
    if any(not isinstance(n, RandomWalk) for n in fit.seen.values()):
        return None
    memories = _memories(fit.trials)
    scores = scored(fit, memories, columns_of) if memories else None
    if scores is None or scores.p_value >= UNEXPLAINED:
        return None
    best = scores.terms[0]
    assert isinstance(best.term, Memory)
    about = [_memory(best.term.signal, best.term.component, best.term.tau * f) for f in FINER]
    fits = {m: _beside(fit, m, best.axes) for m in about}
    memory = max(fits, key=lambda m: sum(fits[m].values()))
    known, cost = fit.as_declared().noise, PENALTY * len(best.axes) + float(np.log(len(memories)))
    linears, beside = fit.linearise(), fits[memory]
    gain = sum(beside[i] - _likelihood(linears, i, known[i], False) for i in best.axes)
    said = tuple(
        Unexplained(fit.sensor.kind, AXES[i], memory.inputs, scores.p_value, memory.text)
        for i in best.axes
    )
    return Remembered(gain - cost, sum(beside.values()) - cost, said)


def _beside(fit: Fit, memory: Memory, axes: tuple[int, ...]) -> dict[int, float]:
    """The likelihood [nat] of each axis of a fit with a memory on some of them."""
    linears = fit.beside(fit.linearise(), [columns_of(fit.sensor.kind, [memory])])
    return {i: _walking(fit, linears, i, i in axes) for i in fit.noise}


def less_than_memory(inv: Investigation) -> Investigation:
    """An investigation less its slow effects, where a memory of the motion explains more than they
    do together: each of them is slow as that is, and none is what it is. Where they leave one that
    is seen beside them, it need only explain as much.
    """
    steps = [s for s in inv.steps if not s.declared]
    if not any(is_slow(CATALOGUE[s.effect]) for s in steps):
        return inv
    memory = remembered(inv.before)
    if memory is None:
        return inv
    linears = inv.after.linearise()
    named = sum(_walking(inv.after, linears, i, False) for i in inv.after.noise)
    ahead = memory.likelihood - (named - PENALTY * inv.brought_in)
    if ahead <= (SET_WIDTH if remembered(inv.after) is None else -SET_WIDTH):
        return inv
    for s in steps:
        inv = without(inv, s.effect, f"{memory.said} explains {_said(ahead)}")
    return inv


def _said(ahead: float) -> str:
    return f"{ahead:.0f} nat more" if ahead > SET_WIDTH else "as much"


def _walking(fit: Fit, linears: list[Linear], axis: int, remembers: bool) -> float:
    """The likelihood of one axis beside the walk that suits it best, up to that of the fit."""
    known, seen = fit.as_declared().noise[axis], fit.noise[axis]
    least = max(known.k2, 1e-4 * seen.k2)
    walks = np.geomspace(least, max(seen.k2, least), WALKS) if least > 0.0 else np.zeros(1)
    noises = (replace(seen, k2=float(k2)) for k2 in walks)
    return max(_likelihood(linears, axis, noise, remembers) for noise in noises)


def _likelihood(linears: list[Linear], axis: int, noise: RandomWalk, remembers: bool) -> float:
    """Log-likelihood [nat, constant left out] of one axis of a residual less all that the columns
    of the model explain, and those of the memory, where it ``remembers``.
    """
    with_axis = [one for one in linears if axis in one.keys]
    every = dict.fromkeys(k for one in with_axis for k in one.keys[axis])
    place = {k: n for n, k in enumerate(k for k in every if remembers or not is_memory(k))}
    gram, score, total = np.zeros((len(place), len(place))), np.zeros(len(place)), 0.0
    for one in with_axis:
        columns = [one.residual[:, axis], *one.columns[axis].arrays]
        white = noise.whiten(np.column_stack(columns), one.time, one.segments)
        own = [n for n, k in enumerate(one.keys[axis]) if k in place]
        at, rows = [place[one.keys[axis][n]] for n in own], white[:, [1 + n for n in own]]
        gram[np.ix_(at, at)] += rows.T @ rows
        score[at] += rows.T @ white[:, 0]
        total -= 0.5 * (float(white[:, 0] @ white[:, 0]) + noise.log_det(one.time, one.segments))
    return total + 0.5 * float(score @ solve(gram, score))


def is_memory(key: Key) -> bool:
    return isinstance(key, Shape) and not isinstance(key, Coefficient)


def _memories(trials: tuple[Trial, ...]) -> list[Memory]:
    moving = usable(trials)
    return [
        _memory(name, component, tau)
        for name in ("rate", "specific_force")
        for component in (None, *moving.get(name, ()))
        for tau in TIMES
        if name in moving
    ]


def _memory(signal: str, component: int | None, tau: float) -> Memory:
    of = "angular rate" if signal == "rate" else SAID.get(signal, signal)
    what = f"size of the {of}" if component is None else f"{of} {AXES[component]}"
    inputs = (signal,) if component is None else (f"{signal}_{AXES[component]}",)
    more = {"signal": signal, "component": component, "tau": tau}
    text = f"a memory of the {what} that fades within {tau:.2g} s"
    return Memory(text, ("",), ("",), ("",), frozenset({signal}), 1, inputs, **more)


def columns_of(kind: str, terms: Sequence[Memory]) -> Callable:
    """Column maker for ``Fit.beside``: each memory on every axis."""

    def add_all(trial: Trial, u: np.ndarray, add: Callable) -> None:
        for term in terms:
            values = np.asarray(u[:, COLUMNS[term.signal]])
            own = term.component
            number = np.linalg.norm(values, axis=1) if own is None else values[:, own]
            column = low_passed(number, trial.h / term.tau)
            for i in range(3):
                add(Shape(term.text, 0, i), i, column)

    return add_all


def low_passed(values: np.ndarray, share: float) -> np.ndarray:
    """Values (n,) through a first-order low-pass, by exp(-share) from sample to sample; it has seen
    the first of them for ever.
    """
    pole = np.exp(-share)
    return lfilter([1.0 - pole], [1.0, -pole], values, zi=[pole * values[0]])[0]
