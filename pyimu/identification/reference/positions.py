"""Which coefficients the positions of a log's rests show, and in which positions more rests would
show the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from pyimu.identification.fit.columns import linearise
from pyimu.identification.fit.fit import Fit, begin, gauss_newton
from pyimu.identification.fit.keys import Coefficient, Key
from pyimu.identification.fit.normal import normal_equations, variances
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.rests import Rests
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.typical import CLASSES, magnitudes
from pyimu.report.numbers import joined

STEPS = 8

MOST = 12
"""More rests than that are not asked for one by one."""

WAYS = np.array(
    sorted((w for w in product((0, 1, -1), repeat=3) if any(w)), key=lambda w: np.abs(w).sum())
)
"""Positions (26, 3) to rest in, by the way that points up: on faces, edges and corners."""


def unshown(sensor: Sensor, free: frozenset[Key], trials: Sequence[Trial]) -> list[Coefficient]:
    """Those of the coefficients ``free`` of which the rests say less than that the sensor is a
    consumer part, the least shown first.
    """
    fit = _fitted(sensor, free, trials)
    normal = normal_equations(fit.linearise(), fit.noise)
    return _hidden(sensor.kind, normal.keys, normal.gram, free)


def positions_wanted(sensor: Sensor, free: frozenset[Key], trials: Sequence[Trial]) -> list[str]:
    """Positions in which further rests would show all the coefficients ``free``, in words.

    None where not even many do.
    """
    if not isinstance(trials[0].reduction, Rests):
        return []
    fit = _fitted(sensor, free, trials)
    normal = normal_equations(fit.linearise(), fit.noise)
    missing = sorted(free - set(normal.keys))
    keys = [*normal.keys, *missing]
    rows, chosen = _imagined(fit, keys), []
    gram = np.pad(normal.gram, (0, len(missing)))
    loose = np.diag([_typical(sensor.kind, k) ** -2 if k in free else 1e-6 for k in keys])
    while _hidden(sensor.kind, keys, gram, free):
        if len(chosen) == MOST:
            return []
        worth = [np.linalg.slogdet(gram + loose + np.outer(r, r))[1] for r in rows]
        chosen.append(int(np.argmax(worth)))
        gram = gram + np.outer(rows[chosen[-1]], rows[chosen[-1]])
    return [_in_words(WAYS[i]) for i in chosen]


def _fitted(sensor: Sensor, free: frozenset[Key], trials: Sequence[Trial]) -> Fit:
    return gauss_newton(
        begin(sensor, free, trials, {k: _typical(sensor.kind, k) for k in free}), STEPS
    )


def _typical(kind: str, key: Coefficient) -> float:
    return magnitudes(key.effect, kind)[CLASSES[-1]].si


def _hidden(
    kind: str, keys: list[Key], gram: np.ndarray, free: frozenset[Key]
) -> list[Coefficient]:
    hidden: list[Coefficient] = sorted(free - set(keys))
    while True:
        at = [i for i, k in enumerate(keys) if k not in hidden]
        std = np.sqrt(variances(gram[np.ix_(at, at)]))
        loose = [
            (s / _typical(kind, keys[i]), keys[i].effect == "misalignment", keys[i])
            for s, i in zip(std, at, strict=True)
            if keys[i] in free and s >= _typical(kind, keys[i])
        ]
        if not loose:
            return hidden
        hidden.append(max(loose)[2])


def _imagined(fit: Fit, keys: list[Key]) -> np.ndarray:
    """The rows (26, P) that rests in the positions ``WAYS`` of the first log would add, white."""
    trial = fit.trials[0]
    state, n = fit.states[trial.name], len(WAYS)
    u = np.tile(trial.u.mean(axis=0), (n, 1))
    ways = WAYS / np.linalg.norm(WAYS, axis=1)[:, None]
    u[:, OWN[trial.kind]] = trial.reduction.gravity * ways
    each = [(i, i + 1) for i in range(n)]
    r = trial.reduction
    like = {
        "white": np.median(np.diag(r.white)) * np.eye(n),
        "wander": r.wander[0, 0] * np.eye(n),
        "common": np.zeros((n, n)),
        "time": np.zeros(n),
    }
    y = predict(fit.sensor, u, each, trial.h) + state.bias
    made = replace(trial, y=y, u=u, time=np.zeros(n), segments=each, reduction=replace(r, **like))
    linear = linearise(fit.sensor, made, state, fit.free)
    rows = np.zeros((n, len(keys)))
    for k, column in zip(linear.keys[0], linear.columns[0].arrays, strict=True):
        if k in keys:
            rows[:, keys.index(k)] = column
    return rows


def _in_words(way: np.ndarray) -> str:
    """``x up``, or ``between x up and y down``."""
    axes = [f"{'xyz'[i]} {'up' if way[i] > 0 else 'down'}" for i in np.flatnonzero(way)]
    return axes[0] if len(axes) == 1 else f"between {joined(axes)}"
