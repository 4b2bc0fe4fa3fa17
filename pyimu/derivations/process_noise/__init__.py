"""Results of the discrete process noise of attitude error and gyro bias."""
