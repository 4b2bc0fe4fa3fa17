"""Rest that the filter finds by itself, all through a run."""

import numpy as np
import pytest
from attitude_cases import (
    GRAVITY,
    N_ACCEL,
    H,
    N,
    attitude_after,
    drive,
    error,
    inputs,
    measured,
    output,
    parameters,
    part,
    rover_rate,
)
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.attitude import attitude_ukf, run
from pyimu.attitude.filter.sigma_point_filter import sigma_point_filter
from pyimu.attitude.rest import find_rest
from pyimu.recording.recording import Recording

OUTSIDE = 1e-4
"""Probability on either side of a band."""

STD0 = np.array([0.02, 0.02, 0.02, 0.01, 0.01, 0.01])
STOPS, GOES = 2000, 3500

QUIET = 1e-3
"""m/s/sqrt(s); of an accelerometer of 0.1 mg/sqrt(Hz)."""


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


def stop_and_go(extra=0.0) -> np.ndarray:
    """Rates (n, 3): 20 s of driving, 15 s of rest with ``extra`` (n, 3) or (3,), 15 s of driving
    once more.
    """
    rate = rover_rate(GOES + 1500)
    rate[STOPS:GOES] = extra
    return rate


def one(block, world, seed: int, std0=STD0, n_accel=N_ACCEL):
    """Outputs and true bias (n, 3) of a draw of noise, with the initial error of the covariance."""
    rng = np.random.default_rng(seed)
    first = std0 * rng.standard_normal(6)
    gyro, accel, bias = measured(world, rng, first[3:], n_accel)
    q0 = Rotation.from_rotvec(first[:3]).inv().as_quat(scalar_first=True)
    y, _ = block.run(
        inputs(len(gyro), gyro=gyro, accel=accel), p=parameters(block, q0=q0, std0=std0)
    )
    return y, bias


def test_a_stop_gives_the_bias_and_holds_the_heading(block):
    """Errors over claimed variances are chi-square but for what the sway, which is none here, is
    allowed: it makes the claims up to a third larger.
    """
    world, draws = drive(stop_and_go()), 30
    squares = {"bias": 0.0, "heading": 0.0}
    for seed in range(draws):
        y, bias = one(block, world, seed)
        off = (bias - output(block, y, "gyro_bias"))[GOES - 1]
        squares["bias"] += np.sum((off / output(block, y, "std")[GOES - 1, 3:]) ** 2)
        turn = world.attitude[-1].apply(error(output(block, y, "q")[-1:], world.attitude[-1:])[0])
        squares["heading"] += (turn[2] / output(block, y, "heading_std")[-1]) ** 2
        # Of a bias that is not known about the vertical a rest takes 2.5 s to show.
        assert output(block, y, "at_rest")[STOPS + 260 : GOES].all()
        assert not output(block, y, "at_rest")[:STOPS].any()
        assert not output(block, y, "at_rest")[GOES + 10 :].any()
    for what, degrees in (("bias", 3 * draws), ("heading", draws)):
        low, high = chi2.ppf([OUTSIDE, 1 - OUTSIDE], degrees)
        assert low * 2 / 3 < squares[what] < high, what
    std = output(block, y, "std")
    assert std[GOES - 1, 5] < 1.1 * np.hypot(N / np.sqrt(15), 2e-4 * np.sqrt(15 / 3))
    heading = output(block, y, "heading_std")
    assert heading[GOES - 1] < 1.01 * heading[STOPS + 200]


@pytest.mark.parametrize(
    "turn", [[0, 0, 0.02], [0, 0, -0.05], [0.02, 0, 0]], ids=["slow", "faster", "tilting"]
)
def test_a_steady_turn_is_no_rest_once_the_bias_is_known(block, turn):
    """A turn of 15 and more standard deviations of the bias that a first rest has shown."""
    rate = np.vstack([np.zeros((1500, 3)), stop_and_go(turn)])
    world = drive(rate)
    y, _ = one(block, world, 1)
    at_rest = output(block, y, "at_rest")
    assert at_rest[300:1500].all()
    assert not at_rest[1510:].any()


@pytest.mark.parametrize(
    "rate, off, n_accel",
    [(1.5, 20, N_ACCEL), (1.5, 50, N_ACCEL), (0.9, 7, QUIET), (1.5, 5, QUIET)],
)
def test_a_slow_turn_of_a_gyro_whose_bias_nobody_knows_is_no_rest(rate, off, n_accel):
    """Of ``rate`` deg/s, no more than 2.6 standard deviations of the bias, about an axis that is
    ``off`` deg from the vertical: gravity shows it in the time that a rest then takes. A tenth of a
    degree per second of tilt is eight standard deviations of a quiet accelerometer's mean.
    """
    block, off = attitude_ukf(part(n_accel=n_accel)), np.deg2rad(off)
    axis = np.deg2rad(rate) * np.array([np.sin(off), 0.0, np.cos(off)])
    world = drive(np.tile(axis, (1200, 1)))
    for seed in range(5):
        y, bias = one(block, world, seed, n_accel=n_accel)
        assert not output(block, y, "at_rest").any()
        assert (np.abs(output(block, y, "gyro_bias")[-1] - bias[-1]) < 0.04).all()


@pytest.mark.parametrize("k", [2e-6, 3e-5])
def test_a_drift_that_the_part_is_silent_of_is_no_turn_where_gravity_stands_still(k):
    """A bias that drifts by a sixth of a degree per second about a level axis, of a part whose walk
    is far less: the body stops, and gravity, which such a turn would move, does not move.
    """
    n_accel, drift = 2e-3, np.array([0.0, 3e-3, 0.0])
    block = attitude_ukf(part(3e-4, k, n_accel))
    world = drive(np.vstack([np.zeros((1500, 3)), stop_and_go()]))
    since = np.clip((H * np.arange(len(world.rate)) - 15.0) / 10.0, 0.0, 1.0)[:, None]
    stops, goes = 1500 + STOPS, 1500 + GOES
    for seed in range(3):
        rng = np.random.default_rng(seed)
        noise = rng.standard_normal((2, *world.rate.shape)) / np.sqrt(H)
        gyro = world.inertial + since * drift + 3e-4 * noise[0]
        accel = world.force + n_accel * noise[1]
        y, _ = block.run(inputs(len(gyro), gyro=gyro, accel=accel), p=parameters(block, std0=STD0))
        assert output(block, y, "at_rest")[stops + 800 : goes].all()
        off = error(output(block, y, "q"), world.attitude)[goes - 1, :2]
        std = output(block, y, "std")[goes - 1]
        assert np.sum((off / std[:2]) ** 2) < chi2.ppf(1 - OUTSIDE, 2)
        wrong = output(block, y, "gyro_bias")[goes - 1] - drift
        assert np.sum((wrong / std[3:]) ** 2) < chi2.ppf(1 - OUTSIDE, 3)


REST, GO, ROUNDS = 1000, 1500, 6
"""Samples of a rest and of a drive, and how often they follow each other."""


def warming(drift, seed: int):
    """Outputs, the drive and the true bias (n, 3) of a gyro of 1 deg/sqrt(h) whose bias goes away
    by ``drift`` (3,) rad/s in a minute or two, where its part knows a walk of 1e-6 alone.
    """
    block, n_accel = attitude_ukf(part(3e-4, 1e-6, 2e-3)), 2e-3
    rate = rover_rate(ROUNDS * (REST + GO) + REST)
    rate[np.arange(len(rate)) % (REST + GO) < REST] = 0
    world, rng = drive(rate), np.random.default_rng(seed)
    noise = rng.standard_normal((2, *rate.shape)) / np.sqrt(H)
    bias = (1 - np.exp(-H * np.arange(len(rate)) / 60.0))[:, None] * drift
    gyro = world.inertial + bias + 3e-4 * noise[0]
    u = inputs(len(gyro), gyro=gyro, accel=world.force + n_accel * noise[1])
    y, _ = block.run(u, p=parameters(block, std0=STD0))
    return block, y, world, bias


@pytest.mark.parametrize("drift", [[2e-3, -1e-3, 2e-3], [0.0, 0.0, -3e-3], [1e-4, 1e-4, 0.0]])
def test_the_walk_of_a_bias_is_learnt_from_the_rests(drift):
    """Each rest after the second is seen, though the bias left what the part knows long ago, and
    the bias that it shows is within what is claimed.
    """
    squares, ends, draws = 0.0, np.arange(2, ROUNDS + 1) * (REST + GO) + REST - 1, 5
    for seed in range(draws):
        block, y, _, bias = warming(np.array(drift), seed)
        for end in ends:
            assert output(block, y, "at_rest")[end - REST + 400 : end].all()
        off = (output(block, y, "gyro_bias") - bias)[ends] / output(block, y, "std")[ends, 3:]
        squares += np.sum(off**2)
    # Rests of which nothing new is learnt go into each other's bias: the errors of a draw may be
    # one error, and their mean square that of 3 axes.
    assert squares / len(ends) < chi2.ppf(1 - OUTSIDE, 3 * draws)


def test_of_a_bias_that_stays_the_rests_learn_no_walk():
    """The bias after seven rests is as well known as all of them together show it, or nearly: a
    rest of a thousand looks like a drift.
    """
    for seed in range(3):
        block, y, _, _ = warming(np.zeros(3), seed)
        std = output(block, y, "std")[-1, 3:]
        together = 3e-4 / np.sqrt(H * REST * (ROUNDS + 1))
        assert std.max() < 1.3 * together


def test_an_even_turn_that_leans_as_it_is_pushed_is_no_rest():
    """An aircraft that turns by 1.1 deg/s at 50 m/s: rate and force stand still in its axes, and
    by the force the turn is partly about a level axis.
    """
    rate, speed, n = 0.02, 50.0, 6000
    lean = np.arctan(rate * speed / GRAVITY) * np.clip(H * np.arange(n) / 5 - 4, 0, 1)
    yaw = H * np.cumsum(rate * (lean > 0))
    attitude = Rotation.from_euler("ZX", np.column_stack([yaw, -lean]))
    inward = Rotation.from_euler("Z", yaw[:, None]).apply([0.0, -1.0, 0.0])
    pushed = GRAVITY * np.tan(lean)[:, None] * inward
    force = attitude.apply(pushed + [0, 0, GRAVITY], inverse=True)
    turns = (attitude[:-1].inv() * attitude[1:]).as_rotvec() / H
    noise = np.random.default_rng(1).standard_normal((2, n, 3)) / np.sqrt(H)
    gyro = np.vstack([turns[:1], turns]) + 3e-4 * noise[0]
    block = attitude_ukf(part(3e-4, 2e-6, 2e-3))
    u = inputs(n, gyro=gyro, accel=force + 2e-3 * noise[1])
    y, _ = block.run(u, p=parameters(block, std0=STD0))
    assert output(block, y, "at_rest")[500:1900].all()
    assert not output(block, y, "at_rest")[2600:].any()


def test_a_body_that_is_held_still_may_sway(block):
    """A sway of 0.3 deg at half a hertz is no error of the heading: it is followed."""
    t = H * np.arange(GOES - STOPS)[:, None]
    sway = 2e-3 * np.sin(2 * np.pi * np.array([0.5, 0.7, 0.4]) * t)
    world = drive(stop_and_go(sway))
    y, _ = one(block, world, 3)
    resting = output(block, y, "at_rest") > 0
    off = np.linalg.norm(error(output(block, y, "q"), world.attitude), axis=1)[resting]
    whole = np.linalg.norm(output(block, y, "std")[resting, :3], axis=1)
    assert resting.sum() > 500
    assert np.all(off < 4 * whole)


def test_a_vehicle_at_even_speed_on_a_rough_road_is_not_at_rest(block):
    rng = np.random.default_rng(2)
    world = drive(np.zeros((3000, 3)))
    gyro, accel, _ = measured(world, rng, np.zeros(3))
    y, _ = block.run(
        inputs(3000, gyro=gyro, accel=accel + 0.5 * rng.standard_normal(accel.shape)),
        p=parameters(block, std0=STD0),
    )
    assert not output(block, y, "at_rest").any()


def test_both_forms_of_the_filter_find_the_same_rest(block):
    world, rng = drive(stop_and_go()), np.random.default_rng(4)
    gyro, accel, _ = measured(world, rng, np.array([0.01, -0.01, 0.005]))
    found = []
    for b in (block, sigma_point_filter(part())):
        y, _ = b.run(inputs(len(gyro), gyro=gyro, accel=accel), p=parameters(b, std0=STD0))
        found.append(y)
    np.testing.assert_array_equal(*(output(block, y, "at_rest") for y in found))
    # Their errors of attitude differ to second order of its standard deviation of 0.02 rad.
    np.testing.assert_allclose(*(output(block, y, "q") for y in found), rtol=0, atol=0.02**2)
    np.testing.assert_allclose(*(output(block, y, "std") for y in found), rtol=0.1**2)


def test_a_log_that_begins_with_a_slow_turn_has_no_rest_there():
    """No faster than a bias may be, but gravity turns with it."""
    rng = np.random.default_rng(5)
    for rate, rests in ((0.01, False), (0.0, True)):
        axis = np.array([0.6, -0.64, 0.48])
        world = drive(np.tile(rate * axis, (1500, 1)), Rotation.from_euler("x", 0.2))
        gyro, accel, _ = measured(world, rng, 0.01 * rng.standard_normal(3))
        recording = Recording.from_arrays(time=H * np.arange(1500), gyro=gyro, accel=accel)
        assert find_rest(recording).seen is rests


def test_a_rest_before_the_turn_begins_is_kept():
    """Eight seconds of rest, then a slow turn: what is found is within the eight."""
    rng = np.random.default_rng(6)
    rate = np.zeros((1500, 3))
    rate[800:] = [0.01, 0.0, 0.0]
    gyro, accel, _ = measured(drive(rate), rng, np.zeros(3))
    rest = find_rest(Recording.from_arrays(time=H * np.arange(1500), gyro=gyro, accel=accel))
    assert rest.seen and 3.0 < rest.duration < 8.5
    assert abs(np.linalg.norm(rest.force) - GRAVITY) < 0.01


PUSH, EVERY, DRIVEN = 0.5, 12, 72
"""m/s^2 of a push of 6 s, to and fro; s from one to the next; s of drive between two stops."""


def driven(turn: float, shakes: bool):
    """Outputs by name and times (n,) of a vehicle with ``EVERY`` pushes, which turns by ``turn``
    rad/s where nothing pushes it; it rests for 5 s before.
    """
    n = round((5 + DRIVEN + 10) / H)
    t = H * np.arange(n) - 5
    rng, drives = np.random.default_rng(8), (t > 0) & (t < DRIVEN)
    pushed = drives * (t % EVERY < EVERY / 2)
    along = PUSH * pushed * np.where(t % (2 * EVERY) < EVERY, 1, -1)
    rough = 0.3 * shakes * drives[:, None] * rng.standard_normal((n, 3))
    accel = np.column_stack([along, 0 * t, GRAVITY + 0 * t]) + rough
    accel += 1e-3 / np.sqrt(H) * rng.standard_normal((n, 3))
    rate = turn * (drives & ~pushed.astype(bool))[:, None] * [0, 0, 1]
    gyro = 0.002 + rate + 3e-4 / np.sqrt(H) * rng.standard_normal((n, 3))
    quiet = attitude_ukf(part(3e-4, 1e-5, 1e-3))
    y, _ = quiet.run(inputs(n, gyro=gyro, accel=accel), p=parameters(quiet, std0=STD0))
    yaw = output(quiet, y, "yaw") - H * np.cumsum(rate[:, 2])
    names = ("at_rest", "gyro_bias", "std", "heading_std", "status")
    tilt = np.hypot(output(quiet, y, "roll"), output(quiet, y, "pitch"))
    return {k: output(quiet, y, k) for k in names} | {"off": yaw, "tilt": tilt}, t, drives


@pytest.mark.parametrize("shakes", [False, True])
def test_a_stop_shows_only_after_a_drive_that_shook(shakes):
    """The pushes leave a velocity that nobody knows: on a smooth way the even drive between them is
    no rest, and nor is the stop. Where the drive shook, the stop is one, and the drive is none.
    What the first push is, a steady force after a rest, only its end shows.
    """
    found, t, drives = driven(0.0, shakes)
    rests = found["at_rest"] > 0
    assert rests[(t > -2.4) & (t < 0)].all()
    assert not rests[drives & (t > EVERY / 2 + 1)].any()
    assert rests[t > DRIVEN + 2].all() == rests[t > DRIVEN + 2].any() == shakes


def test_a_stop_after_pushes_gives_the_tilt():
    """Long pushes make the tilt unsure by degrees; where the body stands, gravity shows it again to
    the tenth of one."""
    found, t, _ = driven(0.0, shakes=True)
    whole = np.degrees(np.linalg.norm(found["std"][:, :2], axis=1))
    tilt = np.degrees(found["tilt"])
    assert whole[np.searchsorted(t, DRIVEN - 1.0)] > 0.5
    stands = t > DRIVEN + 6
    assert whole[stands].max() < 0.1
    assert (tilt[stands] < 3 * whole[stands]).all()


def test_a_slow_bend_is_turned_by_the_gyro_and_is_no_bias_of_it():
    """A turn of three standard deviations of the bias, on a smooth way at even speed. Nothing about
    the vertical is learnt of it; about the level axes the bias is.
    """
    turn = 6e-4
    found, t, drives = driven(turn, shakes=False)
    begins, ends = np.flatnonzero((t > EVERY / 2) & drives)[[0, -1]]
    assert np.all(np.abs(found["off"][drives]) < 4 * found["heading_std"][drives])
    assert np.abs(np.diff(found["gyro_bias"][[begins, ends], 2])) < turn / 10
    level, upright = found["std"][:, 3], found["std"][:, 5]
    assert level[ends] < 0.7 * level[begins] and upright[ends] > 0.95 * upright[begins]


def test_a_rest_makes_the_tilt_so_sure_that_a_push_after_it_is_none():
    """The body at rest had no velocity: half a m/s^2 for 6 s, which would be a tilt of 3 deg, and
    the even drive after it, are not taken for one. No more do they contradict the attitude.
    """
    found, t, _ = driven(0.0, shakes=False)
    whole = np.linalg.norm(found["std"][:, :2], axis=1)
    first = (t > 0) & (t < EVERY)
    assert np.degrees(whole[np.searchsorted(t, 0.0)]) < 0.1
    assert np.degrees(found["tilt"][first].max()) < 3.0 / 15
    assert (found["tilt"][first] < 3 * whole[first]).all()
    assert not (found["status"].astype(int)[t < EVERY / 2] & 8).any()


@pytest.mark.parametrize("factor", [0.3, 0.9, 1.0, 1.01, 1.15, 1.6, 3.0])
def test_a_force_at_rest_that_is_not_gravity_is_said(factor):
    """Where it is off by so much that no accelerometer at rest is, too."""
    rng = np.random.default_rng(2)
    world = attitude_after(rover_rate(3000, still=800))
    accel = factor * world.apply([0, 0, GRAVITY], inverse=True) + rng.normal(0, 0.02, (3000, 3))
    gyro = rover_rate(3000, still=800) + rng.normal(0, 1e-3, (3000, 3))
    result = run(Recording.from_arrays(time=H * np.arange(3000), gyro=gyro, accel=accel))
    found = [f.detail["magnitude"] for f in result.findings if f.kind == "gravity_off"]
    assert found == ([] if abs(factor - 1) < 0.02 else [pytest.approx(factor * GRAVITY, 0.01)])
    assert ("gravity at rest is" in result.report()) == bool(found)
    assert "in motion" not in result.report().splitlines()[0]
