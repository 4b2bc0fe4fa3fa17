"""The Earth's magnetic field in a place at a date, by the World Magnetic Model."""

from __future__ import annotations

import datetime
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pyimu.errors import UserError
from pyimu.recording.formats.reader import need

YEARS = (2015, 2030)
"""From the start of the one to that of the other the models, of five years each, are known."""

HEIGHTS = (-1e3, 850e3)
"""m above the WGS 84 ellipsoid, for which the model is made (WMM2025 technical report)."""

NANO = 1e-9

Date = str | datetime.date


@dataclass(frozen=True)
class WorldField:
    """The field by ``model``, its angles in rad, its strength in T.

    ``declination`` is positive to the east, ``dip`` downwards. Each ``_std`` is the model's own
    figure, over the surface of the Earth, of what it does not have: crust, disturbances, its own
    change (technical reports of WMM2015, 2020 and 2025, section on the error model). ``level_std``
    and ``upward_std`` T are those of the horizontal and the vertical part. It is of no room: iron
    in a wall changes it by more.
    """

    model: str
    declination: float
    declination_std: float
    strength: float
    strength_std: float
    dip: float
    dip_std: float
    level_std: float
    upward_std: float

    @property
    def parts(self) -> np.ndarray:
        """Horizontal and upward part (2,) in T."""
        return self.strength * np.array([math.cos(self.dip), -math.sin(self.dip)])

    @property
    def part_std(self) -> float:
        """T; root mean square of the standard deviations of the two parts."""
        return math.hypot(self.level_std, self.upward_std) / math.sqrt(2)

    def settings(self) -> dict[str, float]:
        """The parameters of the attitude filter that it gives."""
        return {
            "declination": self.declination,
            "field_strength": self.strength,
            "field_dip": self.dip,
            "field_strength_std": self.part_std,
        }


def world_field(place: Sequence[float], date: Date) -> WorldField:
    """The field in a ``place``, latitude and longitude in rad and height in m, at a date.

    A place without height is at sea level; a text is a date such as 2026-05-01. Raises UserError
    for a place or a date that is none, is outside of what the models cover, and where pygeomag,
    which has the models, is not installed.
    """
    latitude, longitude, height = checked_place(place)
    day = _day(date)
    pygeomag = need("pygeomag", "place", "the field of a place")
    model = pygeomag.GeoMag(base_year=day.year)
    found = model.calculate(
        glat=math.degrees(latitude),
        glon=math.degrees(longitude),
        alt=height / 1e3,
        time=pygeomag.decimal_year_from_date(day),
    )
    off = found.calculate_uncertainty()
    return WorldField(
        model.model,
        math.radians(found.d),
        math.radians(off.d),
        NANO * found.f,
        NANO * off.f,
        math.radians(found.i),
        math.radians(off.i),
        NANO * off.h,
        NANO * off.z,
    )


def checked_place(place: Sequence[float]) -> tuple[float, float, float]:
    """Latitude and longitude in rad and height in m of a place.

    Raises UserError for other than two or three finite numbers, and outside their bounds.
    """
    try:
        numbers = [float(v) for v in place]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) not in (2, 3) or not np.isfinite(numbers).all():
        raise UserError(
            f"place is {str(place)[:60]}, expected latitude and longitude in rad, and the height "
            "in m if it is known"
        )
    latitude, longitude, height = (*numbers, 0.0)[:3]
    if abs(latitude) > math.pi / 2:
        swapped = "; is it the longitude, which comes second?" if abs(longitude) < 1.6 else ""
        raise UserError(f"place: latitude {latitude:g}, expected -pi/2 to pi/2 rad{swapped}")
    if abs(longitude) > 2 * math.pi:
        raise UserError(f"place: longitude {longitude:g}, expected -2 pi to 2 pi rad")
    low, high = HEIGHTS
    if not low <= height <= high:
        raise UserError(f"place: height {height:g} m, expected {low:g} to {high:g} m")
    return latitude, math.remainder(longitude, 2 * math.pi), height


def _day(date: Date) -> datetime.date:
    """The day. Raises UserError for a text that is none, and one no model is made for."""
    if isinstance(date, datetime.datetime):
        date = date.date()
    elif not isinstance(date, datetime.date):
        try:
            date = datetime.date.fromisoformat(str(date))
        except ValueError:
            raise UserError(f"date '{str(date)[:40]}': expected one such as 2026-05-01") from None
    first, end = YEARS
    if not first <= date.year < end:
        raise UserError(
            f"date {date}: the World Magnetic Model is known here from {first}-01-01 to "
            f"{end - 1}-12-31; give the declination itself"
        )
    return date
