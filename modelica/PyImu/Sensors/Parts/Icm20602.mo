// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Icm20602 "TDK InvenSense ICM-20602, six-axis IMU of flight controllers"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of icm20602"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={4.93653659795374e-05, 4.93653659795374e-05, 4.93653659795374e-05})
      "Angle (velocity) random walk; N: 0.004 deg/s/sqrt(Hz) noise density, ICM-20602 data sheet DS-000176 rev. 1.0, page 1, features";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={4.363323129985824, 4.363323129985824, 4.363323129985824})
      "Input range, saturation; limit: ICM-20602 data sheet DS-000176 rev. 1.0, page 1, features (FS_SEL = 0)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00013323124061025415, 0.00013323124061025415, 0.00013323124061025415})
      "Resolution, quantization; q: 131 LSB/(deg/s), ICM-20602 data sheet DS-000176 rev. 1.0, table 1, second-hand (drv_icm20602.c, scale factors of ICM-20602: 1/131)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of icm20602"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0006934348715723055, 0.0006934348715723055, 0.0006934348715723055})
      "Angle (velocity) random walk; N: 100 ug/sqrt(Hz) noise density, ICM-20602 data sheet DS-000176 rev. 1.0, page 1, features";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={19.6133,
      19.6133, 19.6133})
      "Input range, saturation; limit: ICM-20602 data sheet DS-000176 rev. 1.0, page 1, features (ACCEL_FS_SEL = 0)";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0005985504150390625, 0.0005985504150390625, 0.0005985504150390625})
      "Resolution, quantization; q: 16384 LSB/g, ICM-20602 data sheet DS-000176 rev. 1.0, table 2, second-hand (drv_icm20602.c, scale factors of ICM-20602: 1/16384)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "TDK InvenSense ICM-20602, six-axis IMU of flight controllers"
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
<p>TDK InvenSense ICM-20602, six-axis IMU of flight controllers.</p>
<p>Sampled at 1000 Hz (ICM-20602 data sheet DS-000176 rev. 1.0, register SMPLRT_DIV, 1 kHz,
second-hand (Embedded Planet, icm20602.h, which names the sheet: 1 kHz behind the low-passes of 176
Hz and less)). Coefficients are in SI units; their sources stand behind the blocks that have
them.</p>
</html>"));
end Icm20602;
