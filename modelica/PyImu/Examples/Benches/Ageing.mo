// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model Ageing "Ageing of bias and scale factor alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.Ageing.Gyro effect(samplePeriod=0.01, kb={2.7607445729848578e-11,
    -2.7607445729848578e-11, 2.7607445729848578e-11}, ks={0, 0, 0}, age=0);
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Signals.Time.Signal source1(samplePeriod=0.01);
equation
  connect(motion.y, effect.x);
  connect(source1.y, effect.t);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end Ageing;
