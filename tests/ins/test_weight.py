"""What rests, legs and turns tell of tilt, bias and misalignment, and that they tell no more."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
from navigation_cases import SHORT, assumed, calibrated, declared, noisy, perfect, white
from scipy.stats import chi2

from pyimu.block.block import Run
from pyimu.block.parameters import with_values
from pyimu.ins import run
from pyimu.ins.filter.ins_block import ins_of_log
from pyimu.ins.filter.layout import BASE, UP, VELOCITY, Layout
from pyimu.ins.filter.weight import bowed
from pyimu.model.sensor import Sensor
from pyimu.rover.trajectory import stop_times
from pyimu.units import STANDARD_GRAVITY

DRIVE = replace(SHORT, legs=1, vibration=0.0)
BIAS = 0.3
"""m/s^2."""

SETTINGS = {f"gyro_bias_std0[{i}]": 0.01 for i in (1, 2, 3)}
SETTINGS |= {f"accel_bias_std0[{i}]": BIAS for i in (1, 2, 3)}

PRIOR = 1 / np.hypot(STANDARD_GRAVITY / BIAS, 1 / 0.3)
"""rad; of the tilt after a rest: that of the bias, and the filter's 0.3 rad before the rest."""


def navigated(bias=(0.0, 0.0, 0.0), seed=None, part=None):
    """The filter over a leg and a turn."""
    part = white(calibrated()) if part is None else part
    truth = declared(perfect(DRIVE), DRIVE)
    log = truth if seed is None else noisy(truth, part, seed)
    log = replace(log, accel=log.accel + bias)
    return run(log, part, method="filter", settings=SETTINGS)


def tilt_std(found, stop):
    """rad; of roll and pitch at the end of a stop."""
    row = found.stops[stop][1] - 2
    return found.filter.vector("attitude_std")[row, :2]


@pytest.mark.parametrize("seed", range(4))
def test_the_noise_of_a_leg_tells_no_tilt(seed):
    """A leg that only goes straight leaves the tilt as unknown as it was but for what the rest of
    its zero velocities say of its change, some 0.2 % of the whole."""
    found = navigated(seed=seed)
    np.testing.assert_allclose(tilt_std(found, 0), PRIOR, rtol=2e-3)
    np.testing.assert_allclose(tilt_std(found, 1), PRIOR, rtol=2e-2)
    assert np.all(tilt_std(found, 2) < 0.1 * PRIOR)


def test_a_turn_is_linear_in_the_tilt():
    """A body that is tilted by up to 7 deg, by its accelerometer's bias: the first zero velocity
    after a turn has the NIS of that bias, and the attitude is right after it."""
    for size in (0.01, 0.3, 1.2):
        found = navigated(bias=(0.0, -size, 0.0))
        assert found.first_zupts[-1] == pytest.approx((size / BIAS) ** 2, rel=0.03)
        up = found.filter.vector("q", 4)[-1]
        roll = 2 * np.arcsin(np.hypot(up[1], up[2]))
        assert abs(roll - np.hypot(*DRIVE.tilt)) < 3e-3 * max(1.0, size)


def test_a_turn_tells_the_tilt_from_the_bias_as_far_as_the_gyro_stands_straight():
    """On a level floor a tilt and a gyro that is askew by as much look the same: the axis of the
    turn is where the gravity is. So what is known of the tilt is what is known of the two."""
    own = white(calibrated())
    askew = next(t for t in assumed().tolerances if t.key[:2] == ("gyro", "misalignment"))
    found = navigated(part=replace(own, tolerances=(askew,)))
    want = 1 / np.hypot(1 / PRIOR, 1 / np.radians(1.0))
    np.testing.assert_allclose(tilt_std(found, 2), want, rtol=0.03)


@pytest.mark.parametrize("drift", [(0.0, 4e-3), (-3e-3, 3e-3)])
def test_a_tilt_that_comes_up_on_the_way_bends_the_weight(drift):
    """A gyro's bias that is another from the first drive on, by what its walk allows, tilts the
    estimate by 85 mrad: the weight is off upwards by 35 mm/s^2, of which the stop leaves no more in
    the bias than the filter says, so that the next stop does not contradict it.
    """
    drive = replace(DRIVE, side=6.0)
    own = white(calibrated())
    walk = {"rate_random_walk": {"K": np.full(3, 1e-3)}}
    part = replace(own, gyro=Sensor("gyro", dict(own.gyro.values) | walk))
    truth = declared(perfect(drive), drive)
    later = (truth.time > drive.first_rest)[:, None]
    settings = SETTINGS | {f"accel_bias_std0[{i}]": 0.01 for i in (1, 2, 3)}
    log = replace(truth, gyro=truth.gyro + later * [*drift, 0.0])
    found = run(log, part, method="filter", settings=settings)
    start, stop = found.stops[1]
    tilted = found.filter.vector("q", 4)[start - 1]
    assert 2 * np.hypot(*tilted[1:3]) > 0.08
    bias, std = (found.filter.vector(n)[stop - 2, 2] for n in ("accel_bias", "accel_bias_std"))
    assert abs(bias) < std
    assert found.first_zupts[1] < chi2.isf(1e-3, 3)


def stds_after(log, part, settings=None):
    """Standard deviations (n,) of the error state at the end of a log, by the filter of a part."""
    layout = Layout(part)
    block = ins_of_log(layout)
    at = {v.name: i for i, v in enumerate(block.inputs)}
    u = np.tile(block.start_inputs, (len(log.time), 1))
    u[:, :3], u[:, 3:6], u[:, at["stationary"]] = log.gyro, log.accel, log.stationary
    state = Run(
        block, len(u), p=with_values(block, settings or SETTINGS), sample_period=log.sample_period
    )
    state.advance(u)
    return np.sqrt(
        np.array(ca.evalf(ca.diag(layout.unpack(ca.DM(state.state)).covariance))).ravel()
    )


def test_a_tilt_that_was_there_at_the_rest_bends_no_weight_on_a_leg():
    """Upwards the resting force and the velocity are as well known at the end of a leg of 20 s
    whether the tilt was known to 0.1 rad before it or to 10 mrad."""
    drive = replace(DRIVE, side=6.0)
    truth = declared(perfect(drive), drive)
    (start, _), *_ = stop_times(drive)[1:]
    log = truth.slice(stop=int(np.searchsorted(truth.time, start)))
    found = [
        stds_after(log, white(calibrated()), {f"accel_bias_std0[{i}]": size for i in (1, 2, 3)})
        for size in (0.1, 1.0)
    ]
    for up in (UP, VELOCITY.stop - 1):
        assert found[1][up] == pytest.approx(found[0][up], rel=0.01)


@pytest.mark.parametrize("bias", (0.0, BIAS))
def test_legs_and_turns_on_a_level_floor_tell_nothing_of_the_accelerometers_gains(bias):
    """From rest to rest the velocity has come to nothing, and its gains' errors with it; on a level
    floor no turn changes the weight in the body, whatever the estimate of a tilted one makes of it.
    """
    wide = next(t for t in assumed().tolerances if t.key[:2] == ("accel", "scale_factor"))
    part = replace(white(calibrated()), tolerances=(wide,))
    log = noisy(declared(perfect(DRIVE), DRIVE), part, 1)
    log = replace(log, accel=log.accel + [bias, -bias, 0.0])
    level = stds_after(log, part)[BASE : BASE + 2]
    np.testing.assert_allclose(level, wide.std[:2], rtol=0.01)


def test_a_tilt_makes_a_climb_of_a_leg():
    """Of all of it, although the speed is less than its own error before the leg ends: a bias as
    large as its standard deviation is a climb as large as the position's."""
    found = navigated(bias=(-BIAS, 0.0, 0.0))
    row = found.stops[1][1] - 2
    track = found.filter.track("filter")
    assert abs(track.position[row, 2]) == pytest.approx(track.position_std[row, 2], rel=0.1)


@pytest.mark.parametrize("std", (0.01, 0.3, 1.0, 3.0))
def test_a_heading_that_is_off_makes_a_way_shorter(std):
    nodes, weights = np.polynomial.hermite_e.hermegauss(60)
    want = weights @ (1 - np.cos(std * nodes)) ** 2 / np.sqrt(2 * np.pi)
    assert float(bowed(std**2)) == pytest.approx(want, rel=1e-6)
