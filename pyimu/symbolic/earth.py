"""The Earth's rotation in the world frame."""

from __future__ import annotations

import casadi as ca

EARTH_RATE = 7.292115e-5
"""rad/s, WGS 84."""

EARTH_RADIUS = 6371008.8
"""m; mean radius of the Earth (IUGG)."""


def earth_rate(latitude, magnitude: float = EARTH_RATE):
    """Rate (3,) rad/s of the east-north-up frame against inertial space at ``latitude`` rad.

    Hidalgo 2012, equation of the Earth rotation vector, printed there in north-west-up axes: [cos,
    0, sin] of the latitude; Groves 2013, eq. 2.123, in north-east-down.
    """
    return magnitude * ca.vertcat(0, ca.cos(latitude), ca.sin(latitude))


def transport_rate(latitude, velocity, radius: float = EARTH_RADIUS):
    """Transport rate (3,) rad/s of the east-north-up frame against the Earth.

    The body moves at ``velocity`` (3,) m/s in that frame.

    Groves 2013, eq. 5.44, for a sphere of ``radius`` m and in east-north-up axes.
    """
    east, north = velocity[0] / radius, velocity[1] / radius
    return ca.vertcat(-north, east, east * ca.tan(latitude))


EQUATORIAL_RADIUS = 6378137.0
"""m, WGS 84."""

EQUATORIAL_GRAVITY, GRAVITY_SLOPE, ECCENTRICITY_SQUARED = (
    9.7803253359,
    1.93185265241e-3,
    6.69437999014e-3,
)
"""m/s^2, 1 and 1: of Somigliana's formula, WGS 84 (NIMA TR8350.2, third edition, table 3.4)."""


def normal_gravity(latitude):
    """Magnitude of gravity in m/s^2 on the ellipsoid at ``latitude`` rad.

    NIMA TR8350.2, eq. 4-1 (Somigliana); above the ellipsoid it falls by 3.086e-6 m/s^2 a metre.
    """
    square = ca.sin(latitude) ** 2
    bent = (1 - ECCENTRICITY_SQUARED * square) ** 0.5
    return EQUATORIAL_GRAVITY * (1 + GRAVITY_SLOPE * square) / bent
