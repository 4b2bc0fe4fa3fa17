"""Errors of measured positions that last."""

from dataclasses import replace

import numpy as np
import pytest
from navigation_cases import calibrated, declared, noisy, perfect, white
from scipy.stats import chi2

from pyimu.ins import run
from pyimu.ins.lasting import _fitted
from pyimu.rover.trajectory import Drive

DRIVE = Drive(legs=4, side=150.0, speed=10.0, first_rest=5.0, stops=0.0, turn_rate=0.3, ramp=4.0)
STD, TIME, RATE, EVERY = 1.0, 20.0, 20.0, 10
RUNS = 6


@pytest.fixture(scope="module")
def truth():
    return declared(perfect(DRIVE, RATE), DRIVE)


def located(truth, seed, new):
    """A noisy log with positions, of whose variance the share ``new`` is new each time and the rest
    lasts for ``TIME``."""
    rng = np.random.default_rng(50 + seed)
    log = noisy(truth, white(calibrated()), seed)
    rows = np.arange(0, len(log.time), EVERY)
    kept, error = np.exp(-EVERY / RATE / TIME), rng.standard_normal((len(rows), 3))
    lasts = np.empty_like(error)
    lasts[0] = error[0]
    for k in range(1, len(rows)):
        lasts[k] = kept * lasts[k - 1] + np.sqrt(1 - kept**2) * error[k]
    fresh = rng.standard_normal(error.shape)
    off = STD * (np.sqrt(1 - new) * lasts + np.sqrt(new) * fresh)
    columns = {}
    for i, axis in enumerate(("east", "north", "up")):
        values = np.full(len(log.time), np.nan)
        values[rows] = getattr(log, f"ref_{axis}")[rows] + off[:, i]
        columns[f"position_{axis}"] = values
    return replace(log, **columns, position_std=np.full(len(log.time), STD)), off[0]


def navigated(truth, seed, new):
    log, first = located(truth, seed, new)
    settings = {"top_speed": 20.0}
    found = run(log, white(calibrated()), method="filter", heading0=0.0, settings=settings)
    return found, first


def squares(found, first, truth):
    """The squared error of the last position over its claimed variance (2,)."""
    end = np.array([truth.ref_east[-1], truth.ref_north[-1]]) - first[:2]
    track = found.tracks["filter"]
    return ((track.position[-1, :2] - end) / track.position_std[-1, :2]) ** 2


@pytest.mark.parametrize("new", (0.0, 0.2))
def test_the_path_is_no_surer_than_positions_whose_errors_last(truth, new):
    """Each of the sums over the runs is that of as many squares of a normal number on each axis;
    axes are alike, and what they have in common widens no mean. One in 10,000 is larger."""
    total, times = np.zeros(2), []
    for seed in range(RUNS):
        found, first = navigated(truth, seed, new)
        total += squares(found, first, truth)
        (said,) = [f for f in found.findings if f.kind == "lasting_fixes"]
        times.append(said.detail["time"])
    assert np.all(total < chi2.isf(5e-5, RUNS))
    assert TIME / 3 < np.median(times) < 3 * TIME
    assert "The errors of the measured positions last" in found.report()


def test_errors_that_do_not_last_are_taken_as_new(truth):
    for seed in range(3):
        found, _ = navigated(truth, seed, 1.0)
        assert not [f for f in found.findings if f.kind == "lasting_fixes"]


@pytest.mark.parametrize("time", (3.0, 10.0, 30.0))
def test_a_time_constant_is_that_of_an_exponential(time):
    """By a line through the spans up to 5 s that of 10 s was 1.4 times as long."""
    spans = np.arange(1.0, 6.0)
    halves = 0.2 + 0.8 * (1 - np.exp(-spans / time))
    found, share = _fitted(spans, halves, (0.5, 120.0))
    assert found == pytest.approx(time, rel=0.02)
    assert share == pytest.approx(0.2, abs=0.01)
