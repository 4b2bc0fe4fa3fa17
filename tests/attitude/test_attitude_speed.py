"""A vehicle whose speed is measured: pushes and turns do not tilt its attitude."""

from dataclasses import replace
from itertools import pairwise

import casadi as ca
import numpy as np
import pytest
from attitude_cases import (
    GRAVITY,
    Drive,
    H,
    error,
    inputs,
    measured,
    output,
    parameters,
    part,
)
from scipy.spatial.transform import Rotation
from scipy.stats import chi2
from turns import turned

from pyimu.attitude import attitude_ukf, run
from pyimu.attitude.columns import NOMINAL_AXES_STD
from pyimu.attitude.contradicted import believed
from pyimu.attitude.driven import speed_findings, speed_share
from pyimu.attitude.filter.passed import Passed
from pyimu.attitude.filter.sigma_point_filter import sigma_point_filter
from pyimu.attitude.filter.ukf import recorded_ukf
from pyimu.attitude.rest import find_rest
from pyimu.model.part_file import parse_part
from pyimu.recording.recording import Recording

STD0 = np.array([0.02, 0.02, 0.02, 0.005, 0.005, 0.005])
SPEED_STD, ROWS = 0.05, 6000
EVERY = 10
"""Samples from one speed to the next."""


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


def vehicle(rows: int = ROWS) -> tuple[Drive, np.ndarray]:
    """A drive on a ramp of 0.1 rad and back: pushes of 0.8 m/s^2 for 5 s, turns of 0.3 rad/s at 3
    to 9 m/s, and the speed (n,) after each row.
    """
    t = H * np.arange(1, rows + 1)
    along = 0.8 * np.sin(2 * np.pi * t / 20)
    speed = 3.0 + np.cumsum(along) * H
    rate = np.zeros((rows, 3))
    rate[:, 2] = 0.3 * np.sin(2 * np.pi * t / 33)
    rate[:, 1] = 0.1 * 2 * np.pi / 25 * np.sin(2 * np.pi * t / 25)
    attitude = turned(Rotation.from_rotvec(rate * H))[1:]
    # f = v' + w x v + R^T g, with v the mean speed of the period along x.
    forward = np.column_stack([speed - along * H / 2, 0 * t, 0 * t])
    force = np.column_stack([along, 0 * t, 0 * t]) + np.cross(rate, forward)
    force += attitude.apply([0, 0, GRAVITY], inverse=True)
    return Drive(rate, attitude, force, rate), speed


def numbers(expression: ca.SX) -> np.ndarray:
    return np.array(ca.evalf(ca.densify(expression)))


def filtered(block, world: Drive, speed, seed: int, told=True, until=ROWS, every=EVERY, **settings):
    """Outputs, final state and the true bias of a draw, with an initial error of ``STD0``."""
    rng = np.random.default_rng(seed)
    first = STD0 * rng.standard_normal(6)
    gyro, accel, bias = measured(world, rng, first[3:])
    q0 = Rotation.from_rotvec(first[:3]).inv().as_quat(scalar_first=True)
    n = len(gyro)
    seen = speed + SPEED_STD * rng.standard_normal(n)
    valid = (np.arange(n) % every == 0) & told & (np.arange(n) < until)
    u = inputs(
        n, gyro=gyro, accel=accel, speed=seen, speed_variance=SPEED_STD**2, speed_valid=valid
    )
    known = {"q0": q0, "std0": STD0, "slip_std": 0.0, "speed_tolerance": 0.0}
    y, state = block.run(u, p=parameters(block, **(known | settings)))
    return y, state, bias


@pytest.mark.long
def test_pushes_and_turns_do_not_tilt_a_vehicle_whose_speed_is_known(block):
    """The squared error of the tilt over the claimed variance is chi-square: what accelerates a
    body of known speed is in its force, and nothing is allowed for beside that.
    """
    world, speed = vehicle()
    draws, at, squares = 20, np.array([1500, 3000, 4500, 5999]), []
    up = world.attitude.apply([0, 0, 1], inverse=True)
    for seed in range(draws):
        y, _, bias = filtered(block, world, speed, seed)
        off = error(output(block, y, "q"), world.attitude)[at]
        level = off - np.sum(off * up[at], axis=1)[:, None] * up[at]
        std = output(block, y, "std")[at]
        whole = np.sum(std[:, :3] ** 2, axis=1) - output(block, y, "heading_std")[at] ** 2
        squares.append(np.sum(level**2, axis=1) / (whole / 2))
        shown = np.degrees(np.sqrt(np.mean(np.sum(level**2, axis=1))))
        assert shown < 0.5
    total = np.sum(squares, axis=0)
    assert np.all(total < chi2.ppf(1 - 1e-4 / len(at), 2 * draws))
    assert np.all(total > chi2.ppf(1e-4 / len(at), 2 * draws))
    without, _, _ = filtered(block, world, speed, 0, told=False)
    lost = error(output(block, without, "q"), world.attitude)[1000:]
    assert np.degrees(np.sqrt(np.mean(np.sum(lost[:, :2] ** 2, axis=1)))) > 1.5


def test_after_the_last_speed_the_body_is_one_that_stays_in_its_place(block):
    """Its tilt is then less sure than with speeds, and hardly a contradiction is seen."""
    world, speed = vehicle()
    y, state, _ = filtered(block, world, speed, 3, until=3000)
    whole = filtered(block, world, speed, 3)[0]
    np.testing.assert_array_equal(y[:3000], whole[:3000])
    status = output(block, y, "status")[3000:]
    assert np.mean(status.astype(int) & 8 > 0) < 0.05
    assert np.all(output(block, y, "std")[-1, :2] > output(block, whole, "std")[-1, :2])
    assert np.isfinite(state).all()


def test_the_forces_of_a_drive_raise_no_doubt_of_the_size_of_gravity(block):
    """In turns the force is larger than gravity by 0.4 m/s^2 for more than ten seconds."""
    world, speed = vehicle()
    y, _, _ = filtered(block, world, speed, 0)
    assert np.mean(np.linalg.norm(world.force, axis=1) > GRAVITY + 0.25) > 0.2
    assert not (output(block, y, "status").astype(int) & 512 > 0).any()


def test_both_forms_of_the_filter_take_a_speed_alike(block):
    world, speed = vehicle(3000)
    one, two = (filtered(b, world, speed, 1)[0] for b in (block, sigma_point_filter(part())))
    np.testing.assert_allclose(output(block, one, "q"), output(block, two, "q"), atol=2e-4)
    np.testing.assert_allclose(output(block, one, "std"), output(block, two, "std"), rtol=1e-2)


def log(world: Drive, speed: np.ndarray, sign: float = 1.0) -> Recording:
    rng = np.random.default_rng(5)
    gyro, accel, _ = measured(world, rng, np.zeros(3))
    seen = np.where(np.arange(len(speed)) % EVERY == 0, sign * speed, np.nan)
    return Recording.from_arrays(time=H * np.arange(len(speed)), gyro=gyro, accel=accel, speed=seen)


def test_a_log_with_speeds_is_run_with_them():
    world, speed = vehicle()
    result = run(log(world, speed), part())
    found = Rotation.from_quat(result.q, scalar_first=True)
    ups = [q.apply([0, 0, 1], inverse=True)[1000:] for q in (found, world.attitude)]
    off = np.linalg.norm(ups[0] - ups[1], axis=1)
    assert np.degrees(np.sqrt(np.mean(off**2))) < 0.5
    assert not [f for f in result.findings if f.kind.startswith("speed")]


def test_a_speed_of_the_wrong_sign_is_said_and_not_used():
    world, speed = vehicle()
    wrong, right = log(world, speed, -1.0), log(world, speed)
    result = run(wrong, part())
    assert "the speed has the wrong sign" in result.report()
    plain = run(Recording.from_arrays(time=right.time, gyro=right.gyro, accel=right.accel), part())
    np.testing.assert_array_equal(result.q, plain.q)


def level(seed: int, n: int = 9000) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A car on level ground: the speed (n,), gyro and accel (n, 3). It leans in turns and squats
    where it speeds up, by which it feels a tenth more.
    """
    rng, t = np.random.default_rng(seed), H * np.arange(n)
    tone = rng.uniform(0.02, 0.06, 2)
    speed = 8 + 4 * np.sin(2 * np.pi * tone[0] * t)
    rate = 0.2 * np.sin(2 * np.pi * tone[1] * t) * (t % 60 > 20)
    gyro = np.column_stack([0 * t, 0 * t, rate]) + rng.normal(0, 2e-3, (n, 3)) + [0.01, 0, -0.01]
    accel = 1.1 * np.column_stack([np.gradient(speed, H), rate * speed, 0 * t])
    return speed, gyro, accel + [0.1, -0.1, GRAVITY] + rng.normal(0, 0.3, (n, 3))


IN_UNITS = {"m/s": 1, "km/h": 3.6, "kn": 1.94384, "mph": 2.23694, "cm/s": 100, "mm/s": 1000}


@pytest.mark.parametrize("noise", [0.0, 0.1, 1.0])
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("unit", IN_UNITS)
def test_a_speed_in_another_unit_is_named(unit, seed, noise):
    """Noise makes the slope of the forces flat, as a factor does, and is not taken for one."""
    speed, gyro, accel = level(seed)
    speed = speed + noise * np.random.default_rng(seed).normal(size=len(speed))
    seen = speed * IN_UNITS[unit]
    found = speed_findings(
        Recording.from_arrays(time=H * np.arange(len(speed)), gyro=gyro, accel=accel, speed=seen)
    )
    if unit == "m/s":
        assert found == ()
    elif noise < 1.0:
        assert found[0].kind == "speed_unit" and unit in found[0].detail["as"]
        assert found[0].detail["factor"] == pytest.approx(IN_UNITS[unit], rel=0.25)


def test_a_speed_in_another_unit_is_said_and_not_used():
    speed, gyro, accel = level(0, 4000)
    time = H * np.arange(4000)
    right = Recording.from_arrays(time=time, gyro=gyro, accel=accel)
    wrong = replace(right, speed=3.6 * speed)
    assert "times too large, and it was not used: numbers in km/h" in run(wrong, part()).report()
    assert believed(wrong).speed is None and believed(replace(right, speed=speed)).speed is not None


def mounted(degrees: float, seed: int = 0) -> Recording:
    """The car whose sensor is turned to the left, so that it drives to the right of x."""
    speed, gyro, accel = level(seed, 6000)
    turn = Rotation.from_euler("z", degrees, degrees=True)
    gyro, accel = (turn.apply(v, inverse=True) for v in (gyro, accel))
    return Recording.from_arrays(time=H * np.arange(6000), gyro=gyro, accel=accel, speed=speed)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("degrees", [0, 20, -45, 90, -110])
def test_a_body_that_drives_along_another_axis_than_x_is_named(degrees, seed):
    """By the forces of turns and pushes."""
    found = speed_findings(mounted(degrees, seed))
    if not degrees:
        assert found == ()
        return
    assert [f.kind for f in found] == ["speed_axis"]
    angle, std = (found[0].detail[k] for k in ("angle", "std"))
    # Mean forces of a second miss a changing push by some percent, beside the noise.
    assert angle == pytest.approx(np.radians(-degrees), abs=5 * std + 0.05)


def test_a_speed_along_another_axis_is_said_and_not_used():
    askew = mounted(90)
    result = run(askew, part())
    assert "the body drives 90 deg to the right of its x axis" in result.report()
    assert believed(askew).speed is None


@pytest.mark.parametrize("factor", [0.95, 1.1, 1.25])
def test_how_far_a_speed_is_off_is_read_off_the_forces(factor):
    """The car feels a tenth more by leaning, which is the speed's share as well."""
    speed, gyro, accel = level(0)
    car = Recording.from_arrays(
        time=H * np.arange(len(speed)), gyro=gyro, accel=accel, speed=factor * speed
    )
    assert speed_share(car) == pytest.approx(abs(1.1 / factor - 1), abs=0.01)


def test_a_car_that_drives_evenly_is_not_at_rest_if_its_speed_is_known(block):
    """Straight on, without a bump, it looks as if at rest."""
    zero, force = np.zeros((1500, 3)), np.tile([0.0, 0.0, GRAVITY], (1500, 1))
    world = Drive(zero, Rotation.identity(1500), force, zero)
    for told in (True, False):
        y, _, _ = filtered(block, world, np.full(1500, 8.0), 1, told=told)
        assert output(block, y, "at_rest")[300:].any() == (not told)


def test_a_log_that_begins_with_an_even_drive_has_no_rest_there():
    """Nothing but the speed tells it from one: 8 m/s, or the 0.05 m/s by which it is off."""
    n = 1500
    zero, force = np.zeros((n, 3)), np.tile([0.0, 0.0, GRAVITY], (n, 1))
    world = Drive(zero, Rotation.identity(n), force, zero)
    for speed, rests in ((8.0, False), (0.0, True)):
        assert find_rest(log(world, np.full(n, speed))).seen is rests
        found = run(log(world, np.full(n, speed)), part())
        assert (found.std[-1, 5] < STD0[5] / 2) == rests


@pytest.mark.parametrize("bad", [np.nan, -1.0, np.inf])
def test_a_speed_without_a_usable_variance_is_none(block, bad):
    u = inputs(400, speed=5.0, speed_variance=bad, speed_valid=1)
    none = inputs(400)
    p = parameters(block, std0=STD0)
    np.testing.assert_array_equal(block.run(u, p=p)[0], block.run(none, p=p)[0])


def test_turns_at_a_known_speed_show_the_bias_about_the_vertical(block):
    """A turn of a body at the speed v has the force w v across, so that an error of its rate shows
    where v changes, and with it the heading is known better than by the gyro's first bias: heading
    and bias are as far off as is claimed, by chi-square.
    """
    world, speed = vehicle()
    draws, squares = 20, []
    for seed in range(100, 100 + draws):
        y, _, bias = filtered(block, world, speed, seed)
        heading, std = output(block, y, "heading_std")[-1], output(block, y, "std")[-1]
        assert heading < STD0[5] * H * ROWS / 2 and std[5] < STD0[5] / 2
        turned = error(output(block, y, "q")[-1:], world.attitude[-1:])[0]
        off = output(block, y, "gyro_bias")[-1] - bias[-1]
        squares.append([turned[2] ** 2 / heading**2, off[2] ** 2 / std[5] ** 2])
    total = np.sum(squares, axis=0)
    assert np.all(total < chi2.ppf(1 - 1e-4, draws)) and np.all(total > chi2.ppf(1e-4, draws))


@pytest.mark.parametrize("share", [-0.03, 0.03])
def test_a_speed_that_is_off_by_a_share_does_not_turn_the_heading(block, share):
    """Wheels of another size: the share of the turns' force that speed and rate do not explain is
    no bias of the gyro. Heading and bias are as sure as they are right, by four standard
    deviations at every second; with a speed that is taken for exact the heading is not.
    """
    world, speed = vehicle()
    given = block, world, (1 + share) * speed, 7
    assert beyond(*given, speed_tolerance=abs(share)) < 4 < beyond(*given)


def beyond(block, world: Drive, speed, seed: int, **settings) -> float:
    """By how many standard deviations heading or bias are off at most, of every second."""
    y, _, bias = filtered(block, world, speed, seed, **settings)
    turned = error(output(block, y, "q"), world.attitude)[::100]
    up = world.attitude.apply([0, 0, 1], inverse=True)[::100]
    off = np.sum(turned * up, axis=1) / output(block, y, "heading_std")[::100]
    biased = (output(block, y, "gyro_bias") - bias)[::100] / output(block, y, "std")[::100, 3:]
    return float(max(np.abs(off).max(), np.abs(biased).max()))


def askew(world: Drive, force=(0.0, 0.0), axis=(0.0, 0.0)) -> Drive:
    """The drive with a bias ``force`` (2,) m/s^2 of the accelerometer, along and across, and a gyro
    that leans by ``axis`` (2,) rad.
    """
    inertial = world.inertial + np.cross(world.inertial, [*axis, 0])
    return replace(world, force=world.force + [*force, 0], inertial=inertial)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("off", [{"force": (-0.1, 0.1)}, {"axis": (0.01, -0.01)}], ids=str)
def test_what_turns_with_a_driven_body_is_no_bias_of_its_gyro(block, off, seed):
    """A bias of the accelerometer and axes that are off show from one turn to the next, and a
    bias of the gyro would explain them as well. Told of them the filter is as sure as it is right.
    """
    world, speed = vehicle()
    given = block, askew(world, **off), speed, seed
    assert beyond(*given, slip_std=0.1, axes_std=0.01) < 4 < beyond(*given, slip_std=0.1)


@pytest.mark.parametrize("seed", range(2))
def test_a_slip_upwards_that_lasts_is_no_bias_of_the_gyro(block, seed):
    """A car moves on its springs for seconds, with a speed at each sample."""
    world, speed = vehicle()
    phase, zero = 2 * np.pi * H * np.arange(1, ROWS + 1) / 7, np.zeros(ROWS)
    upwards = np.column_stack([zero, zero, 0.15 * np.sin(phase)])
    change = np.column_stack([zero, zero, 0.15 * 2 * np.pi / 7 * np.cos(phase)])
    sways = replace(world, force=world.force + change + np.cross(world.rate, upwards))
    assert beyond(block, sways, speed, seed, every=1, slip_std=0.1, axes_std=0.02) < 4


def test_without_errors_that_turn_along_the_turns_show_the_bias_better(block):
    """What the filter is told of them costs it: it does not take what it may not know."""
    world, speed = vehicle(3000)
    exact, told = (
        output(block, filtered(block, world, speed, 1, axes_std=v)[0], "heading_std")[-1]
        for v in (0.0, 0.02)
    )
    assert exact < told


PART = """name = "measured"
sample_rate = {value = 100.0, unit = "Hz"}
[gyro.angle_random_walk]
N = {value = 1e-4, unit = "rad/sqrt(s)", source = "a log at rest"}
"""
ALLOWED = """[tolerance.accel.turn_on_bias]
b0 = {value = 30.0, unit = "mg", distribution = "normal", source = "a data sheet"}
[tolerance.gyro.misalignment]
m = {value = 0.04, unit = "rad", distribution = "normal", source = "a data sheet"}
"""


def test_sensors_are_as_askew_as_their_part_says_or_as_unknown_ones():
    """A part that was measured at rest says nothing of it; one of a program has no such error."""
    world, speed = vehicle(1000)
    recording = log(world, speed)
    parts = None, parse_part(PART, "part.toml"), part(), parse_part(PART + ALLOWED, "part.toml")
    found = [run(recording, p).parameters["axes_std"] for p in parts]
    assert found == pytest.approx([NOMINAL_AXES_STD, NOMINAL_AXES_STD, 0, 0.05])


def test_what_accelerates_a_body_of_known_speed_is_in_its_force():
    """Only the accelerometer's noise adds to the errors of its velocity, no acceleration beside."""
    world, speed = vehicle(500)
    noise = []
    for accel_std in (0.01, 0.5):
        rows = filtered(recorded_ukf(part()), world, speed, 2, accel_std=accel_std)[0]
        recorded = [Passed.unpack(ca.SX(ca.DM(row))) for row in rows[50::50]]
        noise.append([numbers(row.transition.velocity) for row in recorded])
    np.testing.assert_array_equal(*noise)


def test_the_errors_of_a_driven_body_change_as_a_smoother_is_told():
    """The covariance that the filter predicts is that of T (F x + w) with the recorded transition,
    of x after the sample before; with speeds, and where they begin and end.
    """
    world, speed = vehicle(1500)
    rows = filtered(recorded_ukf(part()), world, speed, 2, until=1000)[0]
    driven = 0
    for before, now in pairwise(rows[950:1150]):
        was, row = (Passed.unpack(ca.SX(ca.DM(v))) for v in (before, now))
        to, whole = row.transition, numbers(was.after.covariance)
        f, t = (np.linalg.inv(numbers(m(ca.SX.eye(9)))) for m in (to.undone, to.untilted))
        made = t @ (f @ whole @ f.T + numbers(to.noise)) @ t.T
        predicted = numbers(row.predicted.covariance)
        std = np.sqrt(np.diag(predicted))
        np.testing.assert_allclose((made - predicted) / np.outer(std, std), 0, atol=1e-9)
        driven += bool(np.linalg.norm(numbers(to.carried)) > 1)
    # The last speed is that of row 990; a second later the body drives no more.
    assert driven == 990 + 100 - 950
