// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Sparkfun6dofV2 "SparkFun IMU 6 Degrees of Freedom v2 (ADXRS300, MMA7260Q, 10 bits)"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of sparkfun6dof_v2"
    extends PyImu.Interfaces.Triad(samplePeriod=0.01);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.001234134149488435, 0.001234134149488435, 0.001234134149488435})
      "Angle (velocity) random walk; N: 0.1 deg/s/sqrt(Hz) rate noise density at 25 degC, ADXRS300 data sheet Rev. B, page 3, specifications, unchecked";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={5.235987755982989, 5.235987755982989, 5.235987755982989})
      "Input range, saturation; limit: ADXRS300 data sheet Rev. B, page 3, specifications, full-scale range over specifications range, second-hand (IMUSim, platforms/gyroscopes.py)";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.017044230976507126, 0.017044230976507126, 0.017044230976507126})
      "Resolution, quantization; q: 1.024 LSB/(deg/s) of 1024 steps of 5 V at 5 mV/(deg/s), ADXRS300 data sheet Rev. B, page 3, sensitivity and supply; 10 bits: PIC16F88 data sheet DS30487, page 1, unchecked";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of sparkfun6dof_v2"
    extends PyImu.Interfaces.Triad(samplePeriod=0.01);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.002427022050503069, 0.002427022050503069, 0.002427022050503069})
      "Angle (velocity) random walk; N: 350 ug/sqrt(Hz) power spectral density, rms, 0.1 Hz to 1 kHz, MMA7260QT data sheet Rev. 5, table 2, operating characteristics, unchecked";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={14.709975,
      14.709975, 14.709975})
      "Input range, saturation; limit: MMA7260QT data sheet Rev. 5, page 1, selectable sensitivity";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.03950432739257813, 0.03950432739257813, 0.03950432739257813})
      "Resolution, quantization; q: 4.0283203125 mg step, 1024 of 3.3 V at 800 mV/g, MMA7260QT data sheet Rev. 5, page 1, sensitivity; 10 bits: PIC16F88 data sheet DS30487, page 1, unchecked";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "SparkFun IMU 6 Degrees of Freedom v2 (ADXRS300, MMA7260Q, 10 bits)"
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
<p>SparkFun IMU 6 Degrees of Freedom v2 (ADXRS300, MMA7260Q, 10 bits).</p>
<p>Sampled at 100 Hz (SparkFun IMU 6 Degrees of Freedom v2 data sheet of 2008-02-21, page 1 has
none; assumed). Coefficients are in SI units; their sources stand behind the blocks that have
them.</p>
</html>"));
end Sparkfun6dofV2;
