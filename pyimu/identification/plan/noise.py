"""The noise in a motion that nobody has made yet."""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.whiten import LEAST_VARIANCE, RandomWalk
from pyimu.model.effect import Effect
from pyimu.model.sensor import Sensor


def declared_noise(sensor: Sensor, h: float, sample_period: float) -> dict[int, RandomWalk]:
    """The noise of each axis that a part of this ``sample_period`` in s declares, for rows ``h`` s
    apart.

    What is white from sample to sample, as rounding is, has the density that the sensor's own
    samples give it, however far apart the rows are by which a motion is planned.
    Flicker of coefficient B counts as the random walk that has its density where it meets the white
    noise, K = B^2 / N, and a Gauss-Markov process as the walk that drives it: both are more than
    they are at lower frequencies.
    """
    white, walk = np.zeros(3), np.zeros(3)
    for e in sensor.effects:
        if e.law is not None and e.law.ramp is None and e.law.white and not _conditional(e):
            white = white + e.law.value("white", sensor.values[e.name], h=sample_period)
    for e in sensor.effects:
        if e.law is None or e.law.ramp is not None:
            continue
        values = sensor.values[e.name]
        if e.law.walk:
            walk = walk + e.law.value("walk", values)
        elif e.law.floor:
            walk = walk + values["B"] ** 4 / np.maximum(white, 1e-300) * (values["B"] > 0)
        elif e.law.markov:
            walk = walk + sum(2 * v / t**2 * t for v, t in e.law.value("markov", values))
    return {
        i: RandomWalk(max(float(white[i]) / h, LEAST_VARIANCE), float(walk[i])) for i in range(3)
    }


def _conditional(e: Effect) -> bool:
    """Whether its noise depends on the motion: left out."""
    return e.law.needs("x") or e.law.needs("slope")


def noise_at(fit: Fit, frequency: float, h: float) -> dict[int, RandomWalk]:
    """The noise of the fitted residual for rows ``h`` s apart.

    Where it is that of a derived reference as well, it is white with the density that it has at
    ``frequency`` [Hz], beside its random walk.
    """
    made = {}
    for i, n in fit.noise.items():
        t = next(t for t in fit.trials if i in t.axes)
        if isinstance(n, RandomWalk):
            made[i] = RandomWalk(n.r * t.h / h, n.k2)
        else:
            step = t.h * t.band.stride
            lags = np.arange(1, len(n.coefficients) + 1)
            turned = np.exp(-2j * np.pi * frequency * step * lags)
            back = np.exp(-2j * np.pi * frequency * step)
            gain = (1 - np.sum(n.coefficients * turned)) / (1 - n.theta * back)
            made[i] = RandomWalk(float(n.r * step / abs(gain) ** 2) / h, n.k2)
    return made
