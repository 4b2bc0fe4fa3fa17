// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Icm45686 "TDK InvenSense ICM-45686, high-precision six-axis IMU"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of icm45686"
    extends PyImu.Interfaces.Triad(samplePeriod=0.00125);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={4.689709768056053e-05, 4.689709768056053e-05, 4.689709768056053e-05})
      "Angle (velocity) random walk; N: 0.0038 deg/s/sqrt(Hz) noise density, ICM-45686 data sheet DS-000577, page 1, second-hand (pcbsync.com, ICM-45686 datasheet, key specifications)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={34.90658503988659, 34.90658503988659, 34.90658503988659})
      "Input range, saturation; limit: ICM-45686 data sheet DS-000577, table 1, second-hand (Linux, drivers/iio/imu/inv_icm45600)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0010642251536550791, 0.0010642251536550791, 0.0010642251536550791})
      "Resolution, quantization; q: 16.4 LSB/(deg/s), ICM-45686 data sheet DS-000577, table 1, second-hand (Linux, drivers/iio/imu/inv_icm45600)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of icm45686"
    extends PyImu.Interfaces.Triad(samplePeriod=0.00125);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.00048540441010061383, 0.00048540441010061383, 0.00048540441010061383})
      "Angle (velocity) random walk; N: 70 ug/sqrt(Hz) noise density, ICM-45686 data sheet DS-000577, page 1, second-hand (pcbsync.com, ICM-45686 datasheet, key specifications)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={156.9064,
      156.9064, 156.9064})
      "Input range, saturation; limit: ICM-45686 data sheet DS-000577, table 2, second-hand (Linux, drivers/iio/imu/inv_icm45600)";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0047884033203125, 0.0047884033203125, 0.0047884033203125})
      "Resolution, quantization; q: 2048 LSB/g, ICM-45686 data sheet DS-000577, table 2, second-hand (Linux, drivers/iio/imu/inv_icm45600)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "TDK InvenSense ICM-45686, high-precision six-axis IMU"
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
<p>TDK InvenSense ICM-45686, high-precision six-axis IMU.</p>
<p>Sampled at 800 Hz (ICM-45686 data sheet DS-000577, registers GYRO_CONFIG0 and ACCEL_CONFIG0, 800
Hz, unchecked). Coefficients are in SI units; their sources stand behind the blocks that have
them.</p>
</html>"));
end Icm45686;
