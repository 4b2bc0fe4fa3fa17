within PyImu.Rover;
block Straight "A straight line"
  extends PyImu.Rover.Drive;
  parameter Modelica.Units.SI.Velocity cruiseSpeed(min=1e-6) = 0.01 "Speed";
  parameter Modelica.Units.SI.Length length(min=1e-3) = 5 "Length";
equation
  assert(cruiseSpeed > 0 and length > 0, "cruiseSpeed and length must be above 0");
  motion = Functions.straightMotion(time, startTime, heading0, rampTime, latitude, gravity, cruiseSpeed, length);
  annotation(Documentation(info="<html>
<p>A straight line of 5 m at 1 cm/s. Hidalgo 2012, section 6.1. The speed rises and falls along 10 x^3 - 15 x^4 + 6 x^5. The same
drive on rough ground, with a suspension and vibration, is the co-simulation unit RoverDrive.</p>
</html>"));
end Straight;
