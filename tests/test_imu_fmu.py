"""The FMU of a sensor is the Python simulation of that sensor, bit for bit, whatever effects it has."""

import numpy as np
import pytest
from catalogue_cases import H, as_part, everything, motion
from fmpy.validation import validate_fmu

from pyimu.effect import CATALOGUE
from pyimu.fmu import build_fmus, simulate
from pyimu.imu import simulate as simulate_in_python
from pyimu.partfile import part, part_names

N = 600
VERSIONS = (2, 3)


@pytest.fixture(scope="module")
def full():
    """A part with every effect of the catalogue at values that matter, no matrix symmetric."""
    made = as_part(everything("gyro"), everything("accel"))
    assert {e.name for s in (made.gyro, made.accel) for e in s.effects} == set(CATALOGUE)
    return made


@pytest.fixture(scope="module")
def fmus(full, tmp_path_factory):
    return dict(zip(VERSIONS, build_fmus(full.block, tmp_path_factory.mktemp("fmus"), VERSIONS)))


def silent(part_):
    """Start values that switch the noise off: the FMU always draws, so its stochastic coefficients are zero."""
    return {v.name: 0.0 for v in part_.block.parameters if CATALOGUE[v.name.split(".")[1]].stochastic}


def without_noise(part_):
    for sensor in (part_.gyro, part_.accel):
        part_ = part_.with_sensor(sensor.without(*[e.name for e in sensor.effects if e.stochastic]))
    return part_


@pytest.mark.parametrize("version", VERSIONS)
def test_noise_off_the_fmu_gives_the_bits_of_python(full, fmus, version):
    u = motion(N)
    gyro, accel = simulate_in_python(without_noise(full), u[:, :3], u[:, 3:6], u[:, 6], seed=None)
    assert np.abs(gyro - u[:, :3]).max() > 0.1
    y = simulate(fmus[version], u, sample_period=H, start_values=silent(full))
    np.testing.assert_array_equal(y[1:], np.hstack([gyro, accel]))


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("seed", [0, 12345])
def test_the_same_seed_gives_the_same_bits(full, fmus, version, seed):
    u = motion(N)
    y = simulate(fmus[version], u, sample_period=H, start_values={"seed": seed})
    np.testing.assert_array_equal(y[1:], np.hstack(simulate_in_python(full, u[:, :3], u[:, 3:6], u[:, 6], seed=seed)))


@pytest.mark.parametrize("version", VERSIONS)
def test_a_matrix_stands_in_the_fmu_row_by_row(full, fmus, version):
    """G[1,2] alone: the x axis of the gyro answers to the y axis of the force, and nothing else moves."""
    values = {v.name: v.start for v in without_effects(full)} | {"gyro_error.g_sensitivity.G[1,2]": 0.01}
    u = motion(20)
    y = simulate(fmus[version], u, sample_period=H, start_values=values)[1:]
    want = u[:, :6].copy()
    want[:, 0] += 0.01 * u[:, 4]
    np.testing.assert_allclose(y, want, rtol=1e-14, atol=1e-14)


def without_effects(part_):
    """The parameters of the part's block at the identity."""
    for sensor in (part_.gyro, part_.accel):
        part_ = part_.with_sensor(type(sensor)(sensor.kind, {e.name: {} for e in sensor.effects}))
    return part_.block.parameters


@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_finds_nothing_wrong_with_the_full_sensor(fmus, version):
    assert validate_fmu(str(fmus[version])) == []


@pytest.mark.parametrize("name", part_names())
def test_fmpy_finds_nothing_wrong_with_built_in_parts(name, tmp_path):
    for path in build_fmus(part(name).block, tmp_path, VERSIONS):
        assert validate_fmu(str(path)) == []
