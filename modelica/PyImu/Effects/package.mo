// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu;
package Effects "Errors of sensors: each a package of its functions and blocks"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>Each package holds the functions of one effect, which are printed from its definition, and a
block of them for each kind of sensor that can have it. An effect without memory has a form in
continuous time as well.</p>
</html>"));
end Effects;
