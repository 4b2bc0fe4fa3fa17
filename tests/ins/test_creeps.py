"""Bases that creep at a few centimetres a second, and rests within which a motion begins."""

from dataclasses import replace

import numpy as np
import pytest

from pyimu import Recording
from pyimu.attitude.rest import find_rest
from pyimu.ins import run
from pyimu.ins.noise import Noise
from pyimu.ins.shoves import shoved
from pyimu.ins.stops import rest_at_start
from pyimu.recording.clock import runs

H, G = 0.01, 9.80665
RATE, FORCE, WALK = 8e-4, 0.03, 3e-5
"""rad/s, m/s^2 and rad/s/sqrt(s); white noise of a sample at 100 Hz, and a consumer gyro's walk."""


def measured(along, seed, shaken=0.0):
    """The log of a body that speeds up by ``along`` (n,) m/s^2, on x, and is ``shaken`` m/s^2 as it
    moves; and its speed.
    """
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal((3, len(along), 3))
    speed = np.cumsum(along) * H
    speed[np.abs(speed) < 1e-9] = 0.0
    walk = WALK * np.sqrt(H) * np.cumsum(noise[0], axis=0)
    gyro = 0.01 * rng.standard_normal(3) + walk + RATE * noise[1]
    moves = np.minimum(speed / 0.1, 1.0)[:, None]
    accel = np.hypot(FORCE, shaken * moves) * noise[2] + [0.1, -0.2, G]
    accel[:, 0] += along
    return Recording.from_arrays(time=H * np.arange(len(along)), gyro=gyro, accel=accel), speed


def bell(gain, seconds):
    """m/s^2; what gains so many m/s within some seconds."""
    count = round(seconds / H)
    shape = 1 - np.cos(2 * np.pi * (np.arange(count) + 0.5) / count)
    return gain * shape / shape.sum() / H


def still(seconds):
    return np.zeros(round(seconds / H))


@pytest.mark.parametrize("seed", range(5))
def test_a_shove_is_found_where_it_is_and_a_rest_has_none(seed):
    """Of 2 cm/s within 0.4 s, 11 standard deviations of the sum of so much noise; at rest a window
    of 200 s is above the gate 4e-6 times, some 2,000 are independent."""
    noise = Noise(np.full(3, RATE), np.full(3, FORCE), np.full(3, WALK), np.zeros(3))
    marks = np.ones(20000, dtype=bool)
    rest, _ = measured(still(200), 7600 + seed)
    assert not shoved(rest.accel, marks, noise, H)[0].any()
    log, _ = measured(np.concatenate([still(100), bell(0.02, 0.4), still(99.6)]), 7600 + seed)
    ((start, stop),) = runs(shoved(log.accel, marks, noise, H)[0])
    assert start < 10020 < stop and stop - start < 100


def test_noise_that_a_low_pass_leaves_is_no_shove():
    """Neighbours that are alike make sums that wander three times as far as white noise does."""
    log, _ = measured(still(200), 7605)
    alike = np.convolve(log.accel[:, 0] - 0.1, np.ones(9) / 3, "same") + 0.1
    force = np.column_stack([alike, log.accel[:, 1:]])
    noise = Noise(np.full(3, RATE), np.full(3, FORCE), np.full(3, WALK), np.zeros(3))
    assert not shoved(force, np.ones(20000, dtype=bool), noise, H)[0].any()


@pytest.mark.parametrize("seed", range(3))
def test_what_creeps_is_no_rest_and_the_end_is_as_sure_as_it_is_said(seed):
    """It counted as rest, and of 5 creeps the end was 1.1 m off where 8 mm were claimed."""
    creeps = [part for _ in range(5) for part in (*_creep(0.022), still(8))]
    log, speed = measured(np.concatenate([still(12), *creeps]), 7610 + seed)
    found = run(log, method="filter", heading0=0.0)
    assert np.mean(speed[found.still] > 0.01) < 0.02
    assert found.still[speed == 0].mean() > 0.8
    (creeps,) = (f for f in found.findings if f.kind == "creeps")
    assert creeps.count == 5 and "The body creeps 5 times" in found.report()
    track = found.tracks["filter"]
    off = track.position[-1, 0] - speed.sum() * H
    assert abs(off) < 4 * track.position_std[-1, 0] < 2.0


@pytest.mark.parametrize("seed", range(3))
def test_the_unit_tells_a_creep_by_its_shoves(seed):
    """By what came before alone. It counted as rest, 130 standard deviations off at the end. What
    is missed of a creep is what its shove takes to be seen.
    """
    creeps = [part for _ in range(5) for part in (*_creep(0.022), still(8))]
    log, speed = measured(np.concatenate([still(12), *creeps]), 7630 + seed)
    found = run(log, method="filter", heading0=0.0, zupt="live")
    assert np.mean(speed[found.still] > 0.01) < 0.1
    assert found.still[speed == 0].mean() > 0.6
    track = found.tracks["filter"]
    off = track.position[-1, 0] - speed.sum() * H
    assert abs(off) < 4 * track.position_std[-1, 0] < 3.0


@pytest.mark.parametrize("size", (0.02, 0.04))
def test_the_unit_tells_a_push_that_no_window_shows(size):
    """For 20 s: half of it, and the cruise after it, counted as rest. Less than 3 s of it is to be
    seen, and the speed of that time is found."""
    push = np.concatenate(
        [still(12), bell(10 * size, 20), still(10), bell(-10 * size, 20), still(8)]
    )
    log, speed = measured(push, 7640)
    found = run(log, method="filter", heading0=0.0, zupt="live")
    assert not found.still[speed > 10 * size / 2].any()
    v, std = found.filter.vector("velocity")[:, 0], found.filter.vector("velocity_std")[:, 0]
    cruise = slice(3200, 4200)
    assert np.all(np.abs(v - speed)[cruise] < 4 * std[cruise])
    assert std[cruise].max() < 0.1


@pytest.mark.parametrize("seed", range(3))
def test_a_push_that_goes_on_makes_the_drive_no_slow_one(seed):
    """By a rest of 5 s before it, a speed is known to no more than it first was. The drive was told
    to be as slow as that all along, and its cruise was a rest.
    """
    ramp = np.clip((np.arange(3000) + 0.5) * H, 0, 1)
    push = 0.02 * np.minimum(ramp, ramp[::-1])
    log, speed = measured(np.concatenate([still(5), push, still(5), -push, still(8)]), 7660 + seed)
    found = run(log, method="filter", heading0=0.0, zupt="live")
    assert not found.still[speed > 0.1].any()
    v, std = found.filter.vector("velocity")[:, 0], found.filter.vector("velocity_std")[:, 0]
    cruise = slice(3500, 4000)
    assert np.all(np.abs(v - speed)[cruise] < 4 * std[cruise])


def test_the_unit_takes_no_flicker_for_a_push():
    """Minutes of rest, beside forces whose means over a second wander by twice what white noise of
    their samples makes them."""
    log, _ = measured(still(200), 7650)
    slow = np.repeat(np.random.default_rng(7650).standard_normal((200, 3)), 100, axis=0)
    smooth = [np.convolve(column, np.ones(100) / 100, "same") for column in slow.T]
    own = 2 * FORCE / 10 * np.column_stack(smooth)
    found = run(replace(log, accel=log.accel + own), method="filter", zupt="live", heading0=0.0)
    assert found.still.mean() > 0.95


def _creep(speed):
    return bell(speed, 0.4), still(10), bell(-speed, 0.4)


def test_what_shakes_more_than_a_rest_before_it_is_a_motion_that_begins():
    """Of a push of 0.03 m/s^2, with a vibration of 0.1 m/s^2 that no second alone tells: the rest
    had a noise of 0.08 m/s^2 with it, and hid all later motions."""
    push = np.concatenate([still(10), bell(0.6, 20), still(20), bell(-0.6, 20), still(10)])
    log, speed = measured(push, 7620, shaken=0.1)
    assert np.mean(find_rest(log).force_std) > 1.5 * FORCE
    rest = rest_at_start(log, None, G)
    assert speed[rest.rows.stop - 1] < 0.1
    assert np.mean(rest.force_std) == pytest.approx(FORCE, rel=0.1)


def test_a_rest_that_is_never_as_quiet_again_stays_as_long_as_it_was():
    """As of a machine whose engine is started: by its quiet noise alone it would never rest."""
    log, _ = measured(still(60), 7621)
    louder = log.accel.copy()
    louder[1000:] += 2 * (louder[1000:] - louder[1000:].mean(axis=0))
    both = Recording.from_arrays(time=log.time, gyro=log.gyro, accel=louder)
    assert rest_at_start(both, None, G).rows == find_rest(both).rows
