"""Drives from Python, free ones from a table, and what is refused."""

import numpy as np
import pytest
from built import built
from fmpy.fmi1 import FMICallException
from fmu_toy import Unit

from pyimu.errors import UserError
from pyimu.fmu.package import BLOCKS
from pyimu.model.part_file import part
from pyimu.plant.rover_drive import rover_drive
from pyimu.rover.drives import drive, free_drive

TABLE = "time [s],speed [cm/s],turn_rate [deg/s]\n0,0,0\n5,2,0\n20,2,1\n60,0,0\n"


def test_a_drive_is_the_truth_of_a_recording():
    m = drive("ackermann", sample_rate=10.0, angle=0.2)
    log = m.recording(stationary=m.standing)
    np.testing.assert_array_equal(log.ref_q, m.q)
    np.testing.assert_array_equal(log.ref_rate, m.rate)
    np.testing.assert_array_equal(log.ref_force, m.specific_force)
    np.testing.assert_array_equal(
        np.column_stack([log.ref_east, log.ref_north, log.ref_up]), m.position
    )
    np.testing.assert_array_equal(log.moving + log.stationary, 1.0)
    assert log.time[0] == 0.1 and log.name == "ackermann" and log.latitude[0] == np.deg2rad(52.22)
    assert drive("straight", sample_rate=1.0, body="Mars").recording().mag is None


def test_a_part_measures_the_drive():
    m = drive("straight", length=0.02, start_time=1.0)
    log = part("imt30").simulate(m.recording(), seed=3)
    assert log.gyro.shape == m.rate.shape and np.ptp(log.accel[:, 2]) > 0


def test_an_unknown_attribute_is_none():
    m = drive("straight", sample_rate=1.0, length=0.02)
    with pytest.raises(AttributeError, match="a motion has no colour"):
        m.colour  # noqa: B018


def test_a_table_is_read_with_its_units(tmp_path):
    path = tmp_path / "commands.csv"
    path.write_text(TABLE)
    rows = np.array([[0, 0, 0], [5, 0.02, 0], [20, 0.02, np.pi / 180], [60, 0, 0]])
    given = free_drive(rows, sample_rate=10.0)
    np.testing.assert_array_equal(free_drive(path, sample_rate=10.0).outputs, given.outputs)
    assert abs(given.yaw[-1] - np.deg2rad(40)) < 1e-12 and len(given.time) == 700


def test_a_later_command_comes_later():
    """Before its first row the table says to stand."""
    rows = np.array([[3.0, 0.02, 0.0], [8.0, 0.0, 0.0]])
    m = free_drive(rows, sample_rate=50.0)
    assert m.standing[:150].all() and not m.standing[155:300].any()
    assert abs(m.position[-1, 0] - 0.1) < 1e-12


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("time [s],speed [m/s]\n0,1\n", "column 'turn_rate [rad/s]' is missing"),
        ("time [s],speed [rad/s],turn_rate [rad/s]\n0,1,1\n", "column 'speed [m/s]' is missing"),
        (
            "time [s],speed [m/s],turn_rate [rad/s]\n0,1,1\n0,1,1\n",
            "time must increase from 0 on, row 2",
        ),
        ("time [s],speed [m/s],turn_rate [rad/s]\n-1,1,1\n", "time must increase from 0 on, row 1"),
        ("time [s],speed [m/s],turn_rate [rad/s]\n0,1,\n", "row 1 has no number"),
        ("time [s],speed [m/s],turn_rate [rad/s]\n", "expected rows of time, speed, turn_rate"),
        ("time [s],speed [m/s],turn_rate [rad/s]\n0,fast,1\n", "row 2"),
    ],
)
def test_a_wrong_table_is_one_line(tmp_path, text, says):
    path = tmp_path / "commands.csv"
    path.write_text(text)
    with pytest.raises(UserError) as caught:
        free_drive(path, sample_rate=10.0)
    assert says in str(caught.value) and str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"radius": -1.0}, "radius is -1 m, expected 0.001 or more"),
        ({"terrain": 1.5}, "terrain is 1.5, expected a whole number"),
        ({"terrain": -1}, "terrain is -1, expected 0 to 67108857"),
        ({"latitude": 2.0}, "latitude is 2 rad, expected -1.57079633 to 1.57079633"),
        ({"boulders": 0.5}, "boulders is 0.5, expected true or false"),
        ({"lever_arm": (1.0, 2.0)}, "lever_arm is (1.0, 2.0), expected 3 numbers"),
        ({"roughnes": 0.1}, "RoverDrive has no parameter roughnes, did you mean roughness?"),
        ({"length": np.nan}, "length is 'nan', expected a finite number"),
        ({"ramp_time": 600.0}, "the drive is shorter than its ramp_time"),
        ({"boulder_height[1]": 0.7}, "roughness and boulders are too high for the suspension"),
        ({"sample_rate": 0.0}, "sample_rate is 0.0, expected a positive number of Hz"),
        ({"sample_rate": "50"}, "sample_rate is 50, expected a positive number of Hz"),
        ({"body": "Venus"}, "body 'Venus': unknown; known are Earth, Mars, Moon"),
    ],
)
def test_bad_parameters_are_one_line(given, says):
    with pytest.raises(UserError) as caught:
        drive("straight", **{"sample_rate": 10.0} | given)
    assert says in str(caught.value)


def test_an_unknown_drive_is_one_line():
    with pytest.raises(UserError, match="drive 'zigzag': unknown; known are straight, obstacle"):
        drive("zigzag")
    with pytest.raises(UserError, match="drive 'zigzag': unknown; known are free, straight"):
        rover_drive(0.02, "zigzag")


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    return built(rover_drive(1 / 50), tmp_path_factory)


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize(
    ("name", "value"), [("drive", 7), ("radius", -1.0), ("sample_period", -1.0), ("ramp_time", 1e3)]
)
def test_the_unit_refuses_them_too(fmus, version, name, value):
    with Unit(fmus[version]) as unit, pytest.raises(FMICallException):
        unit.start(**{name: value})


def test_units_of_a_part_have_its_sample_period():
    imt30 = part("imt30")
    for name in ("rover", "low-pass"):
        assert BLOCKS[name](imt30).sample_period == imt30.sample_period
