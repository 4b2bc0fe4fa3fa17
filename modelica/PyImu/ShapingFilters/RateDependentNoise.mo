// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.ShapingFilters;
block RateDependentNoise "Rate-dependent noise, scale factor noise, of one axis, as a filter on white noise"
  extends PyImu.Icons.Effect;
  parameter Real k = 1 "root of the two-sided density of the relative error [sqrt(s)]";
  parameter Real x = 1 "Input of the axis";
  Modelica.Blocks.Interfaces.RealInput u "White noise of two-sided density 1"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y "Noise"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
equation
  assert(k >= 0, "rate_dependent_noise: k must not be below 0");
  y = k*abs(x)*u;
  annotation(Documentation(info="<html>
<ul>
<li>transfer function: <code>k\\, |x|</code></li>
<li>poles: <code>none</code></li>
<li>two-sided density of the samples: <code>k^2 x^2</code></li>
<li>Allan deviation: <code>\\frac{k |x|}{\\sqrt\\tau}</code></li>
</ul>
<p>In LaTeX; {y} is the unit of the output, {Y} that of its integral.</p>
<p>White noise in proportion to the size of the input.</p>
</html>"));
end RateDependentNoise;
