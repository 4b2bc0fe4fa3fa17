within PyImu.Noise;
block RateRandomWalk "Random walk of three axes: rate or acceleration random walk"
  extends PyImu.Interfaces.NoiseSource(final count=3);
  parameter Real K[3](each min=0) = fill(1, 3) "Root of the two-sided density of the derivative, unit of y over sqrt(s)";
  PyImu.Effects.RateRandomWalk.Gyro effect(samplePeriod=samplePeriod, K=K);
equation
  effect.x = fill(0, 3);
  connect(normals.y, effect.w);
  connect(effect.y, y);
  annotation(Documentation(info="<html>
<p>Sums of steps of standard deviation K sqrt(samplePeriod), of Allan deviation K sqrt(tau/3):
Effects.RateRandomWalk on a perfect sensor at rest. Spectrum and source stand with
ShapingFilters.RateRandomWalk.</p>
</html>"));
end RateRandomWalk;
