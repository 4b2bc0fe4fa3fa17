// Written by `make generate` from the definitions in pyimu; do not edit.
within PyImu.Sensors;
type Part = enumeration(
    Adis16405 "Analog Devices ADIS16405, industrial IMU with magnetometer",
    Adis16448 "Analog Devices ADIS16448, industrial ten-axis IMU of visual-inertial rigs",
    Adis16470 "Analog Devices ADIS16470, miniature industrial IMU",
    Adis16495 "Analog Devices ADIS16495-1, tactical-grade IMU",
    Adis16500 "Analog Devices ADIS16500, miniature industrial IMU",
    Adxrs300 "Analog Devices ADXRS300, analog gyro of a single axis",
    Bmi088 "Bosch Sensortec BMI088, six-axis IMU for drones",
    Bmi160 "Bosch Sensortec BMI160, low-power six-axis IMU",
    Bmi270 "Bosch Sensortec BMI270, low-power six-axis IMU for wearables",
    Hg4930 "Honeywell HG4930 CA51, tactical-grade IMU",
    Icm20602 "TDK InvenSense ICM-20602, six-axis IMU of flight controllers",
    Icm20948 "TDK InvenSense ICM-20948, consumer nine-axis IMU, gyro and accelerometer",
    Icm42670 "TDK InvenSense ICM-42670-P, low-power six-axis IMU",
    Icm42688 "TDK InvenSense ICM-42688-P, high-precision consumer six-axis IMU",
    Icm45686 "TDK InvenSense ICM-45686, high-precision six-axis IMU",
    Imt30 "Imego IMT30, prototype of a tactical-grade MEMS inertial measurement unit",
    Lsm6dsl "STMicroelectronics LSM6DSL, consumer six-axis IMU",
    Lsm6dso "STMicroelectronics LSM6DSO, consumer six-axis IMU",
    Lsm6dsox "STMicroelectronics LSM6DSOX, consumer six-axis IMU with machine-learning core",
    Lsm6dsv "STMicroelectronics LSM6DSV, six-axis IMU for augmented reality and drones",
    Mma7260q "Freescale MMA7260Q, analog three-axis accelerometer",
    Mpu6050 "InvenSense MPU-6050, consumer six-axis IMU",
    Mpu9250 "InvenSense MPU-9250, consumer nine-axis IMU, gyro and accelerometer",
    Mti3 "Movella (Xsens) MTi-3, attitude and heading reference module, inertial sensors only",
    Mti300 "Movella (Xsens) MTi-300, attitude and heading reference system, inertial sensors only",
    Sparkfun6dofV2 "SparkFun IMU 6 Degrees of Freedom v2 (ADXRS300, MMA7260Q, 10 bits)",
    Stim300 "Sensonor STIM300 with 10 g accelerometers, tactical-grade IMU",
    Vn100 "VectorNav VN-100, attitude and heading reference system, inertial sensors only")
  "The built-in parts"
  annotation(Documentation(info="<html>
<p>What a sensor may be; figures and sources stand with Sensors.Parts.</p>
</html>"));
