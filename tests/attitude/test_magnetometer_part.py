"""What a part file says of a magnetometer, and what the attitude filter makes of it."""

import numpy as np
import pytest
from attitude_cases import part
from test_attitude_magnetometer import World, recording

from pyimu import UserError, simulate
from pyimu.attitude import MagnetometerCalibration, run
from pyimu.attitude.calibration import as_values, of_sensor
from pyimu.model.part_reader import parse_part
from pyimu.model.part_writer import format_part
from pyimu.model.sensor import Sensor
from pyimu.model.simulate import simulate_recording

TEXT = """\
name = "triads"
sample_rate = {value = 100.0, unit = "Hz"}

[gyro.angle_random_walk]
N = {value = 0.1, unit = "deg/sqrt(h)"}

[mag.misalignment]
m = {value = [[0.0, 0.02, -0.01], [0.03, 0.0, 0.01], [-0.02, 0.04, 0.0]], unit = "rad"}

[mag.scale_factor]
s = {value = [1.0, -2.0, 3.0], unit = "%"}

[mag.turn_on_bias]
b0 = {value = [12.0, -3.0, 40.0], unit = "uT"}

[mag.angle_random_walk]
N = {value = 30.0, unit = "nT/sqrt(Hz)", density = "one-sided"}
"""

BIAS = np.array([12e-6, -3e-6, 40e-6])
MATRIX = np.diag([1.01, 0.98, 1.03]) @ [[1, 0.02, -0.01], [0.03, 1, 0.01], [-0.02, 0.04, 1]]


def test_the_tables_of_a_magnetometer_are_its_calibration():
    found = of_sensor(parse_part(TEXT).mag)
    np.testing.assert_allclose(found.bias, BIAS, rtol=1e-12)
    np.testing.assert_allclose(found.matrix, MATRIX, rtol=1e-12)


def test_a_calibration_becomes_values_and_comes_back():
    given = MagnetometerCalibration(BIAS, MATRIX)
    found = of_sensor(Sensor("mag", as_values(given)))
    np.testing.assert_allclose(found.matrix, given.matrix, rtol=1e-12)
    np.testing.assert_allclose(found.bias, given.bias, rtol=1e-12)
    assert of_sensor(Sensor("mag")) is None
    assert of_sensor(Sensor("mag", {"angle_random_walk": {"N": 1e-8}})) is None


def test_a_part_with_a_magnetometer_is_written_as_it_is_read():
    known = parse_part(TEXT)
    assert parse_part(format_part(known)) == known
    noise = known.mag.values["angle_random_walk"]["N"]
    np.testing.assert_allclose(noise, 30e-9 / np.sqrt(2), rtol=1e-12)


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("[mag.g_sensitivity]\nG = 1", "mag.g_sensitivity: is an effect of gyro, not of mag"),
        ("[mag.lag]\nwn = 1", "mag.lag: is an effect of gyro and accel, not of mag"),
        (
            '[mag.turn_on_bias]\nb0 = {value = 1, unit = "deg/s"}',
            "expected a unit like T",
        ),
    ],
)
def test_what_no_magnetometer_has_is_said(table, said):
    head = 'name = "a"\nsample_rate = {value = 1.0, unit = "Hz"}\n'
    with pytest.raises(UserError) as error:
        parse_part(head + table)
    assert said in str(error.value)


@pytest.fixture(scope="module")
def log():
    world = World(301, still=300)
    true = world.mag()
    return recording(world, true), recording(world, true @ MATRIX.T + BIAS)


def with_mag(**values):
    known = part()
    return known.with_sensor(
        Sensor("mag", as_values(MagnetometerCalibration(BIAS, MATRIX)) | values)
    )


def test_the_filter_undoes_what_the_part_knows(log):
    """As the true field would, to rounding; a calibration that is given goes before the part's."""
    true, seen = log
    by_part, ideal = run(seen, with_mag()), run(true, part())
    np.testing.assert_allclose(by_part.q, ideal.q, rtol=0, atol=1e-9)
    assert "magnetometer, calibrated" in by_part.report()
    given = MagnetometerCalibration(BIAS, MATRIX)
    np.testing.assert_array_equal(run(seen, with_mag(), magnetometer=given).q, by_part.q)
    none = run(seen, with_mag(), magnetometer=False)
    np.testing.assert_array_equal(none.q, run(seen, part(), magnetometer=False).q)


def test_the_parts_noise_is_the_filters_but_for_less_than_it_has(log):
    noisy, quiet = (
        run(log[1], with_mag(angle_random_walk={"N": size * np.array([3.0, 4.0, 5.0])}))
        for size in (1e-7, 1e-9)
    )
    assert noisy.parameters["field_noise"] == pytest.approx(np.sqrt(50 / 3) * 1e-7)
    np.testing.assert_array_equal(quiet.q, run(log[1], with_mag()).q)


def test_a_part_with_a_magnetometer_goes_with_a_log_that_has_none(log):
    world = World(302, rows=500, still=300)
    plain = recording(world, 0.0)
    plain = type(plain).from_arrays(time=plain.time, gyro=plain.gyro, accel=plain.accel)
    np.testing.assert_array_equal(run(plain, with_mag()).q, run(plain, part()).q)


def test_the_unit_of_a_part_has_no_magnetometer(log):
    """Its gyro and accelerometer are those of the part without one."""
    known, rate = with_mag(), np.zeros((20, 3))
    for one, other in zip(simulate(known, rate, rate), simulate(part(), rate, rate), strict=True):
        np.testing.assert_array_equal(one, other)
    with pytest.raises(UserError, match="not simulated"):
        simulate_recording(known.mag, log[0])
