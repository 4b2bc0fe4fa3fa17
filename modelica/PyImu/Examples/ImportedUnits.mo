within PyImu.Examples;
partial model ImportedUnits "A rover's motion through the imported sensor and the imported filter"
  extends Modelica.Icons.Example;
  replaceable block Sensor = PyImu.Interfaces.ImportedSensor
    constrainedby PyImu.Interfaces.ImportedSensor "Class of ImuSensor.fmi2.fmu"
    annotation(choicesAllMatching=true);
  replaceable block Filter = PyImu.Interfaces.ImportedFilter
    constrainedby PyImu.Interfaces.ImportedFilter "Class of AttitudeUkf.fmi2.fmu"
    annotation(choicesAllMatching=true);
  PyImu.Rover.TurnOnSpot drive(startTime=10)
    annotation(Placement(transformation(extent={{-90,-20},{-50,20}})));
  Sensor sensor annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Filter filter annotation(Placement(transformation(extent={{50,-20},{90,20}})));
equation
  connect(drive.rate[1], sensor.rate_1_);
  connect(drive.rate[2], sensor.rate_2_);
  connect(drive.rate[3], sensor.rate_3_);
  connect(drive.specificForce[1], sensor.specific_force_1_);
  connect(drive.specificForce[2], sensor.specific_force_2_);
  connect(drive.specificForce[3], sensor.specific_force_3_);
  sensor.temperature = 25;
  connect(sensor.gyro_1_, filter.gyro_1_);
  connect(sensor.gyro_2_, filter.gyro_2_);
  connect(sensor.gyro_3_, filter.gyro_3_);
  connect(sensor.accel_1_, filter.accel_1_);
  connect(sensor.accel_2_, filter.accel_2_);
  connect(sensor.accel_3_, filter.accel_3_);
  connect(sensor.measured_temperature, filter.temperature);
  filter.heading = 0;
  filter.heading_variance = 1;
  filter.heading_valid = false;
  filter.heading_age = 0;
  filter.stationary = false;
  filter.speed = 0;
  filter.speed_variance = 1;
  filter.speed_valid = false;
  filter.mag_1_ = 0;
  filter.mag_2_ = 0;
  filter.mag_3_ = 0;
  annotation(
    experiment(StopTime=180, Interval=0.01),
    Documentation(info="<html>
<p>Import both units as UsersGuide.ImportOfUnits says, here as classes of a package Units, and extend
this model:</p>
<pre>model Imported
  extends PyImu.Examples.ImportedUnits(
    redeclare block Sensor = Units.ImuSensor(seed=1),
    redeclare block Filter = Units.AttitudeUkf(latitude=0.911));
end Imported;</pre>
<p>A unit has every input that it may use; what a model does not have is switched off in the equations
here. Without the two classes the model is partial, and a tool says so.</p>
</html>"));
end ImportedUnits;
