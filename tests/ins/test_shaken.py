"""A body whose engine runs at rest: its rests are found, and drives that shake alike are none."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from pyimu import Recording
from pyimu.attitude.rest import find_rest
from pyimu.ins import run
from pyimu.ins.noise import Noise
from pyimu.ins.vibration import vibration_of, whitened
from pyimu.recording.clock import runs

HZ = 200.0

RATE_NOISE, FORCE_NOISE = np.radians(0.05), 0.04
"""Of a sample at that rate: those of an MPU-6050, 0.005 deg/s/sqrt(Hz) and 400 ug/sqrt(Hz)."""

LEGS = ((0.8, 0.0), (1.0, 90.0), (0.6, 0.0), (1.2, 0.0))
"""m/s of a drive along x, and deg of the turn on the spot at its end."""


def engine(time, seed, shakes=True):
    """What an engine of 43 Hz that hunts by 2 % makes of rates and forces: 4 deg/s and 1 m/s^2,
    root mean squares of an axis, with a harmonic.
    """
    rng = np.random.default_rng(seed)
    steps = np.convolve(rng.standard_normal(len(time)), np.ones(100) / 10.0, "same")
    phase = 2 * np.pi * np.cumsum(43.0 * (1 + 0.02 * steps)) / HZ

    def shaking(size):
        waves = [
            np.sin(phase + p) + 0.4 * np.sin(2 * phase + q) for p, q in rng.uniform(0, 6, (3, 2))
        ]
        return shakes * size * np.transpose(waves) / np.sqrt(0.5 * (1 + 0.4**2))

    return shaking(np.radians(4.0)), shaking(1.0)


def mowing(seed, engine_at_rest=True):
    """A log of rests of 5 s, drives of 6 s whose speed comes and goes within 1 s, and turns; and
    speed, turn rate and place along the first leg's axes at each row.
    """
    rng = np.random.default_rng(1000 + seed)
    speed, turn = [np.zeros(round(8 * HZ))], [np.zeros(round(8 * HZ))]
    up = 0.5 - 0.5 * np.cos(np.pi * np.arange(HZ) / HZ)
    for fast, degrees in LEGS:
        drive = fast * np.concatenate([up, np.ones(round(4 * HZ)), up[::-1]])
        spot = np.radians(degrees) * (1 - np.cos(2 * np.pi * np.arange(2 * HZ) / (2 * HZ))) / 2
        spot = spot if degrees else spot[:0]
        rest = np.zeros(round(5 * HZ))
        speed += [drive, rest, 0 * spot, rest]
        turn += [0 * drive, rest, spot, rest]
    speed, turn = np.concatenate(speed), np.concatenate(turn)
    time, yaw = np.arange(len(speed)) / HZ, np.cumsum(turn) / HZ
    place = np.cumsum(speed[:, None] * np.stack([np.cos(yaw), np.sin(yaw)], axis=1), axis=0) / HZ
    rates, forces = engine(time, seed)
    on = 1.0 if engine_at_rest else ((speed > 0) | (turn != 0))[:, None]
    rate = np.stack([0 * turn, 0 * turn, turn], axis=1) + [0.01, -0.02, 0.015] + on * rates
    force = np.stack([np.gradient(speed, time), speed * turn, 0 * turn + 9.80665], axis=1)
    gyro = rate + RATE_NOISE * rng.standard_normal(rate.shape)
    accel = force + on * forces + FORCE_NOISE * rng.standard_normal(rate.shape)
    return Recording.from_arrays(time=time, gyro=gyro, accel=accel), speed, turn, place


@pytest.mark.parametrize("part", ("mpu6050", None))
@pytest.mark.parametrize("seed", range(2))
def test_an_engine_that_idles_leaves_rests_and_makes_none(part, seed):
    """Each of the rests is found, no row that moves faster than 5 cm/s or 2 deg/s counts, and the
    end is as far off as is claimed, to the 1e-4 of chi-square with two degrees.
    """
    log, speed, turn, place = mowing(seed)
    found = run(log, part, method="filter", heading0=0.0)
    assert not found.still[(speed > 0.05) | (np.abs(turn) > np.radians(2.0))].any()
    rests = runs((speed == 0) & (turn == 0))
    assert all(found.still[a:b].mean() > 0.5 for a, b in rests)
    assert "shakes_at_rest" in {f.kind for f in found.findings}
    track = found.tracks["filter"]
    off, std = (track.position[-1, :2] - place[-1]), track.position_std[-1, :2]
    both = track.correlation[-1] * std[0] * std[1]
    spread = np.array([[std[0] ** 2, both], [both, std[1] ** 2]])
    assert off @ np.linalg.solve(spread, off) < chi2.isf(1e-4, 2)
    assert np.linalg.norm(std) < 3.0


def test_a_body_that_shakes_as_it_moves_does_not_at_rest():
    log, *_ = mowing(5, engine_at_rest=False)
    assert vibration_of(log) is None
    assert vibration_of(mowing(5)[0]).force == pytest.approx(1.0, rel=0.1)


def test_a_log_of_one_even_drive_is_no_rest():
    """Nothing tells it from an engine that idles; 0.8 m/s from 9 s on, for 4 s."""
    log, *_ = mowing(5)
    drive = log.slice(round(9.2 * HZ), round(12.8 * HZ))
    assert vibration_of(drive) is None
    assert not run(drive, "mpu6050", method="filter").still.any()


def test_what_is_left_of_a_line_is_made_white_and_a_constant_stays():
    """Of an AR(2) process with a line at a fifth of the sample rate and 2,000 rows: correlations of
    white noise are below 4 over the root of their number, and the size is that of the spectrum at
    0 Hz, to 4 times the scatter that six estimated numbers leave of it.
    """
    rng, n = np.random.default_rng(0), 2000
    noise = np.zeros((n, 3))
    for k in range(2, n):
        noise[k] = 1.6 * 0.9 * np.cos(0.4 * np.pi) * noise[k - 1] - 0.81 * noise[k - 2]
        noise[k] += rng.standard_normal(3)
    at_zero = 1 / (1 - 1.6 * 0.9 * np.cos(0.4 * np.pi) + 0.81)
    log = Recording.from_arrays(
        time=0.1 * np.arange(n), gyro=1e-3 * noise + 0.01, accel=0.01 * noise + [0, 0, 9.8]
    )
    rest = replace(find_rest(log), seen=True, rows=slice(0, n))
    none = Noise(np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3))
    white, size = whitened(log, rest, none)
    left = white.gyro - white.gyro.mean(axis=0)
    near = np.sum(left[1:] * left[:-1], axis=0) / np.sum(left**2, axis=0)
    assert np.all(np.abs(near) < 4 / np.sqrt(n))
    assert white.gyro.mean(axis=0) == pytest.approx(log.gyro.mean(axis=0), abs=1e-5)
    assert size.rate == pytest.approx(1e-3 * at_zero, rel=4 * np.sqrt(6 / n))
    assert size.force == pytest.approx(1e-2 * at_zero, rel=4 * np.sqrt(6 / n))
