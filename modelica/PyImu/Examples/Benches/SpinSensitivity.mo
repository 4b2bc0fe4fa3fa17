// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model SpinSensitivity "Spin-rate sensitivity, anisoinertia alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.SpinSensitivity.Accel effect(samplePeriod=0.01, s={{0.0019613300000000003,
    -0.0019613300000000003, 0.0019613300000000003}, {-0.0019613300000000003,
    0.0019613300000000003, -0.0019613300000000003}, {0.0019613300000000003,
    -0.0019613300000000003, 0.0019613300000000003}});
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(10, 3),
    offset={0, 0, 9.80665});
  PyImu.Examples.Excitation source1(samplePeriod=0.01, n=3, shift=1, amplitude=fill(1, 3),
    offset={0, 0, 0});
equation
  connect(motion.y, effect.x);
  connect(source1.y, effect.rate);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end SpinSensitivity;
