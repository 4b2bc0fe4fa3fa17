"""The input below which the output is zero (a hard dead zone): no regressor describes it, yet the
samples about it say exactly where it lies.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq
from scipy.special import ndtr

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient, Key
from pyimu.identification.fit.limited import THRESHOLD, as_sampled
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.score import compared, sides
from pyimu.identification.fit.trial import Trial, marked
from pyimu.model.sensor import Sensor
from pyimu.recording.quality.resolution import resolution
from pyimu.recording.quality.zeroed import zone

LIKELY = 7.35
"""Rise of the sum of squares, in variances, that bounds the 95 % interval of a threshold: Hansen,
Sample splitting and threshold estimation, Econometrica 68 (2000), table I."""

NEAR = 10
"""Samples on each side of a threshold whose distances say how far it may lie from the nearest: a
jump far above the noise lies anywhere between two of them (Chan 1993, a Poisson process)."""

MISTAKEN = 2.0
"""Times as many inputs may have come into a zone as a model says that still lacks something."""

LEAST_ZEROS = 2
"""One zero alone is no sign of anything: a log may begin with it."""

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


Threshold = tuple[float, float, float]
"""A threshold, its standard error, and the log-likelihood [nat] by which zeros speak for it."""


@dataclass(frozen=True)
class Zeros:
    """What zeros of the output of an axis say: the threshold of a ``hard`` dead zone, which passes
    larger inputs as they are, and of a ``soft`` one, which takes the threshold off.

    ``count`` zeros are there, and ``below`` as many inputs came below the least output.
    """

    hard: Threshold
    soft: Threshold
    count: int
    below: float

    @property
    def for_hard(self) -> float:
        """Log-likelihood [nat] by which they speak for a hard dead zone.

        It leaves no output below its threshold, where a soft one leaves as many as there are inputs
        so small; these alone make its zeros, where a soft one's are as many as it is wide.
        """
        expected = min(MISTAKEN * self.below, self.count)
        fewer = self.count * np.log(expected / self.count) + self.count - expected
        return float(fewer + self.below)


def zeros(fitted: Fit, held: Iterable[Trial], axis: int) -> Zeros | None:
    """What an output that is exactly zero now and then in fitted or held-out rows says of a dead
    zone; None where it is not.
    """
    trials = tuple(_with_zeros(t, axis) for t in fitted.trials)
    held = [_with_zeros(t, axis) for t in held]
    x, y = compared(replace(fitted, trials=trials), held, axis)
    zero = y == 0.0
    count = int(zero.sum())
    if count < LEAST_ZEROS or len(y) - count <= NEAR:
        return None
    left = (y - x)[~zero]
    chance = _Below(x, 1.4826 * float(np.median(np.abs(left - np.median(left)))))
    step = resolution(y)
    least, std = float(np.abs(y[~zero]).min()), max(_least_output(y)[1], step / 2)
    hard = max(least - std, 0.5 * least)
    soft = brentq(lambda d: chance.of(d).sum() - count, 0.0, 2.0 * float(np.abs(x).max()))
    return Zeros(
        (hard, std, chance.gain(zero, hard, step)),
        (soft, soft / np.sqrt(count), chance.gain(zero, soft, step)),
        count,
        float(chance.of(least).sum()),
    )


def zeroed(trials: Iterable[Trial], axis: int) -> Threshold | None:
    """What the zeros of an axis say of a hard dead zone without any input beside them, which a
    derived reference does not show sample by sample; None where nothing is set to zero.

    A soft dead zone leaves outputs of any size, rounded ones lie a step apart, and lost ones leave
    no gap about zero.
    """
    y = np.concatenate([as_sampled(t)[marked(t.segments, len(t.y)), axis] for t in trials])
    found = zone(y)
    return None if found is None else (*_least_output(y), found[1])


@dataclass(frozen=True)
class _Below:
    """Inputs ``x`` (n,), each with noise of one standard deviation."""

    x: np.ndarray
    noise: float

    def of(self, threshold: float) -> np.ndarray:
        """The probability (n,) of an input below a threshold."""
        at = (-self.x / self.noise)[:, None] + np.array([threshold, -threshold]) / self.noise
        return ndtr(at[:, 0]) - ndtr(at[:, 1])

    def gain(self, zero: np.ndarray, threshold: float, step: float) -> float:
        """Log-likelihood [nat] by which ``zero`` (n,) outputs speak for a threshold, against what
        speaks better: samples that are rounded to a ``step``, or that were lost at any time.
        """
        count, n = int(zero.sum()), len(zero)
        shown, rounded = (
            float(np.log(np.maximum(self.of(d)[zero], 1.0 / n)).sum())
            for d in (threshold, step / 2)
        )
        lost = count * np.log(count / n) + (n - count) * np.log1p(-count / n)
        return shown - max(rounded, float(lost))


def _with_zeros(trial: Trial, axis: int) -> Trial:
    """A trial that counts the zeros of an axis among what was left out where another axis is none:
    in motion a zero beside others is far off, and looks like a spike.
    """
    if trial.left_out is None:
        return trial
    zero = (trial.y[:, axis] == 0.0) & (trial.y != 0.0).any(axis=1)
    return replace(trial, left_out=trial.left_out & ~zero)


def _sides(fitted: Fit, trial: Trial, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """What would come without the zone, and what was measured, in the rows that count."""
    whole = fitted.sensor.without(fitted.sensor.reading(THRESHOLD)[0])
    return sides(whole, trial, fitted.states[trial.name], axis)
