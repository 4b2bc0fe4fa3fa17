"""The celestial bodies on which a rover may drive: gravity, rotation, day and magnetic field."""

from __future__ import annotations

from dataclasses import dataclass

from pyimu.symbolic.earth import EARTH_RATE
from pyimu.units import STANDARD_GRAVITY


@dataclass(frozen=True)
class CelestialBody:
    """What of a planet or a moon enters the motion on it.

    ``gravity`` m/s^2 at its surface, ``rotation_rate`` rad/s against inertial space, ``solar_day``
    s from noon to noon, and its magnetic field: ``field_strength`` T, ``field_dip`` rad below the
    horizontal, ``field_declination`` rad to the east of north.
    """

    name: str
    gravity: float
    rotation_rate: float
    solar_day: float
    field_strength: float = 0.0
    field_dip: float = 0.0
    field_declination: float = 0.0


BODIES = {
    body.name: body
    for body in (
        CelestialBody("Earth", STANDARD_GRAVITY, EARTH_RATE, 86400.0, 48.957e-6, 1.17308, 2.09e-4),
        CelestialBody("Mars", 3.728, 7.088218e-5, 88775.244),
        CelestialBody("Moon", 1.624, 2.661699e-6, 2551442.9),
    )
}
"""By name. Gravity of the Earth is standard gravity, that of Mars and Moon G M / R^2 of NASA's
planetary fact sheets (4.28284e13 m^3/s^2 and 3389.5 km, 4.9028e12 m^3/s^2 and 1737.4 km). Rotation
of the Earth: WGS 84; of Mars and Moon: Archinal et al. 2018, tables 1 and 2 (350.891982 and
13.17635815 deg a day). Solar days: 24 h by definition; Allison and McEwen 2000 (24 h 39 min
35.244 s); the mean synodic month of 29.530589 days (Astronomical Almanac). The Earth's field is
that of the World Magnetic Model 2010 in Noordwijk (52.22 deg north, 4.42 deg east, middle of 2011),
where the paper's rover drove; Mars and Moon have no field of their own."""
