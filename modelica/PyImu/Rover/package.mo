within PyImu;
package Rover "Drives of a rover"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>The manoeuvres of Hidalgo 2012, section 6.1, as formulas of time on level ground.</p>
</html>"));
end Rover;
