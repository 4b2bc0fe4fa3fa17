// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude.Functions;
function earthRate "The Earth's rotation in world axes, rad/s"
  extends Modelica.Icons.Function;
  input Real latitude;
  output Real y[3];
algorithm
  y[1] := 0;
  y[2] := 7.292115e-05*cos(latitude);
  y[3] := 7.292115e-05*sin(latitude);
  annotation(Documentation(info="<html>
<p>Rate (3,) rad/s of the east-north-up frame against inertial space at latitude rad.</p>
<p>Hidalgo 2012, equation of the Earth rotation vector, printed there in north-west-up axes: [cos,
0, sin] of the latitude; Groves 2013, eq. 2.123, in north-east-down.</p>
</html>"));
end earthRate;
