// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model DeadZone "Dead zone, threshold alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.DeadZone.Gyro effect(samplePeriod=0.01, d={0.00013264502315156904,
    0.00013264502315156904, 0.00013264502315156904});
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
equation
  connect(motion.y, effect.x);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end DeadZone;
