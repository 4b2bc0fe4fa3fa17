"""Whether one of sensor and reference damps what the other shows.

By the motion as either shows it. The noise of the one that it is taken from lies in the regressors,
and makes the other look as if it damped what is quick: by the reference the sensor damps too much,
by the sensor too little, and the truth lies between.
"""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import own_rate
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN


def damping(current: Fit, by_sensor: bool = False) -> tuple[float, float]:
    """Log-likelihood [nat] that a gain which falls with the square of the frequency explains of
    what a model leaves, and half of that gain's second derivative [s^2]: above 0 where the sensor
    damps, below where the reference does.

    Beside a clock and a scale factor, of every axis by itself, by the size of what is left. Taken
    for white that is more than what a filter explains in the end.
    """
    gain, along_all, power_all = 0.0, 0.0, 0.0
    for trial, one in zip(current.trials, current.residuals(), strict=True):
        turn = current.states[trial.name].rotation.T
        columns = _by_sensor(trial) if by_sensor else _by_reference(trial, turn)
        for i in trial.axes:
            left, x, clock, bent = one.residual[:, i], *(c[:, i] for c in columns)
            beside = np.column_stack([np.ones(len(x)), x, clock])
            left, bent = (v - beside @ np.linalg.lstsq(beside, v)[0] for v in (left, bent))
            power, along = float(left @ left), float(left @ bent)
            both = power * float(bent @ bent)
            if both > 0.0:
                share = along**2 / both
                gain -= 0.5 * len(left) * np.log1p(-min(share, 1.0 - 1e-12))
                along_all += along * len(left) / power
                power_all += float(bent @ bent) * len(left) / power
    return gain, along_all / power_all if power_all else 0.0


def slopes(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Rates of change of values (n, k) within a trial's segments: beside them nothing is known."""
    out = np.zeros(values.shape)
    for a, b in trial.segments:
        if b - a > 1:
            out[a:b] = np.gradient(values[a:b], trial.h, axis=0)
    return out


def _by_reference(trial: Trial, turn: np.ndarray) -> list[np.ndarray]:
    """The motion and two derivatives of it (m, 3) each, in the trial's band."""
    own, rate = (trial.u[:, at] for at in (OWN[trial.kind], own_rate(trial.kind)))
    return [in_band(trial, v @ turn) for v in (own, rate, slopes(trial, rate))]


def _by_sensor(trial: Trial) -> list[np.ndarray]:
    first = slopes(trial, trial.y)
    return [in_band(trial, v) for v in (trial.y, first, slopes(trial, first))]
