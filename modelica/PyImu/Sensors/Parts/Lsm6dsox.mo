// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Lsm6dsox "STMicroelectronics LSM6DSOX, consumer six-axis IMU with machine-learning core"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of lsm6dsox"
    extends PyImu.Interfaces.Triad(samplePeriod=0.002403846153846154);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={4.689709768056053e-05, 4.689709768056053e-05, 4.689709768056053e-05})
      "Angle (velocity) random walk; N: 0.0038 deg/s/sqrt(Hz) rate noise density in high-performance mode, LSM6DSOX data sheet DS12814, table 2, second-hand (AMR-RL, description of the robot Pip, sensors, which cites Rev 3: noise 3.8 mdps/sqrt(Hz))";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={4.363323129985824, 4.363323129985824, 4.363323129985824})
      "Input range, saturation; limit: LSM6DSOX data sheet DS12814, table 2, second-hand (sensitivity table of a driver's tests that quotes table 2)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00015271630954950385, 0.00015271630954950385, 0.00015271630954950385})
      "Resolution, quantization; q: 0.00875 deg/s per LSB, LSM6DSOX data sheet DS12814, table 2, second-hand (sensitivity table of a driver's tests that quotes table 2)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of lsm6dsox"
    extends PyImu.Interfaces.Triad(samplePeriod=0.002403846153846154);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.00048540441010061383, 0.00048540441010061383, 0.00048540441010061383})
      "Angle (velocity) random walk; N: 70 ug/sqrt(Hz) acceleration noise density in high-performance mode, LSM6DSOX data sheet DS12814, table 2, unchecked (+-2 g)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={19.6133,
      19.6133, 19.6133})
      "Input range, saturation; limit: LSM6DSOX data sheet DS12814, page 1, features, the least of its ranges";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00059820565, 0.00059820565, 0.00059820565})
      "Resolution, quantization; q: 0.061 mg per LSB, LSM6DSOX data sheet DS12814, table 2, second-hand (a driver that quotes the data sheet's sensitivity)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "STMicroelectronics LSM6DSOX, consumer six-axis IMU with machine-learning core"
    extends PyImu.Interfaces.Imu(samplePeriod=0.002403846153846154);
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
<p>STMicroelectronics LSM6DSOX, consumer six-axis IMU with machine-learning core.</p>
<p>Sampled at 416 Hz (LSM6DSOX data sheet DS12814, table of output data rates, one of them,
unchecked). Coefficients are in SI units; their sources stand behind the blocks that have them.</p>
</html>"));
end Lsm6dsox;
