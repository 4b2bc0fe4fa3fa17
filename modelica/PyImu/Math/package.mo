within PyImu;
package Math "Functions that the language lacks"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>Functions that printed expressions need and that Modelica does not define.</p>
</html>"));
end Math;
