"""The rover's system: what is wired to what, how long it runs, and what is refused in a line."""

import math
import os
import subprocess
import sys
import zipfile

import pytest
from lxml import etree
from places import CHECKOUT

from pyimu.errors import UserError
from pyimu.model.part import Part, input_variables
from pyimu.model.part_file import part
from pyimu.plant.rover_variables import DRIVES, OUTPUTS
from pyimu.rover.system import connections, rover_system, write_rover

SMALL = Part("small", 100.0)


@pytest.fixture
def without_compiling(monkeypatch):
    """Units without libraries: the wiring looks at descriptions alone."""
    monkeypatch.setattr(
        "pyimu.fmu.build._compile", lambda name, texts, forms, *_: {f: b"" for f in forms}
    )


def test_a_sensor_is_wired_to_all_of_the_motion_that_its_effects_need():
    """Its attitude to the drive's quaternion; what the drive does not show stays as it starts."""
    needs = ("rate", "specific_force", "temperature", "mag", "attitude", "supply", "latitude")
    wires = connections(OUTPUTS, input_variables(needs))
    assert set(wires) == {
        ("Drive.rate", "Sensor.rate"),
        ("Drive.specific_force", "Sensor.specific_force"),
        ("Drive.temperature", "Sensor.temperature"),
        ("Drive.mag", "Sensor.mag"),
        ("Drive.q", "Sensor.attitude"),
        ("Sensor.gyro", "LowPass.gyro"),
        ("Sensor.accel", "LowPass.accel"),
        ("LowPass.filtered_gyro", "Filter.gyro"),
        ("LowPass.filtered_accel", "Filter.accel"),
        ("Sensor.measured_temperature", "Filter.temperature"),
    }


@pytest.mark.parametrize(
    "drive, seconds",
    (
        ("straight", 60 + 5 / 0.01 + 2 + 10),
        ("ackermann", 60 + math.pi * 1.25 / 0.01 + 2 + 10),
        ("turn_on_spot", 60 + 2 * (math.pi / 0.02 + 2) + 10),
        ("free", 60),
    ),
)
def test_a_drive_ends_after_its_way_a_ramp_and_a_rest(without_compiling, tmp_path, drive, seconds):
    system = rover_system(SMALL, tmp_path, drive)
    assert system.stop_time == round(seconds)
    assert system.components[0].parameters["drive"] == DRIVES[drive]


def test_the_filter_is_told_where_the_drive_is(without_compiling, tmp_path):
    mars = {"Drive": {"gravity": 3.71, "latitude": 0.1}, "Sensor": {}, "Filter": {"std0[1]": 0.2}}
    system = rover_system(SMALL, tmp_path, parameters=mars)
    assert system.components[3].parameters == {
        "gravity": 3.71,
        "latitude": 0.1,
        "std0[1]": 0.2,
        "sample_period": 0.01,
    }


@pytest.mark.long
def test_a_specimens_coefficients_are_parameters_of_the_sensor(without_compiling, tmp_path):
    """Those that its part has not; the unit, and what the filter knows, are the part's."""
    stim300 = part("stim300")
    nominal, drawn = (rover_system(stim300, tmp_path, specimen=s) for s in (None, 5))
    files = [c.fmu.read_bytes() for c in drawn.components]
    assert [c.fmu.read_bytes() for c in nominal.components] == files
    assert drawn.components[3].parameters == nominal.components[3].parameters
    specimen, own = stim300.specimen(5), nominal.components[1].parameters
    bound = {n: x for n, x in drawn.components[1].parameters.items() if n not in own}
    for sensor, axis in ((specimen.gyro, 1), (specimen.accel, 3)):
        bias = sensor.values["turn_on_bias"]["b0"][axis - 1]
        assert bound[f"{sensor.kind}_error.turn_on_bias.b0[{axis}]"] == bias != 0
    with pytest.raises(UserError, match="no tolerances"):
        rover_system(SMALL, tmp_path, specimen=5)


@pytest.mark.parametrize(
    "given, words",
    (
        ({"drive": "straigt"}, "drive 'straigt': unknown, did you mean straight\\?"),
        ({"form": "block"}, "units of FMI 2 or 3, not of form block"),
        ({"parameters": {"Drve": {}}}, "has no unit Drve, did you mean Drive\\?"),
        ({"parameters": {"Drive": {"gravty": 1}}}, "no parameter gravty, did you mean gravity\\?"),
        (
            {"parameters": {"Drive": {"latitude": 2.0}}},
            "latitude is 2 rad, expected -1.57.* to 1.57",
        ),
        (
            {"parameters": {"LowPass": {"cutoff": -1.0}}},
            "cutoff = -1.0 must be a number in 0 to inf",
        ),
    ),
)
def test_what_is_wrong_is_one_clear_line(without_compiling, tmp_path, given, words):
    with pytest.raises(UserError, match=words):
        rover_system(SMALL, tmp_path, **given)


def test_the_ssp_holds_its_units_and_nothing_is_left_beside_it(without_compiling, tmp_path):
    path = write_rover(SMALL, tmp_path / "out", "obstacle", seed=3)
    assert list(path.parent.iterdir()) == [path]
    with zipfile.ZipFile(path) as archive:
        names = set(archive.namelist())
        root = etree.fromstring(archive.read("SystemStructure.ssd"))
    units = [c.get("source") for c in root.iter("{*}Component")]
    assert units == [
        f"resources/{n}.fmi2.fmu" for n in ("RoverDrive", "ImuSensor", "LowPass", "AttitudeUkf")
    ]
    assert set(units) < names and len(list(root.iter("{*}Connection"))) == 6 + 1 + 6 + 6 + 1


def test_the_command_refuses_before_it_builds(pyimu, tmp_path):
    status, out, err = pyimu("build", "imt30", "--ssp", "obstacl", "--out", "new")
    assert (status, out) == (2, "") and "did you mean obstacle?" in err
    status, out, err = pyimu(
        "build", "imt30", "--ssp", "obstacle", "--fmi", "block", "--out", "new"
    )
    assert (status, out) == (2, "") and "FMI 2 or 3" in err
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("compiled", (False, True))
def test_a_disk_without_room_is_one_line_and_leaves_nothing(compiled, tmp_path):
    """No file may have more than 4 kB here: while it compiles, or while it writes the unit."""
    resource = pytest.importorskip("resource", reason="the system limits no sizes of files")
    environment = os.environ | {
        "PYIMU_CACHE": str(tmp_path / "cache"),
        "PYTHONPATH": str(CHECKOUT),
        "PYTHONDONTWRITEBYTECODE": "1",
        "NUMBA_CACHE_DIR": str(tmp_path),
    }
    words = [sys.executable, "-m", "pyimu", "build", "imt30", "--fmu", "sensor", "--fmi", "2"]
    if compiled:
        subprocess.run([*words, "--out", tmp_path / "first"], env=environment, check=True)
    done = subprocess.run(
        [*words, "--out", tmp_path / "out"],
        env=environment,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2 and not done.stdout
    assert len(done.stderr.splitlines()) == 1 and done.stderr.startswith("pyimu: ")
    if compiled:
        assert "ImuSensor.fmi2.fmu: cannot be written (File too large)" in done.stderr
    assert not (tmp_path / "out").exists() or not list((tmp_path / "out").iterdir())
