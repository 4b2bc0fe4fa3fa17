"""Attitudes of cameras that see a quick motion with few frames, beside a gyro."""

import numpy as np
import pytest
from loop_cases import smooth
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.quiet_rate import with_quiet_rate
from pyimu.model.kinds import OWN
from pyimu.recording.recording import Recording
from pyimu.recording.reference.file import with_reference

H, SECONDS, NOISE = 0.01, 90.0, 2e-3
"""s and rad/s, of the gyro."""


def shaken(seed, hz, size, highest, of_camera=1e-3):
    """The log of a gyro in a hand that shakes by ``size`` rad up to ``highest`` Hz, and what a
    camera of ``hz`` sees of it, on a clock of its own."""
    rng = np.random.default_rng(seed)
    fine = H * np.arange(-100, round(SECONDS / H) + 100)
    slow = smooth(rng, fine, 0.4, highest=1.0) * [1.0, 0.8, 1.0]
    quick = smooth(rng, fine, size, highest=highest)
    turn = RotationSpline(fine, Rotation.from_euler("ZYX", slow + quick))
    time = fine[100:-100]
    gyro = turn(time, 1) + NOISE * rng.standard_normal((len(time), 3)) + rng.normal(0, 5e-3, 3)
    at = np.arange(0.013, time[-1], 1.0 / hz)
    seen = turn(at) * Rotation.from_rotvec(of_camera * rng.standard_normal((len(at), 3)))
    log = Recording.from_arrays(time=time, gyro=gyro)
    return log, Recording.from_arrays(time=at, ref_q=seen.as_quat(scalar_first=True)), turn


@pytest.mark.parametrize(
    "hz, size, highest",
    [
        (20, 0.04, 8.0),
        pytest.param(10, 0.02, 6.0, marks=pytest.mark.long),
        # Much of it is quicker than half the frames, and looks slow to them.
        pytest.param(25, 0.01, 20.0, marks=pytest.mark.long),
        pytest.param(30, 0.04, 8.0, marks=pytest.mark.long),
    ],
)
@pytest.mark.parametrize("seed", [12, pytest.param(13, marks=pytest.mark.long)])
def test_what_few_frames_show_of_shaking_is_no_error_of_the_gyro(hz, size, highest, seed):
    """A camera of 20 Hz looked smoothed, and products of rates were formulas of the gyro's."""
    log, camera, _ = shaken(seed, hz, size, highest)
    closed = pyimu.close(log, reference=camera)
    assert closed.verdict == "clean" and not closed.added, closed.report()
    assert not [f for f in closed.quality if f.kind == "reference_smoothed"]


@pytest.mark.parametrize("seed", range(14, 18))
def test_the_gyro_shows_what_frames_between_which_an_axis_turns_lack(seed):
    """Of frames without noise: what is left of the reference's rate in its band is at most what the
    gyro's own noise has there."""
    log, camera, turn = shaken(seed, 25, 0.01, 20.0, of_camera=0.0)
    trial = gyro_trial(with_reference(log, camera))
    whole = with_quiet_rate(trial)
    true = turn(trial.time, 1)
    left, was = (
        t.band.apply(t.u[:, OWN["gyro"]] - true, whole.row_segments).std() for t in (whole, trial)
    )
    own = NOISE * np.sqrt(np.sum(np.square(trial.band.weights)))
    assert left < own < 0.5 * was
