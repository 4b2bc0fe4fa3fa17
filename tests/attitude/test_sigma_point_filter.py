"""The fast filter makes the estimates of the filter of 13 sigma points."""

import casadi as ca
import numpy as np
import pytest
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
from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.layout import Layout
from pyimu.attitude.filter.prediction import ARGUMENTS, Instant, is_awake
from pyimu.attitude.filter.sigma_point_filter import sigma_point_filter
from pyimu.attitude.filter.stillness import SLOW

FILTERS = (attitude_ukf, sigma_point_filter)

ALIGNED = np.array([0.01, 0.01, 0.001, 1e-3, 1e-3, 1e-3])
"""Standard deviations after some seconds at rest."""


@pytest.mark.long
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


def test_fast_filter_is_the_other_where_axes_and_triads_are_stuck():
    """Axes and triads for some seconds, rows that repeat as a whole, and zeros before the first.

    The estimates differ by what the approximation of the fast filter leaves, a small part of a
    standard deviation where innovations are large.
    """
    gyro, accel, *_ = eventful_drive(6000)
    gyro[1500:1800, 2], gyro[2500:2700, 0], gyro[2550:2600, 1] = gyro[1500, 2], 0.1, 0.2
    accel[3200:3400, 1], gyro[4000:4100], accel[4500:4600] = 0.5, gyro[4000], accel[4500]
    gyro[5001:5800:2], accel[:3] = gyro[5000:5799:2], 0
    u, (fast, plain) = inputs(6000, gyro=gyro, accel=accel), (f(part()) for f in FILTERS)
    times = {"stuck_time": 0.5 - H / 2, "axis_stuck_time": np.full(6, 0.2 - H / 2)}
    p = parameters(fast, std0=ALIGNED, lost_rate_std=0.02, **times)
    (y, _), (want, _) = fast.run(u, p=p), plain.run(u, p=p)
    turned = error(output(fast, y, "q"), Rotation.from_quat(want[:, :4], scalar_first=True))
    std = output(plain, want, "std")
    assert (np.abs(turned) < 0.01 * std[:, :3]).all()
    np.testing.assert_allclose(output(fast, y, "std"), std, rtol=0.01)
    status = output(fast, y, "status").astype(int)
    np.testing.assert_array_equal(status, output(plain, want, "status"))
    # Stuck since the sample after the first of the equal ones, and found after the set time.
    found = np.flatnonzero(status & 4)
    expected = [(1520, 1800), (2520, 2700), (3220, 3400), (4050, 4100), (4550, 4600)]
    np.testing.assert_array_equal(found, np.concatenate([np.arange(*e) for e in expected]))


def test_fast_filter_of_a_calibrated_gyro_is_that_which_knows_of_scale_factors():
    """Its own functions, in motion and at rest, give the bits of those that carry along what scale
    factors have made, where that is nothing; these run where the state says that there was some.
    """
    gyro, accel, *_ = eventful_drive(6000)
    u, fast = inputs(6000, gyro=gyro, accel=accel), attitude_ukf(part())
    p = parameters(fast, std0=np.full(6, 0.01), scale_std=0.0, axes_std=0.0)
    state = fast.initial(fast.start_inputs, p)[0].full().ravel()
    scales = Layout(Compensation(part())).motion - 5
    said = state.copy()
    said[scales] = 1
    (y, after), (want, other) = (fast.run(u, p=p, state=s) for s in (state, said))
    np.testing.assert_array_equal(y, want)
    assert (after[scales], other[scales]) == (0, 1)
    assert output(fast, y, "at_rest").any() and not output(fast, y, "at_rest").all()


def test_a_body_that_may_show_that_it_sways_is_asked_whether_it_does():
    """It may after 3 s, however long a rest takes."""
    layout = Layout(Compensation(part()))
    symbols = layout.symbols(ca.SX, ARGUMENTS)
    at = Instant.of(layout, symbols)
    span = at.memory.stillness.span
    still, p = ca.SX.sym("still"), parameters(attitude_ukf(part()), rest_time=10.0)
    given = [ca.substitute(is_awake(at), span, still)]
    awake = ca.Function("awake", [still, *symbols], given)
    others = [np.zeros(s.numel()) for s in symbols]
    others[3:] = p, H
    found = [float(awake(s, *others)) for s in (SLOW - 3 * H, SLOW - H)]
    assert found == [1, 0]


def test_fast_product_of_turns_is_the_drive_made_one_by_one():
    """Of the truth with which long tests are made."""
    rate = rover_rate(500)
    turned = (attitude_after(rate).inv() * drive(rate).attitude).as_rotvec()
    assert np.abs(turned).max() < 1e-13
