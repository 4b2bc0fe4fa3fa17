// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function quaternionProduct "q r, the rotation by r followed by that by q"
  extends Modelica.Icons.Function;
  input Real q[4], r[4];
  output Real y[4];
algorithm
  y[1] := q[1]*r[1] - (q[2]*r[2] + q[3]*r[3] + q[4]*r[4]);
  y[2] := q[1]*r[2] + r[1]*q[2] + (q[3]*r[4] - q[4]*r[3]);
  y[3] := q[1]*r[3] + r[1]*q[3] + (q[4]*r[2] - q[2]*r[4]);
  y[4] := q[1]*r[4] + r[1]*q[4] + (q[2]*r[3] - q[3]*r[2]);
  annotation(Documentation(info="<html>
<p>The product a b (4,), the rotation by b followed by that by a; Hamilton's i j = k.</p>
</html>"));
end quaternionProduct;
