within PyImu.Examples;
model ImuAtRest "A measurement unit that lies still"
  extends Modelica.Icons.Example;
  inner PyImu.Noise.GlobalSeed globalSeed;
  PyImu.Sensors.Imu imu(part=PyImu.Sensors.Part.Imt30, samplePeriod=0.01, seed=1,
    rate={0, 0, 0}, specificForce={0, 0, 9.80665}, temperature=25)
    annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  annotation(
    experiment(StopTime=10, Interval=0.01),
    Documentation(info="<html>
<p>The inputs are bound in the declaration: at rest, level, at 25 degC. The gyros show white noise
and random walk; the part declares nothing of its accelerometers, which are perfect.</p>
</html>"));
end ImuAtRest;
