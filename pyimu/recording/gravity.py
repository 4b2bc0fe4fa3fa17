"""Gravity where a log was made."""

from __future__ import annotations

import numpy as np

from pyimu.recording.recording import Recording
from pyimu.symbolic.earth import normal_gravity

MIDDLE, SOMEWHERE = 9.8063, 0.015
"""m/s^2; gravity at an unknown place, and the standard deviation of one that is as likely anywhere
from the equator's 9.780 to the poles' 9.832."""

HEIGHT = 0.003
"""m/s^2; standard deviation of gravity at a known latitude and an unknown height, of 1 km."""


def gravity_of(recording: Recording, latitude: float | None) -> tuple[float, float]:
    """Gravity where a log was made and its standard deviation, m/s^2."""
    if latitude is None and recording.latitude is not None:
        latitude = float(np.nanmean(recording.latitude))
    if latitude is None or not np.isfinite(latitude):
        return MIDDLE, SOMEWHERE
    return float(normal_gravity(latitude)), HEIGHT
