"""Small trials with known truth, built without files, references or the command that closes the
loop.
"""

from __future__ import annotations

import numpy as np
from scipy.signal import butter, sosfilt

from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN
from pyimu.model.signals import N_INPUT

STATE_NAMES = frozenset({"rate", "specific_force", "temperature"})


def smooth(
    rng: np.random.Generator, time: np.ndarray, size: float, highest: float = 2.0
) -> np.ndarray:
    """A motion (n, 3): five sines on each axis below ``highest`` Hz, of RMS ``size``."""
    f, phase = rng.uniform(0.1, highest, (5, 1, 3)), rng.uniform(0, 2 * np.pi, (5, 1, 3))
    return size * np.sqrt(2 / 5) * np.sin(2 * np.pi * f * time[:, None] + phase).sum(axis=0)


def inputs(rng: np.random.Generator, time: np.ndarray) -> np.ndarray:
    """Rate, specific force and temperature (n, 7) of a lively minute."""
    u = np.zeros((len(time), N_INPUT))
    u[:, OWN["gyro"]], u[:, OWN["accel"]] = (
        smooth(rng, time, 0.5),
        smooth(rng, time, 2.0) + [0.0, 0.0, 9.8],
    )
    u[:, 6] = 25.0 + 5.0 * np.sin(2 * np.pi * time / 50.0)
    return u


def noise(
    rng: np.random.Generator, time: np.ndarray, r: float, k2: float, zero_at: int = 0
) -> np.ndarray:
    """White noise of variance ``r`` and a random walk that gains ``k2`` a second and passes zero at
    row ``zero_at``, (n, 3).
    """
    steps = np.sqrt(k2 * np.diff(time, prepend=time[0]))[:, None]
    walk = np.cumsum(steps * rng.standard_normal((len(time), 3)), axis=0)
    return np.sqrt(r) * rng.standard_normal((len(time), 3)) + walk - walk[zero_at]


def trial(
    time: np.ndarray, y: np.ndarray, u: np.ndarray, kind: str = "gyro", name: str = "log", **more
) -> Trial:
    """A trial with all inputs known and one segment, unless ``more`` says otherwise."""
    settings = {"segments": [(0, len(time))], "known": STATE_NAMES, "reference": "rate", **more}
    return Trial(name, kind, float(np.median(np.diff(time))), time, y, u, **settings)


def low_pass(values: np.ndarray, hz: float, period: float) -> np.ndarray:
    """Values (n, 3) below so many Hz, of the size that they had."""
    out = sosfilt(butter(2, hz, fs=1 / period, output="sos"), values, axis=0)
    return out * values.std(axis=0) / out.std(axis=0)
