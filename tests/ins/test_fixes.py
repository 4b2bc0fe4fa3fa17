"""Measured positions and velocities of a log: what they do, and what is no position of it."""

from dataclasses import replace

import numpy as np
import pytest
from navigation_cases import SHORT, calibrated, declared, noisy, perfect, white
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.errors import UserError
from pyimu.ins import run
from pyimu.ins.measured import fixes_of
from pyimu.ins.report.page import page
from pyimu.rover.trajectory import Drive

DRIVE = replace(SHORT, vibration=0.0)
STD = 0.05


@pytest.fixture(scope="module")
def truth():
    return declared(perfect(DRIVE, 50.0), DRIVE)


@pytest.fixture(scope="module")
def log(truth):
    return noisy(truth, white(calibrated()), 3)


def fixed(log, every=50, seed=0, std=STD, **off):
    """The log with a position every second, in a frame whose origin is elsewhere."""
    rng, n = np.random.default_rng(seed), len(log.time)
    seen = np.arange(n) % every == 0
    columns = {}
    for axis, shift in (("east", 1e5), ("north", -3e4), ("up", 200.0)):
        true = getattr(log, f"ref_{axis}") + shift + std * rng.standard_normal(n)
        columns[f"position_{axis}"] = np.where(seen, true + off.get(axis, 0.0), np.nan)
    return replace(log, **columns, position_std=np.full(n, std))


DRAWN = {f"gyro_bias_std0[{i}]": 0.01 for i in (1, 2, 3)}
DRAWN |= {f"accel_bias_std0[{i}]": 0.1 for i in (1, 2, 3)} | {"zupt_std": 1e-4}


def drawn(truth, seed):
    """Noise, and biases of the sizes with which the filter starts."""
    log, rng = noisy(truth, white(calibrated()), seed), np.random.default_rng(100 + seed)
    gyro = log.gyro + rng.normal(scale=0.01, size=3)
    return replace(log, gyro=gyro, accel=log.accel + rng.normal(scale=0.1, size=3))


def within_bounds(parts):
    nis = np.concatenate(parts)
    nis = nis[nis > 0]
    low, high = chi2.ppf([0.0005, 0.9995], 3 * len(nis)) / len(nis)
    assert len(nis) > 150 and low < nis.mean() < high


def navigate(log, **how):
    return run(log, white(calibrated()), method="filter", **how)


def test_positions_hold_the_path_and_their_nis_is_right(log, truth):
    """Innovations of a right model are white, so that the sum of their normalised squares is
    chi-square distributed with three degrees each; 99.9 % of means are allowed."""
    parts = [navigate(fixed(drawn(truth, s), seed=s), settings=DRAWN) for s in range(6)]
    within_bounds([r.filter.scalar("position_nis") for r in parts])
    for r in parts:
        std = np.hypot(*r.filter.vector("position_std")[-1, :2])
        assert r.errors["filter"].end < 5 * std < 5 * 2 * STD
    assert navigate(log, zupt="off").errors["filter"].end > 10 * STD


ARM = np.array([0.8, -0.3, 0.5])
"""m; from the sensor to an antenna."""


def of_antenna(log, seed):
    """The log with positions and velocities of the antenna: p + R l, v + R (w x l)."""
    rng, n = np.random.default_rng(seed), len(log.time)
    turn = Rotation.from_quat(log.ref_q, scalar_first=True)
    arm, moves = turn.apply(ARM), turn.apply(np.cross(log.ref_rate, ARM))
    seen = np.arange(n) % 25 == 0
    columns = {}
    for i, axis in enumerate(("east", "north", "up")):
        place = getattr(log, f"ref_{axis}") + arm[:, i] + STD * rng.standard_normal(n)
        speed = log.ref_velocity[:, i] + moves[:, i] + STD * rng.standard_normal(n)
        columns[f"position_{axis}"] = np.where(seen, place, np.nan)
        columns[f"velocity_{axis}"] = np.where(seen, speed, np.nan)
    std = np.full(n, STD)
    return replace(log, **columns, position_std=std, velocity_std=std)


def test_an_antenna_beside_the_sensor_is_known_to_be(truth):
    """It turns about the sensor with 0.85 m and 45 deg/s, 13 times the noise of a position: with
    the arm the innovations are right and the path is the sensor's, without it they contradict."""
    settings = DRAWN | {"antenna": tuple(ARM)}
    logs = [of_antenna(drawn(truth, s), s) for s in range(3)]
    parts = [navigate(log, settings=settings) for log in logs]
    for name in ("position_nis", "velocity_nis"):
        within_bounds([r.filter.scalar(name) for r in parts])
    assert max(r.errors["filter"].most for r in parts) < 5 * STD
    # most of what is seen after the first turn contradicts: of short legs that is most of all
    short = replace(DRIVE, side=1.0)
    log = of_antenna(drawn(declared(perfect(short, 50.0), short), 0), 0)
    with pytest.raises(UserError, match="--antenna"):
        navigate(log, settings=DRAWN)


@pytest.mark.parametrize("seed", range(2))
def test_far_from_the_start_a_heading_that_is_put_right_moves_no_position(seed):
    """40 s on one course leave the yaw 1.3 deg off, which 600 m away and as a turn about the start
    is 16 cm of second order, five times the noise of a position. Of 296 fixes and as many smoothed
    positions, over their variances, a mean of two would be 8 standard deviations of chance where
    each told by itself, and over 4 where ten of them tell one."""
    far = Drive(legs=1, side=600.0, speed=15.0, first_rest=5.0, stops=0.0, turn_rate=0.3, ramp=4.0)
    part = white(calibrated())
    noise = 3 * part.gyro.values["angle_random_walk"]["N"]
    part = replace(part, gyro=part.gyro.with_values("angle_random_walk", N=noise))
    log = noisy(declared(perfect(far, 20.0), far), part, seed)
    log = fixed(log, every=4, std=0.03, seed=seed)
    found = run(log, part, heading0=0.0, settings={"top_speed": 30.0})
    rows = np.flatnonzero(np.isfinite(log.position_east))
    first = np.array([log.position_east[0] - 1e5, log.position_north[0] + 3e4])
    true = np.column_stack([log.ref_east, log.ref_north])[rows] - first
    for name in ("filter", "smoother"):
        track = found.tracks[name]
        off = (track.position[rows, :2] - true) / track.position_std[rows, :2]
        assert np.mean(off[1:] ** 2) < 2.0
    nis = found.filter.scalar("position_nis")
    assert np.mean(nis[nis > 0]) < chi2.isf(1e-4, 3 * 296) / 296


def late(log, age, seed=0):
    """The log with a position every half second that was true ``age`` s before, between samples."""
    rng, seen = np.random.default_rng(seed), np.arange(len(log.time)) % 25 == 0
    columns = {}
    for axis in ("east", "north", "up"):
        true = np.interp(log.time - age, log.time, getattr(log, f"ref_{axis}"))
        values = true + STD * rng.standard_normal(len(seen))
        columns[f"position_{axis}"] = np.where(seen, values, np.nan)
    return replace(log, **columns, position_std=np.full(len(seen), STD))


@pytest.mark.parametrize("by", ("column", "option"))
def test_positions_that_come_late_are_of_their_instant(truth, by):
    """At 0.3 m/s those of 0.73 s before are off by 0.22 m, four times their noise. By their age the
    innovations are right; what is new since the last of them is the inertial unit's."""
    age, parts, ends = 0.73, [], []
    for seed in range(4):
        log = late(drawn(truth, seed), age, seed)
        told = {"position_age": age} if by == "option" else {}
        aged = log if told else replace(log, position_age=np.full(len(log.time), age))
        parts.append(navigate(aged, settings=DRAWN, **told))
        ends.append(navigate(log, settings=DRAWN).errors["filter"].rms)
    within_bounds([r.filter.scalar("position_nis") for r in parts])
    assert np.mean([r.errors["filter"].rms for r in parts]) < 0.5 * np.mean(ends)


@pytest.mark.parametrize(
    ("age", "said"),
    (
        (-0.1, "position_age is -0.1 s, expected 0 or more"),
        (float("nan"), "position_age"),
        (700.0, "position_age is 700 s or more, by which each measured position is of before"),
    ),
)
def test_an_age_that_is_none_is_refused(log, age, said):
    with pytest.raises(UserError, match=said):
        navigate(fixed(log), position_age=age)


@pytest.mark.parametrize("name", ("position_std", "position_age", "velocity_std", "velocity_age"))
def test_what_is_told_of_measurements_that_are_not_there_is_refused(log, name):
    with pytest.raises(UserError, match=f"{name} was told, and there is no measured"):
        navigate(log, **{name: 0.5})


def test_positions_that_are_held_from_one_to_the_next_count_once(log):
    """As a table has them that was written at the sensor's rate."""
    sparse, names = fixed(log), [f"position_{axis}" for axis in ("east", "north", "up")]
    last = np.arange(len(log.time)) // 50 * 50
    held = replace(sparse, **{name: getattr(sparse, name)[last] for name in names})
    ours, theirs = fixes_of(held), fixes_of(sparse)
    np.testing.assert_array_equal(ours.rows, theirs.rows)
    np.testing.assert_array_equal(ours.position, theirs.position)
    for name, column in theirs.columns.items():
        np.testing.assert_array_equal(ours.columns[name], column)


def test_a_fix_without_height_leaves_the_height_alone(log):
    level = replace(fixed(log), position_up=None)
    found = navigate(level, zupt="off")
    std = found.filter.vector("position_std")
    assert std[-1, :2].max() < 2 * STD < std[-1, 2]


def test_a_jump_is_weighed_down_counted_and_said(log):
    jump = np.where((log.time > 14.5) & (log.time < 17.5), 8.0, 0.0)
    found = navigate(fixed(log, east=jump))
    (finding,) = [f for f in found.findings if f.kind == "position_fixes"]
    assert finding.count == 3
    assert "3 of them" in found.report() and "weighed down: a jump" in found.report()
    assert found.errors["filter"].most < 4.0


def test_positions_that_all_fit_are_no_finding_of_the_page(log):
    found = navigate(fixed(log))
    (finding,) = [f for f in found.findings if f.kind == "position_fixes"]
    assert finding.count == 0 and "correct the filter" in found.report()
    assert "position_fixes" not in page(found)


def test_positions_of_another_frame_are_refused(log):
    good = fixed(log)
    swapped = replace(
        good, position_east=-10 * good.position_north, position_north=good.position_up
    )
    with pytest.raises(UserError, match=r"of the measured position contradicts .* another frame"):
        navigate(swapped, heading0=0.0)


def test_a_course_gives_the_heading_where_nothing_else_does(log):
    """The frame is turned by a radian: the positions turn the path with it."""
    good, turn = fixed(log, every=10, std=0.01), 1.0
    east, north = good.position_east, good.position_north
    turned = replace(
        good,
        position_east=np.cos(turn) * east - np.sin(turn) * north,
        position_north=np.sin(turn) * east + np.cos(turn) * north,
        **{name: None for name in ("ref_q", "ref_heading")},
    )
    found = navigate(turned)
    assert "course" in found.heading_from
    yaw = found.filter.track("filter").yaw[-1] - np.pi  # two quarter turns
    std = found.filter.vector("attitude_std")[-1, 2]
    assert abs(yaw - turn) < 4 * std and std < 0.1


def test_velocities_hold_it_too(log, truth):
    rng, n = np.random.default_rng(1), len(truth.time)
    seen, parts = np.arange(n) % 25 == 0, []
    names = ("velocity_east", "velocity_north", "velocity_up")
    for seed in range(6):
        velocity = truth.ref_velocity + 0.02 * rng.normal(size=(n, 3))
        columns = np.where(seen[:, None], velocity, np.nan).T
        with_them = replace(drawn(truth, seed), **dict(zip(names, columns, strict=True)))
        parts.append(navigate(with_them, velocity_std=0.02, settings=DRAWN))
    within_bounds([r.filter.scalar("velocity_nis") for r in parts])
    alone = navigate(with_them, zupt="off", velocity_std=0.02).errors["filter"].end
    assert alone < 0.1 * navigate(log, zupt="off").errors["filter"].end
    assert navigate(with_them, zupt="off", fixes=False).fixes is None


@pytest.mark.parametrize(
    ("change", "said"),
    (
        ({"position_std": None}, r"position_std \[m\]' or --position-std"),
        ({"position_north": None}, "position_north is missing"),
        ({"position_std": 0.0}, "position_std is 0 m at 0 s, expected above 0"),
    ),
)
def test_what_is_no_position_ends_with_a_line(log, change, said):
    full = fixed(log)
    values = {k: v if v is None else np.full(len(log.time), v) for k, v in change.items()}
    with pytest.raises(UserError, match=said):
        navigate(replace(full, **values))


@pytest.mark.parametrize("std", (-1.0, 0.0, float("nan")))
def test_a_standard_deviation_of_an_option_is_above_zero(log, std):
    with pytest.raises(UserError, match="position_std"):
        navigate(fixed(log), position_std=std)


def test_positions_in_a_mirror_are_refused(log):
    """East and north swapped, where only some of the positions contradict."""
    east, north = fixed(log).position_east, fixed(log).position_north
    with pytest.raises(UserError, match="mirrored, .* swapped, or one has the other sign"):
        navigate(replace(fixed(log), position_east=north, position_north=east))


def test_positions_that_move_during_a_rest_say_that_it_is_none(log):
    """An even drive is a rest to gyro and accelerometer; the positions know better."""
    n = len(log.time)
    even = replace(
        log,
        gyro=np.repeat(log.gyro[:1], n, axis=0),
        accel=np.repeat(log.accel[:1], n, axis=0),
        stationary=np.ones(n),
    )
    moved = replace(fixed(even), position_east=fixed(even).position_east + 0.5 * log.time)
    with pytest.raises(UserError, match="during what was taken for rests.*--zupt off"):
        navigate(moved)


@pytest.mark.parametrize("seed", range(3))
def test_the_first_velocities_tell_the_heading(truth, seed):
    """Of a vehicle that begins 2 rad from east, by its velocities alone; 0.1 rad is what a course
    is good to."""
    log, rng = drawn(truth, seed), np.random.default_rng(seed)
    n, c, s = len(log.time), np.cos(2.0), np.sin(2.0)
    east, north = log.ref_velocity[:, :2].T
    noise = STD * rng.standard_normal((2, n))
    measured = {
        "velocity_east": c * east - s * north + noise[0],
        "velocity_north": s * east + c * north + noise[1],
        "velocity_std": np.full(n, STD),
    }
    bare = {"ref_q": None, "ref_east": None, "ref_north": None}
    found = navigate(replace(log, **measured, **bare), settings=DRAWN)
    assert found.heading_from == "the course of the first 2 m of measured velocities"
    assert abs(found.heading0 - 2.0) < 3 * 0.1
