within PyImu;
package Sensors "Gyroscopes, accelerometers and inertial measurement units"
  extends Modelica.Icons.Package;
  annotation(Documentation(info="<html>
<p>A sensor is a chain of effects, in the order of their stages: motion, dynamics, gain, bias, noise, output. It has the effects that its part has and no others.</p>
</html>"));
end Sensors;
