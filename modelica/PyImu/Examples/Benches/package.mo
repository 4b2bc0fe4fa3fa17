// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Examples;
package Benches "Each effect alone, with inputs that excite its branches"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>One model for each effect. Their values are compared in the tests with those of the definition,
sample by sample.</p>
</html>"));
end Benches;
