within PyImu.Noise;
block Flicker "Flicker noise of three axes: bias instability"
  extends PyImu.Interfaces.NoiseSource(final count=18);
  parameter Real B[3](each min=0) = fill(1, 3) "Coefficient of the density B^2/(2 pi f), unit of y";
  parameter Real f_low(unit="Hz") = 1e-5 "Lower end of the band";
  parameter Real f_high(unit="Hz") = 1 "Upper end of the band, 2 to 5 decades above";
  PyImu.Effects.BiasInstability.Gyro effect(samplePeriod=samplePeriod, B=B, f_low=f_low, f_high=f_high);
equation
  effect.x = fill(0, 3);
  connect(normals.y, effect.w);
  connect(effect.y, y);
  annotation(Documentation(info="<html>
<p>A sum of Gauss-Markov processes whose corners lie evenly in the logarithm of frequency, of
density B^2/(2 pi f) between f_low and f_high: Effects.BiasInstability on a perfect sensor at rest.
Spectrum and source stand with ShapingFilters.BiasInstability.</p>
</html>"));
end Flicker;
