within PyImu.Noise;
block WhiteNoise "White noise of three axes: angle or velocity random walk"
  extends PyImu.Interfaces.NoiseSource(final count=3);
  parameter Real N[3](each min=0) = fill(1, 3) "Root of the two-sided density, unit of y times sqrt(s)";
  PyImu.Effects.AngleRandomWalk.Gyro effect(samplePeriod=samplePeriod, N=N);
equation
  effect.x = fill(0, 3);
  connect(normals.y, effect.w);
  connect(effect.y, y);
  annotation(Documentation(info="<html>
<p>Samples of standard deviation N/sqrt(samplePeriod), of two-sided density N^2 and Allan deviation
N/sqrt(tau): Effects.AngleRandomWalk on a perfect sensor at rest. Spectrum and source stand with
ShapingFilters.AngleRandomWalk.</p>
</html>"));
end WhiteNoise;
