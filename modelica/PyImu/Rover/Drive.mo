within PyImu.Rover;
partial block Drive "Motion of a rover on level ground as a function of time"
  extends PyImu.Icons.Sensor;
  parameter Modelica.Units.SI.Time startTime(min=0) = 60 "Rest before the drive";
  parameter Modelica.Units.SI.Angle heading0 = 0 "Heading at the start, counter-clockwise from east";
  parameter Modelica.Units.SI.Time rampTime(min=0.01) = 2 "Time in which it starts, and stops";
  parameter Modelica.Units.SI.Angle latitude = 0.9114109353914389 "Geographic latitude; Noordwijk";
  parameter Modelica.Units.SI.Acceleration gravity = 9.80665 "Gravity";
  Modelica.Blocks.Interfaces.RealOutput q[4](each unit="1") "Attitude, body to world"
    annotation(Placement(transformation(extent={{100,70},{120,90}})));
  Modelica.Blocks.Interfaces.RealOutput rate[3](each unit="rad/s") "Rate against inertial space, body axes"
    annotation(Placement(transformation(extent={{100,20},{120,40}})));
  Modelica.Blocks.Interfaces.RealOutput specificForce[3](each unit="m/s2") "Specific force, body axes"
    annotation(Placement(transformation(extent={{100,-40},{120,-20}})));
  Modelica.Blocks.Interfaces.RealOutput position[3](each unit="m") "East, north, up of the start"
    annotation(Placement(transformation(extent={{100,-90},{120,-70}})));
protected
  Real motion[13];
equation
  assert(startTime >= 0, "startTime must not be below 0");
  assert(rampTime >= 0.01, "rampTime must not be below 0.01 s");
  q = {motion[1], motion[2], motion[3], motion[4]};
  rate = {motion[5], motion[6], motion[7]};
  specificForce = {motion[8], motion[9], motion[10]};
  position = {motion[11], motion[12], motion[13]};
  annotation(Documentation(info="<html>
<p>What all drives have: attitude, rate against inertial space, specific force in body axes, place.
The rate contains the Earth's rotation, the specific force gravity.</p>
</html>"));
end Drive;
