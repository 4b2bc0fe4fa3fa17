"""Systems of units as SSP files in simulators that nobody here wrote: fmpy, ecos, libcosim.

All of them let every unit make its step and exchange values then (Jacobi), so that the filter has
at sample k what the sensor measured at sample k - 1. Only what they pass on before the first step
differs: see the tests, and ``docs/simulators.md``.
"""

from dataclasses import replace

import numpy as np
import pytest
from simulators import in_ecos, in_fmpy, in_libcosim
from wired import in_python

from pyimu.attitude import attitude_ukf
from pyimu.fmu.cosimulate import cosimulate
from pyimu.fmu.ssp import write_ssp
from pyimu.model.part_file import part
from pyimu.plant.low_pass import low_pass
from pyimu.plant.rover_drive import rover_drive
from pyimu.rover.system import rover_system

IMT30 = part("imt30")
STEPS = 500
BLOCKS = {
    "Drive": rover_drive(IMT30.sample_period),
    "Sensor": IMT30.nominal.block,
    "LowPass": low_pass(IMT30.sample_period),
    "Filter": attitude_ukf(IMT30),
}
GIVEN = {
    "Drive": {"start_time": 0.1, "ramp_time": 0.1, "spot_turn_rate": 0.2, "roughness": 0.02},
    "Filter": {"std0[1]": 0.05},
}


@pytest.fixture(scope="module")
def systems(tmp_path_factory):
    """(units, version of FMI) to a system, and its SSP file: the rover, and sensor and filter."""
    folder = tmp_path_factory.mktemp("systems")
    found = {}
    for version in (2, 3):
        rover = rover_system(IMT30, folder, seed=7, form=version, parameters=GIVEN)
        pair = replace(
            rover,
            name="Pair",
            components=tuple(c for c in rover.components if c.name in ("Sensor", "Filter")),
            connections=(
                ("Sensor.gyro", "Filter.gyro"),
                ("Sensor.accel", "Filter.accel"),
                ("Sensor.measured_temperature", "Filter.temperature"),
            ),
        )
        for name, system in (("rover", rover), ("pair", pair)):
            found[name, version] = system, write_ssp(system, folder / f"{name}{version}.ssp")
    return found


@pytest.fixture(params=("pair", "rover"))
def name(request):
    return request.param


def reals(system):
    return [name for name, (_, v) in system.outputs.items() if v.type in ("Real", "Float64")]


def expected(system, steps=STEPS, **how):
    return in_python(system, {c.name: BLOCKS[c.name] for c in system.components}, steps, **how)


def assert_same_bits(found, want, rows=slice(None)):
    assert len(found) > 20
    for name, values in found.items():
        np.testing.assert_array_equal(values[rows], want[name][rows], err_msg=name)


@pytest.mark.parametrize("version", (2, 3))
def test_a_loop_over_fmpy_is_python_one_sample_late(systems, name, version):
    system, _ = systems[name, version]
    found = cosimulate(system, STEPS)
    assert_same_bits(found, expected(system))
    assert np.ptp(found["Filter.yaw"]) > 0


@pytest.mark.parametrize("version", (2, 3))
def test_ecos(systems, name, version):
    system, ssp = systems[name, version]
    assert_same_bits(in_ecos(ssp, STEPS, system.step_size, reals(system)), expected(system))


def test_libcosim(systems, name):
    """FMI 3 it does not read; before the first step it shows nothing."""
    system, ssp = systems[name, 2]
    found = in_libcosim(ssp, STEPS, system.step_size, reals(system))
    assert_same_bits(found, expected(system), slice(1, None))


def test_fmpys_own_reader_passes_zeros_at_first(systems, name):
    """In the first step all inputs that are wired are 0."""
    system, ssp = systems[name, 2]
    found = in_fmpy(ssp, STEPS, system.step_size, reals(system))
    assert_same_bits(found, expected(system, first=0.0), slice(1, None))
    assert not np.array_equal(found["Filter.roll"][1:], expected(system)["Filter.roll"][1:])


def test_two_steps_a_sample_change_nothing(systems, name, tmp_path):
    """A sample is passed on before the next is due."""
    system, _ = systems[name, 2]
    halves = replace(system, step_size=system.step_size / 2)
    ssp = write_ssp(halves, tmp_path / "halves.ssp")
    for found in (
        cosimulate(halves, 2 * STEPS),
        in_ecos(ssp, 2 * STEPS, halves.step_size, reals(system)),
    ):
        assert_same_bits({n: rows[::2] for n, rows in found.items()}, expected(system))
