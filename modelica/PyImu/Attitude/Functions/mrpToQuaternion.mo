// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function mrpToQuaternion "The quaternion of modified Rodrigues parameters"
  extends Modelica.Icons.Function;
  input Real p[3];
  output Real y[4];
protected
  Real v1, v2, v3;
algorithm
  v1 := p[1]*p[1] + p[2]*p[2] + p[3]*p[3];
  v2 := (16 - v1)/(16 + v1);
  v3 := (1 + v2)/4;
  y[1] := v2;
  y[2] := v3*p[1];
  y[3] := v3*p[2];
  y[4] := v3*p[3];
  annotation(Documentation(info="<html>
<p>The unit quaternion (4,) of p (3,), the inverse of fromQuaternion.</p>
<p>Crassidis and Markley 2003, eqs. 21.</p>
</html>"));
end mrpToQuaternion;
