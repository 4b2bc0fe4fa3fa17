within PyImu;
package Thermal "Temperature of a part"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>Sources of the temperature that the thermal effects follow.</p>
</html>"));
end Thermal;
