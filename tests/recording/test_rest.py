"""Is a sensor at rest? Sensors that are and sensors that are not, and where in a log they are."""

import numpy as np
import pytest

from pyimu.recording.quality.in_pieces import quality
from pyimu.recording.recording import Recording
from pyimu.recording.rest import (
    DRIFT,
    FARTHEST,
    SIGMAS,
    is_at_rest,
    motion_in,
    motion_of,
    rests,
    seconds_of,
    still_rows,
)

H = 0.01
DEG = np.pi / 180


def log(seconds=120, rate=0.0, force=(0.0, 0.0, 9.80665), seed=0, noise=(0.05 * DEG, 0.01), **more):
    """A consumer part with noise of root densities ``noise`` that measures these."""
    n, rng = round(seconds / H), np.random.default_rng(seed)
    gyro, accel = (s / np.sqrt(H) * rng.standard_normal((n, 3)) for s in noise)
    gyro = gyro + np.reshape(rate, (-1, 1)) * [1.0, 0.0, 0.0]
    time = H * np.arange(n)
    return Recording.from_arrays(time=time, gyro=gyro, accel=accel + force, **more)


def time(seconds=120):
    return H * np.arange(round(seconds / H))


@pytest.mark.parametrize("seed", range(5))
def test_noise_is_no_motion(seed):
    """Of 119 changes on each of six axes, each beyond five standard deviations once in 1.7e6."""
    assert is_at_rest(log(seed=seed)) and motion_in(log(seed=seed)) == []


@pytest.mark.parametrize("rate", [0.5, 1.0, 3.0, 5.0])
def test_unfiltered_noise_is_no_motion_at_any_rate(rate):
    """Samples that a logger takes now and then have the noise of all of the sensor's bandwidth: of
    a consumer part 0.15 deg/s and 5 mg. The least of what is believed of it is two thirds, and of
    the changes of twelve hours one in two hundred may be beyond: each is so once in 1,000.
    """
    n, rng = round(12 * 3600 * rate), np.random.default_rng(3)
    gyro, force = 0.15 * DEG * rng.standard_normal((n, 3)), 0.05 * rng.standard_normal((n, 3))
    slow = Recording.from_arrays(
        time=np.arange(n) / rate, gyro=gyro, accel=force + [0.0, 0.0, 9.80665]
    )
    assert motion_in(slow) == []
    assert not {"gyro_noisy"} & {f.kind for f in quality(slow)}


@pytest.mark.parametrize("rate", [1.0, 3.0])
def test_a_drive_is_motion_at_any_rate(rate):
    """A car that turns a corner every minute, at rates of ten degrees a second."""
    at = np.arange(0.0, 3600.0, 1 / rate)
    turn = 10 * DEG * np.maximum(np.sin(2 * np.pi * at / 60) - 0.8, 0) / 0.2
    gyro = 0.1 * DEG * np.random.default_rng(4).standard_normal((len(at), 3))
    gyro[:, 2] += turn
    slow = Recording.from_arrays(time=at, gyro=gyro)
    assert [f.column for f in motion_in(slow)] == ["gyro_z"]


@pytest.mark.parametrize("period", [4.0, 20.0, 60.0])
def test_a_slow_sway_is_motion(period):
    """1.7 deg/s of sway about one axis; the slowest changes by 0.18 deg/s in a second."""
    sway = 1.7 * DEG * np.sin(2 * np.pi * time() / period)
    found = motion_in(log(rate=sway, noise=(0.005 * DEG, 0.001)))
    assert [f.column for f in found] == ["gyro_x"] and not is_at_rest(log(rate=sway))


def test_a_bias_that_drifts_with_temperature_is_no_motion():
    """2 deg/s in an hour, and the accelerometer by 20 mg: 0.0006 deg/s in a second."""
    drift = np.linspace(0, 2 * DEG, round(3600 / H))
    force = np.linspace(0, 0.2, len(drift))[:, None] + [0.0, 0.0, 9.80665]
    assert is_at_rest(log(3600, rate=drift, force=force))


def test_a_far_level_is_motion_however_slowly_it_is_reached():
    rate = np.linspace(0, 4 * FARTHEST["gyro"], round(3600 / H))
    assert not is_at_rest(log(3600, rate=rate))


def test_a_jolt_is_no_motion():
    rate = np.zeros(round(1000 / H))
    rate[50_000:50_020] = 1.0
    assert is_at_rest(log(1000, rate=rate))


def test_what_a_log_says_of_itself_counts():
    rate = np.where(time() > 60, 0.5, 0.0)
    marks = np.ones(len(rate))
    assert is_at_rest(log(rate=rate, stationary=marks))
    assert not is_at_rest(log(moving=marks))
    assert not is_at_rest(log(ref_rate=np.zeros((len(rate), 3))))


def test_rests_are_found_where_they_are():
    """The second in which a turn begins or ends is not counted, so up to two are missing."""
    rate = np.where((time() > 40) & (time() < 70), 0.3, 0.0)
    assert still_rows(log(rate=rate)) == [(0, 3900), (7100, 12000)]


def test_rests_are_where_the_log_says_so():
    """The column wins over the samples, and a gap parts a rest."""
    marks = np.where((time() > 10) & (time() < 40), 1.0, 0.0)
    assert rests(log(rate=0.3 * marks, stationary=marks)) == [(1001, 4000)]
    assert rests(log(rate=np.zeros(len(marks)))) == [(0, len(marks))]


def test_a_body_that_shakes_is_not_still():
    shake = np.where(time() > 60, 0.5 * np.sin(2 * np.pi * 8 * time()), 0.0)
    rows = still_rows(log(rate=shake))
    assert rows and all(b <= 6100 for _, b in rows)


@pytest.mark.parametrize("cut", [150, 6_000])
def test_gaps_part_seconds(cut):
    """Across a gap nothing is compared: a level that another segment has is no change."""
    r = log(120, rate=np.where(np.arange(12_000) < cut, 0.0, 0.01), noise=(1e-5, 1e-3))
    segments = [(0, cut), (cut, 12_000)]
    assert motion_of("gyro", r.gyro[:, 0], segments, H) is None
    step = seconds_of(r.gyro[:, 0], [(0, 12_000)], H).moving("gyro")
    assert step.any() and not seconds_of(r.gyro[:, 0], segments, H).moving("gyro").any()


def test_pieces_give_what_the_whole_gives(monkeypatch):
    r = log(rate=0.02 * np.sin(time() / 3))
    whole = seconds_of(r.gyro[:, 0], r.segments, H)
    monkeypatch.setattr("pyimu.recording.rest.PIECE", 700)
    parts = seconds_of(r.gyro[:, 0], r.segments, H)
    for name in ("mean", "std", "first", "joined"):
        np.testing.assert_array_equal(getattr(parts, name), getattr(whole, name))
    assert parts.white == whole.white


def test_missing_samples_are_left_out():
    r = log()
    r.gyro[500:2500] = np.nan
    r.gyro[3000::7] = np.nan
    seconds = seconds_of(r.gyro[:, 0], r.segments, H)
    assert len(seconds.mean) == 100 and np.isfinite(seconds.mean).all() and is_at_rest(r)


def test_white_noise_is_told_from_motion():
    """The standard deviation of a sample's noise, from third differences, beside a sway of 1 Hz.

    Third differences have the autocorrelation 1, -3/4, 3/10, -1/20, so that their mean square over
    a second (97 of them) scatters by sqrt(2 * 2.31 / 97) = 0.22; the mean of the lowest quarter of
    120 such is lower by 1.27 times that, or 15 % in the standard deviation, give or take 3 * 2 %.
    """
    r = log(rate=0.5 * np.sin(2 * np.pi * time()), noise=(0.05 * DEG, 0.01))
    white = seconds_of(r.gyro[:, 0], r.segments, H).white
    assert 0.79 * 0.5 * DEG < white < 0.91 * 0.5 * DEG
    limit = DRIFT["gyro"] + SIGMAS * np.sqrt(2 / 100) * white
    assert np.deg2rad(0.3) < limit < np.deg2rad(0.5)
