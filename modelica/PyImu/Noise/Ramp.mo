within PyImu.Noise;
block Ramp "Growth with time of three axes: rate or acceleration ramp"
  extends PyImu.Interfaces.Sampled;
  parameter Real R[3] = fill(1, 3) "Growth, unit of y over s";
  Modelica.Blocks.Interfaces.RealOutput y[3] "Ramp"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  PyImu.Signals.Time.Signal clock(samplePeriod=samplePeriod);
  PyImu.Effects.RateRamp.Gyro effect(samplePeriod=samplePeriod, R=R);
equation
  effect.x = fill(0, 3);
  connect(clock.y, effect.t);
  connect(effect.y, y);
  annotation(Documentation(info="<html>
<p>R t at the time of the last sample, of Allan deviation R tau/sqrt(2): Effects.RateRamp on a
perfect sensor at rest. Hidalgo 2012,
table 3, rate ramp.</p>
</html>"));
end Ramp;
