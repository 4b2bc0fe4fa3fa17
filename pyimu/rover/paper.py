"""The four test drives of Hidalgo 2012, section 6.1, and what its table 6 prints of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

ANGLES = ("heading", "pitch", "roll")

TILT = 0.2
"""deg; what pitch and roll are to reach once the loop is closed."""


@dataclass(frozen=True)
class PaperDrive:
    """A drive: its ``name`` in ``pyimu.rover.drives``, what people call it, table 6 and a target.

    ``paper`` and ``target`` are largest errors in deg by angle; the target is what the filter is to
    reach once the loop is closed.
    """

    name: str
    title: str
    paper: Mapping[str, float]
    target: Mapping[str, float]


def _angles(heading: float, pitch: float, roll: float) -> Mapping[str, float]:
    return MappingProxyType(dict(zip(ANGLES, (heading, pitch, roll), strict=True)))


PAPER_DRIVES = (
    PaperDrive("straight", "straight line", _angles(0.35, 0.2, 0.1), _angles(0.35, TILT, TILT)),
    PaperDrive(
        "obstacle",
        "straight line over boulders",
        _angles(0.35, 0.2, 0.1),
        _angles(0.35, TILT, TILT),
    ),
    PaperDrive("ackermann", "Ackermann steering", _angles(1.4, 0.3, 0.3), _angles(0.4, TILT, TILT)),
    PaperDrive(
        "turn_on_spot", "turn on the spot", _angles(6.5, 0.2, 0.4), _angles(0.5, TILT, TILT)
    ),
)
"""Table 6 has one column for both straight lines."""
