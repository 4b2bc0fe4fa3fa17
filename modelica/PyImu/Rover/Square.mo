within PyImu.Rover;
block Square "A square with a stop before and after each turn"
  extends PyImu.Rover.Drive(startTime=10, rampTime=0.5, latitude=0.23963370629657247);
  parameter Integer legs(min=1) = 4 "Number of legs, each followed by a turn";
  parameter Modelica.Units.SI.Length side(min=1e-3) = 2 "Length of a leg";
  parameter Modelica.Units.SI.Velocity speed(min=1e-6) = 0.3 "Speed";
  parameter Modelica.Units.SI.AngularVelocity turnRate(min=1e-6) = 0.7853981633974483 "Turn rate";
  parameter Modelica.Units.SI.Angle turn = 1.5707963267948966 "Angle of a turn, to the left above zero";
  parameter Modelica.Units.SI.Time stops(min=0) = 3 "Rest before and after each turn";
equation
  assert(legs >= 1, "legs must be 1 at least");
  assert(speed > 0 and turnRate > 0, "speed and turnRate must be above 0");
  assert(side/speed >= rampTime and abs(turn)/turnRate >= rampTime,
    "a leg or a turn is shorter than rampTime: make it slower or longer");
  assert(stops >= 0, "stops must not be below 0");
  motion = squareMotion(time, startTime, heading0, rampTime, latitude, gravity, legs, side, speed,
    turnRate, turn, stops);
  annotation(Documentation(info="<html>
<p>The drive by which a path is estimated from an inertial unit alone: Wongwirat and Chaiyarat 2010
drove a square. Sides, speeds and stops are this package's; the other turn of the polygon is its
parameter. The same motion with a tilt and with vibration is pyimu.rover.trajectory.</p>
</html>"));
end Square;
