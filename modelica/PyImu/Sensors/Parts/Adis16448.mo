// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors.Parts;
package Adis16448 "Analog Devices ADIS16448, industrial ten-axis IMU of visual-inertial rigs"
  extends Modelica.Icons.Package;

  block Gyroscope "Gyroscope of adis16448"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001220703125);
    parameter Real y0[3] = {0, 0, 0} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Measured rate"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Gyro angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.00019198621771937625, 0.00019198621771937625, 0.00019198621771937625})
      "Angle (velocity) random walk; N: 0.66 deg/sqrt(h) angular random walk, ADIS16448 data sheet, table 1, second-hand (kalibr, issue 63)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={2090672062, 1471171709, 1319861564});
    PyImu.Effects.BiasInstability.Gyro biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={0.0001058348265862117, 0.0001058348265862117, 0.0001058348265862117}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 14.5 deg/h in-run bias stability, taken as the floor 0.664 B of the Allan deviation, ADIS16448 data sheet, table 1, unchecked";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3196001024, 2505197763, 2353625474, 3272142661, 3658735108, 4047408583, 3894787206,
      1874698313, 1990627592, 389392437, 237934964, 621005495, 1008270326, 1935240497, 1782733936,
      1097797555, 1484013298, 3756794429});
    PyImu.Effects.Saturation.Gyro saturation(samplePeriod=samplePeriod, y0=y0,
      limit={17.453292519943297, 17.453292519943297, 17.453292519943297})
      "Input range, saturation; limit: ADIS16448 data sheet, page 1, features";
    PyImu.Effects.Quantization.Gyro quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.0006981317007977319, 0.0006981317007977319, 0.0006981317007977319})
      "Resolution, quantization; q: 0.04 deg/s per LSB, ADIS16448 data sheet, table 1, second-hand (Linux, adis16400.c, scales of the ADIS16448)";
  equation
    connect(rate, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Gyroscope;

  block Accelerometer "Accelerometer of adis16448"
    extends PyImu.Interfaces.Triad(samplePeriod=0.001220703125);
    parameter Real y0[3] = {0, 0, 9.80665} "Output before the first sample";
    Modelica.Blocks.Interfaces.RealOutput y[3](each unit="m/s2") "Measured specific force"
      annotation(Placement(transformation(extent={{100,-10},{120,10}})));
    PyImu.Effects.AngleRandomWalk.Accel angleRandomWalk(samplePeriod=samplePeriod, y0=y0,
      N={0.0018333333333333333, 0.0018333333333333333, 0.0018333333333333333})
      "Angle (velocity) random walk; N: 0.11 m/s/sqrt(h) velocity random walk, ADIS16448 data sheet, table 1, second-hand (kalibr, issue 63)";
    PyImu.Noise.Normals angleRandomWalkNormals(samplePeriod=samplePeriod, seed=seed, n=3,
      channel={562850750, 178337917, 330959164});
    PyImu.Effects.BiasInstability.Accel biasInstability(samplePeriod=samplePeriod, y0=y0,
      B={0.0036902423950000004, 0.0036902423950000004, 0.0036902423950000004}, f_low=1e-05,
      f_high=1)
      "Bias instability, flicker noise; B: 0.25 mg in-run bias stability, taken as the floor 0.664 B of the Allan deviation, ADIS16448 data sheet, table 1, unchecked";
    PyImu.Noise.Normals biasInstabilityNormals(samplePeriod=samplePeriod, seed=seed, n=18,
      channel={3339721210, 3963439673, 4112939896, 3127373247, 2742869246, 2287046461, 2437594748,
      382902963, 264868850, 1243929653, 1396698484, 2014494391, 1628016630, 776476977, 928196720,
      478051251, 90524402, 2197640765});
    PyImu.Effects.Saturation.Accel saturation(samplePeriod=samplePeriod, y0=y0, limit={176.5197,
      176.5197, 176.5197})
      "Input range, saturation; limit: ADIS16448 data sheet, page 1, features (at least 18 g)";
    PyImu.Effects.Quantization.Accel quantization(samplePeriod=samplePeriod, y0=y0,
      q={0.008168939449999999, 0.008168939449999999, 0.008168939449999999})
      "Resolution, quantization; q: 0.833 mg per LSB, ADIS16448 data sheet, table 1, second-hand (Linux, adis16400.c, scales of the ADIS16448)";
  equation
    connect(specificForce, angleRandomWalk.x);
    connect(angleRandomWalkNormals.y, angleRandomWalk.w);
    connect(angleRandomWalk.y, biasInstability.x);
    connect(biasInstabilityNormals.y, biasInstability.w);
    connect(biasInstability.y, saturation.x);
    connect(saturation.y, quantization.x);
    connect(quantization.y, y);
  end Accelerometer;

  block Imu "Analog Devices ADIS16448, industrial ten-axis IMU of visual-inertial rigs"
    extends PyImu.Interfaces.Imu(samplePeriod=0.001220703125);
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
<p>Analog Devices ADIS16448, industrial ten-axis IMU of visual-inertial rigs.</p>
<p>Sampled at 819.2 Hz (ADIS16448 data sheet, table 1, internal sample rate 819.2 samples/s,
second-hand (PX4, Analog_Devices_ADIS16448_registers.hpp)). Coefficients are in SI units; their
sources stand behind the blocks that have them.</p>
</html>"));
end Adis16448;
