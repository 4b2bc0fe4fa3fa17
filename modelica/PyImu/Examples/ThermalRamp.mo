within PyImu.Examples;
model ThermalRamp "The drift of a gyro while its temperature rises"
  extends Modelica.Icons.Example;
  inner PyImu.Noise.GlobalSeed globalSeed;
  PyImu.Thermal.Ramp ramp(from=15, to=35, duration=10)
    annotation(Placement(transformation(extent={{-80,-70},{-40,-30}})));
  PyImu.Sensors.Imu imu(part=PyImu.Sensors.Part.Imt30, samplePeriod=0.01, seed=1,
    rate={0, 0, 0}, specificForce={0, 0, 9.80665})
    annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
equation
  connect(ramp.temperature, imu.temperature);
  annotation(
    experiment(StopTime=10, Interval=0.01),
    Documentation(info="<html>
<p>kT (T - T0) of the part, Hidalgo 2012, table 1: 0.4 to 1.1 deg/s over 20 K.</p>
</html>"));
end ThermalRamp;
