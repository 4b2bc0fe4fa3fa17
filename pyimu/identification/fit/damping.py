"""Whether one of sensor and reference damps what the other shows."""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import own_rate
from pyimu.model.kinds import OWN


def damping(current: Fit) -> tuple[float, float]:
    """Log-likelihood [nat] that a gain which falls with the square of the frequency explains of
    what a model leaves, and half of that gain's second derivative [s^2]: above 0 where the sensor
    damps, below where the reference does.

    Beside a clock and a scale factor, of every axis by itself, by the size of what is left. Taken
    for white that is more than what a filter explains in the end.
    """
    gain, along_all, power_all = 0.0, 0.0, 0.0
    for trial, one in zip(current.trials, current.residuals(), strict=True):
        own, rate = OWN[trial.kind], own_rate(trial.kind)
        change = np.gradient(trial.u[:, rate], trial.h, axis=0)
        turn = current.states[trial.name].rotation.T
        columns = [in_band(trial, v @ turn) for v in (trial.u[:, own], trial.u[:, rate], change)]
        for i in trial.axes:
            left, x, clock, bent = one.residual[:, i], *(c[:, i] for c in columns)
            beside = np.column_stack([np.ones(len(x)), x, clock])
            left, bent = (v - beside @ np.linalg.lstsq(beside, v)[0] for v in (left, bent))
            power, along = float(left @ left), float(left @ bent)
            if power > 0.0 and bent.any():
                share = along**2 / (power * float(bent @ bent))
                gain -= 0.5 * len(left) * np.log1p(-min(share, 1.0 - 1e-12))
                along_all += along * len(left) / power
                power_all += float(bent @ bent) * len(left) / power
    return gain, along_all / power_all if power_all else 0.0
