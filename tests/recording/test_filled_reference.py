"""Rows of a reference that a program filled in where samples were lost."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from pyimu.identification.fit.trials import gyro_trial
from pyimu.recording.recording import Recording
from pyimu.recording.reference.filled import filled_in, resolution
from pyimu.recording.reference.rate import reference_rate

H, ROWS = 0.01, 4000
TIME = H * np.arange(ROWS)
ANGLE = np.sin(1.3 * TIME) + 0.5 * np.sin(3.1 * TIME)
SPANS = [(300, 380), (1000, 1020), (1210, 1350), (2500, 2530)]
LOST = np.isin(np.arange(ROWS), np.concatenate([np.arange(*s) for s in SPANS]))


def noisy(seed=0, std=3e-4):
    return ANGLE + std * np.random.default_rng(seed).standard_normal(ROWS)


def kept(values):
    values = values[:, None]
    return np.flatnonzero(~filled_in(values, resolution(values)))


def by_lines(values):
    return np.interp(TIME, TIME[~LOST], values[~LOST])


def by_splines(values):
    return CubicSpline(TIME[~LOST], values[~LOST])(TIME)


@pytest.mark.parametrize("filled", [by_lines, by_splines])
def test_rows_that_were_filled_in_are_no_samples(filled):
    """A spline's fourth differences reach two rows into what lies beside it."""
    there = np.isin(np.arange(ROWS), kept(filled(noisy())))
    assert there[~LOST].mean() > 0.99 and not there[LOST].mean() > 0.03
    for first, stop in SPANS:
        assert not there[first + 2 : stop - 2].any()


@pytest.mark.parametrize("digits", [None, 3, 6])
def test_what_was_measured_is_whole_however_few_its_digits(digits):
    """A rest of few digits repeats, a curve without noise is smooth everywhere, and what shakes a
    thousand times its noise at times, as beside a motor, scatters in between.
    """
    busy = np.sin(0.2 * TIME) > 0.0
    shakes = noisy(std=1e-3) + busy * noisy(seed=1, std=1.0)
    ramps = np.cumsum(np.clip(2.0 * np.sin(0.7 * TIME), -1.0, 1.0)) * H
    steep = np.clip((TIME % 10.0 - 3.0) / 2.0, 0.0, 1.0)
    quick = np.where(TIME < 20.0, np.sin(15.0 * TIME), steep)
    for values in (noisy(), ANGLE, busy * ANGLE, np.abs(ANGLE), ramps, quick, shakes):
        seen = values if digits is None else np.round(values, digits)
        assert len(kept(seen)) == ROWS


def test_the_rate_is_unknown_where_an_attitude_was_filled_in():
    values = by_lines(noisy(std=3e-5))
    q = np.column_stack([np.cos(values / 2), 0 * values, 0 * values, np.sin(values / 2)])
    gyro = np.column_stack([0 * ANGLE, 0 * ANGLE, np.gradient(ANGLE, H)])
    found = reference_rate(Recording.from_arrays("log", time=TIME, gyro=gyro, ref_q=q))
    assert np.isnan(found.rate[305:375]).all() and np.isfinite(found.rate[100:290]).all()
    assert {f.kind: f.count for f in found.findings}["filled_in"] == LOST.sum()


def test_rows_of_a_gyro_that_were_filled_in_are_left_out():
    """Beside a rate that is known, lines across 0.2 to 1.4 s of a motion are no samples; where one
    meets what was measured that may look like a spike.
    """
    rng = np.random.default_rng(3)
    rate = np.column_stack([np.gradient(ANGLE, H), 0 * ANGLE, 0 * ANGLE])
    measured = rate + 1e-3 * rng.standard_normal(rate.shape)
    gyro = np.column_stack([by_lines(v) for v in measured.T])
    trial = gyro_trial(Recording.from_arrays("log", time=TIME, gyro=gyro, ref_rate=rate))
    assert trial.left_out[LOST].all() and np.sum(trial.left_out & ~LOST) <= 2 * len(SPANS)
    assert {f.kind: f.count for f in trial.findings} == {"filled_in": LOST.sum()}
