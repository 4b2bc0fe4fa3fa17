// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Adxrs300 "Analog Devices ADXRS300, analog gyro of a single axis"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of adxrs300"
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
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of adxrs300"
    extends PyImu.Interfaces.Triad(samplePeriod=0.01);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Sensors.Sampler sampler(samplePeriod=samplePeriod, y0=y0);
  equation
    connect(specificForce, sampler.x);
    connect(sampler.y, y);
  end Accelerometer;

  block Imu "Analog Devices ADXRS300, analog gyro of a single axis"
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
<p>Analog Devices ADXRS300, analog gyro of a single axis.</p>
<p>Sampled at 100 Hz (no clock of its own; assumed, as for the unit that samples it). Coefficients
are in SI units; their sources stand behind the blocks that have them.</p>
</html>"));
end Adxrs300;
