// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function quaternionNormalized "q at unit length"
  extends Modelica.Icons.Function;
  input Real q[4];
  output Real y[4];
protected
  Real v1;
algorithm
  v1 := sqrt(q[1]*q[1] + q[2]*q[2] + q[3]*q[3] + q[4]*q[4]);
  y[1] := q[1]/v1;
  y[2] := q[2]/v1;
  y[3] := q[3]/v1;
  y[4] := q[4]/v1;
  annotation(Documentation(info="<html>
<p>q at unit length.</p>
<p>After a product one Newton step would do, but the root is exact for any length.</p>
</html>"));
end quaternionNormalized;
