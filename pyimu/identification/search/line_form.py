"""The frequency and the phases of a line, by the periodogram of a residual that is white."""

from __future__ import annotations

import numpy as np
from scipy.fft import next_fast_len, rfft

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.form import Form, form_of, since_power_on
from pyimu.model.effect import Effect

PADDED = 2
"""Frequencies tried to each that is independent: a line between two of those would be missed."""

ABOUT_THE_GATE = 10.0
"""nat, before the penalty: near the gate the sum of two squares has the tail of one times
sqrt(pi g), whose logarithm the free phase costs."""


def line_form(fit: Fit, linears: list[Linear], e: Effect, penalty: float) -> Form | None:
    """The frequency at which the periodogram of the whitened residual is largest, and the phase of
    each axis there.

    With nothing to find the ordinates are independent and exponential (Brockwell and Davis 1991,
    section 10.1): the best of m is larger by log m.
    """
    parts = [(t, one) for t, one in zip(fit.trials, linears, strict=True) if len(one.time) > 1]
    periods = [float(np.median(np.diff(one.time))) for _, one in parts]
    if not parts or max(periods) > 1.01 * min(periods):
        return None
    period = periods[0]
    places = [np.rint(since_power_on(t, one.time) / period).astype(int) for t, one in parts]
    size = next_fast_len(PADDED * (max(int(p[-1]) for p in places) + 1), real=True)
    frequency = np.arange(size // 2 + 1) / (size * period)
    length = max(float(one.time[-1] - one.time[0]) for _, one in parts)
    name = form_of(e)
    tried = (frequency > e.parameters[name].scan.low / length) & (frequency < 0.49 / period)
    if not tried.any():
        return None
    total = np.zeros(len(frequency))
    for i, noise in fit.noise.items():
        row = np.zeros(size)
        for (_, one), place in zip(parts, places, strict=True):
            if i in one.keys:
                white = noise.whiten(one.residual[:, [i]], one.time, one.segments)
                np.add.at(row, place, white[:, 0])
        rows = sum(len(one.time) for _, one in parts if i in one.keys)
        total += np.maximum(np.abs(rfft(row)) ** 2 / rows - penalty, 0.0)
    best = float(frequency[np.argmax(np.where(tried, total, -1.0))])
    toll = np.log(tried.sum()) + 0.5 * np.log(np.pi * ABOUT_THE_GATE)
    values, keys = {name: np.array(best)}, [Coefficient(e.name, name, ())]
    for n, p in e.parameters.items():
        if p.form and p.scan.measure == "phase":
            values[n] = np.array([_phase(fit, parts, i, best) for i in range(3)])
            keys += [Coefficient(e.name, n, (i,)) for i in range(3)]
    return Form(values, tuple(keys), float(toll))


def _phase(fit: Fit, parts: list[tuple[Trial, Linear]], axis: int, frequency: float) -> float:
    """The phase at power-on of a line in the residual of an axis."""
    gram, score = np.zeros((2, 2)), np.zeros(2)
    for trial, one in parts:
        if axis in one.keys:
            angle = 2 * np.pi * frequency * since_power_on(trial, one.time)
            rows = np.column_stack([np.sin(angle), np.cos(angle), one.residual[:, axis]])
            white = fit.noise[axis].whiten(rows, one.time, one.segments)
            gram += white[:, :2].T @ white[:, :2]
            score += white[:, :2].T @ white[:, 2]
    sine, cosine = np.linalg.lstsq(gram, score)[0]
    return float(np.arctan2(cosine, sine))
