"""Whether a recording's magnetometer can tell the heading, and what speaks against it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np

from pyimu.attitude.calibration import MagnetometerCalibration
from pyimu.attitude.filter.field_learning import NEW_PLACE
from pyimu.attitude.filter.variables import USUAL
from pyimu.attitude.world_field import WorldField
from pyimu.display.brief import Brief
from pyimu.errors import Finding
from pyimu.recording.quality.field_axes import field_findings
from pyimu.recording.quality.gyro_axes import gyro_findings
from pyimu.recording.recording import Recording
from pyimu.recording.reference.white_noise import white_noise
from pyimu.units import parse

EARTH = (22e-6, 67e-6)
"""T; least and largest strength of the Earth's field at its surface (World Magnetic Model 2020)."""

ROOM = 2.0
"""Factor by which a field indoors, or of a magnetometer that is not calibrated, may be outside."""

WITHIN = (16, 84)
"""Percentiles that are a standard deviation from the mean, of a normal quantity."""

MOST_TURNED = 75
"""Percentile of how much the times of a log have turned, more than which none of them counts."""

TINY = 1e-12
"""Keeps divisors from zero."""

OTHER = 0.05
"""Share by which the median strength may differ from the place's, or the strength from sample to
sample, before that is said: beyond it the field is another one by many times what the model leaves
open."""

UNITS = ("T", "gauss", "uT", "nT", "mT")
"""Units in which magnetometers are logged, the one that hardly anybody takes last."""

MISTAKEN = sorted(permutations(UNITS, 2), key=lambda pair: UNITS[-1] in pair)
"""Pairs of the unit in a header and that of its numbers, the likely ones first."""


@dataclass(frozen=True, repr=False)
class Magnetometer(Brief):
    """A recording's magnetometer: whether it is ``used``, and the ``findings`` about it.

    ``strength`` is the median of its samples' length in T, NaN without any, ``scatter`` the
    standard deviation of that length, and ``turning`` that of a component of what turns with the
    body, as the length shows it; ``calibration`` the one that was undone before, or None; ``world``
    the field of the place by the World Magnetic Model.
    """

    used: bool = False
    strength: float = float("nan")
    scatter: float = 0.0
    turning: float = 0.0
    findings: tuple[Finding, ...] = ()
    calibration: MagnetometerCalibration | None = None
    world: WorldField | None = None

    @property
    def is_uneven(self) -> bool:
        """Whether the strength differs by more than surroundings without iron make it."""
        return self.scatter > OTHER * self.strength

    def settings(self) -> dict[str, float]:
        """What the log tells the filter of its magnetometer before it begins."""
        name = "field_turning_std"
        return {name: max(self.turning, USUAL[name])} if self.used else {}

    def in_world(self, world: WorldField | None) -> Magnetometer:
        """The same in the field of a place, with a finding where the samples show another one."""
        if world is None:
            return self
        found = self.findings
        if self.used and abs(self.strength / world.strength - 1) > OTHER:
            detail = {"strength": self.strength, "model": world.strength}
            found += (Finding("mag_not_of_the_place", "mag", 1, detail),)
        return replace(self, world=world, findings=found)


def magnetometer_of(recording: Recording, wanted: bool) -> Magnetometer:
    """The magnetometer of a recording, not used where it is not ``wanted`` or cannot be."""
    mag = recording.mag
    if mag is None or not wanted:
        return Magnetometer()
    rows = mag[np.isfinite(mag).all(axis=1)]
    there = rows[np.any(rows != 0, axis=1)]
    if not len(there):
        kind = "mag_missing" if not len(rows) else "mag_zeros"
        return Magnetometer(findings=(Finding(kind, "mag", len(mag)),))
    strength = float(np.median(np.linalg.norm(there, axis=1)))
    dead = [n for n, v in zip("xyz", there.T, strict=True) if not v.any()]
    if dead:
        detail = {"axes": ", ".join(dead)}
        axis_missing = Finding("mag_axis_missing", "mag", len(mag), detail)
        return Magnetometer(False, strength, findings=(axis_missing,))
    if EARTH[0] / ROOM <= strength <= EARTH[1] * ROOM:
        found = _axes(recording)
        return Magnetometer(not found, strength, *_uneven(recording, there), found)
    other = _other_size(strength, recording.stated.get("mag"))
    return Magnetometer(False, strength, findings=(other,))


def _uneven(recording: Recording, rows: np.ndarray) -> tuple[float, float]:
    """Scatter and turning in T, as ``Magnetometer`` has them, of samples (n, 3)."""
    size = np.linalg.norm(rows, axis=1)
    white = white_noise(size[:, None]) if len(size) >= 8 else 0.0
    times = max(int((recording.time[-1] - recording.time[0]) / NEW_PLACE), 1)
    scatter = float(np.sqrt(_square(size, white)))
    # The scatter has what the place does beside.
    return scatter, min(_turning(rows, times, white), scatter)


def _square(size: np.ndarray, white: float) -> float:
    """Mean square in T^2 of what lengths (n,) are off their mean, beside ``white`` noise in T.

    Two thirds of the samples tell of it, as iron near by may bend the others.
    """
    low, high = np.percentile(size, WITHIN)
    return max(float(0.5 * (high - low)) ** 2 - white**2, 0.0)


def _turning(rows: np.ndarray, times: int, white: float) -> float:
    """Standard deviation in T of a component of what turns with the body of samples (n, 3).

    A bias adds to their length its part along the field, and so in proportion to how much the
    field's direction in the body has turned. Of so many ``times`` of the log each tells that, and
    their median counts: a field that is another one from one of them on spoils that one alone. The
    result is that of a component over all attitudes of the log.
    """
    size = np.linalg.norm(rows, axis=1)
    ways = rows / size[:, None]
    parts = np.array_split(np.arange(len(rows)), min(times, len(rows)))
    squares = np.array([_square(size[at], white) for at in parts])
    turned = np.array([max(_turned(ways[at]), TINY) for at in parts])
    # A field that changes looks like a turn, too.
    weight = np.minimum(turned, np.percentile(turned, MOST_TURNED))
    order = np.argsort(squares / turned)
    below = np.cumsum(weight[order])
    middle = order[np.searchsorted(below, below[-1] / 2)]
    return float(np.sqrt(squares[middle] / turned[middle] * _turned(ways)))


def _turned(ways: np.ndarray) -> float:
    """The sum of the variances of unit vectors (n, 3), 1 where they are all round."""
    return 1 - float(np.sum(np.mean(ways, axis=0) ** 2))


def _axes(recording: Recording) -> tuple[Finding, ...]:
    """What its turning says against the axes, by a gyro that nothing contradicts."""
    found = field_findings(recording)
    return () if found and gyro_findings(recording) else found


def _other_size(strength: float, header: str | None) -> Finding:
    """The finding about a field whose ``strength`` in T is not the Earth's.

    Numbers in gauss under a header of tesla, say, are 10^4 times too large. What the ``header``
    states is known of a file alone.
    """
    detail: dict[str, float | str] = {"strength": strength}
    pairs = MISTAKEN if header is None else [(header, right) for right in UNITS]
    for stated, right in pairs:
        true = strength * parse(right).factor / parse(stated).factor
        if EARTH[0] <= true <= EARTH[1]:
            return Finding("mag_unit", "mag", 1, detail | {"stated": stated, "as": right})
    return Finding("mag_strength", "mag", 1, detail)
