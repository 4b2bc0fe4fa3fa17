"""Whether one of sensor and reference damps what the other shows.

By the motion as either shows it. The noise of the one that it is taken from lies in the regressors,
and makes the other look as if it damped what is quick: by the reference the sensor damps too much,
by the sensor too little, and the truth lies between.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.identification.fit.columns import Linear, band_segments, in_band
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.incoherent import thirds
from pyimu.identification.fit.inputs import own_rate
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import OWN

SHOWN = 10.0
"""Power of the motion over that of what a model leaves from which on a frequency counts."""

FEWEST = 64
"""Rows of a segment whose spectrum is looked at."""

OF_HANN = 1.5
"""Frequencies of a spectrum through Hann's window that say as much as one by itself would."""


@dataclass(frozen=True)
class Damped:
    """``gain`` [nat] that a gain which falls with the square of the frequency explains, by the half
    ``falls`` [s^2] of that gain's second derivative, which is known to ``std``; beside it a sensor
    is ``late`` by so many s. Above ``below`` Hz no motion stands out.
    """

    gain: float = 0.0
    falls: float = 0.0
    std: float = np.inf
    late: float = 0.0
    below: float = 0.0


def beyond_noise(current: Fit, share: float | None = None) -> Damped:
    """How much the sensor damps at the frequencies at which the motion stands out.

    By the motion as both show it: with variances v of the sensor's noise n and w of the reference's
    e, that of (v x + w y) / (v + w) has the noise (v e + w n) / (v + w), which does not correlate
    with n - e, the noise of what is left (errors in variables; Fuller 1987, Measurement Error
    Models, section 1.3). The ``share`` w / (v + w) is that of the noise that was drawn in what is
    left unless given: 0 goes by the reference alone, 1 by the sensor.
    """
    total, along, late, weight, below = 0.0, 0.0, 0.0, 0.0, 0.0
    for trial, one in zip(current.trials, current.residuals(), strict=True):
        turn = current.states[trial.name].rotation.T
        signals = [in_band(trial, v) for v in (trial.u[:, OWN[trial.kind]] @ turn, trial.y)]
        drawn = None if trial.noise is None else in_band(trial, trial.noise)
        for i in trial.axes:
            rows, left, highest = _spectra(trial, one, i, signals, drawn, share)
            if len(left) <= 2 * rows.shape[1]:
                continue
            scale = np.linalg.norm(rows, axis=0)
            inverse = np.linalg.pinv(rows.T @ rows / np.outer(scale, scale))
            found = inverse @ (rows / scale).T @ left
            rest = left - rows / scale @ found
            both = left - rows[:, :2] @ np.linalg.lstsq(rows[:, :2], left)[0]
            total += 0.5 * len(left) / OF_HANN * np.log(max(both @ both, 1e-300) / (rest @ rest))
            variance = OF_HANN * inverse[2, 2] / scale[2] ** 2 * (rest @ rest) / len(left)
            along, weight = along + found[2] / scale[2] / variance, weight + 1.0 / variance
            late, below = late - found[1] / scale[1] / variance, max(below, highest)
    if not weight:
        return Damped()
    return Damped(total, along / weight, weight**-0.5, late / weight, below)


def _spectra(
    trial: Trial,
    one: Linear,
    i: int,
    signals: list[np.ndarray],
    drawn: np.ndarray | None,
    share: float | None,
) -> tuple[np.ndarray, np.ndarray, float]:
    """Columns (m, 3) of the motion and two derivatives of it on an axis, and what is left (m,), at
    the frequencies at which the motion stands out, real parts and imaginary ones, and the highest
    of these in Hz.
    """
    highest, columns, lefts = 0.0, [np.zeros((0, 3))], [np.zeros(0)]
    for a, b in band_segments(trial):
        if b - a < FEWEST:
            continue
        left, by, own = (_spectrum(v[a:b, i]) for v in (one.residual, *signals))
        out = _stands_out(by, left)
        if share is None and drawn is not None:
            noise, power = (np.sum(np.abs(v[out]) ** 2) for v in (_spectrum(drawn[a:b, i]), left))
            of_reference = min(1.0, noise / max(power, 1e-300))
        else:
            of_reference = share or 0.0
        frequency = np.fft.rfftfreq(b - a, trial.h * trial.band.stride)[out]
        slope, highest = 2j * np.pi * frequency, max([highest, *frequency[-1:]])
        motion = ((1.0 - of_reference) * by + of_reference * own)[out]
        made = np.column_stack([motion, slope * motion, slope**2 * motion])
        columns += [made.real, made.imag]
        lefts += [left[out].real, left[out].imag]
    return np.concatenate(columns), np.concatenate(lefts), float(highest)


def _spectrum(values: np.ndarray) -> np.ndarray:
    return np.fft.rfft(np.hanning(len(values)) * (values - values.mean()))


def _stands_out(motion: np.ndarray, left: np.ndarray) -> np.ndarray:
    """The frequencies (f,) at which the motion has ``SHOWN`` times the power of what is left."""
    out = np.zeros(len(motion), dtype=bool)
    for some in thirds(len(motion)):
        shown, rest = (np.sum(np.abs(v[some]) ** 2) for v in (motion, left))
        out[some] = shown > SHOWN * rest
    return out


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
