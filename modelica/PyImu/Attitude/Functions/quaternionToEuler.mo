// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function quaternionToEuler "Roll, pitch, yaw"
  extends Modelica.Icons.Function;
  input Real q[4];
  output Real y[3];
protected
  Real v1, v2, v3;
algorithm
  v1 := q[3]*q[3];
  v2 := 1 - 2*(v1 + q[4]*q[4]);
  v3 := 2*(q[2]*q[3] + q[1]*q[4]);
  y[1] := atan2(2*(q[3]*q[4] + q[1]*q[2]), 1 - 2*(q[2]*q[2] + v1));
  y[2] := atan2(2*(q[1]*q[3] - q[2]*q[4]), max(sqrt(v2*v2 + v3*v3), 0));
  y[3] := atan2(v3, v2);
  annotation(Documentation(info="<html>
<p>Roll, pitch, yaw (3,) in rad, the inverse of fromEuler for |pitch| &lt; pi/2.</p>
<p>Pitch is an arc tangent, not an arc sine: it keeps its digits close to +-pi/2, and needs no
clamp.</p>
</html>"));
end quaternionToEuler;
