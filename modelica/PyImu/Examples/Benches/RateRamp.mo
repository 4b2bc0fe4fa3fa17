// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model RateRamp "Rate (acceleration) ramp alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.RateRamp.Gyro effect(samplePeriod=0.01, R={7.528079103895294e-09,
    -7.528079103895294e-09, 7.528079103895294e-09});
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
end RateRamp;
