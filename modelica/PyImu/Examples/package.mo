within PyImu;
package Examples "Sensors at rest, on a turn, in changing temperature, and each effect alone"
  extends Modelica.Icons.ExamplesPackage;
  annotation(Documentation(info="<html>
<p>Models that can be simulated as they are.</p>
</html>"));
end Examples;
