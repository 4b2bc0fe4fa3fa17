// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Bmi160 "Bosch Sensortec BMI160, low-power six-axis IMU"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of bmi160"
    extends PyImu.Interfaces.Triad(samplePeriod=0.01);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={9.87307319590748e-05, 9.87307319590748e-05, 9.87307319590748e-05})
      "Angle (velocity) random walk; N: 0.008 deg/s/sqrt(Hz) noise density, BMI160 data sheet BST-BMI160-DS000, table of the gyro, second-hand (comparison table of BMI160, BMI055, ICM-20602 and ICM-42688, blog.csdn.net 103731233)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={34.90658503988659, 34.90658503988659, 34.90658503988659})
      "Input range, saturation; limit: BMI160 data sheet BST-BMI160-DS000, table of the gyro, second-hand (comparison table of BMI160, BMI055, ICM-20602 and ICM-42688, blog.csdn.net 103731233)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0010642251536550791, 0.0010642251536550791, 0.0010642251536550791})
      "Resolution, quantization; q: 16.4 LSB/(deg/s), BMI160 data sheet BST-BMI160-DS000, register GYR_RANGE, second-hand (community.bosch-sensortec.com, BMI160 converting data with resolution: 2^15 counts over the range)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of bmi160"
    extends PyImu.Interfaces.Triad(samplePeriod=0.01);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0010401523073584583, 0.0010401523073584583, 0.0010401523073584583})
      "Angle (velocity) random walk; N: 150 ug/sqrt(Hz) noise density, BMI160 data sheet BST-BMI160-DS000, table of the accelerometer, second-hand (comparison table of BMI160, BMI055, ICM-20602 and ICM-42688, blog.csdn.net 103731233)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={19.6133,
      19.6133, 19.6133})
      "Input range, saturation; limit: BMI160 data sheet BST-BMI160-DS000, register ACC_RANGE, reset state, second-hand (topic.alibabacloud.com, notes on commissioning a BMI160, default configuration)";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0005985504150390625, 0.0005985504150390625, 0.0005985504150390625})
      "Resolution, quantization; q: 16384 LSB/g, BMI160 data sheet BST-BMI160-DS000, register ACC_RANGE, second-hand (community.bosch-sensortec.com, BMI160 converting data with resolution: 2^15 counts over the range)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "Bosch Sensortec BMI160, low-power six-axis IMU"
    extends PyImu.Interfaces.Imu(samplePeriod=0.01);
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
<p>Bosch Sensortec BMI160, low-power six-axis IMU.</p>
<p>Sampled at 100 Hz (BMI160 data sheet BST-BMI160-DS000, register GYR_CONF, reset state 100 Hz,
second-hand (topic.alibabacloud.com, notes on commissioning a BMI160, default configuration)).
Coefficients are in SI units; their sources stand behind the blocks that have them.</p>
</html>"));
end Bmi160;
