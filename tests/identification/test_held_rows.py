"""Which rows of a log judge where no log is named for it."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

import pyimu
from pyimu.identification.fit.trial import HELD_OUT
from pyimu.identification.fit.trials import gyro_trial
from pyimu.recording.recording import Recording

H, N = 0.01, 3e-4
LEVELS = np.radians([50.0, 150.0, 300.0])


def table(order: str = "xyz") -> np.ndarray:
    """Rates (n, 3) of a rate table on which one axis is turned after another, up and down."""
    rests, turns = np.zeros((round(2.0 / H), 3)), []
    for axis in order:
        for level in (s * v for v in LEVELS for s in (1.0, -1.0)):
            turn = np.zeros((round(5.0 / H), 3))
            turn[:, "xyz".index(axis)] = level
            turns += [rests, turn]
    return gaussian_filter1d(np.concatenate([*turns, rests]), 0.1 / H, axis=0)


def log(rate: np.ndarray, seed: int, cubic: float = 0.0) -> Recording:
    noise = N / np.sqrt(H) * np.random.default_rng(seed).standard_normal(rate.shape)
    time = H * np.arange(len(rate))
    gyro = rate + cubic * rate**3 + noise
    return Recording.from_arrays("table", time=time, gyro=gyro, ref_rate=rate)


@pytest.mark.parametrize("order", ["xyz", "yzx", "xyzxyz"])
def test_each_axis_has_its_share_of_the_fitted_rows(order):
    """Where each comes again the end judges, as of other logs."""
    trial = gyro_trial(log(table(order), 1))
    fitted, held = trial.split(HELD_OUT)
    rows = np.concatenate([np.arange(a, b) for a, b in fitted.segments])
    whole = np.sum(trial.u[:, :3] ** 2, axis=0)
    assert np.all(np.sum(fitted.u[rows, :3] ** 2, axis=0) > 0.2 * whole)
    assert len(held.time) == pytest.approx(HELD_OUT * len(trial.time), abs=1)
    both = np.concatenate([fitted.time[rows], held.time])
    np.testing.assert_array_equal(np.sort(both), trial.time)
    assert (held.time[-1] == trial.time[-1]) == (order == "xyzxyz")


def test_an_error_that_grows_with_the_rate_is_found_on_the_axis_that_turns_last_too():
    """It was "partly" what a part lacks, and 3.8 times the noise was left on that axis."""
    closed = pyimu.close([log(table(), 2, cubic=2e-4)])
    (added,) = closed.added
    assert added.effect == "scale_factor_cubic"
    value, std, _ = added.parameters["s3"]
    assert np.all(np.abs(value - 2e-4) < 4.5 * std)
    errors = closed.errors["gyro"]
    assert errors.after.total < errors.before.total / 1.5
    white = N / np.sqrt(H)
    rows = errors.after.rows.sum()
    assert errors.after.total == pytest.approx(white, rel=5 / np.sqrt(2 * rows) + 1e-3)
    assert closed.held_out == "middle 30 %"
    assert "on the middle 30 %" in closed.report()


def test_of_a_table_of_which_nothing_is_missing_nothing_is_named():
    closed = pyimu.close([log(table(), 3)])
    assert not closed.added and not closed.formulas
    errors = closed.errors["gyro"]
    assert errors.after.total == pytest.approx(errors.floor.total, rel=0.02)
