// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Icm42688 "TDK InvenSense ICM-42688-P, high-precision consumer six-axis IMU"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of icm42688"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={3.455575618567618e-05, 3.455575618567618e-05, 3.455575618567618e-05})
      "Angle (velocity) random walk; N: 0.0028 deg/s/sqrt(Hz) rate noise spectral density, ICM-42688-P data sheet DS-000347 rev. 1.8, table 1, second-hand";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={34.90658503988659, 34.90658503988659, 34.90658503988659})
      "Input range, saturation; limit: ICM-42688-P data sheet DS-000347 rev. 1.7, page 1, features (reset state)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0010642251536550791, 0.0010642251536550791, 0.0010642251536550791})
      "Resolution, quantization; q: 16.4 LSB/(deg/s), ICM-42688-P data sheet DS-000347 rev. 1.8, table 1, second-hand (GYRO_UI_FS_SEL = 0; a driver's list of the ranges of ICM-42688-P: 2000 dps, 16.4 LSB/dps)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of icm42688"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0004507326665219986, 0.0004507326665219986, 0.00048540441010061383})
      "Angle (velocity) random walk; N: [65, 65, 70] ug/sqrt(Hz) power spectral density, ICM-42688-P data sheet DS-000347 rev. 1.8, table 2, second-hand";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={156.9064,
      156.9064, 156.9064})
      "Input range, saturation; limit: ICM-42688-P data sheet DS-000347 rev. 1.7, page 1, features (reset state)";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0047884033203125, 0.0047884033203125, 0.0047884033203125})
      "Resolution, quantization; q: 2048 LSB/g, ICM-42688-P data sheet DS-000347 rev. 1.8, table 2, second-hand (ACCEL_UI_FS_SEL = 0; a driver's list of the ranges of ICM-42688-P: 16 g, 2048 LSB/g)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "TDK InvenSense ICM-42688-P, high-precision consumer six-axis IMU"
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
<p>TDK InvenSense ICM-42688-P, high-precision consumer six-axis IMU.</p>
<p>Sampled at 1000 Hz (ICM-42688-P data sheet DS-000347 rev. 1.8, registers GYRO_CONFIG0 and
ACCEL_CONFIG0, reset state 1 kHz, second-hand (a driver&#x27;s map of the registers of ICM-42688-P:
reset value 0x06 of both)). Coefficients are in SI units; their sources stand behind the blocks that
have them.</p>
</html>"));
end Icm42688;
