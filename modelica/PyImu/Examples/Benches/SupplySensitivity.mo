// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model SupplySensitivity "Supply sensitivity alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.SupplySensitivity.Gyro effect(samplePeriod=0.01, kV={0.03490658503988659,
    -0.03490658503988659, 0.03490658503988659}, V0=3.3);
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Examples.Excitation source1(samplePeriod=0.01, n=1, shift=1, amplitude=fill(0.5, 1),
    offset={3.3});
equation
  connect(motion.y, effect.x);
  connect(source1.y[1], effect.V);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end SupplySensitivity;
