"""What surrounds the rover beside the ground: the sun, the magnetic field, the temperature."""

from __future__ import annotations

import math

import casadi as ca


def hour_angle(time, start, solar_day):
    """Hour angle in rad of the sun ``time`` s after it was ``start``; 0 is noon, afternoons above.

    The mean sun's: it goes round once in ``solar_day`` s.
    """
    return start + 2 * math.pi / solar_day * time


def sun_direction(angle, declination, latitude) -> ca.SX:
    """Unit vector (3,) to the sun in east-north-up axes, for an hour angle; all in rad.

    Meeus 1998, Astronomical Algorithms, eq. 13.5 and 13.6, there as azimuth and altitude.
    """
    across = ca.cos(declination) * ca.cos(angle)
    c, s, up = ca.cos(latitude), ca.sin(latitude), ca.sin(declination)
    return ca.vertcat(
        -ca.cos(declination) * ca.sin(angle), up * c - across * s, up * s + across * c
    )


def magnetic_field(strength, dip, declination) -> ca.SX:
    """The field (3,) T in east-north-up axes, ``dip`` rad below the horizontal.

    Its horizontal part lies ``declination`` rad to the east of north.
    """
    level = strength * ca.cos(dip)
    return ca.vertcat(
        level * ca.sin(declination), level * ca.cos(declination), -strength * ca.sin(dip)
    )


def temperature(time, angle, start, rise, rise_time, swing, warmest):
    """Temperature in degC ``time`` s after the start, the sun's hour angle being ``angle`` rad.

    A body that warms itself up by ``rise`` K with the time constant ``rise_time`` s, in a place
    whose temperature swings by ``swing`` K around ``start`` degC and is highest at the hour angle
    ``warmest``.
    """
    return start + rise * (1 - ca.exp(-time / rise_time)) + swing * ca.cos(angle - warmest)
