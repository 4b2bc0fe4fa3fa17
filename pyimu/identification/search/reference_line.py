"""Lines that are the reference's and not the sensor's: the counts of an encoder, or a tracked body
that shakes. In what is left they look the same; the sensor's own signal tells them apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.columns import band_time, in_band, in_log
from pyimu.identification.fit.doubted import CERTAIN
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.incoherent import CHANCE
from pyimu.identification.fit.inputs import LogState, copied, reference_input
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

BESIDE = range(8, 32)
"""Frequencies on either side of a line, in units of one over the log's length, that show what the
motion has there."""

UNSURE = 0.25
"""Share of a line by which the sensor's signal may have more or less of it than all or nothing, as
frequency and phase are not quite the line's."""

BLACKMAN_HARRIS = (0.35875, -0.48829, 0.14128, -0.01168)
"""Of 1, cos x, cos 2x and cos 3x (Harris 1978, "On the use of windows for harmonic analysis with
the discrete Fourier transform", Proc. IEEE 66, table 1)."""


def is_line_of_reference(fit: Fit, effect: str, certain: float = CERTAIN) -> bool:
    """Whether the line that an ``effect`` of a model makes is not in the sensor's own signal, by
    more than ``certain`` [nat], but in the reference's, with the other sign.

    What the motion has at that frequency, in both signals alike, is as large as beside it.
    """
    each = (_of_reference(t, _line(fit, effect, t, fit.states[t.name])) for t in fit.trials)
    return sum(each) > certain


def without_line(
    fit: Fit, effect: str, trials: Sequence[Trial], held: Sequence[Trial]
) -> tuple[list[Trial], list[Trial]]:
    """The ``trials`` of a model, and those ``held`` out, their references without the line that an
    ``effect`` of it makes; of a log that was not fitted nobody knows its phase.
    """
    fitted = [_less(t, fit, effect, t.name) for t in trials]
    return fitted, [_less(t, fit, effect, t.parent) if t.parent else t for t in held]


def _less(trial: Trial, fit: Fit, effect: str, log: str) -> Trial:
    line, own = _line(fit, effect, trial, fit.states[log]), OWN[trial.kind]
    line = np.where(np.isin(np.arange(3), trial.axes), line, 0.0)
    u, rate = copied(trial.u), COLUMNS[KINDS[trial.kind].own_rate]
    u[:, own] += line
    for a, b in trial.segments:
        if b - a > 1:
            u[a:b, rate] += np.gradient(line[a:b], trial.time[a:b], axis=0)
    values = fit.sensor.values[effect]
    found = Finding(
        "reference_line",
        trial.kind,
        1,
        {"frequency": float(values["f0"]), "amplitude": float(np.abs(values["A"]).max())},
    )
    return replace(trial, u=u, findings=(*trial.findings, found))


def _line(fit: Fit, effect: str, trial: Trial, state: LogState) -> np.ndarray:
    """What an effect of a model adds (n, 3) to the sensor's output in a trial."""
    others = {e: v for e, v in fit.sensor.values.items() if e != effect}
    u = reference_input(trial, state)
    after, before = (
        predict(in_log(sensor, state), u, trial.segments, trial.h)
        for sensor in (fit.sensor, Sensor(fit.sensor.kind, others))
    )
    return after - before


def _of_reference(trial: Trial, line: np.ndarray) -> float:
    """Log-likelihood [nat] that a ``line`` (n, 3) is the reference's, over that it is the
    sensor's.
    """
    seen, time = in_band(trial, trial.y), band_time(trial)
    if len(time) < 2:
        return 0.0
    rows = in_band(trial, line)
    phase = 2 * np.pi * (time - time[0]) / (time[-1] - time[0])
    # The main lobe of this window is eight wide, and what lies farther away leaks in 92 dB lower.
    window = np.polynomial.chebyshev.chebval(np.cos(phase), BLACKMAN_HARRIS)
    beside = np.array([window * np.cos(k * phase) for k in (0, *BESIDE)])
    total = 0.0
    for i in trial.axes:
        lines = rows[:, i] * beside
        power = lines @ rows[:, i]
        if not power[0] > 0.0:
            continue
        share, *others = lines @ (seen[:, i] - seen[:, i].mean()) / power[0]
        variance = float(np.mean(np.square(others)))
        # A motion that is a line itself is in the sensor's signal by any share: that tells nothing.
        if min(abs(share), abs(share - 1.0)) < max(CHANCE * np.sqrt(variance), UNSURE):
            total += (0.5 - float(share)) / variance
    return total
