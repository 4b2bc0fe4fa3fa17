"""What differs from run to run, each number a hash of the campaign's seed and the run's number."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.rover.campaign.faults import NONE, SATURATING, Fault
from pyimu.rover.campaign.motion import SOL, SOL_DURATION
from pyimu.rover.campaign.seeds import among, drawn, normal, uniform
from pyimu.rover.campaign.settings import Settings

START, RISE, WARMING = (-10.0, 40.0), (0.0, 15.0), (300.0, 900.0)
"""degC at the start of a drive, K by which a part warms up, and the time constant of that in s:
the temperatures of a body that is heated at night and a part's usual warming up. They are the
campaign's own choice; no source."""

MEAN, SWING = (-10.0, 20.0), (5.0, 20.0)
"""degC of a sol in its mean, and K by which it swings: that of a warm electronics box. They are the
campaign's own choice; no source."""

WARMEST = 0.5 + 1 / 12
"""Share of a sol from midnight until it is warmest, as ``RoverDrive`` has it: an hour angle of the
sun of 30 deg."""


@dataclass(frozen=True)
class Draws:
    """The draws of run ``number`` of a campaign of a ``seed``.

    ``profile`` are the numbers of its temperature; ``start_error`` (3,) is that of the
    attitude at the start, in standard deviations. The fault is one of the campaign's or none, each
    as likely, after a ``fault_share`` of the drive.
    """

    seed: int
    number: int
    noise_seed: int
    specimen_seed: int
    terrain: int
    profile: dict[str, float]
    start_error: np.ndarray
    fault_name: str
    fault_share: float
    fault_axis: int

    def temperature(self, time: np.ndarray) -> np.ndarray:
        """degC (n,) at ``time`` s."""
        start, rise, *time_constant = self.profile.values()
        if not time_constant:
            return start + rise * np.cos(2 * np.pi * (time / SOL_DURATION - WARMEST))
        return start - rise * np.expm1(-time / time_constant[0])

    def fault(self, begin: float, end: float) -> Fault:
        """The fault of a drive that lasts from ``begin`` to ``end`` s."""
        if self.fault_name == NONE:
            return Fault()
        if self.fault_name == SATURATING:  # from the start on
            return Fault(SATURATING, 0.0)
        return Fault(self.fault_name, begin + self.fault_share * (end - begin), self.fault_axis)

    def normals(self, what: str, size: int) -> np.ndarray:
        """Standard normals (size,) of the run."""
        return normal(self.seed, self.number, what, size) if size else np.zeros(0)


def draws_of(settings: Settings, number: int) -> Draws:
    """The draws of that run."""
    seed, known = settings.seed, (NONE, *settings.faults)
    return Draws(
        seed,
        number,
        drawn(seed, number, "noise"),
        drawn(seed, number, "specimen"),
        among(seed, number, "terrain", settings.terrains),
        _profile(settings, number),
        np.asarray(normal(seed, number, "start", 3)),
        known[among(seed, number, "fault", len(known))],
        uniform(seed, number, "fault time"),
        among(seed, number, "fault axis", 3),
    )


def _profile(settings: Settings, number: int) -> dict[str, float]:
    def between(what: str, ends: tuple[float, float]) -> float:
        return uniform(settings.seed, number, what, *ends)

    if settings.drive == SOL:
        return {
            "temperature_mean [degC]": between("temperature mean", MEAN),
            "temperature_swing [K]": between("temperature swing", SWING),
        }
    return {
        "temperature_start [degC]": between("temperature start", START),
        "temperature_rise [K]": between("temperature rise", RISE),
        "temperature_time [s]": between("temperature time", WARMING),
    }
