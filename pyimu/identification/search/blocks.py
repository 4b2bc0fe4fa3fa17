"""Means over blocks of time of what a model leaves, of its columns and of the inputs: what varies
slowly is looked for on these.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numba import njit

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import reference_input
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.response import predict, predict_each
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import WALKS, Autoregressive
from pyimu.identification.search.form import BLOCK, UNUSED, since_power_on
from pyimu.model.effect import Effect
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

NOTHING = 1e-4
"""Share of a column that the model's own must leave of it to be more than rounding."""


class Blocks:
    """Of a fit and its trials, ``most`` of the longest log."""

    def __init__(self, fit: Fit, linears: Sequence[Linear], most: int) -> None:
        self.fit = fit
        self.length = max(since_power_on(t, t.time[-1]) for t in fit.trials)
        self.block = max(BLOCK, self.length / most)
        self.trials = [
            (t, one, *self._of_rows(t, one))
            for t, one in zip(fit.trials, linears, strict=True)
            if len(one.time)
        ]

    def _of_rows(self, trial: Trial, one: Linear) -> tuple[np.ndarray, np.ndarray, float]:
        """The block of each row, those that are nearly full, and their rows."""
        number = np.floor(since_power_on(trial, one.time) / self.block).astype(int)
        present, count = np.unique(number, return_counts=True)
        return number, present[count >= 0.5 * count.max()], float(count.max())

    @property
    def count(self) -> int:
        """Blocks of all trials."""
        return sum(len(u) for u in self.inputs)

    @cached_property
    def inputs(self) -> list[np.ndarray]:
        """Inputs (blocks, N_INPUT) of each trial."""
        out = []
        for trial, _, _, full, _ in self.trials:
            u = reference_input(trial, self.fit.states[trial.name])
            at = np.floor(since_power_on(trial, trial.time) / self.block).astype(int)
            out.append(_means(u[:], at, full))
        return out

    @cached_property
    def left(self) -> dict[int, list[np.ndarray]]:
        """By axis, for each trial, the residual and the columns of the model (blocks, 1 + P)."""
        keys = list(
            dict.fromkeys(k for _, one, *_ in self.trials for i in one.keys for k in one.keys[i])
        )
        out: dict[int, list[np.ndarray]] = {i: [] for i in self.fit.noise}
        for i, (_, one, number, full, _) in ((i, t) for i in out for t in self.trials):
            columns = np.zeros((len(one.time), len(keys) + 1))
            columns[:, 0] = one.residual[:, i]
            if i in one.keys:
                at = [1 + keys.index(k) for k in one.keys[i]]
                columns[:, at] = np.asarray(one.columns[i])
            out[i].append(_means(columns, number, full))
        return out

    def white(self, parts: Sequence[np.ndarray], noise: WALKS) -> tuple[np.ndarray, float]:
        """Means (blocks, c) of each trial, white with unit variance beside a noise of the rows, one
        after another, and the sum of the logarithms of the variances that they had.
        """
        made, total = [], 0.0
        for values, (_, _, _, full, count) in zip(parts, self.trials, strict=True):
            of_means, time = noise.in_means(count), full * self.block
            made.append(of_means.whiten(values, time, [(0, len(time))]))
            total += of_means.log_det(time, [(0, len(time))])
        return made[0] if len(made) == 1 else np.concatenate(made), total

    def drawn(self, noise: WALKS, k2: np.ndarray, rng: np.random.Generator) -> list[np.ndarray]:
        """Draws (blocks, k) of each trial's noise of the rows, one for each of the walks ``k2``
        (k,).
        """
        out = []
        for _, _, _, full, count in self.trials:
            steps = np.diff(full * self.block, prepend=full[:1] * self.block)
            walk = np.sqrt(steps[:, None] * k2) * rng.standard_normal((len(full), len(k2)))
            white = _drawn(noise.in_means(count), len(full), len(k2), rng)
            out.append(np.cumsum(walk, axis=0) + white)
        return out

    def of_effect(self, linears: Sequence[Linear], effect: str) -> dict[int, list[np.ndarray]]:
        """By axis, for each trial, the columns (blocks, c) of an effect's coefficients in all of
        ``linears``; without the axes on which it has none.
        """
        shown, out = [one for one in linears if len(one.time)], {}
        for i in self.fit.noise:
            keys = dict.fromkeys(k for one in shown for k in one.keys.get(i, ()))
            wanted = [k for k in keys if isinstance(k, Coefficient) and k.effect == effect]
            if not wanted:
                continue
            out[i] = []
            for one, (_, _, number, full, _) in zip(shown, self.trials, strict=True):
                columns = np.zeros((len(one.time), len(wanted)))
                for at, k in enumerate(wanted):
                    if k in one.keys.get(i, ()):
                        columns[:, at] = one.columns[i].arrays[one.keys[i].index(k)]
                out[i].append(_means(columns, number, full))
        return out

    def columns(self, e: Effect, name: str, values: np.ndarray) -> list[np.ndarray]:
        """What a unit of an effect's size adds to each axis (3, blocks, values) of each trial, for
        each of the ``values`` of the coefficient ``name``.
        """
        return [self._columns(e, name, values, u) for u in self.inputs]

    def _columns(self, e: Effect, name: str, values: np.ndarray, u: np.ndarray) -> np.ndarray:
        kind, out = self.fit.sensor.kind, np.empty((3, len(u), len(values)))
        sizes = {n: _unit(p.shape) for n, p in e.parameters.items() if not (p.form or p.reference)}

        def at(value: float) -> Sensor:
            return Sensor(kind, {e.name: {**sizes, name: _placed(e, name, value)}})

        if e.remembers:
            for k, value in enumerate(values):
                out[:, :, k] = predict(at(value), u, [(0, len(u))], self.block).T
        else:
            one = at(values[0])
            slot = next(k for k, s in enumerate(one.slots) if s.parameter == name)
            out = predict_each(one, u, self.block, slot, values)
        out -= u[:, OWN[kind]].T[:, :, None]
        return out

    def swing(self, e: Effect) -> float:
        """Range of the signals that drive an effect, of the one that has the largest."""
        at = [COLUMNS[s] for s in e.signals(self.fit.sensor.kind)]
        return max(
            (float(np.ptp(u[:, a], axis=0).max()) for u in self.inputs for a in at), default=0.0
        )


def _drawn(noise: WALKS, rows: int, count: int, rng: np.random.Generator) -> np.ndarray:
    """Draws (rows, count) of a noise of means without its walk."""
    theta = noise.theta if isinstance(noise, Autoregressive) else 0.0
    white = np.sqrt(noise.r) * rng.standard_normal((rows + (theta != 0.0), count))
    return white[1:] - theta * white[:-1] if theta else white


def basis(columns: np.ndarray) -> np.ndarray:
    """Orthonormal columns (n, b) that span those (n, P) of a model."""
    scale = np.linalg.norm(columns, axis=0)
    vectors, values, _ = np.linalg.svd(columns[:, scale > 0.0] / scale[scale > 0.0], False)
    return vectors[:, values > 1e-9 * values.max(initial=0.0)]


def beside(columns: np.ndarray, base: np.ndarray) -> np.ndarray:
    """Columns of unit length without what an orthonormal ``base`` explains; zero where that is
    all.
    """
    return _beside(columns, base, base.T @ columns)


@njit(cache=True)
def _beside(columns, base, shares):
    """The same with the ``shares`` (b, c) of the base in the columns, row by row."""
    left, raw, size = columns.copy(), np.zeros(columns.shape[1]), np.zeros(columns.shape[1])
    for k in range(len(columns)):
        for b in range(len(shares)):
            for j in range(len(raw)):
                left[k, j] -= base[k, b] * shares[b, j]
        for j in range(len(raw)):
            raw[j] += columns[k, j] ** 2
            size[j] += left[k, j] ** 2
    for j in range(len(raw)):
        size[j] = 1.0 / np.sqrt(size[j]) if size[j] > NOTHING**2 * raw[j] else 0.0
    for k in range(len(columns)):
        for j in range(len(raw)):
            left[k, j] *= size[j]
    return left


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
    starts = np.flatnonzero(np.diff(number, prepend=-1))
    count = np.diff(np.append(starts, len(number)))
    inside = np.isin(number[starts], wanted)
    return np.add.reduceat(values, starts, axis=0)[inside] / count[inside, None]
