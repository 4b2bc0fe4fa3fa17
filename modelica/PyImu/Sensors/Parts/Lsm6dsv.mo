// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Lsm6dsv "STMicroelectronics LSM6DSV, six-axis IMU for augmented reality and drones"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of lsm6dsv"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0020833333333333333);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={3.455575618567618e-05, 3.455575618567618e-05, 3.455575618567618e-05})
      "Angle (velocity) random walk; N: 0.0028 deg/s/sqrt(Hz) rate noise density, typical, LSM6DSV data sheet DS13476, table 3, second-hand (Luxonis documentation, LSM6DSV, native characteristics)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={4.363323129985824, 4.363323129985824, 4.363323129985824})
      "Input range, saturation; limit: LSM6DSV data sheet DS13476, table 3, second-hand (Luxonis documentation, LSM6DSV, native characteristics)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00015271630954950385, 0.00015271630954950385, 0.00015271630954950385})
      "Resolution, quantization; q: 0.00875 deg/s per LSB, LSM6DSV data sheet DS13476, table 3, second-hand (Luxonis documentation, LSM6DSV, native characteristics)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of lsm6dsv"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0020833333333333333);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.00041606092294338323, 0.00041606092294338323, 0.00041606092294338323})
      "Angle (velocity) random walk; N: 60 ug/sqrt(Hz) in high-performance mode, typical, LSM6DSV data sheet DS13476, table 3, second-hand (Luxonis documentation, LSM6DSV, native characteristics)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={19.6133,
      19.6133, 19.6133})
      "Input range, saturation; limit: LSM6DSV data sheet DS13476, table 3, second-hand (Luxonis documentation, LSM6DSV, native characteristics)";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00059820565, 0.00059820565, 0.00059820565})
      "Resolution, quantization; q: 0.061 mg per LSB, LSM6DSV data sheet DS13476, table 3, second-hand (Luxonis documentation, LSM6DSV, native characteristics)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "STMicroelectronics LSM6DSV, six-axis IMU for augmented reality and drones"
    extends PyImu.Interfaces.Imu(samplePeriod=0.0020833333333333333);
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
<p>STMicroelectronics LSM6DSV, six-axis IMU for augmented reality and drones.</p>
<p>Sampled at 480 Hz (LSM6DSV data sheet DS13476, table of output data rates, one of them,
second-hand (ST, STMems_Standard_C_drivers, lsm6dsv_reg.h)). Coefficients are in SI units; their
sources stand behind the blocks that have them.</p>
</html>"));
end Lsm6dsv;
