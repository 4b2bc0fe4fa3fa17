within PyImu.Interfaces;
partial block Triad "Three sensors along the body axes, with what every part is given"
  extends PyImu.Icons.Sensor;
  parameter Modelica.Units.SI.Time samplePeriod(min=1e-9) = 0.01
    "Time between two samples, the first at this time" annotation(Evaluate=true);
  parameter Real seed(min=0) = mod(1.0*globalSeed.seed
    + Modelica.Utilities.Strings.hashString(getInstanceName()), 2147483647)
    "Seed of the noise: a whole number, not negative";
  outer PyImu.Noise.GlobalSeed globalSeed "Seed of all sensors that have none of their own";
  Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s", each start=0)
    "Angular rate against inertial space, body axes"
    annotation(Placement(transformation(extent={{-140,40},{-100,80}})));
  Modelica.Blocks.Interfaces.RealInput specificForce[3](each unit="m/s2", start={0, 0, 9.80665})
    "Specific force, body axes"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealInput temperature(unit="degC", start=25) "Temperature of the part"
    annotation(Placement(transformation(extent={{-140,-80},{-100,-40}})));
equation
  assert(samplePeriod > 0, "samplePeriod must be a positive number of seconds");
  assert(seed >= 0 and seed <= floor(seed) and seed < 9007199254740992.0,
    "seed must be a whole number, not negative, below 2^53");
  annotation(Documentation(info="<html>
<p>Rate, specific force and temperature are inputs of every part, whether its effects need them or
not, so that parts can be exchanged. All of them must be connected or bound.</p>
</html>"));
end Triad;
