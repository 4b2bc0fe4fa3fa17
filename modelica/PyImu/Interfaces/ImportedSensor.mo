// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Interfaces;
partial block ImportedSensor "Connectors of the imported co-simulation unit ImuSensor"
  Modelica.Blocks.Interfaces.RealInput rate_1_ "Angular rate against inertial space, body axes";
  Modelica.Blocks.Interfaces.RealInput rate_2_ "Angular rate against inertial space, body axes";
  Modelica.Blocks.Interfaces.RealInput rate_3_ "Angular rate against inertial space, body axes";
  Modelica.Blocks.Interfaces.RealInput specific_force_1_ "Specific force, body axes";
  Modelica.Blocks.Interfaces.RealInput specific_force_2_ "Specific force, body axes";
  Modelica.Blocks.Interfaces.RealInput specific_force_3_ "Specific force, body axes";
  Modelica.Blocks.Interfaces.RealInput temperature "Temperature of the part";
  Modelica.Blocks.Interfaces.RealOutput gyro_1_ "Measured rate, axis x";
  Modelica.Blocks.Interfaces.RealOutput gyro_2_ "Measured rate, axis y";
  Modelica.Blocks.Interfaces.RealOutput gyro_3_ "Measured rate, axis z";
  Modelica.Blocks.Interfaces.RealOutput accel_1_ "Measured specific force, axis x";
  Modelica.Blocks.Interfaces.RealOutput accel_2_ "Measured specific force, axis y";
  Modelica.Blocks.Interfaces.RealOutput accel_3_ "Measured specific force, axis z";
  Modelica.Blocks.Interfaces.RealOutput measured_temperature
    "Temperature of the part, sampled like its axes";
  annotation(Documentation(info="<html>
<p>Redeclared by the class that an importer makes of the unit; see UsersGuide.ImportOfUnits. Every
importer that replaces what is no letter or digit by an underscore gives these names.</p>
</html>"));
end ImportedSensor;
