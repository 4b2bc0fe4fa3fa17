// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function quaternionRotate "A vector of the body in world axes"
  extends Modelica.Icons.Function;
  input Real q[4], v[3];
  output Real y[3];
protected
  Real v1, v2, v3;
algorithm
  v1 := 2*(q[3]*v[3] - q[4]*v[2]);
  v2 := 2*(q[2]*v[2] - q[3]*v[1]);
  v3 := 2*(q[4]*v[1] - q[2]*v[3]);
  y[1] := v[1] + q[1]*v1 + (q[3]*v2 - q[4]*v3);
  y[2] := v[2] + q[1]*v3 + (q[4]*v1 - q[2]*v2);
  y[3] := v[3] + q[1]*v2 + (q[2]*v3 - q[3]*v1);
  annotation(Documentation(info="<html>
<p>The vector v (3,) of the body in world axes.</p>
<p>v + 2 w (r x v) + 2 r x (r x v) for q = (w, r).</p>
</html>"));
end quaternionRotate;
