"""Co-simulation units beside the library: the names that importers make, and the example."""

import numpy as np
import pytest
from modelica_cases import simulated, vector

from pyimu.attitude import attitude_ukf
from pyimu.fmu.variables import entries
from pyimu.model.part_file import part, part_names
from pyimu.modelica.imported import imported_name

IMPORTED = """model Test
  block MySensor
    extends PyImu.Interfaces.ImportedSensor;
  equation
    gyro_1_ = rate_1_ + 1;
    gyro_2_ = rate_2_ + 2;
    gyro_3_ = rate_3_ + 3;
    accel_1_ = specific_force_1_ + 1;
    accel_2_ = specific_force_2_ + 2;
    accel_3_ = specific_force_3_ + 3;
    measured_temperature = temperature + 1;
  end MySensor;
  block MyFilter
    extends PyImu.Interfaces.ImportedFilter;
  equation
    q_1_ = gyro_1_;
    q_2_ = gyro_2_;
    q_3_ = gyro_3_;
    q_4_ = temperature;
    gyro_bias_1_ = accel_1_;
    gyro_bias_2_ = accel_2_;
    gyro_bias_3_ = accel_3_;
    roll = heading_variance;
    pitch = heading_age;
    yaw = speed_variance;
    std_1_ = mag_1_;
    std_2_ = mag_2_;
    std_3_ = mag_3_;
    std_4_ = speed;
    std_5_ = heading;
    std_6_ = 0;
    quasi_static = heading_valid or speed_valid or stationary;
    nis = 0;
    status = 0;
    heading_std = 0;
    at_rest = true;
  end MyFilter;
  extends PyImu.Examples.ImportedUnits(
    redeclare block Sensor = MySensor,
    redeclare block Filter = MyFilter);
end Test;
"""


def test_names_of_the_guide():
    """As the importers' sources replace them."""
    assert imported_name("gyro[1]") == "gyro_1_"
    long = "gyro_error.angle_random_walk.N[1]"
    assert imported_name(long) == "gyro_error_angle_random_walk_N_1_"
    assert imported_name("gyro_error.misalignment.m[1,2]") == "gyro_error_misalignment_m_1_2_"


@pytest.mark.long
@pytest.mark.parametrize("name", part_names())
def test_no_two_variables_of_a_unit_become_one(name):
    """Nor by OpenModelica, which replaces sign by sign."""
    for block in (part(name).block, attitude_ukf(part(name))):
        names = [e.name for e in entries(block, False)]
        assert len({imported_name(n) for n in names}) == len(names)
        signs = str.maketrans(".[] ,()", "_______")
        assert all(n.translate(signs) == imported_name(n) for n in names)


def test_example_wires_the_units():
    """With blocks in their place that show what they were given."""
    rows = simulated("Test", 20.0, 1.0, IMPORTED)
    drive = vector(rows, "drive.rate")
    for i in range(3):
        force = rows[f"drive.specificForce[{i + 1}]"]
        np.testing.assert_allclose(rows[f"filter.q_{i + 1}_"], drive[:, i] + i + 1, rtol=1e-15)
        np.testing.assert_allclose(rows[f"filter.gyro_bias_{i + 1}_"], force + i + 1, rtol=1e-15)
    assert (rows["filter.q_4_"] == 26).all() and not rows["filter.quasi_static"].any()


def test_example_without_units_is_refused():
    """Its blocks are partial; rumoca counts equations."""
    with pytest.raises(Exception, match="unbalanced|partial"):
        simulated("PyImu.Examples.ImportedUnits", 1.0, 1.0)
