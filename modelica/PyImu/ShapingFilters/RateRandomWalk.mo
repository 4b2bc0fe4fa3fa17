// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.ShapingFilters;
block RateRandomWalk "Rate (acceleration) random walk, of one axis, as a filter on white noise"
  extends PyImu.Icons.Effect;
  parameter Real K = 1 "root of the two-sided density of the bias's derivative [{y}/sqrt(s)]";
  Modelica.Blocks.Interfaces.RealInput u "White noise of two-sided density 1"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y "Noise"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
protected
  Real b(start=0, fixed=true);
equation
  assert(K >= 0, "rate_random_walk: K must not be below 0");
  der(b) = K*u;
  y = b;
  annotation(Documentation(info="<html>
<ul>
<li>transfer function: <code>\\frac{K}{s}</code></li>
<li>poles: <code>0</code></li>
<li>two-sided density of the samples: <code>\\frac{K^2 h^2}{4 \\sin^2(\\pi f h)} \\approx \\frac{K^2}{(2
\\pi f)^2}</code></li>
<li>Allan deviation: <code>K \\sqrt{\\frac{\\tau}{3} \\left(1 + \\frac{1}{2 n^2}\\right)}</code></li>
</ul>
<p>In LaTeX; {y} is the unit of the output, {Y} that of its integral.</p>
</html>"));
end RateRandomWalk;
