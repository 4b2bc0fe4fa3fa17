"""What lasts of the errors of a vehicle's wheels: scale, delay and place of a measured speed, and
the angle by which it crabs."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
from navigation_cases import calibrated, declared, noisy, perfect, white
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.block.block import Run
from pyimu.block.parameters import with_values
from pyimu.ins import run
from pyimu.ins.crabbing import crabbing
from pyimu.ins.filter.ins_block import ins_of_log
from pyimu.ins.filter.layout import Layout
from pyimu.ins.track import Track
from pyimu.rover.trajectory import Drive

DRIVE = Drive(legs=1, side=20.0, speed=1.0, first_rest=5.0, stops=3.0, ramp=2.0)
RATE, RUNS = 50.0, 6
SCALE, STD = 0.02, 0.01
SHAKEN = 0.2
"""m/s^2; of which the difference from sample to sample shakes the body: it comes back."""


@pytest.fixture(scope="module")
def truth():
    return declared(perfect(DRIVE, RATE), DRIVE)


def driven(truth, seed, late=0):
    """A drive beside a speed of another scale each time that is ``late`` rows late."""
    rng = np.random.default_rng(5000 + seed)
    log = noisy(truth, white(calibrated()), seed)
    speed = np.linalg.norm(truth.ref_velocity, axis=1) * (1 + SCALE * rng.standard_normal())
    speed = np.concatenate([np.zeros(late), speed[: len(speed) - late]])
    seen = np.where(np.arange(len(speed)) % 10 == 0, speed, np.nan)
    seen = seen + STD * rng.standard_normal(len(speed))
    return replace(log, speed=seen, speed_std=np.full(len(speed), STD))


@pytest.mark.parametrize("late", (0, 5))
def test_the_path_is_no_surer_than_the_scale_of_its_speed(truth, late):
    """The sum of squares is that of as many normal numbers; one in 10,000 is larger. Taken for
    noise of each sample, 2 % of 20 m was known to 3 cm."""
    total = 0.0
    for seed in range(RUNS):
        found = run(driven(truth, seed, late), white(calibrated()), method="filter", heading0=0.0)
        track = found.tracks["filter"]
        off = track.position[-1, 0] - truth.ref_east[-1] + truth.ref_east[0]
        total += (off / track.position_std[-1, 0]) ** 2
    assert total < chi2.isf(1e-4, RUNS)
    assert found.filter.scalar("speed_nis").max() > 0


def late_and_std(log):
    """s; by how much the filter finds the speed of a log late at its end, and how well it claims to
    know that."""
    layout = Layout(white(calibrated()), wheels=True)
    block = ins_of_log(layout)
    names = [v.name for v in block.inputs]
    u = np.tile(block.start_inputs, (len(log), 1))
    u[:, :3], u[:, 3:6], u[:, names.index("stationary")] = log.gyro, log.accel, log.stationary
    seen = np.isfinite(log.speed)
    u[:, names.index("speed_valid")] = seen
    u[:, names.index("speed")] = np.where(seen, log.speed, 0.0)
    u[:, names.index("speed_variance")] = STD**2
    known = with_values(block, {"speed_late_std": 0.1})
    state = Run(block, len(u), p=known, sample_period=log.sample_period)
    state.advance(u)
    x, at = layout.unpack(ca.DM(state.state)), layout.of_wheels.start + 1
    late, variance = (np.array(ca.evalf(v)).item() for v in (x.wheels[1], x.covariance[at, at]))
    return late, float(np.sqrt(variance))


def test_what_shakes_a_body_makes_no_speed_less_late(truth):
    """Beside forces that shake by 0.3 m/s^2 0.1 s was found to be a fifth of it: a slope beside
    what is itself in error is too small. The sum of squares is that of as many
    normal numbers; one in 10,000 is larger."""
    total = 0.0
    for seed in range(RUNS):
        log = driven(truth, seed, late=5)
        shaken = np.random.default_rng(6000 + seed).standard_normal(log.accel.shape)
        log = replace(log, accel=log.accel + SHAKEN * np.diff(shaken, axis=0, prepend=0))
        late, std = late_and_std(log)
        total += ((late - 5 / RATE) / std) ** 2
    assert total < chi2.isf(1e-4, RUNS)


def test_a_speed_beside_no_rate_is_late_by_half_its_interval(truth):
    found = run(driven(truth, 0), white(calibrated()), method="filter", heading0=0.0)
    assert found.settings["speed_late_std"] == pytest.approx(5 / RATE, rel=1e-6)


def crabbed(std, time, seed):
    """The track of a vehicle at 5 m/s that turns and crabs, with an arm of 0.5 m, and its rate."""
    h, n, rng = 0.1, 6000, np.random.default_rng(5000 + seed)
    kept, angle = np.exp(-h / time), np.zeros(n)
    for k in range(1, n):
        angle[k] = kept * angle[k - 1] + np.sqrt(1 - kept**2) * std * rng.standard_normal()
    rate = 0.3 * np.sin(0.2 * h * np.arange(n))
    yaw = np.cumsum(rate) * h
    turn = Rotation.from_rotvec(np.outer(yaw, [0, 0, 1]))
    angle += 0.02
    body = 5 * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    body[:, 1] += 0.5 * rate
    q = turn.as_quat(scalar_first=True)
    noise = np.full((n, 3), 0.002)
    place = np.zeros((n, 3))
    track = Track("smoother", h * np.arange(n), q, turn.apply(body), place)
    return replace(track, velocity_std=noise, attitude_std=noise), rate


def test_how_a_vehicle_crabs_is_read_off_its_path():
    """Mounting and arm are no crabbing. 600 s of 8 s tell its variance to a sixth."""
    found = [crabbing(*crabbed(0.015, 8.0, seed)) for seed in range(8)]
    assert np.median([f.std for f in found]) == pytest.approx(0.015, rel=0.2)
    assert np.median([f.time for f in found]) == pytest.approx(8.0, rel=0.4)
    none = crabbing(*crabbed(0.0, 8.0, 0))
    assert none is None or none.std < 1e-3
