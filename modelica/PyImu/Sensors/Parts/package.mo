// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors;
package Parts "The built-in parts"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>A package for each part: its gyroscope, its accelerometer, and both as a measurement unit. A part
has the effects of which its data sheet says something.</p>
</html>"));
end Parts;
