"""What a receiver of satellites writes, among the names of columns: places and velocities."""

from __future__ import annotations

from collections.abc import Sequence

from pyimu.recording.columns import FIXES
from pyimu.recording.naming.name import named
from pyimu.recording.naming.words import DERIVED, TRUTHS
from pyimu.units import same_dimension

RECEIVERS = {"gps", "gnss", "ins", "rtk", "location", "loc", "pos", "position", "lla", "llh"} | {
    "nav",
    "geodetic",
    "msl",
    "wgs84",
}
"""Words that may stand beside one of a place."""

LATITUDES, LONGITUDES = {"lat", "latitude"}, {"lon", "lng", "long", "longitude"}
HEIGHTS = {"alt", "altitude", "height", "hmsl", "elevation"}

WAYS = {"n": "north", "e": "east", "d": "down", "u": "up"} | {
    way: way for way in ("north", "east", "down", "up")
}
VELOCITIES = {"v", "vel", "velocity"}
PER_SECOND = {"m", "s", "mps", "ms"}
"""What names have behind a velocity: ``vel_n_m_s``."""


def fix(header: Sequence[str]) -> dict[str, int]:
    """Positions of ``ref_latitude`` and ``ref_longitude``, and of ``ref_up`` where there is one;
    empty without the first two. Those that are called a reference go first.
    """
    found: dict[bool, dict[str, int]] = {True: {}, False: {}}
    latitude, longitude = FIXES["ref"]
    kinds = ((LATITUDES, latitude), (LONGITUDES, longitude), (HEIGHTS, "ref_up"))
    for position, cell in enumerate(header):
        name = named(cell)
        words = set(name.words)
        kind = next(((those, target) for those, target in kinds if words & those), None)
        if kind is None or words - kind[0] - RECEIVERS - TRUTHS:
            continue
        of = "m" if kind[1] == "ref_up" else "rad"
        if name.unit is None or same_dimension(name.unit, of):
            found[bool(words & TRUTHS)].setdefault(kind[1], position)
    return next((at for at in (found[True], found[False]) if {latitude, longitude} <= set(at)), {})


def velocities(header: Sequence[str]) -> dict[str, int]:
    """Positions of a velocity north, east and down or up by ``ref_velocity_north`` and so on
    (``vn``, ``vel_n_m_s``, ``velocity_north``); empty where not all three are there.
    """
    found: dict[str, int] = {}
    for position, cell in enumerate(header):
        name = named(cell)
        words = [w for w in name.words if w not in RECEIVERS | TRUTHS]
        if words and len(words[0]) == 2 and words[0][0] == "v":
            words = ["v", words[0][1], *words[1:]]
        ways = [WAYS[w] for w in words if w in WAYS]
        rest = set(words) - set(WAYS)
        if len(ways) != 1 or not rest & VELOCITIES or rest - VELOCITIES - PER_SECOND - {"ned"}:
            continue
        if not rest & DERIVED and (name.unit is None or same_dimension(name.unit, "m/s")):
            found.setdefault(f"ref_velocity_{ways[0]}", position)
    upright = {"ref_velocity_down", "ref_velocity_up"} & set(found)
    if not {"ref_velocity_north", "ref_velocity_east"} <= set(found) or not upright:
        return {}
    if len(upright) == 2:
        del found["ref_velocity_down"]
    return found
