within PyImu;
package Interfaces "Connectors and what blocks have in common"
  extends Modelica.Icons.InterfacesPackage;
  annotation(Documentation(info="<html>
<p>Signals are plain real inputs and outputs, vectors of three along x (forward), y (left), z (up).</p>
</html>"));
end Interfaces;
