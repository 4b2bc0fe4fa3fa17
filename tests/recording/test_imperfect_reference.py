"""References whose samples, stamps or world are not what they seem, and logs with bad or lost rows:
what is found of them, against motions that are known in closed form.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from pyimu.recording.complete import completed
from pyimu.recording.quality.healing import healed
from pyimu.recording.recording import Recording
from pyimu.recording.reference.nodes import own_samples
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.reference.stamps import even_times

H, N, STEP = 0.01, 8000, 1e-4
TIME = np.arange(N) * H


def attitude(time, fast=1.0):
    """A tumble of up to 3 rad/s, as a Rotation."""
    t = fast * np.asarray(time)
    angles = [1.3 * np.sin(1.7 * t), 0.8 * np.sin(2.3 * t + 1) * np.cos(0.2 * t), np.sin(3.1 * t)]
    return Rotation.from_euler("ZYX", np.column_stack(angles))


def rate(time, fast=1.0):
    """Its rate (n, 3) rad/s, by a central difference that misses by some STEP^2."""
    before, after = (attitude(time + s, fast) for s in (-STEP, STEP))
    return (before.inv() * after).as_rotvec() / (2 * STEP)


def noisy(rotations, degrees, seed=1):
    error = np.random.default_rng(seed).standard_normal((len(rotations), 3))
    return rotations * Rotation.from_rotvec(np.deg2rad(degrees) * error)


def quaternions(rotations):
    return rotations.as_quat(scalar_first=True)


def gyro(time, seed=2):
    """With the noise of a consumer part, 0.01 deg/s/sqrt(Hz)."""
    return rate(time) + 1.7e-3 * np.random.default_rng(seed).standard_normal((len(time), 3))


def kinds(reference):
    return [f.kind for f in reference.findings]


# Jumps of its world


@pytest.mark.parametrize("angle", [1.0, 2.0, 5.0])
def test_a_jump_of_the_world_is_left_out(angle):
    """With 0.05 deg of noise two lines through 12 samples each are apart by 0.06 deg in the middle:
    1 deg is 17 times that. What is left out begins and ends 0.25 s away.
    """
    jump = Rotation.from_rotvec(np.deg2rad(angle) * np.array([0.6, 0.0, 0.8]))
    q = quaternions(noisy(attitude(TIME), 0.05))
    q[3000:] = quaternions(jump * Rotation.from_quat(q[3000:], scalar_first=True))
    reference = reference_rate(Recording.from_arrays(time=TIME, gyro=gyro(TIME), ref_q=q))
    (spikes,) = reference.findings
    assert spikes.kind == "reference_spikes" and spikes.count == 1
    assert spikes.detail["largest_angle"] == pytest.approx(np.deg2rad(angle), abs=np.deg2rad(0.3))
    lost = np.flatnonzero(np.isnan(reference.rate[:, 0]))
    assert lost[0] == pytest.approx(2975, abs=2) and lost[-1] == pytest.approx(3025, abs=2)


@pytest.mark.parametrize("late", [-0.03, 0.02, 1.4])
def test_a_jump_shows_beside_a_gyro_that_is_early_or_late(late):
    """A camera's are 30 ms late as a rule: what it was behind hid jumps of a degree."""
    jump = Rotation.from_rotvec(np.deg2rad(1.2) * np.array([0.6, 0.0, 0.8]))
    q = quaternions(noisy(attitude(TIME), 0.05))
    q[3000:] = quaternions(jump * Rotation.from_quat(q[3000:], scalar_first=True))
    measured = rate(TIME - late) + 1.7e-3 * np.random.default_rng(2).standard_normal((N, 3))
    reference = reference_rate(Recording.from_arrays(time=TIME, gyro=measured, ref_q=q))
    (spikes,) = reference.findings
    assert spikes.kind == "reference_spikes" and spikes.count == 1
    assert spikes.detail["largest_angle"] == pytest.approx(np.deg2rad(1.2), abs=np.deg2rad(0.3))


@pytest.mark.parametrize("late", [0.0, 0.3])
@pytest.mark.parametrize("row", [700, 3000, 5200])
def test_a_jump_shows_in_a_motion_that_repeats_itself(late, row):
    """A period later it is not in the rows that both have, and that lag was the likelier."""
    swing = 0.4 * np.sin(2 * np.pi * 0.6 * TIME)
    measured = np.zeros((N, 3))
    measured[:, 2] = 0.4 * 2 * np.pi * 0.6 * np.cos(2 * np.pi * 0.6 * (TIME - late))
    measured += 1.7e-3 * np.random.default_rng(3).standard_normal((N, 3))
    q = quaternions(noisy(Rotation.from_rotvec(np.outer(swing, [0, 0, 1])), 0.05))
    jump = Rotation.from_rotvec([0.0, 0.2, 0.0])
    q[row:] = quaternions(jump * Rotation.from_quat(q[row:], scalar_first=True))
    reference = reference_rate(Recording.from_arrays(time=TIME, gyro=measured, ref_q=q))
    assert kinds(reference) == ["reference_spikes"] and reference.findings[0].count == 1


@pytest.mark.parametrize("late", [0.0, 0.02, 1.4])
@pytest.mark.parametrize("seed", range(4))
def test_motion_is_no_jump(seed, late):
    """A gyro that is late, turned by 10 deg, and has a scale factor, a bias and noise."""
    turn = Rotation.from_rotvec([0.1, -0.1, 0.1])
    measured = 1.03 * turn.apply(rate(TIME - late)) + [0.02, -0.01, 0.03]
    measured += 2e-3 * np.random.default_rng(seed).standard_normal(measured.shape)
    q = quaternions(noisy(attitude(TIME), 0.05, seed=10 + seed))
    assert kinds(reference_rate(Recording.from_arrays(time=TIME, gyro=measured, ref_q=q))) == []


@pytest.mark.parametrize("slip", [-1, 1])
def test_a_slip_of_the_clock_by_a_sample_is_no_jump(slip):
    """At 1.5 rad/s it is 0.86 deg at once, about the axis of the motion."""
    spin = np.array([0.9, -0.9, 0.8])
    turned = Rotation.from_rotvec(TIME[:, None] * spin)
    row = np.clip(np.arange(N) + slip * (np.arange(N) >= 4000), 0, N - 1)
    measured = spin + 1.7e-3 * np.random.default_rng(4).standard_normal((N, 3))
    q = quaternions(noisy(turned[row], 0.02))
    assert kinds(reference_rate(Recording.from_arrays(time=TIME, gyro=measured, ref_q=q))) == []


def test_a_gyro_beyond_its_range_makes_no_jump():
    measured = np.clip(gyro(TIME), -1.0, 1.0)
    q = quaternions(noisy(attitude(TIME), 0.05))
    assert kinds(reference_rate(Recording.from_arrays(time=TIME, gyro=measured, ref_q=q))) == []


# Interpolated along shortest arcs


def interpolated(own_hz, rows_hz, digits=None):
    """The own samples' times and attitudes, and the rows that were made of them."""
    nodes = np.arange(-0.5, 40 * own_hz) / own_hz
    own = noisy(attitude(nodes), 0.05)
    time = np.arange(0.0, 39.0, 1 / rows_hz)
    q = quaternions(Slerp(nodes, own)(time))
    return (
        nodes,
        own,
        Recording.from_arrays(time=time, ref_q=q if digits is None else q.round(digits)),
    )


@pytest.mark.parametrize(
    "own_hz, rows_hz", [(60, 200), (50, 200), (100, 250), (120, 285.7), (60, 1000)]
)
def test_the_samples_behind_an_interpolated_attitude_are_found(own_hz, rows_hz):
    """Each is where the line of its arc ends: exact, but for the root of the rounding that the
    attitudes' angle takes (1e-8).
    """
    nodes, own, rows = interpolated(own_hz, rows_hz)
    found = own_samples(rows)
    assert np.diff(found.time) == pytest.approx(1 / own_hz, rel=1e-6)
    first = np.argmin(np.abs(nodes - found.time[0]))
    truth = own[first : first + len(found.time)]
    missed = (truth.inv() * Rotation.from_quat(found.ref_q, scalar_first=True)).magnitude()
    assert missed.max() < 1e-6 and len(found) > 0.97 * 39 * own_hz


def test_a_quaternion_of_six_digits_still_shows_its_samples():
    """A step of 5 ms then has a rate off by 3e-4 rad/s, a hundredth of what the noise changes it by
    at a sample: a sample is placed to a hundredth of a row.
    """
    _, _, rows = interpolated(60, 200, digits=6)
    assert np.diff(own_samples(rows).time) == pytest.approx(1 / 60, rel=1e-3)


@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_an_attitude_that_was_measured_stays_as_it_is(noise):
    rows = Recording.from_arrays(time=TIME, ref_q=quaternions(noisy(attitude(TIME), noise)))
    assert own_samples(rows) is rows


def test_a_held_attitude_stays_as_it_is():
    latest = np.arange(N) // 5 * 5
    rows = Recording.from_arrays(time=TIME, ref_q=quaternions(noisy(attitude(TIME), 0.05)[latest]))
    assert own_samples(rows) is rows


def test_an_interpolated_attitude_has_the_rate_of_its_motion():
    """A C2 spline through 60 Hz misses by h^3/24 of the rate's third derivative at most (de Boor),
    some 3 rad/s times (3.1 1/s)^3 with products: 1e-4 rad/s. The arcs miss by 0.1 rad/s.
    """
    nodes = np.arange(-0.5, 40 * 60) / 60
    time = np.arange(0.0, 39.0, 1 / 200)
    q = quaternions(Slerp(nodes, attitude(nodes))(time))
    reference = reference_rate(Recording.from_arrays(time=time, gyro=rate(time), ref_q=q))
    inside = np.isfinite(reference.rate[:, 0]) & (time > 1.0) & (time < 38.0)
    assert np.abs(reference.rate - rate(time))[inside].max() < 1e-3
    assert inside.sum() == np.sum((time > 1.0) & (time < 38.0))
    assert 4 * reference.band_limit == pytest.approx(60.0, rel=1e-6)


# Stamps that scatter


def scattered(share, seed=3):
    return TIME + share * H * np.random.default_rng(seed).uniform(-1, 1, N)


def test_the_line_through_scattered_stamps_is_the_instants():
    """Uniform by 0.3 periods is 0.173 RMS; a line through 1000 has 2/sqrt(1000) of that at its
    ends, and no one of 8000 beyond five times it.
    """
    even = even_times(Recording.from_arrays(time=scattered(0.3)))
    assert np.abs(even - TIME).max() < 5 * 2 / np.sqrt(999) * 0.173 * H


def test_even_stamps_are_taken_as_they_are():
    assert even_times(Recording.from_arrays(time=TIME * (1 + 1e-4))) is None


@pytest.mark.parametrize("sensor", ["its stamps", "even times"])
@pytest.mark.parametrize("looked_up", ["its stamps", "even times"])
def test_the_times_of_sensor_and_reference_are_told_apart(sensor, looked_up):
    """Where the reference's own noise, larger between stamps that are close, does not hide them."""
    stamps = scattered(0.4)
    at = {"its stamps": stamps, "even times": TIME}
    q = quaternions(noisy(attitude(at[looked_up]), 0.005))
    log = Recording.from_arrays(time=stamps, gyro=gyro(at[sensor]), ref_q=q)
    reference = reference_rate(log)
    (jitter,) = [f for f in reference.findings if f.kind == "jitter"]
    assert (jitter.detail["sensor_at"], jitter.detail["reference_at"]) == (sensor, looked_up)
    used = stamps if reference.time is None else reference.time
    assert np.abs(used - at[sensor]).max() < 0.07 * H


# Lost and bad rows


def test_lost_rows_are_put_in_where_they_are_few():
    kept = np.ones(N, bool)
    kept[[100, 200, 201, 202, 5000, 5002]] = kept[300:310] = False
    log = Recording.from_arrays(time=TIME[kept], gyro=gyro(TIME)[kept])
    whole = completed(log)
    assert [b - a for a, b in whole.segments] == [300, N - 310]
    expected = np.delete(TIME, np.arange(300, 310))
    np.testing.assert_allclose(whole.time, expected, atol=1e-9)
    put_in = np.flatnonzero(np.isnan(whole.gyro).all(axis=1))
    assert put_in.tolist() == [100, 200, 201, 202, 4990, 4992]
    assert completed(whole).time is whole.time


def test_a_lost_sample_of_the_reference_ends_no_segment():
    q = quaternions(attitude(TIME))
    q[np.arange(50, N, 97)] = np.nan
    reference = reference_rate(Recording.from_arrays(time=TIME, gyro=gyro(TIME), ref_q=q))
    assert reference.segments == [(0, N)]
    assert 4 * reference.band_limit == pytest.approx(100.0)


def test_a_bad_sample_is_taken_from_its_neighbours():
    """A cubic spline reproduces cubics; a run that is too long stays."""
    t = TIME[:60]
    values = np.column_stack([1 + 2 * t - 40 * t**2 + 90 * t**3, t])
    bad, wrong = np.zeros(values.shape, bool), values.copy()
    bad[[10, 30, 31], 0] = bad[40:44, 0] = bad[0, 1] = True
    wrong[bad] = 100.0
    found = healed(t, wrong, bad, most=2)
    still = np.argwhere(found == 100.0).tolist()
    assert still == [[0, 1], [40, 0], [41, 0], [42, 0], [43, 0]]
    np.testing.assert_allclose(found[found != 100.0], values[found != 100.0], atol=1e-12)
