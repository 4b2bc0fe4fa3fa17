"""The closed table of units, their aliases, and what is often taken for one of them."""

from __future__ import annotations

import math

STANDARD_GRAVITY = 9.80665
"""m/s^2, exact by definition (3rd CGPM, 1901)."""

LARGEST_EXPONENT = 150
"""Powers of ten that a unit's factor may have, so that its square and its inverse are numbers."""

ZERO_CELSIUS = 273.15
"""K, exact by definition."""

IN_SI: dict[str, dict[str, int]] = {
    "rad": {"rad": 1},
    "s": {"s": 1},
    "m": {"m": 1},
    "K": {"K": 1},
    "V": {"kg": 1, "m": 2, "s": -3, "A": -1},
    "T": {"kg": 1, "s": -2, "A": -1},
    "LSB": {},
}
"""The base units of this module in those of SI."""

BASES = tuple(IN_SI)
"""The base units, in the order of the exponents in ``Unit.dimension``."""

_DEG = math.pi / 180

KNOWN: dict[str, tuple[float, dict[str, int]]] = {
    "1": (1.0, {}),
    "ppm": (1e-6, {}),
    "%": (1e-2, {}),
    "rad": (1.0, {"rad": 1}),
    "mrad": (1e-3, {"rad": 1}),
    "urad": (1e-6, {"rad": 1}),
    "deg": (_DEG, {"rad": 1}),
    "mdeg": (1e-3 * _DEG, {"rad": 1}),
    "rev": (2 * math.pi, {"rad": 1}),
    "arcmin": (_DEG / 60, {"rad": 1}),
    "arcsec": (_DEG / 3600, {"rad": 1}),
    "s": (1.0, {"s": 1}),
    "ms": (1e-3, {"s": 1}),
    "us": (1e-6, {"s": 1}),
    "ns": (1e-9, {"s": 1}),
    "min": (60.0, {"s": 1}),
    "h": (3600.0, {"s": 1}),
    "day": (86400.0, {"s": 1}),
    "Hz": (1.0, {"s": -1}),
    "kHz": (1e3, {"s": -1}),
    "m": (1.0, {"m": 1}),
    "um": (1e-6, {"m": 1}),
    "mm": (1e-3, {"m": 1}),
    "cm": (1e-2, {"m": 1}),
    "km": (1e3, {"m": 1}),
    "ft": (0.3048, {"m": 1}),
    "mi": (1609.344, {"m": 1}),
    "kn": (1852 / 3600, {"m": 1, "s": -1}),
    "g": (STANDARD_GRAVITY, {"m": 1, "s": -2}),
    "mg": (1e-3 * STANDARD_GRAVITY, {"m": 1, "s": -2}),
    "ug": (1e-6 * STANDARD_GRAVITY, {"m": 1, "s": -2}),
    "Gal": (1e-2, {"m": 1, "s": -2}),
    "mGal": (1e-5, {"m": 1, "s": -2}),
    "K": (1.0, {"K": 1}),
    "degC": (1.0, {"K": 1}),
    "degF": (5 / 9, {"K": 1}),
    "V": (1.0, {"V": 1}),
    "mV": (1e-3, {"V": 1}),
    "T": (1.0, {"T": 1}),
    "mT": (1e-3, {"T": 1}),
    "uT": (1e-6, {"T": 1}),
    "nT": (1e-9, {"T": 1}),
    "gauss": (1e-4, {"T": 1}),
    "mgauss": (1e-7, {"T": 1}),
    "ugauss": (1e-10, {"T": 1}),
    "LSB": (1.0, {"LSB": 1}),
}

ATOMS = tuple(KNOWN)
"""Every spelling that the table knows."""

ALIASES = {
    "dps": "deg/s",
    "DPS": "deg/s",
    "mdps": "mdeg/s",
    "Deg": "deg",
    "dph": "deg/h",
    "rpm": "rev/min",
    "RPM": "rev/min",
    "kph": "km/h",
    "mph": "mi/h",
    "knot": "kn",
    "knots": "kn",
    "degree": "deg",
    "degrees": "deg",
    "radian": "rad",
    "radians": "rad",
    "arcsecond": "arcsec",
    "arcseconds": "arcsec",
    "arc-sec": "arcsec",
    "arcminute": "arcmin",
    "arcminutes": "arcmin",
    "arc-min": "arcmin",
    "sec": "s",
    "Sec": "s",
    "msec": "ms",
    "usec": "us",
    "nsec": "ns",
    "minute": "min",
    "minutes": "min",
    "second": "s",
    "seconds": "s",
    "hr": "h",
    "Hr": "h",
    "hrs": "h",
    "sps": "Hz",
    "SPS": "Hz",
    "gal": "Gal",
    "milli-g": "mg",
    "micro-g": "ug",
    "g0": "g",
    "g₀": "g",
    "gₙ": "g",
    "volt": "V",
    "volts": "V",
    "hour": "h",
    "hours": "h",
    "days": "day",
    "Gauss": "gauss",
    "mGauss": "mgauss",
    "Ga": "gauss",
    "mGa": "mgauss",
    "milligauss": "mgauss",
    "uGauss": "ugauss",
    "lsb": "LSB",
    "LSb": "LSB",
    "LSBs": "LSB",
    "count": "LSB",
    "counts": "LSB",
    "digit": "LSB",
    "digits": "LSB",
}
"""Names that data sheets use, in those of the table; each is one factor: LSB/dps = LSB/(deg/s)."""

HINTS = {
    "mG": "mgauss (field) or mg (gravity)",
    "G": "gauss (field) or g (gravity)",
    "Gs": "gauss (field) or g (gravity)",
    "mGs": "mgauss (field) or mg (gravity)",
    "bit": "LSB",
    "bits": "LSB",
    "code": "LSB",
    "codes": "LSB",
    "meter": "m",
    "metre": "m",
    "C": "degC",
    "celsius": "degC",
    "fahrenheit": "degF",
    "kelvin": "K",
    "rps": "rev/s or rad/s",
}
"""What common spellings outside the table are called in it; only for error messages."""
