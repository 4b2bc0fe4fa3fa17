"""Logs that are wrong in one way: each ends with a line or says what it is."""

from dataclasses import replace

import numpy as np
import pytest
from navigation_cases import SHORT, assumed, declared, noisy, perfect, white

import pyimu
from pyimu import Recording
from pyimu.errors import UserError
from pyimu.ins import run
from pyimu.ins.checks import CONSTRAINT, JUMP, check_columns, constraint
from pyimu.ins.filtered import COLUMN
from pyimu.rover.trajectory import motion


@pytest.fixture(scope="module")
def log():
    return assumed().specimen(4).simulate(motion(SHORT, 50.0), seed=4)


def said(log, **how):
    return run(log, assumed(), method="filter", **how).report()


def changed(log, name, rows, value):
    values = np.array(getattr(log, name), dtype=float)
    values[rows] = value
    return replace(log, **{name: values})


@pytest.mark.parametrize(
    ("factor", "hint"),
    (
        (1 / 9.80665, "write accel_x \\[g\\]"),
        (102.0, "write accel_x \\[cm/s\\^2\\]"),
        (50.0, "magnitude of .* expected about 9.8: in which unit"),
        (0.0, "magnitude of .* expected about 9.8: in which unit"),
    ),
)
def test_a_force_that_is_no_gravity_is_refused(log, factor, hint):
    with pytest.raises(UserError, match=hint):
        said(replace(log, accel=factor * log.accel))


def running(hz=100.0, seconds=30.0):
    """What a perfect sensor on a runner's foot shows: a place that swings by 0.35 m along and 0.1 m
    up, at 1.4 and 2.8 Hz, while the foot pitches by 1 rad. The median force is 2.4 times gravity.
    """
    t = np.arange(0.0, seconds, 1 / hz)
    a, b = 2 * np.pi * 1.4 * t, 2 * np.pi * 2.8 * t
    pitch, rate = np.sin(a + 1), 2 * np.pi * 1.4 * np.cos(a + 1)
    push = np.stack([0 * t, 0.1 * (2 * np.pi * 2.8) ** 2 * np.sin(b), 0 * t + 9.80665])
    push[0] = 0.35 * (2 * np.pi * 1.4) ** 2 * np.sin(a)
    push[2] += push[1]
    x, z = np.cos(pitch) * push[0] - np.sin(pitch) * push[2], np.zeros(len(t))
    up = np.sin(pitch) * push[0] + np.cos(pitch) * push[2]
    return Recording.from_arrays(
        time=t, gyro=np.stack([z, rate, z], axis=1), accel=np.stack([x, z, up], axis=1)
    )


def test_a_runner_is_told_from_another_unit_by_the_mean_force():
    """In axes that do not turn what is left of the force over seconds is gravity."""
    own = running()
    assert np.median(np.linalg.norm(own.accel, axis=1)) > 2 * 9.80665
    check_columns(own)
    for factor, hint in ((1 / 9.80665, "g"), (9.80665, "m/s\\^2")):
        with pytest.raises(UserError, match=f"write accel_x \\[{hint}\\]"):
            check_columns(replace(own, accel=factor * own.accel))


def test_another_place_has_another_gravity(log):
    with pytest.raises(UserError, match="expected about 1.6"):
        said(log, settings={"gravity": 1.62})


def test_an_axis_without_numbers_is_named(log):
    with pytest.raises(UserError, match="gyro_y has no number in any row"):
        said(changed(log, "gyro", (slice(None), 1), np.nan))


def test_a_body_on_its_side_is_said(log):
    lying = replace(log, accel=log.accel[:, [2, 0, 1]], gyro=log.gyro[:, [2, 0, 1]])
    assert "Gravity is on x at rest" in said(lying)
    assert "Gravity is on" not in said(log)


def test_samples_that_no_motion_makes_are_left_out(log):
    """Two of 1000 g would be 200 m/s each."""
    text = run(changed(log, "accel", [500, 900], 1e4), assumed(), method="filter")
    assert "2 samples of accel that no motion makes were left out, the first at 10 s" in (
        text.report()
    )
    assert text.errors["filter"].most < 2.0
    infinite = run(changed(log, "gyro", [500], np.inf), assumed(), method="filter")
    assert infinite.filter.scalar("status")[500] == 1


def test_outliers_of_both_sensors_are_said(log):
    accel, gyro = log.accel.copy(), log.gyro.copy()
    accel[300], gyro[500], gyro[700] = (900.0, 0, 0), (0, 0, 90.0), (0, -90.0, 0)
    text = said(replace(log, accel=accel, gyro=gyro))
    assert "1 sample of accel that no motion makes was left out, the first at 6 s" in text
    assert "2 samples of gyro that no motion makes were left out, the first at 10 s" in text


def test_a_gap_is_said_with_its_time_and_the_position_is_wider_by_the_top_speed(log):
    kept = (log.time < 15.0) | (log.time > 18.0)
    cut = replace(log, time=log.time[kept], **{k: v[kept] for k, v in log.groups.items()})
    found = run(cut, assumed(), method="filter", settings={"top_speed": 5.0})
    assert "No samples for up to 3.04 s (from 14.98 s; 1 gap)" in found.report()
    assert "a robot of at most 5 m/s" in found.report()
    last, first = (
        found.filter.vector("position_std")[np.sum(cut.time < 15.0) + i] for i in (-1, 0)
    )
    assert np.all(first - last > 0.9 * 5.0 * 3.0) and np.all(first - last < 1.1 * 5.0 * 3.04)


def test_what_a_reference_goes_in_a_gap_is_no_jump(log):
    """The truth drives on through 3 s without samples; a jump of that size between two is one."""
    kept = (log.time < 6.0) | (log.time > 11.0)
    cut = replace(log, time=log.time[kept], **{k: v[kept] for k, v in log.groups.items()})
    far = np.hypot(*[np.ptp(getattr(log, n)[~kept]) for n in ("ref_east", "ref_north")])
    assert far > JUMP
    assert "reference jumps" not in said(cut)
    assert "jumps by 1" in said(replace(log, ref_east=log.ref_east + far * (log.time > 20)))


def test_rests_that_a_log_declares_and_that_are_none_are_said(log):
    still = np.zeros(len(log.time))
    assert "The column stationary declares no rest in this log" in said(
        replace(log, stationary=still)
    )
    still[log.time < 5.0] = 1.0
    still[(log.time > 8.0) & (log.time < 8.3)] = 1.0
    text = said(replace(log, stationary=still))
    assert "weighed down (" in text and "the first at 8.02 s). The column stationary may" in text


def test_where_what_is_declared_a_rest_is_none_nothing_is_to_be_relied_on(log):
    drives = 1.0 - declared(log, SHORT).stationary
    text = said(replace(log, stationary=drives))
    assert "Most of what was taken for rest contradicts the estimate: it is none" in text
    assert "contradicts the estimate: it is none" not in said(log)


def test_standard_deviations_that_the_ends_of_the_drives_refute_are_widened():
    """Of a sensor that is noisier than its part says, by how much it is; beside measured positions,
    of which the ends tell nothing, it is said alone."""
    part, drive = white(assumed()), replace(SHORT, legs=4)
    told = declared(perfect(drive), drive)
    quiet, loud = (noisy(told, scaled(part, share), seed=3) for share in (1.0, 4.0))
    found, same = (run(log, part, method="filter") for log in (loud, quiet))
    assert found.too_sure > 1.5 and same.too_sure == 1.0
    for result in (found, same):
        std = result.too_sure * result.filter.vector("position_std")
        np.testing.assert_array_equal(result.tracks["filter"].position_std, std)
    said_so = (
        "times as large as the noise makes them: at the end of the drives the velocity was off"
    )
    assert said_so in found.report() and said_so not in same.report()
    places = {f"position_{n}": getattr(told, f"ref_{n}") for n in ("east", "north", "up")}
    fixed = run(replace(loud, **places), part, method="filter", position_std=20.0)
    assert "The standard deviations are too small" in fixed.report()
    np.testing.assert_array_equal(
        fixed.tracks["filter"].position_std, fixed.filter.vector("position_std")
    )


def scaled(part, share):
    """The part with ``share`` times the white noise."""
    white_of = {}
    for kind in ("gyro", "accel"):
        density = part.sensor(kind).values["angle_random_walk"]["N"]
        white_of[kind] = part.sensor(kind).with_values("angle_random_walk", N=share * density)
    return replace(part, **white_of)


def test_a_drive_at_constant_speed_is_said_and_is_no_rest():
    """Without vibration nothing tells the two apart but the speed that came before."""
    drive = replace(SHORT, legs=1, side=6.0, vibration=0.0)
    found = run(assumed().specimen(4).simulate(motion(drive, 50.0), seed=4), assumed())
    assert "driven at a constant speed, 1 time, the longest at 5" in found.report()
    speed = np.linalg.norm(found.recording.ref_velocity, axis=1)
    assert speed[found.still].max() < 0.05
    std = found.filter.vector("position_std")[-1, :2]
    assert found.errors["filter"].end < 4 * np.hypot(*std)


def test_a_log_that_begins_at_a_constant_speed_is_told_by_the_rests_after_it():
    """No inertial sensor tells it from a rest by itself. The bias there is that of these rests."""
    drive = replace(SHORT, legs=1, side=6.0, vibration=0.0)
    log = assumed().specimen(4).simulate(motion(drive, 50.0), seed=4)
    found = run(log.slice(int(np.searchsorted(log.time, 10.0))), assumed(), method="filter")
    speed = np.linalg.norm(found.recording.ref_velocity, axis=1)
    assert found.still.any() and speed[found.still].max() < 0.05
    assert "the gyro's bias there is that of a later rest" in found.report()


def test_rests_that_are_rests_do_not_move(log):
    """The reference's own noise and a slow wander of a receiver are no way."""
    rng, n = np.random.default_rng(7), len(log.time)
    wander = 0.01 * np.sqrt(0.02) * np.cumsum(rng.standard_normal((n, 2)), axis=0)
    east = log.ref_east + wander[:, 0] + 0.05 * rng.standard_normal(n)
    north = log.ref_north + wander[:, 1] + 0.05 * rng.standard_normal(n)
    assert "reference moves" not in said(replace(log, ref_east=east, ref_north=north))


@pytest.mark.parametrize("factor", (100.0, 1 / 0.3048, 1e-3))
def test_a_reference_in_another_unit_is_said_with_its_factor(log, factor):
    other = {name: factor * getattr(log, name) for name in ("ref_east", "ref_north")}
    found = run(replace(log, **other), assumed(), method="filter")
    detail = next(f.detail for f in found.findings if f.kind == "reference_scale")
    assert detail["factor"] == pytest.approx(factor, rel=0.1)
    assert "times as large as the estimate's and of its shape" in found.report()
    assert "times as large" not in said(log)


@pytest.mark.parametrize("backwards", (False, True))
def test_a_vehicle_that_does_not_drive_along_x_is_said(backwards):
    """What is mounted backwards drives along x all the same: there the constraint holds."""
    log = assumed().specimen(4).simulate(motion(replace(SHORT, vibration=0.1), 50.0), seed=4)

    def turned(v):
        return v * (-1, -1, 1) if backwards else v[:, [1, 0, 2]] * (1, -1, 1)

    found = run(
        replace(log, accel=turned(log.accel), gyro=turned(log.gyro), ref_q=None),
        assumed(),
        method="filter",
        nhc=True,
    )
    said = [f.detail for f in found.findings if f.kind == "constraint"]
    assert bool(said) != backwards
    if said:
        assert abs(np.degrees(said[0]["along"]) + 90) < 20
        assert "[frame]" in found.report() and "deg to the right of x" in found.report()


def test_a_drive_along_x_that_contradicts_its_constraint_is_not_said_to_be_askew(log):
    """As where the attitude was lost: the share is said, and no other axis."""
    found = run(log, assumed(), method="filter")
    y = found.filter.y.copy()
    y[:, COLUMN["nhc_nis"]], y[:, COLUMN["status"]] = 100.0, CONSTRAINT
    (said,) = constraint(replace(found.filter, y=y), found.still, found.filter)
    assert said.detail["share"] == 1.0 and np.isnan(said.detail["along"])


@pytest.mark.parametrize("value", (2.0, -1.0))
def test_a_mark_that_is_no_mark_is_refused(log, tmp_path, value):
    still = np.zeros(len(log.time))
    still[100] = value
    path = replace(log, stationary=still).write(tmp_path / "log.csv")
    with pytest.raises(UserError, match=f"stationary is {value:g} at 2 s, expected 0 or 1"):
        pyimu.read_recording(path)
    with pytest.raises(UserError, match="expected 0 or 1"):
        pyimu.Recording.from_arrays(time=log.time, stationary=still)


def test_the_heading_is_that_of_the_first_reference_turned_back(log):
    late = np.array(log.ref_q)
    late[log.time < 20.0] = np.nan
    found = run(replace(log, ref_q=late), assumed(), method="filter")
    assert found.heading_from == "the log's ref_q at 20 s"
    own = run(log, assumed(), method="filter")
    std = own.filter.vector("attitude_std")[np.searchsorted(log.time, 20.0), 2]
    assert abs(found.heading0 - own.heading0) < 5 * std


@pytest.mark.parametrize("seed", range(3))
def test_of_a_slow_log_no_drive_is_a_rest_by_two_samples(seed):
    """At 5 Hz a window of 0.3 s has two samples, which are alike by chance at an even speed."""
    drive = replace(SHORT, vibration=0.1, stops=3.0)
    log = assumed().specimen(seed).simulate(motion(drive, 5.0), seed=seed)
    assert len(run(log, assumed(), method="filter").later_stops) == 4


def test_a_steady_turn_is_said_with_its_time():
    drive = replace(SHORT, legs=1, turn=6 * np.pi, vibration=0.0)
    text = said(assumed().specimen(4).simulate(motion(drive, 50.0), seed=4))
    assert "The sensor turned steadily, 1 time, the longest at 1" in text


def test_a_reference_that_jumps_is_said(log):
    text = said(replace(log, ref_east=log.ref_east + 100 * (log.time > 20)))
    assert "jumps by 100 m at 20" in text and "reference's own" in text


def test_a_reference_that_jumps_while_the_body_rests_does_not_move_there(log):
    """Both ways, in the middle of two rests; a rest that is declared in motion moves."""
    away = (log.time > 2.0) & (log.time < 31.0)
    text = said(replace(log, ref_east=log.ref_east + 30 * away))
    assert "jumps by 30.0 m at 2" in text and "reference moves" not in text
    still = ((log.time < 4) | ((log.time > 6) & (log.time < 9))).astype(float)
    assert "these are none, whatever the column stationary says" in said(
        replace(log, stationary=still)
    )


@pytest.mark.parametrize(("mirrored", "turn"), ((False, 2.0), (True, 0.0)))
def test_a_reference_in_another_frame_is_said_with_its_turn(log, mirrored, turn):
    """A turn of the frame by ``turn``, of a frame whose first axis is north where mirrored."""
    east = np.cos(turn) * log.ref_east - np.sin(turn) * log.ref_north
    north = np.sin(turn) * log.ref_east + np.cos(turn) * log.ref_north
    if mirrored:
        east, north = north, east
    text = said(replace(log, ref_east=east, ref_north=north))
    about = "mirrored and turned by" if mirrored else "turned by -11"
    assert f"The reference {about}" in text
    assert "another frame than east-north-up" in text
    assert "another frame" not in said(log)


def test_a_static_log_is_at_no_limit(log):
    """Each column has a few values of its converter, and piles up at both ends."""
    text = said(log.slice(0, 225))
    assert "The whole log is at rest" in text
    assert "stuck at a limit" not in text and "% of the way" not in text


def test_the_steady_turns_of_a_coarse_gyro_are_no_limit_of_it():
    """Three values of the converter at 28 deg/s, of a part that goes to 300: all of the turn
    counts. Only the turn-on bias is unknown, which the rest tells."""
    part = pyimu.part("sparkfun6dof_v2")
    kept = tuple(t for t in part.tolerances if t.key[1] == "turn_on_bias")
    own = replace(part, tolerances=kept)
    found = run(own.specimen(0).simulate(motion(SHORT, 100.0), seed=0), own, method="filter")
    assert abs(found.errors["filter"].yaw) < 5 * found.filter.vector("attitude_std")[-1, 2]
    assert not np.any(found.filter.scalar("status").astype(int) & 1)


@pytest.mark.long
def test_a_gyro_with_a_wide_null_is_at_rest_where_its_part_allows_it():
    """The ADXRS300 may show 40 deg/s at rest; the same samples of a finer part are a turn."""
    part = pyimu.part("sparkfun6dof_v2")
    own = part.specimen(4).simulate(motion(SHORT, 100.0), seed=4)
    assert np.abs(own.gyro[:400].mean(axis=0)).max() > np.radians(10)
    found = run(own, part, method="filter")
    assert found.rest.seen and len(found.later_stops) == 4
    assert found.errors["filter"].end < 2.0
    assert not run(own, assumed(), method="filter").rest.seen


def test_a_force_at_rest_that_is_not_gravity_is_said_and_the_rest_is_one(log):
    """60 %: no gravity by any consumer part, yet the body stands; its gyro's bias is known so."""
    found = run(replace(log, accel=1.6 * log.accel), None, method="filter")
    text = found.report()
    (off,) = [f.detail for f in found.findings if f.kind == "gravity_off"]
    assert off["magnitude"] == pytest.approx(
        1.6 * np.linalg.norm(log.accel[:200].mean(axis=0)), 0.01
    )
    assert "% of gravity off" in text
    assert "turned steadily" not in text and "no rest at the start" not in text


def test_a_gyro_in_another_unit_is_said(log):
    text = run(replace(log, gyro=np.radians(log.gyro)), None, method="filter").report()
    assert "The gyro's rates are 57.3 times too small" in text


def test_headings_that_count_clockwise_are_said_and_not_used(log):
    """A compass in a world of east-north-up."""
    w, x, y, z = log.ref_q.T
    yaw = np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    rng = np.random.default_rng(3)
    compass = np.pi / 2 - yaw + 0.02 * rng.standard_normal(len(yaw))
    bare = replace(log, ref_q=None, heading=compass)
    found = run(bare, assumed(), method="filter")
    assert "count clockwise, as a compass does" in found.report()
    assert found.heading_from != "the log's column heading"


def test_a_part_that_is_too_quiet_for_a_log_is_told_by_its_rests():
    """A log of another sensor, ten times as noisy, shows no rest by the part's noise."""
    rest = noisy(perfect(SHORT), assumed(), 3)
    louder = noisy(perfect(SHORT), part_of_noise(10.0), 3)
    asked = "is it another part?"
    assert "There is no rest in this log" in said(louder) and asked in said(louder)
    assert asked not in said(rest)


def part_of_noise(times):
    values = {k: dict(assumed().sensor(k).values) for k in ("gyro", "accel")}
    for own in values.values():
        walk = own["angle_random_walk"]
        own["angle_random_walk"] = walk | {"N": times * walk["N"]}
    return replace(
        assumed(), **{k: replace(assumed().sensor(k), values=v) for k, v in values.items()}
    )
