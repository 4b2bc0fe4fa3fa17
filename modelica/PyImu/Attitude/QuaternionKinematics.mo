within PyImu.Attitude;
block QuaternionKinematics "Attitude of a body that turns at a rate"
  extends PyImu.Icons.Sensor;
  parameter Real q0[4] = {1, 0, 0, 0} "Attitude at the start";
  parameter Modelica.Units.SI.Angle latitude = 0 "Geographic latitude";
  parameter Boolean turningEarth = false "True where the rate is against inertial space"
    annotation(Evaluate=true);
  parameter Real gain(unit="1/s") = 1 "How fast an error of the length dies away";
  Modelica.Blocks.Interfaces.RealInput rate[3](each unit="rad/s") "Angular rate, body axes"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput q[4](each unit="1") "Attitude, body to world, of unit length"
    annotation(Placement(transformation(extent={{100,40},{120,60}})));
  Modelica.Blocks.Interfaces.RealOutput euler[3](each unit="rad") "Roll, pitch, yaw"
    annotation(Placement(transformation(extent={{100,-60},{120,-40}})));
protected
  Real turned[4](start=q0, each fixed=true) "Attitude before its length is set right";
  Real earth[3] "Rotation of the world axes, body axes";
equation
  assert(q0*q0 > 0, "q0 must not be zero");
  earth = if turningEarth then Functions.quaternionRotate(Functions.quaternionConjugate(q),
    Functions.earthRate(latitude)) else fill(0, 3);
  der(turned) = Functions.quaternionDerivative(turned, rate - earth)
    + gain*(1 - turned*turned)*turned;
  q = Functions.quaternionNormalized(turned);
  euler = Functions.quaternionToEuler(q);
  annotation(Documentation(info="<html>
<p>dq/dt = q (0, rate)/2; Hidalgo 2012, section 4.1, there with the vector part first. The length of
the integrated quaternion is drawn back to 1, and what goes out is of unit length.</p>
</html>"));
end QuaternionKinematics;
