// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors;
block Gyroscope "Gyroscope of a built-in part"
  extends PyImu.Interfaces.Triad(samplePeriod=partPeriods[part]);
  parameter PyImu.Sensors.Part part = PyImu.Sensors.Part.Imt30 "Which part"
    annotation(Evaluate=true);
  constant Modelica.Units.SI.Time partPeriods[PyImu.Sensors.Part] = {
    0.001220703125,
    0.001220703125,
    0.0005,
    0.00023529411764705883,
    0.0005,
    0.01,
    0.0025,
    0.01,
    0.005,
    0.0016666666666666668,
    0.001,
    0.0008888888888888889,
    0.00125,
    0.001,
    0.00125,
    0.0010245901639344263,
    0.002403846153846154,
    0.002403846153846154,
    0.002403846153846154,
    0.0020833333333333333,
    0.01,
    0.001,
    0.001,
    0.001,
    0.0005,
    0.01,
    0.001,
    0.00125} "Sample period of each part";
  Modelica.Blocks.Interfaces.RealOutput y[3](each unit="rad/s") "Output, body axes"
    annotation(Placement(transformation(extent={{100,-10},{120,10}})));
  PyImu.Sensors.Parts.Adis16405.Gyroscope adis16405(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16405;
  PyImu.Sensors.Parts.Adis16448.Gyroscope adis16448(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16448;
  PyImu.Sensors.Parts.Adis16470.Gyroscope adis16470(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16470;
  PyImu.Sensors.Parts.Adis16495.Gyroscope adis16495(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16495;
  PyImu.Sensors.Parts.Adis16500.Gyroscope adis16500(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16500;
  PyImu.Sensors.Parts.Adxrs300.Gyroscope adxrs300(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adxrs300;
  PyImu.Sensors.Parts.Bmi088.Gyroscope bmi088(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Bmi088;
  PyImu.Sensors.Parts.Bmi160.Gyroscope bmi160(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Bmi160;
  PyImu.Sensors.Parts.Bmi270.Gyroscope bmi270(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Bmi270;
  PyImu.Sensors.Parts.Hg4930.Gyroscope hg4930(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Hg4930;
  PyImu.Sensors.Parts.Icm20602.Gyroscope icm20602(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm20602;
  PyImu.Sensors.Parts.Icm20948.Gyroscope icm20948(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm20948;
  PyImu.Sensors.Parts.Icm42670.Gyroscope icm42670(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm42670;
  PyImu.Sensors.Parts.Icm42688.Gyroscope icm42688(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm42688;
  PyImu.Sensors.Parts.Icm45686.Gyroscope icm45686(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm45686;
  PyImu.Sensors.Parts.Imt30.Gyroscope imt30(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Imt30;
  PyImu.Sensors.Parts.Lsm6dsl.Gyroscope lsm6dsl(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Lsm6dsl;
  PyImu.Sensors.Parts.Lsm6dso.Gyroscope lsm6dso(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Lsm6dso;
  PyImu.Sensors.Parts.Lsm6dsox.Gyroscope lsm6dsox(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Lsm6dsox;
  PyImu.Sensors.Parts.Lsm6dsv.Gyroscope lsm6dsv(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Lsm6dsv;
  PyImu.Sensors.Parts.Mma7260q.Gyroscope mma7260q(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mma7260q;
  PyImu.Sensors.Parts.Mpu6050.Gyroscope mpu6050(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mpu6050;
  PyImu.Sensors.Parts.Mpu9250.Gyroscope mpu9250(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mpu9250;
  PyImu.Sensors.Parts.Mti3.Gyroscope mti3(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mti3;
  PyImu.Sensors.Parts.Mti300.Gyroscope mti300(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mti300;
  PyImu.Sensors.Parts.Sparkfun6dofV2.Gyroscope sparkfun6dofV2(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Sparkfun6dofV2;
  PyImu.Sensors.Parts.Stim300.Gyroscope stim300(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Stim300;
  PyImu.Sensors.Parts.Vn100.Gyroscope vn100(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Vn100;
equation
  connect(rate, adis16405.rate);
  connect(specificForce, adis16405.specificForce);
  connect(temperature, adis16405.temperature);
  connect(adis16405.y, y);
  connect(rate, adis16448.rate);
  connect(specificForce, adis16448.specificForce);
  connect(temperature, adis16448.temperature);
  connect(adis16448.y, y);
  connect(rate, adis16470.rate);
  connect(specificForce, adis16470.specificForce);
  connect(temperature, adis16470.temperature);
  connect(adis16470.y, y);
  connect(rate, adis16495.rate);
  connect(specificForce, adis16495.specificForce);
  connect(temperature, adis16495.temperature);
  connect(adis16495.y, y);
  connect(rate, adis16500.rate);
  connect(specificForce, adis16500.specificForce);
  connect(temperature, adis16500.temperature);
  connect(adis16500.y, y);
  connect(rate, adxrs300.rate);
  connect(specificForce, adxrs300.specificForce);
  connect(temperature, adxrs300.temperature);
  connect(adxrs300.y, y);
  connect(rate, bmi088.rate);
  connect(specificForce, bmi088.specificForce);
  connect(temperature, bmi088.temperature);
  connect(bmi088.y, y);
  connect(rate, bmi160.rate);
  connect(specificForce, bmi160.specificForce);
  connect(temperature, bmi160.temperature);
  connect(bmi160.y, y);
  connect(rate, bmi270.rate);
  connect(specificForce, bmi270.specificForce);
  connect(temperature, bmi270.temperature);
  connect(bmi270.y, y);
  connect(rate, hg4930.rate);
  connect(specificForce, hg4930.specificForce);
  connect(temperature, hg4930.temperature);
  connect(hg4930.y, y);
  connect(rate, icm20602.rate);
  connect(specificForce, icm20602.specificForce);
  connect(temperature, icm20602.temperature);
  connect(icm20602.y, y);
  connect(rate, icm20948.rate);
  connect(specificForce, icm20948.specificForce);
  connect(temperature, icm20948.temperature);
  connect(icm20948.y, y);
  connect(rate, icm42670.rate);
  connect(specificForce, icm42670.specificForce);
  connect(temperature, icm42670.temperature);
  connect(icm42670.y, y);
  connect(rate, icm42688.rate);
  connect(specificForce, icm42688.specificForce);
  connect(temperature, icm42688.temperature);
  connect(icm42688.y, y);
  connect(rate, icm45686.rate);
  connect(specificForce, icm45686.specificForce);
  connect(temperature, icm45686.temperature);
  connect(icm45686.y, y);
  connect(rate, imt30.rate);
  connect(specificForce, imt30.specificForce);
  connect(temperature, imt30.temperature);
  connect(imt30.y, y);
  connect(rate, lsm6dsl.rate);
  connect(specificForce, lsm6dsl.specificForce);
  connect(temperature, lsm6dsl.temperature);
  connect(lsm6dsl.y, y);
  connect(rate, lsm6dso.rate);
  connect(specificForce, lsm6dso.specificForce);
  connect(temperature, lsm6dso.temperature);
  connect(lsm6dso.y, y);
  connect(rate, lsm6dsox.rate);
  connect(specificForce, lsm6dsox.specificForce);
  connect(temperature, lsm6dsox.temperature);
  connect(lsm6dsox.y, y);
  connect(rate, lsm6dsv.rate);
  connect(specificForce, lsm6dsv.specificForce);
  connect(temperature, lsm6dsv.temperature);
  connect(lsm6dsv.y, y);
  connect(rate, mma7260q.rate);
  connect(specificForce, mma7260q.specificForce);
  connect(temperature, mma7260q.temperature);
  connect(mma7260q.y, y);
  connect(rate, mpu6050.rate);
  connect(specificForce, mpu6050.specificForce);
  connect(temperature, mpu6050.temperature);
  connect(mpu6050.y, y);
  connect(rate, mpu9250.rate);
  connect(specificForce, mpu9250.specificForce);
  connect(temperature, mpu9250.temperature);
  connect(mpu9250.y, y);
  connect(rate, mti3.rate);
  connect(specificForce, mti3.specificForce);
  connect(temperature, mti3.temperature);
  connect(mti3.y, y);
  connect(rate, mti300.rate);
  connect(specificForce, mti300.specificForce);
  connect(temperature, mti300.temperature);
  connect(mti300.y, y);
  connect(rate, sparkfun6dofV2.rate);
  connect(specificForce, sparkfun6dofV2.specificForce);
  connect(temperature, sparkfun6dofV2.temperature);
  connect(sparkfun6dofV2.y, y);
  connect(rate, stim300.rate);
  connect(specificForce, stim300.specificForce);
  connect(temperature, stim300.temperature);
  connect(stim300.y, y);
  connect(rate, vn100.rate);
  connect(specificForce, vn100.specificForce);
  connect(temperature, vn100.temperature);
  connect(vn100.y, y);
  annotation(Documentation(info="<html>
<p>One of the built-in parts, chosen by <code>part</code>, with its own effects and no others. The
sample period is the part's own unless another is given.</p>
</html>"));
end Gyroscope;
