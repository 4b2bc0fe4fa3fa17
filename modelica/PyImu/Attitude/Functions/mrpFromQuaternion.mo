// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function mrpFromQuaternion "Modified Rodrigues parameters, in rad for small angles"
  extends Modelica.Icons.Function;
  input Real q[4];
  output Real y[3];
protected
  Real v1;
algorithm
  v1 := 1 + q[1];
  y[1] := 4*q[2]/v1;
  y[2] := 4*q[3]/v1;
  y[3] := 4*q[4]/v1;
  annotation(Documentation(info="<html>
<p>p (3,) of the unit quaternion q (4,).</p>
<p>Hidalgo 2012, equation of the delta quaternion; Crassidis and Markley 2003, eq. 16.</p>
</html>"));
end mrpFromQuaternion;
