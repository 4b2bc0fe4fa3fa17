"""The input below which the output is zero (a hard dead zone): no regressor describes it, yet the
samples about it say exactly where it lies.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import in_log, reference_input
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient, Key
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.trial import Trial, marked
from pyimu.model.sensor import Sensor

THRESHOLD = "threshold"

LIKELY = 7.35
"""Rise of the sum of squares, in variances, that bounds the 95 % interval of a threshold: Hansen,
Sample splitting and threshold estimation, Econometrica 68 (2000), table I."""

NEAR = 10
"""Samples on each side of a threshold whose distances say how far it may lie from the nearest: a
jump far above the noise lies anywhere between two of them (Chan 1993, a Poisson process)."""

ROUNDS = 2
"""Each moves what else is fitted by what the samples in the zone had bent."""


def is_threshold(sensor: Sensor, effect: str) -> bool:
    """Whether an effect that the sensor has is the one that makes small outputs zero."""
    found = sensor.reading(THRESHOLD)
    return found is not None and found[0] == effect


def is_held_there(fitted: Fit, axis: int) -> bool:
    """Whether most samples of an axis that the zone takes in really are one value."""
    effect, parameter = fitted.sensor.reading(THRESHOLD)
    sides = [_sides(fitted, t, axis) for t in fitted.trials]
    x, y = (np.concatenate(values) for values in zip(*sides, strict=True))
    inside = y[np.abs(x) < fitted.sensor.values[effect][parameter][axis]]
    if len(inside) < NEAR:
        return False
    return bool(np.unique(inside, return_counts=True)[1].max() >= 0.5 * len(inside))


def at_threshold(fitted: Fit) -> Fit:
    """Put each threshold where it leaves the least squares, and fit the rest again."""
    effect, parameter = fitted.sensor.reading(THRESHOLD)
    for _ in range(ROUNDS):
        values, std = np.array(fitted.sensor.values[effect][parameter]), {}
        for i in map(int, np.flatnonzero(values)):
            values[i], std[Coefficient(effect, parameter, (i,))] = _found(fitted, i, values[i])
        sensor = fitted.sensor.with_values(effect, **{parameter: values})
        free = frozenset(k for k in fitted.free if k.effect != effect)
        known: dict[Key, float] = {**fitted.std, **std}
        fitted = fit(replace(fitted, sensor=sensor, free=free, std=known).with_noise())
    return fitted


def _found(fitted: Fit, axis: int, guess: float) -> tuple[float, float]:
    """The threshold of an axis and its standard error, from a guess."""
    sides = [_sides(fitted, t, axis) for t in fitted.trials]
    x, y = (np.concatenate(values) for values in zip(*sides, strict=True))
    inside = y[np.abs(x) < guess]
    if not len(inside):
        return guess, np.inf
    if np.count_nonzero(inside) < 0.5 * len(inside) and np.count_nonzero(y) > NEAR:
        return _least_output(y)
    return _least_squares(x, y)


def _least_output(y: np.ndarray) -> tuple[float, float]:
    """The threshold below the least output, where the zeros are the sensor's own and exact.

    The least of many outputs lies, on average, as far above the threshold as they lie apart.
    """
    least = np.partition(np.abs(y[y != 0.0]), range(NEAR + 1))[: NEAR + 1]
    apart = float(least[-1] - least[0]) / NEAR
    return max(float(least[0]) - apart, 0.5 * float(least[0])), apart


def _least_squares(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """The threshold between what came in and what came out, and its standard error.

    Each sample that the zone takes in changes the sum of squares by y^2 - (y - x)^2, whatever the
    threshold: sorted by |x|, their sums are the sum of squares for every threshold. Its error is at
    least the distance of the samples there.
    """
    order = np.argsort(np.abs(x))
    size, squares = np.abs(x)[order], np.cumsum((x * (2 * y - x))[order])
    best, last = int(np.argmin(squares)), len(size) - 1
    left = float(np.sum((y - x) ** 2) + squares[best])
    likely = np.flatnonzero(squares - squares[best] <= LIKELY * left / len(x))
    likely_width = size[min(likely[-1] + 1, last)] - size[likely[0]]
    first, final = max(best - NEAR, 0), min(best + NEAR, last)
    apart = (size[final] - size[first]) / max(final - first, 1)
    middle = 0.5 * (size[best] + size[min(best + 1, last)])
    return float(middle), float(max(likely_width / (2 * 1.96), apart))


def _sides(fitted: Fit, trial: Trial, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """What would come without the zone, and what was measured, in the rows that count."""
    state, effect = fitted.states[trial.name], fitted.sensor.reading(THRESHOLD)[0]
    whole = in_log(fitted.sensor.without(effect), state)
    x = predict(whole, reference_input(trial, state), trial.segments, trial.h)
    counted = marked(trial.row_segments, len(x))
    return x[counted, axis], trial.y[counted, axis]
