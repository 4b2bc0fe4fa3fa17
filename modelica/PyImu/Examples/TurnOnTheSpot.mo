within PyImu.Examples;
model TurnOnTheSpot "A rover turns on the spot; its gyros have a scale factor that nobody declared"
  extends Modelica.Icons.Example;
  inner PyImu.Noise.GlobalSeed globalSeed;
  PyImu.Rover.TurnOnSpot drive(startTime=10)
    annotation(Placement(transformation(extent={{-90,-20},{-50,20}})));
  PyImu.Effects.ScaleFactor.GyroContinuous undeclared(s={-0.018, 0.011, -0.036})
    annotation(Placement(transformation(extent={{-30,0},{0,30}})));
  PyImu.Sensors.Gyroscope gyroscope(part=PyImu.Sensors.Part.Imt30, samplePeriod=0.1, seed=1,
    temperature=25)
    annotation(Placement(transformation(extent={{20,-20},{60,20}})));
  PyImu.Attitude.QuaternionKinematics estimate(turningEarth=true, latitude=drive.latitude)
    annotation(Placement(transformation(extent={{70,-20},{110,20}})));
  Real headingError(unit="rad") "Estimated less true heading";
protected
  Real true_[3];
equation
  connect(drive.rate, undeclared.x);
  connect(undeclared.y, gyroscope.rate);
  connect(drive.specificForce, gyroscope.specificForce);
  connect(gyroscope.y, estimate.rate);
  true_ = PyImu.Attitude.Functions.quaternionToEuler(drive.q);
  headingError = atan2(sin(estimate.euler[3] - true_[3]), cos(estimate.euler[3] - true_[3]));
  annotation(
    experiment(StopTime=180, Interval=0.1),
    Documentation(info="<html>
<p>Hidalgo 2012, section 6.2, found 6.5 deg of heading error after half a turn; a scale factor error
of 3.6 % about the vertical makes as much.</p>
</html>"));
end TurnOnTheSpot;
