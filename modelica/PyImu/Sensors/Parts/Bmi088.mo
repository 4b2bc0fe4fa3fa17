// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Bmi088 "Bosch Sensortec BMI088, six-axis IMU for drones"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of bmi088"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0025);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.Lag.Gyro lag(samplePeriod=samplePeriod, y0=y0, wn=295.30971,
      zeta=0.7071067811865476)
      "Bandwidth, second-order lag; wn: 47 Hz (-3 dB), taken as 2 pi f of a second-order Butterworth low-pass, BMI088 data sheet BST-BMI088-DS000-19 rev. 1.9, table 5, second-hand";
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.00017277878092838089, 0.00017277878092838089, 0.00017277878092838089})
      "Angle (velocity) random walk; N: 0.014 deg/s/sqrt(Hz) at 47 Hz bandwidth, output noise, BMI088 data sheet BST-BMI088-DS000-19 rev. 1.9, table 5, second-hand";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.BiasInstability.Gyro biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={4.7460350498536915e-05, 4.7460350498536915e-05, 4.7460350498536915e-05}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 6.5 deg/h bias stability, taken as the floor 0.664 B of the Allan deviation, jpieper.com, page on the Allan variance of one BMI088, logged overnight at 1 kHz, second-hand";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3196001024, 2505197763, 2353625474, 3272142661, 3658735108, 4047408583, 3894787206,
      1874698313, 1990627592, 389392437, 237934964, 621005495, 1008270326, 1935240497, 1782733936,
      1097797555, 1484013298, 3756794429});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={34.90658503988659, 34.90658503988659, 34.90658503988659})
      "Input range, saturation; limit: BMI088 data sheet BST-BMI088-DS001-13 rev. 1.3, section 5.5.2, page 27";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0010652644360316954, 0.0010652644360316954, 0.0010652644360316954})
      "Resolution, quantization; q: 16.384 LSB/(deg/s), BMI088 data sheet BST-BMI088-DS001-13 rev. 1.3, section 5.5.2, page 27";
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

  block Accelerometer "Accelerometer of bmi088"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0025);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0011094957945156888, 0.0011094957945156888, 0.0013175262559873805})
      "Angle (velocity) random walk; N: [160, 160, 190] ug/sqrt(Hz) output noise density, BMI088 data sheet BST-BMI088-DS000-19 rev. 1.9, table 4, second-hand";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={58.8399,
      58.8399, 58.8399})
      "Input range, saturation; limit: BMI088 data sheet BST-BMI088-DS000-19 rev. 1.9, page 8, second-hand";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0017960897435897434, 0.0017960897435897434, 0.0017960897435897434})
      "Resolution, quantization; q: 5460 LSB/g, BMI088 data sheet BST-BMI088-DS000-19 rev. 1.9, page 8, second-hand";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "Bosch Sensortec BMI088, six-axis IMU for drones"
    extends PyImu.Interfaces.Imu(samplePeriod=0.0025);
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
<p>Bosch Sensortec BMI088, six-axis IMU for drones.</p>
<p>Sampled at 400 Hz (BMI088 data sheet BST-BMI088-DS000-19 rev. 1.9, register GYRO_BANDWIDTH,
output data rate of the 47 Hz filter, second-hand). Coefficients are in SI units; their sources
stand behind the blocks that have them.</p>
</html>"));
end Bmi088;
