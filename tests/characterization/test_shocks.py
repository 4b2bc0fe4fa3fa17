"""A knock on a still sensor: it is found, left out and said, and the noise is that without it."""

import numpy as np
import pytest
from scipy.stats import norm

from pyimu import Recording
from pyimu.characterization.run import characterize
from pyimu.characterization.samples import Samples
from pyimu.characterization.shocks import without_shocks

H = 0.01
N = {"gyro": 1e-4, "accel": 2e-3}
"""White noise: rad/sqrt(s), m/s/sqrt(s)."""

G = 9.80665
SIX = [(kind, axis) for kind in N for axis in range(3)]


def rest(seed, rows=2**16):
    """White noise of a gyro and a level accelerometer, (n, 3) each."""
    rng = np.random.default_rng(seed)
    gyro, accel = (n / np.sqrt(H) * rng.standard_normal((rows, 3)) for n in N.values())
    return {"gyro": gyro, "accel": accel + [0, 0, G]}


def knock(log, second, size=1.0, axes=SIX):
    """The log after a knock that rings at 12 Hz for 0.1 s, ``size`` rad/s and 10 ``size`` m/s^2."""
    t = H * np.arange(60)
    ring = size * np.exp(-t / 0.1) * np.sin(2 * np.pi * 12 * t)
    rows = slice(round(second / H), round(second / H) + len(t))
    for kind, axis in axes:
        log[kind][rows, axis] += ring * {"gyro": 1.0, "accel": 10.0}[kind]
    return log


def sensors(log):
    """The samples of a log without gap."""
    time = H * np.arange(len(log["gyro"]))
    none = np.empty(0, dtype=int)
    return {
        kind: Samples(kind, H, time, list(values.T), [(0, len(time))], none, None)
        for kind, values in log.items()
    }


def segments(log):
    cut, findings = without_shocks(sensors(log))
    return cut["gyro"].segments, cut["accel"].segments, findings


def corrupt(values):
    """The values with a row of another size."""
    values[777] += 50.0
    return values


def often(log):
    """The log with a knock every 20 s, which is how its place is."""
    for second in np.arange(5, 650, 20):
        knock(log, second)
    return log


def test_noise_is_that_without_the_knock():
    log = knock(rest(1), 300.4)
    time = H * np.arange(len(log["gyro"]))
    found = characterize(Recording.from_arrays("knocked", time=time, **log)).logs[0]
    assert [f.column for f in found.findings if f.kind == "shocks"] == [
        c.name for c in found.channels
    ]
    for channel in found.channels:
        n = channel.coefficient("N")
        # Within its interval, widened to one that six right ones leave once in a thousand times.
        wide = norm.isf(1e-3 / 12) / norm.isf(0.025)
        assert abs(n.value - N[channel.kind]) < wide * (n.high - n.low) / 2
        assert not channel.lines
        assert channel.bandwidth is None


def test_what_is_cut_is_the_knock_and_the_seconds_about_it():
    gyro, accel, findings = segments(knock(rest(2), 300.8))
    assert gyro == accel == [(0, 29900), (30300, 2**16)]
    first = {f.column: f.detail["first_row"] for f in findings}
    assert len(first) == 6
    assert all(30080 <= row < 30090 for row in first.values())
    assert all(f.count in (1, 2) for f in findings)


def test_a_log_that_ends_in_a_hand_ends_before_it():
    log = rest(3)
    for values in log.values():
        values[-50:] += np.linspace(0.0, 0.3, 50)[:, None]
    gyro, accel, _ = segments(log)
    assert len(gyro) == len(accel) == 1
    assert 2**16 - 250 < gyro[0][1] <= 2**16 - 50


@pytest.mark.parametrize(
    "disturbed",
    [
        pytest.param(lambda log: knock(log, 100, axes=[("gyro", 1)]), id="burst of one axis"),
        pytest.param(lambda log: {k: corrupt(v) for k, v in log.items()}, id="corrupt row"),
        pytest.param(often, id="shaken often"),
    ],
)
def test_what_is_no_knock_is_left_in(disturbed):
    gyro, accel, findings = segments(disturbed(rest(4)))
    assert not findings
    assert gyro == accel == [(0, 2**16)]


@pytest.mark.parametrize("step", [0.0, 2e-3])
def test_noise_alone_is_no_knock(step):
    """In 20 logs, rounded by twice its noise or not, of which each may err once in a million."""
    for seed in range(20):
        log = rest(seed, 2**14)
        if step:
            log["gyro"] = step * np.round(log["gyro"] / step)
        assert not segments(log)[2]
