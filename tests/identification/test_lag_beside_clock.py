"""A low-pass filter of the gyro beside cameras whose clock nobody set."""

import numpy as np
import pytest
from loop_cases import smooth
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.recording.recording import Recording

TAU, H, FINE = 0.012, 0.005, 5
FORM = 5e-3
"""Share of the time constant that the form of the sampled lag may cost: its difference is off by
(w h)^3 / 4 < 2e-4 at 3 Hz, against a curvature of b w / 2 = 0.11 of the slope; 1e-3 are the four
standard errors of these logs."""


def log(seed, clock, tau=TAU, slips=False, seconds=60.0):
    """A wand turned by hand before cameras that are ``clock`` s ahead; ``slips``: by one sample
    more in the last third. Its gyro is behind a filter with the time constant ``tau``.
    """
    rng = np.random.default_rng(seed)
    fine = np.arange(0.0, seconds + 1.0, H / FINE)
    turn = Rotation.from_euler("ZYX", smooth(rng, fine, 0.5, 3.0) * [1.0, 0.8, 1.0])
    motion = RotationSpline(fine[::2], turn[::2])
    kept = np.exp(-H / FINE / tau) if tau else 0.0
    rate = lfilter([1.0 - kept], [1.0, -kept], motion(fine, 1), axis=0)
    first, count = round(0.4 / H), round(seconds / H)
    rows = slice(first * FINE, (first + count) * FINE, FINE)
    time = fine[rows]
    ahead = clock + H * (slips & (np.arange(count) > 2 * count / 3))
    seen = motion(time + ahead) * Rotation.from_rotvec(3e-4 * rng.standard_normal((count, 3)))
    return Recording.from_arrays(
        name=f"log{seed}",
        time=time - time[0],
        gyro=rate[rows] + 2e-3 * rng.standard_normal((count, 3)),
        ref_q=seen.as_quat(scalar_first=True),
    )


def added(closed):
    return {a.effect: a.parameters for a in closed.added}


@pytest.mark.parametrize(
    "clock, slips",
    [pytest.param(-0.05, False, marks=pytest.mark.long), (0.03, False), (-0.02, True)],
)
def test_a_lag_is_told_from_the_clock_by_what_it_damps(clock, slips):
    """Whether the sensor shows the motion early, late, or later and later."""
    closed = pyimu.close(log(5, clock, slips=slips))
    assert set(added(closed)) == {"first_order_lag"}, closed.report()
    tau, std, _ = added(closed)["first_order_lag"]["tau"]
    assert tau == pytest.approx(TAU, abs=FORM * TAU + 4 * std)
    gyro = closed.errors["gyro"]
    assert gyro.after.total < 0.2 * gyro.before.total
    assert "fitted beside it" in closed.report()


def test_a_log_that_was_not_fitted_has_a_clock_of_its_own():
    closed = pyimu.close(log(5, -0.05), holdout=log(6, -0.03))
    assert set(added(closed)) == {"first_order_lag"}, closed.report()
    gyro = closed.errors["gyro"]
    assert gyro.after.total < 0.2 * gyro.before.total


@pytest.mark.parametrize("clock", [-0.05, 0.03])
def test_a_clock_alone_is_no_lag(clock):
    found = set(added(pyimu.close(log(5, clock, tau=0.0))))
    assert found <= {"time_delay"} if clock > 0 else not found
