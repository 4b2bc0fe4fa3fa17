"""Attitude from gyro and accelerometer: the unscented filter as a block, and its run over a log."""

from pyimu.attitude.result import AttitudeResult
from pyimu.attitude.run import run
from pyimu.attitude.ukf import attitude_ukf
from pyimu.attitude.variables import STATUS

__all__ = ["STATUS", "AttitudeResult", "attitude_ukf", "run"]
