"""The kinds of noise that explain a residual, their sizes, and how likely it is by them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from pyimu.identification.fit.errors_in_variables import has_noise, residual_changes
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk
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
from pyimu.identification.search.investigation import Refused
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import WALK, WHITE
from pyimu.model.sensor import Sensor


@dataclass(frozen=True)
class Explained:
    """The residual of a fit by axis and log, what was known of its noise at the ``start``, and the
    kinds that were ``chosen``; ``beside`` (3,) is the variance that references have in a row.
    """

    sensor: Sensor
    fit: Fit
    logs: dict[int, list[Rows]]
    kinds: Sequence[Kind]
    free: frozenset[str]
    fitted: Mapping[int, RandomWalk]
    beside: np.ndarray
    start: State
    state: State
    chosen: tuple[Chosen, ...] = ()
    refused: tuple[Refused, ...] = ()

    @classmethod
    def of(
        cls,
        sensor: Sensor,
        fit: Fit,
        held: tuple[Trial, ...],
        free: frozenset[str],
        rounds: bool,
    ) -> Self | None:
        """The residual of a fit under the noise that is known beforehand; None where the reference
        was differentiated, or where rows are no samples.
        """
        if any(not isinstance(n, RandomWalk) for n in fit.seen.values()):
            return None
        fitted = {i: n for i, n in fit.seen.items() if isinstance(n, RandomWalk)}
        logs = rows_of(fit, held)
        longest = max(float(one.time[-1] - one.time[0]) for each in logs.values() for one in each)
        every = kinds(sensor, fit.trials[0].h, longest)
        loose = frozenset(free | ({WHITE[0]} if rounds else set()))
        beside = _of_reference(fit)
        start = state_of(sensor, logs, fitted, every, loose, beside)
        known = sensor, fit, logs, every, loose, fitted, beside
        return cls(*known, start, start) if start.axes else None

    def chosen_of(self, sensors: int) -> Self:
        """With the kinds that the axes have, their forms refined."""
        tried = [k for k in self.kinds if k.name not in self.free]
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
        loose = [k for k in self.kinds if k.name in self.loose(i)]
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
        return AxisNoise({k: v for k, v in out.items() if v[0] > 0.0}, float(self.beside[i]))

    def loose(self, i: int) -> list[str]:
        """The kinds that are left to the data on an axis, in the order of their columns."""
        had = self.sensor.values.get(WHITE[0], {}).get(WHITE[1], np.zeros(3))[i]
        names = [k.name for k in self.kinds if k.name in (WHITE[0], WALK[0])]
        return [n for n in names if n in self.free or (n == WHITE[0] and not had)]

    def _white(self, i: int, motion: np.ndarray) -> float:
        """N squared beside noise that follows the motion."""
        white = (1.0 + motion[0]) * self.fitted[i].r - self.beside[i]
        return max(float(white), 0.0) * self.logs[i][0].h

    def explained(self) -> float:
        """Log-likelihood [nat] of all rows, the numbers of what was chosen penalised."""
        total = 0.0
        for i in self.state.axes:
            noise, terms = self.sizes(self.state, i), self.state.found.get(i, ())
            each = (float(noise.likelihood(one).sum()) for one in self.logs[i])
            total += sum(each) - PENALTY * sum(1 + t.kind.scans for t in terms)
        return total

    # What speaks against it

    def _less(self, terms: Sequence[Term], i: int) -> Self:
        state = self.state
        for term in terms:
            state = without(state, term.kind, i)
        names = {t.kind.name for t in terms}
        kept = (
            replace(c, axes=tuple(a for a in c.axes if a != i)) if c.kind.name in names else c
            for c in self.chosen
        )
        return replace(self, state=state, chosen=tuple(c for c in kept if c.axes))

    def confirmed(self) -> Self:
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

    def _is_declared(self, kind: Kind) -> bool:
        """Whether the part has the kind, on some axis, so that its value changes."""
        values = self.sensor.values.get(kind.name)
        return values is not None and bool(np.any(values[kind.parameter]))


def _of_reference(fit: Fit) -> np.ndarray:
    """Variance (3,) that the noise of the references has in a row of the residual."""
    if not has_noise(fit):
        return np.zeros(3)
    rows = [one.residual for one in residual_changes(fit)]
    return np.mean(np.concatenate(rows) ** 2, axis=0)


def _form(sensor: Sensor, kind: Kind, i: int) -> dict[str, float]:
    """The form that a part declares of a kind on an axis, or the first that is tried."""
    values = sensor.values.get(kind.name)
    if values is None:
        return dict(kind.forms[0])
    return {n: float(v[i] if np.ndim(v) else v) for n, v in values.items() if n != kind.parameter}
