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
end earthRate;
