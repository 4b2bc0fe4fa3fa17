// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors;
type Part = enumeration(
    Adis16405 "Analog Devices ADIS16405, industrial IMU with magnetometer",
    Adis16470 "Analog Devices ADIS16470, miniature industrial IMU",
    Adis16495 "Analog Devices ADIS16495-1, tactical-grade IMU",
    Bmi088 "Bosch Sensortec BMI088, six-axis IMU for drones",
    Icm20948 "TDK InvenSense ICM-20948, consumer nine-axis IMU, gyro and accelerometer",
    Icm42688 "TDK InvenSense ICM-42688-P, high-precision consumer six-axis IMU",
    Imt30 "Imego IMT30, prototype of a tactical-grade MEMS inertial measurement unit",
    Lsm6dsl "STMicroelectronics LSM6DSL, consumer six-axis IMU",
    Lsm6dso "STMicroelectronics LSM6DSO, consumer six-axis IMU",
    Mpu6050 "InvenSense MPU-6050, consumer six-axis IMU",
    Mpu9250 "InvenSense MPU-9250, consumer nine-axis IMU, gyro and accelerometer",
    Mti300 "Movella (Xsens) MTi-300, attitude and heading reference system, inertial sensors only",
    Stim300 "Sensonor STIM300 with 10 g accelerometers, tactical-grade IMU")
  "The built-in parts"
  annotation(Documentation(info="<html>
<p>What a sensor may be; figures and sources stand with Sensors.Parts.</p>
</html>"));
