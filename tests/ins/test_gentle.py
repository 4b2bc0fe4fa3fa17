"""Bodies that speed up and slow down so gently that no window shows it, on smooth floors."""

from pathlib import Path

import numpy as np
import pytest

import pyimu
from pyimu.ins import run
from pyimu.ins.pushes import LEAST_SPEED, unpushed
from pyimu.ins.speeds import _beside_drives
from pyimu.recording.clock import runs
from pyimu.rover.trajectory import square

H, FORCE = 0.01, 0.027
"""s, and m/s^2 of white noise of a sample."""

PART = Path(__file__).parents[2] / "examples" / "sparkfun6dof_assumed.toml"


@pytest.mark.parametrize("first", range(0, 60, 4))
def test_short_rests_beside_pushes_are_found_wherever_a_block_begins(first):
    """2 s of rest at each end of a leg of 0.15 m/s within 4 s. Blocks at a fixed phase of the
    stretch held parts of pushes that were alike, and the rests were lost."""
    rng = np.random.default_rng([first, 7])
    push = 0.15 / 2 * (1 - np.cos(2 * np.pi * np.arange(200) / 200))
    along = np.concatenate([np.zeros(200), push, -push, np.zeros(200)])[first:]
    speed = np.cumsum(along) * H
    force = FORCE * rng.standard_normal((len(along), 3)) + [0.1, -0.2, 9.8]
    force[:, 0] += along
    still = unpushed(force, np.full(3, FORCE), 30, H)
    assert np.abs(speed[still]).max() < LEAST_SPEED
    rests = runs(still)
    assert rests[0][0] == 0 and rests[-1][1] == len(still)
    assert min(rests[0][1], rests[-1][1] - rests[-1][0]) * H > 1.0


def test_a_line_is_a_push_and_a_rest_is_one_piece():
    """6 mm/s^2 a second for 10 s are no rest; a rest of a minute, longer than a
    piece may be, has no hole."""
    rng = np.random.default_rng(8)
    time = H * np.arange(6000)
    force = FORCE * rng.standard_normal((6000, 3)) + [0.1, -0.2, 9.8]
    assert unpushed(force, np.full(3, FORCE), 30, H).all()
    force[:, 0] += 0.006 * np.clip(time - 20.0, 0, 10.0)
    still = unpushed(force, np.full(3, FORCE), 30, H)
    assert still[:1700].all() and not still[2500:2900].any() and still[3500:].all()


@pytest.mark.parametrize("seed", (7123, 7124, 7125))
def test_no_rest_of_a_gentle_square_is_lost(seed):
    """A gyro so noisy that a leg of 9 s is known to 0.1 m/s, of which it has 0.55: a rest was
    passed over where its zero velocity was two standard deviations off, though nothing had told a
    motion before it."""
    truth = square(2.7, 0.55, np.radians(22), 4.0, ramp=3.6, tilt=(0.02, -0.01))
    part = pyimu.part(PART)
    log = part.specimen(seed).simulate(truth, seed=seed)
    found = run(log, part, method="filter")
    speed = np.linalg.norm(found.recording.ref_velocity, axis=1)
    rates = np.linalg.norm(found.recording.ref_rate, axis=1)
    stops = runs((speed < 1e-3) & (rates < 1e-3))
    assert len(stops) > 7
    assert all(found.still[a:b].any() for a, b in stops if (b - a) * H > 2)
    assert np.max(speed[found.still]) < 2 * LEAST_SPEED


def test_a_velocity_tells_a_rest_as_far_as_drives_are_faster():
    """Where the error is as large as any speed nothing is told."""
    none, own = np.zeros(3), np.array([0.3, 0.0, 0.0])
    assert _beside_drives(none, 0.01**2, 1.0) > 8
    assert _beside_drives(own, 0.01**2, 1.0) < -100
    assert abs(_beside_drives(own, 10.0**2, 0.3)) < 0.01
