"""Units: a closed table of atoms and a small strict grammar over it.

A general unit parser reads ``g`` as gram and knows no ``deg/sqrt(h)``; here ``g`` is standard
gravity, and a spelling that is not in the table is an error that names the nearest one that is::

    product = power (("*" | "/") power)*         left to right: deg/h/sqrt(h) = deg/(h sqrt(h))
    power   = factor ["^" (integer | half)]          half: 0.5, 1/2, (-3/2)
    factor  = atom [integer] | "sqrt" "(" product ")" | "(" product ")"

What data sheets and the package's own reports print is read as well: degree and micro signs, roots
with their sign or as rtHz, raised powers, any sign of minus and fraction, and the names in
``ALIASES``, so that ``°/s``, ``mdps/√Hz``, ``µg/rtHz``, ``m/s2`` and ``ppm/°C`` are units, and
``LSB/°/s`` is LSB/(°/s). A blank or a point between two names multiplies where no sign of division
stands (``m s⁻²``, ``rad.s-1``); behind one it could mean either, and is an error. A trailing
``rms``, as in ``mg rms``, says how a figure was measured and is no part of its unit; so does
``(1σ)``.

The radian and the count of a converter (LSB) are kept as dimensions of their own, so that a column
in 1/s is not taken for a rate, nor one in counts for a pure number.
"""

from pyimu.units.conversion import DEGREES, FREEZING, convert, same_dimension, to_degc
from pyimu.units.grammar import Unit, UnitError, parse
from pyimu.units.near import did_you_mean, nearest, or_known
from pyimu.units.printed import plain
from pyimu.units.table import (
    ALIASES,
    ATOMS,
    BASES,
    IN_SI,
    LARGEST_EXPONENT,
    STANDARD_GRAVITY,
    ZERO_CELSIUS,
)

__all__ = [
    "ALIASES",
    "ATOMS",
    "BASES",
    "DEGREES",
    "FREEZING",
    "IN_SI",
    "LARGEST_EXPONENT",
    "STANDARD_GRAVITY",
    "ZERO_CELSIUS",
    "Unit",
    "UnitError",
    "convert",
    "did_you_mean",
    "nearest",
    "or_known",
    "parse",
    "plain",
    "same_dimension",
    "to_degc",
]
