// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.ShapingFilters;
block AngleRandomWalk "Angle (velocity) random walk, of one axis, as a filter on white noise"
  extends PyImu.Icons.Effect;
  parameter Real N = 1 "root of the two-sided white noise density [{Y}/sqrt(s)]";
  Modelica.Blocks.Interfaces.RealInput u "White noise of two-sided density 1"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y "Noise"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
equation
  assert(N >= 0, "angle_random_walk: N must not be below 0");
  y = N*u;
  annotation(Documentation(info="<html>
<ul>
<li>transfer function: <code>N</code></li>
<li>poles: <code>none</code></li>
<li>two-sided density of the samples: <code>N^2</code></li>
<li>Allan deviation: <code>\\frac{N}{\\sqrt\\tau}</code></li>
</ul>
<p>In LaTeX; {y} is the unit of the output, {Y} that of its integral.</p>
</html>"));
end AngleRandomWalk;
