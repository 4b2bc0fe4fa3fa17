"""What a lag or a delay leaves by its form, as a log shows it.

The form is not exact, and what it leaves of a large motion may be more than an effect of the sensor
makes. But it is linear in the sensor's own signal, the same at all times, and passes a constant: a
sum of that signal's rates of change. What these explain beside a model is what its form may be off
by, and where they explain nothing it is exact to the noise, however large the lag.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Shape
from pyimu.identification.fit.normal import solve
from pyimu.identification.fit.response import through_dynamics
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.projected import Projected
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor

ORDERS = 8
"""Rates of change that a form may be off by: they reach four samples either way, by when what is
sampled of a pole has its exponential."""

CHANGE = "change"
"""The term that they are columns of."""


def left_by_form(fit: Fit) -> float:
    """Gain [nat] of the rates of change of what comes out of a model's dynamics, on all axes, less
    what they gain by chance: half a nat each, the mean of half a chi-square. Nothing that the form
    makes explains more.
    """
    add = _changes(fit.sensor)
    normal = with_prior(equations(fit, lambda f: f.beside(f.linearise(), [add])), fit)
    changes = [i for i, k in enumerate(normal.keys) if isinstance(k, Shape)]
    model = [i for i, k in enumerate(normal.keys) if not isinstance(k, Shape)]
    projected = Projected.of(normal, model, changes)
    power = float(projected.score @ solve(projected.variance, projected.score))
    return 0.5 * (power - len(changes))


def _changes(sensor: Sensor) -> Callable[[Trial, np.ndarray, Callable], None]:
    """Adds columns: the differences of what comes out of a sensor's dynamics."""

    def add_all(trial: Trial, u: np.ndarray, add: Callable) -> None:
        answer = through_dynamics(sensor, u[:, OWN[trial.kind]], trial.segments, trial.h)
        out = np.zeros((ORDERS, *answer.shape))
        for a, b in trial.segments:
            if b - a > 2:
                out[:, a:b] = differences(answer[a:b])
        for number, values in enumerate(out):
            for axis, column in enumerate(values.T):
                add(Shape(CHANGE, number, axis), axis, column)

    return add_all


def differences(values: np.ndarray) -> np.ndarray:
    """Central differences (``ORDERS``, n, k) of values (n, k), of first and second order in turn of
    those of even order; the first and last value go on beyond the ends.
    """
    out, even = [], values
    for _ in range(ORDERS // 2):
        padded = np.concatenate([even[:1], even, even[-1:]])
        out.append((padded[2:] - padded[:-2]) / 2)
        even = padded[2:] - 2 * even + padded[:-2]
        out.append(even)
    return np.array(out)
