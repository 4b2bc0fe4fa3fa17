// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Icm20948 "TDK InvenSense ICM-20948, consumer nine-axis IMU, gyro and accelerometer"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of icm20948"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0008888888888888889);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.00018512012242326523, 0.00018512012242326523, 0.00018512012242326523})
      "Angle (velocity) random walk; N: 0.015 deg/s/sqrt(Hz) noise spectral density, ICM-20948 data sheet DS-000189 rev. 1.3, table 1, second-hand";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={4.363323129985824, 4.363323129985824, 4.363323129985824})
      "Input range, saturation; limit: ICM-20948 data sheet DS-000189 rev. 1.3, page 1 (GYRO_FS_SEL = 0)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00013323124061025415, 0.00013323124061025415, 0.00013323124061025415})
      "Resolution, quantization; q: 131 LSB/(deg/s), ICM-20948 data sheet DS-000189 rev. 1.3, table 1, second-hand (GYRO_FS_SEL = 0; Zephyr, drivers/sensor/tdk/icm20948/icm20948.c: 131.0)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of icm20948"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0008888888888888889);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0015949002046163026, 0.0015949002046163026, 0.0015949002046163026})
      "Angle (velocity) random walk; N: 230 ug/sqrt(Hz) noise spectral density, ICM-20948 data sheet DS-000189 rev. 1.3, table 2, page 12";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={19.6133,
      19.6133, 19.6133})
      "Input range, saturation; limit: ICM-20948 data sheet DS-000189 rev. 1.3, table 2, page 12, ACCEL_FS = 0";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0005985504150390625, 0.0005985504150390625, 0.0005985504150390625})
      "Resolution, quantization; q: 16384 LSB/g, ICM-20948 data sheet DS-000189 rev. 1.3, table 2, page 12, ACCEL_FS = 0";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "TDK InvenSense ICM-20948, consumer nine-axis IMU, gyro and accelerometer"
    extends PyImu.Interfaces.Imu(samplePeriod=0.0008888888888888889);
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
<p>TDK InvenSense ICM-20948, consumer nine-axis IMU, gyro and accelerometer.</p>
<p>Sampled at 1125 Hz (ICM-20948 data sheet DS-000189 rev. 1.3, table 2, page 12, largest output
data rate in low-noise mode with the filter on). Coefficients are in SI units; their sources stand
behind the blocks that have them.</p>
</html>"));
end Icm20948;
