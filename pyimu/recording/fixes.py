"""Places as latitude and longitude, as receivers of satellites write them, made into metres."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.columns import FIXES

POLE, ROUND = np.pi / 2, 2 * np.pi
"""rad; no latitude, and no longitude, is beyond them."""


class Fixes:
    """The places of a file that come in batches, in metres north and east of the first of them.

    Those that a file measured and those of its reference count from one origin. Latitude and
    longitude that are both zero are a receiver's that has no fix yet, and missing.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._origin: tuple[float, float] | None = None
        self._columns: list[str] = []

    def metres(self, values: Mapping[str, np.ndarray]) -> Iterator[tuple[str, np.ndarray]]:
        """The groups, and their columns (n,), that latitude and longitude among the ``values`` (n,)
        rad make; the latitude is one of them.

        Raises UserError for a latitude beyond the poles.
        """
        for stem, fix in FIXES.items():
            if not set(fix) <= set(values):
                continue
            latitude, longitude = (values[name] for name in fix)
            self._check(fix, latitude, longitude)
            seen = np.isfinite(latitude) & np.isfinite(longitude)
            seen &= (latitude != 0) | (longitude != 0)
            if self._origin is None and seen.any():
                first = int(np.argmax(seen))
                self._origin = float(latitude[first]), float(longitude[first])
            if stem not in self._columns:
                self._columns.append(stem)
            north, east = np.full((2, len(seen)), np.nan)
            if self._origin is not None:
                north[seen], east[seen] = north_east(latitude[seen], longitude[seen], *self._origin)
            yield f"{stem}_north", north
            yield f"{stem}_east", east
            yield "latitude", np.where(seen, latitude, np.nan)

    def findings(self) -> list[Finding]:
        """Where the metres count from."""
        if self._origin is None:
            return []
        detail = dict(zip(("latitude", "longitude"), self._origin, strict=True))
        return [Finding("place_origin", f"{stem}_north", 1, detail) for stem in self._columns]

    def _check(self, fix: tuple[str, str], latitude: np.ndarray, longitude: np.ndarray) -> None:
        for name, column, most in zip(fix, (latitude, longitude), (POLE, ROUND), strict=True):
            size = float(np.nanmax(np.abs(column), initial=0.0))
            if size > most:
                raise UserError(
                    f"{self._path}: {name} goes to {np.degrees(size):.6g} deg, beyond "
                    f"{np.degrees(most):g}: are its numbers in another unit, in 1e-7 deg ([count], "
                    f'[scale] {name} = {{value = 1e-7, unit = "deg"}}), or degrees and minutes as '
                    "in NMEA (4807.038)?"
                )


def north_east(
    latitude: np.ndarray, longitude: np.ndarray, latitude0: float, longitude0: float
) -> tuple[np.ndarray, np.ndarray]:
    """m north and east (n,) of an origin, in the plane that touches the ellipsoid there; from rad.

    Groves 2013, eq. 2.106, 2.112 and 2.150 at no height; at a height h they are longer by h / R, at
    1,000 m by 0.016 %.
    """
    from pyimu.symbolic.earth import (  # it loads CasADi, and few files have such places
        ECCENTRICITY_SQUARED,
        EQUATORIAL_RADIUS,
    )

    def outward(phi):
        normal = EQUATORIAL_RADIUS / np.sqrt(1 - ECCENTRICITY_SQUARED * np.sin(phi) ** 2)
        return normal * np.cos(phi), (1 - ECCENTRICITY_SQUARED) * normal * np.sin(phi)

    (across, up), (across0, up0) = outward(latitude), outward(latitude0)
    turned = longitude - longitude0
    # cos - 1 without what a small angle cancels.
    toward = (across - across0) - 2 * across * np.sin(turned / 2) ** 2
    return np.cos(latitude0) * (up - up0) - np.sin(latitude0) * toward, across * np.sin(turned)
