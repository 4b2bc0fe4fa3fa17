// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Bmi270 "Bosch Sensortec BMI270, low-power six-axis IMU for wearables"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of bmi270"
    extends PyImu.Interfaces.Triad(samplePeriod=0.005);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={8.638939046419044e-05, 8.638939046419044e-05, 8.638939046419044e-05})
      "Angle (velocity) random walk; N: 0.007 deg/s/sqrt(Hz) noise density in performance mode, BMI270 data sheet BST-BMI270-DS000 rev. 1.5, table of native characteristics, second-hand (Luxonis documentation, BMI270)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={34.90658503988659, 34.90658503988659, 34.90658503988659})
      "Input range, saturation; limit: BMI270 data sheet BST-BMI270-DS000 rev. 1.5, table of native characteristics, second-hand (Luxonis documentation, BMI270)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0010652644360316954, 0.0010652644360316954, 0.0010652644360316954})
      "Resolution, quantization; q: 16.384 LSB/(deg/s), BMI270 data sheet BST-BMI270-DS000 rev. 1.5, table of native characteristics, second-hand (Luxonis documentation, BMI270)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of bmi270"
    extends PyImu.Interfaces.Triad(samplePeriod=0.005);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0011094957945156888, 0.0011094957945156888, 0.0011094957945156888})
      "Angle (velocity) random walk; N: 160 ug/sqrt(Hz) noise density, BMI270 data sheet BST-BMI270-DS000 rev. 1.5, table of native characteristics, second-hand (Luxonis documentation, BMI270)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={78.4532,
      78.4532, 78.4532})
      "Input range, saturation; limit: BMI270 data sheet BST-BMI270-DS000 rev. 1.5, table of native characteristics, second-hand (Luxonis documentation, BMI270)";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.00239420166015625, 0.00239420166015625, 0.00239420166015625})
      "Resolution, quantization; q: 4096 LSB/g, BMI270 data sheet BST-BMI270-DS000 rev. 1.5, table of native characteristics, second-hand (Luxonis documentation, BMI270)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "Bosch Sensortec BMI270, low-power six-axis IMU for wearables"
    extends PyImu.Interfaces.Imu(samplePeriod=0.005);
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
<p>Bosch Sensortec BMI270, low-power six-axis IMU for wearables.</p>
<p>Sampled at 200 Hz (BMI270 data sheet BST-BMI270-DS000 rev. 1.5, registers GYR_CONF and ACC_CONF,
output data rate of the gyro&#x27;s reset state, unchecked). Coefficients are in SI units; their
sources stand behind the blocks that have them.</p>
</html>"));
end Bmi270;
