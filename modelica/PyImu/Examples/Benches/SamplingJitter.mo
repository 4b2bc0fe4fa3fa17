// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model SamplingJitter "Sampling jitter alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.SamplingJitter.Gyro effect(samplePeriod=0.01, sj=0.00029);
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Examples.Excitation source1(samplePeriod=0.01, n=3, shift=1, amplitude=fill(2, 3),
    offset={0, 0, 0});
  PyImu.Examples.Excitation normals(samplePeriod=0.01, n=1, shift=7, amplitude=fill(2.5, 1),
    offset=fill(0, 1));
equation
  connect(motion.y, effect.x);
  connect(source1.y, effect.slope);
  connect(normals.y, effect.w);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end SamplingJitter;
