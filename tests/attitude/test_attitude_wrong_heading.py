"""Headings that are wrong, that contradict the yaw, or that come before the tilt is known."""

import numpy as np
import pytest
from attitude_cases import H, error, inputs, output, parameters, part
from scipy.spatial.transform import Rotation
from test_attitude_faults import upside_down

from pyimu.attitude import attitude_ukf


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


def test_single_wrong_heading_changes_little_and_is_said(block):
    """1.5 rad off with a standard deviation of 0.02 rad, among right ones once a second."""
    n = 4000
    u = inputs(n)
    u[::100, 8:10] = 0.02**2, 1
    right, _ = block.run(u)
    u[2000, 7] = 1.5
    y, _ = block.run(u)
    status = output(block, y, "status")
    assert status[2000] == 64 and not np.delete(status, 2000).any()
    moved, std = (
        np.abs(output(block, y, "yaw") - output(block, right, "yaw")),
        output(block, y, "std")[:, 2],
    )
    assert (moved < 3 * std)[2000:].all() and moved[-1] < std[-1]


def test_yaw_that_all_headings_contradict_is_given_up(block):
    u = inputs(4000)
    u[1000::10, 7:10] = 2.0, 0.02**2, 1
    y, _ = block.run(u, p=parameters(block, std0=np.array([0.01, 0.01, 0.01, 1e-3, 1e-3, 1e-3])))
    status = output(block, y, "status").astype(int)
    assert status[1000] == 64 and not status[1500:].any()
    assert abs(output(block, y, "yaw")[-1] - 2.0) < 5 * output(block, y, "std")[-1, 2]
    assert abs(output(block, y, "gyro_bias")[-1, 2]) < 5 * output(block, y, "std")[-1, 5]


@pytest.mark.parametrize("variance", [0.0, -1.0, np.nan])
def test_heading_whose_variance_is_none_is_refused(block, variance):
    u = inputs(50)
    plain, _ = block.run(u)
    u[20, 7:10] = 0.3, variance, 1
    y, _ = block.run(u)
    assert output(block, y, "status")[20] == 1
    np.testing.assert_array_equal(output(block, y, "q"), output(block, plain, "q"))


@pytest.mark.parametrize("std0", [0.1, 2.0])
def test_headings_wait_until_gravity_has_set_the_tilt_right(block, std0):
    """Upside down and called level: what the headings are off by then is neither yaw nor bias."""
    u, _ = upside_down(1 / H, 60, seed=3)
    told = np.arange(0, len(u), 10)
    u[told, 7:10] = np.column_stack(
        [
            1.0 + 0.02 * np.random.default_rng(3).standard_normal(len(told)),
            np.full((len(told), 2), [0.02**2, 1]),
        ]
    )
    y, _ = block.run(u, p=parameters(block, std0=np.array([std0] * 3 + [0.003] * 3)))
    truth = Rotation.from_euler("ZYX", [1.0, 0, np.pi])
    status, std = output(block, y, "status").astype(int), output(block, y, "std")
    assert (status[told[1:5]] & 32).all() and not status[1000:].any()
    for row in (2000, -1):
        assert (np.abs(error(output(block, y, "q")[row], truth)) < 5 * std[row, :3]).all()
        assert (np.abs(output(block, y, "gyro_bias")[row]) < 5 * std[row, 3:]).all()
