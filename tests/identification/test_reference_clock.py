"""The reference's clock: how late the sensor is by it, and whose lag that is."""

from dataclasses import replace

import numpy as np
import pytest
from effect_logs.cases import make
from effect_results.record import closed
from scipy.spatial.transform import Rotation, RotationSpline
from scipy.stats import chi2

import pyimu
from pyimu.identification.close import undeclared
from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.trials import accel_trial, gyro_trial
from pyimu.identification.reference.align import LONGEST_OWN, aligned, in_common
from pyimu.identification.reference.clock import _places, measure
from pyimu.identification.reference.moving import LEAST_ROWS
from pyimu.identification.reference.slips import placed_slips
from pyimu.identification.reference.track import WANDERS, level_of
from pyimu.identification.report.page import page
from pyimu.model.part_reader import parse_part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

H, SECONDS, NOISE = 0.01, 120.0, 2e-3
TIME = np.arange(0.0, SECONDS, H)


WHITE = f"""
name = "white"
sample_rate = {{value = {1 / H}, unit = "Hz"}}
[gyro.angle_random_walk]
N = {{value = {[NOISE * H**0.5] * 3}, unit = "rad/sqrt(s)"}}
"""


class Motion:
    """A rate (n, 3) rad/s at any time: sines up to 2 Hz."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.frequency = rng.uniform(0.1, 2.0, (3, 6))
        self.phase = rng.uniform(0, 2 * np.pi, (3, 6))
        self.size = rng.uniform(0.1, 0.4, (3, 6))

    def __call__(self, t):
        angle = 2 * np.pi * self.frequency * np.asarray(t)[:, None, None] + self.phase
        return np.sum(self.size * np.sin(angle), axis=2)


def log(late, seed=0, name="log", reference_noise=0.0):
    """A log whose gyro shows the motion ``late`` s, a number or (n,), after its reference."""
    rng, motion = np.random.default_rng(100 + seed), Motion(seed)
    gyro = motion(TIME - late) + NOISE * rng.standard_normal((len(TIME), 3))
    rate = motion(TIME) + reference_noise * rng.standard_normal((len(TIME), 3))
    return Recording.from_arrays(name=name, time=TIME, gyro=gyro, ref_rate=rate)


def seen(recording):
    return measure(gyro_trial(recording), Sensor("gyro"))


@pytest.mark.parametrize("late", [0.0, 2.1])
def test_a_log_held_apart_has_the_drift_of_its_own_clock(late):
    """A fitted log's is found by its fit. Beside 2.1 s a drift of 5 ms was too little of the lag to
    be its change; to five standard errors of 40 ppm.
    """
    drift = 4e-5
    apart = gyro_trial(log(late + drift * TIME, seed=1, name="apart"))
    _, held = aligned([gyro_trial(log(0.4))], [apart], Sensor("gyro"))
    slope, std = held.clock.skew
    assert slope == pytest.approx(drift, abs=5 * std) and std < drift / 5
    assert held.clock.at(TIME[-1:]) == pytest.approx(late + drift * TIME[-1], abs=2e-4)


LATE, OTHER = 4e-3, 12e-3


@pytest.mark.parametrize(
    ("fitted", "held", "own"),
    [([LATE], [], 0.0), ([LATE, LATE], [], LATE), ([LATE], [LATE], LATE), ([LATE], [OTHER], 0.0)],
)
def test_a_lag_beside_clocks_of_their_own_is_the_sensors_where_two_logs_have_it(fitted, held, own):
    """One log alone does not tell, and says so."""

    def trial(name, late, seed):
        return replace(gyro_trial(log(late, seed, name)), reference_apart=True)

    trials = [trial(f"fitted{k}", late, k) for k, late in enumerate(fitted)]
    apart = [trial(f"held{k}", late, 9 + k) for k, late in enumerate(held)]
    clock = aligned(trials, apart, Sensor("gyro"))[0].clock
    assert clock.own == pytest.approx(own, abs=5 * clock.std + 1e-4 * H)
    assert clock.own + clock.mean == pytest.approx(LATE, abs=5 * clock.std + 1e-4 * H)
    assert clock.or_sensor == (len(fitted) == 1 and not held)


FAST, SLOW, SET_ANEW = 0.02 * TIME, -0.01 * TIME, 0.6 * (TIME > 50.0)


@pytest.mark.parametrize("late", [FAST, SLOW, SET_ANEW, -SET_ANEW])
def test_a_clock_of_another_pace_or_set_anew_is_followed(late):
    """No single lag fits: over 2 % of two minutes the motion, of up to 2 Hz, is another. When it is
    set anew the samples show later, to a window of 12 s; elsewhere the lag is known to a tenth of
    a row.
    """
    clock = seen(log(late))
    known = np.abs(TIME - 50.0) > 12.0 if late is not SLOW and late is not FAST else TIME > 0.0
    inside = known & (TIME > 6.0) & (TIME < SECONDS - 6.0)
    assert clock.explained > 0.95
    assert np.abs(clock.at(TIME) - late)[inside].max() < 0.1 * H


SAWTOOTH = 8e-3 * ((TIME / 40.0) % 1.0)


@pytest.mark.parametrize("late", [0.0, -0.0025, -0.0125, -0.0225, 0.005, 0.02, 1.37, -1.37, 18.0])
def test_a_constant_lag_is_found_to_its_standard_error(late):
    """The slope by differences is short, which the rounds take out of the lag; interpolation adds
    1e-4 sample periods.
    """
    clock = seen(log(late))
    assert clock.keeps_step
    # Five standard errors are exceeded once in two million times.
    assert abs(clock.mean - late) < 5 * clock.std + 1e-4 * H
    assert clock.std < 1e-4 and clock.explained > 0.999


def test_a_clock_is_seen_by_moves_too_short_for_a_window_each():
    """Moves of 0.12 s every 3 s, each about another direction: a dozen rows in a window."""
    rng, late = np.random.default_rng(5), -0.024
    starts = np.arange(1.0, SECONDS - 2.0, 3.0)
    sizes = rng.standard_normal((len(starts), 3))

    def moves(t):
        within = np.clip((t[:, None] - starts) / 0.12, 0.0, 1.0)
        return (16.0 * within**2 * (1.0 - within) ** 2) @ sizes

    gyro = moves(TIME - late) + NOISE * rng.standard_normal((len(TIME), 3))
    clock = seen(Recording.from_arrays(name="moves", time=TIME, gyro=gyro, ref_rate=moves(TIME)))
    assert clock.std < 1e-3
    # Five standard errors, and a hundredth of a row: a parabola between rows misses such a bend.
    assert abs(clock.mean - late) < 5 * clock.std + 1e-2 * H


@pytest.mark.parametrize("late", [0.3, -0.3])
def test_a_lag_is_found_below_noise_larger_than_the_motion(late):
    """As attitudes of 0.2 deg at 100 Hz have it once they are differentiated. A window of 2.5 s
    knows the lag to 250 samples of noise over slopes of 5 rad/s^2: 9 ms.
    """
    clock = seen(log(late, reference_noise=0.7))
    assert clock.explained > 0.9 and np.abs(clock.at(TIME).mean() - late) < 5 * 0.009


def test_a_clock_that_slips_is_followed():
    clock = seen(log(SAWTOOTH))
    assert not clock.keeps_step
    inside = np.abs((TIME % 40.0) - 20.0) < 15.0
    error = clock.at(TIME)[inside] - SAWTOOTH[inside]
    assert np.sqrt(np.mean(error**2)) < 0.1 * np.sqrt(np.mean(SAWTOOTH**2))


@pytest.mark.parametrize("seed", range(3))
def test_the_instant_of_a_slip_is_that_of_the_samples(seed):
    """Three slips of a sample, two of them a few windows apart, beside clocks 1e-4 apart: what a
    slip of 10 ms leaves of this motion in two samples is 20 times the noise.
    """
    rng = np.random.default_rng(seed)
    first, apart = rng.uniform(15.0, 40.0), rng.uniform(9.0, 12.0)
    true = [first, first + apart, rng.uniform(70.0, 105.0)]
    steps = sum(size * (TIME >= t) for size, t in zip([-H, H, -H], true, strict=True))
    trial = gyro_trial(log(5e-3 + 1e-4 * TIME + steps, seed))
    clock = placed_slips(trial, measure(trial, Sensor("gyro")), Sensor("gyro"))
    assert np.allclose([s.time for s in clock.slips], true, atol=0.1), clock.slips
    assert all(a < t < b for t, (a, b) in zip(true, clock.unsure, strict=True))
    late, known = 5e-3 + 1e-4 * TIME + steps, np.ones(len(TIME), dtype=bool)
    for a, b in clock.unsure:
        known &= (TIME < a) | (TIME > b)
    assert np.abs(clock.at(TIME) - late)[known].max() < 0.1 * H


def eased(start, stop):
    x = np.clip(np.minimum(TIME - start, stop - TIME), 0.0, 1.0)
    return 0.5 - 0.5 * np.cos(np.pi * x)


def table():
    """A rate (n, 3) rad/s: one axis after another, a sine and constant rates to and fro."""
    out = np.zeros((len(TIME), 3))
    for k in range(3):
        sine, to, fro = (eased(40 * k + a, 40 * k + b) for a, b in ((1, 12), (14, 26), (28, 39)))
        out[:, k] = 1.5 * sine * np.sin(1.4 * np.pi * TIME) + 1.2 * to - fro
    return out


def test_a_large_slip_during_an_even_turn_is_known_to_lie_there():
    """Of the reference as it is on one side of the slip the rows on the other tell nothing, not
    even its axes and its size; an even turn from 55 to 65 s does not show when it slips.
    """
    rng, turned = np.random.default_rng(1), table()
    moved = np.where(TIME[:, None] > 61.0, np.roll(turned, 30, axis=0), turned)
    gyro = moved + NOISE * rng.standard_normal(moved.shape)
    rate = turned + 5 * NOISE * rng.standard_normal(moved.shape)
    trial = gyro_trial(Recording.from_arrays("log", time=TIME, gyro=gyro, ref_rate=rate))
    clock = placed_slips(trial, measure(trial, Sensor("gyro")), Sensor("gyro"))
    ((first, last),) = clock.unsure
    assert first < 61.0 < last < 66.0


@pytest.mark.long
def test_a_level_that_stands_still_is_rarely_said_to_wander():
    """Twice the gain of the walk is half chance zero and half chi-square on one degree (Self and
    Liang 1987): above 2 ``WANDERS`` with p = 0.00027, in 400 draws more than twice once in 5000.
    """
    assert WANDERS >= 6.0
    rng, time = np.random.default_rng(5), np.arange(0.0, 100.0, 2.5)
    levels = [level_of(time, 1e-3 * rng.standard_normal(40), np.full(40, 3e-4)) for _ in range(400)]
    assert sum(len(one.value) > 1 for one in levels) <= 2
    # Unknown up to a factor: the scatter tells the standard error, not what was claimed.
    np.testing.assert_allclose(
        [np.median([one.std for one in levels])], 1e-3 / np.sqrt(40), rtol=0.1
    )


def test_few_measurements_are_enough_for_a_steep_slope():
    """Few windows are enough for a slope of many standard errors, where a walk takes eight."""
    time, error = np.arange(5.0, 80.0, 12.0), 3e-4
    values = 5e-4 * time + error * np.random.default_rng(6).standard_normal(len(time))
    level = level_of(time, values, np.full(len(time), error))
    slope_std = error / (np.std(time) * np.sqrt(len(time)))
    assert abs(level.slope[0] - 5e-4) < 5 * slope_std


def test_few_measurements_rarely_make_a_slope():
    """By chance once in 3700 logs: in 400 draws more than twice once in 5000."""
    rng, time = np.random.default_rng(7), np.arange(6.0)
    levels = [level_of(time, rng.standard_normal(6), np.ones(6)) for _ in range(400)]
    assert sum(one.slope is not None for one in levels) <= 2


WINDOWS, SCATTER = np.arange(1.25, 100.0, 2.5), 3e-4


def levels(shape, count, seed):
    """What is found behind measurements of ``shape`` every 2.5 s with white errors."""
    rng = np.random.default_rng(seed)
    drawn = (shape(rng) + SCATTER * rng.standard_normal(len(WINDOWS)) for _ in range(count))
    return [level_of(WINDOWS, values, np.full(len(WINDOWS), SCATTER), 2e-3) for values in drawn]


def slewed(rng):
    return 1e-3 * np.clip(0.5 * (WINDOWS - 40.0), 0.0, 8.0)


def test_a_clock_that_is_slewed_is_followed():
    """As a daemon takes an offset out: 8 ms at 500 ppm. A line leaves 1.3 ms of it, and steps below
    a fifth of a row are none: a walk follows it, as do a few steps, to their own errors.
    """
    for one in levels(slewed, 20, 2):
        left = np.interp(WINDOWS, one.time, one.value) - slewed(None)
        assert np.sqrt(np.mean(left**2)) < 2 * SCATTER


def walk(rng):
    return np.cumsum(5e-4 * np.sqrt(2.5) * rng.standard_normal(len(WINDOWS)))


@pytest.mark.parametrize(
    "shape", [walk, lambda rng: 2e-3 * np.sin(WINDOWS / 15), lambda rng: 5e-5 * WINDOWS]
)
def test_a_level_that_does_not_step_is_rarely_said_to(shape):
    """Steps must gain ``WANDERS`` nat over the simpler laws, each at the price of its place, the
    logarithm of the number of measurements: by chance as often as exp(-6), 1 in 400. A walk may
    make one large step by itself; of 60 more than 6 steps are as many as of a law of 2 % once in
    3000 times.
    """
    assert sum(bool(one.steps) for one in levels(shape, 60, 1)) <= 6


def test_a_steady_drift_is_known_to_its_standard_error():
    """The sum of squares over 60 draws is chi-square, but for standard errors of 38 degrees."""
    found = levels(lambda rng: 5e-5 * WINDOWS, 60, 2)
    z = [(one.slope[0] - 5e-5) / one.slope[1] for one in found if one.slope and not one.steps]
    assert len(z) > 50
    assert chi2.ppf(1e-4, len(z)) < np.sum(np.square(z)) < 1.2 * chi2.ppf(1 - 1e-4, len(z))


@pytest.mark.parametrize("period", [30.0, 45.0])
def test_a_sawtooth_is_a_drift_with_steps_of_one_size(period):
    """A step within a window is found within the window, one between two within both."""
    phase = 0.4
    found = levels(lambda rng: 1e-2 * ((WINDOWS / period + phase) % 1.0), 20, 3)
    times = period * (np.arange(1, 5) - phase)
    times = times[times < WINDOWS[-1]]
    right = [one for one in found if len(one.steps) == len(times)]
    assert len(right) >= 18
    for one in right:
        np.testing.assert_allclose([s.time for s in one.steps], times, atol=2.5)
        # Five standard errors of the size of a step between stretches of ten windows or more.
        sizes = [s.size for s in one.steps]
        np.testing.assert_allclose(sizes, -1e-2, atol=5 * SCATTER * np.sqrt(3 / 10))
        assert one.slope[0] == pytest.approx(1e-2 / period, abs=5 * one.slope[1])


def test_a_step_that_comes_and_goes_is_a_fault_of_one_measurement():
    def one_off(rng):
        return 5e-3 * (np.arange(len(WINDOWS)) == 20)

    assert not any(one.steps for one in levels(one_off, 20, 4))


def test_slips_and_skew_are_figures_of_the_report():
    closed = pyimu.close(log(SAWTOOTH))
    (entry,) = closed.as_dict()["reference"]
    skew, slips = entry["clock_skew"], entry["slips"]
    assert abs(skew["value"] - 2e-4) < 5 * skew["std"] and skew["std"] < 1e-5
    # The fitted and held-out rows are measured together; 120 s hold the jumps at 40 and 80 s.
    np.testing.assert_allclose([s["time"] for s in slips], [40.0, 80.0], atol=0.1)
    np.testing.assert_allclose([s["size"] for s in slips], -8e-3, rtol=0.02)
    assert "slips 2 times by 8.0" in closed.remarks[0], closed.remarks
    assert "slips by 8.0" in page(closed) and "sensor late by" in page(closed)


def test_the_noise_of_a_rate_reference_is_given():
    """As noisy as the gyro: an estimate of a variance out of the difference of two."""
    closed = pyimu.close(log(0.0, 3, reference_noise=NOISE))
    noise = closed.references[0]["noise"]
    assert noise["unit"] == "rad/s"
    np.testing.assert_allclose(np.sqrt(np.mean(np.square(noise["value"]))), NOISE, rtol=0.2)


@pytest.mark.long
def test_a_noisy_slope_makes_neither_a_lag_nor_its_standard_error_small():
    """A slow motion seen by an attitude whose differences are mostly noise: the lag would be drawn
    to zero by the share of the noise in its slope, and its error with it. The sum of squares over
    16 draws is chi-square but for standard errors that some ten windows say, to a quarter.
    """
    z = []
    for seed in range(16):
        rng, late = np.random.default_rng(seed), 0.2
        angle = [0.6 * np.sin(2 * np.pi * 0.05 * (t + seed)) for t in (TIME, TIME - late)]
        turns = Rotation.from_rotvec(np.outer(angle[0], [0, 0, 1]))
        noisy = turns * Rotation.from_rotvec(0.01 * rng.standard_normal((len(TIME), 3)))
        gyro = np.gradient(angle[1], H)[:, None] * [0, 0, 1.0]
        seen_by = Recording.from_arrays(
            name="slow",
            time=TIME,
            gyro=gyro + NOISE * rng.standard_normal((len(TIME), 3)),
            ref_q=noisy.as_quat(scalar_first=True),
        )
        found = seen(seen_by)
        assert found.std < 0.1
        z.append((found.mean - late) / found.std)
    assert np.sum(np.square(z)) < 1.5**2 * chi2.ppf(1 - 1e-4, len(z))


@pytest.mark.long
def test_a_bias_that_changes_is_no_lag():
    """A table turns an accelerometer through gravity about one axis after another while its bias
    changes: what a window sees of that bends neither the clock nor the error that is given for it.
    The sum of squares over 16 draws is chi-square but for errors that some dozens of windows say.
    """
    z = []
    for seed in range(16):
        rng, third = np.random.default_rng(seed), len(TIME) // 3
        turns = np.zeros((len(TIME), 3))
        for k, axis in enumerate(rng.permutation(3)):
            at = slice(k * third, (k + 1) * third)
            turns[at, axis] = 1.5 * np.where(np.arange(third) < third / 2, 1.0, -1.0)
        attitude = np.cumsum(turns, axis=0) * H
        force = 9.8 * Rotation.from_rotvec(attitude).inv().as_matrix()[:, :, 2]
        bias = 0.015 * rng.choice([-1, 1], 3) * (TIME[:, None] > TIME[-1] * rng.uniform(0.2, 0.8))
        accel = force + bias + 0.017 * rng.standard_normal((len(TIME), 3))
        turning = Recording.from_arrays(name="table", time=TIME, accel=accel, ref_force=force)
        found = measure(accel_trial(turning, False), Sensor("accel"))
        assert len(found.late) == 1
        z.append(found.mean / found.std)
    assert np.sum(np.square(z)) < 1.5**2 * chi2.ppf(1 - 1e-4, len(z))


def on_a_table(seed, wander):
    """A force (n, 3) that gravity makes on axes that turn one after another, as an accelerometer
    shows it whose bias walks, ``wander`` s early and late of it over and over.
    """
    rng, time = np.random.default_rng(seed), np.arange(0.0, 300.0, H)
    axes, pace = rng.permutation(3), 2 * np.pi / rng.uniform(8, 20)

    def force(t):
        angle = np.zeros((len(t), 3))
        for k, axis in enumerate(axes):
            angle[:, axis] = np.pi / 3 * (1 - np.cos(pace * np.clip(t - 100.0 * k, 0.0, 100.0)))
        return 9.8 * Rotation.from_euler("xyz", angle).inv().as_matrix()[:, :, 2]

    late = wander * np.sin(2 * np.pi * time / 80.0)
    walk = 1e-4 * np.sqrt(H) * np.cumsum(rng.standard_normal((len(time), 3)), axis=0)
    accel = force(time - late) + walk + 0.012 * rng.standard_normal((len(time), 3))
    return Recording.from_arrays(name="table", time=time, accel=accel, ref_force=force(time))


@pytest.mark.long
def test_a_lag_wanders_only_where_that_explains_the_samples():
    """A tenth of a sample is twenty times its standard error in a window here. The cases of the
    table are three of 24 in which windows alone had taken a bias that walks for such a lag.
    """
    for seed in range(3):
        (trial,) = aligned([accel_trial(on_a_table(seed, 1e-3), False)], [], Sensor("accel"))
        clock = trial.clock
        assert not clock.keeps_step
        off = clock.late - 1e-3 * np.sin(2 * np.pi * clock.time / 80.0)
        assert np.sqrt(np.mean(off**2)) < 3 * clock.std < 1e-3 / 3
    for number in (100, 108, 114):
        made = make("clean/table", number, (5.0, 8.0))
        (columns,) = made.logs
        trial = accel_trial(Recording.from_arrays("table", **columns), False)
        sensor = parse_part(made.part, "case.toml").accel
        assert not measure(trial, sensor).keeps_step
        (trial,) = aligned([trial], [], sensor)
        assert trial.clock.keeps_step


def test_without_motion_there_is_no_clock():
    still = Recording.from_arrays(
        name="still",
        time=TIME,
        gyro=NOISE * np.random.default_rng(1).standard_normal((len(TIME), 3)),
        ref_rate=np.zeros((len(TIME), 3)),
    )
    assert seen(still) is None


def clock(*late, std=1e-5):
    return Clock(np.arange(len(late), dtype=float), np.array(late), std, 1.0)


@pytest.mark.parametrize(
    "clocks, own",
    [
        ([clock(4.2e-3)], 4.2e-3),
        ([clock(4.2e-3), clock(4.3e-3)], 4.25e-3),
        ([clock(4.2e-3), clock(8e-3)], 0.0),
        ([clock(-4.2e-3)], 0.0),
        ([clock(-4.2e-3), clock(4.2e-3)], 0.0),
        ([clock(4.2e-3), clock(4e-3, 5e-3)], 0.0),
        ([clock(4.2e-3), clock(2e-3, std=1e-3)], 4.2e-3),
        ([clock(4.2e-3), clock(0.0, std=1e-3)], 0.0),
        ([clock(4e-5), clock(3e-5)], 0.0),
        ([clock(6e-5), clock(4e-5)], 5e-5),
        ([clock(1.1 * LONGEST_OWN)], 0.0),
        ([clock(4.2e-3, std=1e-3)], 0.0),
        ([], 0.0),
    ],
)
def test_a_lag_may_be_the_sensors_where_all_logs_have_it_and_it_is_late(clocks, own):
    assert in_common(clocks) == pytest.approx(own, rel=1e-3)


@pytest.mark.parametrize("late", [-0.0025, -0.0125, -0.0225, H / 2 - H, 1.37, SAWTOOTH])
def test_a_clock_is_no_effect_of_the_sensor(late):
    """Its error on held-out rows is that of the same log without the clock's error: white noise."""
    closed = pyimu.close(log(late))
    assert not closed.added, closed.report()
    (found,) = [f for f in closed.quality if f.kind == "reference_clock"]
    assert found.detail["least_late"] < np.max(late) + 1e-4
    assert found.detail["most_late"] > np.min(late) - 1e-4
    reached = closed.errors["gyro"].after.total / NOISE
    # Held-out rows of three axes; a slipping clock is known to within its windows only.
    assert reached < (1.05 if np.ndim(late) == 0 else 1.5)


@pytest.mark.parametrize("drift", [2e-6, -2e-6, 5e-5, -5e-5, 5e-4])
def test_a_clock_that_runs_is_the_references_and_its_drift_is_known(drift):
    """The rows that were fitted say how fast, weighed as the model weighs them."""
    closed = pyimu.close(log(drift * TIME, 4))
    assert not closed.added, closed.report()
    assert closed.verdict in ("clean", "undecidable")
    skew = closed.references[0]["clock_skew"]
    # The white noise alone, by the motion's rate over the fitted 70 % of the log.
    rate = np.gradient(Motion(4)(TIME), TIME, axis=0)[: int(0.7 * len(TIME))]
    since = TIME[: len(rate)] - TIME[: len(rate)].mean()
    std = NOISE / np.sqrt(np.sum((rate * since[:, None]) ** 2))
    assert abs(skew["value"] - drift) < 5 * std
    assert skew["std"] == pytest.approx(std, rel=0.1)
    assert closed.errors["gyro"].after.total / NOISE < 1.02


def test_lags_that_differ_from_log_to_log_are_the_clocks():
    closed = pyimu.close([log(0.004, 1, "a"), log(0.016, 2, "b")])
    assert not closed.added, closed.report()
    lates = [r.log_state["gyro"]["reference"]["clock"]["late"] for r in closed.recordings]
    np.testing.assert_allclose(lates, [0.004, 0.016], atol=1e-4)


def test_a_lag_that_all_logs_share_is_the_sensors_with_the_clock_beside_it():
    closed = pyimu.close([log(0.0085, 1, "a"), log(0.0085, 2, "b")])
    (added,) = closed.added
    named = {added.effect, *added.alternatives}
    assert named == {"time_delay", "lag", "first_order_lag"} and "clock" in added.note
    clocks = [r.log_state["gyro"]["reference"]["clock"] for r in closed.recordings]
    assert all(c["left_to_sensor"] == pytest.approx(0.0085, abs=1e-4) for c in clocks)


@pytest.mark.long
@pytest.mark.parametrize("name", ["gyro.time_delay", "gyro.lag", "accel.time_delay"])
def test_a_delay_that_one_of_two_logs_shows_is_named(name):
    """Beside a rover's log one of a table whose turns show little of it; and the drift of the
    rover's clock, 4.8e-8 of a standard error of 3e-8, carried on to the held-out rows.
    """
    found = closed(make(f"together/8/{name}", 0, (6.0, 9.0)))
    assert [a.effect for a in found.added] == ["time_delay"], found.report()


@pytest.mark.parametrize(
    "share",
    [pytest.param(0.05, marks=pytest.mark.long), 0.1, pytest.param(0.2, marks=pytest.mark.long)],
)
def test_a_little_noise_of_the_reference_is_no_dead_zone(share):
    """A zone as wide as that noise would smooth it where nothing turns: half a nat in a row for
    each share of the variance.
    """
    rng, motion = np.random.default_rng(9), Motion(3)

    def turns(t):
        eased = np.clip(np.sin(2 * np.pi * t / 20.0), 0.0, 1.0) ** 2
        return eased[:, None] * motion(t)

    gyro = turns(TIME + 0.5 * H) + NOISE * rng.standard_normal((len(TIME), 3))
    rate = turns(TIME) + share * NOISE * rng.standard_normal((len(TIME), 3))
    recording = Recording.from_arrays(name="log", time=TIME, gyro=gyro, ref_rate=rate)
    closed = pyimu.close(recording, part=parse_part(WHITE, "white.toml"))
    assert not closed.added, closed.report()


@pytest.mark.long
def test_a_noisy_reference_is_no_lag():
    """As noisy as the gyro: interpolation would smooth it, and win likelihood."""
    closed = pyimu.close(log(0.0, 3, reference_noise=NOISE))
    assert not closed.added, closed.report()


def attitude_log(name, seed, mounting, rest):
    """A gyro 8 ms late behind an optical attitude, which rests for ``rest`` s first."""
    rng, motion = np.random.default_rng(seed), Motion(seed)
    h = 0.005
    t = np.arange(0.0, 100.0 + rest, h)
    fade = np.clip((t - rest) / 2.0, 0.0, 1.0)[:, None]
    angles = 0.3 * fade * motion(t)
    spline = RotationSpline(t, Rotation.from_rotvec(angles))
    gyro = mounting.apply(spline(np.maximum(t - 0.008, 0.0), 1))
    gyro += NOISE * rng.standard_normal((len(t), 3)) + [0.01, -0.02, 0.005]
    optical = Rotation.from_rotvec(1e-4 * rng.standard_normal((len(t), 3))) * spline(t)
    return Recording.from_arrays(
        name=name, time=t, gyro=gyro, ref_q=optical.as_quat(scalar_first=True)
    )


@pytest.mark.long
def test_a_held_out_log_that_begins_at_rest_confirms_the_delay():
    """Its mounting and bias come from rows that move; a rest shows neither."""
    mounting = Rotation.from_euler("xyz", [20, -35, 100], degrees=True)
    closed = pyimu.close(
        attitude_log("a", 1, mounting, 0.0), holdout=attitude_log("b", 2, mounting, 40.0)
    )
    assert [a.effect for a in closed.added] == ["time_delay"], closed.report()
    rate = closed.errors["gyro"]
    assert rate.after.total < 0.3 * rate.before.total
    held = np.array(closed.recordings[1].log_state["gyro"]["rotation"])
    assert Rotation.from_matrix(held.T @ mounting.as_matrix()).magnitude() < 0.01


def test_gravity_that_is_turned_in_the_bodys_axes_has_no_lag():
    """Its size stays, and so did what was compared: a bias that moved with temperature looked like
    a lag of 12 s.
    """
    made = make("size1/accel.thermal_bias_cubic", 400, (5.0, 9.0))
    recording = Recording.from_arrays("turned", **made.logs[0])
    clock = measure(accel_trial(recording, False), Sensor("accel"))
    assert np.abs(clock.at(recording.time)).max() < H
    assert clock.explained > 0.99


def test_a_reference_of_another_body_is_unfit():
    own = log(0.0, 4)
    other = Recording.from_arrays(name="x", time=TIME, gyro=own.gyro, ref_rate=Motion(99)(TIME))
    closed = pyimu.close(other)
    assert closed.verdict == "reference_unfit" and not closed.added, closed.report()
    # Nothing that was fitted to another body's motion is shown, and no noise is read off it.
    assert not [v for v in closed.estimated if v.origin != "declared"]
    assert not closed.candidates and closed.errors["gyro"].floor is None
    assert not closed.after.gyro.values and "times" not in closed.report()


def test_times_in_milliseconds_are_said():
    own = log(0.0, 4)
    late = Recording.from_arrays(name="ms", time=1e3 * TIME, gyro=own.gyro, ref_rate=own.ref_rate)
    with pytest.raises(pyimu.UserError, match=r"ms: a row every 10 s.*time \[ms\]"):
        pyimu.close(late)


@pytest.mark.long
def test_a_sensor_that_warms_up_beside_a_reference_at_rest_has_no_unfit_reference():
    """Its bias follows the temperature; the reference says truly that nothing turned."""
    rng, temperature = np.random.default_rng(7), 25 + 8 * np.sin(2 * np.pi * TIME / 60)
    gyro = NOISE * rng.standard_normal((len(TIME), 3)) + 1e-3 * (temperature - 25)[:, None]
    still = Recording.from_arrays(
        name="table",
        time=TIME,
        gyro=gyro,
        ref_rate=np.zeros((len(TIME), 3)),
        temperature=temperature,
    )
    closed = pyimu.close(still)
    assert closed.verdict == "named", closed.report()
    assert [a.effect for a in closed.added] == ["thermal_bias"]


def test_coefficients_of_an_axis_that_does_not_move_stay_where_they_are_typical():
    """One axis of motion: what it does not show of a part that nobody declared is left."""
    from pyimu.model.typical import magnitudes

    rng = np.random.default_rng(6)
    rate = Motion(6)(TIME) * [0.0, 0.0, 1.0]
    gyro = rate * 1.01 + NOISE * rng.standard_normal((len(TIME), 3))
    reference = rate + 1e-4 * rng.standard_normal((len(TIME), 3))
    closed = pyimu.close(
        Recording.from_arrays(name="pendulum", time=TIME, gyro=gyro, ref_rate=reference)
    )
    s, m = (
        closed.after.gyro.values[e][p] for e, p in (("scale_factor", "s"), ("misalignment", "m"))
    )
    assert s[2] == pytest.approx(0.01, abs=1e-3)
    most = [3 * magnitudes(e, "gyro")["consumer"].si for e in ("scale_factor", "misalignment")]
    assert np.abs(s[:2]).max() < most[0] and np.abs(m).max() < most[1]
    assert closed.errors["gyro"].after.total < 1.05 * NOISE


# References that are not what they say


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (np.diag([1.0, 1.0, -1.0]), "mirrored axes"),
        (np.degrees(1.0) * np.eye(3), "too large by 57.3"),
        (np.radians(1.0) * np.eye(3), "too small by 57.3"),
        (2.0 * np.eye(3), "too large by 2.00: it, or the gyro, has another unit"),
        (0.1 * np.eye(3), "too small by 10.0"),
    ],
)
def test_a_reference_of_other_axes_or_units_is_said(change, said):
    rng, motion = np.random.default_rng(3), Motion(3)
    gyro = motion(TIME) + NOISE * rng.standard_normal((len(TIME), 3))
    closed = pyimu.close(
        Recording.from_arrays(name="log", time=TIME, gyro=gyro, ref_rate=motion(TIME) @ change)
    )
    assert closed.verdict == "reference_unfit" and said in closed.reason, closed.report()
    assert said in closed.report()


@pytest.mark.parametrize(
    ("misread", "said"),
    [
        (np.degrees, "too large by 57.3"),
        (np.negative, "counts the other way"),
        (np.zeros_like, "stands still while the gyro goes"),
    ],
)
def test_a_heading_of_other_units_or_sign_is_said(misread, said):
    rng, rate = np.random.default_rng(7), Motion(7)(TIME) * [0.0, 0.0, 1.0]
    heading = H * np.cumsum(rate[:, 2]) + 1e-3 * rng.standard_normal(len(TIME))
    gyro = rate + NOISE * rng.standard_normal((len(TIME), 3))
    closed = pyimu.close(
        Recording.from_arrays(name="log", time=TIME, gyro=gyro, ref_heading=misread(heading))
    )
    assert closed.verdict == "reference_unfit" and said in closed.reason, closed.report()


@pytest.mark.parametrize("gyro", [NOISE, 0.0])
def test_a_gyro_that_stands_still_beside_its_reference_is_said(gyro):
    noise = gyro * np.random.default_rng(8).standard_normal((len(TIME), 3))
    closed = pyimu.close(
        Recording.from_arrays(name="log", time=TIME, gyro=0.01 + noise, ref_rate=Motion(8)(TIME))
    )
    assert closed.verdict == "reference_unfit", closed.report()
    assert "the gyro of log stands still while the reference goes" in closed.reason


@pytest.mark.parametrize(
    ("misread", "said"),
    [
        (lambda q: np.roll(q, -1, axis=1), "scalar last"),
        (lambda q: q * [1.0, -1.0, -1.0, -1.0], "world to body"),
    ],
)
def test_a_quaternion_in_another_order_is_said(misread, said):
    """The attitude turns through more than half a turn, so that no constant mounting stands for the
    order.
    """
    log_of = attitude_log("a", 1, Rotation.from_euler("xyz", [10, 20, 30], degrees=True), 0.0)
    closed = pyimu.close(replace(log_of, ref_q=misread(log_of.ref_q)))
    assert closed.verdict == "reference_unfit", closed.report()
    assert any(said in remark for remark in closed.remarks), closed.remarks


def test_a_row_between_two_gaps_has_no_slope_and_stops_nothing():
    whole = gyro_trial(log(0.005))
    alone = replace(whole, segments=[(0, 6000), (6500, 6501), (7000, len(TIME))])
    clock = measure(alone, Sensor("gyro"))
    assert abs(clock.mean - 0.005) < 5 * clock.std + 1e-4 * H


@pytest.mark.parametrize("number", range(3))
def test_what_an_effect_does_is_no_clock_that_wanders(number):
    """An accelerometer that rests about zero for long shows its asymmetry as steps, which look like
    lags of some tenths of a millisecond where the mean of the lags is held at theirs.
    """
    made = make("one/30/accel.bias_asymmetry", 11 + number, (6.0, 9.0))
    log = pyimu.Recording.from_arrays("log", **made.logs[0])
    (kept,) = aligned([accel_trial(log, False)], [], undeclared(100.0).accel)
    assert kept.clock.keeps_step and not kept.clock.taken_out


@pytest.mark.long
def test_a_walk_larger_than_declared_is_no_noise_of_the_reference():
    """80 times on one axis: it follows many a slow input by chance, and is said as what it is."""
    found = closed(make("size1/gyro.rate_random_walk", 120, (6.0, 9.0)))
    assert found.verdict == "drift", found.report()
    (found,) = [c for c in found.changed if (c.sensor, c.parameter) == ("gyro", "K")]
    assert 40 < found.fitted[0] / found.declared[0] < 160


def test_a_small_drift_is_taken_out_whatever_the_mean_lag():
    """0.5 ppm over eight minutes, a gain of 12 nat beside the mean lag, which is seen, too."""
    made = make("one/12/accel.clock_skew", 120, (6.0, 9.0))
    found = closed(made)
    assert not found.added and found.verdict != "unexplained", found.report()
    (clock,) = [f.detail for f in found.quality if f.kind == "reference_clock"]
    drift = (clock["most_late"] - clock["least_late"]) / made.logs[0]["time"][-1]
    assert drift == pytest.approx(float(made.truths[0].value), rel=0.5)


@pytest.mark.long
def test_what_a_lever_does_is_no_clock_that_wanders():
    """It bends the lags by tenths of a millisecond, to and fro, as rates and their changes go."""
    found = closed(make("size1/accel.size_effect", 121, (6.0, 9.0)))
    assert [a.effect for a in found.added] == ["size_effect"], found.report()
    assert not any(f.kind == "reference_clock" for f in found.quality)


def test_windows_grow_until_half_of_the_rows_are_in_one():
    """Of moves of a few rows each, far apart: all are in the last window at the latest."""
    few = np.concatenate([100.0 * k + H * np.arange(LEAST_ROWS // 2) for k in range(4)])
    assert _places(few, 1.0) == [(0, LEAST_ROWS)]
    assert _places(few[:LEAST_ROWS], 1.0) == [(0, LEAST_ROWS)]
    assert _places(H * np.arange(4 * LEAST_ROWS), 2 * H * LEAST_ROWS) == [
        (0, 2 * LEAST_ROWS),
        (2 * LEAST_ROWS, 4 * LEAST_ROWS),
    ]


def test_a_bent_response_to_steps_of_a_table_is_no_clock_that_wanders():
    """A scale factor that bends by 0.4 % is late at each step from rate to rate by another amount,
    up to 9 ms: as windows of it see it, a clock that wanders.
    """
    rates = np.radians([0, 10, -10, 30, -30, 60, -60, 100, -100, 150, -150, 200, -200, 250, -250])
    at = np.repeat(np.arange(len(rates)), 2) * 10.0 + np.tile([0.0, 7.0], len(rates))
    time = np.arange(0.0, at[-1], H)
    true = np.interp(time, at, np.repeat(rates, 2))[:, None] * [0.0, 0.0, 1.0]
    noise = NOISE * np.random.default_rng(5).standard_normal(true.shape)
    bent = 4e-3 / np.radians(300.0)
    gyro = true + bent * true**2 + noise
    closed = pyimu.close(Recording.from_arrays("table", time=time, gyro=gyro, ref_rate=true))
    assert [a.effect for a in closed.added] == ["scale_factor_nonlinearity"], closed.report()
    assert not any(f.kind == "reference_clock" for f in closed.quality)
    (one,) = closed.added
    value, std = (v[2] for v in one.parameters["s2"][:2])
    assert abs(value - bent) < 4 * std, (value, std)
