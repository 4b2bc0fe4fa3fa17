within PyImu.Rover;
block Ackermann "Half a circle"
  extends PyImu.Rover.Drive;
  parameter Modelica.Units.SI.Velocity cruiseSpeed(min=1e-6) = 0.01 "Speed";
  parameter Modelica.Units.SI.Length radius(min=1e-3) = 1.25 "Radius, to the left";
  parameter Modelica.Units.SI.Angle angle(min=1e-3) = 3.141592653589793 "Angle";
equation
  assert(cruiseSpeed > 0 and angle > 0, "cruiseSpeed and angle must be above 0");
  assert(radius >= 1e-3, "radius must not be below 1e-3 m");
  motion = Functions.ackermannMotion(time, startTime, heading0, rampTime, latitude, gravity, cruiseSpeed,
    max(radius, 1e-3), angle);
  annotation(Documentation(info="<html>
<p>Half a circle of 1.25 m radius at 1 cm/s. Hidalgo 2012, section 6.1. The speed rises and falls along 10 x^3 - 15 x^4 + 6 x^5. The same
drive on rough ground, with a suspension and vibration, is the co-simulation unit RoverDrive.</p>
</html>"));
end Ackermann;
