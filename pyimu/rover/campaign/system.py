"""The units of a campaign, compiled once in a process: sensor, low-pass and attitude filter."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.signal import butter

from pyimu.attitude.alignment import BIAS_STD, TILT_STD, YAW_STD
from pyimu.attitude.filter.ukf import attitude_ukf
from pyimu.attitude.stuck import LEAST
from pyimu.block.block import Block
from pyimu.model.part import Part
from pyimu.rover.campaign.faults import SATURATING
from pyimu.rover.campaign.motion import LATITUDE
from pyimu.rover.campaign.settings import CUT_OFF, Settings
from pyimu.rover.campaign.specimen import specimen_of

WHITE = "angle_random_walk"
"""White noise: it is no part of a bias, and makes successive samples differ."""

STD0 = np.array([TILT_STD, TILT_STD, YAW_STD, BIAS_STD, BIAS_STD, BIAS_STD])
"""Standard deviations (6,) before the first sample: attitude rad, bias rad/s."""


@dataclass(frozen=True)
class System:
    """The blocks of a campaign: the ``sensor``, the ``nominal`` one, and the ``filter``.

    ``part`` is what the filter knows.

    ``sections`` are the low-pass's (1, 6), None without one.
    """

    settings: Settings
    part: Part
    sensor: Block
    nominal: Block
    filter: Block
    sections: np.ndarray | None

    @property
    def period(self) -> float:
        """s of the sensors' samples."""
        return 1.0 / self.settings.sensor_rate

    def specimen(self, seed: int) -> Part:
        """The part that a run has."""
        return specimen_of(self.part, seed) if self.settings.specimens else self.part

    def parameters(self, q0: np.ndarray, limit: np.ndarray | None) -> np.ndarray:
        """The filter's, with which it starts; ``limit`` (3,) rad/s is the gyro's range."""
        values = {"latitude": LATITUDE, "rest_time": 0.0, "stuck_time": self.stuck_time}
        values |= {f"q0[{i + 1}]": v for i, v in enumerate(q0)}
        values |= {f"std0[{i + 1}]": v for i, v in enumerate(STD0)}
        if limit is not None:
            values |= {f"gyro_error.saturation.limit[{i + 1}]": v for i, v in enumerate(limit)}
        return with_values(self.filter, self.filter.start, values)

    @property
    def stuck_time(self) -> float:
        """s of equal samples that mean a stuck sensor; 0, never, where one has no white noise."""
        sensors = (self.part.gyro, self.part.accel)
        return LEAST if all(WHITE in s.values and s.acts(WHITE) for s in sensors) else 0.0


@lru_cache(maxsize=4)
def system_of(settings: Settings) -> System:
    """The units of a campaign."""
    part = replace(settings.part, sample_rate=settings.sensor_rate)
    if SATURATING in settings.faults:
        part = part.with_sensor(part.gyro.with_values("saturation"))
    known = replace(part, sample_rate=settings.sensor_rate / settings.every)
    drawn = specimen_of(part, 0) if settings.specimens else part
    sections = None
    if settings.low_pass:
        sections = butter(2, CUT_OFF, fs=settings.sensor_rate, output="sos")
    return System(settings, part, drawn.block, part.block, attitude_ukf(known), sections)


def with_values(block: Block, p: np.ndarray, values: dict[str, float]) -> np.ndarray:
    """Parameters of a block with ``values`` by name."""
    at, p = {v.name: i for i, v in enumerate(block.parameters)}, p.copy()
    for name, value in values.items():
        p[at[name]] = value
    return p


def coefficients(part: Part) -> np.ndarray:
    """The values of a part's coefficients in the order of its block's parameters."""
    return np.concatenate([part.gyro.p, part.accel.p])
