"""Bodies that go at a constant speed for long, and logs that begin in the middle of it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from pyimu import Recording
from pyimu.attitude.filter.prediction import DRIVES
from pyimu.attitude.rest import find_rest
from pyimu.errors import Finding
from pyimu.ins import run
from pyimu.ins.detector import detect
from pyimu.ins.noise import Noise
from pyimu.ins.pushes import unpushed
from pyimu.ins.speeds import _change, _Stretch, _unsure, driven
from pyimu.recording.clock import runs

H, G = 0.01, 9.80665
RATE, FORCE, WALK = 8e-4, 0.03, 3e-5
"""rad/s, m/s^2 and rad/s/sqrt(s); white noise of a sample at 100 Hz, and a consumer gyro's walk."""


def measured(plan, seed, begins=0.0, bias=0.01):
    """What a body measures that goes along x by a ``plan`` of (seconds, speed at the end), each
    change a raised cosine of acceleration: times, speeds and the log, from ``begins`` s on.
    """
    rng = np.random.default_rng(seed)
    time = H * np.arange(round(sum(seconds for seconds, _ in plan) / H))
    speed, at, last = np.zeros(len(time)), 0.0, plan[0][1]
    speed += last
    for seconds, end in plan:
        share = np.clip((time - at) / seconds, 0, 1)
        speed += (end - last) * (share - np.sin(2 * np.pi * share) / (2 * np.pi))
        at, last = at + seconds, end
    walk = WALK * np.sqrt(H) * np.cumsum(rng.standard_normal((len(time), 3)), axis=0)
    gyro = bias * rng.standard_normal(3) + walk + RATE * rng.standard_normal((len(time), 3))
    accel = FORCE * rng.standard_normal((len(time), 3)) + [0.1, -0.2, G]
    accel[:, 0] += np.gradient(speed, time)
    own = slice(round(begins / H), None)
    log = Recording.from_arrays(time=time[own], gyro=gyro[own], accel=accel[own])
    return time[own], speed[own], log


BELT = [(10, 0), (1.5, 0.4), (80, 0.4), (1.5, 0), (6, 0), (1.2, 0.25), (60, 0.25), (1.2, 0), (8, 0)]
"""A conveyor: long at a speed, shortly at rest."""

TRAIN = [(20, 0), (60, 20), (60, 20), (70, 0), (30, 0)]


@pytest.mark.parametrize("plan", (BELT, TRAIN))
@pytest.mark.parametrize("seed", range(3))
def test_a_body_that_drives_for_longer_than_it_rests_rests_where_it_stands(plan, seed):
    """The gyro's bias walks by as much over a minute as a slow turn has: stretches were cut into
    turns, and drives between two of them taken for rests, up to 166 s of a log."""
    _, speed, log = measured(plan, 7330 + seed)
    found = run(log, method="filter", settings={"top_speed": 30.0})
    assert np.abs(speed[found.still]).max() < 0.1
    assert found.still[speed == 0].mean() > 0.8


@pytest.mark.parametrize("seed", range(4))
def test_a_bias_that_walks_is_no_turn(seed):
    """Of a body that rests all along. Each of some ten tests of a stretch would be beyond its gate
    by chance with 4e-6."""
    time, _, log = measured([(400, 0)], 7340 + seed, bias=0.0)
    noise = Noise(np.full(3, RATE), np.full(3, FORCE), np.full(3, WALK), np.zeros(3))
    found = detect(time, log.gyro, log.accel, noise, H)
    assert not found.steady and found.still.mean() > 0.98


def test_the_mean_of_a_rate_is_known_to_its_noise_and_its_walk():
    """N/n and K^2 T/3; the longest mean is where the two are alike."""
    noise = Noise(np.full(3, RATE), np.full(3, FORCE), np.full(3, WALK), np.zeros(3))
    rng, n = np.random.default_rng(7), noise.longest_mean(H)
    assert RATE**2 / n == pytest.approx(WALK**2 * n * H / 3, rel=0.01)
    walk = WALK * np.sqrt(H) * np.cumsum(rng.standard_normal((400, n)), axis=1)
    off = np.mean(walk - walk[:, -1:] + RATE * rng.standard_normal((400, n)), axis=1)
    low, high = chi2.ppf([1e-4, 1 - 1e-4], 400) / 400
    assert low < np.mean(off**2) / noise.of_mean(n, H)[0] < high


@pytest.mark.parametrize("seed", range(3))
def test_a_push_that_lasts_is_seen_from_where_its_speed_comes_up(seed):
    """0.06 m/s^2 at most for 8 s, as little as the noise of a mean over a window. At its first
    3 cm/s no more than twice that is left of the rest."""
    _, speed, log = measured([(30, 0), (8, 0.24), (30, 0.24)], 7350 + seed)
    still = unpushed(log.accel, np.full(3, FORCE), 30, H)
    first = runs(still)[0]
    assert first[0] == 0 and first[1] * H > 25 and speed[first[1] - 1] < 0.1


GENTLE = [(12, 0), (40, 0.6), (10, 0.6), (2, 0), (8, 0), (2, 0.7), (8, 0.7), (45, 0), (9, 0)]
GENTLE += [(30, 0.5), (30, 0), (10, 0)]
"""Starts and brakes of up to 0.03 m/s^2, as long as the rests beside them and longer."""


@pytest.mark.parametrize("seed", range(3))
def test_what_is_pushed_gently_for_long_does_not_stand_askew(seed):
    """What stayed at another force for 10 s was taken for a rest on a slope, though the gyro showed
    no turn: up to 50 s of each such log. One in a thousand ends is further off."""
    _, speed, log = measured(GENTLE, 7390 + seed)
    found = run(log, method="filter", heading0=0.0)
    assert np.abs(speed[found.still]).max() < 0.1
    assert found.still[speed == 0].mean() > 0.4
    track, way = found.tracks["filter"], np.array([np.sum(speed) * H, 0.0, 0.0])
    off = (track.position[-1] - way) / track.position_std[-1]
    assert off @ off < chi2.isf(1e-3, 3)


def test_a_rest_that_a_turn_left_at_another_force_is_one():
    """5 mrad within a second: 0.05 m/s^2 as of a push, and a turn that the gyro shows."""
    time, _, log = measured([(60, 0)], 7395, bias=0.0)
    gyro, accel, lean = log.gyro.copy(), log.accel.copy(), 0.005
    gyro[3000:3100, 1] += lean
    accel[:, 0] += G * lean * -np.clip(time - 30.0, 0, 1)
    noise = Noise(np.full(3, RATE), np.full(3, FORCE), np.full(3, WALK), np.zeros(3))
    still = detect(time, gyro, accel, noise, H).still
    drives = driven(time, gyro, accel, still, noise, H)[0]
    assert still[:2700].mean() > 0.9 and still[3300:].mean() > 0.8 and not drives


@pytest.mark.parametrize("seed", range(3))
def test_a_log_that_begins_in_a_drive_ends_where_it_claims(seed):
    """Before, the drive with which it begins was the rest, and each other rest a drive. 3 axes; one
    in a thousand ends is further off."""
    time, speed, log = measured(BELT, 7360 + seed, begins=40.0)
    found = run(log, method="filter", heading0=0.0)
    assert np.abs(speed[found.still]).max() < 0.1
    assert "the gyro's bias there is that of a later rest" in found.report()
    way = np.array([np.sum(speed) * H, 0.0, 0.0])
    track = found.tracks["filter"]
    off = (track.position[-1] - way) / track.position_std[-1]
    assert off @ off < chi2.isf(1e-3, 3)


def told(plan, begins):
    time, speed, log = measured(plan, 7370, begins, bias=0.0)
    noise = Noise(np.full(3, RATE), np.full(3, FORCE), np.full(3, WALK), np.zeros(3))
    still = detect(time, log.gyro, log.accel, noise, H).still
    return speed, driven(time, log.gyro, log.accel, still, noise, H)


def test_where_nothing_tells_rests_from_drives_it_is_said():
    """At one speed twice, in a log that begins in the middle of it, rests and drives are alike; of
    one with two speeds only the rests are."""
    one = [(5, 0), (1.5, 0.4), (20, 0.4), (1.5, 0), (9, 0), (1.5, 0.4), (20, 0.4), (1.5, 0), (9, 0)]
    other = [*one[:5], (1.5, 0.7), (20, 0.7), (1.5, 0), (9, 0)]
    assert told(one, 15.0)[1][1] == 2
    assert told(other, 0.0)[1][1] == 0


def test_what_would_tell_rests_from_drives_is_what_the_log_has_not():
    """Of a log with a speed nobody is told that a speed would tell."""
    log = measured([(3, 0)], 7371)[2]
    doubt = Finding("rests_or_drives", "", 2, {})
    for own, more in ((log, True), (replace(log, speed=np.zeros(len(log))), False)):
        found = replace(run(own, method="filter", heading0=0.0), findings=(doubt,))
        assert ("stationary, a speed or positions would tell" in found.report()) == more


def test_rests_between_which_a_speed_comes_up_are_said():
    """0.3 m/s that come within 2 s and never go: two rests are told, and one drives."""
    time, speed, log = measured([(30, 0), (2, 0.3), (30, 0.3)], 7373, bias=0.0)
    noise = Noise(np.full(3, RATE), np.full(3, FORCE), np.full(3, WALK), np.zeros(3))
    at = np.flatnonzero(speed == 0)[-1]
    still = (time < 29) | (time > 33)
    stretches = [_Stretch.of(log.gyro, log.accel, *run) for run in runs(still)]
    change = _change(time, log.gyro, log.accel, tuple(stretches), noise, H)
    assert at < stretches[1].start
    assert list(_unsure({0, 1}, stretches, {(0, 1): change}, H)) == [1]
    assert not list(_unsure({1}, stretches, {(0, 1): change}, H))
    found = run(log, method="filter", heading0=0.0)
    finding = Finding("unsure_rests", "", 1, {"first": 32.0})
    assert "a speed is left" in replace(found, findings=(finding,)).report()


@pytest.mark.parametrize("count", (2, 4, 12))
def test_a_log_of_a_few_samples_has_a_path(count):
    """Where its vibration is looked for there was one sample, without a period."""
    rows = measured([(3, 0)], 7372)[2].slice(0, count)
    assert np.isfinite(run(rows, heading0=0.0).tracks["smoother"].position_std).all()


def test_a_rest_at_the_start_ends_where_a_speed_begins():
    """0.02 m/s^2 look still for 30 s, of which 12 rest; what drives from the start has none."""
    _, speed, log = measured([(12, 0), (30, 0.6), (10, 0.6)], 7380)
    rest = find_rest(replace(log, speed=speed))
    assert rest.seen and 11 < rest.duration < 30 and speed[rest.rows].max() <= DRIVES
    assert not find_rest(replace(log, speed=speed + 0.5)).seen
