// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.ShapingFilters;
block SecondGaussMarkov "Second exponentially correlated (Gauss-Markov) noise, of one axis, as a filter on white noise"
  extends PyImu.Icons.Effect;
  parameter Real q = 1 "root of the two-sided density of the noise that drives it [{y}/sqrt(s)]";
  parameter Real tau(unit="s") = 1 "correlation time, tau_c of the equation";
  Modelica.Blocks.Interfaces.RealInput u "White noise of two-sided density 1"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y "Noise"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
protected
  Real b(start=0, fixed=true);
equation
  assert(q >= 0, "second_gauss_markov: q must not be below 0");
  assert(tau >= 1e-06, "second_gauss_markov: tau must not be below 1e-06");
  der(b) = -b/tau + q*u;
  y = b;
  annotation(Documentation(info="<html>
<ul>
<li>transfer function: <code>\\frac{q}{s + 1 / \\tau_c}</code></li>
<li>poles: <code>-1 / \\tau_c</code></li>
<li>two-sided density of the samples: <code>\\frac{q^2 h\\, (1 - a^2)\\, \\tau_c / 2}{1 - 2 a \\cos(2 \\pi
f h) + a^2} \\approx \\frac{q^2 \\tau_c^2}{1 + (2 \\pi f \\tau_c)^2},\\quad a = e^{-h /
\\tau_c}</code></li>
<li>Allan deviation: <code>q \\tau_c \\sqrt{\\tfrac{1}{\\tau} \\left[1 - \\tfrac{\\tau_c}{2 \\tau} \\left(3 -
4 e^{-\\tau / \\tau_c} + e^{-2 \\tau / \\tau_c}\\right)\\right]}</code></li>
</ul>
<p>In LaTeX; {y} is the unit of the output, {Y} that of its integral.</p>
<p>The closed form is the continuous one (IEEE Std 952-2020, annex C); samples lie above, in the
variance by at most $\\left(h / (\\sqrt{2}\\, \\tau) + h / (\\sqrt{12}\\, \\tau_c)\\right)^2$ of it. The
coefficient `tau` is the correlation time $\\tau_c$; $\\tau$ alone is the cluster time.</p>
</html>"));
end SecondGaussMarkov;
