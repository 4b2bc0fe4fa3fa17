// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude;
package Functions "Functions of quaternions, Rodrigues parameters and the Earth's rotation"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>Printed from pyimu.symbolic. Quaternions are Hamilton's, scalar first, from body to world axes
(east, north, up).</p>
</html>"));
end Functions;
