// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Mpu6050 "InvenSense MPU-6050, consumer six-axis IMU"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of mpu6050"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.Lag.Gyro lag(samplePeriod=samplePeriod, y0=y0, wn=628.31853,
      zeta=0.7071067811865476)
      "Bandwidth, second-order lag; wn: 100 Hz (-3 dB), taken as 2 pi f of a second-order Butterworth low-pass, MPU-6000/MPU-6050 product specification PS-MPU-6000A-00 rev. 3.4, section 6.1, page 12, DLPF_CFG = 2";
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={6.170670747442175e-05, 6.170670747442175e-05, 6.170670747442175e-05})
      "Angle (velocity) random walk; N: 0.005 deg/s/sqrt(Hz) at 10 Hz, rate noise spectral density, MPU-6000/MPU-6050 product specification PS-MPU-6000A-00 rev. 3.4, section 6.1, page 12";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.BiasInstability.Gyro biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={3.154391734771085e-05, 3.154391734771085e-05, 3.154391734771085e-05}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 0.0012 deg/s bias instability, taken as the floor 0.664 B of the Allan deviation, Robotics Stack Exchange, question 8860, table of values: Allan deviation of one MPU-6050 at 500 Hz, second-hand";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3196001024, 2505197763, 2353625474, 3272142661, 3658735108, 4047408583, 3894787206,
      1874698313, 1990627592, 389392437, 237934964, 621005495, 1008270326, 1935240497, 1782733936,
      1097797555, 1484013298, 3756794429});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={4.363323129985824, 4.363323129985824, 4.363323129985824})
      "Input range, saturation; limit: MPU-6000/MPU-6050 product specification PS-MPU-6000A-00 rev. 3.4, section 6.1, page 12, FS_SEL = 0";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00013323124061025415, 0.00013323124061025415, 0.00013323124061025415})
      "Resolution, quantization; q: 131 LSB/(deg/s), MPU-6000/MPU-6050 product specification PS-MPU-6000A-00 rev. 3.4, section 6.1, page 12, FS_SEL = 0";
  equation
    connect(rate, lag.x);
    connect(lag.y, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of mpu6050"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.Lag.Accel lag(samplePeriod=samplePeriod, y0=y0, wn=590.61942,
      zeta=0.7071067811865476)
      "Bandwidth, second-order lag; wn: 94 Hz (-3 dB), taken as 2 pi f of a second-order Butterworth low-pass, MPU-6000/MPU-6050 register map RM-MPU-6000A-00, register 26, DLPF_CFG = 2, as copied into public drivers, second-hand";
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.002773739486289222, 0.002773739486289222, 0.002773739486289222})
      "Angle (velocity) random walk; N: 400 ug/sqrt(Hz) at 10 Hz, power spectral density, MPU-6000/MPU-6050 product specification PS-MPU-6000A-00 rev. 3.4, section 6.2, page 13";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.BiasInstability.Accel biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={0.0005317165629999999, 0.0005317165629999999, 0.0005317165629999999}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 36 ug bias stability, taken as the floor 0.664 B of the Allan deviation, AirSim, ImuSimpleParams.hpp, parameters of an MPU-6000, at 800 s, after a thesis of D. R. Greenheck, section 2.2, page 17, second-hand";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3339721210, 3963439673, 4112939896, 3127373247, 2742869246, 2287046461, 2437594748,
      382902963, 264868850, 1243929653, 1396698484, 2014494391, 1628016630, 776476977, 928196720,
      478051251, 90524402, 2197640765});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={19.6133,
      19.6133, 19.6133})
      "Input range, saturation; limit: MPU-6000/MPU-6050 product specification PS-MPU-6000A-00 rev. 3.4, section 6.2, page 13, AFS_SEL = 0";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0005985504150390625, 0.0005985504150390625, 0.0005985504150390625})
      "Resolution, quantization; q: 16384 LSB/g, MPU-6000/MPU-6050 product specification PS-MPU-6000A-00 rev. 3.4, section 6.2, page 13, AFS_SEL = 0";
  equation
    connect(specificForce, lag.x);
    connect(lag.y, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "InvenSense MPU-6050, consumer six-axis IMU"
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
<p>InvenSense MPU-6050, consumer six-axis IMU.</p>
<p>Sampled at 1000 Hz (MPU-6000/MPU-6050 product specification PS-MPU-6000A-00 rev. 3.4, section
6.2, page 13, output data rate at which the noise is stated). Coefficients are in SI units; their
sources stand behind the blocks that have them.</p>
</html>"));
end Mpu6050;
