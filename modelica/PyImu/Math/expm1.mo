within PyImu.Math;
function expm1 "exp(x) - 1 without loss of digits near zero"
  extends Modelica.Icons.Function;
  input Real x;
  output Real y;
protected
  Real u;
algorithm
  u := exp(x);
  y := if u == 1 then x else if u - 1 == -1 then -1 else (u - 1)*x/log(u);
  annotation(Documentation(info="<html>
<p>W. Kahan's form: the rounding errors of exp and log cancel. As given by N. Higham, Accuracy and
Stability of Numerical Algorithms, 2002, section 1.14.1.</p>
</html>"));
end expm1;
