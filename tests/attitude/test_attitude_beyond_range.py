"""Rates beyond a gyro's range are drawn as the body turned before and after, where that helps."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu import Recording, attitude
from pyimu.attitude import beyond_range as module
from pyimu.attitude.beyond_range import beyond_range
from pyimu.attitude.columns import nominal_part
from pyimu.attitude.rest import find_rest

H, WHITE, G = 0.01, 2e-3, 9.80665


def swung(seed: int, seconds: float = 60.0, tones: int = 6) -> tuple[Recording, np.ndarray]:
    """A body that is swung about a level axis by a hand that shakes it by 2 m/s^2 as well, and the
    angle (n,) in rad after each sample.
    """
    rng = np.random.default_rng(seed)
    time = H * np.arange(round(seconds / H))

    def sums(count: int) -> np.ndarray:
        phases = np.outer(rng.uniform(0.3, 1.5, count), 2 * np.pi * time)
        return np.sum(np.sin(phases + rng.uniform(0, 6.3, (count, 1))), axis=0) * (time >= 5)

    rate = sums(tones)
    angle = np.cumsum(rate) * H
    gyro = np.outer(rate, [1.0, 0.0, 0.0]) + rng.normal(0, WHITE, (len(time), 3))
    up = G * np.column_stack([0 * angle, np.sin(angle), np.cos(angle)])
    shaken = np.column_stack([sums(4) for _ in range(3)]) * 2 / np.sqrt(2)
    accel = up + shaken + rng.normal(0, 0.02, up.shape)
    return Recording.from_arrays(time=time, gyro=gyro, accel=accel), angle


def cut(recording: Recording, share: float) -> tuple[Recording, float]:
    """The log of a gyro whose range has the ``share`` of its samples, and that range."""
    limit = float(np.quantile(np.abs(recording.gyro[:, 0]), share))
    return replace(recording, gyro=np.clip(recording.gyro, -limit, limit)), limit


def drawn(recording: Recording) -> tuple[Recording, float]:
    return beyond_range(recording, nominal_part(recording, find_rest(recording, G)))


def off(result, angle: np.ndarray) -> float:
    """Root mean square in rad of the error of the inclination."""
    up = Rotation.from_quat(result.q, scalar_first=True).apply([0, 0, 1], inverse=True)
    error = np.arctan2(up[:, 1], up[:, 2]) - angle
    return float(np.sqrt(np.mean(np.angle(np.exp(1j * error)) ** 2)))


def test_most_of_the_turn_that_was_lost_is_drawn_and_what_is_not_is_claimed():
    """Over eight bodies. The spans of one log, some dozen, tell their scatter to a fifth, and the
    known ones from which it is claimed turn less than those that are lost.
    """
    ratios = []
    for seed in range(8):
        whole, _ = swung(seed)
        clipped, limit = cut(whole, 0.9)
        found, std = drawn(clipped)
        lost = np.abs(clipped.gyro[:, 0]) >= limit
        edges = np.flatnonzero(np.diff(lost.astype(int)))
        spans = np.split(np.arange(len(lost)), edges + 1)
        spans = [s for s in spans if lost[s[0]] and len(s) > 2]

        def turns(log, spans=spans, whole=whole):
            return [np.sum(log.gyro[s, 0] - whole.gyro[s, 0]) * H for s in spans]

        assert np.linalg.norm(turns(found)) < 0.5 * np.linalg.norm(turns(clipped))
        time = H * np.linalg.norm([len(s) for s in spans])
        ratios.append(np.linalg.norm(turns(found)) / time / std)
    assert 0.4 < np.median(ratios) < 2.0


@pytest.mark.parametrize("smooth", [False, True])
def test_the_attitude_is_better_by_it(monkeypatch, smooth):
    """In the median of five bodies at least by half."""
    ratios = []
    for seed in range(10, 15):
        whole, angle = swung(seed)
        clipped, _ = cut(whole, 0.95)
        with_it = off(attitude.run(clipped, smooth=smooth), angle)
        with monkeypatch.context() as without:
            name = "pyimu.attitude.prepared.beyond_range"
            without.setattr(name, lambda log, part: (log, 0.0))
            ratios.append(with_it / off(attitude.run(clipped, smooth=smooth), angle))
    assert np.median(ratios) < 0.5


def test_a_gyro_within_its_range_is_left_as_it_is():
    whole, _ = swung(1)
    assert drawn(whole) == (whole, 0.0)


def test_what_piles_up_far_below_the_limit_is_not_drawn_beyond_it():
    """By a part whose range is five times as large, the pile is no limit: what is drawn there would
    be five times too fast.
    """
    clipped, limit = cut(swung(3)[0], 0.9)
    part = nominal_part(clipped, find_rest(clipped, G))
    wide = part.with_sensor(part.gyro.with_values("saturation", limit=np.full(3, 5 * limit)))
    assert module.by_axis(clipped, wide, untold=True) == (clipped, [0.0] * 3)


def test_nothing_is_drawn_of_which_the_log_knows_nothing_alike():
    """A single knock in a log that rests: what it was beyond the range nobody can say."""
    rng = np.random.default_rng(2)
    time = H * np.arange(3000)
    rate = 8.0 * np.exp(-(((time - 15) / 0.1) ** 2))
    gyro = np.outer(rate, [1.0, 0.0, 0.0]) + rng.normal(0, WHITE, (len(time), 3))
    accel = np.tile([0.0, 0.0, G], (len(time), 1)) + rng.normal(0, 0.02, (len(time), 3))
    log = Recording.from_arrays(time=time, gyro=np.clip(gyro, -4.0, 4.0), accel=accel)
    found, std = drawn(log)
    assert found is log and std == 0.0


def test_nothing_is_drawn_across_a_gap():
    whole, _ = swung(3)
    clipped, limit = cut(whole, 0.9)
    lost = np.abs(clipped.gyro[:, 0]) >= limit
    spans = module.Axis(clipped.gyro[:, 0], limit, lost, np.zeros(0, dtype=int)).spans()
    middle = (spans[3].first + spans[3].stop) // 2
    time = clipped.time + np.where(np.arange(len(lost)) >= middle, 30.0, 0.0)
    torn = Recording.from_arrays(time=time, gyro=clipped.gyro, accel=clipped.accel)
    found, _ = drawn(torn)
    inside = slice(spans[3].first, spans[3].stop)
    assert np.array_equal(found.gyro[inside], clipped.gyro[inside])
    assert not np.array_equal(found.gyro, clipped.gyro)


@pytest.mark.parametrize("lost", ["another axis", "samples"])
def test_what_is_drawn_makes_nothing_else_that_is_lost_surer(lost):
    """The filter has one standard deviation for all: of an axis whose knock nothing draws, and of
    samples that are missing for long, it stays what it is.
    """
    usual = 1.0
    clipped, _ = cut(swung(4)[0], 0.9)
    assert 0.0 < drawn(clipped)[1] < usual
    gyro = clipped.gyro.copy()
    if lost == "samples":
        gyro[3000:3100] = np.nan
    else:
        knock = 8.0 * np.exp(-(((clipped.time - 15) / 0.1) ** 2))
        gyro[:, 1] = np.minimum(gyro[:, 1] + knock, 4.0)
    found, std = drawn(replace(clipped, gyro=gyro))
    assert std == usual and not np.array_equal(found.gyro[:, 0], gyro[:, 0], equal_nan=True)
