"""A lag that bends the motion within the band of an attitude, whose form can be told there, and the
noise of a rate behind a declared one.
"""

import numpy as np
import pytest
from scipy.signal import bilinear, lfilter
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.identification.fit.short_memory import short_memory
from pyimu.model.part_reader import parse_part
from pyimu.recording.recording import Recording

RATE, FINER, SECONDS = 200.0, 10, 60.0
TAU = 0.0177
"""s; a pole at 9 Hz, beside motions of up to 5 Hz."""

WHITE = np.radians(0.05)
"""rad/s; noise of a sample of the gyro."""

READS = np.radians(0.002)
"""rad; what an encoder reads about each axis is off by so much."""


def arm(tau: float, late: int = 0, seed: int = 2) -> Recording:
    """A quick arm, measured by a gyro behind a single pole of ``tau`` s, ``late`` fine steps late,
    beside the attitude that its encoders read. All of it is made at ten times the rate.
    """
    rng = np.random.default_rng(seed)
    time = np.arange(-2.0, SECONDS, 1 / (FINER * RATE))
    f, size = np.array([0.31, 0.7, 1.3, 2.6, 4.7]), np.array([0.5, 0.3, 0.12, 0.04, 0.008])
    angles = np.zeros((len(time), 3))
    for k in range(3):
        turned = np.outer(time, 2 * np.pi * f * (1 + 0.05 * k)) + rng.uniform(0, 2 * np.pi, len(f))
        angles[:, k] = np.sin(turned) @ size
    q = Rotation.from_euler("ZYX", angles)
    rate = (q[:-1].inv() * q[1:]).as_rotvec() * FINER * RATE
    rate = 0.5 * (np.vstack([rate[:1], rate]) + np.vstack([rate, rate[-1:]]))
    if tau:
        pole = np.exp(-1 / (FINER * RATE * tau))
        # The mean of two samples undoes the half step by which the recursion is early.
        seen = lfilter([(1 - pole) / 2, (1 - pole) / 2], [1, -pole], rate, axis=0)
    else:
        seen = np.roll(rate, late, axis=0)
    kept = np.flatnonzero(time >= 0.0)[::FINER]
    gyro = seen[kept] + 0.003 + WHITE * rng.standard_normal((len(kept), 3))
    read = q[kept] * Rotation.from_rotvec(READS * rng.standard_normal((len(kept), 3)))
    return Recording.from_arrays(
        "arm", time=time[kept], gyro=gyro, ref_q=read.as_quat(scalar_first=True)
    )


def test_a_slow_lag_is_named_for_what_it_is_and_leaves_the_noise_alone():
    """It was called a delay; a hundred times the floor was left, and taken for the reference's."""
    found = pyimu.close(arm(TAU))
    (added,) = found.added
    assert added.effect == "first_order_lag" and not added.alternatives, found.report()
    assert "may hold a part" in added.note
    tau, std, _ = added.parameters["tau"]
    # The gyro's samples, of the lag as of the rate, are joined as at ten times their rate.
    assert abs(tau - TAU) < 5 * std + (2 * np.pi * 5 / RATE) ** 3 / 4 * TAU
    left = found.errors["gyro"]
    assert np.all(left.after.per_axis < 1.2 * left.noise_per_axis), found.report()
    (s,) = [e for e in found.estimated if (e.sensor, e.effect) == ("gyro", "scale_factor")]
    assert np.max(np.abs(s.value)) < 1e-4


def test_a_delay_is_not_called_a_lag():
    found = pyimu.close(arm(0.0, late=24))
    (added,) = found.added
    assert added.effect == "time_delay", found.report()
    assert added.parameters["td"][0] == pytest.approx(0.012, abs=1e-4)


def test_a_delay_is_taken_out_of_a_row_by_those_about_it_and_noise_stays():
    """Of 15 taps a row of 2000 loses 15/2000 of its noise's power, which it is given back."""
    rng, count = np.random.default_rng(0), 2000
    time = np.arange(count + 1.0)
    smooth = [np.cos(w * time[:, None] + rng.uniform(0, 6, 9)).sum(axis=1) for w in (0.2, 0.3, 0.5)]
    noise = 1e-3 * rng.standard_normal(count)
    late = smooth[0][:-1] - smooth[0][1:]
    signals = [s[1:] for s in smooth]
    found = short_memory(
        (late + noise)[:, None], signals, [(0, count)], np.zeros(count, dtype=bool)
    )
    power = float(np.var(found.beyond[5:-5])) / 1e-6
    assert abs(power - 1.0) < 5 * np.sqrt(2 / count), power
    gain = found.response(np.array([0.2 / (2 * np.pi)]), 0, 0)
    assert gain == pytest.approx(np.cos(0.2) - 1.0, abs=1e-3)


LAGS = """
name = "lags"
sample_rate = {value = 400.0, unit = "Hz"}
[gyro.lag]
wn = {value = 120.0, unit = "Hz"}
zeta = {value = 0.7, unit = "1"}
[gyro.angle_random_walk]
N = {value = [5e-5, 5e-5, 5e-5], unit = "rad/sqrt(s)"}
"""


def test_noise_of_a_rate_that_comes_through_a_declared_lag_is_not_the_sensors():
    """Behind the lag it is not white, and was taken for nothing: then the lag's bandwidth went from
    136 to 380 Hz, where it leaves less of it, and a Gauss-Markov process for the rest.
    """
    rng, rate, fine = np.random.default_rng(6), 400.0, 10
    time = np.arange(0.0, 90.0, 1 / (fine * rate))
    f = np.array([0.3, 0.8, 1.9])
    phases = rng.uniform(0, 2 * np.pi, (3, len(f)))
    motion = np.column_stack(
        [np.sin(2 * np.pi * np.outer(time, f) + p) @ [0.8, 0.5, 0.2] for p in phases]
    )
    wn = 2 * np.pi * 120.0
    numbers = bilinear([wn**2], [1.0, 1.4 * wn, wn**2], fine * rate)
    seen = lfilter(*numbers, motion, axis=0)[::fine]
    white = 5e-5 * np.sqrt(rate)
    gyro = seen + 0.004 + white * rng.standard_normal(seen.shape)
    told = motion[::fine] + 0.25 * white * rng.standard_normal(seen.shape)
    log = Recording.from_arrays("lagging", time=time[::fine], gyro=gyro, ref_rate=told)
    found = pyimu.close(log, parse_part(LAGS, "lags.toml"))
    assert not found.added and not found.changed, found.report()
    left = found.errors["gyro"]
    # Of the power of the reference's noise, a sixteenth of the gyro's, the lag lets half through.
    assert np.all(np.abs(left.after.per_axis / left.noise_per_axis - 1.0) < 0.03), found.report()
