"""Rows of a reference that repeat the one before: their sample was lost, or the body rests."""

import numpy as np
import pytest

from pyimu.recording.recording import Recording
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.reference.repeats import LOST, without_repeats

H, ROWS = 0.01, 4000
TIME = H * np.arange(ROWS)
ANGLE = np.sin(1.3 * TIME) + 0.5 * np.sin(3.1 * TIME)
RATE = 1.3 * np.cos(1.3 * TIME) + 1.55 * np.cos(3.1 * TIME)


def noisy(seed=0, std=3e-4):
    return ANGLE + std * np.random.default_rng(seed).standard_normal(ROWS)


def held(values, spans):
    out, lost = np.array(values), np.zeros(len(values), dtype=bool)
    for first, stop in spans:
        out[first:stop] = out[first - 1]
        lost[first:stop] = True
    return out, lost


def kept(values):
    return without_repeats(values[:, None], np.arange(len(values)))


FRAMES = [(k, k + 1 + k % 4) for k in range(100, 3900, 60)]
SECONDS = [(300, 380), (1000, 1200), (1210, 1300), (2500, 2530)]


@pytest.mark.parametrize("spans", [FRAMES, SECONDS, [*FRAMES[::9], *SECONDS[1:2]]])
def test_rows_that_lost_their_sample_are_none(spans):
    values, lost = held(noisy(), spans)
    np.testing.assert_array_equal(kept(values), np.flatnonzero(~lost))


def test_a_rest_without_noise_and_one_of_few_digits_are_samples():
    """A body that rests goes on from where it was: no step makes up for the rows between."""
    ease = np.clip((TIME % 10.0 - 3.0) / 4.0, 0.0, 1.0)
    rests = np.floor(TIME / 10.0) + ease**2 * (3 - 2 * ease)
    for values in (rests, np.round(rests + 1e-4 * noisy(), 2)):
        runs = np.diff(np.flatnonzero(np.diff(values) != 0.0))
        assert runs.max() > 10 * LOST
        there = kept(values)
        # A step that few digits make of two rows may lose one of them, among steps as large.
        assert len(there) > 0.97 * ROWS and np.diff(there).max() <= LOST


def test_the_rate_of_an_attitude_is_unknown_where_its_samples_were_lost():
    """A hold of 2 s is no rest, though the body turns at up to 3 rad/s, and a single frame is
    bridged. Noise of 0.03 mrad makes 0.06 rad/s of a rate at the ends of what is known; a row that
    repeats would be off by all of it.
    """
    values, _ = held(noisy(std=3e-5), [(1000, 1200), (2000, 2001)])
    q = np.column_stack([np.cos(values / 2), 0 * values, 0 * values, np.sin(values / 2)])
    gyro = np.column_stack([0 * RATE, 0 * RATE, RATE])
    found = reference_rate(Recording.from_arrays("log", time=TIME, gyro=gyro, ref_q=q))
    inside = (TIME > 10.1) & (TIME < 11.9)
    assert np.isnan(found.rate[inside]).all() and np.isfinite(found.rate[1990:2010]).all()
    known = np.isfinite(found.rate[:, 2])
    assert np.abs(found.rate[known, 2] - RATE[known]).max() < 0.15
    assert {f.kind: f.count for f in found.findings}["repeated_samples"] == 201
