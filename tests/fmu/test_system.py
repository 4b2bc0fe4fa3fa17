"""A system of units: wiring that is wrong is refused in a line, and its SSP file follows the
standard's schema.
"""

import zipfile
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import fmpy
import numpy as np
import pytest
from built import built
from fmpy.ssp.ssd import read_ssd
from lxml import etree

from pyimu.attitude import attitude_ukf
from pyimu.errors import UserError
from pyimu.fmu.cosimulate import cosimulate
from pyimu.fmu.ssp import PARAMETERS, whole_nanoseconds, write_ssp
from pyimu.fmu.system import Component, System
from pyimu.model.part import Part, Sensor
from pyimu.model.part_file import part

IMT30 = part("imt30")
H = IMT30.sample_period
SSP1 = "{http://ssp-standard.org/SSP1/SystemStructure%s}"
SCHEMAS = Path(fmpy.__file__).parent / "ssp" / "schema"
WIRES = (("Sensor.gyro", "Filter.gyro"), ("Sensor.accel", "Filter.accel"))


@pytest.fixture(scope="module")
def units(tmp_path_factory):
    return {b.name: built(b, tmp_path_factory) for b in (IMT30.block, attitude_ukf(IMT30))}


@pytest.fixture(params=(2, 3), ids=("fmi2", "fmi3"))
def system(request, units):
    return System(
        "Pair",
        (
            Component("Sensor", units["ImuSensor"][request.param], {"seed": 7}),
            Component(
                "Filter", units["AttitudeUkf"][request.param], {"std0[1]": 0.05, "latitude": 0.5}
            ),
        ),
        WIRES,
        H,
        3.5,
    )


def with_parameters(system, **values):
    sensor, other = system.components
    return replace(system, components=(replace(sensor, parameters=values), other))


# What is wrong


@pytest.mark.parametrize(
    "start, end, words",
    (
        ("Sensr.gyro", "Filter.gyro", "no unit Sensr, did you mean Sensor?"),
        ("Sensor.gyr", "Filter.gyro", "Sensor has no output gyr, did you mean gyro?"),
        ("Sensor.rate", "Filter.gyro", "Sensor has no output rate: it is input"),
        ("Sensor.gyro", "Filter.roll", "Filter has no input roll: it is output"),
        ("Sensor.gyro[4]", "Filter.gyro[1]", "Sensor has no output gyro[4], did you mean"),
        ("Sensor.gyro", "Filter.temperature", "3 outputs do not fit 1 inputs"),
        ("Sensor.gyro", "Filter.accel", r"gyro[1] -> Filter.accel[1]: rad/s is not m/s^2"),
        ("Sensor.gyro[1]", "Filter.stationary", "a Real cannot feed a Boolean"),
        ("Sensor.accel", "Filter.accel", "Filter.accel[1] is fed twice"),
    ),
)
def test_wrong_wiring_is_one_clear_line(system, start, end, words):
    with pytest.raises(UserError) as caught:
        replace(system, connections=(*WIRES, (start, end)))
    assert words in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "values, words",
    (
        ({"sed": 1}, "Sensor has no parameter sed, did you mean seed?"),
        ({"seed": -1}, "Sensor: parameter seed = -1 must be a number in 0 to"),
        ({"seed": 2**31}, "must be a number in 0 to 2.14748e+09"),
        ({"seed": 1.5}, "seed = 1.5 must be a whole number"),
        (
            {"gyro_error.angle_random_walk.N[1]": -1e-3},
            "must be a number in 0 to inf rad/sqrt(s)",
        ),
        ({"gyro_error.thermal_bias.T0": np.nan}, "must be a number in -inf to inf degC"),
        ({"rate[1]": 1.0}, "Sensor has no parameter rate[1]"),
    ),
)
def test_a_parameter_that_is_none_is_refused_before_the_run(system, values, words):
    with pytest.raises(UserError) as caught:
        with_parameters(system, **values)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    "step, words",
    (
        (0.001, "a step of 0.001 s does not divide the sample period of Sensor, 0.00102459"),
        (2 * H, "does not divide the sample period"),
        (0.7 * H, "take 0.00102459016393 s"),
        (0.0, "a step of 0 s is not possible"),
        (np.inf, "not possible"),
    ),
)
def test_a_step_that_does_not_divide_the_sample_period_is_refused(system, step, words):
    with pytest.raises(UserError, match=words):
        replace(system, step_size=step)
    assert replace(system, step_size=H / 3).step_size == H / 3


def test_a_missing_unit_is_named(system, tmp_path):
    sensor, other = system.components
    gone, none = tmp_path / "gone.fmu", tmp_path / "none.fmu"
    none.write_text("no archive")
    with pytest.raises(UserError, match="Sensor: .*gone.fmu is missing; pyimu build makes"):
        replace(system, components=(replace(sensor, fmu=gone), other))
    with pytest.raises(UserError, match="Sensor: .*none.fmu is no FMU"):
        replace(system, components=(replace(sensor, fmu=none), other))
    with pytest.raises(UserError, match="more than one unit is called Sensor"):
        replace(system, components=(sensor, sensor, other))


def test_two_sensors_of_one_seed_are_refused(system):
    """But not two that nobody gave seeds: the noise of each follows from its name."""
    sensor, other = system.components
    with pytest.raises(UserError, match="Sensor and Second have the same seed 7"):
        replace(system, components=(sensor, replace(sensor, name="Second"), other))
    unset = replace(sensor, parameters={})
    replaced = System("Two", (unset, replace(unset, name="Second")), (), H)
    found = cosimulate(replaced, 5, ("Sensor.gyro[1]", "Second.gyro[1]"))
    assert (found["Sensor.gyro[1]"][1:] != found["Second.gyro[1]"][1:]).all()


def test_what_a_unit_refuses_is_said_with_its_name(tmp_path_factory):
    """Here parameters that do not go together, which no description can say."""
    late = built(Part("p", 100.0, Sensor("gyro", {"time_delay": {}})).block, tmp_path_factory)
    for version in (2, 3):
        sensor = Component("Late", late[version], {"gyro_error.time_delay.td": 0.5})
        with pytest.raises(UserError, match="^Late: .*td must not be above 30 sample periods"):
            cosimulate(System("Alone", (sensor,), (), 0.01), 1)


def test_an_output_that_is_none_is_refused(system):
    with pytest.raises(UserError, match=r"no output Filter.rol, did you mean Filter.roll\?"):
        cosimulate(system, 1, ("Filter.rol",))


# The file


def test_the_file_follows_the_schemas(system, tmp_path):
    path = write_ssp(system, tmp_path / "Pair.ssp")
    with zipfile.ZipFile(path) as archive:
        for name, schema in (
            ("SystemStructure.ssd", "SystemStructureDescription.xsd"),
            (PARAMETERS, "SystemStructureParameterValues.xsd"),
        ):
            document = etree.parse(BytesIO(archive.read(name)))
            etree.XMLSchema(etree.parse(str(SCHEMAS / schema))).assertValid(document)
            if name != PARAMETERS:
                (experiment,) = document.iter(SSP1 % "Description" + "DefaultExperiment")
                assert (experiment.get("startTime"), experiment.get("stopTime")) == ("0", "3.5")
        names = [c.fmu.name for c in system.components]
        assert [archive.read(f"resources/{n}") for n in names] == [
            c.fmu.read_bytes() for c in system.components
        ]


def test_connectors_have_equal_units_and_types_at_both_ends(system, tmp_path):
    """Each is declared, and each unit is one of the file's own with the base units of the FMU."""
    with zipfile.ZipFile(write_ssp(system, tmp_path / "Pair.ssp")) as archive:
        root = etree.fromstring(archive.read("SystemStructure.ssd"))
    connectors = {
        (component.get("name"), c.get("name")): (c.get("kind"), c[0].tag, c[0].get("unit"))
        for component in root.iter(SSP1 % "Description" + "Component")
        for c in component.iter(SSP1 % "Description" + "Connector")
    }
    units = {u.get("name"): dict(u[0].attrib) for u in root.iter(SSP1 % "Common" + "Unit")}
    connections = list(root.iter(SSP1 % "Description" + "Connection"))
    assert len(connections) == 6
    for c in connections:
        start = connectors[c.get("startElement"), c.get("startConnector")]
        end = connectors[c.get("endElement"), c.get("endConnector")]
        assert (start[0], end[0]) == ("output", "input") and start[1:] == end[1:]
        assert start[2] in units
    assert units["rad/s"] == {"rad": "1", "s": "-1"} and units["m/s^2"] == {"m": "1", "s": "-2"}
    # No input is declared that is not fed: fmpy would set it to zero.
    fed = {(c.get("endElement"), c.get("endConnector")) for c in connections}
    assert {key for key, c in connectors.items() if c[0] == "input"} == fed


def test_parameters_are_bound_at_their_component(system, tmp_path):
    found = read_ssd(str(write_ssp(system, tmp_path / "Pair.ssp")))
    bound = {
        (component.name, p.name): (p.type, float(p.value))
        for component in found.system.elements
        for binding in component.parameterBindings
        for values in binding.parameterValues
        for p in values.parameters
    }
    assert bound == {
        ("Sensor", "seed"): ("Integer", 7.0),
        ("Filter", "std0[1]"): ("Real", 0.05),
        ("Filter", "latitude"): ("Real", 0.5),
    }
    assert not found.system.parameterBindings and not found.system.connectors


def test_the_same_system_gives_the_same_bytes(system, tmp_path):
    first, again = (write_ssp(system, tmp_path / f"{n}.ssp").read_bytes() for n in (1, 2))
    assert first == again


def test_a_step_in_whole_nanoseconds():
    """976 Hz has none: a simulator that counts them would lose a sample in 6.2 million."""
    assert whole_nanoseconds(H) == 1024590e-9 and whole_nanoseconds(0.01) == 0.01
    assert whole_nanoseconds(1e-12) == 1e-9


def test_two_units_of_one_file_name_are_refused(system, tmp_path):
    sensor, other = system.components
    copy = tmp_path / sensor.fmu.name
    copy.write_bytes(sensor.fmu.read_bytes())
    second = Component("Second", copy, {"seed": 8})
    with pytest.raises(UserError, match="two units of one file name"):
        write_ssp(replace(system, components=(sensor, second, other)), tmp_path / "x.ssp")


def test_a_full_disk_is_one_line_and_leaves_nothing(system, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pyimu.fmu.ssp.shutil.copyfileobj", full)
    with pytest.raises(UserError, match="Pair.ssp: cannot be written .No space left on device"):
        write_ssp(system, tmp_path / "Pair.ssp")
    assert not list(tmp_path.iterdir())
