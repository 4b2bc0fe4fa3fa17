// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Mpu9250 "InvenSense MPU-9250, consumer nine-axis IMU, gyro and accelerometer"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of mpu9250"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.Lag.Gyro lag(samplePeriod=samplePeriod, y0=y0, wn=578.05305,
      zeta=0.7071067811865476)
      "Bandwidth, second-order lag; wn: 92 Hz (-3 dB), taken as 2 pi f of a second-order Butterworth low-pass, MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, table 1, page 8, DLPFCFG = 2";
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0001234134149488435, 0.0001234134149488435, 0.0001234134149488435})
      "Angle (velocity) random walk; N: 0.01 deg/s/sqrt(Hz) rate noise spectral density, MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, table 1, page 8";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={4.363323129985824, 4.363323129985824, 4.363323129985824})
      "Input range, saturation; limit: MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, table 1, page 8, FS_SEL = 0";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00013323124061025415, 0.00013323124061025415, 0.00013323124061025415})
      "Resolution, quantization; q: 131 LSB/(deg/s), MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, table 1, page 8, FS_SEL = 0";
  equation
    connect(rate, lag.x);
    connect(lag.y, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of mpu9250"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.Lag.Accel lag(samplePeriod=samplePeriod, y0=y0, wn=590.61942,
      zeta=0.7071067811865476)
      "Bandwidth, second-order lag; wn: 94 Hz (-3 dB), taken as 2 pi f of a second-order Butterworth low-pass, MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, table 2, page 9, DLPFCFG = 2";
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0020803046147169165, 0.0020803046147169165, 0.0020803046147169165})
      "Angle (velocity) random walk; N: 300 ug/sqrt(Hz) noise power spectral density, MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, table 2, page 9";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={19.6133,
      19.6133, 19.6133})
      "Input range, saturation; limit: MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, table 2, page 9, AFS_SEL = 0";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0005985504150390625, 0.0005985504150390625, 0.0005985504150390625})
      "Resolution, quantization; q: 16384 LSB/g, MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, table 2, page 9, AFS_SEL = 0";
  equation
    connect(specificForce, lag.x);
    connect(lag.y, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "InvenSense MPU-9250, consumer nine-axis IMU, gyro and accelerometer"
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
<p>InvenSense MPU-9250, consumer nine-axis IMU, gyro and accelerometer.</p>
<p>Sampled at 1000 Hz (MPU-9250 product specification PS-MPU-9250A-01 rev. 1.0, tables 1 and 2,
pages 8 and 9, in the programmable range of both (4 to 4000 Hz)). Coefficients are in SI units;
their sources stand behind the blocks that have them.</p>
</html>"));
end Mpu9250;
