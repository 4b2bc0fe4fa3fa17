"""Attitude from gyro and accelerometer: the unscented filter as a block, and its run over a log."""

from pyimu.attitude.calibration import MagnetometerCalibration
from pyimu.attitude.filter.hidalgo2012 import attitude_hidalgo2012
from pyimu.attitude.filter.status import STATUS
from pyimu.attitude.filter.ukf import attitude_ukf
from pyimu.attitude.result import AttitudeResult
from pyimu.attitude.run import run

__all__ = [
    "STATUS",
    "AttitudeResult",
    "MagnetometerCalibration",
    "attitude_hidalgo2012",
    "attitude_ukf",
    "run",
]
