// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model MagneticSensitivity "Magnetic sensitivity alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.MagneticSensitivity.Gyro effect(samplePeriod=0.01, C={{0.484813681109536,
    -0.484813681109536, 0.484813681109536}, {-0.484813681109536, 0.484813681109536,
    -0.484813681109536}, {0.484813681109536, -0.484813681109536, 0.484813681109536}});
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Examples.Excitation source1(samplePeriod=0.01, n=3, shift=1, amplitude=fill(5e-05, 3),
    offset={0, 0, 0});
equation
  connect(motion.y, effect.x);
  connect(source1.y, effect.B);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end MagneticSensitivity;
