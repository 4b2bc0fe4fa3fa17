// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Vn100 "VectorNav VN-100, attitude and heading reference system, inertial sensors only"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of vn100"
    extends PyImu.Interfaces.Triad(samplePeriod=0.00125);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={4.319469523209522e-05, 4.319469523209522e-05, 4.319469523209522e-05})
      "Angle (velocity) random walk; N: 0.0035 deg/s/sqrt(Hz) noise density, VN-100 data sheet, specifications, second-hand (comments of a Kalibr configuration that quotes the data sheet)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.BiasInstability.Gyro biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={7.296445900698517e-05, 7.296445900698517e-05, 7.296445900698517e-05}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 10 deg/h in-run bias stability, taken as the floor 0.664 B of the Allan deviation, VN-100 data sheet, specifications, second-hand (NitinJSanket/RoboticsHardware, IMUs)";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3196001024, 2505197763, 2353625474, 3272142661, 3658735108, 4047408583, 3894787206,
      1874698313, 1990627592, 389392437, 237934964, 621005495, 1008270326, 1935240497, 1782733936,
      1097797555, 1484013298, 3756794429});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={34.90658503988659, 34.90658503988659, 34.90658503988659})
      "Input range, saturation; limit: VN-100 data sheet, specifications, second-hand (NitinJSanket/RoboticsHardware, IMUs)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of vn100"
    extends PyImu.Interfaces.Triad(samplePeriod=0.00125);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0009708088202012277, 0.0009708088202012277, 0.0009708088202012277})
      "Angle (velocity) random walk; N: 140 ug/sqrt(Hz) noise density, VN-100 data sheet, specifications, second-hand (comments of a Kalibr configuration that quotes the data sheet)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.BiasInstability.Accel biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={0.0005905564629999999, 0.0005905564629999999, 0.0005905564629999999}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 40 ug in-run bias stability, taken as the floor 0.664 B of the Allan deviation, VN-100 data sheet, specifications, second-hand (NitinJSanket/RoboticsHardware, IMUs)";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3339721210, 3963439673, 4112939896, 3127373247, 2742869246, 2287046461, 2437594748,
      382902963, 264868850, 1243929653, 1396698484, 2014494391, 1628016630, 776476977, 928196720,
      478051251, 90524402, 2197640765});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={156.9064,
      156.9064, 156.9064})
      "Input range, saturation; limit: VN-100 data sheet, specifications, second-hand (NitinJSanket/RoboticsHardware, IMUs)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, y);
  end Accelerometer;

  block Imu "VectorNav VN-100, attitude and heading reference system, inertial sensors only"
    extends PyImu.Interfaces.Imu(samplePeriod=0.00125);
    Gyroscope gyroscope(samplePeriod=samplePeriod, seed=seed)
      annotation(Placement(transformation(extent={{-20,30},{20,70}})));
    Accelerometer accelerometer(samplePeriod=samplePeriod, seed=seed)
      annotation(Placement(transformation(extent={{-20,-70},{20,-30}})));
  equation
    connect(rate, gyroscope.rate);
    connect(specificForce, gyroscope.specificForce);
    connect(temperature, gyroscope.temperature);
    connect(gyroscope.y, gyro);
    connect(rate, accelerometer.rate);
    connect(specificForce, accelerometer.specificForce);
    connect(temperature, accelerometer.temperature);
    connect(accelerometer.y, accel);
    when sample(samplePeriod, samplePeriod) then
      measuredTemperature = temperature;
    end when;
  end Imu;

  annotation(Documentation(info="<html>
<p>VectorNav VN-100, attitude and heading reference system, inertial sensors only.</p>
<p>Sampled at 800 Hz (VN-100 data sheet, specifications, rate of the inertial data, second-hand
(NitinJSanket/RoboticsHardware, IMUs)). Coefficients are in SI units; their sources stand behind the
blocks that have them.</p>
</html>"));
end Vn100;
