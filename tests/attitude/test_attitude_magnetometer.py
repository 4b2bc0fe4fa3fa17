"""The magnetometer in the attitude filter: its heading converges and is honest, a disturbance is
rejected and said, a new field is learnt.

The world is made by numpy and scipy alone.
"""

from dataclasses import replace

import numpy as np
import pytest
from attitude_cases import (
    GRAVITY,
    N_ACCEL,
    H,
    K,
    N,
    attitude_after,
    inputs,
    output,
    parameters,
    part,
)
from scipy.spatial.transform import Rotation
from scipy.stats import binom, chi2, norm

import pyimu
from pyimu.attitude import attitude_ukf, run
from pyimu.recording.quality.field_axes import field_findings
from pyimu.recording.recording import Recording
from pyimu.units import parse

FIELD = np.array([0.0, 19e-6, -45e-6])
"""T; east, north, up, of a dip of 67 degrees."""

ROWS, RUNS = 4000, 40
STD0 = np.array([0.01, 0.01, 0.5, 2e-3, 2e-3, 2e-3])
NOISE, LASTING, TURNING = 5e-8, 3e-7, 1e-6
SETTINGS = {
    "accel_std": 0.0,
    "accel_correlation_time": 0.0,
    "field_noise": NOISE,
    "field_std": LASTING,
    "field_turning_std": TURNING,
}
DISTURBED = 256


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


class World:
    """A body that turns in place by hand, and what its sensors show of one draw of their errors."""

    def __init__(self, seed: int, rows: int = ROWS, still: int = 0) -> None:
        self.rng, self.rows = np.random.default_rng(seed), rows
        t = np.arange(rows)[:, None, None] * H
        omega, phase = self.rng.uniform(0.5, 2.5, (3, 2)), self.rng.uniform(0, 2 * np.pi, (3, 2))
        self.rate = np.sum(0.7 * np.sin(omega * t + phase), axis=2)
        self.rate[:still] = 0
        self.attitude = Rotation.from_euler("z", self.rng.uniform(-3, 3)) * attitude_after(
            self.rate
        )
        normal = self.rng.standard_normal
        bias = STD0[3:] * normal(3) + K * np.sqrt(H) * np.cumsum(normal((rows, 3)), axis=0)
        self.gyro = self.rate + bias + N / np.sqrt(H) * normal((rows, 3))
        self.accel = self.attitude.apply([0, 0, GRAVITY], inverse=True)
        self.accel += N_ACCEL / np.sqrt(H) * normal((rows, 3))
        self.start = self.attitude[0] * Rotation.from_rotvec(STD0[:3] * normal(3)).inv()

    def mag(self, field=FIELD, turning: float = 0.0, lasting: float = 0.0) -> np.ndarray:
        """The magnetometer (n, 3) in a field (3,) or (n, 3), with a bias and a world of its own."""
        normal = self.rng.standard_normal
        field = field + [lasting * normal(), 0, 0]
        seen = self.attitude.apply(field, inverse=True) + turning * normal(3)
        return seen + NOISE / np.sqrt(H) * normal((self.rows, 3))

    def run(self, block, mag, **more):
        """Outputs of the filter, which starts with an error of ``STD0``."""
        u = inputs(self.rows, gyro=self.gyro, accel=self.accel, mag=mag)
        q0 = self.start.as_quat(scalar_first=True)
        p = parameters(block, **(SETTINGS | {"q0": q0, "std0": STD0} | more))
        return block.run(u, p=p)[0]

    def heading_error(self, block, y) -> np.ndarray:
        """Error (n,) rad about the vertical."""
        q = Rotation.from_quat(output(block, y, "q"), scalar_first=True)
        return (self.attitude * q.inv()).as_rotvec()[:, 2]


def nees(block, rows, make, **more) -> np.ndarray:
    """Normalised heading errors squared (RUNS, len(rows)) at ``rows``."""
    found = []
    for seed in range(RUNS):
        world = World(seed)
        y = world.run(block, make(world), **more)
        found.append((world.heading_error(block, y) / output(block, y, "heading_std"))[rows] ** 2)
    return np.array(found)


def test_heading_converges_to_the_truth(block):
    """From half a radian off to what is claimed, far less; without a field it stays off."""
    world = World(101)
    y = world.run(block, world.mag(), field_std=0, field_turning_std=0)
    off, std = world.heading_error(block, y), output(block, y, "heading_std")
    assert abs(off[-1]) < 4 * std[-1] < 0.02
    alone = world.run(block, 0.0)
    assert output(block, alone, "heading_std")[-1] > 0.4


LEVEL = 0.0005
"""Probability of a bound of a statistic on either side."""


def test_heading_is_honest_with_what_lasts_of_the_field(block):
    """The field's lasting angle is the larger part of the error, and no sample tells it from yaw.
    Its draws are quantiles of its distribution, so that the mean of their squares is 1.
    """
    draws = iter(norm.ppf((np.arange(RUNS) + 0.5) / RUNS))

    def make(world):
        return world.mag(FIELD + [LASTING * next(draws), 0, 0])

    found = nees(block, [200, 1000, 3999], make, field_turning_std=0).mean(axis=0)
    low, high = chi2.ppf([LEVEL, 1 - LEVEL], RUNS) / RUNS
    assert np.all((low < found) & (found < high)), found


def test_heading_is_honest_with_a_bias_of_the_magnetometer(block):
    """What it turns changes as the body does, and does not average out over few attitudes."""
    found = nees(block, [1000, 2000, 3999], lambda w: w.mag(FIELD, TURNING, LASTING)).mean(axis=0)
    low, high = chi2.ppf([LEVEL, 1 - LEVEL], RUNS) / RUNS
    assert np.all((low < found) & (found < high)), found


def test_a_sample_held_for_a_faster_gyro_counts_once(block):
    """Held rows give the bits of rows without a sample."""
    world = World(102)
    mag = world.mag()
    held = np.repeat(mag[::5], 5, axis=0)
    gaps = np.where((np.arange(ROWS) % 5 == 0)[:, None], mag, np.nan)
    np.testing.assert_array_equal(world.run(block, held), world.run(block, gaps))


def test_a_log_with_each_sample_twice_is_no_more_precise(block):
    """Interpolated to a faster clock the same field tells the same: what it is off lasts."""
    world = World(103)
    mag = world.mag(turning=TURNING)
    rows = np.arange(ROWS)
    coarse = np.column_stack([np.interp(rows, rows[::4], column[::4]) for column in mag.T])
    full, filled = (
        output(block, world.run(block, m), "heading_std")[[500, 2000, -1]] for m in (mag, coarse)
    )
    np.testing.assert_allclose(filled, full, rtol=0.1)


def test_a_missing_field_changes_nothing_and_is_no_fault(block):
    world = World(104)
    zeros, missing = world.run(block, 0.0), world.run(block, np.nan)
    np.testing.assert_array_equal(zeros, missing)
    assert not output(block, missing, "status").astype(int).__and__(1).any()


def test_the_field_does_not_tilt(block):
    """The first sample turns the attitude by a good part of a radian, about the vertical alone."""
    world = World(105)
    up = [
        Rotation.from_quat(output(block, world.run(block, m), "q")[0], scalar_first=True).apply(
            [0, 0, 1], inverse=True
        )
        for m in (world.mag(), 0.0)
    ]
    np.testing.assert_allclose(*up, rtol=0, atol=1e-12)


def test_a_disturbance_is_said_and_rejected(block):
    """For ten seconds a field of 30 uT more, across and down, would turn the heading by 53 deg."""
    world = World(106)
    field, off = np.tile(FIELD, (ROWS, 1)), slice(2000, 3000)
    field[off] += [25e-6, 0, -17e-6]
    y = world.run(block, world.mag(field))
    said = output(block, y, "status").astype(int) & DISTURBED > 0
    assert said[off].all() and not said[1000:2000].any() and not said[3000:].any()
    error, std = world.heading_error(block, y), output(block, y, "heading_std")
    assert np.abs(error[1000:] / std[1000:]).max() < 4


def test_a_new_place_is_learnt(block):
    """Another strength and dip to the same north: disturbed at first, then used again. By how much
    it may be bent nobody knows, and that it stays the same tells no more of that: but it shows how
    the gyro drifts meanwhile.
    """
    world, rows = World(107, rows=8000), np.arange(8000)
    field = np.where((rows < 2000)[:, None], FIELD, [0, 30e-6, -30e-6])
    mag = world.mag(field)
    y = world.run(block, mag)
    said = output(block, y, "status").astype(int) & DISTURBED > 0
    assert said[2000:3900].all() and not said[4500:].any()
    error, std = world.heading_error(block, y), output(block, y, "heading_std")
    before = np.where((rows < 2000)[:, None], mag, 0.0)
    drifts = output(block, world.run(block, before), "heading_std")
    grown, alone = (np.diff(v[[4500, -1]] ** 2) for v in (std, drifts))
    assert np.abs(error / std)[1000:].max() < 4 and grown < 0.8 * alone


def bent_at_first(world: World) -> np.ndarray:
    """The magnetometer (n, 3) near iron, of any direction, for the first 20 s."""
    iron = world.rng.standard_normal(3)
    near = (np.arange(world.rows) < 2000)[:, None]
    return world.mag(FIELD + near * 25e-6 * iron / np.linalg.norm(iron))


def test_a_field_that_was_bent_at_first_is_admitted_when_another_stays(block):
    """By the first one the heading began: it may be off by the angle between the two. Of 24 bodies
    hardly any is off by three standard deviations then, where nearly all were. In one direction of
    32 the iron bends the field across alone, and neither strength nor dip by the tolerance of 13 %:
    that is found out later.
    """
    z = []
    for seed in range(24):
        world = World(300 + seed, rows=5500)
        std0 = np.array([0.01, 0.01, 2, 2e-3, 2e-3, 2e-3])
        y = world.run(block, bent_at_first(world), std0=std0)
        z.append((world.heading_error(block, y) / output(block, y, "heading_std"))[[1500, -1]])
    before, after = np.count_nonzero(np.abs(z) > 3, axis=0)
    assert after <= binom.ppf(1 - LEVEL, len(z), 1 / 32 + 2 * norm.sf(3)) and before > 18


def bent_from(world: World, row: int) -> np.ndarray:
    """The magnetometer (n, 3) near iron, of any direction, from a row on."""
    iron = world.rng.standard_normal(3)
    near = (np.arange(world.rows) >= row)[:, None]
    return world.mag(FIELD + near * 25e-6 * iron / np.linalg.norm(iron))


def test_a_field_that_is_bent_for_good_is_not_taken_for_north(block):
    """20 s after it changed it is that of a new place, whose direction nobody knows. That it stays
    the same tells no more of that, so that the heading is where it was. The odds were that of half
    a minute to 20 s.
    """
    z, moved = [], []
    for seed in range(12):
        world = World(500 + seed, rows=9000)
        y = world.run(block, bent_from(world, 3000))
        error, std = world.heading_error(block, y), output(block, y, "heading_std")
        z.append(error[-1] / std[-1])
        moved.append(error[-1] - error[5500])
    assert np.count_nonzero(np.abs(z) > 3) <= binom.ppf(1 - LEVEL, len(z), 1 / 32 + 2 * norm.sf(3))
    assert np.median(np.abs(moved)) < np.radians(3)


def test_a_direction_that_contradicts_the_heading_leaves_open_which_is_wrong(block):
    """Strength and dip stay as they were, the direction turns by 60 deg: said for 20 s, and then
    either is off by as much as it has the odds of, 30 s of agreement to 20 s.
    """
    world, turned = World(520, rows=9000), np.radians(60)
    north = Rotation.from_euler("z", turned * (np.arange(9000) >= 3000)[:, None])
    y = world.run(block, world.mag(north.apply(FIELD)))
    said = output(block, y, "status").astype(int) & DISTURBED > 0
    assert said[3100:4900].all() and not said[5500:].any()
    error, std = world.heading_error(block, y), output(block, y, "heading_std")
    assert np.abs(error[:5000] / std[:5000]).max() < 4
    odds = 20 / (20 + 30)
    assert std[-1] == pytest.approx(turned * np.sqrt(odds * (1 - odds)), rel=0.1)
    assert abs(error[-1]) == pytest.approx(turned * odds, rel=0.1)


def test_a_heading_that_headings_tell_is_not_doubted_for_the_field(block):
    """It does not lean on the field that was the wrong one."""
    world = World(330, rows=5500)
    u = inputs(world.rows, gyro=world.gyro, accel=world.accel, mag=bent_at_first(world))
    yaw = world.attitude.as_euler("ZYX")[:, 0]
    u[::10, 7:10] = np.column_stack([yaw, np.full((len(yaw), 2), [0.01**2, 1])])[::10]
    p = parameters(block, **SETTINGS, q0=world.start.as_quat(scalar_first=True), std0=STD0)
    y, _ = block.run(u, p=p)
    error, std = world.heading_error(block, y), output(block, y, "heading_std")
    assert (np.abs(error) < 4 * std)[2000:].all() and std[3900:].max() < 0.01


def recording(world: World, mag, **more) -> Recording:
    time = H * np.arange(world.rows)
    return Recording.from_arrays(
        time=time,
        gyro=world.gyro,
        accel=world.accel,
        mag=np.broadcast_to(mag, (world.rows, 3)),
        **more,
    )


def test_run_and_unit_agree():
    """With the result's parameters the block gives its bits, from the heading of the first rest."""
    world = World(108, still=300)
    log = recording(world, world.mag())
    found = run(log, part())
    u = inputs(world.rows, gyro=world.gyro, accel=world.accel, mag=log.mag)
    unit = attitude_ukf(part())
    y, _ = unit.run(u, p=parameters(unit, **found.parameters), sample_period=log.sample_period)
    for name in ("q", "std", "status", "heading_std"):
        np.testing.assert_array_equal(output(unit, y, name), getattr(found, name))
    yaw = Rotation.from_quat(found.q[0], scalar_first=True) * world.attitude[0].inv()
    assert found.magnetometer.used and abs(yaw.as_rotvec()[2]) < 0.1


def test_without_its_magnetometer_a_log_gives_the_bits_of_one_that_has_none():
    world = World(109, still=300)
    log = recording(world, world.mag())
    plain = Recording.from_arrays(time=log.time, gyro=log.gyro, accel=log.accel)
    one, other = run(log, part(), magnetometer=False), run(plain, part())
    np.testing.assert_array_equal(one.q, other.q)
    np.testing.assert_array_equal(one.std, other.std)
    assert not one.magnetometer.used


def test_a_log_shows_how_far_its_magnetometer_is_off():
    """The mean square of a heading by iron of 5 uT an axis, which nobody calibrated, is as claimed:
    it was twelve times that, as the filter began with a bias of 1 uT.
    """
    runs, squares = 12, []
    for seed in range(400, 400 + runs):
        world = World(seed, still=300)
        iron = 5e-6 * np.random.default_rng(seed + 1000).standard_normal(3)
        found = run(recording(world, world.mag() + iron), part())
        off = world.attitude[-1] * Rotation.from_quat(found.q[-1], scalar_first=True).inv()
        squares.append((off.as_rotvec()[2] / found.heading_std[-1]) ** 2)
    assert np.sum(squares) < chi2.isf(1e-4, runs)


def test_iron_near_by_is_nothing_that_turns_with_the_body():
    """It changes the strength for half of the log, and in one time of it."""
    world = World(112, rows=12_000, still=300)
    field = np.where((np.arange(12_000) < 6500)[:, None], FIELD, FIELD + [1e-5, 0, -1e-5])
    near = run(recording(world, world.mag(field)), part()).magnetometer
    bias = run(recording(world, world.mag() + [5e-6, 0, 0]), part()).magnetometer
    assert near.turning < 5e-7 and near.scatter > 3e-6
    assert bias.turning > 1e-6


def test_the_turning_of_a_calibrated_magnetometer_is_its_least():
    world = World(109, still=300)
    found = run(recording(world, world.mag()), part())
    assert found.parameters["field_turning_std"] == TURNING


def test_declination_turns_the_heading():
    world = World(110, still=300)
    log, angle = recording(world, world.mag()), 0.3
    east, true = (run(log, part(), settings={"declination": d}) for d in (angle, 0.0))
    turned = (
        Rotation.from_quat(true.q, scalar_first=True)
        * Rotation.from_quat(east.q, scalar_first=True).inv()
    )
    np.testing.assert_allclose(turned[-1].as_rotvec()[2], angle, atol=1e-6)


WRONG = {
    "zeros": (0.0, 1, "zeros alone"),
    "one axis": ([1, 0, 0], 1, "axis y, z shows zeros"),
    "gauss": (1, 1e4, "numbers in gauss under a header of T"),
    "nT": (1, 1e9, "numbers in nT under a header of T"),
    "nT under uT": (1, 1e3, "numbers in nT under a header of uT"),
    "uT under nT": (1, 1e-3, "numbers in uT under a header of nT"),
    "gauss under uT": (1, 1e-2, "numbers in gauss under a header of uT"),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_magnetometer_that_cannot_be_right_is_said_and_not_used(case):
    axes, factor, said = WRONG[case]
    world = World(111, rows=500, still=300)
    found = run(recording(world, world.mag() * axes * factor), part())
    assert not found.magnetometer.used and said in found.report()
    plain = run(recording(world, world.mag()), part(), magnetometer=False)
    np.testing.assert_array_equal(found.q, plain.q)


@pytest.mark.parametrize("header, numbers", [("mT", "uT"), ("uT", "nT"), ("gauss", "uT")])
def test_the_unit_that_is_named_is_that_of_the_header(header, numbers, tmp_path):
    """Numbers in uT under a header of mT are as much too large as those in nT under one of uT."""
    world = World(111, rows=500, still=300)
    path = recording(world, world.mag() / parse(numbers).factor).write(tmp_path / "log.csv")
    path.write_text(path.read_text().replace("[T]", f"[{header}]"))
    said = run(path, part()).report()
    assert f"numbers in {numbers} under a header of {header} look so" in said


AXES = {
    "forward-right-down": (np.diag([1.0, -1, -1]), "y is -y, z is -z"),
    "y mirrored": (np.diag([1.0, -1, 1]), "y is -y"),
    "x and y swapped": (np.eye(3)[[1, 0, 2]], "x is y, y is x"),
    "north-east-down": (np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]]), "x is y, y is x, z is -z"),
}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("iron", [0.0, 20e-6])
@pytest.mark.parametrize("case", AXES)
def test_a_magnetometer_in_other_axes_is_named(case, iron, seed):
    """Iron on board, which turns with the body, hides that no more than it makes it up."""
    matrix, said = AXES[case]
    world = World(seed, rows=6000, still=300)
    right = recording(world, world.mag() + iron)
    assert field_findings(right) == ()
    (found,) = field_findings(replace(right, mag=right.mag @ matrix.T))
    assert said in found.detail["axes"].split("; or ")


def test_it_is_said_and_not_used():
    world = World(5, rows=6000, still=300)
    right = recording(world, world.mag())
    result = run(replace(right, mag=right.mag * [1, -1, 1]), part())
    assert "(y is -y; or x is -x, z is -z): it was not used" in result.report().splitlines()[1]
    np.testing.assert_array_equal(result.q, run(right, part(), magnetometer=False).q)


def test_by_a_gyro_that_is_wrong_no_magnetometer_is_judged():
    world = World(6, rows=9000, still=300)
    right = recording(world, world.mag())
    result = run(replace(right, gyro=right.gyro * [1, -1, 1]), part())
    kinds = {f.kind for f in result.findings}
    assert "gyro_axes" in kinds and "mag_axes" not in kinds


def test_a_field_that_is_disturbed_in_most_of_the_log_is_said_first():
    world = World(7, rows=3000, still=300)
    field = world.mag() * (1 + 0.6 * (np.arange(3000) % 500 > 150))[:, None]
    log = recording(world, field)
    assert "from sample to sample, 19% of it" in run(log, part()).report()
    text = run(log, part(), settings={"field_turning_std": TURNING}).report()
    assert "the magnetic field is disturbed in" in text
    assert "may be off by more than its standard deviation" in text


@pytest.mark.long
@pytest.mark.parametrize("seed", (1, 3, 5))
def test_speeds_and_forces_that_contradict_the_field_leave_a_number(seed):
    """A body that does not turn, forces of seconds, wrong speeds: the field's parts were more like
    the estimate than they can be, until a variance was negative and the attitude NaN."""
    n, rng = 150_000, np.random.default_rng(seed)
    force, at = np.tile([0.0, 0.0, GRAVITY], (n, 1)), 0
    while at < n:
        lasts = int(rng.uniform(1, 6) / H)
        force[at : at + lasts] += rng.normal(scale=3.6, size=3) * rng.integers(0, 2, 3)
        at += lasts
    normal = rng.standard_normal
    u = inputs(
        n,
        gyro=1.4e-4 * normal((n, 3)),
        accel=force + 1e-3 * normal((n, 3)),
        mag=[2e-5, 0, -4e-5] + 3e-6 * normal((n, 3)),
    )
    told = rng.integers(0, n, 400)
    u[told, 12:15] = [9.8, 1e-5, 1.0]
    block = attitude_ukf(replace(pyimu.part("bmi088"), sample_rate=1 / H, tolerances=()))
    y, _ = block.run(u, p=parameters(block, accel_std=0.0055, motion_time=0.37, rate_noise=0.0033))
    assert np.all(np.isfinite(y)) and not np.any(output(block, y, "status").astype(int) & 128)


@pytest.mark.parametrize(
    ("still", "lasting", "turning"),
    [(6000, 1e-6, 0.0), (0, 1e-6, 0.0), (6000, LASTING, TURNING), (6000, LASTING, 1e-7)],
)
def test_a_field_that_is_looked_at_for_a_minute_says_no_more_than_at_once(
    block, still, lasting, turning
):
    """What the field has beside the north lasts: the heading is as far off as claimed after a
    minute, at rest above all, where it was claimed to be three times better."""
    settings = {"field_std": lasting, "field_turning_std": turning, "field_time": 1e6}
    found = []
    for seed in range(RUNS):
        world = World(seed, rows=6000, still=still)
        y = world.run(block, world.mag(lasting=lasting, turning=turning), **settings)
        found.append(world.heading_error(block, y)[-1] / output(block, y, "heading_std")[-1])
    low, high = chi2.ppf([0.0005, 0.9995], RUNS)
    assert low < np.sum(np.square(found)) < high
