// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors;
block Imu "Inertial measurement unit of a built-in part"
  extends PyImu.Interfaces.Imu(samplePeriod=partPeriods[part]);
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
  PyImu.Sensors.Parts.Adis16405.Imu adis16405(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16405;
  PyImu.Sensors.Parts.Adis16448.Imu adis16448(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16448;
  PyImu.Sensors.Parts.Adis16470.Imu adis16470(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16470;
  PyImu.Sensors.Parts.Adis16495.Imu adis16495(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16495;
  PyImu.Sensors.Parts.Adis16500.Imu adis16500(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adis16500;
  PyImu.Sensors.Parts.Adxrs300.Imu adxrs300(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Adxrs300;
  PyImu.Sensors.Parts.Bmi088.Imu bmi088(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Bmi088;
  PyImu.Sensors.Parts.Bmi160.Imu bmi160(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Bmi160;
  PyImu.Sensors.Parts.Bmi270.Imu bmi270(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Bmi270;
  PyImu.Sensors.Parts.Hg4930.Imu hg4930(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Hg4930;
  PyImu.Sensors.Parts.Icm20602.Imu icm20602(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm20602;
  PyImu.Sensors.Parts.Icm20948.Imu icm20948(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm20948;
  PyImu.Sensors.Parts.Icm42670.Imu icm42670(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm42670;
  PyImu.Sensors.Parts.Icm42688.Imu icm42688(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm42688;
  PyImu.Sensors.Parts.Icm45686.Imu icm45686(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Icm45686;
  PyImu.Sensors.Parts.Imt30.Imu imt30(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Imt30;
  PyImu.Sensors.Parts.Lsm6dsl.Imu lsm6dsl(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Lsm6dsl;
  PyImu.Sensors.Parts.Lsm6dso.Imu lsm6dso(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Lsm6dso;
  PyImu.Sensors.Parts.Lsm6dsox.Imu lsm6dsox(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Lsm6dsox;
  PyImu.Sensors.Parts.Lsm6dsv.Imu lsm6dsv(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Lsm6dsv;
  PyImu.Sensors.Parts.Mma7260q.Imu mma7260q(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mma7260q;
  PyImu.Sensors.Parts.Mpu6050.Imu mpu6050(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mpu6050;
  PyImu.Sensors.Parts.Mpu9250.Imu mpu9250(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mpu9250;
  PyImu.Sensors.Parts.Mti3.Imu mti3(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mti3;
  PyImu.Sensors.Parts.Mti300.Imu mti300(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Mti300;
  PyImu.Sensors.Parts.Sparkfun6dofV2.Imu sparkfun6dofV2(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Sparkfun6dofV2;
  PyImu.Sensors.Parts.Stim300.Imu stim300(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Stim300;
  PyImu.Sensors.Parts.Vn100.Imu vn100(samplePeriod=samplePeriod, seed=seed)
    if part == PyImu.Sensors.Part.Vn100;
equation
  connect(rate, adis16405.rate);
  connect(specificForce, adis16405.specificForce);
  connect(temperature, adis16405.temperature);
  connect(adis16405.gyro, gyro);
  connect(adis16405.accel, accel);
  connect(adis16405.measuredTemperature, measuredTemperature);
  connect(rate, adis16448.rate);
  connect(specificForce, adis16448.specificForce);
  connect(temperature, adis16448.temperature);
  connect(adis16448.gyro, gyro);
  connect(adis16448.accel, accel);
  connect(adis16448.measuredTemperature, measuredTemperature);
  connect(rate, adis16470.rate);
  connect(specificForce, adis16470.specificForce);
  connect(temperature, adis16470.temperature);
  connect(adis16470.gyro, gyro);
  connect(adis16470.accel, accel);
  connect(adis16470.measuredTemperature, measuredTemperature);
  connect(rate, adis16495.rate);
  connect(specificForce, adis16495.specificForce);
  connect(temperature, adis16495.temperature);
  connect(adis16495.gyro, gyro);
  connect(adis16495.accel, accel);
  connect(adis16495.measuredTemperature, measuredTemperature);
  connect(rate, adis16500.rate);
  connect(specificForce, adis16500.specificForce);
  connect(temperature, adis16500.temperature);
  connect(adis16500.gyro, gyro);
  connect(adis16500.accel, accel);
  connect(adis16500.measuredTemperature, measuredTemperature);
  connect(rate, adxrs300.rate);
  connect(specificForce, adxrs300.specificForce);
  connect(temperature, adxrs300.temperature);
  connect(adxrs300.gyro, gyro);
  connect(adxrs300.accel, accel);
  connect(adxrs300.measuredTemperature, measuredTemperature);
  connect(rate, bmi088.rate);
  connect(specificForce, bmi088.specificForce);
  connect(temperature, bmi088.temperature);
  connect(bmi088.gyro, gyro);
  connect(bmi088.accel, accel);
  connect(bmi088.measuredTemperature, measuredTemperature);
  connect(rate, bmi160.rate);
  connect(specificForce, bmi160.specificForce);
  connect(temperature, bmi160.temperature);
  connect(bmi160.gyro, gyro);
  connect(bmi160.accel, accel);
  connect(bmi160.measuredTemperature, measuredTemperature);
  connect(rate, bmi270.rate);
  connect(specificForce, bmi270.specificForce);
  connect(temperature, bmi270.temperature);
  connect(bmi270.gyro, gyro);
  connect(bmi270.accel, accel);
  connect(bmi270.measuredTemperature, measuredTemperature);
  connect(rate, hg4930.rate);
  connect(specificForce, hg4930.specificForce);
  connect(temperature, hg4930.temperature);
  connect(hg4930.gyro, gyro);
  connect(hg4930.accel, accel);
  connect(hg4930.measuredTemperature, measuredTemperature);
  connect(rate, icm20602.rate);
  connect(specificForce, icm20602.specificForce);
  connect(temperature, icm20602.temperature);
  connect(icm20602.gyro, gyro);
  connect(icm20602.accel, accel);
  connect(icm20602.measuredTemperature, measuredTemperature);
  connect(rate, icm20948.rate);
  connect(specificForce, icm20948.specificForce);
  connect(temperature, icm20948.temperature);
  connect(icm20948.gyro, gyro);
  connect(icm20948.accel, accel);
  connect(icm20948.measuredTemperature, measuredTemperature);
  connect(rate, icm42670.rate);
  connect(specificForce, icm42670.specificForce);
  connect(temperature, icm42670.temperature);
  connect(icm42670.gyro, gyro);
  connect(icm42670.accel, accel);
  connect(icm42670.measuredTemperature, measuredTemperature);
  connect(rate, icm42688.rate);
  connect(specificForce, icm42688.specificForce);
  connect(temperature, icm42688.temperature);
  connect(icm42688.gyro, gyro);
  connect(icm42688.accel, accel);
  connect(icm42688.measuredTemperature, measuredTemperature);
  connect(rate, icm45686.rate);
  connect(specificForce, icm45686.specificForce);
  connect(temperature, icm45686.temperature);
  connect(icm45686.gyro, gyro);
  connect(icm45686.accel, accel);
  connect(icm45686.measuredTemperature, measuredTemperature);
  connect(rate, imt30.rate);
  connect(specificForce, imt30.specificForce);
  connect(temperature, imt30.temperature);
  connect(imt30.gyro, gyro);
  connect(imt30.accel, accel);
  connect(imt30.measuredTemperature, measuredTemperature);
  connect(rate, lsm6dsl.rate);
  connect(specificForce, lsm6dsl.specificForce);
  connect(temperature, lsm6dsl.temperature);
  connect(lsm6dsl.gyro, gyro);
  connect(lsm6dsl.accel, accel);
  connect(lsm6dsl.measuredTemperature, measuredTemperature);
  connect(rate, lsm6dso.rate);
  connect(specificForce, lsm6dso.specificForce);
  connect(temperature, lsm6dso.temperature);
  connect(lsm6dso.gyro, gyro);
  connect(lsm6dso.accel, accel);
  connect(lsm6dso.measuredTemperature, measuredTemperature);
  connect(rate, lsm6dsox.rate);
  connect(specificForce, lsm6dsox.specificForce);
  connect(temperature, lsm6dsox.temperature);
  connect(lsm6dsox.gyro, gyro);
  connect(lsm6dsox.accel, accel);
  connect(lsm6dsox.measuredTemperature, measuredTemperature);
  connect(rate, lsm6dsv.rate);
  connect(specificForce, lsm6dsv.specificForce);
  connect(temperature, lsm6dsv.temperature);
  connect(lsm6dsv.gyro, gyro);
  connect(lsm6dsv.accel, accel);
  connect(lsm6dsv.measuredTemperature, measuredTemperature);
  connect(rate, mma7260q.rate);
  connect(specificForce, mma7260q.specificForce);
  connect(temperature, mma7260q.temperature);
  connect(mma7260q.gyro, gyro);
  connect(mma7260q.accel, accel);
  connect(mma7260q.measuredTemperature, measuredTemperature);
  connect(rate, mpu6050.rate);
  connect(specificForce, mpu6050.specificForce);
  connect(temperature, mpu6050.temperature);
  connect(mpu6050.gyro, gyro);
  connect(mpu6050.accel, accel);
  connect(mpu6050.measuredTemperature, measuredTemperature);
  connect(rate, mpu9250.rate);
  connect(specificForce, mpu9250.specificForce);
  connect(temperature, mpu9250.temperature);
  connect(mpu9250.gyro, gyro);
  connect(mpu9250.accel, accel);
  connect(mpu9250.measuredTemperature, measuredTemperature);
  connect(rate, mti3.rate);
  connect(specificForce, mti3.specificForce);
  connect(temperature, mti3.temperature);
  connect(mti3.gyro, gyro);
  connect(mti3.accel, accel);
  connect(mti3.measuredTemperature, measuredTemperature);
  connect(rate, mti300.rate);
  connect(specificForce, mti300.specificForce);
  connect(temperature, mti300.temperature);
  connect(mti300.gyro, gyro);
  connect(mti300.accel, accel);
  connect(mti300.measuredTemperature, measuredTemperature);
  connect(rate, sparkfun6dofV2.rate);
  connect(specificForce, sparkfun6dofV2.specificForce);
  connect(temperature, sparkfun6dofV2.temperature);
  connect(sparkfun6dofV2.gyro, gyro);
  connect(sparkfun6dofV2.accel, accel);
  connect(sparkfun6dofV2.measuredTemperature, measuredTemperature);
  connect(rate, stim300.rate);
  connect(specificForce, stim300.specificForce);
  connect(temperature, stim300.temperature);
  connect(stim300.gyro, gyro);
  connect(stim300.accel, accel);
  connect(stim300.measuredTemperature, measuredTemperature);
  connect(rate, vn100.rate);
  connect(specificForce, vn100.specificForce);
  connect(temperature, vn100.temperature);
  connect(vn100.gyro, gyro);
  connect(vn100.accel, accel);
  connect(vn100.measuredTemperature, measuredTemperature);
  annotation(Documentation(info="<html>
<p>One of the built-in parts, chosen by <code>part</code>, with its own effects and no others. The
sample period is the part's own unless another is given.</p>
</html>"));
end Imu;
