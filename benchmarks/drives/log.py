"""What a simulated body leaves behind."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Log:
    """What is recorded and what is true, a row a sample.

    ``time`` (n,) s as recorded; ``gyro``, ``accel`` (n, 3); the true attitude ``q`` (n, 4) at the
    sample, the true gyro ``bias`` (n, 3). ``heading``, ``heading_std``, ``heading_age`` (n,), NaN
    where there is none. ``told`` are arguments of the filter.
    """

    time: np.ndarray
    gyro: np.ndarray
    accel: np.ndarray
    q: np.ndarray
    bias: np.ndarray
    heading: dict[str, np.ndarray] = field(default_factory=dict)
    told: dict = field(default_factory=dict)
