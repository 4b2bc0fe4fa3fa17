// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Imt30 "Imego IMT30, prototype of a tactical-grade MEMS inertial measurement unit"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of imt30"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0010245901639344263);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.ThermalBias.Gyro thermalBias(samplePeriod=samplePeriod, y0=y0,
      kT={0.00034906585039886593, 0.0009773843811168245, 0.0008726646259971648}, T0=25)
      "Bias temperature sensitivity; kT: Hidalgo 2012, table 1";
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={6.0400027647350424e-05, 6.940010882346785e-05, 5.960008507351969e-05})
      "Angle (velocity) random walk; N: Hidalgo 2012, table 2";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.RateRandomWalk.Gyro rateRandomWalk(samplePeriod=samplePeriod, y0=y0,
      K={2.6503147900654633e-06, 4.007793097172164e-06, 5.187506387872035e-06})
      "Rate (acceleration) random walk; K: Hidalgo 2012, table 4";
    PyImu.Noise.Normals rateRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={269997735, 993690980, 572634149});
  equation
    connect(rate, thermalBias.x);
    connect(temperature, thermalBias.T);
    connect(thermalBias.y, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, rateRandomWalk.x);
    connect(rateRandomWalkNormals.y, rateRandomWalk.w);
    connect(rateRandomWalk.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of imt30"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0010245901639344263);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Sensors.Sampler sampler(samplePeriod=samplePeriod, y0=y0);
  equation
    connect(specificForce, sampler.x);
    connect(sampler.y, y);
  end Accelerometer;

  block Imu "Imego IMT30, prototype of a tactical-grade MEMS inertial measurement unit"
    extends PyImu.Interfaces.Imu(samplePeriod=0.0010245901639344263);
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
<p>Imego IMT30, prototype of a tactical-grade MEMS inertial measurement unit.</p>
<p>Sampled at 976 Hz (Hidalgo 2012, section 2.2, test setup (acquisition frequency)). Coefficients
are in SI units; their sources stand behind the blocks that have them.</p>
</html>"));
end Imt30;
