"""Hard and soft iron: a magnetometer's bias, scale and misalignment, found in a log and undone."""
