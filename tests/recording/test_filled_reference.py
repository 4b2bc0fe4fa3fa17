"""Rows of a reference that a program filled in where samples were lost."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from pyimu.recording.recording import Recording
from pyimu.recording.reference.filled import without_filled
from pyimu.recording.reference.rate import reference_rate

H, ROWS = 0.01, 4000
TIME = H * np.arange(ROWS)
ANGLE = np.sin(1.3 * TIME) + 0.5 * np.sin(3.1 * TIME)
SPANS = [(300, 380), (1000, 1020), (1210, 1350), (2500, 2530)]
LOST = np.isin(np.arange(ROWS), np.concatenate([np.arange(*s) for s in SPANS]))


def noisy(seed=0, std=3e-4):
    return ANGLE + std * np.random.default_rng(seed).standard_normal(ROWS)


def kept(values):
    return without_filled(values[:, None], np.arange(len(values)))


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
    """By chance three numbers in 20,000 are as small, and no five in a row; a rest of few digits
    repeats, and a curve without noise is smooth everywhere.
    """
    rests = np.where(np.sin(0.2 * TIME) > 0.0, ANGLE, 0.0)
    for values in (noisy(), ANGLE, rests, np.abs(ANGLE), noisy(std=1e-6)):
        seen = values if digits is None else np.round(values, digits)
        assert len(kept(seen)) == ROWS


def test_the_rate_is_unknown_where_an_attitude_was_filled_in():
    values = by_lines(noisy(std=3e-5))
    q = np.column_stack([np.cos(values / 2), 0 * values, 0 * values, np.sin(values / 2)])
    gyro = np.column_stack([0 * ANGLE, 0 * ANGLE, np.gradient(ANGLE, H)])
    found = reference_rate(Recording.from_arrays("log", time=TIME, gyro=gyro, ref_q=q))
    assert np.isnan(found.rate[305:375]).all() and np.isfinite(found.rate[100:290]).all()
    assert {f.kind: f.count for f in found.findings}["filled_in"] == LOST.sum()
