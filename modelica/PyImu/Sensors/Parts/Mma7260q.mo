// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Mma7260q "Freescale MMA7260Q, analog three-axis accelerometer"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of mma7260q"
    extends PyImu.Interfaces.Triad(samplePeriod=0.01);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Sensors.Sampler sampler(samplePeriod=samplePeriod, y0=y0);
  equation
    connect(rate, sampler.x);
    connect(sampler.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of mma7260q"
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
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, saturation.x);
    connect(saturation.y, y);
  end Accelerometer;

  block Imu "Freescale MMA7260Q, analog three-axis accelerometer"
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
<p>Freescale MMA7260Q, analog three-axis accelerometer.</p>
<p>Sampled at 100 Hz (no clock of its own; assumed, as for the unit that samples it). Coefficients
are in SI units; their sources stand behind the blocks that have them.</p>
</html>"));
end Mma7260q;
