"""Rest that the unit finds by itself: its statistic, its threshold, and the stops of a drive."""

import casadi as ca
import numpy as np
import pytest
from navigation_cases import SHORT, assumed, calibrated, white
from scipy.stats import chi2

from pyimu.ins import run, strapdown_ins
from pyimu.ins.detector import FALSE_ALARM, WINDOW
from pyimu.ins.filter import prediction, rest_window
from pyimu.ins.filter.layout import Layout
from pyimu.recording.clock import runs
from pyimu.rover.trajectory import motion, stop_times

H = 0.01


@pytest.fixture(scope="module")
def layout():
    return Layout(white(calibrated()), detects=True)


@pytest.fixture(scope="module")
def step(layout):
    """``memory, rate, force, lost -> memory, mean, alike``."""
    p = np.array([v.start for v in layout.parameters])
    settings = prediction.settings_of(layout, ca.SX(ca.DM(p)))
    names = (("m", rest_window.SIZE), ("r", 3), ("f", 3), ("l", 1))
    arguments = [ca.SX.sym(name, size) for name, size in names]
    found = rest_window.followed(*arguments, settings, H)
    return ca.Function("step", arguments, [found.memory, found.mean, found.alike])


def stds(layout):
    sensors = (layout.part.gyro, layout.part.accel)
    return [s.values["angle_random_walk"]["N"] / np.sqrt(H) for s in sensors]


def test_a_window_is_at_rest_where_the_likelihood_ratio_says_so(layout, step):
    """Against sums over the very rows, and the chi-square quantile itself; where the two are
    closer than the approximation of the quantile is, neither is asked."""
    rng, n = np.random.default_rng(0), 3000
    std = np.concatenate(stds(layout))
    # noisier and noisier, so that windows pass at first and later do not
    grown = np.linspace(0.9, 1.6, n)[:, None]
    x = np.array([0.01, 0.02, -0.01, 0.3, -0.2, 9.7]) + grown * std * rng.standard_normal((n, 6))
    memory, seen = np.zeros(rest_window.SIZE), []
    rows = round(WINDOW / rest_window.SLOTS / H)
    for k, row in enumerate(x):
        memory, mean, alike = (np.array(v).ravel() for v in step(memory, row[:3], row[3:], 0.0))
        size = (rest_window.SLOTS - 1) * rows + k % rows + 1
        if k + 1 < size:
            assert not alike
            continue
        inside = x[k + 1 - size : k + 1] / std
        squares = np.sum((inside - inside.mean(axis=0)) ** 2)
        gate = chi2.isf(FALSE_ALARM, 6 * (size - 1))
        near = np.sum((inside[-1] - inside[:-1].mean(axis=0)) ** 2)
        outlier = chi2.isf(FALSE_ALARM, 6) * (1 + 1 / (size - 1))
        np.testing.assert_allclose(mean, inside.mean(axis=0)[:3] * std[:3], rtol=1e-9)
        if abs(squares / gate - 1) > 2e-3 and abs(near / outlier - 1) > 0.1:
            assert bool(alike) == (squares <= gate and near <= outlier)
            seen.append(bool(alike))
    assert 0.2 < np.mean(seen) < 0.8


@pytest.mark.parametrize(("n", "off"), ((10, 4e-3), (30, 1e-3), (100, 1e-3)))
def test_the_threshold_is_the_quantile_of_chi_square(n, off):
    """Wilson and Hilferty 1931, as good as is said of it."""
    found = float(ca.evalf(rest_window._threshold(ca.SX(n))))
    assert found == pytest.approx(chi2.isf(FALSE_ALARM, 6 * (n - 1)), rel=off)


def test_a_lost_sample_empties_the_window(layout, step):
    memory = np.ones(rest_window.SIZE)
    after = np.array(step(memory, np.zeros(3), np.zeros(3), 1.0)[0]).ravel()
    assert not after.any()


def test_it_finds_the_stops_of_a_drive_a_window_after_they_begin():
    truth = motion(SHORT)
    log = assumed().specimen(4).simulate(truth, seed=4)
    found = run(log, assumed(), method="filter", zupt="live")
    at, slot = found.time, WINDOW / rest_window.SLOTS
    long = [(at[a], at[b - 1]) for a, b in runs(found.still) if b - a > 20]
    stops = stop_times(SHORT)
    assert len(long) == len(stops)
    for (begin, end), (start, stop) in zip(long, stops, strict=True):
        # full after nine to ten of its parts; a slow end of a motion is lost in noise, for less
        # than a window
        late = begin - max(start, at[0])
        assert -slot < late < 2 * WINDOW
        assert abs(end - min(stop, at[-1])) < WINDOW
    assert found.errors["filter"].end < 1.0
    assert found.settings["detect"] == 1.0
    # that at the start is found a window late, and is none of them
    assert len(found.later_stops) == len(stops) - 1 == len(found.first_zupts)


def test_a_steady_turn_without_vibration_is_none():
    """Even rate and force, 45 deg/s after a rest: only the mean of the rate tells it."""
    part = white(calibrated())
    unit, n = strapdown_ins(part, nhc=False), 1500
    rng = np.random.default_rng(2)
    u = np.tile(unit.start_inputs, (n, 1))
    u[:, 2] = np.radians(45) * np.clip((np.arange(n) - 700) / 50, 0, 1)
    for i, sensor in enumerate((part.gyro, part.accel)):
        std = sensor.values["angle_random_walk"]["N"] / np.sqrt(H)
        u[:, 3 * i : 3 * i + 3] += std * rng.standard_normal((n, 3))
    y, _ = unit.run(u)
    rest = y[:, [v.name for v in unit.outputs].index("at_rest")]
    assert rest[50:690].all() and not rest[760:].any()


def test_where_stationary_says_all_nothing_is_found():
    unit = strapdown_ins(white(calibrated()), nhc=False)
    u = np.tile(unit.start_inputs, (100, 1))
    p = unit.start.copy()
    p[[v.name for v in unit.parameters].index("detect")] = 0.0
    at = [v.name for v in unit.outputs].index("at_rest")
    assert not unit.run(u, p=p)[0][:, at].any()
    assert unit.run(u)[0][60:, at].all()


def driven(part, pushes, seconds, seed):
    """What the unit makes of a part's noise and ``pushes`` (start s, seconds, m/s^2) along x, as
    raised cosines: its outputs by name, the true speed (n,) m/s.
    """
    unit, time = strapdown_ins(part, nhc=False), H * np.arange(round(seconds / H))
    rng, u = np.random.default_rng(seed), np.tile(strapdown_ins(part).start_inputs, (len(time), 1))
    push = np.zeros(len(time))
    for start, long, size in pushes:
        t = (time - start) / long
        push += np.where((t > 0) & (t < 1), size / 2 * (1 - np.cos(2 * np.pi * t)), 0.0)
    u[:, 3] += push
    for i, sensor in enumerate((part.gyro, part.accel)):
        std = sensor.values["angle_random_walk"]["N"] / np.sqrt(H)
        u[:, 3 * i : 3 * i + 3] += std * rng.standard_normal((len(time), 3))
    y, _ = unit.run(u)
    names = [v.name for v in unit.outputs]
    return time, {name: y[:, i] for i, name in enumerate(names)}, np.cumsum(push) * H


SUDDEN, GENTLE = 0.8, 4.0
"""s; of the pushes that give 0.4 m/s."""


SEEDS = (0, *(pytest.param(seed, marks=pytest.mark.long) for seed in (1, 2, 3)))


@pytest.mark.parametrize("long", (SUDDEN, GENTLE))
@pytest.mark.parametrize("seed", SEEDS)
def test_a_speed_that_comes_and_goes_is_no_rest(long, seed):
    """A window of 0.3 s does not show the gentle push, and nothing does the speed itself. Left out
    are the slow ends: a push of less than 0.06 m/s^2, 5.3 times what a rest's force may change by
    and noise, is not seen, and that is 0.04 m/s of the raised cosine.
    """
    size = 2 * 0.4 / long
    at, after = 8.0 + long, 8.0 + long + 6.0
    pushes = [(8.0, long, size), (after, long, -size)]
    time, y, speed = driven(white(calibrated()), pushes, after + long + 6.0, seed)
    rest = y["at_rest"] > 0.5
    assert not rest[speed > 0.08].any()
    assert rest[50:750].all() and rest[time > after + long + WINDOW + 1.0].mean() > 0.95
    cruise = (time > at) & (time < after)
    off = np.abs(y["velocity[1]"] - 0.4)
    assert np.all((off < 0.04 + 4 * y["velocity_std[1]"])[cruise])
    off = y["position[1]"][-1] - speed.sum() * H
    assert abs(off) < 4 * y["position_std[1]"][-1]


@pytest.mark.parametrize("seed", SEEDS)
def test_a_blow_keeps_no_later_rest_out(seed):
    """0.3 m/s by the accelerometer, which misses the other half of the blow: the body rests. At
    most the rest in which it was is lost, as after the next motion the speed is not known so well.
    """
    pushes = [(8.0, 0.1, 6.0), (14.0, 0.8, 1.0), (20.0, 0.8, -1.0)]
    time, y, _ = driven(white(calibrated()), pushes, 90.0, seed)
    assert (y["at_rest"] > 0.5)[time > 85.0].all()


def test_a_force_that_stays_another_is_a_rest_again():
    """By 0.1 m/s^2 within 2 s, which the gyro does not show: a push, and after two minutes none."""
    part = white(calibrated())
    unit, n = strapdown_ins(part, nhc=False), 15000
    u = np.tile(unit.start_inputs, (n, 1))
    u[:, 3] += 0.1 * np.clip((np.arange(n) - 800) / 200, 0, 1)
    rng = np.random.default_rng(1)
    for i, sensor in enumerate((part.gyro, part.accel)):
        std = sensor.values["angle_random_walk"]["N"] / np.sqrt(H)
        u[:, 3 * i : 3 * i + 3] += std * rng.standard_normal((n, 3))
    rest = unit.run(u)[0][:, [v.name for v in unit.outputs].index("at_rest")] > 0.5
    assert rest[50:800].all() and not rest[1000:12500].any() and rest[13500:].all()
