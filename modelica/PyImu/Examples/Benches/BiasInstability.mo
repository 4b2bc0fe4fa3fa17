// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model BiasInstability "Bias instability, flicker noise alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.BiasInstability.Gyro effect(samplePeriod=0.01, B={3.3597588100890845e-05,
    3.3597588100890845e-05, 3.3597588100890845e-05}, f_low=1e-05, f_high=1);
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Examples.Excitation normals(samplePeriod=0.01, n=18, shift=7, amplitude=fill(2.5, 18),
    offset=fill(0, 18));
equation
  connect(motion.y, effect.x);
  connect(normals.y, effect.w);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end BiasInstability;
