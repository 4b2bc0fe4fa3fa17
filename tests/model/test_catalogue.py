"""Effects of a user's own: known by name to parts, processes and commands once they are added."""

import pickle
import subprocess
import sys

import numpy as np
import pytest

import pyimu
from pyimu.errors import UserError
from pyimu.model.catalogue import CATALOGUE, POWER_ON, WALK, WHITE
from pyimu.model.effects import EFFECTS
from pyimu.model.part_reader import parse_part
from pyimu.model.sensor import Sensor

FILE = """
from pyimu import Parameter, effect


@effect(stage="gain", term="made up", equation="y = {factor} k x", source="made up")
def of_my_own(x, k: Parameter("1", description="made up")):
    return x + {factor} * k * x
"""

PART = """
name = "mine"
sample_rate = {value = 100.0, unit = "Hz"}
[gyro.of_my_own]
k = 0.5
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(FILE.format(factor=1))
    yield path
    CATALOGUE.remove(*{e.name for e in CATALOGUE.values()} - {e.name for e in EFFECTS})


def answer(sensor):
    """Its output to a rate of one about each axis."""
    u = np.zeros(sensor.chain.u.numel())
    u[:3] = 1.0
    return np.array(sensor.step(sensor.chain.start, u, sensor.p, [], 0.01)[1]).ravel()


def test_a_part_may_have_an_effect_of_a_file(file):
    with pytest.raises(UserError, match="unknown effect"):
        parse_part(PART)
    (mine,) = pyimu.add_effects(file)
    assert mine.file == str(file) and CATALOGUE["of_my_own"] is mine
    np.testing.assert_array_equal(answer(parse_part(PART).gyro), 1.5)


def test_a_file_that_was_changed_takes_the_place_of_its_older_self(file):
    pyimu.add_effects(file)
    old = parse_part(PART).gyro
    file.write_text(FILE.format(factor=3))
    pyimu.add_effects(file)
    np.testing.assert_array_equal(answer(parse_part(PART).gyro), 2.5)
    np.testing.assert_array_equal(answer(old), 1.5)


def test_an_effect_that_was_defined_here_needs_no_file(file):
    @pyimu.effect(stage="bias", term="made up", equation="y = x + b", source="made up")
    def local(x, b: pyimu.Parameter("{y}", description="made up")):
        return x + b

    assert pyimu.add_effects(local) == (local,)
    np.testing.assert_array_equal(answer(Sensor("gyro", {"local": {"b": 2.0}})), 3.0)


def test_a_sensor_goes_to_another_process_with_its_effects(file, tmp_path):
    pyimu.add_effects(file)
    (tmp_path / "sensor").write_bytes(pickle.dumps(parse_part(PART).gyro))
    program = "import pickle, sys; print(pickle.load(open(sys.argv[1], 'rb')).p.tolist())"
    command = [sys.executable, "-c", program, str(tmp_path / "sensor")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[0.5, 0.5, 0.5]"


@pytest.mark.parametrize(
    "text, says",
    [
        ("x = 1", "defines no effect"),
        ("x = ", "SyntaxError"),
        ("1 / 0", "ZeroDivisionError"),
        (FILE.format(factor=1).replace("of_my_own", "scale_factor"), "there is one of this name"),
        (FILE.format(factor=1).replace('"1"', '"furlong"'), "is not a unit"),
    ],
)
def test_a_file_that_cannot_be_used_says_why_and_adds_nothing(file, text, says):
    file.write_text(text)
    with pytest.raises(UserError, match=says) as caught:
        pyimu.add_effects(file)
    assert "\n" not in str(caught.value) and len(CATALOGUE) == len(EFFECTS)


def test_files_that_are_not_there_or_no_python(tmp_path):
    (tmp_path / "mine.txt").write_text("")
    for name, says in (("none.py", "no such file"), ("mine.txt", "ends in .py")):
        with pytest.raises(UserError, match=says):
            pyimu.add_effects(tmp_path / name)


def test_an_older_self_stays_where_the_newer_cannot_be_added(file):
    (mine,) = pyimu.add_effects(file)
    file.write_text(FILE.format(factor=1).replace("of_my_own", "scale_factor"))
    with pytest.raises(UserError):
        pyimu.add_effects(file)
    assert CATALOGUE["of_my_own"] is mine


def test_effects_that_generic_code_asks_for_are_told_by_their_properties():
    assert POWER_ON == ("turn_on_bias", "b0")
    assert WHITE == ("angle_random_walk", "N") and WALK == ("rate_random_walk", "K")
