"""The attitude filter over recordings: how it starts, gaps and missing columns, and what it
refuses.
"""

import sys
from dataclasses import replace

import numpy as np
import pytest
from attitude_cases import (
    EARTH,
    GRAVITY,
    Drive,
    H,
    N,
    drive,
    error,
    eventful_recording,
    inputs,
    measured,
    part,
    rover_rate,
)
from pyarrow import parquet
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.attitude import attitude_ukf, run
from pyimu.attitude.columns import NOMINAL_K
from pyimu.attitude.input_grid import InputGrid
from pyimu.errors import UserError
from pyimu.recording.recording import Recording

BIAS = np.array([0.01, -0.02, 0.015])


def recorded(world: Drive, seed: int = 0, **more) -> Recording:
    gyro, accel, _ = measured(world, np.random.default_rng(seed), BIAS)
    return Recording.from_arrays(time=H * np.arange(len(gyro)), gyro=gyro, accel=accel, **more)


def tilt_error(result, truth: Rotation) -> np.ndarray:
    """Angle (n,) between the estimated and the true vertical."""
    up = Rotation.from_quat(result.q, scalar_first=True).apply([0, 0, 1], inverse=True)
    return np.arccos(np.clip(np.sum(up * truth.apply([0, 0, 1], inverse=True), axis=1), -1, 1))


@pytest.mark.parametrize(
    "start",
    [[0.0, 0.0, 0.0], [0.0, 0.2, np.pi], [0.0, -1.4, 0.0]],
    ids=["level", "upside down", "nose up"],
)
def test_rest_levels_the_attitude_and_gives_the_bias(start):
    truth = Rotation.from_euler("ZYX", start)
    world = drive(rover_rate(3000, still=1500), truth)
    result = run(recorded(world), part())
    assert result.rest.seen and 9 < result.rest.duration < 15
    assert tilt_error(result, world.attitude).max() < 0.01
    # The mean of ten seconds, and what has walked since: four standard deviations.
    std = np.hypot(N / np.sqrt(10), 2e-4 * np.sqrt(10))
    np.testing.assert_allclose(result.gyro_bias[0], BIAS, atol=4 * std)
    np.testing.assert_allclose(np.linalg.norm(result.q, axis=1), 1, atol=1e-14)


def test_without_a_part_the_noise_at_rest_stands_for_it():
    world = drive(rover_rate(3000, still=1000))
    assert tilt_error(run(recorded(world)), world.attitude).max() < 0.01


def test_a_part_that_is_silent_of_its_gyros_wander_is_given_the_nominal_one():
    """Declared as zero it is zero: s_b^2 + K^2 t."""
    recording = recorded(drive(np.zeros((500, 3))))
    std0 = np.array([0.01, 0.01, 0.01, 1e-5, 1e-5, 1e-5])
    silent = part().with_sensor(part().gyro.without("rate_random_walk"))
    for known, k in ((silent, NOMINAL_K), (part(k=0), 0.0)):
        result = run(recording, known, std0=std0, settings={"rest_time": 0, "motion_bias": 0})
        np.testing.assert_allclose(result.std[-1, 5], np.hypot(1e-5, k * np.sqrt(5)), rtol=1e-2)


def test_earth_rate_is_not_taken_for_bias_at_a_known_latitude():
    world = drive(np.zeros((3000, 3)), latitude=0.9)
    recording = Recording.from_arrays(
        time=H * np.arange(3000), gyro=world.inertial, accel=world.force
    )
    np.testing.assert_allclose(
        run(recording, part(), latitude=0.9, heading0=0.0).gyro_bias, 0, atol=1e-4 * EARTH
    )
    unknown = run(recording, part()).gyro_bias
    np.testing.assert_allclose(
        unknown[-1], EARTH * np.array([0, np.cos(0.9), np.sin(0.9)]), atol=1e-6
    )


def test_yaw_starts_where_it_is_told_else_at_the_recorded_heading_else_at_zero():
    world = drive(np.zeros((500, 3)))
    heading = np.full(500, -3.1)
    runs = (
        run(recorded(world), part(), heading0=2.0),
        run(recorded(world, heading=heading), part()),
        run(recorded(world), part()),
    )
    np.testing.assert_allclose([r.euler[0, 2] for r in runs], [2.0, -3.1, 0.0], atol=1e-2)


def test_given_attitude_is_where_the_run_starts():
    q0 = Rotation.from_euler("ZYX", [1.0, 0.0, 0.0])
    result = run(recorded(drive(np.zeros((500, 3)), q0)), part(), q0=q0.as_quat(scalar_first=True))
    assert np.linalg.norm(error(result.q[:1], q0)) < 0.01


def test_given_bias_and_standard_deviations_are_where_the_run_starts():
    recording = recorded(drive(np.zeros((500, 3))))
    bias, std = np.array([1e-3, -2e-3, 3e-3]), np.array([0.3, 0.2, 0.1, 1e-6, 1e-6, 1e-6])
    result = run(recording, part(k=0), bias0=bias, std0=std)
    np.testing.assert_allclose(result.gyro_bias[0], bias, atol=1e-9)
    np.testing.assert_allclose(result.std[0, 3:], std[3:], rtol=1e-3)
    assert result.std[0, 0] <= 0.3 and result.std[0, 2] == pytest.approx(0.1, rel=1e-3)
    assert [result.parameters[f"std0[{i}]"] for i in range(1, 7)] == std.tolist()


def test_gap_widens_the_covariance_and_keeps_the_rows():
    world = drive(rover_rate(3000, still=1000))
    whole = recorded(world)
    keep = np.r_[0:1500, 1600:3000]
    cut = Recording.from_arrays(
        time=whole.time[keep], gyro=whole.gyro[keep], accel=whole.accel[keep]
    )
    result = run(cut, part())
    assert len(result.time) == len(result.q) == len(keep)
    assert result.std[1500, 2] > 0.9 and result.std[1499, 2] < 0.1
    assert tilt_error(result, world.attitude[keep])[-1] < 0.02


def with_gap(world: Drive, seconds: float, seed: int = 0, **more) -> Recording:
    """The recording with its second half ``seconds`` later."""
    whole = recorded(world, seed, **more)
    half = len(whole.time) // 2
    return replace(whole, time=whole.time + seconds * (np.arange(len(whole.time)) >= half))


@pytest.mark.parametrize("seconds", [0.02, 59.0, 7200.0])
def test_bias_walks_on_over_a_gap_of_any_length_and_its_end_is_marked(seconds):
    k, n = 1e-4, 2000
    result = run(with_gap(drive(np.zeros((n, 3))), seconds, stationary=np.ones(n)), part(k=k))
    before, after = result.std[n // 2 - 1, 3:] ** 2, result.std[n // 2, 3:] ** 2
    # The row after the gap tells a little of the bias, as a sample of white noise does.
    expected = before + k**2 * (seconds + H)
    np.testing.assert_allclose(after, 1 / (1 / expected + H / N**2), rtol=1e-3)
    np.testing.assert_array_equal(np.flatnonzero(result.status), [n // 2])


def test_times_that_are_rounded_have_no_gaps():
    """At 976 Hz and whole milliseconds a step is one of them or two."""
    time = np.round(np.arange(5000) * 1.0246e-3, 3)
    recording = Recording.from_arrays(
        time=time, gyro=np.zeros((5000, 3)), accel=np.tile([0, 0, GRAVITY], (5000, 1))
    )
    result = run(recording, "imt30", settings={"rest_time": 0})
    assert not result.status.any() and np.all(np.diff(result.std[:, 2]) >= 0)


def test_pieces_are_cut_at_long_gaps_alone():
    recording = with_gap(drive(np.zeros((100, 3))), 600.0)
    grid = InputGrid(recording, part(), [v.name for v in attitude_ukf(part()).inputs])
    pieces = [(len(piece.inputs), piece.rows, piece.left_out) for piece in grid.pieces()]
    missing = round(60 / H)  # the step over the gap is a sample longer than what it leaves out
    assert [size for size, _, _ in pieces] == [50 + missing - 1, 50]
    assert [rows for _, rows, _ in pieces] == [slice(0, 50), slice(50, 100)]
    assert [left_out for _, _, left_out in pieces] == pytest.approx([0.0, 600.0 + H - 60.0])


def test_pieces_of_a_long_recording_are_its_whole(monkeypatch):
    """A log is run in pieces; where these end, also between gaps, changes nothing."""
    recording = eventful_recording(3000)
    keep = np.r_[0:1000, 1100:2000, 2005:3000]
    cut = Recording.from_arrays(
        time=recording.time[keep], gyro=recording.gyro[keep], accel=recording.accel[keep]
    )
    whole = run(cut, part())
    for module in ("input_grid", "outputs"):
        monkeypatch.setattr(sys.modules[f"pyimu.attitude.{module}"], "CHUNK", 64)
    pieces = run(cut, part())
    for name in ("q", "gyro_bias", "std", "quasi_static", "nis", "status", "heading_std"):
        np.testing.assert_array_equal(getattr(pieces, name), getattr(whole, name))


def test_recording_without_accelerometer_is_integrated():
    world = drive(rover_rate(500))
    recording = Recording.from_arrays(time=H * np.arange(500), gyro=world.inertial)
    certain = {f"std0[{i}]": 0.0 for i in range(1, 7)}
    result = run(recording, part(0, 0), q0=np.array([1.0, 0, 0, 0]), settings=certain)
    assert np.abs(error(result.q, world.attitude)).max() < 1e-9
    np.testing.assert_array_equal(result.status, 0)
    assert not result.quasi_static.any()


def test_missing_cells_are_marked_and_survived():
    world = drive(rover_rate(2000, still=1000))
    recording = recorded(world)
    recording.gyro[1500:1503, 0] = np.nan
    recording.accel[1200:1300] = np.nan
    result = run(recording, part())
    assert np.isfinite(result.q).all() and np.sum(result.status & 1) == 103
    assert "103 samples" in result.report()


def test_run_is_the_block_on_the_recordings_columns():
    recording = recorded(drive(rover_rate(300)))
    block = attitude_ukf(part())
    result = run(
        recording,
        part(),
        settings={f"std0[{i}]": 0.02 for i in range(1, 7)} | {"bias0[1]": 0.0},
        q0=np.array([1.0, 0, 0, 0]),
    )
    p = block.start.copy()
    for i, v in enumerate(block.parameters):
        p[i] = 0.02 if v.name.startswith("std0") else p[i]
    assert not result.rest.seen
    y, _ = block.run(inputs(300, gyro=recording.gyro, accel=recording.accel), p=p)
    np.testing.assert_allclose(result.q, y[:, :4], atol=1e-12)


def test_what_cannot_be_used_is_refused_with_its_reason():
    recording = recorded(drive(np.zeros((200, 3))))
    with pytest.raises(UserError, match="latitude is 52.0 rad"):
        run(recording, part(), latitude=52.0)
    with pytest.raises(UserError, match="q0 is"):
        run(recording, part(), q0=np.zeros(4))
    with pytest.raises(UserError, match="bias0 is .* expected 3 finite numbers"):
        run(recording, part(), bias0=[0.1, np.nan, 0.0])
    with pytest.raises(UserError, match="std0 is .* expected 6 finite numbers"):
        run(recording, part(), std0=np.ones(3))
    with pytest.raises(UserError, match="unknown setting 'gravty'"):
        run(recording, part(), settings={"gravty": 9.8})
    for given, reason in (
        ({"q0": [np.inf, 0, 0, 0]}, "q0 is .* expected four finite numbers"),
        ({"q0": "level"}, "q0 is level"),
        ({"heading0": np.nan}, "heading0 is 'nan'"),
        ({"heading0": 0.1, "q0": [1, 0, 0, 0]}, "heading0 beside q0"),
        ({"latitude": "45"}, "latitude is '45'"),
        ({"latitude": np.nan}, "latitude is 'nan'"),
        ({"bias0": "none"}, "bias0 is none"),
        ({"std0": -np.ones(6)}, r"std0\[1\] is -1 rad, expected 0"),
        ({"settings": {"gravity": np.nan}}, "gravity is 'nan'"),
        ({"settings": {"accel_std": -1}}, "accel_std is -1 m/s"),
        ({"settings": {"accel_std": "a"}}, "accel_std is 'a'"),
    ):
        with pytest.raises(UserError, match=reason):
            run(recording, part(), **given)
    with pytest.raises(UserError, match="column latitude is 45.0 rad"):
        run(recorded(drive(np.zeros((200, 3))), latitude=np.full(200, 45.0)), part())
    with pytest.raises(UserError, match="one sample"):
        run(recording.slice(0, 1), part())
    with pytest.raises(UserError, match="imt31: no built-in part"):
        run(recording, "imt31")
    with pytest.raises(UserError, match="no gyro"):
        run(Recording.from_arrays(time=np.arange(5.0), accel=np.full((5, 3), GRAVITY)), part())


def test_written_result_has_a_column_for_each_number_with_its_unit(tmp_path):
    result = run(recorded(drive(rover_rate(300))), part())
    path = result.write(tmp_path / "new")
    assert path.name == "report.html"
    table = parquet.read_table(path.with_name("attitude.parquet"))
    for names, values in (
        ([f"q_{n} [1]" for n in "wxyz"], result.q),
        ([f"gyro_bias_{n} [rad/s]" for n in "xyz"], result.gyro_bias),
        ([f"std_{n} [rad{'/s' if n > 3 else ''}]" for n in range(1, 7)], result.std),
        (["time [s]", "quasi_static [1]"], np.column_stack([result.time, result.quasi_static])),
        (["nis [1]", "status [1]"], np.column_stack([result.nis, result.status])),
        (["heading_std [rad]"], result.heading_std[:, None]),
        (["at_rest [1]"], result.at_rest[:, None]),
    ):
        np.testing.assert_array_equal(np.column_stack([table[n] for n in names]), values)
    assert table.num_columns == 1 + 4 + 3 + 6 + 5
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="cannot write there"):
        result.write(tmp_path / "file")


def test_a_path_or_a_frame_is_taken_for_a_recording(tmp_path):
    import pandas as pd

    recording = recorded(drive(rover_rate(300)))
    path = recording.write(tmp_path / "log.csv")
    want = run(recording, part())
    for given in (path, str(path), pd.read_csv(path)):
        np.testing.assert_array_equal(run(given, part()).q, want.q)


def test_a_part_is_taken_by_its_name():
    recording = recorded(drive(np.zeros((200, 3))))
    np.testing.assert_array_equal(run(recording, "imt30").q, run(recording, pyimu.part("imt30")).q)


# What the samples say of the sensors


def test_without_a_part_samples_at_the_level_where_they_pile_up_are_at_a_limit():
    limit, t = 3.0, H * np.arange(6000)[:, None]
    world = drive(np.where(t < 31, 0, [4.0, 0.5, 0.5] * np.sin(3 * (t - 31))))
    recording = recorded(world)
    free = run(recording)
    recording.gyro[:, 0] = np.clip(recording.gyro[:, 0], -limit, limit)
    result = run(recording)
    beyond = np.abs(recording.gyro[:, 0]) >= limit
    assert not np.any(free.status & 2) and beyond.sum() > 500
    np.testing.assert_array_equal(result.status & 2 > 0, np.abs(recording.gyro[:, 0]) >= limit)


def test_stamps_that_come_late_are_no_gaps_and_change_nothing():
    """A fifth of a period of jitter makes one step in a hundred longer than 1.5 periods."""
    world = drive(rover_rate(6000, still=1500))
    recording = recorded(world)
    rng = np.random.default_rng(1)
    late = Recording.from_arrays(
        time=recording.time + 0.2 * H * rng.standard_normal(6000).clip(-2.4, 2.4),
        gyro=recording.gyro,
        accel=recording.accel,
    )
    assert np.sum(np.diff(late.time) > 1.5 * H) > 50
    result, right = run(late, part()), run(recording, part())
    assert not np.any(result.status & 1)
    # The period differs by what the jitter of the first and last stamp makes of it.
    np.testing.assert_allclose(result.q, right.q, atol=1e-3)


def test_a_gap_among_late_stamps_is_still_a_gap():
    recording = recorded(drive(np.zeros((3000, 3))))
    jitter = 0.2 * H * np.random.default_rng(1).standard_normal(3000).clip(-2.4, 2.4)
    rows = np.r_[:1500, 1800:3000]
    cut = Recording.from_arrays(
        time=(recording.time + jitter)[rows], gyro=recording.gyro[rows], accel=recording.accel[rows]
    )
    assert np.flatnonzero(run(cut, part()).status & 1).tolist() == [1500]


@pytest.mark.parametrize("gravity", [1.62, 3.71])
def test_rest_is_seen_on_the_moon_and_on_mars(gravity):
    truth = Rotation.from_euler("ZYX", [0.0, 0.2, -0.3])
    world = drive(rover_rate(3000, still=1500), truth)
    recording = recorded(replace(world, force=world.force * gravity / GRAVITY))
    result = run(recording, part(), settings={"gravity": gravity})
    assert result.rest.seen and result.rest.force is not None
    # The tilt of white noise over the rest, and the noise of a sample of less gravity.
    assert tilt_error(result, world.attitude).max() < 0.01 * GRAVITY / gravity


def test_headings_of_a_log_may_be_late():
    """With their ages the log gives what it gives with headings of the instant, to what half a
    second more of the gyro's noise makes; without, they contradict a body that turns.
    """
    world, late = drive(rover_rate(3000, still=300)), 50
    rng = np.random.default_rng(8)
    gyro, accel, _ = measured(world, rng, np.array([0.01, -0.01, 0.005]))
    yaw, rows = world.attitude.as_euler("ZYX")[:, 0], np.arange(3000) % 100 == 99
    heading = np.where(rows, np.roll(yaw, late) + 0.02 * rng.standard_normal(3000), np.nan)
    columns = {"heading": heading, "heading_std": np.where(rows, 0.02, np.nan)}
    off = []
    for age in (np.where(rows, late * H, np.nan), None):
        log = Recording.from_arrays(
            time=H * np.arange(3000), gyro=gyro, accel=accel, heading_age=age, **columns
        )
        result = run(log, part())
        left = result.euler[:, 2] - yaw
        off.append(np.sqrt(np.mean((left[600:] / result.heading_std[600:]) ** 2)))
    assert off[0] < 1.5 and off[1] > 3.0


def test_a_heading_from_the_future_is_an_error():
    log = recorded(drive(rover_rate(300)), heading=np.zeros(300), heading_age=np.full(300, -0.1))
    with pytest.raises(UserError, match=r"heading_age is -0\.1 s at 0 s, expected 0 or more"):
        run(log, part())


@pytest.mark.parametrize("share", [0.1, -0.1])
def test_a_sample_rate_that_wanders_is_integrated_by_the_stamps(share):
    """A fast turn one way while the period is long and back while it is short: by one period for
    the whole log the heading would be off by 2 rad.
    """
    n, k = 6000, np.arange(6000)
    wave = np.sin(2 * np.pi * k / 3000)
    time = np.cumsum(H * (1 + share * wave))
    period = np.diff(time, prepend=0.0)
    rate = np.zeros((n, 3))
    rate[:, 2] = wave
    yaw = np.cumsum(rate[:, 2] * period)
    jitter = H * np.random.default_rng(3).uniform(0, 0.3, n)
    even = np.cumsum(rate[:, 2] * period.mean())
    assert np.ptp(even - yaw) > 1.0
    log = Recording.from_arrays(
        time=time + jitter, gyro=rate, accel=np.tile([0.0, 0.0, GRAVITY], (n, 1))
    )
    off = run(log, part(), settings={"rest_time": 0}).euler[:, 2] - yaw
    off = (off - off[0] + np.pi) % (2 * np.pi) - np.pi
    # The mean of stamps is late by that of the jitter, 0.15 of a period, and within a quarter of a
    # second the period is one number.
    assert np.abs(off).max() < 2 * H


def test_stamps_that_are_late_one_by_one_do_not_wander():
    n, rng = 3000, np.random.default_rng(4)
    gyro = 0.5 * rng.standard_normal((n, 3))
    even = H * np.arange(n)
    want, found = (
        run(
            Recording.from_arrays(time=t, gyro=gyro, accel=np.tile([0, 0, GRAVITY], (n, 1))), part()
        )
        for t in (even, even + H * rng.uniform(0, 0.4, n) * (np.arange(n) % (n - 1) > 0))
    )
    np.testing.assert_allclose(found.q, want.q, atol=1e-9)
