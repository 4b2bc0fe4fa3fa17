"""Positions, speeds and references beside rests that are none: a constant speed looks like one."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from pyimu import Recording, UserError
from pyimu.ins import run
from pyimu.ins.track import Reference
from pyimu.ins.witnesses import Witness, denied, rests_that_move, witnesses_of

TIME = 0.01 * np.arange(6000)
STILL = np.ones(len(TIME), dtype=bool)


def places(way, std=0.0, every=100, seed=0):
    """A position a second of a way (n,) m to the east."""
    rng, rows = np.random.default_rng(seed), np.arange(0, len(TIME), every)
    place = np.stack([way[rows], 0 * rows, 0 * rows], axis=1)
    return Witness("position", TIME[rows], place + std * rng.standard_normal(place.shape), std)


def drive(speed, start=20.0, stop=60.0):
    return speed * (np.clip(TIME, start, stop) - start)


@pytest.mark.parametrize("seed", range(4))
def test_a_way_far_above_the_noise_denies_a_rest(seed):
    """2 m/s for 30 s beside 0.3 m: 10 standard deviations after 1.5 s, which the search by doubles
    sees in 4 s at most. What rested before is left, but for 0.35 + 0.5 of these."""
    moves = places(drive(2.0, 30.0), 0.3, seed=seed).moves(TIME, STILL)
    assert moves[TIME > 31].all() and not moves[TIME < 30 - 0.85 * 4].any()


def test_a_way_within_the_noise_denies_nothing():
    """0.1 m/s is 4 m in all, 4 standard deviations; a wander of 2 cm/s is slower than any drive."""
    assert not places(drive(0.1), 1.0).moves(TIME, STILL).any()
    assert not places(0.02 * TIME, 0.01).moves(TIME, STILL).any()


@pytest.mark.parametrize("far", (1.0, 30.0, 1e4))
def test_a_jump_denies_nothing(far):
    """The source is the outlier: nothing looks still that goes so far in a second."""
    for at in (0.5, 10.3, 30.7, 59.2):
        assert not places(far * (TIME > at), 0.05).moves(TIME, STILL).any()


def speeds(values, std=0.02):
    rows = np.arange(0, len(TIME), 10)
    return Witness("speed", TIME[rows], values[rows, None], std, fast=True)


def test_a_speed_denies_a_rest_and_one_that_jumps_none():
    assert speeds(np.full(len(TIME), 0.3)).moves(TIME, STILL).all()
    assert not speeds(np.full(len(TIME), 0.05)).moves(TIME, STILL).any()
    assert not speeds(2.0 * ((TIME > 20) & (TIME < 30))).moves(TIME, STILL).any()
    assert not speeds(5.0 * (np.arange(len(TIME)) % 500 == 0)).moves(TIME, STILL).any()


def test_a_speed_that_is_missing_for_seconds_tells_what_is_before_and_after():
    """What comes up while no speed is measured is none that nothing feels."""
    rows = np.r_[0:1000:10, 2000:6000:10]
    speed = np.where(TIME > 15, 2.0, 0.0)[rows, None]
    moves = Witness("speed", TIME[rows], speed, 0.02, fast=True).moves(TIME, STILL)
    assert moves[TIME > 20].all() and not moves[TIME < 9].any()


def test_of_a_speed_and_a_position_the_one_that_sees_more_counts():
    """Wheels that slip at 1 m/s for a minute go 60 m, where 0.1 m would be seen; beside positions
    to 5 m, which see no less than 50, the speed counts."""
    slips = speeds(np.full(len(TIME), 1.0))
    stands = places(np.zeros(len(TIME)), 0.01)
    assert not denied(TIME, STILL, [stands, slips])[0].any()
    assert denied(TIME, STILL, [places(np.zeros(len(TIME)), 5.0), slips])[0].all()
    assert denied(TIME, STILL, [places(TIME, 0.01), slips])[0].all()


def test_what_denies_is_said_with_its_time():
    marks, (said,) = denied(TIME, STILL, [places(drive(3.0), 0.1)])
    assert said.kind == "rest_denied" and said.column == "position" and said.count == 1
    assert said.detail["first"] == pytest.approx(20.0, abs=2.0)
    assert said.detail["seconds"] == pytest.approx(np.sum(marks) * 0.01, abs=0.05)
    (moved,) = rests_that_move(TIME, STILL, [places(drive(3.0), 0.1)])
    assert moved.detail["largest"] == pytest.approx(120.0, abs=4.0)


def test_a_height_that_is_missing_is_no_axis():
    rows = np.arange(0, len(TIME), 100)
    place = np.stack([drive(1.0)[rows], 0 * rows, np.full(len(rows), np.nan)], axis=1)
    log = Recording.from_arrays(time=TIME, gyro=np.zeros((len(TIME), 3)))
    (one,) = witnesses_of(log, None, Reference(rows, place))
    assert one.moves(TIME, STILL)[TIME > 25].all()


def lift(seed=0, seconds=60.0, speed=1.5):
    """A lift that is first seen as it goes up, and stops after 30 s for good: nothing but its
    braking, of 0.7 m/s^2, and what else is measured tells the one from the other.
    """
    rng, n = np.random.default_rng(seed), round(seconds / 0.01)
    time = 0.01 * np.arange(n)
    share = np.clip((time - 30) / 2.1, 0, 1)
    up = speed * (1 - share**2 * (3 - 2 * share))
    force = np.stack([0 * up, 0 * up, 9.80665 + np.gradient(up, time)], axis=1)
    return (
        time,
        up,
        Recording.from_arrays(
            time=time,
            gyro=0.01 + 8e-4 * rng.standard_normal((n, 3)),
            accel=force + 0.03 * rng.standard_normal((n, 3)),
        ),
    )


def of_lift(by):
    time, up, log = lift()
    height = 0.01 * np.cumsum(up)
    seen = np.arange(len(time)) % 50 == 0
    rng = np.random.default_rng(1)
    if by == "position":
        noise = 0.3 * rng.standard_normal((3, len(time)))
        names = {"position_east": noise[0], "position_north": noise[1]}
        names["position_up"] = height + noise[2]
        columns = {k: np.where(seen, v, np.nan) for k, v in names.items()}
        return replace(log, **columns, position_std=np.full(len(time), 0.3)), up
    if by == "velocity":
        noise = 0.05 * rng.standard_normal((3, len(time)))
        names = {
            "velocity_east": noise[0],
            "velocity_north": noise[1],
            "velocity_up": up + noise[2],
        }
        columns = {k: np.where(seen, v, np.nan) for k, v in names.items()}
        return replace(log, **columns, velocity_std=np.full(len(time), 0.05)), up
    zero = np.zeros(len(time))
    return replace(log, ref_east=zero, ref_north=zero, ref_up=height), up


@pytest.mark.parametrize("by", ("position", "velocity", "reference"))
def test_a_log_that_begins_at_a_constant_speed_is_told_by_what_it_measures(by):
    """Without, its start is taken for the rest, and that it stands for a drive downwards."""
    log, up = of_lift(by)
    found = run(log, method="filter")
    assert not found.still[up > 0.1].any()
    assert found.still[-2000:].mean() > 0.9
    text = found.report()
    said = {"position": "The measured position moves", "reference": "The reference moves"}
    assert said.get(by, "By the measured velocity the body") in text
    assert "like rest to gyro and accelerometer (the first at 0 s" in text
    assert ("Without a reference in the log" in text) == (by == "reference")


def test_a_declared_rest_that_a_position_moves_in_is_said():
    log, up = of_lift("position")
    told = replace(log, stationary=np.ones(len(up)))
    with pytest.raises(UserError, match="the positions move during what was taken for rests"):
        run(told, method="filter")
    ref = replace(of_lift("reference")[0], stationary=np.ones(len(up)))
    text = run(ref, method="filter").report()
    assert "The reference moves during 1 rest, by up to 4" in text
    assert "these are none, whatever the column stationary says" in text


@pytest.mark.parametrize("seed", range(8))
def test_errors_that_last_for_a_second_deny_no_rest(seed):
    """A receiver's velocity that is 0.1 m/s off for a second here and there left 5 % of a rest."""
    rng, time = np.random.default_rng([41, seed]), np.arange(0.0, 120.0, 0.1)
    off = lfilter([np.sqrt(1 - 0.9**2)], [1.0, -0.9], rng.standard_normal((len(time), 3)), axis=0)
    told = Witness("velocity", time, 0.1 * off, 0.1, fast=True)
    assert not told.moves(time, np.ones(len(time), dtype=bool)).any()


def test_positions_refute_a_speed_where_there_are_some():
    """In a tunnel there are none, and the wheels are right."""
    time = np.arange(0.0, 60.0, 0.1)
    speed = Witness("speed", time, np.ones((len(time), 1)), 0.01, fast=True)
    here, whole = time[time < 3.5], np.zeros((len(time), 3))
    gone = np.column_stack([here, 0 * here, 0 * here])
    still = np.ones(len(time), dtype=bool)
    beside = {"gone": Witness("position", here, gone, 0.05)}
    beside["hung"] = Witness("position", time, whole, 0.05)
    denied_by = {k: denied(time, still, [speed, w])[0].mean() for k, w in beside.items()}
    assert denied_by["gone"] > 0.95 and denied_by["hung"] == 0.0
