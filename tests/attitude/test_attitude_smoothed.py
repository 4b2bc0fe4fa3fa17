"""The smoothed attitude: the least squares of the whole log, with honest standard deviations."""

import json
import sys

import numpy as np
import pytest
from attitude_cases import (
    GRAVITY,
    WHITE,
    H,
    drive,
    error,
    eventful_recording,
    measured,
    parameters,
    part,
    rover_rate,
)
from consistency import KINDS, MATCHED, Bands, outside, simulate_smoothed, smoothed_states
from pyarrow import parquet
from scipy.linalg import block_diag

from pyimu import Recording, attitude
from pyimu.attitude.filter.passed import PACKED
from pyimu.attitude.filter.smoother import before_a_gap
from pyimu.attitude.filter.ukf import recorded_ukf
from pyimu.attitude.filter.variables import LEAST_ACCEL_STD, LEAST_HEADING_STD

ROUNDING = 1 + 1e-9
"""By which a variance of equal information may differ from itself."""

STILL = np.array([0.01, 0.5, 2, 5, 8, 10])
"""s; instants of drives of 10 s."""


# Against the least squares of all samples


SMALL = 1e-4
"""rad; size of all errors of the linear case: what is of the second order is smaller by as much."""


def still_body(n: int):
    """Errors and measurements of a level body at rest for ``n`` samples, all linear.

    Gyro and tilt (n, 3), heading (n,) with NaN where there is none, all in units of ``SMALL``.
    """
    rng = np.random.default_rng(5)
    gyro = rng.standard_normal((n, 3)) + [1.0, -2.0, 0.5]
    tilt, heading = rng.standard_normal((n, 2)), rng.standard_normal(n)
    heading[np.arange(n) % 20 != 7] = np.nan
    return gyro, tilt, heading


def least_squares(gyro, tilt, heading, n, k, std0, accel_std, heading_std):
    """Mean and std (n, 6) of angles (3) and bias (3), by one Gaussian of all samples.

    ``angle' = angle + h (gyro - bias)`` with the noise of ``n`` and ``k`` over each period
    (Farrenkopf 1978), started with ``std0`` (6,) about zero; two tilts with ``accel_std``, some
    headings.
    """
    size, h = len(gyro), H
    noise = np.block(
        [
            [(n**2 * h + k**2 * h**3 / 3) * np.eye(3), -(k**2) * h**2 / 2 * np.eye(3)],
            [-(k**2) * h**2 / 2 * np.eye(3), k**2 * h * np.eye(3)],
        ]
    )
    turn = np.eye(6)
    turn[:3, 3:] = -h * np.eye(3)
    weight, first = np.linalg.inv(noise), np.linalg.inv(np.diag(np.square(std0)))
    # The unknowns begin before the first sample.
    information, right = np.zeros((6 * (size + 1),) * 2), np.zeros(6 * (size + 1))
    information[:6, :6] = first
    change = np.hstack([-turn, np.eye(6)])
    for i in range(size):
        at = slice(6 * i, 6 * i + 12)
        information[at, at] += change.T @ weight @ change
        right[at] += change.T @ weight @ np.append(h * gyro[i], np.zeros(3))
        told = 6 * (i + 1)
        for axis, value, std in [
            (0, tilt[i, 0], accel_std),
            (1, tilt[i, 1], accel_std),
            *[(2, heading[i], heading_std)] * int(np.isfinite(heading[i])),
        ]:
            information[told + axis, told + axis] += 1 / std**2
            right[told + axis] += value / std**2
    covariance = np.linalg.inv(information)
    mean, std = covariance @ right, np.sqrt(np.diag(covariance))
    return mean.reshape(-1, 6)[1:], std.reshape(-1, 6)[1:]


def test_still_body_gets_the_least_squares_of_all_samples():
    """Where the model is linear the smoother is the batch solution (Sarkka 2013, section 8.2)."""
    size = 150
    gyro, tilt, heading = (SMALL * v for v in still_body(size))
    n, k, n_accel = SMALL * 0.3, SMALL * 2.0, SMALL * GRAVITY * 0.1
    std0 = SMALL * np.array([3.0, 3.0, 4.0, 5.0, 5.0, 5.0])
    heading_std = SMALL * 0.7
    block = recorded_ukf(part(n, k, n_accel))
    u = np.zeros((size, len(block.inputs)))
    u[:, :3], u[:, 5], u[:, 6] = gyro, GRAVITY, 25.0
    # A level body that is rolled and pitched by small angles, roll about x and pitch about y.
    u[:, 3:5] = GRAVITY * np.column_stack([-tilt[:, 1], tilt[:, 0]])
    told = np.isfinite(heading)
    u[told, 7], u[told, 8], u[told, 9] = heading[told], heading_std**2, 1
    rows, _ = block.run(u, p=parameters(block, std0=std0, **WHITE))
    states = np.array([s for _, s in smoothed_states(rows, np.arange(1, size + 1))])[::-1]
    accel_std = np.sqrt(n_accel**2 / H + LEAST_ACCEL_STD**2) / GRAVITY
    hold = np.hypot(heading_std, LEAST_HEADING_STD)
    mean, std = least_squares(gyro, tilt, heading, n, k, std0, accel_std, hold)
    found = np.hstack([2 * states[:, 1:4], states[:, 4:7]])
    own = np.sqrt(states[:, [7 + i for i in (0, 6, 11, 15, 18, 20)]])
    # To second order of the angles, which reach some SMALL, over standard deviations of as much.
    assert np.abs((found - mean) / std).max() < 10 * SMALL
    np.testing.assert_allclose(own, std, rtol=10 * SMALL)


def test_gap_is_one_more_step_of_the_walk():
    """x' = x + w of the bias: P^s = P + C (P'^s - P') C^T with C = P P'^-1."""
    rng = np.random.default_rng(2)
    root = rng.standard_normal((9, 9))
    before, walk = root @ root.T + np.eye(9), np.array([3.0, 2.0, 5.0])
    noise = block_diag(np.zeros((3, 3)), np.diag(walk), np.zeros((3, 3)))
    after = before + noise
    known = 0.3 * after
    mean = rng.standard_normal(9)
    packed = np.zeros(PACKED)
    packed[0], packed[7:28] = 1, after[:6, :6][np.triu_indices(6)]
    packed[31:49], packed[49:55] = after[:6, 6:].T.ravel(), after[6:, 6:][np.triu_indices(3)]
    belief = np.concatenate([mean, np.zeros(27), known[np.triu_indices(9)]])
    got = np.array(before_a_gap()(belief, packed, walk)).ravel()
    gain = before @ np.linalg.inv(after)
    want = before + gain @ (known - after) @ gain.T
    np.testing.assert_allclose(got[:9], gain @ mean, atol=1e-12)
    np.testing.assert_allclose(got[36:], want[np.triu_indices(9)], atol=1e-10)


# Consistency


@pytest.mark.long
@pytest.mark.parametrize("scenario", MATCHED, ids=lambda s: s.name)
def test_normalised_errors_are_chi_square(scenario):
    """Of 24 drives with a simulator of its own, all instants by all samples."""
    sums = simulate_smoothed(scenario, 24, STILL)
    assert outside(sums, Bands(len(MATCHED) * len(STILL) * len(KINDS))) == []
    assert sums.norm < 1e-12 and sums.least_eigenvalue > 0


def eventful(**more):
    """A log with shocks, pushes, rests, headings, a loss of the gyro and one of the force."""
    log = eventful_recording(6000)
    gyro, accel, time = log.gyro.copy(), log.accel.copy(), log.time.copy()
    gyro[2500:2600, 1], accel[4000:4300] = np.nan, np.nan
    time[3200:] += 3.0
    time[5200:] += 200.0
    columns = {n: getattr(log, n) for n in ("heading", "heading_std", "stationary")}
    return Recording.from_arrays(time=time, gyro=gyro, accel=accel, **columns, **more)


def test_nothing_is_less_sure_than_in_the_filter_and_the_last_row_is_the_filters():
    log = eventful()
    one, two = (attitude.run(log, part(), smooth=smooth) for smooth in (False, True))
    for name in ("tilt_std", "heading_std"):
        assert np.all(getattr(two, name) <= getattr(one, name) * ROUNDING)
    assert np.all(two.std[:, 3:] <= one.std[:, 3:] * ROUNDING)
    assert np.median(two.tilt_std / one.tilt_std) < 0.9
    for name in ("q", "gyro_bias", "std", "heading_std"):
        np.testing.assert_allclose(
            getattr(two, name)[-1], getattr(one, name)[-1], rtol=1e-12, atol=1e-15
        )
    for name in ("nis", "status", "quasi_static"):
        np.testing.assert_array_equal(getattr(two, name), getattr(one, name))


def wandering():
    """A log whose sample rate wanders by a tenth."""
    log = eventful_recording(6000)
    columns = {n: getattr(log, n) for n in ("gyro", "accel", "heading", "heading_std")}
    time = np.cumsum(H * (1 + 0.1 * np.sin(np.arange(6000) / 300)))
    return Recording.from_arrays(time=time, **columns)


@pytest.mark.parametrize("size", [100, pytest.param(997, marks=pytest.mark.long)])
@pytest.mark.parametrize("made", [eventful, wandering])
def test_segments_change_nothing(monkeypatch, made, size):
    log = made()
    whole = attitude.run(log, part(), smooth=True)
    np.testing.assert_array_equal(whole.nis, attitude.run(log, part()).nis)
    monkeypatch.setattr(sys.modules["pyimu.attitude.smoothing"], "SEGMENT", size)
    cut = attitude.run(log, part(), smooth=True)
    for name in ("q", "gyro_bias", "std", "heading_std", "nis", "status"):
        np.testing.assert_array_equal(getattr(cut, name), getattr(whole, name))


# What the rows that follow tell


def test_bias_and_attitude_of_a_start_in_motion_are_known_by_what_follows():
    """A gyro bias of a degree per second that no rest shows: the filter needs a minute for it."""
    world = drive(rover_rate(9000))
    bias = np.radians([1.0, -1.0, 0.5])
    gyro, accel, walk = measured(world, np.random.default_rng(3), bias)
    log = Recording.from_arrays(time=H * np.arange(9000), gyro=gyro, accel=accel)
    settings = WHITE
    one, two = (attitude.run(log, part(), settings=settings, smooth=s) for s in (False, True))
    early = slice(100, 1000)
    for found in (one, two):
        off = (found.gyro_bias - walk)[early] / found.std[early, 3:]
        # Errors of neighbouring samples are one: the largest of three is that of a few draws.
        assert np.abs(off).max() < 5
    rms = [np.sqrt(np.mean((f.gyro_bias - walk)[early] ** 2)) for f in (one, two)]
    assert rms[1] < 0.5 * rms[0]
    off = np.abs(error(two.q, world.attitude)[early] / two.std[early, :3])
    assert off.max() < 5


def test_turn_that_no_gyro_saw_is_not_carried_into_the_time_before_it():
    """Half a radian within a sample: gravity contradicts, and the filter gives way.

    Of that error no more than the filter took for its own before it was contradicted.
    """
    n, jump = 4000, 2000
    rate = rover_rate(n)
    seen = drive(rate.copy())
    rate[jump] += [0.5 / H, 0, 0]
    world = drive(rate)
    gyro, accel, _ = measured(world, np.random.default_rng(4), np.zeros(3))
    gyro[jump] = measured(seen, np.random.default_rng(4), np.zeros(3))[0][jump]
    log = Recording.from_arrays(time=H * np.arange(n), gyro=gyro, accel=accel)
    q0 = world.attitude[0].as_quat(scalar_first=True)
    found = attitude.run(log, part(), q0=q0, smooth=True)
    assert (found.status[jump : jump + 100] & 8).any()
    up = world.attitude.inv().apply([0, 0, 1])
    tilt = np.linalg.norm(np.cross(error(found.q, world.attitude), up), axis=1)
    # Two normal numbers are longer than five standard deviations once in 270,000 draws.
    assert np.max((tilt / found.tilt_std)[:jump]) < 5


def test_attitude_whose_turns_no_gyro_saw_stays_that_of_the_filter():
    """An axis is lost for half a minute: what follows a turn of any size tells nothing of before.

    Taken for linear, it makes the tilt forty times as wrong.
    """
    n = 6000
    world = drive(4 * rover_rate(n))
    gyro, accel, _ = measured(world, np.random.default_rng(3), np.zeros(3))
    gyro[2000:5000, 0] = np.nan
    log = Recording.from_arrays(time=H * np.arange(n), gyro=gyro, accel=accel)
    up, rms = world.attitude.inv().apply([0, 0, 1]), []
    for smooth in (False, True):
        found = attitude.run(log, part(), smooth=smooth)
        tilt = np.cross(error(found.q, world.attitude), up)[2100:4999]
        rms.append(np.sqrt(np.mean(tilt**2)))
    # The bias is still told; of the tilt that is little.
    assert rms[1] < 1.1 * rms[0]


@pytest.mark.parametrize(
    "given",
    [
        {"latitude": 0.7},
        {"q0": [1.0, 0.01, 0.0, 0.0]},
        {"heading0": 0.3},
        {"bias0": [0.01, 0, 0], "std0": [0.1, 0.1, 0.1, 0.01, 0.01, 0.01]},
        {"settings": {"motion_time": 0.5}},
        {"part": "imt30"},
        {"part": part(clock_skew={"eps": 1e-4})},
        {},
    ],
    ids=lambda given: "-".join(given) or "nothing",
)
def test_it_goes_with_every_other_argument(given):
    log = eventful_recording(3000)
    one, two = (attitude.run(log, **given, smooth=s) for s in (False, True))
    assert two.smoothed and not one.smoothed
    assert one.parameters == two.parameters
    np.testing.assert_allclose(np.linalg.norm(two.q, axis=1), 1, atol=1e-12)
    assert np.all(two.tilt_std <= one.tilt_std * ROUNDING)
    assert np.median(two.tilt_std / one.tilt_std) < 0.95


# Words


def test_result_page_and_plot_say_that_it_is_smoothed(pyimu, tmp_path):
    path = eventful_recording(3000).write(tmp_path / "log.csv")
    code, out, err = pyimu("attitude", path, "--smooth", "--out", "out")
    assert code == 0 and err == ""
    assert "; smoothed" in out and "smoothed by all of the log" in out
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert data["smoothed"] is True
    page = (tmp_path / "out" / "report.html").read_text()
    assert "Smoothed attitude" in page and "before it was smoothed" in page
    table = parquet.read_table(tmp_path / "out" / "attitude.parquet")
    found = attitude.run(path, smooth=True)
    np.testing.assert_allclose(table["std_1 [rad]"], found.std[:, 0], rtol=1e-9)
    assert "smoothed" in [t.get_text() for t in found.plot().legends[0].get_texts()]
    plain = attitude.run(path)
    assert "smoothed" not in plain.report() and plain.as_dict()["smoothed"] is False
