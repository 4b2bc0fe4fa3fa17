"""The level at which samples stop (saturation).

Read off the samples that lie there, which are then left out of what is looked for next.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from scipy.integrate import trapezoid
from scipy.ndimage import maximum_filter1d
from scipy.optimize import brentq
from scipy.special import erfcx

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import LogState, reference_input
from pyimu.identification.fit.keys import Coefficient, Key
from pyimu.identification.fit.limited import CEILING, OVER, ceiling_levels, with_limited
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.sample_noise import rest_noise
from pyimu.identification.fit.score import compared
from pyimu.identification.fit.trial import Trial, counted, marked
from pyimu.model.sensor import Sensor
from pyimu.recording.quality.resolution import resolution

EQUAL = 1e-9
"""Relative difference below which samples are the same: files round them."""

SHOWN = 3.0
"""Log-likelihood [nat] by which samples must lie piled up at a level that regression found (95 %).
"""

NEARLY = 0.8
"""Share of a level above which an input is about to reach it, whatever the model still lacks."""

NEAR = 0.01
"""Share of a level by which samples at it may differ, beside their noise: what a part does after
its converter stopped takes a little of the other axes in."""

FINE = 0.25
"""Standard deviations of the noise that a step of the samples may have for their density to be seen
within one of them."""

ABOUT, BEYOND = 0.5, 4 / 3
"""s on either side in which a sample is looked at with others, and by how much more than the
farthest of these it may go: of a hundred of white noise that is at some three standard deviations,
and four are beyond chance; of a line it is its amplitude."""

LEAST_LEFT = 64
"""Rows without which nothing can be said of a log."""

LEAST_AT_LEVEL = 5
"""Fewer samples beyond a level do not show that there is one."""


def has_ceiling(sensor: Sensor) -> bool:
    """Whether the model's output stops at some level."""
    return bool(ceiling_levels(sensor).any())


def is_ceiling(sensor: Sensor, effect: str) -> bool:
    """Whether an effect that the sensor has is the one that stops its output."""
    found = sensor.reading(CEILING)
    return found is not None and found[0] == effect


def _levels(sensor: Sensor) -> tuple[np.ndarray, Sensor]:
    """The levels (3,), zero where there is none, and the sensor without them."""
    return ceiling_levels(sensor), sensor.without(sensor.reading(CEILING)[0])


def stops_there(fitted: Fit, axis: int) -> bool:
    """Whether the samples really stop at the level of an axis while the model's input is beyond it.

    Few lie above, and most lie there, within ``NEAR`` of it and their noise. A reference that jumps
    leaves them far below. Where the input is hardly ever beyond it, samples must lie piled up at
    the largest of all.
    """
    levels, unlimited = _levels(fitted.sensor)
    level, beyond, over, near = levels[axis], 0, 0, 0
    for t in fitted.trials:
        u = reference_input(t, fitted.states[t.name])
        x = np.abs(predict(unlimited, u, t.segments, t.h)[:, axis])
        y, chance = np.abs(t.y[:, axis]), 4 * rest_noise(t)[axis]
        most = OVER * level + chance
        there = np.abs(y - level) < NEAR * level + chance
        for a, b in t.row_segments:
            outside = x[a:b] > OVER * level
            beyond += int(outside.sum())
            over += int((outside & (y[a:b] > most)).sum())
            near += int((outside & there[a:b]).sum())
    if beyond < LEAST_AT_LEVEL:
        return pile(fitted, axis, level) is not None
    return over < 0.2 * beyond and near > 0.5 * beyond


def pile(fitted: Fit, axis: int, level: float) -> float | None:
    """The largest size of the samples of an axis, where so many lie exactly there that the output
    stops, and where it stops close to a fitted ``level``; else None.
    """
    if not has_samples(fitted.trials):
        return None
    noise = max(float(rest_noise(t)[axis]) for t in fitted.trials)
    top, gain = piled(fitted.trials, axis)
    return top if gain > SHOWN and abs(top - level) < 4.0 * noise + 0.02 * level else None


def has_samples(trials: Iterable[Trial]) -> bool:
    """Whether all rows of trials are samples as the sensor gave them."""
    return all(t.band_hz is None and t.reduction is None for t in trials)


def piled(trials: Sequence[Trial], axis: int) -> tuple[float, float]:
    """The largest size of the samples of an axis, and the log-likelihood [nat] by which so many
    lying exactly there speaks for an output that stops.

    The logarithm of the density of samples with white noise of standard deviation s bends down by
    no more than 1 / s^2: where it is f and falls by c a step of s, f s M(c) samples lie above, M
    the ratio of Mills. None does; those at the level, but the one that makes it the largest, all
    fell into one step of the samples' resolution instead. What lies within s below says how large
    c is.
    """
    y = np.abs(np.concatenate([counted(t, axis) for t in trials]))
    noise = min(float(rest_noise(t)[axis]) for t in trials)
    if not len(y) or not noise > 0.0:
        return 0.0, -np.inf
    top = float(y.max())
    at = y >= top * (1.0 - EQUAL)
    if at.sum() < 2:
        return top, -np.inf
    step = max(resolution(y), 2.0 * EQUAL * top)
    count = _independent(at, np.diff(y, prepend=np.nan) == 0.0, step / noise)
    if count < 2 or step > FINE * noise:
        return top, -np.inf
    below = int(np.sum((y > top - noise) & ~at))
    room = noise / step * _mills(_steepness(below * step / (count * noise)))
    return top, (count - 1) * float(np.log(max(room, 1.0)))


def read_to(trials: Sequence[Trial], axis: int, level: float) -> float:
    """Standard error of a level that was read off samples of an axis: it is anywhere within their
    step.
    """
    step = resolution(np.concatenate([t.y[:, axis] for t in trials]))
    return max(step / np.sqrt(12.0), EQUAL * level)


def is_reached(fitted: Fit, held: Iterable[Trial], axis: int, top: float) -> bool:
    """Whether the input of most samples of size ``top`` is as large by the model, too: those that
    stand for a fault of the log may come at any time.
    """
    x, y = compared(fitted, held, axis)
    return bool(np.median(np.abs(x[np.abs(y) >= top * (1.0 - EQUAL)])) > NEARLY * top)


def _independent(at: np.ndarray, repeats: np.ndarray, step: float) -> int:
    """Samples ``at`` a level (n,); runs of them where samples ``repeats`` (n,) the one before
    oftener than white noise does by steps in units of it, and so are held.
    """
    elsewhere = repeats & ~at
    chance = step / (2.0 * np.sqrt(np.pi))
    expected = len(at) * min(chance, 1.0)
    held = elsewhere.sum() > 2.0 * expected + 4.0 * np.sqrt(expected) + 1.0
    return int(np.sum(at & ~repeats)) if held else int(at.sum())


def _mills(c: float) -> float:
    """What exp(-c t - t^2 / 2) holds above zero."""
    return float(np.sqrt(np.pi / 2.0) * erfcx(c / np.sqrt(2.0)))


def _steepness(share: float) -> float:
    """The fall c at a level below which, within one standard deviation, lie ``share`` times what
    its density would make of that range.
    """

    def more(c: float) -> float:
        t = np.linspace(0.0, 1.0, 65)
        return float(trapezoid(np.exp(c * t - t**2 / 2.0), t)) - share

    return 0.0 if more(0.0) >= 0.0 else 50.0 if more(50.0) <= 0.0 else brentq(more, 0.0, 50.0)


def at_samples(fitted: Fit) -> Fit:
    """Put each level where raw samples lie while the input is well beyond it, and fit the rest.

    In the band of a derived reference the ends of a clipped segment are smeared; the samples
    themselves show the level.
    """
    effect, parameter = fitted.sensor.reading(CEILING)
    levels, unlimited = _levels(fitted.sensor)
    std: dict[Key, float] = {}
    for i in map(int, np.flatnonzero(levels)):
        sides = [_beyond(unlimited, t, fitted.states[t.name], i, levels[i]) for t in fitted.trials]
        joined = [np.concatenate(values) for values in zip(*sides, strict=True)]
        found = [(float(np.median(v)), _median_std(v)) for v in joined if len(v) >= LEAST_AT_LEVEL]
        top = None if found else pile(fitted, i, levels[i])
        if top is not None:
            found = [(top, 0.0)]
        if found:
            levels[i], error = max(found)
            least = read_to(fitted.trials, i, levels[i])
            std[Coefficient(effect, parameter, (i,))] = max(error, least)
    sensor = fitted.sensor.with_values(effect, **{parameter: levels})
    free = frozenset(k for k in fitted.free if k.effect != effect)
    return fit(replace(fitted, sensor=sensor, free=free, std={**fitted.std, **std}).with_noise())


def _median_std(values: np.ndarray) -> float:
    """Standard error of a median from the scatter about it, sqrt(pi/2) that of a mean."""
    scatter = 1.4826 * float(np.median(np.abs(values - np.median(values))))
    return np.sqrt(np.pi / 2 / len(values)) * scatter


def _beyond(
    unlimited: Sensor, trial: Trial, state: LogState, axis: int, level: float
) -> tuple[np.ndarray, np.ndarray]:
    """Magnitudes of the samples, positive and negative side, taken while the unlimited model is 10
    % beyond the level.
    """
    x = predict(unlimited, reference_input(trial, state), trial.segments, trial.h)[:, axis]
    inside = marked(trial.row_segments, len(x))
    y = trial.y[:, axis]
    return tuple(
        np.abs(y[inside & (sign * x > 1.1 * level) & (sign * y > NEARLY * level)])
        for sign in (1, -1)
    )


def without_lost(fitted: Fit) -> Fit:
    """Leave out the samples at the level, and those about them that may be.

    They carry no noise and no slope, and would bias what is looked for next. Rows that are no
    samples have none at it. A log that would have none left keeps what it had.
    """
    if fitted.is_reduced:
        return fitted
    levels, unlimited = _levels(fitted.sensor)
    trials = []
    for t in fitted.trials:
        # Judged by the model and by what is about a sample, not by the noisy sample: choosing by
        # the sample would keep one half of the noise.
        x = predict(unlimited, reference_input(t, fitted.states[t.name]), t.segments, t.h)
        reach = np.abs(x) + _reach(t, np.clip(x, *_either_way(levels)))
        lost = ((levels > 0) & (reach > levels)).any(axis=1)
        fewer = replace(t, left_out=lost if t.left_out is None else lost | t.left_out)
        fewer = with_limited(fitted.sensor, fewer)
        trials.append(fewer if fewer.count >= LEAST_LEFT else t)
    return fit(replace(fitted, trials=tuple(trials)).with_noise())


def _either_way(levels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The least and the largest output (3,) of a sensor that stops at levels, zero for nowhere."""
    most = np.where(levels > 0.0, levels, np.inf)
    return -most, most


def _reach(trial: Trial, x: np.ndarray) -> np.ndarray:
    """How far (n, 3) samples may go from what the model has them be, ``x`` (n, 3): as far as the
    farthest about each, vibration that no reference shows included, and ``BEYOND`` times that.
    """
    about = 2 * round(ABOUT / trial.h) + 1
    far = np.zeros_like(x)
    for a, b in trial.segments:
        far[a:b] = maximum_filter1d(np.abs(trial.y[a:b] - x[a:b]), about, axis=0, mode="nearest")
    return BEYOND * far


def unbent(before: Fit, after: Fit) -> Fit:
    """A model without the level that ``after`` has, its coefficients from the samples that do not
    lie there: those that do would make the scale factor small.
    """
    if has_ceiling(before.sensor) or not has_ceiling(after.sensor):
        return before
    effect, parameter = after.sensor.reading(CEILING)
    levels = after.sensor.values[effect][parameter]
    limited = before.sensor.with_values(effect, **{parameter: levels})
    fitted = fit(replace(before, sensor=limited, trials=after.trials).with_noise())
    return replace(
        before,
        sensor=fitted.sensor.without(effect),
        states=fitted.states,
        std=fitted.std,
    )
