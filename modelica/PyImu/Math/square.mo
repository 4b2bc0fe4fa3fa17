within PyImu.Math;
function square "The square of a number, by one product"
  extends Modelica.Icons.Function;
  input Real x;
  output Real y;
algorithm
  y := x*x;
  annotation(Inline=true, Documentation(info="<html>
<p>x^2 may be made by a power function, whose last bit may differ.</p>
</html>"));
end square;
