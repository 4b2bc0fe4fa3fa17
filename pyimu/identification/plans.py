"""Motions and temperatures that could be measured next, as trials, and the noise in them."""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, START

PEAK, TURN, TURNING = np.radians(90.0), 10.0, 60.0
"""rad/s, s and s: what a hand or a simple turntable does; a saturation below keeps the peak at 0.8
of it."""

WARMING, CYCLE = 20.0, 1800.0
"""K and s; a refrigerator or a warm room, and back."""

LYING = 60.0
"""s; in each of six positions."""

STEP = 0.02
"""s; rows of what is planned: a density counts, not how many rows share it."""

G0 = 9.80665


def turning(sensor: Sensor) -> tuple[str, Trial, float]:
    """Each axis in turn, and the frequency of the turns."""
    found = sensor.reading("ceiling")
    limit = sensor.values[found[0]][found[1]] if found else np.zeros(3)
    peak = float(min([PEAK, *(0.8 * limit[limit > 0])]))
    time = np.arange(0.0, 3 * TURNING, STEP)
    u = np.tile(START, (len(time), 1))
    for i in range(3):
        u[:, OWN["gyro"]][:, i] = np.where(
            (time // TURNING).astype(int) == i, peak * np.sin(2 * np.pi * time / TURN), 0.0
        )
    text = (
        f"turn about x, about y and about z, each {TURNING:g} s to and fro with "
        f"{np.degrees(peak):.0f} deg/s at the most, against a reference"
    )
    return text, _trial("gyro", time, u), 1 / TURN


def lying() -> tuple[str, Trial, float]:
    """Each of six faces down in turn."""
    time = np.arange(0.0, 6 * LYING, STEP)
    face = np.minimum((time // LYING).astype(int), 5)
    u = np.tile(START, (len(time), 1))
    u[:, OWN["accel"]] = G0 * np.concatenate([np.eye(3), -np.eye(3)])[face]
    text = f"let the part lie on each of its six faces, {LYING:g} s each: gravity is the reference"
    return text, _trial("accel", time, u), 1 / LYING


def warming(kind: str) -> tuple[str, Trial, float]:
    """A cycle of temperature at rest, and its frequency."""
    time = np.arange(0.0, CYCLE, 1.0)
    u = np.tile(START, (len(time), 1))
    u[:, COLUMNS["temperature"]] += WARMING / 2 * (1 - np.cos(2 * np.pi * time[:, None] / CYCLE))
    text = f"warm the part by {WARMING:g} K and let it cool again within {CYCLE / 60:g} min at rest"
    return text, _trial(kind, time, u), 1 / CYCLE


def _trial(kind: str, time: np.ndarray, u: np.ndarray) -> Trial:
    y, h = np.zeros((len(time), 3)), float(time[1] - time[0])
    return Trial("planned", kind, h, time, y, u, [(0, len(time))], frozenset(), "rate")


def noise_at(fit: Fit, frequency: float, h: float) -> dict[int, RandomWalk]:
    """The noise of the fitted residual for rows ``h`` s apart.

    Where it is that of a derived reference as well, it is white with the density that it has at
    ``frequency`` [Hz].
    """
    made = {}
    for i, n in fit.noise.items():
        t = next(t for t in fit.trials if i in t.axes)
        if isinstance(n, RandomWalk):
            made[i] = RandomWalk(n.r * t.h / h, n.k2)
        else:
            step = t.h * t.band.stride
            lags = np.arange(1, len(n.coefficients) + 1)
            gain = 1 - np.sum(n.coefficients * np.exp(-2j * np.pi * frequency * step * lags))
            made[i] = RandomWalk(float(n.r * step / abs(gain) ** 2) / h, 0.0)
    return made
