"""The heading filter of one gyro: its variables, and its equations as a block."""
