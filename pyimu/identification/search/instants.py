"""The instants of an effect's events: no slope leads to one, so the residual is asked at times ever
closer together, down to the sample.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.inputs import Inputs
from pyimu.identification.fit.keys import Coefficient, Key, Scanned
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
    that never happens stands at its start value.
    """
    e, name = CATALOGUE[effect], form_of(CATALOGUE[effect])
    if not e.has_events:
        return fitted
    times, std = np.array(fitted.sensor.values[effect][name]), {}
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
    period, linears = min(t.h for t in fitted.trials), fitted.linearise()
    longest, std = max(since_power_on(t, t.time[-1]) for t in fitted.trials), np.inf
    while True:
        times = best + np.linspace(-reach, reach, TRIED)
        gain, apart = _gains(fitted, linears, key, times), times[1] - times[0]
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


def _gains(fitted: Fit, linears: list[Linear], key: Coefficient, times: np.ndarray) -> np.ndarray:
    """Log-likelihood [nat] that the event explains at each of ``times``, its size fitted on the
    axes that it has.
    """
    sizes = {
        k: float(fitted.sensor.values[k.effect][k.parameter][k.index])
        for k in fitted.free
        if isinstance(k, Coefficient) and k.effect == key.effect and k.index[1:] == key.index
    }
    linears = fitted.beside(linears, [_steps(key, times, sorted(k.index[0] for k in sizes))])
    normal = with_prior(normal_equations(linears, fitted.noise), fitted)
    return np.sum([_of_axis(normal, k, size) for k, size in sizes.items()], axis=0)


def _steps(key: Coefficient, times: np.ndarray, axes: list[int]) -> Callable:
    """Column maker: a step at each of ``times``, of one axis after another."""

    def add_all(trial: Trial, u: Inputs, add: Callable) -> None:
        since = u[:, COLUMNS["time"].start]
        for number, instant in enumerate(times.tolist()):
            step = (since >= instant).astype(float)
            for i in axes:
                add(Scanned(key.effect, key.parameter, (i,), number, instant), i, step)

    return add_all


def _of_axis(normal: Normal, own: Coefficient, size: float) -> np.ndarray:
    """Gain of a step at each of the times tried, in place of the one whose size is ``own``."""
    tried = [k for k in normal.keys if isinstance(k, Scanned)]
    places = [normal.position[k] for k in tried if k.index[0] == own.index[0]]
    base = [i for i, k in enumerate(normal.keys) if not isinstance(k, Scanned) and k != own]
    g = normal.gram
    score = normal.score + g[:, normal.position[own]] * size
    back = solve(g[np.ix_(base, base)], g[np.ix_(base, places)])
    power = np.diag(g)[places] - np.sum(g[np.ix_(base, places)] * back, axis=0)
    left = score[places] - back.T @ score[base]
    # A step that another event makes already explains nothing beside it.
    apart = power > DEAD * np.diag(g)[places]
    return np.where(apart, 0.5 * left**2 / np.where(apart, power, 1.0), 0.0)
