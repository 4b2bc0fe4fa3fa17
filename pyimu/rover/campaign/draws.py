"""What differs from run to run, each number a hash of the campaign's seed and the run's number."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.rover.campaign.faults import NONE, Fault
from pyimu.rover.campaign.motion import BEFORE, DRIVES, SOL, SOL_DURATION
from pyimu.rover.campaign.seeds import among, drawn, normal, uniform
from pyimu.rover.campaign.settings import Settings

START, RISE, WARMING = (-10.0, 40.0), (0.0, 15.0), (300.0, 900.0)
"""degC at the start of a drive, K by which a part warms up, and the time constant of that in s:
the temperatures of a body that is heated at night and a part's usual warming up. They are the
campaign's own choice; no source."""

MEAN, SWING, COLDEST = (-10.0, 20.0), (5.0, 20.0), 5.0 * 3600.0
"""degC of a sol in its mean, K by which it swings, and s after midnight at which it is coldest:
that of a warm electronics box. They are the campaign's own choice; no source."""


@dataclass(frozen=True)
class Draws:
    """The draws of run ``number`` of a campaign of a ``seed``.

    ``profile`` are the three numbers of its temperature; ``start_error`` (3,) is that of the
    attitude at the start, in standard deviations.
    """

    seed: int
    number: int
    noise_seed: int
    specimen_seed: int
    terrain: int
    profile: dict[str, float]
    start_error: np.ndarray
    fault: Fault

    def temperature(self, time: np.ndarray) -> np.ndarray:
        """degC (n,) at ``time`` s."""
        a, b, c = self.profile.values()
        if "temperature_swing [K]" in self.profile:
            return a - b * np.cos(2 * np.pi * (time - c) / SOL_DURATION)
        return a - b * np.expm1(-time / c)

    def normals(self, what: str, size: int) -> np.ndarray:
        """Standard normals (size,) of the run."""
        return normal(self.seed, self.number, what, size) if size else np.zeros(0)


def draws_of(settings: Settings, number: int) -> Draws:
    """The draws of that run."""
    seed = settings.seed
    return Draws(
        seed,
        number,
        drawn(seed, number, "noise"),
        drawn(seed, number, "specimen"),
        among(seed, number, "terrain", settings.terrains),
        _profile(settings, number),
        np.asarray(normal(seed, number, "start", 3)),
        _fault(settings, number),
    )


def _profile(settings: Settings, number: int) -> dict[str, float]:
    def between(what: str, ends: tuple[float, float]) -> float:
        return uniform(settings.seed, number, what, *ends)

    if settings.drive == SOL:
        return {
            "temperature_mean [degC]": between("temperature mean", MEAN),
            "temperature_swing [K]": between("temperature swing", SWING),
            "temperature_coldest [s]": COLDEST,
        }
    return {
        "temperature_start [degC]": between("temperature start", START),
        "temperature_rise [K]": between("temperature rise", RISE),
        "temperature_time [s]": between("temperature time", WARMING),
    }


def _fault(settings: Settings, number: int) -> Fault:
    """One of the campaign's faults or none, each as likely, some time in the drive."""
    seed, known = settings.seed, (NONE, *settings.faults)
    name = known[among(seed, number, "fault", len(known))]
    if name == NONE:
        return Fault()
    end = sum(m.duration for m in DRIVES[settings.drive]())
    time = uniform(seed, number, "fault time", BEFORE, end)
    return Fault(name, time, among(seed, number, "fault axis", 3))
