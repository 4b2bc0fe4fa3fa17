within PyImu.Noise;
block GaussMarkov "Exponentially correlated noise of three axes"
  extends PyImu.Interfaces.NoiseSource(final count=3);
  parameter Real q[3](each min=0) = fill(1, 3) "Root of the two-sided density of what drives it, unit of y over sqrt(s)";
  parameter Modelica.Units.SI.Time tau[3] = fill(100, 3) "Correlation time";
  PyImu.Effects.GaussMarkov.Gyro effect(samplePeriod=samplePeriod, q=q, tau=tau);
equation
  effect.x = fill(0, 3);
  connect(normals.y, effect.w);
  connect(effect.y, y);
  annotation(Documentation(info="<html>
<p>A stationary process of variance q^2 tau/2 and correlation time tau: Effects.GaussMarkov on a
perfect sensor at rest. Spectrum and source stand with ShapingFilters.GaussMarkov.</p>
</html>"));
end GaussMarkov;
