"""The noise of a sensor by name: what was added, what contradicts the part, and what is neither."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pyimu.identification.formula.constancy import ANOTHER
from pyimu.identification.found.entries import Added, Changed
from pyimu.identification.noise.choose import Chosen, State, Term, refined
from pyimu.identification.noise.exact import AxisNoise
from pyimu.identification.noise.explained import Explained
from pyimu.identification.noise.jumps import JUMPS, Jump
from pyimu.identification.noise.laws import Kind, names_of
from pyimu.identification.noise.misfit import Misfit, misfits_of
from pyimu.identification.noise.shapes import shapes_of
from pyimu.identification.search.belief import most
from pyimu.identification.search.investigation import Investigation, Refused
from pyimu.identification.search.leftover import Unexplained
from pyimu.model.arguments import AXES
from pyimu.model.catalogue import CATALOGUE, WALK, WHITE
from pyimu.model.sensor import Sensor

RELEVANT = 0.005
"""Share of a declared noise by which data must differ from it before it is said: half a unit of the
last of three digits, with which parts declare it."""

DIFFERENTIATED = "the noise of the reference, or of means over rows, hides kinds of noise"

Values = dict[str, dict[str, np.ndarray]]


@dataclass(frozen=True)
class Noise:
    """What is random in a residual of a sensor.

    ``values`` are coefficients that the model gets, by effect, and ``std`` their standard errors by
    effect and coefficient; ``drift`` the gain [nat] by axis of a larger random walk; ``gained``
    the log-likelihood [nat] that held-out rows gain over noise as ``before`` said, and their
    number. ``unasked`` is why its kinds were not told apart; empty where they were.
    """

    added: tuple[Added, ...] = ()
    changed: tuple[Changed, ...] = ()
    drift: Mapping[int, float] = field(default_factory=dict)
    shapes: tuple[Unexplained, ...] = ()
    refused: tuple[Refused, ...] = ()
    values: Values = field(default_factory=dict)
    std: Mapping[tuple[str, str], np.ndarray] = field(default_factory=dict)
    gained: float = 0.0
    unasked: str = ""

    @property
    def is_more(self) -> bool:
        """Whether there is noise that the part lacks, or a shape that no noise has."""
        return bool(self.added or self.drift or self.shapes)

    @property
    def processes(self) -> dict[int, list[tuple[float, float]]]:
        """By axis the variance and the correlation time [s] of each Gauss-Markov process that was
        added.
        """
        out: dict[int, list[tuple[float, float]]] = {}
        for a in (a for a in self.added if CATALOGUE[a.effect].law.markov):
            law = CATALOGUE[a.effect].law
            for i in range(len(AXES)):
                given = {n: v[i] if np.ndim(v) else v for n, (v, _, _) in a.parameters.items()}
                pairs = (tuple(map(float, p)) for p in law.value("markov", given))
                out.setdefault(i, []).extend((v, tau) for v, tau in pairs if v > 0.0)
        return {i: pairs for i, pairs in out.items() if pairs}


def noise_of(
    sensor: Sensor, inv: Investigation, free: frozenset[str], rounds: bool, sensors: int
) -> Noise:
    """The noise of a sensor whose part declares ``sensor``, less what is ``free``, in the residual
    of an investigation.

    ``rounds`` says that the output is rounded, which adds to its white noise; ``sensors`` share the
    rate of false alarms. Nothing is said where the reference was differentiated, or where rows are
    no samples.
    """
    known = _Named.of(sensor, inv.after, inv.held, free, rounds)
    if known is None:
        return Noise(unasked=DIFFERENTIATED)
    found = known.chosen_of(sensors)
    shapes = _shapes_of(found)
    if shapes:
        rest = State({i: a for i, a in known.state.axes.items() if i not in shapes})
        found = replace(known, state=rest).chosen_of(sensors)
    found = found.confirmed()
    return found.told({**misfits_of(found), **shapes})


def _shapes_of(found: Explained) -> dict[int, Jump | Misfit]:
    """By axis what is no noise of the kinds that were chosen: a shape, or a spectrum so far from
    theirs that it is another noise. Jumps have the spectrum of Gauss-Markov noise.
    """
    shapes: dict[int, Jump | Misfit] = dict(shapes_of(found))
    for i, misfit in misfits_of(found).items():
        if shapes[i].shape in JUMPS if i in shapes else misfit.share > ANOTHER:
            shapes[i] = misfit
    return shapes


class _Named(Explained):
    """What explains a residual, and what is said of it."""

    def _held_as_fitted(self, i: int) -> float:
        walk = self.fitted[i]
        by_name = {k.name: k for k in self.kinds}
        squares = {WHITE[0]: walk.r * self.logs[i][0].h, WALK[0]: walk.k2}
        noise = AxisNoise({by_name[n]: (s, {}) for n, s in squares.items() if s > 0.0})
        return sum(float(noise.likelihood(one)[one.fitted :].sum()) for one in self.logs[i])

    def told(self, shapes: Mapping[int, Jump | Misfit]) -> Noise:
        """What was chosen by name, beside the axes whose residual has a shape of its own."""
        added = [self._added(c) for c in self.chosen if not self._is_declared(c.kind)]
        changed = [c for one in self.chosen if (c := self._changed(one)) is not None]
        white = self._changed_beside()
        changed += [white] if white is not None else []
        values: Values = {a.effect: {n: v for n, (v, _, _) in a.parameters.items()} for a in added}
        std = {}
        for c in changed:
            values.setdefault(c.effect, {})[c.parameter] = c.fitted
            std[c.effect, c.parameter] = c.std
        for name, parameter in (WHITE, WALK):
            if name in self.free and any(self.state.found.values()):
                values[name] = {parameter: self._of_all(name)}
        gained = sum(self.held(self.state, i) - self._held_as_fitted(i) for i in self.state.axes)
        return Noise(
            tuple(added),
            tuple(changed),
            self._drift(),
            tuple(self._shaped(i, one) for i, one in sorted(shapes.items())),
            self.refused,
            values,
            std,
            gained if self.chosen else 0.0,
        )

    def _shaped(self, i: int, one: Jump | Misfit) -> Unexplained:
        return Unexplained(self.sensor.kind, AXES[i], (), one.chance, one.shape)

    def _of_all(self, name: str) -> np.ndarray:
        out = np.zeros(3)
        for i in self.state.axes:
            each = {k.name: v for k, (v, _) in self.sizes(self.state, i).sizes.items()}
            out[i] = np.sqrt(each.get(name, 0.0))
        return out

    def _added(self, one: Chosen) -> Added:
        parameters = {}
        for name, p in one.kind.effect.parameters.items():
            value, std = np.full(p.shape, p.start), np.zeros(p.shape)
            if name == one.kind.parameter:
                value, std = self._size(one, p.shape)
            elif one.kind.scans:
                for i in one.axes:
                    term = self._term(one.kind, i)
                    shares = one.kind.shares_form
                    form, error = (term.form, 0.0) if shares else refined(self.state, i, term)
                    at = (i,) if p.shape else ()
                    value[at], std[at] = form[name], error
            parameters[name] = (value, std, self.sensor.unit(p.unit))
        name, others = self._names(one, float(np.max(parameters[one.kind.parameter][0])))
        return Added(
            self.sensor.kind,
            name,
            others,
            parameters,
            one.gain,
            one.gate,
            "random: its samples are drawn anew each time, and none can be taken off",
        )

    def _names(self, one: Chosen, size: float) -> tuple[str, tuple[str, ...]]:
        """The name of what was added, of several of one law the first of which it may be the size,
        and the names that could stand in for it.
        """
        same = names_of(one.kind, self.sensor)
        kind, parameter = self.sensor.kind, one.kind.parameter
        name = next((n for n in same if most(n, kind, parameter) >= size), same[0])
        return name, tuple(n for n in dict.fromkeys((*same, *self._others(one))) if n != name)

    def _others(self, one: Chosen) -> tuple[str, ...]:
        """The names of the kinds that gain as much."""
        kinds = (k for other in one.alternatives for k in self.kinds if k.name == other)
        return tuple(n for k in kinds for n in names_of(k, self.sensor))

    def _term(self, kind: Kind, i: int) -> Term:
        return next(t for t in self.state.found[i] if t.kind is kind)

    def _square(self, kind: Kind, i: int) -> tuple[float, float]:
        """The size squared that was added on an axis, and its standard error."""
        axis, term = self.state.axes[i], self._term(kind, i)
        cells = axis.motion if kind.follows else axis.spectrum
        sizes = cells.fit()[0]
        variance = cells.covariance(sizes)[term.place, term.place]
        return float(sizes[term.place]), float(np.sqrt(variance))

    def _size(self, one: Chosen, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
        """The coefficient and its standard error, of the mean by precision where axes share it."""
        value, std = np.zeros(shape), np.zeros(shape)
        each = {i: self._square(one.kind, i) for i in one.axes}
        if not shape:
            weights = np.array([s**-2 for _, s in each.values()])
            square = float(weights @ [v for v, _ in each.values()] / weights.sum())
            return np.array(np.sqrt(square)), np.array(0.5 / np.sqrt(square * weights.sum()))
        for i, (square, error) in each.items():
            value[i] = np.sqrt(square)
            std[i] = 0.5 * error / value[i]
        return value, std

    def _changed(self, one: Chosen) -> Changed | None:
        """A declared noise with what the data say instead, where that is another number."""
        if not self._is_declared(one.kind) or one.kind.name in self.free:
            return None
        had = np.array(self.sensor.values[one.kind.name][one.kind.parameter])
        fitted, std = np.array(had), np.full(3, np.nan)
        for i in one.axes:
            square, error = self._square(one.kind, i)
            fitted[i] = np.sqrt(had[i] ** 2 + square)
            std[i] = 0.5 * error / max(fitted[i], 1e-300)
        return self._contradicted(one.kind, had, fitted, std, self._others(one))

    def _changed_beside(self) -> Changed | None:
        """Declared white noise where other noise follows the motion."""
        kind = next(k for k in self.kinds if k.name == WHITE[0])
        beside = [
            i for i in self.state.axes if any(t.kind.follows for t in self.state.found.get(i, ()))
        ]
        if not beside or not self._is_declared(kind) or kind.name in self.free:
            return None
        had = np.array(self.sensor.values[kind.name][kind.parameter])
        fitted, std = np.array(had), np.full(3, np.nan)
        for i in beside:
            cells = self.state.axes[i].motion
            sizes = cells.fit()[0]
            now = np.sqrt(self._white(i, sizes))
            error = 0.5 * now * np.sqrt(cells.covariance(sizes)[0, 0]) / (1.0 + sizes[0])
            if abs(now - had[i]) > 4.0 * error:
                fitted[i], std[i] = now, error
        return self._contradicted(kind, had, fitted, std)

    def _contradicted(
        self, kind: Kind, had, fitted, std, others: tuple[str, ...] = ()
    ) -> Changed | None:
        if not np.any(np.abs(fitted - had) > RELEVANT * had):
            return None
        unit = self.sensor.unit(kind.effect.parameters[kind.parameter].unit)
        return Changed(self.sensor.kind, kind.name, kind.parameter, had, fitted, std, unit, others)

    def _drift(self) -> dict[int, float]:
        """The axes that walk more than the part declares, and what letting them gains."""
        out = {}
        for one in self.chosen:
            if one.kind.name == WALK[0]:
                for i in one.axes:
                    square, _ = self._square(one.kind, i)
                    cells = self.state.axes[i].spectrum
                    less = cells.without(self._term(one.kind, i).place)
                    gain = cells.fit()[1] - less.fit()[1]
                    out |= {i: gain} if square > 0.0 else {}
        return out
