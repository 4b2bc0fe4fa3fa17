// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Hg4930 "Honeywell HG4930 CA51, tactical-grade IMU"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of hg4930"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0016666666666666668);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={1.1635528346628864e-05, 1.1635528346628864e-05, 1.1635528346628864e-05})
      "Angle (velocity) random walk; N: 0.04 deg/sqrt(h) angular random walk, HG4930 product brochure, model CA51, specifications, second-hand (INSbot.m, a simulator in MATLAB of an HG4930CA51: NoiseDensity 0.04 deg/sqrt(h))";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.BiasInstability.Gyro biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={1.824353882015184e-06, 1.824353882015184e-06, 1.824353882015184e-06}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 0.25 deg/h in-run bias stability, taken as the floor 0.664 B of the Allan deviation, HG4930 product brochure, model CA51, specifications, second-hand (INSbot.m, a simulator in MATLAB of an HG4930CA51: BiasInstability 0.25 deg/h)";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3196001024, 2505197763, 2353625474, 3272142661, 3658735108, 4047408583, 3894787206,
      1874698313, 1990627592, 389392437, 237934964, 621005495, 1008270326, 1935240497, 1782733936,
      1097797555, 1484013298, 3756794429});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={6.981317007977318, 6.981317007977318, 6.981317007977318})
      "Input range, saturation; limit: HG4930 product brochure, model CA51, specifications, second-hand (Bolder Flight Systems, library hg4930, description)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of hg4930"
    extends PyImu.Interfaces.Triad(samplePeriod=0.0016666666666666668);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0005, 0.0005, 0.0005})
      "Angle (velocity) random walk; N: 0.03 m/s/sqrt(h) velocity random walk, HG4930 product brochure, model CA51, specifications, second-hand (INSbot.m, a simulator in MATLAB of an HG4930CA51: NoiseDensity 0.03/60 m/s/sqrt(s))";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.BiasInstability.Accel biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={0.0003690242395, 0.0003690242395, 0.0003690242395}, f_low=1e-05, f_high=1)
      "Bias instability, flicker noise; B: 0.025 mg in-run bias stability, taken as the floor 0.664 B of the Allan deviation, HG4930 product brochure, model CA51, specifications, second-hand (INSbot.m, a simulator in MATLAB of an HG4930CA51: BiasInstability 0.025 mg)";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3339721210, 3963439673, 4112939896, 3127373247, 2742869246, 2287046461, 2437594748,
      382902963, 264868850, 1243929653, 1396698484, 2014494391, 1628016630, 776476977, 928196720,
      478051251, 90524402, 2197640765});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0,
      limit={196.13299999999998, 196.13299999999998, 196.13299999999998})
      "Input range, saturation; limit: HG4930 product brochure, model CA51, specifications, second-hand (Bolder Flight Systems, library hg4930, description)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, y);
  end Accelerometer;

  block Imu "Honeywell HG4930 CA51, tactical-grade IMU"
    extends PyImu.Interfaces.Imu(samplePeriod=0.0016666666666666668);
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
<p>Honeywell HG4930 CA51, tactical-grade IMU.</p>
<p>Sampled at 600 Hz (HG4930 product brochure, model CA51, specifications, rate of the inertial
data, second-hand (Bolder Flight Systems, library hg4930, description)). Coefficients are in SI
units; their sources stand behind the blocks that have them.</p>
</html>"));
end Hg4930;
