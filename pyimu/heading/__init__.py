"""Heading of a body that turns about the vertical, from one gyro.

Self-calibration on a known motion and the threshold filter as Hong and Park 2008 have them, the
same two coefficients by the regression of ``pyimu close``, and a Kalman filter with zero-angular-
rate updates. S. K. Hong, S. Park, "Minimal-Drift Heading Measurement using a MEMS Gyro for Indoor
Mobile Robots", Sensors 8 (2008), 7287-7299.
"""

from pyimu.heading.calibration import Calibration, self_calibrate
from pyimu.heading.filter import HeadingFilter, HeadingTrack
from pyimu.heading.fit import fit
from pyimu.heading.result import HeadingResult
from pyimu.heading.run import METHODS, run
from pyimu.heading.threshold import threshold_filter
from pyimu.heading.transfer import RateTransfer, rate_transfer

__all__ = [
    "METHODS",
    "Calibration",
    "HeadingFilter",
    "HeadingResult",
    "HeadingTrack",
    "RateTransfer",
    "fit",
    "rate_transfer",
    "run",
    "self_calibrate",
    "threshold_filter",
]
