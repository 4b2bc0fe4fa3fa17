"""The instants of an effect's events: no slope leads to one, so the residual is asked at times ever
closer together, down to the sample.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.glance import Glance
from pyimu.identification.fit.inputs import Inputs
from pyimu.identification.fit.keys import Coefficient, Key, Scanned
from pyimu.identification.fit.limited import without_limit
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.mixture import REACH
from pyimu.identification.fit.normal import DEAD, Normal, normal_equations, solve
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.form import BLOCK, UNUSED, form_of, since_power_on
from pyimu.identification.search.threshold import LIKELY
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.signals import COLUMNS

TRIED = 25
"""Instants of one round, evenly about the best of the round before."""


def at_instants(fitted: Fit, effect: str) -> Fit:
    """Put each event of an effect where the residual is least, and fit the rest again; an event
    that never happens, or that no axis has a size of, stands at its start value.
    """
    e, name = CATALOGUE[effect], form_of(CATALOGUE[effect])
    if not e.has_events:
        return fitted
    times, std = np.array(fitted.sensor.values[effect][name]), {}
    sized = {k.index[-1] for k in fitted.free if isinstance(k, Coefficient) and k.effect == effect}
    times[[k for k in range(len(times)) if k not in sized]] = UNUSED
    events = np.flatnonzero(times < UNUSED)
    reach = 1.2 * max(BLOCK, np.ptp(np.append(times[events], 0.0)) / 1200)
    for k in map(int, events):
        key = Coefficient(effect, name, (k,))
        times[k], std[key] = _found(_at(fitted, effect, name, times), key, reach)
    known: dict[Key, float] = {**fitted.std, **std}
    settled = _at(replace(fitted, std=known), effect, name, times)
    return fit(_at(settled, effect, name, np.where(times < UNUSED, times, 0.0)).with_noise())


def _at(fitted: Fit, effect: str, name: str, times: np.ndarray) -> Fit:
    return replace(fitted, sensor=fitted.sensor.with_values(effect, **{name: times}))


def _found(fitted: Fit, key: Coefficient, reach: float) -> tuple[float, float]:
    """The likeliest instant of an event and its standard error, from a guess within ``reach`` s."""
    best = float(fitted.sensor.values[key.effect][key.parameter][key.index])
    period, gains_at = min(t.h for t in fitted.trials), _gains(fitted, key)
    longest, std = max(since_power_on(t, t.time[-1]) for t in fitted.trials), np.inf
    while True:
        times = best + np.linspace(-reach, reach, TRIED)
        gain, apart = gains_at(times), times[1] - times[0]
        likely = np.flatnonzero(gain > gain.max() - 0.5 * LIKELY)
        best = float(times[np.argmax(gain)])
        # Instants that are as likely and lie beyond are not seen by those that were tried.
        ends = likely[0] > 0 and likely[-1] < TRIED - 1
        if ends or reach >= longest:
            std = min(std, (times[likely[-1]] - times[likely[0]] + apart) / (2 * REACH))
        elif np.isinf(std):
            reach *= 2.0
            continue
        if apart <= period:
            return best, std
        reach = 1.5 * apart


def _gains(fitted: Fit, key: Coefficient) -> Callable[[np.ndarray], np.ndarray]:
    """A function that gives the log-likelihood (T,) [nat] that the event explains at each of times
    (T,), its size fitted on the axes that it has.
    """
    own = {
        k.index[0]: k
        for k in fitted.free
        if isinstance(k, Coefficient) and k.effect == key.effect and k.index[1:] == key.index
    }
    counts = all(without_limit(fitted.sensor, t)[1] is None for t in fitted.trials)
    glance = Glance.of(fitted) if counts else None
    if glance is None:
        of_times = partial(_by_equations, fitted, fitted.linearise(), key, own)
    else:
        of_times = _AnyStep(fitted, glance, own)

    def gains(times: np.ndarray) -> np.ndarray:
        model, steps = of_times(times)
        sizes = {
            i: float(fitted.sensor.values[k.effect][k.parameter][k.index]) for i, k in own.items()
        }
        return np.sum([_gain(model, own[i], sizes[i], steps[i]) for i in own], axis=0)

    return gains


class _Steps(NamedTuple):
    """Products of steps at T instants, white: with each column of a model (P, T), with what is left
    (T,), and of each with itself (T,).
    """

    model: np.ndarray
    left: np.ndarray
    power: np.ndarray


def _by_equations(
    fitted: Fit, linears: list[Linear], key: Coefficient, own: Mapping[int, Key], times: np.ndarray
) -> tuple[Normal, dict[int, _Steps]]:
    """The equations of a model and steps by axis beside it, of columns that are made of them."""
    linears = fitted.beside(linears, [_columns(key, times, sorted(own))])
    normal = with_prior(normal_equations(linears, fitted.noise), fitted)
    at = [i for i, k in enumerate(normal.keys) if not isinstance(k, Scanned)]
    batch = normal.batch_gram[:, at][:, :, at], normal.batch_score[:, at]
    model = replace(
        normal, keys=[normal.keys[i] for i in at], batch_gram=batch[0], batch_score=batch[1]
    )
    steps = {}
    for i in own:
        tried = [Scanned(key.effect, key.parameter, (i,), *v) for v in enumerate(times.tolist())]
        # A step that is in no log explains nothing.
        seen = [n for n, k in enumerate(tried) if k in normal.position]
        places = [normal.position[tried[n]] for n in seen]
        one = _Steps(np.zeros((len(at), len(times))), *np.zeros((2, len(times))))
        one.model[:, seen] = normal.gram[np.ix_(at, places)]
        one.left[seen], one.power[seen] = normal.score[places], np.diag(normal.gram)[places]
        steps[i] = one
    return model, steps


def _columns(key: Coefficient, times: np.ndarray, axes: list[int]) -> Callable:
    """Column maker: a step at each of ``times``, of one axis after another."""

    def add_all(trial: Trial, u: Inputs, add: Callable) -> None:
        since = u[:, COLUMNS["time"].start]
        for number, instant in enumerate(times.tolist()):
            step = (since >= instant).astype(float)
            for i in axes:
                add(Scanned(key.effect, key.parameter, (i,), number, instant), i, step)

    return add_all


class _AnyStep:
    """The equations of a model and steps by axis beside it, of which all are known at once: the
    product of a step with any column is the sum of that, there and back, over all later rows.
    """

    def __init__(self, fitted: Fit, glance: Glance, own: Mapping[int, Key]) -> None:
        self.model, self.parts = glance.model, []
        for trial, axes in zip(fitted.trials, glance.axes, strict=True):
            rows = trial.band.apply(trial.u[:, COLUMNS["time"].start], trial.row_segments)
            for i in (i for i in axes if i in own):
                later = np.zeros((len(rows) + 1, len(axes[i].places)))
                later[:-1] = np.cumsum(axes[i].there[::-1], axis=0)[::-1]
                self.parts.append((i, rows, axes[i].places, later, axes[i].white().of_steps()))
        self.axes = sorted(own)

    def __call__(self, times: np.ndarray) -> tuple[Normal, dict[int, _Steps]]:
        count = len(self.model.keys)
        products = {i: np.zeros((count + 1, len(times))) for i in self.axes}
        powers = {i: np.zeros(len(times)) for i in self.axes}
        for i, rows, places, later, power in self.parts:
            first = np.searchsorted(rows, times)
            products[i][places] += later[first].T
            powers[i] += power[first]
        return self.model, {
            i: _Steps(products[i][:count], products[i][count], powers[i]) for i in self.axes
        }


def _gain(model: Normal, own: Key, size: float, steps: _Steps) -> np.ndarray:
    """Gain (T,) of steps in place of the one whose size is ``own``."""
    at = model.position[own]
    base = [i for i in range(len(model.keys)) if i != at]
    g, score = model.gram, model.score + model.gram[:, at] * size
    back = solve(g[np.ix_(base, base)], steps.model[base])
    power = steps.power - np.sum(steps.model[base] * back, axis=0)
    left = steps.left + steps.model[at] * size - back.T @ score[base]
    # A step that another event makes already explains nothing beside it.
    apart = power > DEAD * steps.power
    return np.where(apart, 0.5 * left**2 / np.where(apart, power, 1.0), 0.0)
