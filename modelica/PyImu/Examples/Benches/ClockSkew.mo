// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model ClockSkew "Clock skew alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.ClockSkew.Gyro effect(samplePeriod=0.01, eps=9.999999999999999e-05);
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Signals.Time.Signal source1(samplePeriod=0.01);
  PyImu.Examples.Excitation source2(samplePeriod=0.01, n=3, shift=2, amplitude=fill(2, 3),
    offset={0, 0, 0});
equation
  connect(motion.y, effect.x);
  connect(source1.y, effect.t);
  connect(source2.y, effect.slope);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end ClockSkew;
