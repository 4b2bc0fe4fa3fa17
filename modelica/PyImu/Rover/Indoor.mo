within PyImu.Rover;
block Indoor "An indoor robot: a known start-up motion, then straights, quarter turns and stops"
  extends PyImu.Interfaces.Sampled(samplePeriod=0.02);
  parameter Modelica.Units.SI.AngularVelocity turnRate(min=1e-6) = 0.5235987755982988 "Turn rate";
  parameter Real slip(unit="1") = 0 "Share by which the start-up motion turns farther than it is said to";
  parameter Modelica.Units.SI.Acceleration gravity = 9.80665 "Gravity";
  Modelica.Blocks.Interfaces.RealOutput rate[3](each unit="rad/s", each start=0, each fixed=true)
    "Mean rate of the period that ends with the sample, body axes; the Earth does not turn"
    annotation(Placement(transformation(extent={{100,70},{120,90}})));
  Modelica.Blocks.Interfaces.RealOutput specificForce[3](each unit="m/s2") "Specific force, body axes"
    annotation(Placement(transformation(extent={{100,30},{120,50}})));
  Modelica.Blocks.Interfaces.RealOutput heading(unit="rad", start=0, fixed=true)
    "Heading, counter-clockwise from that at the start"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  Modelica.Blocks.Interfaces.RealOutput nominalHeading(unit="rad", start=0, fixed=true)
    "Heading that the motion is said to have"
    annotation(Placement(transformation(extent={{100,-50},{120,-30}})));
  Modelica.Blocks.Interfaces.BooleanOutput standing "The robot stands"
    annotation(Placement(transformation(extent={{100,-90},{120,-70}})));
protected
  parameter Real count = floor(20/samplePeriod + 0.5)
    + 10*(floor(4.8/samplePeriod + 0.5) + floor(8.2/samplePeriod + 0.5) + floor(3/samplePeriod + 0.5))
    "Samples of the drive";
  parameter Integer width = 2*integer(3*(0.3/6/samplePeriod) + 0.5) + 1
    "Samples over which an edge is rounded: three standard deviations to either side";
  discrete Real k(start=0, fixed=true) "Number of the sample";
  discrete Real turn[2](start={0, 1}, each fixed=true) "Share of the turn rate; 1 where the robot stands";
equation
  assert(turnRate > 0, "turnRate must be above 0");
  specificForce = {0, 0, gravity};
  standing = turn[2] > 0.5;
  when sample(samplePeriod, samplePeriod) then
    k = pre(k) + 1;
    turn = indoorTurn(k, samplePeriod, count, width);
    rate = {0, 0, turnRate*turn[1]*(if k*samplePeriod < 20 + 0.5*samplePeriod then 1 + slip else 1)};
    heading = pre(heading) + rate[3]*samplePeriod;
    nominalHeading = pre(nominalHeading) + turnRate*turn[1]*samplePeriod;
  end when;
  annotation(Documentation(info="<html>
<p>The drive on which a gyro is calibrated by itself and a heading is estimated: after Hong and Park
2008, who give neither the motion nor its length. 3 min, of which 20 s are the start-up motion, half a
turn to the left and back; then ten cycles of a stop, a straight and a quarter turn at 30 deg/s, seven
to the left and three to the right. Its edges are those of pyimu.rover.indoor; the wander of the
heading and the shaking of the wheels, which are drawn there, are left to the noise blocks.</p>
</html>"));
end Indoor;
