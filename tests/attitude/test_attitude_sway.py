"""A body that looks still and sways: it stands on nothing solid, and may turn slowly."""

from dataclasses import replace

import numpy as np
import pytest
from attitude_cases import GRAVITY, H, part
from drives import bodies
from scipy.signal import butter, lfilter, sosfilt

from pyimu.attitude import run
from pyimu.attitude.filter.stillness import TURN_STD
from pyimu.attitude.rest import find_rest, lagged
from pyimu.recording.recording import Recording

N, K, N_ACCEL = 1e-4, 1e-5, 1e-3
RUNS = 4


def still(seed: int, roll: float = 0.0, seconds: float = 30.0) -> Recording:
    """A body on a table, or one that rolls by ``roll`` rad in 8 s."""
    rng, t = np.random.default_rng([5, seed]), H * np.arange(round(seconds / H))
    phase = 2 * np.pi / 8 * t
    gyro, accel = rng.standard_normal((2, len(t), 3)) / H**0.5
    gyro, accel = N * gyro + 0.01, N_ACCEL * accel
    gyro[:, 0] += roll * 2 * np.pi / 8 * np.cos(phase)
    accel[:, 1] += GRAVITY * roll * np.sin(phase)
    accel[:, 2] += GRAVITY
    return Recording.from_arrays(time=t, gyro=gyro, accel=accel)


def test_a_rest_on_a_table_is_told_from_one_on_water():
    """By chance a table's density is that of a body that sways once in a million."""
    for seed in range(20):
        for seconds in (4.0, 30.0):
            assert not find_rest(still(seed, seconds=seconds)).sways
        assert find_rest(still(seed, roll=0.002)).sways
    assert not find_rest(still(0, roll=0.002, seconds=2.0)).sways


@pytest.mark.parametrize("cutoff", [5.0, 10.0, 20.0, 40.0])
@pytest.mark.parametrize("order", [1, 2])
def test_the_noise_of_a_gyro_behind_a_low_pass_is_no_sway(cutoff, order):
    """Nor is it less in the nominal part, by more than the low-pass takes at 5 Hz and the scatter
    of the noise of 300 means, four standard deviations.
    """
    low = butter(order, cutoff, output="sos", fs=1 / H)
    least = 0.9 / (1 + (5.0 / cutoff) ** (2 * order)) ** 0.5
    for seed in range(10):
        table = still(seed)
        found = find_rest(replace(table, gyro=sosfilt(low, table.gyro, axis=0)).slice(300, 3000))
        assert not found.sways
        assert found.rate_density.min() > (least - 4 / (2 * 270) ** 0.5) * N
        water = still(seed, roll=0.002)
        water = replace(water, gyro=sosfilt(low, water.gyro, axis=0)).slice(300, 3000)
        assert find_rest(water).sways


@pytest.mark.parametrize("time", [0.05, 1.0, 40.0])
def test_a_lag_of_the_first_order_is_the_recursive_filter_of_its_two_taps(time):
    """To the rounding of either: of a few half units of the last place in each step, of which the
    lag forgets the earlier ones with its time constant.
    """
    values = np.random.default_rng(3).standard_normal((3000, 3))
    want = lfilter([H / (time + H)], [1.0, -time / (time + H)], values, axis=0)
    rounding = 6 * np.finfo(float).eps * (time + H) / H * np.abs(want).max()
    np.testing.assert_allclose(lagged(values, H, time), want, rtol=0, atol=rounding)


@pytest.mark.parametrize("known", [False, True])
def test_the_bias_of_a_body_that_sways_is_unsure_about_the_vertical(known):
    """By a turn of 0.01 rad/s, unless it was known before: by ``std0``, as of a part."""
    table, water = (
        run(still(1, roll), part(N, K, N_ACCEL), std0=np.full(6, 1e-4) if known else None)
        for roll in (0.0, 0.002)
    )
    assert table.at_rest[1500] and not water.at_rest[1500]
    assert table.std[1000, 5] < 2e-4
    if known:
        assert water.std[1000, 5] < 3e-4
    else:
        assert 0.5 * TURN_STD < water.std[1000, 5] < 1.5 * TURN_STD
    # Level it does not turn away, and gravity shows that.
    assert water.std[1000, 3:5].max() < 0.1 * TURN_STD


def test_a_ship_that_swings_at_its_anchor_may_be_off_by_what_it_turns():
    """Of four ships, which swing by 20 deg in two to four minutes, the mean squared errors over
    their variances are those of a sine, and not the hundreds and thousands of a turn that is taken
    for a bias.
    """
    bias, heading = [], []
    for seed in range(RUNS):
        log = bodies.at_anchor(np.random.default_rng([97, seed + 3]), duration=150.0)
        found = run(Recording.from_arrays(time=log.time, gyro=log.gyro, accel=log.accel))
        w, x, y, z = log.q.T
        yaw = np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
        off = np.unwrap(found.euler[:, 2]) - yaw
        off = (off - off[0])[1000:]
        heading.append(np.mean((off / found.heading_std[1000:]) ** 2))
        bias.append(np.mean(((found.gyro_bias - log.bias)[1000:] / found.std[1000:, 3:]) ** 2))
    assert 0.1 < np.mean(bias) < 2 and 0.1 < np.mean(heading) < 3
