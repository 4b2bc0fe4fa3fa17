"""The sensors' errors are undone in the filter, whatever the effect: an attitude as of sensors
without errors.
"""

import casadi as ca
import numpy as np
import pytest
from attitude_cases import H, drive, error, output, parameters, rover_rate
from catalogue_cases import CASES, everything, excited

from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter.compensation import noise_of
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor

N = 1000
WORLD_ALONE = ("earth_rate", "transport_rate")
"""They come with a turning Earth, which the drives of this file are without."""

QUICK = ("scale_factor", "thermal_bias", "clock_skew", "rate_ramp", "g_sensitivity")
"""Effects of the accelerometer that are undone in the short run, too; of the gyro all are."""

UNDONE = [
    pytest.param(name, kind, marks=() if kind == "gyro" or name in QUICK else pytest.mark.long)
    for name, kind in CASES
    if not CATALOGUE[name].stochastic and CATALOGUE[name].invertible and name not in WORLD_ALONE
    # Behind a lag rates are those of instants, and here the means of periods.
    if not (kind == "gyro" and CATALOGUE[name].delay)
]
SMALL = {"angular_acceleration": 0.005}
"""Shares for effects that are undone in rounds, which leave the fourth power of their size."""


@pytest.fixture(scope="module")
def world():
    """A drive, and the course of all that effects may depend on."""
    t, driven = H * np.arange(1, N + 1), drive(rover_rate(N))
    signals = {
        "rate": driven.rate,
        "specific_force": driven.force,
        "temperature": 25 + 10 * np.sin(t / 5),
        "supply": 3.3 + 0.1 * np.sin(t),
        "mag": 1e-5 * np.column_stack([3 * np.cos(t), 3 * np.sin(t), np.full(N, -4.0)]),
        "attitude": driven.attitude.as_quat(scalar_first=True),
        "latitude": np.full(N, 0.8),
        "velocity": np.zeros((N, 3)),
    }
    return driven, signals


def columns(block, signals: dict) -> np.ndarray:
    """A block's inputs (n, nu) from signals by name, what is not among them at its start value."""
    out = np.tile([v.start for v in block.inputs], (N, 1))
    for i, variable in enumerate(block.inputs):
        name, _, axis = variable.name.partition("[")
        if name in signals:
            out[:, i] = signals[name][:, int(axis[:-1]) - 1] if axis else signals[name]
    return out


def off(part: Part, measured: np.ndarray, world) -> float:
    """Largest attitude error in rad of the part's filter, which starts at the truth and trusts the
    gyro alone; the field is no heading to it.
    """
    driven, signals = world
    block = attitude_ukf(part)
    u = columns(block, {**signals, "gyro": measured[:, :3], "accel": measured[:, 3:6]})
    std0 = np.array([1e-4] * 3 + [1e-7] * 3)
    p = parameters(block, std0=std0, field_tolerance=0, accel_std=0.1)
    y, state = block.run(u, p=p)
    assert np.isfinite(state).all()
    return np.linalg.norm(error(output(block, y, "q"), driven.attitude), axis=1).max()


def part_of(kind: str, sensor: Sensor) -> Part:
    return Part(
        "test", 1 / H, **({"gyro": Sensor("gyro"), "accel": Sensor("accel")} | {kind: sensor})
    )


@pytest.mark.parametrize("name, kind", UNDONE)
def test_declared_effect_is_undone(name, kind, world):
    """To rounding, and where errors follow from what is not affine in the sensor's input to the
    precision of two steps of Newton's: a fiftieth of what the effect does where it is left in.
    """
    part = part_of(kind, excited(name, kind, SMALL.get(name, 0.05)))
    measured, _ = part.block.run(columns(part.block, world[1]))
    left_in = off(part_of(kind, Sensor(kind)), measured, world)
    assert off(part, measured, world) < min(left_in / 50, 2e-7)
    if kind == "gyro":
        assert left_in > 1e-5, "the effect is large enough to be seen"


def test_rounding_counts_as_white_noise_and_what_is_not_undone_is_said():
    """A step q leaves q^2/12 in a sample; the FMU's description names what stays in."""
    sensor = Sensor(
        "gyro",
        {
            "angle_random_walk": {"N": 1e-3},
            "quantization": {"q": 0.02},
        },
    )
    noise = noise_of(sensor, ca.SX(ca.DM(sensor.p)), H)
    np.testing.assert_allclose(
        np.array(ca.evalf(noise.white)).ravel() ** 2, 1e-3**2 + 0.02**2 * H / 12, rtol=1e-12
    )
    blocks = [
        attitude_ukf(part_of("gyro", s))
        for s in (sensor, Sensor("gyro", {"angle_random_walk": {"N": 1e-3}}))
    ]
    u = np.tile([v.start for v in blocks[0].inputs], (200, 1))
    grown = [
        output(b, b.run(u, p=parameters(b, std0=np.full(6, 1e-9), rest_time=0))[0], "std")[-1, 2]
        ** 2
        for b in blocks
    ]
    np.testing.assert_allclose(grown[0] - grown[1], 0.02**2 * H / 12 * 200 * H, rtol=1e-3)
    assert "quantization of the gyro" in blocks[0].description
    assert "quantization" not in blocks[1].description
    assert "lag" not in attitude_ukf(part_of("gyro", excited("lag", "gyro"))).description


@pytest.mark.parametrize("horizon", [10.0, 100.0])
def test_what_stands_for_a_gauss_markov_process_grows_as_it_does_over_the_horizon(horizon):
    """Of a process much faster than the horizon the sum over it has the variance 2 s^2 tau T, less
    the share tau/T twice over; what a much slower one adds by then, s^2 T/tau twice, the walk has.
    """
    for tau, white, walk in ((0.05, 2 * 0.05, None), (5000.0, 0.0, 2.0 / 5000.0)):
        sensor = Sensor("gyro", {"gauss_markov": {"q": 1e-3 * np.sqrt(2 / tau), "tau": tau}})
        noise = noise_of(sensor, ca.SX(ca.DM(sensor.p)), H, horizon)
        found = [np.array(ca.evalf(v)).ravel()[0] ** 2 / 1e-6 for v in (noise.white, noise.walk)]
        assert found[0] == pytest.approx(white, rel=3 * 0.05 / horizon, abs=horizon**2 / 5000)
        if walk is not None:
            assert found[1] == pytest.approx(walk, rel=horizon / 5000)


@pytest.mark.parametrize("tau", [0.05, 1.0, 5.0, 30.0, 900.0, 5000.0])
def test_what_stands_for_a_gauss_markov_process_has_its_allan_variance(tau):
    """Of a process with unit variance by the integral of its density (two-sided, 2 tau / (1 + (2 pi
    f tau)^2)) with the weight 2 sin^4(pi f t) / (pi f t)^2, at both times.
    """
    sensor = Sensor("gyro", {"gauss_markov": {"q": np.sqrt(2 / tau), "tau": tau}})
    noise = noise_of(sensor, ca.SX(ca.DM(sensor.p)), H, (3.0, 10.0))
    white, walk = (np.array(ca.evalf(v)).ravel()[0] ** 2 for v in (noise.white, noise.walk))
    for t in (3.0, 10.0):
        f = np.geomspace(1e-7, 1e3, 2_000_001)
        density = 2 * tau / (1 + (2 * np.pi * f * tau) ** 2)
        seen = 4 * density * np.sin(np.pi * f * t) ** 4 / (np.pi * f * t) ** 2
        want = np.trapezoid(seen * f, np.log(f))
        assert white / t + walk * t / 3 == pytest.approx(want, rel=2e-3)


def test_a_gauss_markov_process_that_is_a_walk_has_no_white_noise():
    """Of correlation times at which the difference of the two is rounding."""
    for tau in np.geomspace(1e15, 1e24, 50):
        sensor = Sensor("gyro", {"gauss_markov": {"q": 1.0, "tau": tau}})
        noise = noise_of(sensor, ca.SX(ca.DM(sensor.p)), H, (3.0, 10.0))
        white, walk = (np.array(ca.evalf(v)).ravel()[0] for v in (noise.white, noise.walk))
        assert 0 <= white < 1e-6 and walk == pytest.approx(1.0, rel=1e-9)


@pytest.mark.long
def test_filter_of_a_part_with_every_effect_at_once_stays_finite(world):
    part = Part("test", 1 / H, everything("gyro", 0.002), everything("accel", 0.002))
    measured, _ = part.block.run(columns(part.block, world[1]), seed=1)
    assert np.isfinite(off(part, measured, world))
