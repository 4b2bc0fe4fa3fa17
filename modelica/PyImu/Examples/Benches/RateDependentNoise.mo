// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model RateDependentNoise "Rate-dependent noise, scale factor noise alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.RateDependentNoise.Gyro effect(samplePeriod=0.01, k={0.0001, 0.0001, 0.0001});
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Examples.Excitation normals(samplePeriod=0.01, n=3, shift=7, amplitude=fill(2.5, 3),
    offset=fill(0, 3));
equation
  connect(motion.y, effect.x);
  connect(normals.y, effect.w);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end RateDependentNoise;
