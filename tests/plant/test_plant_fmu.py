"""The units around sensor and filter are the blocks of Python, bit for bit, and as agreed."""

import numpy as np
import pytest
from built import built
from fmpy import read_model_description
from fmpy.validation import validate_fmu

from pyimu.fmu import simulate, simulate_blocks
from pyimu.plant.low_pass import low_pass
from pyimu.plant.rover_drive import rover_drive
from pyimu.plant.rover_variables import DRIVES

PERIOD = 1 / 50
ROVER, LOW_PASS = rover_drive(PERIOD), low_pass(PERIOD)
FORMS = (2, 3, "block")


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    """Name of the block to form to path."""
    return {b.name: built(b, tmp_path_factory) for b in (ROVER, LOW_PASS)}


def through(path, form, u, **start_values):
    run = simulate_blocks if form == "block" else simulate
    return run(path, u, sample_period=PERIOD, start_values=start_values)


def array(name, count):
    return [f"{name}[{i + 1}]" for i in range(count)]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", ["RoverDrive", "LowPass"])
def test_fmpy_finds_nothing_wrong(fmus, name, form):
    assert validate_fmu(str(fmus[name][form])) == []


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("drive", DRIVES)
def test_the_unit_gives_the_bits_of_python(fmus, drive, form):
    """Every drive, with boulders, vibration and commands that are missing now and then."""
    rng = np.random.default_rng(4)
    u = np.column_stack([0.01 * rng.random(1500), 0.02 * rng.standard_normal(1500)])
    if form == "block":  # fmpy would carry the others over to the row before
        u[rng.random(u.shape) < 0.05] = np.nan
    given = {
        "drive": DRIVES[drive],
        "start_time": 3.0,
        "length": 0.2,
        "angle": 0.2,
        "terrain": 5,
        "boulders": True,
        "boulder_forward[1]": 0.8,
        "motor_rate[2]": 0.01,
        "motor_force[3]": 0.1,
        "tread_rate[1]": 0.01,
        "tread_force[2]": 0.02,
        "lever_arm[3]": 0.3,
        "heading0": 1.0,
    }
    p = np.array([given.get(v.name, v.start) for v in ROVER.parameters])
    y = through(fmus["RoverDrive"][form], form, u, **given)
    np.testing.assert_array_equal(y[1:], ROVER.run(u, p=p)[0])
    first = np.array(ROVER.initial(u[0], p)[1]).ravel()
    np.testing.assert_array_equal(y[0], first)
    assert np.ptp(y, axis=0)[:3].min() > 1e-4


@pytest.mark.parametrize("form", FORMS)
def test_a_drive_begins_with_the_simulation_whenever_that_does(fmus, form):
    """Its clock is the simulation's since its start."""
    run = simulate_blocks if form == "block" else simulate
    given = {"sample_period": PERIOD, "start_values": {"start_time": 1.0, "angle": 0.1}}
    u = np.zeros((600, 2))
    early, late = (run(fmus["RoverDrive"][form], u, start_time=t, **given) for t in (0.0, 1000.0))
    np.testing.assert_array_equal(early, late)


@pytest.mark.parametrize("form", FORMS)
def test_the_low_pass_gives_the_bits_of_python(fmus, form):
    u = np.random.default_rng(1).standard_normal((700, 6))
    y = through(fmus["LowPass"][form], form, u, cutoff=4.0)
    np.testing.assert_array_equal(y[1:], LOW_PASS.run(u, p=np.array([4.0]))[0])
    np.testing.assert_array_equal(y[0], u[0])


@pytest.mark.parametrize("form", (2, 3))
def test_variables_are_named_as_agreed(fmus, form):
    causes = {}
    for v in read_model_description(str(fmus["RoverDrive"][form])).modelVariables:
        causes.setdefault(v.causality, []).append(v.name)
    assert causes["input"] == ["speed_command", "turn_rate_command"]
    assert causes["output"] == [
        *array("q", 4),
        "roll",
        "pitch",
        "yaw",
        *array("rate", 3),
        *array("specific_force", 3),
        *array("position", 3),
        "speed",
        "turn_rate",
        "temperature",
        *array("sun", 3),
        "sun_visible",
        *array("mag", 3),
        "standing",
    ]
    causes = {}
    for v in read_model_description(str(fmus["LowPass"][form])).modelVariables:
        causes.setdefault(v.causality, []).append(v.name)
    assert causes["input"] == [*array("gyro", 3), *array("accel", 3)]
    assert causes["output"] == [*array("filtered_gyro", 3), *array("filtered_accel", 3)]
