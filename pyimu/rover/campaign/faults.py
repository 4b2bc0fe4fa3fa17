"""What may go wrong in a run: the samples of a sensor that has failed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

STUCK_FOR = 20.0
"""s for which a stuck gyro gives one sample."""

WRONG_BY = np.deg2rad(10.0)
"""rad by which a heading sensor is wrong that has failed."""

OF_RANGE = 0.9
"""Share of the drive's largest rate at which a gyro of too small a range ends."""

NONE = "none"


@dataclass(frozen=True)
class Fault:
    """What fails, from ``time`` s on, and on which ``axis``."""

    name: str = NONE
    time: float = float("nan")
    axis: int = 0


@dataclass
class Samples:
    """What the sensors gave: ``gyro`` and ``accel`` (n, 3) each ``period`` s; ``heading`` (m,)
    and whether it is ``valid`` (m,), at ``time`` (m,) s.
    """

    gyro: np.ndarray
    accel: np.ndarray
    period: float
    heading: np.ndarray
    valid: np.ndarray
    time: np.ndarray


def _lost_axis(fault: Fault, samples: Samples) -> None:
    samples.gyro[round(fault.time / samples.period) :, fault.axis] = np.nan


def _stuck(fault: Fault, samples: Samples) -> None:
    first = round(fault.time / samples.period)
    samples.gyro[first : first + round(STUCK_FOR / samples.period)] = samples.gyro[first]


def _in_the_sensor(fault: Fault, samples: Samples) -> None:
    """Nothing more: the sensor itself has it."""


def _heading_lost(fault: Fault, samples: Samples) -> None:
    samples.valid[samples.time >= fault.time] = 0.0


def _heading_wrong(fault: Fault, samples: Samples) -> None:
    samples.heading[samples.time >= fault.time] += WRONG_BY


FAULTS: dict[str, Callable[[Fault, Samples], None]] = {
    "lost-axis": _lost_axis,
    "stuck": _stuck,
    "saturating": _in_the_sensor,
    "heading-lost": _heading_lost,
    "heading-wrong": _heading_wrong,
}
"""What fails: an axis of the gyro gives nothing any more; the gyro repeats a sample for
``STUCK_FOR``; its range ends below the drive's rates; the heading sensor gives nothing any more,
or is wrong by ``WRONG_BY``."""

SATURATING = "saturating"

NEEDS_HEADING = ("heading-lost", "heading-wrong")


def fail(fault: Fault, samples: Samples) -> None:
    """Change the samples into those of the sensor that failed."""
    if fault.name != NONE:
        FAULTS[fault.name](fault, samples)
