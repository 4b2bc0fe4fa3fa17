within PyImu.Rover;
function squareMotion "A polygon of straight legs with turns on the spot between them, at the time t"
  extends Modelica.Icons.Function;
  input Real t;
  input Real startTime;
  input Real heading0;
  input Real rampTime;
  input Real latitude;
  input Real gravity;
  input Integer legs;
  input Real side;
  input Real speed;
  input Real turnRate;
  input Real turn;
  input Real stops;
  output Real y[13] "Attitude (4), rate (3), specific force (3), position (3)";
protected
  Real start "Of the move, s";
  Real course "Of the leg, rad";
  Real yaw;
  Real yawRate;
  Real move[3];
  Real east[3] "Position, velocity and acceleration";
  Real north[3];
  Real earth[3] "Rotation of the Earth, world axes";
  Real force[3] "World axes";
algorithm
  start := startTime;
  course := heading0;
  yaw := heading0;
  yawRate := 0;
  east := {0, 0, 0};
  north := {0, 0, 0};
  for i in 1:legs loop
    move := smoothProgress(t - start, side/speed, rampTime);
    east := {east[1] + speed*cos(course)*move[1], east[2] + speed*cos(course)*move[2],
      east[3] + speed*cos(course)*move[3]};
    north := {north[1] + speed*sin(course)*move[1], north[2] + speed*sin(course)*move[2],
      north[3] + speed*sin(course)*move[3]};
    start := start + side/speed + rampTime + stops;
    move := smoothProgress(t - start, abs(turn)/turnRate, rampTime);
    yaw := yaw + (if turn > 0 then turnRate else -turnRate)*move[1];
    yawRate := yawRate + (if turn > 0 then turnRate else -turnRate)*move[2];
    course := course + turn;
    start := start + abs(turn)/turnRate + rampTime + stops;
  end for;
  earth := PyImu.Attitude.Functions.earthRate(latitude);
  force := {
    east[3] - 2*earth[3]*north[2],
    north[3] + 2*earth[3]*east[2],
    gravity - 2*earth[2]*east[2]};
  y := {
    cos(yaw/2), 0, 0, sin(yaw/2),
    earth[2]*sin(yaw), earth[2]*cos(yaw), earth[3] + yawRate,
    force[1]*cos(yaw) + force[2]*sin(yaw), force[2]*cos(yaw) - force[1]*sin(yaw), force[3],
    east[1], north[1], 0};
  annotation(Documentation(info="<html>
<p>Position, velocity and acceleration of each leg and angle and rate of each turn by
smoothProgress; the specific force has gravity and the Coriolis force 2 w x v of the turning Earth,
the rate the Earth's. As pyimu.rover.trajectory, there in closed form as well.</p>
</html>"));
end squareMotion;
