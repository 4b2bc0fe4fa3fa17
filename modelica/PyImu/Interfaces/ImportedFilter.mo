// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Interfaces;
partial block ImportedFilter "Connectors of the imported co-simulation unit AttitudeUkf"
  Modelica.Blocks.Interfaces.RealInput gyro_1_
    "Measured rate against inertial space, body axes";
  Modelica.Blocks.Interfaces.RealInput gyro_2_
    "Measured rate against inertial space, body axes";
  Modelica.Blocks.Interfaces.RealInput gyro_3_
    "Measured rate against inertial space, body axes";
  Modelica.Blocks.Interfaces.RealInput accel_1_ "Measured specific force, body axes";
  Modelica.Blocks.Interfaces.RealInput accel_2_ "Measured specific force, body axes";
  Modelica.Blocks.Interfaces.RealInput accel_3_ "Measured specific force, body axes";
  Modelica.Blocks.Interfaces.RealInput temperature "Temperature of the part";
  Modelica.Blocks.Interfaces.RealInput heading "Heading, counter-clockwise from east";
  Modelica.Blocks.Interfaces.RealInput heading_variance "Variance of the heading, above zero";
  Modelica.Blocks.Interfaces.BooleanInput heading_valid "Use the heading of this sample";
  Modelica.Blocks.Interfaces.RealInput heading_age
    "Time since the heading was true, counted in whole samples";
  Modelica.Blocks.Interfaces.BooleanInput stationary "The body does not turn against the Earth";
  Modelica.Blocks.Interfaces.RealInput speed
    "Speed over the ground along the body's x axis, backwards below zero";
  Modelica.Blocks.Interfaces.RealInput speed_variance "Variance of the speed";
  Modelica.Blocks.Interfaces.BooleanInput speed_valid "Use the speed of this sample";
  Modelica.Blocks.Interfaces.RealInput mag_1_ "Measured magnetic flux density, body axes";
  Modelica.Blocks.Interfaces.RealInput mag_2_ "Measured magnetic flux density, body axes";
  Modelica.Blocks.Interfaces.RealInput mag_3_ "Measured magnetic flux density, body axes";
  Modelica.Blocks.Interfaces.RealOutput q_1_
    "Attitude, body to world (east-north-up), Hamilton, scalar first";
  Modelica.Blocks.Interfaces.RealOutput q_2_
    "Attitude, body to world (east-north-up), Hamilton, scalar first";
  Modelica.Blocks.Interfaces.RealOutput q_3_
    "Attitude, body to world (east-north-up), Hamilton, scalar first";
  Modelica.Blocks.Interfaces.RealOutput q_4_
    "Attitude, body to world (east-north-up), Hamilton, scalar first";
  Modelica.Blocks.Interfaces.RealOutput roll "Roll";
  Modelica.Blocks.Interfaces.RealOutput pitch "Pitch, nose up is negative";
  Modelica.Blocks.Interfaces.RealOutput yaw "Yaw, counter-clockwise from east";
  Modelica.Blocks.Interfaces.RealOutput gyro_bias_1_ "Bias of the compensated rate";
  Modelica.Blocks.Interfaces.RealOutput gyro_bias_2_ "Bias of the compensated rate";
  Modelica.Blocks.Interfaces.RealOutput gyro_bias_3_ "Bias of the compensated rate";
  Modelica.Blocks.Interfaces.RealOutput std_1_
    "Standard deviation of the attitude error, body axes";
  Modelica.Blocks.Interfaces.RealOutput std_2_
    "Standard deviation of the attitude error, body axes";
  Modelica.Blocks.Interfaces.RealOutput std_3_
    "Standard deviation of the attitude error, body axes";
  Modelica.Blocks.Interfaces.RealOutput std_4_ "Standard deviation of the gyro bias";
  Modelica.Blocks.Interfaces.RealOutput std_5_ "Standard deviation of the gyro bias";
  Modelica.Blocks.Interfaces.RealOutput std_6_ "Standard deviation of the gyro bias";
  Modelica.Blocks.Interfaces.BooleanOutput quasi_static
    "The accelerometer is used as an inclinometer";
  Modelica.Blocks.Interfaces.RealOutput nis
    "Normalised innovation squared of this sample's quasi-static update, 0 without one";
  Modelica.Blocks.Interfaces.IntegerOutput status "What happened";
  Modelica.Blocks.Interfaces.RealOutput heading_std
    "Standard deviation of the attitude error about the vertical, however the body is tilted";
  Modelica.Blocks.Interfaces.BooleanOutput at_rest
    "The body does not move, as the input or the run says";
  annotation(Documentation(info="<html>
<p>Redeclared by the class that an importer makes of the unit; see UsersGuide.ImportOfUnits. Every
importer that replaces what is no letter or digit by an underscore gives these names.</p>
</html>"));
end ImportedFilter;
