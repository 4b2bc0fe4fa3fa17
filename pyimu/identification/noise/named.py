"""The noise of a sensor by name: what was added, what contradicts the part, and what is neither."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.found import Added, Changed
from pyimu.identification.noise.choose import (
    Chosen,
    State,
    Term,
    choose,
    refined,
    with_form,
    without,
)
from pyimu.identification.noise.exact import AxisNoise
from pyimu.identification.noise.known import state_of
from pyimu.identification.noise.laws import Kind, kinds
from pyimu.identification.noise.rows import Rows, rows_of
from pyimu.identification.noise.telegraph import FINE, NUMBERS, telegraph_likelihood
from pyimu.identification.search.forward import SET_WIDTH, Investigation, Refused
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import WALK, WHITE
from pyimu.model.sensor import Sensor

RELEVANT = 0.02
"""Share of a declared noise by which data must differ from it before it is said."""

POPCORN = "random telegraph (popcorn) noise"
"""What jumps between two levels at random instants."""

Values = dict[str, dict[str, np.ndarray]]


@dataclass(frozen=True)
class Noise:
    """What is random in a residual of a sensor.

    ``values`` are coefficients that the model gets, by effect, and ``std`` their standard errors by
    effect and coefficient; ``drift`` the gain [nat] by axis of a larger random walk; ``gained``
    the log-likelihood [nat] that held-out rows gain over noise as ``before`` said, and their
    number.
    """

    added: tuple[Added, ...] = ()
    changed: tuple[Changed, ...] = ()
    drift: Mapping[int, float] = field(default_factory=dict)
    shapes: tuple[Unexplained, ...] = ()
    refused: tuple[Refused, ...] = ()
    values: Values = field(default_factory=dict)
    std: Mapping[tuple[str, str], np.ndarray] = field(default_factory=dict)
    gained: float = 0.0


def noise_of(
    sensor: Sensor, inv: Investigation, free: frozenset[str], rounds: bool, sensors: int
) -> Noise:
    """The noise of a sensor whose part declares ``sensor``, less what is ``free``, in the residual
    of an investigation.

    ``rounds`` says that the output is rounded, which adds to its white noise; ``sensors`` share the
    rate of false alarms. Nothing is said where the reference was differentiated, or where rows are
    no samples.
    """
    fit = inv.after
    if any(not isinstance(n, RandomWalk) for n in fit.seen.values()):
        return Noise()
    fitted = {i: n for i, n in fit.seen.items() if isinstance(n, RandomWalk)}
    logs = rows_of(fit, inv.held)
    longest = max(float(one.time[-1] - one.time[0]) for each in logs.values() for one in each)
    every = kinds(sensor, fit.trials[0].h, longest)
    loose = free | ({WHITE[0]} if rounds else set())
    start = state_of(sensor, logs, fitted, every, frozenset(loose), np.zeros(3))
    if not start.axes:
        return Noise()
    tried = [k for k in every if k.name not in loose]
    known = _Found(sensor, fit, logs, every, frozenset(loose), fitted, start, start)
    found = known.chosen_of(tried, sensors)
    jumps = found.popcorn()
    if jumps:
        rest = State({i: a for i, a in start.axes.items() if i not in jumps})
        found = replace(known, state=rest).chosen_of(tried, sensors)
    return found.confirmed().told(jumps)


@dataclass(frozen=True)
class _Found:
    """What was chosen, on the way to what is said of it."""

    sensor: Sensor
    fit: Fit
    logs: dict[int, list[Rows]]
    kinds: Sequence[Kind]
    free: frozenset[str]
    fitted: Mapping[int, RandomWalk]
    start: State
    state: State
    chosen: tuple[Chosen, ...] = ()
    refused: tuple[Refused, ...] = ()

    def chosen_of(self, tried: Sequence[Kind], sensors: int) -> _Found:
        """With the kinds of ``tried`` that the axes have, their forms refined."""
        state, chosen = choose(self.state, tried, sensors)
        for i in state.axes:
            for term in state.found.get(i, ()):
                if term.kind.scans and not term.kind.shares_form:
                    state = with_form(state, i, term, refined(state, i, term)[0])
        return replace(self, state=state, chosen=tuple(chosen))

    # Sizes

    def sizes(self, state: State, i: int) -> AxisNoise:
        """The noise of an axis under a state, for the exact likelihood."""
        axis, out = state.axes[i], {}
        spectrum, motion = axis.spectrum.fit()[0], None
        if axis.motion is not None:
            motion = axis.motion.fit()[0]
        loose = [k for k in self.kinds if k.name in self._loose(i)]
        for kind in self.kinds:
            square = axis.had.get(kind.name, 0.0) ** 2
            form = _form(self.sensor, kind, i)
            if kind in loose:
                square += spectrum[loose.index(kind)]
            for term in state.found.get(i, ()):
                if term.kind is kind:
                    square += (motion if kind.follows else spectrum)[term.place]
                    form = term.form
            out[kind] = (square, form)
        if motion is not None and any(t.kind.follows for t in state.found.get(i, ())):
            white = next(k for k in self.kinds if k.name == WHITE[0])
            out[white] = (self._white(i, motion), {})
        return AxisNoise({k: v for k, v in out.items() if v[0] > 0.0})

    def _loose(self, i: int) -> list[str]:
        """The kinds that are left to the data on an axis, in the order of their columns."""
        had = self.sensor.values.get(WHITE[0], {}).get(WHITE[1], np.zeros(3))[i]
        names = [k.name for k in self.kinds if k.name in (WHITE[0], WALK[0])]
        return [n for n in names if n in self.free or (n == WHITE[0] and not had)]

    def _white(self, i: int, motion: np.ndarray) -> float:
        """N squared beside noise that follows the motion."""
        return float((1.0 + motion[0]) * self.fitted[i].r * self.logs[i][0].h)

    # What speaks against it

    def popcorn(self) -> dict[int, float]:
        """The axes whose residual jumps between two levels, and the log-likelihood [nat] by which
        that is likelier than the slow noise that was chosen for them.
        """
        ahead = {}
        for i in self.state.axes:
            if not any(_is_slow(t.kind) for t in self.state.found.get(i, ())):
                continue
            noise = self.sizes(self.state, i)
            seen = [one.seen().means(FINE) for one in self.logs[i] if one.fitted]
            smooth = sum(float(noise.likelihood(one).sum()) for one in seen)
            jumps = sum(telegraph_likelihood(one, noise.variance(one)) for one in seen)
            ahead[i] = jumps - smooth - PENALTY * NUMBERS * len(seen)
        ahead = {i: gain for i, gain in ahead.items() if gain > 0.0}
        return ahead if sum(ahead.values()) > SET_WIDTH else {}

    def _less(self, terms: Sequence[Term], i: int) -> _Found:
        state = self.state
        for term in terms:
            state = without(state, term.kind, i)
        names = {t.kind.name for t in terms}
        kept = (
            replace(c, axes=tuple(a for a in c.axes if a != i)) if c.kind.name in names else c
            for c in self.chosen
        )
        return replace(self, state=state, chosen=tuple(c for c in kept if c.axes))

    def confirmed(self) -> _Found:
        """Less what held-out rows speak against."""
        out = self
        for one in self.chosen:
            if self._is_declared(one.kind):
                continue
            fewer = out
            for i in one.axes:
                fewer = fewer._less([t for t in out.state.found[i] if t.kind is one.kind], i)
            gained = sum(out.held(out.state, i) - out.held(fewer.state, i) for i in one.axes)
            if one.gain + gained <= one.gate:
                reason = f"held-out data lose {-gained:.2g} nat by it"
                refused = Refused(one.kind.name, one.gain, reason)
                out = replace(fewer, refused=(*out.refused, refused))
        return out

    def held(self, state: State, i: int) -> float:
        """Log-likelihood [nat] of the held-out rows of an axis, given those before them."""
        noise = self.sizes(state, i)
        return sum(float(noise.likelihood(one)[one.fitted :].sum()) for one in self.logs[i])

    def _held_as_fitted(self, i: int) -> float:
        walk = self.fitted[i]
        by_name = {k.name: k for k in self.kinds}
        squares = {WHITE[0]: walk.r * self.logs[i][0].h, WALK[0]: walk.k2}
        noise = AxisNoise({by_name[n]: (s, {}) for n, s in squares.items() if s > 0.0})
        return sum(float(noise.likelihood(one)[one.fitted :].sum()) for one in self.logs[i])

    # What is said

    def _is_declared(self, kind: Kind) -> bool:
        """Whether the part has the kind, on some axis, so that its value changes."""
        values = self.sensor.values.get(kind.name)
        return values is not None and bool(np.any(values[kind.parameter]))

    def told(self, jumps: Mapping[int, float]) -> Noise:
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
            tuple(self._popcorn(i, gain) for i, gain in jumps.items()),
            self.refused,
            values,
            std,
            gained if self.chosen else 0.0,
        )

    def _popcorn(self, i: int, gain: float) -> Unexplained:
        return Unexplained(self.sensor.kind, "xyz"[i], (), float(np.exp(-gain)), POPCORN)

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
        return Added(
            self.sensor.kind,
            one.kind.name,
            one.alternatives,
            parameters,
            one.gain,
            one.gate,
            "random: its samples are drawn anew each time, and none can be taken off",
        )

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
        return self._contradicted(one.kind, had, fitted, std)

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

    def _contradicted(self, kind: Kind, had, fitted, std) -> Changed | None:
        if not np.any(np.abs(fitted - had) > RELEVANT * had):
            return None
        unit = self.sensor.unit(kind.effect.parameters[kind.parameter].unit)
        return Changed(self.sensor.kind, kind.name, kind.parameter, had, fitted, std, unit)

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


def _is_slow(kind: Kind) -> bool:
    return bool(kind.effect.law.walk or kind.effect.law.markov)


def _form(sensor: Sensor, kind: Kind, i: int) -> dict[str, float]:
    """The form that a part declares of a kind on an axis, or the first that is tried."""
    values = sensor.values.get(kind.name)
    if values is None:
        return dict(kind.forms[0])
    return {n: float(v[i] if np.ndim(v) else v) for n, v in values.items() if n != kind.parameter}
