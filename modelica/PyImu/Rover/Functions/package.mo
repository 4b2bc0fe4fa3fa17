// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Rover;
package Functions "Motion of the test drives as functions of time"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>Printed from the unit RoverDrive on level ground and without vibration.</p>
</html>"));
end Functions;
