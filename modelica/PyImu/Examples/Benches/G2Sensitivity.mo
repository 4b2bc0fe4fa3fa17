// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model G2Sensitivity "Acceleration-squared-sensitive drift, anisoelastic alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.G2Sensitivity.Gyro effect(samplePeriod=0.01, Q={{1.8148302786815662e-06,
    -1.8148302786815662e-06, 1.8148302786815662e-06, -1.8148302786815662e-06,
    1.8148302786815662e-06, -1.8148302786815662e-06}, {-1.8148302786815662e-06,
    1.8148302786815662e-06, -1.8148302786815662e-06, 1.8148302786815662e-06,
    -1.8148302786815662e-06, 1.8148302786815662e-06}, {1.8148302786815662e-06,
    -1.8148302786815662e-06, 1.8148302786815662e-06, -1.8148302786815662e-06,
    1.8148302786815662e-06, -1.8148302786815662e-06}});
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Examples.Excitation source1(samplePeriod=0.01, n=3, shift=1, amplitude=fill(10, 3),
    offset={0, 0, 9.80665});
equation
  connect(motion.y, effect.x);
  connect(source1.y, effect.f);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end G2Sensitivity;
