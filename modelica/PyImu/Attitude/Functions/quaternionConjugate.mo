// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function quaternionConjugate "The inverse of a unit quaternion"
  extends Modelica.Icons.Function;
  input Real q[4];
  output Real y[4];
algorithm
  y[1] := q[1];
  y[2] := -q[2];
  y[3] := -q[3];
  y[4] := -q[4];
  annotation(Documentation(info="<html>
<p>The inverse of a unit quaternion, (4,).</p>
</html>"));
end quaternionConjugate;
