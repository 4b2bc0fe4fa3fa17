// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function quaternionFromEuler "The quaternion of Rz(yaw) Ry(pitch) Rx(roll)"
  extends Modelica.Icons.Function;
  input Real roll, pitch, yaw;
  output Real y[4];
protected
  Real v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13;
algorithm
  v1 := yaw/2;
  v2 := cos(v1);
  v3 := pitch/2;
  v4 := cos(v3);
  v5 := roll/2;
  v6 := cos(v5);
  v7 := v4*v6;
  v8 := sin(v1);
  v9 := sin(v3);
  v10 := sin(v5);
  v11 := v9*v10;
  v12 := v4*v10;
  v13 := v6*v9;
  y[1] := v2*v7 + v8*v11;
  y[2] := v2*v12 - v8*v13;
  y[3] := v2*v13 + v8*v12;
  y[4] := v7*v8 - v2*v11;
  annotation(Documentation(info="<html>
<p>The quaternion (4,) of Rz(yaw) Ry(pitch) Rx(roll), angles in rad.</p>
<p>Yaw is counter-clockwise from east, nose up is negative pitch (REP 103).</p>
</html>"));
end quaternionFromEuler;
