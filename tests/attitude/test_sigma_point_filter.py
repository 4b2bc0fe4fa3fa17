"""The fast filter makes the estimates of the filter of 13 sigma points."""

import numpy as np
from attitude_cases import (
    H,
    attitude_after,
    drive,
    error,
    eventful_drive,
    inputs,
    output,
    parameters,
    part,
    rover_rate,
)
from scipy.spatial.transform import Rotation

from pyimu.attitude import attitude_ukf
from pyimu.attitude.sigma_point_filter import sigma_point_filter

ALIGNED = np.array([0.01, 0.01, 0.001, 1e-3, 1e-3, 1e-3])
"""Standard deviations after some seconds at rest."""


def test_fast_filter_is_the_filter_of_thirteen_points_over_an_hour():
    """360,000 samples with updates by gravity at rest and in motion, by headings on time and late,
    and by zero rates: to 1e-6 rad and rad/s.
    """
    n = 360_000
    gyro, accel, heading, told, still = eventful_drive(n)
    late = np.where(told, np.arange(n) % 30, 0)
    u = inputs(
        n,
        gyro=gyro,
        accel=accel,
        heading=heading[np.arange(n) - late],
        heading_variance=4e-4,
        heading_valid=told & (late < np.arange(n)),
        heading_age=late * H,
        stationary=still,
    )
    fast, plain = attitude_ukf(part()), sigma_point_filter(part())
    p = parameters(fast, std0=ALIGNED, latitude=0.8)
    (y, _), (want, _) = fast.run(u, p=p), plain.run(u, p=p)
    turned = error(output(fast, y, "q"), Rotation.from_quat(want[:, :4], scalar_first=True))
    assert np.linalg.norm(turned, axis=1).max() < 1e-6
    assert np.abs(output(fast, y, "gyro_bias") - output(plain, want, "gyro_bias")).max() < 1e-6
    assert np.abs(output(fast, y, "std") - output(plain, want, "std")).max() < 1e-6
    for name in ("quasi_static", "status"):
        np.testing.assert_array_equal(output(fast, y, name), output(plain, want, name))
    quasi_static = output(fast, y, "quasi_static")
    assert 0.3 < quasi_static.mean() < 0.9
    assert output(fast, y, "nis")[quasi_static > 0].min() > 0


def test_fast_product_of_turns_is_the_drive_made_one_by_one():
    """Of the truth with which long tests are made."""
    rate = rover_rate(500)
    turned = (attitude_after(rate).inv() * drive(rate).attitude).as_rotvec()
    assert np.abs(turned).max() < 1e-13
