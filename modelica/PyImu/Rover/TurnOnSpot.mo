within PyImu.Rover;
block TurnOnSpot "A turn on the spot and back"
  extends PyImu.Rover.Drive;
  parameter Modelica.Units.SI.AngularVelocity spotTurnRate(min=1e-6) = 0.02 "Turn rate";
  parameter Modelica.Units.SI.Angle angle(min=1e-3) = 3.141592653589793 "Angle";
  parameter Modelica.Units.SI.Time pause(min=0) = 0 "Rest between out and back";
equation
  assert(spotTurnRate > 0 and angle > 0, "spotTurnRate and angle must be above 0");
  assert(pause >= 0, "pause must not be below 0");
  motion = Functions.turnOnSpotMotion(time, startTime, heading0, rampTime, latitude, gravity, spotTurnRate, angle, pause);
  annotation(Documentation(info="<html>
<p>Half a turn at 0.02 rad/s and back. Hidalgo 2012, section 6.1. The speed rises and falls along 10 x^3 - 15 x^4 + 6 x^5. The same
drive on rough ground, with a suspension and vibration, is the co-simulation unit RoverDrive.</p>
</html>"));
end TurnOnSpot;
