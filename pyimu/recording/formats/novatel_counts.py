"""The sizes of counts of the inertial units that NovAtel's receivers log."""

from __future__ import annotations

import math

from pyimu.recording.formats.novatel import TIME, VECTORS
from pyimu.recording.formats.reader import Reader
from pyimu.units import STANDARD_GRAVITY

_DEG = math.pi / 180
_FOOT = 0.3048
_EPSON = 2.0**-16
"""Of the 32 bits of a sample, those behind the point."""

_HG1700 = (2.0**-33, _FOOT * 2.0**-27)
_HG1700_LARGE = (2.0**-33, _FOOT * 2.0**-26)
_LITEF = (1e-9, 2e-8)
_STIM300 = (_DEG * 2.0**-21, 2.0**-22)
_HG4930 = (2.0**-33, 2.0**-29)

INCREMENTS: dict[int, tuple[float, tuple[float, float]]] = {
    1: (100.0, _HG1700),
    4: (100.0, _HG1700_LARGE),
    5: (100.0, _HG1700),
    8: (200.0, (2.0**-19, 2.0**-14)),
    11: (100.0, _HG1700),
    12: (100.0, _HG1700_LARGE),
    13: (200.0, (_DEG / 3600 * 0.1 * 2.0**-8, 0.05 * 2.0**-15)),
    20: (100.0, _HG1700),
    26: (100.0, _LITEF),
    27: (100.0, _HG1700),
    28: (100.0, _HG1700),
    31: (200.0, (_DEG * 720 * 2.0**-31, 200 * 2.0**-31)),
    32: (125.0, _STIM300),
    52: (200.0, _LITEF),
    56: (125.0, _STIM300),
    58: (200.0, _HG4930),
    68: (100.0, _HG4930),
    69: (400.0, _HG4930),
}
"""By the type of a unit its samples a second, and the rad and m/s of a count.

NovAtel's OEM7 driver for ROS: oem7_imu.hpp, oem7_imu.cpp, oem7_supported_imus.yaml. KVH's units are
left out: rad stand there where the size of the figure says degrees.
"""

RATES = {
    **dict.fromkeys((41, 62), (_DEG * 0.008 * _EPSON, 2e-4 * STANDARD_GRAVITY * _EPSON)),
    61: (_DEG * 0.0151515 * _EPSON, 4e-4 * STANDARD_GRAVITY * _EPSON),
}
"""Of units that give rates and no increments (Epson's), the rad/s and m/s^2 of a count."""


def is_novatel(reader: Reader) -> bool:
    """Whether a log is one of a receiver's raw samples."""
    return reader.header[:1] == [TIME] and set(VECTORS) <= set(reader.header)
