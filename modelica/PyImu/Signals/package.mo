// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu;
package Signals "Signals that follow from the course of others"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>What some effects depend on besides the inputs of a sensor: rates of change, mean squares, what
follows from attitude and place.</p>
</html>"));
end Signals;
