// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.ShapingFilters;
block BiasInstability "Bias instability, flicker noise, of one axis, as a filter on white noise"
  extends PyImu.Icons.Effect;
  parameter Real B = 1 "coefficient of the 1/f noise; the Allan deviation's floor is 0.664 B [{y}]";
  parameter Real f_low(unit="Hz") = 1e-05 "lower end of the band in which the density is 1/f";
  parameter Real f_high(unit="Hz") = 1 "upper end of that band, 2 to 5 decades above";
  Modelica.Blocks.Interfaces.RealInput u[6] "White noise of two-sided density 1"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y "Noise"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
protected
  parameter Real spacing = log(min(max(f_high/f_low, 100), 100000))/5
    "Of the rates, in the natural logarithm";
  parameter Real rate[6] = {2*Modelica.Constants.pi*f_low*exp((k - 1)*spacing)
    for k in 1:6} "1/s";
  parameter Real strength[6] = {B*sqrt(2*rate[k]*spacing/Modelica.Constants.pi
    *(if k == 1 or k == 6 then 0.535 + 1.363/spacing else 1))
    for k in 1:6};
  Real b[6](each start=0, each fixed=true);
equation
  assert(B >= 0, "bias_instability: B must not be below 0");
  assert(f_low >= 1e-12, "bias_instability: f_low must not be below 1e-12");
  assert(f_high >= 1e-12, "bias_instability: f_high must not be below 1e-12");
  assert(not PyImu.Effects.BiasInstability.biasInstabilityBroken1(f_low, f_high),
    "bias_instability: f_high must lie 2 to 5 decades above f_low");
  for k in 1:6 loop
    der(b[k]) = -rate[k]*b[k] + strength[k]*u[k];
  end for;
  y = sum(b);
  annotation(Documentation(info="<html>
<ul>
<li>transfer function: <code>c\\, \\frac{\\prod_{k=1}^{5} (s + z_k)}{\\prod_{k=1}^{6} (s + a_k)},\\quad
|H|^2 = \\sum_k \\frac{g_k^2}{a_k^2 + \\omega^2}</code></li>
<li>poles: <code>-a_k = -2 \\pi f_{low} (f_{high} / f_{low})^{(k - 1) / 5}</code></li>
<li>two-sided density of the samples: <code>\\approx \\frac{B^2}{2 \\pi f} \\quad (f_{low} \\le f \\le
f_{high})</code></li>
<li>Allan deviation: <code>\\approx \\sqrt{\\tfrac{2 \\ln 2}{\\pi}}\\, B = 0.664\\, B</code></li>
</ul>
<p>In LaTeX; {y} is the unit of the output, {Y} that of its integral.</p>
<p>A sum of six Gauss-Markov processes stands for the density. From $f_{low}$ to $f_{high}$ it
departs from $B^2 / (2 \\pi f)$ by at most 0.25 dB; the line of the Allan deviation is the integral
of the sum&#x27;s density.</p>
</html>"));
end BiasInstability;
