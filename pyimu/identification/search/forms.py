"""The form of an effect whose size is linear beside it: a time constant, the width of a play,
instants, a frequency. Each value is tried on the whole residual, and the best is where regression
starts from.

What varies slowly is tried on means of seconds, a line on the periodogram of the whitened residual.
The best of many is large by chance, too: the ``toll`` [nat] is what the choice makes of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.fft import next_fast_len, rfft

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import reference_input
from pyimu.identification.fit.keys import Coefficient, Key
from pyimu.identification.fit.response import is_driven, predict, predict_each
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import Autoregressive, RandomWalk
from pyimu.model.effect import Effect
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

BLOCK, MOST_BLOCKS = 1.0, 1200
"""s; means over so long are tried, or over longer ones where there were more than so many."""

LEAST_BLOCKS = 20
"""Fewer tell nothing of a slow form."""

CHANCE = 0.01
"""Share of logs with nothing to find in which the best value may gain more than the toll says."""

DRAWS, MOST_DRAWN = 2000, 300
"""Draws of chance, and values of a form that are drawn; between them the others lie."""

PADDED = 2
"""Frequencies tried to each that is independent: a line between two of those would be missed."""

ABOUT_THE_GATE = 10.0
"""nat, before the penalty: near the gate the sum of two squares has the tail of one times
sqrt(pi g), whose logarithm the free phase costs."""

UNUSED = 1e9
"""s; an event so late never happens."""


@dataclass(frozen=True)
class Form:
    """Values of an effect's form to start from, the coefficients of it that regression refines, and
    what the choice is to be charged for.
    """

    values: Mapping[str, np.ndarray]
    keys: tuple[Coefficient, ...]
    toll: float

    def beside(self, keys: Iterable[Key]) -> frozenset[Key]:
        """The coefficients of the form that shape those of ``keys``, by axis where each has one."""
        axes = {k.index[0] for k in keys}
        return frozenset(k for k in self.keys if not k.index or k.index[0] in axes)


def form_of(e: Effect) -> str:
    """The coefficient that is tried of an effect's form; empty where there is none."""
    found = (n for n, p in e.parameters.items() if p.form and p.scan and p.scan.measure != "phase")
    return next(found, "")


def can_be_formed(e: Effect, kind: str) -> bool:
    """Whether the form of an effect can be tried: each size belongs to one axis, and what the
    effect remembers follows from other signals than the sensor's own.
    """
    sizes = [p for p in e.parameters.values() if not (p.form or p.reference)]
    return (
        bool(form_of(e))
        and all(p.scan for p in e.parameters.values() if p.form)
        and all(p.shape and p.shape[0] == 3 for p in sizes)
        and (not e.remembers or is_driven(e, kind))
    )


def forms(fit: Fit, effects: Iterable[Effect], penalty: float) -> dict[str, Form]:
    """By name the likeliest form of each effect that has one to be tried; without those whose form
    shows in no log. ``penalty`` [nat] is what a coefficient costs.
    """
    wanted = [e for e in effects if form_of(e)]
    if not wanted or any(t.reduction is not None for t in fit.trials):
        return {}
    linears, out = fit.linearise(), {}
    slow = Slow(fit, linears, penalty)
    for e in wanted:
        found = _line(fit, linears, e, penalty) if e.is_line else slow.form(e)
        if found is not None:
            out[e.name] = found
    return out


def since_power_on(trial: Trial, time: np.ndarray) -> np.ndarray:
    """Seconds since power-on of instants of a trial."""
    return time - trial.time[0] + trial.u[0, COLUMNS["time"].start]


# What varies slowly


@dataclass(frozen=True)
class _Tried:
    """Columns of one axis for each value, of unit length and free of what the model explains, and
    the residual [standard deviations] that is left to explain.
    """

    columns: np.ndarray
    residual: np.ndarray

    @property
    def gain(self) -> np.ndarray:
        return 0.5 * (self.columns.T @ self.residual) ** 2

    def without(self, number: int) -> _Tried:
        """What is left once one value is in."""
        one = self.columns[:, number]
        return _Tried(self.columns, self.residual - one * (one @ self.residual))


class Slow:
    """Means of residual, columns and inputs over blocks of time, one after another."""

    def __init__(self, fit: Fit, linears: list[Linear], penalty: float) -> None:
        self.fit, self.penalty = fit, penalty
        self.length = max(since_power_on(t, t.time[-1]) for t in fit.trials)
        self.block = max(BLOCK, self.length / MOST_BLOCKS)
        self.linears = [
            (t, one, *self._blocks(t, one))
            for t, one in zip(fit.trials, linears, strict=True)
            if len(one.time)
        ]

    def _blocks(self, trial: Trial, one: Linear) -> tuple[np.ndarray, np.ndarray, float]:
        """The block of each row, those that are nearly full, and their rows."""
        number = np.floor(since_power_on(trial, one.time) / self.block).astype(int)
        present, count = np.unique(number, return_counts=True)
        return number, present[count >= 0.5 * count.max()], float(count.max())

    @cached_property
    def inputs(self) -> list[np.ndarray]:
        """Inputs (blocks, N_INPUT) of each trial."""
        out = []
        for trial, _, _, full, _ in self.linears:
            u = reference_input(trial, self.fit.states[trial.name])
            at = np.floor(since_power_on(trial, trial.time) / self.block).astype(int)
            out.append(_means(u, at, full))
        return out

    @cached_property
    def base(self) -> dict[int, tuple[np.ndarray, np.ndarray]]:
        """By axis the whitened residual and columns of the model, (blocks,) and (blocks, P)."""
        keys = list(
            dict.fromkeys(k for _, one, *_ in self.linears for i in one.keys for k in one.keys[i])
        )
        out = {}
        for i in self.fit.noise:
            parts = []
            for trial, one, number, full, count in self.linears:
                columns = np.zeros((len(one.time), len(keys) + 1))
                columns[:, 0] = one.residual[:, i]
                if i in one.keys:
                    columns[:, [1 + keys.index(k) for k in one.keys[i]]] = np.asarray(
                        one.columns[i]
                    )
                parts.append(self._white(i, _means(columns, number, full), full, count))
            whole = np.concatenate(parts)
            out[i] = whole[:, 0], whole[:, 1:]
        return out

    def _white(self, axis: int, values: np.ndarray, full: np.ndarray, count: float) -> np.ndarray:
        """Means of blocks, white with unit variance."""
        noise = self.fit.noise[axis]
        if isinstance(noise, Autoregressive):
            return values / np.sqrt(noise.r / count) * (1.0 - sum(noise.coefficients))
        time = full * self.block
        return RandomWalk(noise.r / count, noise.k2).whiten(values, time, [(0, len(time))])

    def form(self, e: Effect) -> Form | None:
        """The likeliest form of an effect, None where no log shows any."""
        name = form_of(e)
        values = e.parameters[name].scan.forms(self.length, self._swing(e))
        # Finer than the blocks nothing is seen; instants are placed down to the sample later.
        values = values[:: max(1, -(-len(values) // MOST_BLOCKS))]
        if sum(len(u) for u in self.inputs) < LEAST_BLOCKS or not len(values):
            return None
        tried = self._tried(e, name, values)
        toll = _toll(list(tried.values()), self.penalty)
        events = e.parameters[name].shape
        if not events:
            best = int(np.argmax(_total(tried.values(), self.penalty)))
            return Form({name: values[best]}, (Coefficient(e.name, name, ()),), toll)
        instants = sorted(values[self._one_by_one(tried, toll, events[0])])
        padded = np.concatenate([instants, np.full(events[0] - len(instants), UNUSED)])
        return Form({name: padded}, (), toll * len(instants))

    def _one_by_one(self, tried: dict[int, _Tried], toll: float, most: int) -> list[int]:
        """Numbers of the values that explain most, each beside those before; at least one."""
        found: list[int] = []
        while len(found) < most:
            total = _total(tried.values(), self.penalty)
            best = int(np.argmax(total))
            if found and (total[best] <= toll - np.log(CHANCE) or best in found):
                break
            found.append(best)
            tried = {i: t.without(best) for i, t in tried.items()}
        return found

    def _swing(self, e: Effect) -> float:
        """Range of the signals that drive an effect, of the one that has the largest."""
        at = [COLUMNS[s] for s in e.signals(self.fit.sensor.kind)]
        return max(
            (float(np.ptp(u[:, a], axis=0).max()) for u in self.inputs for a in at), default=0.0
        )

    def _tried(self, e: Effect, name: str, values: np.ndarray) -> dict[int, _Tried]:
        made = [self._columns(e, name, values, u) for u in self.inputs]
        out = {}
        for i, (residual, base) in self.base.items():
            parts = [
                self._white(i, one[:, :, i], full, count)
                for one, (_, _, _, full, count) in zip(made, self.linears, strict=True)
            ]
            out[i] = _Tried(_projected(np.concatenate(parts), base), residual)
        return out

    def _columns(self, e: Effect, name: str, values: np.ndarray, u: np.ndarray) -> np.ndarray:
        """What a unit of size adds to each axis (blocks, values, 3)."""
        kind, out = self.fit.sensor.kind, np.empty((len(u), len(values), 3))
        sizes = {n: _unit(p.shape) for n, p in e.parameters.items() if not (p.form or p.reference)}

        def at(value: float) -> Sensor:
            return Sensor(kind, {e.name: {**sizes, name: _placed(e, name, value)}})

        if e.remembers:
            for k, value in enumerate(values):
                out[:, k] = predict(at(value), u, [(0, len(u))], self.block)
        else:
            one = at(values[0])
            slot = next(k for k, s in enumerate(one.slots) if s.parameter == name)
            out = predict_each(one, u, self.block, slot, values)
        return out - u[:, None, OWN[kind]]


def _unit(shape: tuple[int, ...]) -> np.ndarray:
    """One for each axis, of several events the first."""
    sizes = np.zeros(shape)
    sizes[(slice(None), *(0 for _ in shape[1:]))] = 1.0
    return sizes


def _placed(e: Effect, name: str, value: float) -> np.ndarray:
    """A value of a form as its coefficient has it, of several events the first."""
    array = np.full(e.parameters[name].shape, UNUSED)
    array[(0,) * array.ndim] = value
    return array


def _means(values: np.ndarray, number: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Means (blocks, c) of rows (n, c) whose block has a ``number`` (n,), of those ``wanted``."""
    inside = np.isin(number, wanted)
    values, number = values[inside], number[inside]
    starts = np.flatnonzero(np.diff(number, prepend=-1))
    count = np.diff(np.append(starts, len(number)))
    return np.add.reduceat(values, starts, axis=0) / count[:, None]


def _projected(columns: np.ndarray, base: np.ndarray) -> np.ndarray:
    """Columns of unit length without what a base explains; zero where that is all."""
    raw = np.linalg.norm(columns, axis=0)
    scale = np.linalg.norm(base, axis=0)
    base = base[:, scale > 0.0] / scale[scale > 0.0]
    left = columns - base @ np.linalg.lstsq(base, columns)[0]
    size = np.linalg.norm(left, axis=0)
    return np.where(size > 1e-4 * raw, left / np.where(size > 0.0, size, 1.0), 0.0)


def _total(tried: Iterable[_Tried], penalty: float) -> np.ndarray:
    """Gain [nat] of each value, on the axes that pay for themselves."""
    return np.sum([np.maximum(t.gain - penalty, 0.0) for t in tried], axis=0)


def _toll(tried: list[_Tried], penalty: float) -> float:
    """How much more the best of all values gains by chance than one that was named beforehand."""
    rng, count = np.random.default_rng(1), tried[0].columns.shape[1]
    apart = -(-count // MOST_DRAWN)
    gains = []
    for t in tried:
        columns = t.columns[:, ::apart]
        values, vectors = np.linalg.eigh(columns.T @ columns)
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        z = rng.standard_normal((DRAWS, root.shape[1])) @ root.T
        gains.append(np.maximum(0.5 * z**2 - penalty, 0.0))
    total = np.sum(gains, axis=0)
    largest, single = (
        float(np.quantile(v, 1.0 - CHANCE)) for v in (total.max(axis=1), total[:, -1])
    )
    between = np.median([_neighbours(t.columns[:, ::apart]) for t in tried])
    return min(largest - single + (1.0 - between**2) * np.log(apart), np.log(count))


def _neighbours(columns: np.ndarray) -> float:
    """Typical correlation of a column with the next."""
    if columns.shape[1] < 2:
        return 1.0
    return float(np.median(np.abs(np.sum(columns[:, 1:] * columns[:, :-1], axis=0))))


# Lines


def _line(fit: Fit, linears: list[Linear], e: Effect, penalty: float) -> Form | None:
    """The frequency at which the periodogram of the whitened residual is largest, and the phase of
    each axis there.

    With nothing to find the ordinates are independent and exponential (Brockwell and Davis 1991,
    section 10.1): the best of m is larger by log m.
    """
    parts = [(t, one) for t, one in zip(fit.trials, linears, strict=True) if len(one.time) > 1]
    periods = [float(np.median(np.diff(one.time))) for _, one in parts]
    if not parts or max(periods) > 1.01 * min(periods):
        return None
    period = periods[0]
    places = [np.rint(since_power_on(t, one.time) / period).astype(int) for t, one in parts]
    size = next_fast_len(PADDED * (max(int(p[-1]) for p in places) + 1), real=True)
    frequency = np.arange(size // 2 + 1) / (size * period)
    length = max(float(one.time[-1] - one.time[0]) for _, one in parts)
    name = form_of(e)
    tried = (frequency > e.parameters[name].scan.low / length) & (frequency < 0.49 / period)
    if not tried.any():
        return None
    total = np.zeros(len(frequency))
    for i, noise in fit.noise.items():
        row = np.zeros(size)
        for (_, one), place in zip(parts, places, strict=True):
            if i in one.keys:
                white = noise.whiten(one.residual[:, [i]], one.time, one.segments)
                np.add.at(row, place, white[:, 0])
        rows = sum(len(one.time) for _, one in parts if i in one.keys)
        total += np.maximum(np.abs(rfft(row)) ** 2 / rows - penalty, 0.0)
    best = float(frequency[np.argmax(np.where(tried, total, -1.0))])
    toll = np.log(tried.sum()) + 0.5 * np.log(np.pi * ABOUT_THE_GATE)
    values, keys = {name: np.array(best)}, [Coefficient(e.name, name, ())]
    for n, p in e.parameters.items():
        if p.form and p.scan.measure == "phase":
            values[n] = np.array([_phase(fit, parts, i, best) for i in range(3)])
            keys += [Coefficient(e.name, n, (i,)) for i in range(3)]
    return Form(values, tuple(keys), float(toll))


def _phase(fit: Fit, parts: list[tuple[Trial, Linear]], axis: int, frequency: float) -> float:
    """The phase at power-on of a line in the residual of an axis."""
    gram, score = np.zeros((2, 2)), np.zeros(2)
    for trial, one in parts:
        if axis in one.keys:
            angle = 2 * np.pi * frequency * since_power_on(trial, one.time)
            rows = np.column_stack([np.sin(angle), np.cos(angle), one.residual[:, axis]])
            white = fit.noise[axis].whiten(rows, one.time, one.segments)
            gram += white[:, :2].T @ white[:, :2]
            score += white[:, :2].T @ white[:, 2]
    sine, cosine = np.linalg.lstsq(gram, score)[0]
    return float(np.arctan2(cosine, sine))
