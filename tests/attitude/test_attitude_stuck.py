"""Samples that repeat: of a stuck sensor or axis, or by chance, as those of coarse steps do."""

import numpy as np
import pytest
from attitude_cases import N_ACCEL, H, N, drive, error, part, rover_rate
from test_attitude_run import recorded

from pyimu.attitude import run
from pyimu.attitude.rest import find_rest
from pyimu.recording.recording import Recording


@pytest.mark.parametrize("declared", [True, False])
def test_a_gyro_that_rests_on_a_coarse_step_is_not_called_stuck(declared):
    """At the edge of a step its samples change, in the middle they do not: drift takes it from one
    to the other.
    """
    q, n = 0.005, 6000
    rng = np.random.default_rng(0)
    drift = np.where(np.arange(n) < 3500, q / 2, q)[:, None]
    gyro = q * np.round((drift + q / 8 * rng.standard_normal((n, 3))) / q)
    recording = recorded(drive(np.zeros((n, 3))))
    coarse = Recording.from_arrays(time=recording.time, gyro=gyro, accel=recording.accel)
    assert find_rest(coarse).seen and len(np.unique(gyro[:3000])) > 1
    result = run(
        coarse, part(q / 8 * np.sqrt(H), **({"quantization": {"q": q}} if declared else {}))
    )
    assert not np.any(result.status & 4)


def test_a_gyro_that_stops_is_called_stuck():
    recording = recorded(drive(np.zeros((4000, 3))))
    recording.gyro[3200:] = recording.gyro[3200]
    assert np.all(run(recording, part()).status[3400:] & 4)


@pytest.mark.parametrize("known", [True, False], ids=["part", "no part"])
@pytest.mark.parametrize("axis", range(3))
def test_a_gyro_axis_that_stops_by_itself_is_lost_and_the_others_are_not(axis, known):
    """For five seconds of a drive; what was wrong before it was found is allowed for."""
    world, stuck = drive(rover_rate(6000, still=1500)), slice(3000, 3500)
    errors, within, grown = [], [], []
    for seed in range(6):
        recording = recorded(world, seed)
        recording.gyro[stuck, axis] = recording.gyro[stuck.start, axis]
        result = run(recording, part() if known else None)
        status = result.status & 4 > 0
        assert status[stuck.start + 25 : stuck.stop].all()
        assert not status[: stuck.start].any() and not status[stuck.stop :].any()
        off = error(result.q, world.attitude) / result.std[:, :3]
        errors.append(off[-1])
        within.append(np.abs(off[1500:]).max())
        grown.append(result.std[stuck.start + 100, :3] / result.std[stuck.start - 1, :3])
    # Five standard deviations are exceeded by chance once in 2e6; the rows of a run hang together.
    assert max(within) < 5
    growth = np.mean(grown, axis=0)
    assert growth[axis] > 1.5 * np.delete(growth, axis).max()
    # Mean of 6 x 3 squares of unit variance, after the fault: chi-squared of 18 over 18, 1e-4.
    assert np.mean(np.square(errors)) < 2.7


@pytest.mark.parametrize("start", [2600, 3000, 3400])
def test_what_is_stuck_does_not_make_a_gyro_look_coarse(start):
    """Wherever the windows lie in which noise and repeats are looked for."""
    recording = recorded(drive(rover_rate(6000, still=1500)))
    q = 1.4 * N / np.sqrt(H)
    recording.gyro[:] = q * np.round(recording.gyro / q)
    recording.gyro[start : start + 500, 1] = recording.gyro[start, 1]
    status = run(recording).status & 4 > 0
    assert status[start + 100 : start + 500].all()
    assert not status[:start].any() and not status[start + 500 :].any()


@pytest.mark.parametrize("step", [0.0, 0.7, 1.4, 3.0, 10.0])
def test_axes_that_repeat_by_chance_are_not_called_stuck(step):
    """Rounded to steps of so many standard deviations of their noise, in a drive with rests."""
    rate = rover_rate(20_000, still=1500)
    rate[10_000:15_000] = 0
    recording = recorded(drive(rate))
    for values, noise in ((recording.gyro, N), (recording.accel, N_ACCEL)):
        q = step * noise / np.sqrt(H)
        values[:] = q * np.round(values / q) if q else values
    result = run(recording, part())
    assert not np.any(result.status & 4)
    times = [result.parameters[f"axis_stuck_time[{i + 1}]"] for i in range(6)]
    assert max(times) == 0 if step > 2 else 20 * H - 1e-9 < min(times) <= max(times) < 1
