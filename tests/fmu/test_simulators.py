"""Sensor and filter as an SSP file in simulators that nobody here wrote: fmpy, ecos, libcosim.

All of them let every unit make its step and exchange values then (Jacobi), so that the filter has
at sample k what the sensor measured at sample k - 1. What they do before the first step differs:
ecos and libcosim pass on what is shown then, fmpy passes zeros.
"""

import numpy as np
import pytest
from built import built
from simulators import in_ecos, in_fmpy, in_libcosim

from pyimu.attitude import attitude_ukf
from pyimu.fmu.cosimulate import cosimulate
from pyimu.fmu.ssp import whole_nanoseconds, write_ssp
from pyimu.fmu.system import Component, System
from pyimu.model.part_file import part

IMT30 = part("imt30")
H = whole_nanoseconds(IMT30.sample_period)
STEPS, SEED, TILT = 400, 7, 0.05
WANTED = (
    *(f"Sensor.{v.name}" for v in IMT30.block.outputs),
    *("Filter.roll", "Filter.pitch", "Filter.yaw", "Filter.nis"),
    *(f"Filter.std[{i}]" for i in range(1, 7)),
)
SENSOR, FILTER = IMT30.block, attitude_ukf(IMT30)


@pytest.fixture(scope="module")
def pairs(tmp_path_factory):
    """Version of FMI to the system of sensor and filter, and its SSP file."""
    units = {b.name: built(b, tmp_path_factory) for b in (SENSOR, FILTER)}
    folder = tmp_path_factory.mktemp("pair")
    return {
        version: (system := pair(units, version), write_ssp(system, folder / f"{version}.ssp"))
        for version in (2, 3)
    }


def pair(units, version, step=H):
    return System(
        "Pair",
        (
            Component("Sensor", units["ImuSensor"][version], {"seed": SEED, "sample_period": H}),
            Component(
                "Filter", units["AttitudeUkf"][version], {"sample_period": H, "std0[1]": TILT}
            ),
        ),
        (
            ("Sensor.gyro", "Filter.gyro"),
            ("Sensor.accel", "Filter.accel"),
            ("Sensor.measured_temperature", "Filter.temperature"),
        ),
        step,
    )


def expected(first=None):
    """Rows (STEPS + 1,) by name, from the blocks in Python.

    The filter's inputs are the sensor's outputs of the row before; ``first`` are those of its first
    sample (7,), else what the sensor shows before its own.
    """
    held = np.tile(SENSOR.start_inputs, (STEPS, 1))
    shown = np.array(SENSOR.initial(SENSOR.start_inputs, SENSOR.start)[1]).ravel()
    measured = np.vstack([shown, SENSOR.run(held, seed=SEED, sample_period=H)[0]])
    u = np.tile(FILTER.start_inputs, (STEPS, 1))
    u[:, :7] = measured[:-1]
    u[0, :7] = u[0, :7] if first is None else first
    p = FILTER.start.copy()
    p[[v.name for v in FILTER.parameters].index("std0[1]")] = TILT
    estimate = FILTER.run(u, p=p, sample_period=H)[0]
    estimate = np.vstack([np.array(FILTER.initial(FILTER.start_inputs, p)[1]).ravel(), estimate])
    return {
        f"{unit}.{v.name}": column
        for unit, block, rows in (("Sensor", SENSOR, measured), ("Filter", FILTER, estimate))
        for v, column in zip(block.outputs, rows.T, strict=True)
    }


def assert_same_bits(found, want, from_row=0):
    for name in WANTED:
        np.testing.assert_array_equal(found[name][from_row:], want[name][from_row:], err_msg=name)


@pytest.mark.parametrize("version", (2, 3))
def test_a_loop_over_fmpy_is_python_one_sample_late(pairs, version):
    assert_same_bits(cosimulate(pairs[version][0], STEPS, WANTED), expected())


@pytest.mark.parametrize("version", (2, 3))
def test_ecos_is_python_one_sample_late(pairs, version):
    assert_same_bits(in_ecos(pairs[version][1], STEPS, H, WANTED), expected())


def test_libcosim_is_python_one_sample_late(pairs):
    """FMI 3 it does not read; before the first step it shows nothing."""
    assert_same_bits(in_libcosim(pairs[2][1], STEPS, H, WANTED), expected(), 1)


def test_fmpys_own_reader_passes_zeros_at_first(pairs):
    """All that differs is the filter's first sample, whose inputs are 0."""
    found = in_fmpy(pairs[2][1], STEPS, H, WANTED)
    assert_same_bits(found, expected(first=np.zeros(7)), 1)
    assert not np.array_equal(found["Filter.roll"][1:], expected()["Filter.roll"][1:])


def test_two_steps_a_sample_have_the_filter_see_each_sample_at_its_own_next(pairs, tmp_path):
    """In steps of half a sample period a sample is passed on before the next is due: nothing
    changes, in any simulator.
    """
    system, _ = pairs[2]
    halves = System(system.name, system.components, system.connections, H / 2)
    ssp = write_ssp(halves, tmp_path / "halves.ssp")
    for run in (
        lambda: cosimulate(halves, 2 * STEPS, WANTED),
        lambda: in_ecos(ssp, 2 * STEPS, H / 2, WANTED),
    ):
        assert_same_bits({name: rows[::2] for name, rows in run().items()}, expected())
