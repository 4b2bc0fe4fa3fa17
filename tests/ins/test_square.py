"""The drive along a square: closed, and force and rate are those of its own motion."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu.errors import UserError
from pyimu.rover.trajectory import Drive, motion, square, stop_times
from pyimu.symbolic.earth import EARTH_RATE


def test_it_returns_to_its_start_and_heading():
    end = square(vibration=0.3)
    np.testing.assert_allclose([end.ref_east[-1], end.ref_north[-1]], 0, atol=1e-12)
    assert end.ref_east.max() == pytest.approx(2.0, abs=1e-4)
    np.testing.assert_allclose(np.abs(end.ref_q[-1]), [1, 0, 0, 0], atol=1e-12)


@pytest.mark.parametrize("vibration", (0.0, 0.3))
def test_force_and_rate_are_derivatives_of_position_and_attitude(vibration):
    """Groves 2013, eq. 5.53, by central differences: off by h^2/6 of the third derivative."""
    h, latitude = 1e-3, 0.9
    truth = motion(Drive(latitude=latitude, vibration=vibration, tilt=(0.02, -0.03), legs=1), 1 / h)
    q = Rotation.from_quat(truth.ref_q, scalar_first=True)
    earth = EARTH_RATE * np.array([0.0, np.cos(latitude), np.sin(latitude)])
    place = np.column_stack([truth.ref_east, truth.ref_north, truth.ref_up])
    v = np.gradient(place, h, axis=0)
    a = np.gradient(truth.ref_velocity, h, axis=0)
    inner = slice(2, -2)
    omega = 2 * np.pi * 23.0
    # of a vibration a, v is a/omega and the third derivative of the place a omega
    close = h**2 / 6 * (0.3 / 0.5**3 * 60 + np.sqrt(2) * vibration * omega)
    np.testing.assert_allclose(v[inner], truth.ref_velocity[inner], atol=2 * close)
    force = q.inv().apply(a + 2 * np.cross(earth, v) + [0, 0, 9.80665])
    close = h**2 / 6 * (0.3 / 0.5**3 * 60 / 0.1 + np.sqrt(2) * vibration * omega**2)
    np.testing.assert_allclose(force[inner], truth.ref_force[inner], atol=3 * close)
    turn = (q[:-1].inv() * q[1:]).as_rotvec() / h + q[:-1].inv().apply(earth)
    middle = (truth.ref_rate[1:] + truth.ref_rate[:-1]) / 2
    np.testing.assert_allclose(turn, middle, atol=h**2 / 12 * 0.8 / 0.5**2 * 60)


def test_nothing_moves_in_its_stops():
    drive = Drive(vibration=0.3)
    truth = motion(drive)
    for start, stop in stop_times(drive):
        rows = (truth.time > start + 1e-9) & (truth.time < stop - 1e-9)
        assert rows.sum() > 90
        np.testing.assert_array_equal(truth.ref_velocity[rows], 0)
        np.testing.assert_array_equal(truth.moving[rows], 0)


@pytest.mark.parametrize("wrong", ({"speed": 0.0}, {"side": 0.1}, {"legs": 0}, {"stops": -1.0}))
def test_a_drive_that_is_none_is_refused(wrong):
    with pytest.raises(UserError, match="square: "):
        square(**wrong)
