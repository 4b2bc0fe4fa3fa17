// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Mti3 "Movella (Xsens) MTi-3, attitude and heading reference module, inertial sensors only"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of mti3"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.Lag.Gyro lag(samplePeriod=samplePeriod, y0=y0, wn=1602.2123,
      zeta=0.7071067811865476)
      "Bandwidth, second-order lag; wn: 255 Hz (-3 dB), taken as 2 pi f of a second-order Butterworth low-pass, MTi 1-series data sheet, table of sensor specifications, second-hand (article 10.2478/tar-2023-0022, table of the MTi-1's sensors, which the series shares)";
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={8.638939046419044e-05, 8.638939046419044e-05, 8.638939046419044e-05})
      "Angle (velocity) random walk; N: 0.007 deg/s/sqrt(Hz) noise density, MTi 1-series data sheet, table of sensor specifications, second-hand (article 10.2478/tar-2023-0022, table of the MTi-1's sensors, which the series shares)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.BiasInstability.Gyro biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={7.296445900698517e-05, 7.296445900698517e-05, 7.296445900698517e-05}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 10 deg/h in-run bias stability, taken as the floor 0.664 B of the Allan deviation, MTi 1-series data sheet, table of sensor specifications, second-hand (article 10.2478/tar-2023-0022, table of the MTi-1's sensors, which the series shares)";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3196001024, 2505197763, 2353625474, 3272142661, 3658735108, 4047408583, 3894787206,
      1874698313, 1990627592, 389392437, 237934964, 621005495, 1008270326, 1935240497, 1782733936,
      1097797555, 1484013298, 3756794429});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={34.90658503988659, 34.90658503988659, 34.90658503988659})
      "Input range, saturation; limit: MTi 1-series data sheet, table of sensor specifications, second-hand (article 10.2478/tar-2023-0022, table of the MTi-1's sensors, which the series shares)";
  equation
    connect(rate, lag.x);
    connect(lag.y, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of mti3"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.Lag.Accel lag(samplePeriod=samplePeriod, y0=y0, wn=2035.752,
      zeta=0.7071067811865476)
      "Bandwidth, second-order lag; wn: 324 Hz (-3 dB) along x and y, taken as 2 pi f of a second-order Butterworth low-pass, MTi 1-series data sheet, table of sensor specifications, second-hand (article 10.2478/tar-2023-0022, table of the MTi-1's sensors, which the series shares)";
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0008321218458867665, 0.0008321218458867665, 0.0008321218458867665})
      "Angle (velocity) random walk; N: 120 ug/sqrt(Hz) noise density, MTi 1-series data sheet, table of sensor specifications, second-hand (article 10.2478/tar-2023-0022, table of the MTi-1's sensors, which the series shares)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.BiasInstability.Accel biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={0.0004428683139999999, 0.0004428683139999999, 0.0004428683139999999}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 30 ug in-run bias stability, taken as the floor 0.664 B of the Allan deviation, MTi 1-series data sheet, table of sensor specifications, second-hand (article 10.2478/tar-2023-0022, table of the MTi-1's sensors, which the series shares)";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3339721210, 3963439673, 4112939896, 3127373247, 2742869246, 2287046461, 2437594748,
      382902963, 264868850, 1243929653, 1396698484, 2014494391, 1628016630, 776476977, 928196720,
      478051251, 90524402, 2197640765});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={156.9064,
      156.9064, 156.9064})
      "Input range, saturation; limit: MTi 1-series data sheet, table of sensor specifications, second-hand (article 10.2478/tar-2023-0022, table of the MTi-1's sensors, which the series shares)";
  equation
    connect(specificForce, lag.x);
    connect(lag.y, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, y);
  end Accelerometer;

  block Imu "Movella (Xsens) MTi-3, attitude and heading reference module, inertial sensors only"
    extends PyImu.Interfaces.Imu(samplePeriod=0.001);
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
<p>Movella (Xsens) MTi-3, attitude and heading reference module, inertial sensors only.</p>
<p>Sampled at 1000 Hz (MTi 1-series data sheet, internal sample rate, unchecked; chosen to carry its
bandwidth). Coefficients are in SI units; their sources stand behind the blocks that have them.</p>
</html>"));
end Mti3;
