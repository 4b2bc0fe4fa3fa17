// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Attitude;
block AttitudeUkf "Unscented attitude filter of the part imt30, in C"
  extends PyImu.Interfaces.Sampled(samplePeriod=0.0010245901639344263);
  parameter Boolean useHeading = false "True where a heading sensor is connected"
    annotation(Evaluate=true, choices(checkBox=true), Dialog(group="Inputs"));
  parameter Boolean useStationary = false "True where it is told when the body stands"
    annotation(Evaluate=true, choices(checkBox=true), Dialog(group="Inputs"));
  parameter Boolean useSpeed = false "True where a speed is connected" annotation(Evaluate=true,
    choices(checkBox=true), Dialog(group="Inputs"));
  parameter Boolean useMagnetometer = false "True where a magnetometer is connected"
    annotation(Evaluate=true, choices(checkBox=true), Dialog(group="Inputs"));
  parameter Real latitude(unit="rad") = 10
    "Latitude; a finite value outside -pi/2 to pi/2 is unknown: no Earth rate"
    annotation(Dialog(group="Filter"));
  parameter Real q0[4](each unit="1", each min=-1000000.0, each max=1000000.0) = {1, 0, 0, 0}
    "Attitude before the first sample" annotation(Dialog(group="Start"));
  parameter Real bias0[3](each unit="rad/s", each min=-100, each max=100) = {0, 0, 0}
    "Gyro bias before the first sample" annotation(Dialog(group="Start"));
  parameter Real std0[6](unit={"rad", "rad", "rad", "rad/s", "rad/s", "rad/s"}, each min=0, each
    max=1000000.0) = {0.1, 0.1, 0.1, 0.01, 0.01, 0.01}
    "Standard deviation of the attitude before the first sample"
    annotation(Dialog(group="Start"));
  parameter Real gravity(unit="m/s2", min=0) = 9.80665 "Magnitude of gravity"
    annotation(Dialog(group="Filter"));
  parameter Real accelStd(unit="m/s2", min=0) = 0.0001
    "Standard deviation of the acceleration that a body has beside its bounded velocity, and beside the pushes that the run shows"
    annotation(Dialog(group="Filter"));
  parameter Real accelBiasStd(unit="m/s2", min=0) = 0
    "Standard deviation of a component of the accelerometer's constant error, which tilts the attitude by its share of gravity"
    annotation(Dialog(group="Filter"));
  parameter Real accelCorrelationTime(unit="s", min=0) = 0.5
    "Correlation time of that acceleration; 0 is white from sample to sample"
    annotation(Dialog(group="Filter"));
  parameter Real gravityWalk(min=0) = 0.2
    "Random walk of the magnitude in the quasi-static estimator [m/s^2/sqrt(s)]"
    annotation(Dialog(group="Filter"));
  parameter Real gravityTolerance(unit="m/s2", min=0) = 0.25 "Quasi-static"
    annotation(Dialog(group="Filter"));
  parameter Real motionTolerance(unit="m/s2", min=0) = 1
    "Quasi-static: largest difference of a sample's magnitude and the estimated one"
    annotation(Dialog(group="Filter"));
  parameter Real steadyTolerance(unit="m/s2", min=0) = 0.3
    "Quasi-static: largest root mean square of the force against its mean, beside white noise"
    annotation(Dialog(group="Filter"));
  parameter Real motionTime(unit="s", min=0) = 1
    "Correlation time of the velocity of a body that stays in its place"
    annotation(Dialog(group="Filter"));
  parameter Real pushStd(unit="m/s2", min=0) = 0
    "Standard deviation of an axis of pushes that last, as of a vehicle or an aircraft that is on its way before the first sample, until the run shows how large they are"
    annotation(Dialog(group="Filter"));
  parameter Real motionShare(unit="1", min=0, max=1) = 0.0001
    "Least share that the density of that velocity has at low frequency of one of that correlation time, as far as the run shows less"
    annotation(Dialog(group="Filter"));
  parameter Real rateNoise(min=0) = 0
    "Root density of the relative error of the rate, which leaks onto all axes [sqrt(s)]"
    annotation(Dialog(group="Filter"));
  parameter Real scaleStd(unit="1", min=0) = 0
    "Standard deviation of the scale factor of each of the gyro's axes, of which the run learns nothing"
    annotation(Dialog(group="Filter"));
  parameter Real axesStd(unit="rad", min=0) = 0
    "Standard deviation of the angle, about each axis, between the vertical of the accelerometer and the axis about which the gyro says that a body turns whose speed is given"
    annotation(Dialog(group="Filter"));
  parameter Real biasNoise(min=0) = 0
    "Root density of the walk of the bias over the rate [1/sqrt(s)]"
    annotation(Dialog(group="Filter"));
  parameter Real biasDrift(min=0) = 0
    "Root density of the walk of the bias beyond that of the part, as of a gyro that warms up, until rests show how large it is [rad/s/sqrt(s)]"
    annotation(Dialog(group="Filter"));
  parameter Real motionBias(unit="rad/s", min=0) = 0
    "Standard deviation by which the bias of the gyro is another while the body turns fast, by 0.5 rad/s and more over 10 s, than at rest"
    annotation(Dialog(group="Filter"));
  parameter Real stationaryStd(unit="rad/s", min=0) = 1e-05
    "Standard deviation of the rate of a body that is called stationary"
    annotation(Dialog(group="Filter"));
  parameter Real restTime(unit="s", min=0) = 1.5
    "A body of which no sample differs from the others for so long is at rest, or for 2.5 s where its bias about the vertical is not known to 2e-3 rad/s"
    annotation(Dialog(group="Filter"));
  parameter Real restRateTolerance(unit="rad/s", min=0) = 0.005
    "Largest difference of a sample's rate from the others' mean at rest, beside white noise"
    annotation(Dialog(group="Filter"));
  parameter Real restForceTolerance(unit="m/s2", min=0) = 0.2
    "Largest difference of a sample's force from the mean at rest, beside white noise"
    annotation(Dialog(group="Filter"));
  parameter Real slipStd(unit="m/s", min=0) = 0.1
    "Standard deviation of the velocity across and upwards of a body whose speed is given"
    annotation(Dialog(group="Filter"));
  parameter Real speedTolerance(unit="1", min=0) = 0.01
    "Standard deviation of the share by which the accelerations of a body whose speed is given are others than the speed says"
    annotation(Dialog(group="Filter"));
  parameter Real lostRateStd(unit="rad/s", min=0) = 1
    "Standard deviation of the rate along an axis whose gyro is lost"
    annotation(Dialog(group="Filter"));
  parameter Real stuckTime(unit="s", min=0) = 0
    "Equal samples of a triad for so long mean that it is stuck; 0: never"
    annotation(Dialog(group="Filter"));
  parameter Real axisStuckTime[6](each unit="s", each min=0, each max=1000000.0) = {0, 0, 0, 0,
    0, 0}
    "Equal samples of an axis (gyro, then accelerometer) for so long, while the others of its triad change, mean that it is stuck"
    annotation(Dialog(group="Filter"));
  parameter Real headingMemory(unit="s", min=0) = 0.5
    "Largest headingAge; beyond 63 samples the course in between is interpolated"
    annotation(Dialog(group="Filter"));
  parameter Real declination(unit="rad", min=-3.141592653589793, max=3.141592653589793) = 0
    "Declination of the magnetic field, positive to the east: yaw is against true north"
    annotation(Dialog(group="Filter"));
  parameter Real fieldStrength(unit="T", min=0) = 0
    "Strength of the place's magnetic field; 0: not known, the run learns it with the dip from its samples alone"
    annotation(Dialog(group="Filter"));
  parameter Real fieldDip(unit="rad", min=-1.5707963267948966, max=1.5707963267948966) = 0
    "Dip of that field below the horizon" annotation(Dialog(group="Filter"));
  parameter Real fieldStrengthStd(unit="T", min=0) = 1.4e-07
    "Standard deviation of the horizontal and of the vertical part of that field"
    annotation(Dialog(group="Filter"));
  parameter Real fieldStd(unit="T", min=0) = 2e-07
    "Standard deviation of what the place's field has across its horizontal direction"
    annotation(Dialog(group="Filter"));
  parameter Real fieldTime(unit="s", min=0) = 300 "Correlation time of that difference"
    annotation(Dialog(group="Filter"));
  parameter Real fieldTurningStd(unit="T", min=0) = 1e-06
    "Standard deviation of a component of what differs from one attitude of the body to another, as the magnetometer's bias does, before the run itself shows it"
    annotation(Dialog(group="Filter"));
  parameter Real fieldNoise(min=0) = 1e-07
    "Root density of the magnetometer's white noise [T*sqrt(s)]"
    annotation(Dialog(group="Filter"));
  parameter Real fieldTolerance(unit="1", min=0) = 0.13
    "Share of the field's strength by which strength or dip may differ from what the run has learnt of them"
    annotation(Dialog(group="Filter"));
  parameter Real gyroThermalBias_kT[3](each unit="rad/(s.K)") = {0.00034906585039886593,
    0.0009773843811168245, 0.0008726646259971648} "Bias per kelvin"
    annotation(Dialog(group="Sensor"));
  parameter Real gyroThermalBias_T0(unit="degC") = 25
    "Temperature at which the thermal error is zero" annotation(Dialog(group="Sensor"));
  parameter Real gyroAngleRandomWalk_N[3](each min=0) = {6.0400027647350424e-05,
    6.940010882346785e-05, 5.960008507351969e-05}
    "Root of the two-sided white noise density [rad/sqrt(s)]"
    annotation(Dialog(group="Sensor"));
  parameter Real gyroRateRandomWalk_K[3](each min=0) = {2.6503147900654633e-06,
    4.007793097172164e-06, 5.187506387872035e-06}
    "Root of the two-sided density of the bias's derivative [rad/s/sqrt(s)]"
    annotation(Dialog(group="Sensor"));
  Modelica.Blocks.Interfaces.RealInput gyro[3](each unit="rad/s", start={0, 0, 0})
    "Measured rate against inertial space, body axes"
    annotation(Placement(transformation(extent={{-140,30},{-100,70}})));
  Modelica.Blocks.Interfaces.RealInput accel[3](each unit="m/s2", start={0, 0, 9.80665})
    "Measured specific force, body axes"
    annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealInput temperature(unit="degC", start=25)
    "Temperature of the part"
    annotation(Placement(transformation(extent={{-140,-70},{-100,-30}})));
  Modelica.Blocks.Interfaces.RealInput heading(unit="rad") if useHeading
    "Heading, counter-clockwise from east"
    annotation(Placement(transformation(extent={{-10,-10},{10,10}}, rotation=90,
    origin={-80,-120})));
  Modelica.Blocks.Interfaces.RealInput headingVariance(unit="rad2") if useHeading
    "Variance of the heading, above zero"
    annotation(Placement(transformation(extent={{-10,-10},{10,10}}, rotation=90,
    origin={-60,-120})));
  Modelica.Blocks.Interfaces.BooleanInput headingValid if useHeading
    "Use the heading of this sample"
    annotation(Placement(transformation(extent={{-10,-10},{10,10}}, rotation=90,
    origin={-40,-120})));
  Modelica.Blocks.Interfaces.RealInput headingAge(unit="s") if useHeading
    "Time since the heading was true, counted in whole samples"
    annotation(Placement(transformation(extent={{-10,-10},{10,10}}, rotation=90,
    origin={-20,-120})));
  Modelica.Blocks.Interfaces.BooleanInput stationary if useStationary
    "The body does not turn against the Earth"
    annotation(Placement(transformation(extent={{-10,-10},{10,10}}, rotation=90,
    origin={0,-120})));
  Modelica.Blocks.Interfaces.RealInput speed(unit="m/s") if useSpeed
    "Speed over the ground along the body's x axis, backwards below zero"
    annotation(Placement(transformation(extent={{-10,-10},{10,10}}, rotation=90,
    origin={20,-120})));
  Modelica.Blocks.Interfaces.RealInput speedVariance(unit="m2/s2") if useSpeed
    "Variance of the speed" annotation(Placement(transformation(extent={{-10,-10},{10,10}},
    rotation=90, origin={40,-120})));
  Modelica.Blocks.Interfaces.BooleanInput speedValid if useSpeed "Use the speed of this sample"
    annotation(Placement(transformation(extent={{-10,-10},{10,10}}, rotation=90,
    origin={60,-120})));
  Modelica.Blocks.Interfaces.RealInput mag[3](each unit="T") if useMagnetometer
    "Measured magnetic flux density, body axes; zeros or NaN: none"
    annotation(Placement(transformation(extent={{-10,-10},{10,10}}, rotation=90,
    origin={80,-120})));
  Modelica.Blocks.Interfaces.RealOutput q[4](each unit="1")
    "Attitude, body to world (east-north-up), Hamilton, scalar first"
    annotation(Placement(transformation(extent={{100,77},{112,89}})));
  Modelica.Blocks.Interfaces.RealOutput roll(unit="rad") "Roll"
    annotation(Placement(transformation(extent={{100,61},{112,73}})));
  Modelica.Blocks.Interfaces.RealOutput pitch(unit="rad") "Pitch, nose up is negative"
    annotation(Placement(transformation(extent={{100,44},{112,56}})));
  Modelica.Blocks.Interfaces.RealOutput yaw(unit="rad") "Yaw, counter-clockwise from east"
    annotation(Placement(transformation(extent={{100,27},{112,39}})));
  Modelica.Blocks.Interfaces.RealOutput gyroBias[3](each unit="rad/s")
    "Bias of the compensated rate"
    annotation(Placement(transformation(extent={{100,11},{112,23}})));
  Modelica.Blocks.Interfaces.RealOutput std[6](unit={"rad", "rad", "rad", "rad/s", "rad/s",
    "rad/s"}) "Standard deviation of the attitude error, body axes"
    annotation(Placement(transformation(extent={{100,-6},{112,6}})));
  Modelica.Blocks.Interfaces.BooleanOutput quasiStatic
    "The accelerometer is used as an inclinometer"
    annotation(Placement(transformation(extent={{100,-23},{112,-11}})));
  Modelica.Blocks.Interfaces.RealOutput nis(unit="1")
    "Normalised innovation squared of this sample's quasi-static update, 0 without one"
    annotation(Placement(transformation(extent={{100,-39},{112,-27}})));
  Modelica.Blocks.Interfaces.IntegerOutput status
    "What happened, as a sum of the numbers in the documentation"
    annotation(Placement(transformation(extent={{100,-56},{112,-44}})));
  Modelica.Blocks.Interfaces.RealOutput headingStd(unit="rad")
    "Standard deviation of the attitude error about the vertical, however the body is tilted"
    annotation(Placement(transformation(extent={{100,-73},{112,-61}})));
  Modelica.Blocks.Interfaces.BooleanOutput atRest
    "The body does not move, as the input or the run says"
    annotation(Placement(transformation(extent={{100,-89},{112,-77}})));
protected
  Modelica.Blocks.Interfaces.RealInput headingUsed;
  Modelica.Blocks.Interfaces.RealInput headingVarianceUsed;
  Modelica.Blocks.Interfaces.BooleanInput headingValidUsed;
  Modelica.Blocks.Interfaces.RealInput headingAgeUsed;
  Modelica.Blocks.Interfaces.BooleanInput stationaryUsed;
  Modelica.Blocks.Interfaces.RealInput speedUsed;
  Modelica.Blocks.Interfaces.RealInput speedVarianceUsed;
  Modelica.Blocks.Interfaces.BooleanInput speedValidUsed;
  Modelica.Blocks.Interfaces.RealInput magUsed[3];
  final parameter Real p[65] = {latitude, q0[1], q0[2], q0[3], q0[4], bias0[1], bias0[2],
    bias0[3], std0[1], std0[2], std0[3], std0[4], std0[5], std0[6], gravity, accelStd,
    accelBiasStd, accelCorrelationTime, gravityWalk, gravityTolerance, motionTolerance,
    steadyTolerance, motionTime, pushStd, motionShare, rateNoise, scaleStd, axesStd, biasNoise,
    biasDrift, motionBias, stationaryStd, restTime, restRateTolerance, restForceTolerance,
    slipStd, speedTolerance, lostRateStd, stuckTime, axisStuckTime[1], axisStuckTime[2],
    axisStuckTime[3], axisStuckTime[4], axisStuckTime[5], axisStuckTime[6], headingMemory,
    declination, fieldStrength, fieldDip, fieldStrengthStd, fieldStd, fieldTime,
    fieldTurningStd, fieldNoise, fieldTolerance, gyroThermalBias_kT[1], gyroThermalBias_kT[2],
    gyroThermalBias_kT[3], gyroThermalBias_T0, gyroAngleRandomWalk_N[1],
    gyroAngleRandomWalk_N[2], gyroAngleRandomWalk_N[3], gyroRateRandomWalk_K[1],
    gyroRateRandomWalk_K[2], gyroRateRandomWalk_K[3]} "In the order of the co-simulation unit";
  AttitudeUkfMemory memory = AttitudeUkfMemory(samplePeriod, p);
  discrete Real k(start=0, fixed=true) "Number of the sample; 0 is the start";
  Real u[18] "Inputs, in the order of the co-simulation unit";
  discrete Real shown[21] "Outputs, in that order";
initial equation
  shown = attitudeUkfSample(memory, 0, fill(0, 18));
equation
  assert(min(q0) >= -1000000.0, "AttitudeUkf: q0 must not be below -1e+06");
  assert(max(q0) <= 1000000.0, "AttitudeUkf: q0 must not be above 1e+06");
  assert(min(bias0) >= -100, "AttitudeUkf: bias0 must not be below -100");
  assert(max(bias0) <= 100, "AttitudeUkf: bias0 must not be above 100");
  assert(min(std0) >= 0, "AttitudeUkf: std0 must not be below 0");
  assert(max(std0) <= 1000000.0, "AttitudeUkf: std0 must not be above 1e+06");
  assert(gravity >= 0, "AttitudeUkf: gravity must not be below 0");
  assert(accelStd >= 0, "AttitudeUkf: accelStd must not be below 0");
  assert(accelBiasStd >= 0, "AttitudeUkf: accelBiasStd must not be below 0");
  assert(accelCorrelationTime >= 0, "AttitudeUkf: accelCorrelationTime must not be below 0");
  assert(gravityWalk >= 0, "AttitudeUkf: gravityWalk must not be below 0");
  assert(gravityTolerance >= 0, "AttitudeUkf: gravityTolerance must not be below 0");
  assert(motionTolerance >= 0, "AttitudeUkf: motionTolerance must not be below 0");
  assert(steadyTolerance >= 0, "AttitudeUkf: steadyTolerance must not be below 0");
  assert(motionTime >= 0, "AttitudeUkf: motionTime must not be below 0");
  assert(pushStd >= 0, "AttitudeUkf: pushStd must not be below 0");
  assert(motionShare >= 0, "AttitudeUkf: motionShare must not be below 0");
  assert(motionShare <= 1, "AttitudeUkf: motionShare must not be above 1");
  assert(rateNoise >= 0, "AttitudeUkf: rateNoise must not be below 0");
  assert(scaleStd >= 0, "AttitudeUkf: scaleStd must not be below 0");
  assert(axesStd >= 0, "AttitudeUkf: axesStd must not be below 0");
  assert(biasNoise >= 0, "AttitudeUkf: biasNoise must not be below 0");
  assert(biasDrift >= 0, "AttitudeUkf: biasDrift must not be below 0");
  assert(motionBias >= 0, "AttitudeUkf: motionBias must not be below 0");
  assert(stationaryStd >= 0, "AttitudeUkf: stationaryStd must not be below 0");
  assert(restTime >= 0, "AttitudeUkf: restTime must not be below 0");
  assert(restRateTolerance >= 0, "AttitudeUkf: restRateTolerance must not be below 0");
  assert(restForceTolerance >= 0, "AttitudeUkf: restForceTolerance must not be below 0");
  assert(slipStd >= 0, "AttitudeUkf: slipStd must not be below 0");
  assert(speedTolerance >= 0, "AttitudeUkf: speedTolerance must not be below 0");
  assert(lostRateStd >= 0, "AttitudeUkf: lostRateStd must not be below 0");
  assert(stuckTime >= 0, "AttitudeUkf: stuckTime must not be below 0");
  assert(min(axisStuckTime) >= 0, "AttitudeUkf: axisStuckTime must not be below 0");
  assert(max(axisStuckTime) <= 1000000.0, "AttitudeUkf: axisStuckTime must not be above 1e+06");
  assert(headingMemory >= 0, "AttitudeUkf: headingMemory must not be below 0");
  assert(declination >= -3.141592653589793,
    "AttitudeUkf: declination must not be below -3.14159");
  assert(declination <= 3.141592653589793,
    "AttitudeUkf: declination must not be above 3.14159");
  assert(fieldStrength >= 0, "AttitudeUkf: fieldStrength must not be below 0");
  assert(fieldDip >= -1.5707963267948966, "AttitudeUkf: fieldDip must not be below -1.5708");
  assert(fieldDip <= 1.5707963267948966, "AttitudeUkf: fieldDip must not be above 1.5708");
  assert(fieldStrengthStd >= 0, "AttitudeUkf: fieldStrengthStd must not be below 0");
  assert(fieldStd >= 0, "AttitudeUkf: fieldStd must not be below 0");
  assert(fieldTime >= 0, "AttitudeUkf: fieldTime must not be below 0");
  assert(fieldTurningStd >= 0, "AttitudeUkf: fieldTurningStd must not be below 0");
  assert(fieldNoise >= 0, "AttitudeUkf: fieldNoise must not be below 0");
  assert(fieldTolerance >= 0, "AttitudeUkf: fieldTolerance must not be below 0");
  assert(min(gyroAngleRandomWalk_N) >= 0,
    "AttitudeUkf: gyroAngleRandomWalk_N must not be below 0");
  assert(min(gyroRateRandomWalk_K) >= 0,
    "AttitudeUkf: gyroRateRandomWalk_K must not be below 0");
  connect(heading, headingUsed);
  if not useHeading then
    headingUsed = 0;
  end if;
  connect(headingVariance, headingVarianceUsed);
  if not useHeading then
    headingVarianceUsed = 0;
  end if;
  connect(headingValid, headingValidUsed);
  if not useHeading then
    headingValidUsed = false;
  end if;
  connect(headingAge, headingAgeUsed);
  if not useHeading then
    headingAgeUsed = 0;
  end if;
  connect(stationary, stationaryUsed);
  if not useStationary then
    stationaryUsed = false;
  end if;
  connect(speed, speedUsed);
  if not useSpeed then
    speedUsed = 0;
  end if;
  connect(speedVariance, speedVarianceUsed);
  if not useSpeed then
    speedVarianceUsed = 0;
  end if;
  connect(speedValid, speedValidUsed);
  if not useSpeed then
    speedValidUsed = false;
  end if;
  connect(mag, magUsed);
  if not useMagnetometer then
    magUsed = {0, 0, 0};
  end if;
  u = {gyro[1], gyro[2], gyro[3], accel[1], accel[2], accel[3], temperature, headingUsed,
    headingVarianceUsed, if headingValidUsed then 1 else 0, headingAgeUsed, if stationaryUsed
    then 1 else 0, speedUsed, speedVarianceUsed, if speedValidUsed then 1 else 0, magUsed[1],
    magUsed[2], magUsed[3]};
  when sample(samplePeriod, samplePeriod) then
    k = pre(k) + 1;
    shown = attitudeUkfSample(memory, k, u);
  end when;
  q = {shown[1], shown[2], shown[3], shown[4]};
  roll = shown[5];
  pitch = shown[6];
  yaw = shown[7];
  gyroBias = {shown[8], shown[9], shown[10]};
  std = {shown[11], shown[12], shown[13], shown[14], shown[15], shown[16]};
  quasiStatic = shown[17] > 0.5;
  nis = shown[18];
  status = integer(shown[19] + 0.5);
  headingStd = shown[20];
  atRest = shown[21] > 0.5;
  annotation(Icon(graphics={
      Rectangle(extent={{-94,94},{94,-94}}, lineColor={255,255,255}, fillColor={255,255,255},
        fillPattern=FillPattern.Solid),
      Text(extent={{-90,50},{90,-10}}, textString="UKF", textColor={0,0,127}),
      Text(extent={{-90,-20},{90,-70}}, textString="attitude", textColor={128,128,128})}),
    Documentation(info="<html>
<p>Unscented attitude filter of the part imt30: the C of the co-simulation unit AttitudeUkf, whose
samples it gives. It needs a tool that calls external C, and its compiler; where there is none,
import the unit.</p>
<p>Sample k is made at the time k samplePeriod; before the first one the outputs are those of the
start. Inputs that a model does not have stay switched off. Sources: Hidalgo 2012, sections 4 and 5;
Crassidis and Markley 2003; Groves 2013, section 15.3; what differs from them, the guide of the unit
says.</p>
<table>
<tr><td>headingAge</td><td>Time since the heading was true, counted in whole samples; at most
headingMemory. An age of some tenths of a second takes no heading more precise than about 1e-3 rad
many times a second: what is left out then adds up, and std is too small.</td></tr>
<tr><td>accelStd</td><td>Standard deviation of the acceleration that a body has beside its bounded
velocity, and beside the pushes that the run shows; 0: the body never accelerates. The errors of a
real accelerometer in motion are such an acceleration: a run over a log takes 0.01 m/s^2 where
rateNoise is not 0.</td></tr>
<tr><td>accelBiasStd</td><td>Standard deviation of a component of the accelerometer's constant
error, which tilts the attitude by its share of gravity: std has that, no matter how long it is
averaged, and what the size of gravity at rest says of it.</td></tr>
<tr><td>gravityTolerance</td><td>Quasi-static: largest difference of the estimated magnitude and of
gravity as it was measured at rest; beyond, that is called another than gravity.</td></tr>
<tr><td>motionTime</td><td>Correlation time of the velocity of a body that stays in its place. How
large that is the run finds out, over eight times this time.</td></tr>
<tr><td>pushStd</td><td>Standard deviation of an axis of pushes that last, as of a vehicle or an
aircraft that is on its way before the first sample, until the run shows how large they are; its
velocity then is that of so large a push over 6 s. A log that begins in motion shows it.</td></tr>
<tr><td>motionShare</td><td>Least share that the density of that velocity has at low frequency of
one of that correlation time, as far as the run shows less. The errors of a real accelerometer in
motion look like a slow velocity: a run over a log takes 1, which does not ask the run, where
rateNoise is not 0.</td></tr>
<tr><td>scaleStd</td><td>Standard deviation of the scale factor of each of the gyro's axes, of which
the run learns nothing: std has what that makes of a turn that goes on, and of the bias; gravity
corrects the tilt that much sooner, and heading and bias are estimated the same.</td></tr>
<tr><td>axesStd</td><td>Standard deviation of the angle, about each axis, between the vertical of
the accelerometer and the axis about which the gyro says that a body turns whose speed is given: a
bias of the accelerometer, axes of either. It turns with the body, and nothing is learnt of
it.</td></tr>
<tr><td>biasNoise</td><td>Root density of the walk of the bias over the rate: a gyro that feels
forces has another bias when it has turned over.</td></tr>
<tr><td>biasDrift</td><td>Root density of the walk of the bias beyond that of the part, as of a gyro
that warms up, until rests show how large it is. A log with several rests tells it from the
start.</td></tr>
<tr><td>motionBias</td><td>Standard deviation by which the bias of the gyro is another while the
body turns fast, by 0.5 rad/s and more over 10 s, than at rest; its share of that where it turns
less. As much again it changes in 100 s of motion. What the model of a gyro lacks shows in
motion.</td></tr>
<tr><td>restTime</td><td>A body of which no sample differs from the others for so long is at rest,
or for 2.5 s where its bias about the vertical is not known to 2e-3 rad/s; 0: never.</td></tr>
<tr><td>speedTolerance</td><td>Standard deviation of the share by which the accelerations of a body
whose speed is given are others than the speed says: size of the wheels, scale factors.</td></tr>
<tr><td>axisStuckTime</td><td>Equal samples of an axis (gyro, then accelerometer) for so long, while
the others of its triad change, mean that it is stuck; 0: never.</td></tr>
<tr><td>fieldStrengthStd</td><td>Standard deviation of the horizontal and of the vertical part of
that field; what the samples show is weighed against it.</td></tr>
<tr><td>fieldStd</td><td>Standard deviation of what the place's field has across its horizontal
direction: the error of the declination, and the surroundings.</td></tr>
<tr><td>fieldTurningStd</td><td>Standard deviation of a component of what differs from one attitude
of the body to another, as the magnetometer's bias does, before the run itself shows it; 0: nothing
does.</td></tr>
<tr><td>fieldTolerance</td><td>Share of the field's strength by which strength or dip may differ
from what the run has learnt of them; 0: no magnetometer is used.</td></tr>
<tr><td>nis</td><td>Normalised innovation squared of this sample's quasi-static update, 0 without
one; chi-squared of 3 degrees of freedom, white where accelStd is 0, else correlated over
accelCorrelationTime and less on a body that accelerates less than accelStd.</td></tr>
<tr><td>status</td><td>1: an input was not finite or absurd and its last good value was held, or a
heading's variance was not above zero; 2: a sample was at a sensor's limit, or said of more than
half a turn in a sample period; 4: a sensor or an axis is stuck, its samples have not changed for
its stuck time; 8: gravity contradicted the attitude, and was weighed less; 16: a heading was older
than headingMemory, or than the run, and not used; 32: a heading was not used, as the tilt was
contradicted or not known, or as more is known already than when it was true; 64: a heading
contradicted the attitude, and was weighed less; 128: a variance was not above zero, and its std is
shown as 0; 256: the magnetic field was not the place's in strength or dip, and not used, or its
direction contradicted the heading; 512: the force has not had the size of gravity for 10 s, or has
another one at rest than gravityTolerance allows: it is taken as it is found, and std has what that
means for the tilt.</td></tr>
</table>
</html>"));
end AttitudeUkf;
