"""Attitudes that a filter made of the gyro itself, as phones give them beside its samples."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation
from turns import turned

import pyimu
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.common_noise import shows_noise_of_gyro
from pyimu.identification.reference.of_itself import pulled
from pyimu.recording.recording import Recording
from pyimu.recording.reference.file import with_reference

RATE, SECONDS = 100.0, 160.0
WHITE = np.radians(0.05)


def hand(seed: int, rests: bool) -> tuple[np.ndarray, np.ndarray, Rotation]:
    """Time, rate and attitude of a hand that turns by 60 deg/s to and fro, with rests or none."""
    rng, count = np.random.default_rng(seed), int(RATE * SECONDS)
    rate = gaussian_filter1d(rng.standard_normal((count, 3)), 12.0, axis=0)
    rate *= np.radians(60.0) / rate.std()
    time = np.arange(count) / RATE
    if rests:
        rate *= (time % 20.0 > 8.0)[:, None]
    return time, rate, turned(Rotation.from_rotvec(0.5 * (rate[1:] + rate[:-1]) / RATE))


def fused(gyro: np.ndarray, true: Rotation, gain: float) -> Rotation:
    """The attitude that gyro and gravity make together (Mahony's filter)."""
    up, q = true.inv().apply([0.0, 0.0, 1.0]), [true[0]]
    for k in range(len(gyro) - 1):
        seen = q[-1].inv().apply([0.0, 0.0, 1.0])
        mean = 0.5 * (gyro[k] + gyro[k + 1]) + gain * np.cross(up[k], seen)
        q.append(q[-1] * Rotation.from_rotvec(mean / RATE))
    return Rotation.concatenate(q)


@pytest.mark.parametrize(
    "own, rests",
    [
        (True, False),
        (False, True),
        pytest.param(True, True, marks=pytest.mark.long),
        pytest.param(False, False, marks=pytest.mark.long),
    ],
)
def test_the_noise_tells_an_attitude_of_the_gyros_own(own, rests):
    time, rate, true = hand(4, rests)
    rng = np.random.default_rng(5)
    gyro = rate + 0.003 + WHITE * rng.standard_normal(rate.shape)
    seen = true * Rotation.from_rotvec(2e-4 * rng.standard_normal(rate.shape))
    q = fused(gyro, true, 0.1) if own else seen
    log = Recording.from_arrays("phone", time=time, gyro=gyro, ref_q=q.as_quat(scalar_first=True))
    assert shows_noise_of_gyro(gyro_trial(log)) == own
    closed = pyimu.close(log)
    assert (closed.verdict == "reference_unfit") == own, closed.report()
    assert ("shows the gyro's own noise" in closed.reason) == own


BESIDE = {
    "as it is": lambda gyro, rng: gyro,
    "with half as much noise": lambda gyro, rng: gyro + 0.5 * noise(rng),
    "smoothed over 0.1 s": lambda gyro, rng: gaussian_filter1d(gyro, 3.0, axis=0),
}
"""What is done to a gyro's samples before they are integrated."""


def noise(rng) -> np.ndarray:
    return WHITE * rng.standard_normal((int(RATE * SECONDS), 3))


@pytest.mark.parametrize("rate", [True, False], ids=["rate", "attitude"])
@pytest.mark.parametrize("made", [*BESIDE, "of a second gyro", "of a camera"])
def test_what_was_made_of_the_gyro_has_its_noise(made, rate):
    """A second gyro of half the noise, and a camera, have none of it. What is smoothed is left out
    of the rates: nothing but a gain of one tells them from what shakes both.
    """
    time, true, attitude = hand(4, rests=True)
    rng = np.random.default_rng(5)
    gyro = true + 0.003 + noise(rng)
    if made == "of a camera":
        q = attitude * Rotation.from_rotvec(2e-5 * rng.standard_normal(true.shape))
        seen = true
    else:
        seen = BESIDE.get(made, lambda *_: true + 0.5 * noise(rng))(gyro - 0.003, rng)
        q = turned(Rotation.from_rotvec(0.5 * (seen[1:] + seen[:-1]) / RATE))
    what = {"ref_rate": seen} if rate else {"ref_q": q.as_quat(scalar_first=True)}
    log = Recording.from_arrays("log", time=time, gyro=gyro, **what)
    told = made in BESIDE and not (rate and made.startswith("smoothed"))
    assert shows_noise_of_gyro(gyro_trial(log)) == told


def test_a_rate_of_the_gyro_with_noise_beside_it_is_no_reference():
    time, true, _ = hand(4, rests=True)
    rng = np.random.default_rng(5)
    gyro = true + 0.003 + noise(rng)
    ref = gyro + 0.5 * noise(rng)
    closed = pyimu.close(Recording.from_arrays("log", time=time, gyro=gyro, ref_rate=ref))
    assert closed.verdict == "reference_unfit"
    assert "the ref_rate of log shows the gyro's own noise" in closed.reason


@pytest.mark.parametrize("noise_of_reference", [0.05, 1.0])
def test_what_shakes_both_is_not_the_gyros_noise(noise_of_reference):
    """White, and five times the noise of the gyro, so that its gain is 25 / 26."""
    time, true, _ = hand(4, rests=True)
    rng = np.random.default_rng(6)
    true = true + 5.0 * noise(rng)
    ref = true + noise_of_reference * noise(rng)
    log = Recording.from_arrays("log", time=time, gyro=true + noise(rng), ref_rate=ref)
    assert not shows_noise_of_gyro(gyro_trial(log))


GRAVITY = 9.80665


def pushed(seed: int, made: str, gain: float = 0.3, places: bool = False) -> Recording:
    """A phone that a hand turns and pushes by 2 m/s^2, with a filter's attitude, or a camera's."""
    time, rate, true = hand(seed, rests=True)
    time, rate, true = time[:8000], rate[:8000], true[:8000]
    rng = np.random.default_rng(seed + 100)
    push = gaussian_filter1d(rng.standard_normal(rate.shape), 20.0, axis=0)
    push *= 2.0 / push.std()
    gyro = rate + 0.003 + WHITE * rng.standard_normal(rate.shape)
    force = true.inv().apply(push + [0.0, 0.0, GRAVITY]) + 0.02 * rng.standard_normal(rate.shape)
    q = true * Rotation.from_rotvec(2e-4 * rng.standard_normal(rate.shape))
    if made != "camera":
        q = filtered(made, gyro - 0.0028, force, true[0], gain)
    more = {}
    if places:
        place = np.cumsum(np.cumsum(push, axis=0), axis=0) / RATE**2
        place += 1e-3 * rng.standard_normal(place.shape)
        more = dict(zip(("ref_east", "ref_north", "ref_up"), place.T))
    q = q.as_quat(scalar_first=True)
    return Recording.from_arrays("phone", time=time, gyro=gyro, accel=force, ref_q=q, **more)


def filtered(made: str, gyro, force, first: Rotation, gain: float) -> Rotation:
    """The attitude of Mahony's filter, with an integral, or of Madgwick's step of one size."""
    up = force / np.linalg.norm(force, axis=1)[:, None]
    q, bias = [first], np.zeros(3)
    for k in range(len(gyro) - 1):
        error = np.cross(up[k], q[-1].inv().apply([0.0, 0.0, 1.0]))
        bias += 0.1 * gain * error / RATE * (made == "integral")
        if made == "madgwick":
            error /= max(float(np.linalg.norm(error)), 1e-9)
        turn = 0.5 * (gyro[k] + gyro[k + 1]) + gain * error + bias
        q.append(q[-1] * Rotation.from_rotvec(turn / RATE))
    return Rotation.concatenate(q)


@pytest.mark.parametrize(
    ("made", "gain"), [("mahony", 0.05), ("mahony", 3.0), ("integral", 0.3), ("madgwick", 0.05)]
)
def test_what_draws_an_attitude_towards_the_force_tells_a_filter_s(made, gain):
    """The gain comes back: an error of a tenth would be 100 of its standard errors."""
    log = pushed(21, made, gain)
    found = pulled(gyro_trial(log), log)
    assert found > 0.0
    assert made == "madgwick" or found == pytest.approx(gain, rel=0.1)


@pytest.mark.parametrize("seed", [31, 32, 33])
def test_nothing_draws_the_attitude_of_a_camera(seed):
    log = pushed(seed, "camera")
    assert pulled(gyro_trial(log), log) == 0.0


@pytest.mark.parametrize("own", [True, False], ids=["filter", "satellites"])
def test_a_mounting_beside_bends_is_no_filter(own):
    """What a unit that is mounted a degree askew turns beside the gyro follows the bends, and so
    does the force of a vehicle whose speed is even.
    """
    rng, count = np.random.default_rng(41), 30000
    yaw = gaussian_filter1d(rng.standard_normal(count), 150.0)
    rate = np.column_stack([np.zeros((count, 2)), yaw * 0.12 / yaw.std()])
    speed = 6.0 + gaussian_filter1d(rng.standard_normal(count), 500.0) * 30.0
    true = turned(Rotation.from_rotvec(0.5 * (rate[1:] + rate[:-1]) / RATE))
    force = np.column_stack(
        [np.gradient(speed) * RATE, speed * rate[:, 2], np.full(count, GRAVITY)]
    )
    gyro = rate + 0.003 + WHITE * rng.standard_normal(rate.shape)
    force += 0.05 * rng.standard_normal(force.shape)
    askew = Rotation.from_rotvec([0.004, -0.017, 0.0])
    q = filtered("mahony", gyro - 0.0028, force, true[0], 0.05) if own else true * askew
    noise = Rotation.from_rotvec(5e-5 * rng.standard_normal(rate.shape))
    q = (q * noise).as_quat(scalar_first=True)
    log = Recording.from_arrays(
        "car", time=np.arange(count) / RATE, gyro=gyro, accel=force, ref_q=q
    )
    assert (pulled(gyro_trial(log), log) > 0.0) == own


def test_rows_of_zeros_have_no_direction_and_no_say():
    """As a logger writes them before the first sample; numpy's warnings are errors here."""
    log = pushed(4, "mahony")
    force = log.accel.copy()
    force[:50] = 0.0
    zeros = replace(log, accel=force)
    assert pulled(gyro_trial(zeros), zeros) == pytest.approx(0.3, rel=0.1)


def test_a_filter_s_attitude_in_a_file_of_its_own_is_told():
    log = pushed(22, "mahony")
    slow = Recording.from_arrays("fused", time=log.time[::4], ref_q=log.ref_q[::4])
    beside = with_reference(log, slow)
    assert pulled(gyro_trial(beside), beside) == pytest.approx(0.3, rel=0.1)


def test_no_sensor_is_blamed_by_a_filter_s_attitude():
    """With positions beside it would be the accelerometer's reference, too."""
    closed = pyimu.close(pushed(23, "mahony", places=True))
    assert closed.verdict == "reference_unfit" and not closed.added, closed.report()
    assert "drawn towards the accelerometer's force by 0.30 rad/s" in closed.reason
    assert not any("fits if" in remark for remark in closed.remarks)


def test_a_motion_far_above_the_noise_is_not_the_gyros_own_noise():
    """A hand that never rests and a gyro that hardly has any: in the quietest samples there is
    motion, and beyond the band both show its end.
    """
    time, rate, true = hand(4, rests=False)
    rng = np.random.default_rng(5)
    gyro = rate + 1e-9 * rng.standard_normal(rate.shape)
    seen = true * Rotation.from_rotvec(1e-10 * rng.standard_normal(rate.shape))
    log = Recording.from_arrays("hand", time=time, gyro=gyro, ref_q=seen.as_quat(scalar_first=True))
    assert not shows_noise_of_gyro(gyro_trial(log))
