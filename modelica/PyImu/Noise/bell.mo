within PyImu.Noise;
function bell "exp(-x^2/2)"
  extends Modelica.Icons.Function;
  input Real x;
  output Real y;
algorithm
  y := exp(-0.5*x*x);
  annotation(Documentation(info="<html>
<p>The density of a standard normal, not normalised.</p>
</html>"));
end bell;
