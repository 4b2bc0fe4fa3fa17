// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples.Benches;
model ThermalScaleFactor "Scale factor temperature sensitivity alone"
  extends Modelica.Icons.Example;
  PyImu.Effects.ThermalScaleFactor.Gyro effect(samplePeriod=0.01, kS={0.000308, -0.000308,
    0.000308}, T0=25);
  PyImu.Examples.Excitation motion(samplePeriod=0.01, n=3, shift=0, amplitude=fill(1, 3),
    offset={0, 0, 0});
  PyImu.Examples.Excitation source1(samplePeriod=0.01, n=1, shift=1, amplitude=fill(20, 1),
    offset={25});
equation
  connect(motion.y, effect.x);
  connect(source1.y[1], effect.T);
  annotation(
    experiment(StopTime=0.4, Interval=0.01),
    Documentation(info="<html>
<p>The effect alone, at a size that a consumer's part has, with inputs of both signs that change at
each sample. What stands for the normals is no noise.</p>
</html>"));
end ThermalScaleFactor;
