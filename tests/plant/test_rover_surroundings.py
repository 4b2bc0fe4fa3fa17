"""What surrounds the rover of ``RoverDrive``: sun, field, temperature, vibration, the bodies."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu.plant.bodies import BODIES
from pyimu.plant.rover_drive import STANDSTILL
from pyimu.plant.vibration import CREEP
from pyimu.rover.drives import drive

STANDING = {"sample_rate": 1.0, "rest": 0.0, "roughness": 0.01, "terrain": 5, "heading0": 0.5}


def in_world(m, vector):
    return Rotation.from_quat(m.q, scalar_first=True).apply(vector)


# Bodies


@pytest.mark.parametrize(
    ("name", "year"),
    [("Earth", 365.2422), ("Mars", 686.980), ("Moon", 365.2564)],
)
def test_day_and_rotation_of_a_body_belong_together(name, year):
    """In a year there is a solar day less than there are turns: 2 pi / rotation = 1 / (1 / day +
    1 / year). The Moon's year is the Earth's sidereal one. The figures have six digits and more.
    """
    body = BODIES[name]
    turns = body.rotation_rate / (2 * np.pi)
    assert abs(turns - 1 / body.solar_day - 1 / (year * 86400)) < 1e-5 * turns


@pytest.mark.parametrize(
    ("name", "gm", "radius"), [("Mars", 4.28284e13, 3389.5e3), ("Moon", 4.9028e12, 1737.4e3)]
)
def test_gravity_of_a_body_is_that_of_its_mass(name, gm, radius):
    assert abs(BODIES[name].gravity - gm / radius**2) < 0.0006


@pytest.mark.parametrize("name", BODIES)
def test_a_body_is_heard_in_force_rate_and_field(name):
    m, body = drive("straight", body=name, length=0.1, **STANDING), BODIES[name]
    np.testing.assert_allclose(
        np.linalg.norm(m.specific_force[:50], axis=1), body.gravity, rtol=1e-12
    )
    np.testing.assert_allclose(np.linalg.norm(m.rate[:50], axis=1), body.rotation_rate, rtol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(m.mag, axis=1), body.field_strength, rtol=1e-12)


def test_the_earths_field_is_that_of_noordwijk():
    """By the World Magnetic Model 2010 in the middle of 2011, to the digits that ``BODIES`` has."""
    geomag = pytest.importorskip("pygeomag", reason="needs pygeomag: pip install pygeomag")
    want = geomag.GeoMag(coefficients_file="wmm/WMM_2010.COF").calculate(
        glat=52.22, glon=4.42, alt=0, time=2011.5
    )
    m = drive("straight", length=0.1, **STANDING)
    north_up = in_world(m, m.mag)[0][[1, 0, 2]] * 1e9
    np.testing.assert_allclose(north_up, [want.x, want.y, -want.z], atol=0.5)


# The sun


def sun_by_rotations(m, hour_angle):
    """The sun (n, 3), east-north-up: from its meridian, turned by hour angle and latitude."""
    declination, latitude = m.parameters["solar_declination"], m.parameters["latitude"]
    equatorial = [np.cos(declination), 0.0, np.sin(declination)]  # its own meridian, east, pole
    turned = Rotation.from_euler("z", -hour_angle[:, None]).apply(equatorial)
    level = Rotation.from_euler("y", latitude).apply(turned)  # up, east, north
    return level[:, [1, 2, 0]]


@pytest.mark.parametrize("start", [-2.0, 0.0, 1.5])
def test_the_sun_stands_where_hour_angle_and_declination_say(start):
    given = {"solar_declination": 0.3, "hour_angle": start, "latitude": 0.6, "solar_day": 2000.0}
    m = drive("straight", length=3.0, **STANDING, **given)
    want = sun_by_rotations(m, start + 2 * np.pi * m.time / 2000.0)
    np.testing.assert_allclose(in_world(m, m.sun), want, atol=1e-14)
    np.testing.assert_array_equal(m.sun_visible, want[:, 2] > 0)


def test_at_noon_the_sun_is_in_the_south_and_then_goes_west():
    m = drive("straight", length=0.1, **STANDING)
    sun = in_world(m, m.sun)
    np.testing.assert_allclose(np.arcsin(sun[0, 2]), np.pi / 2 - np.deg2rad(52.22), atol=1e-6)
    assert sun[0, 1] < 0 and np.all(np.diff(sun[:, 0]) < 0)


# Temperature


def test_the_temperature_is_that_of_a_body_with_one_time_constant_in_a_sols_air():
    given = {"start_temperature": -40.0, "warm_up": 8.0, "warm_up_time": 300.0}
    sol = {
        "temperature_swing": 30.0,
        "warmest_hour_angle": 0.5,
        "hour_angle": -1.0,
        "solar_day": 3000.0,
    }
    m = drive("straight", length=5.0, **STANDING, **given, **sol)
    air = -40.0 + 30.0 * np.cos(2 * np.pi * m.time / 3000.0 - 1.5)
    own = m.temperature - air
    slope = (own[2:] - own[:-2]) / 2.0  # its third derivative is 8 / 300^3 at most
    np.testing.assert_allclose(slope, (8.0 - own[1:-1]) / 300.0, atol=8 / 300**3 / 6 * 1.1)
    assert abs(own[0] - 8.0 * (1 - np.exp(-1 / 300.0))) < 1e-12


# Vibration

LINES = {"motor_frequency": 40.0, "motor_rate": (0.01, 0.02, 0.03), "motor_force": (0.1, 0.2, 0.3)}


def line(x, time, frequency):
    """Amplitude (3,) of a line in the rows x (n, 3), over whole periods."""
    return np.abs(2 * np.mean(x * np.exp(-2j * np.pi * frequency * time)[:, None], axis=0))


def test_motors_make_lines_of_the_amplitudes_asked_for():
    """At speed v they run by v^2 / (v^2 + CREEP^2); the rates of rotations about three axes mix in
    second order, by the angle of 1e-4 rad.
    """
    given = {"sample_rate": 976.0, "length": 0.2, "roughness": 0.0, "start_time": 3.0}
    m, calm = drive("straight", **given, **LINES), drive("straight", **given)
    cruise = (m.time > 6) & (m.time <= 16)
    share = 0.01**2 / (0.01**2 + CREEP**2)
    for name, amplitude in (
        ("rate", LINES["motor_rate"]),
        ("specific_force", LINES["motor_force"]),
    ):
        found = line((getattr(m, name) - getattr(calm, name))[cruise], m.time[cruise], 40.0)
        tilt = 9.81 * 0.03 / (2 * np.pi * 40) if name == "specific_force" else 0.0
        assert np.abs(found - share * np.array(amplitude)).max() < 1.5e-4 * max(amplitude) + tilt
    still = m.standing == 1  # slower than STANDSTILL
    left = (STANDSTILL / CREEP) ** 2 * 0.3
    np.testing.assert_allclose(m.outputs[still], calm.outputs[still], atol=left, rtol=0)


def test_treads_make_lines_in_proportion_to_speed_and_its_square():
    given = {"sample_rate": 50.0, "length": 0.4, "roughness": 0.0, "start_time": 0.0}
    treads = {
        "tread_rate": (0.0, 0.002, 0.0),
        "tread_force": (0.0, 0.0, 0.05),
        "tread_spacing": 0.02,
    }
    for speed, frequency in ((0.01, 0.5), (0.02, 1.0)):
        m = drive("straight", **given, **treads, cruise_speed=speed)
        cruise = (m.time > 4) & (m.time <= 4 + 8)
        rate = line(m.rate[cruise], m.time[cruise], frequency)
        np.testing.assert_allclose(rate[1], 0.002, rtol=1e-3)
        up = line(m.specific_force[cruise], m.time[cruise], frequency)
        np.testing.assert_allclose(up[2], 0.05, rtol=1e-3)
    slow = drive("turn_on_spot", **given | {"angle": 0.3}, **treads)
    assert np.abs(slow.rate[slow.standing == 1][:, 1]).max() < 1e-4  # nothing turns, nothing shakes
