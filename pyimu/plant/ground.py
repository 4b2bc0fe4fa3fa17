"""Height of the ground over the plane: waves of random direction, and boulders."""

from __future__ import annotations

import math

import casadi as ca

PRIME = 67108859
"""The largest prime below 2^26. A product of two residues is a whole number below 2^53, exact in
a double; and as it is 2 modulo 3, the cube is a permutation of the residues."""

WAVES = 8
"""Waves that make the ground."""

SHORTEST, LONGEST = 0.2, 1.5
"""m; lengths of the waves."""


def uniform(terrain, number: int):
    """A number in [0, 1) that looks random, the ``number``-th of the ``terrain``.

    Three times a constant is added and the cube taken modulo ``PRIME``, a permutation each: numbers
    of one place differ for all terrains. The constants are the fractional parts of the roots of 2,
    3 and 5 of ``PRIME``. All numbers on the way are whole and exact, on every platform.
    """
    x = terrain + 1
    for i, key in enumerate((2, 3, 5)):
        constant = math.floor(math.modf(math.sqrt(key))[0] * PRIME)
        x = ca.fmod(x + constant + (number * 7919 if i == 0 else number), PRIME)
        x = ca.fmod(ca.fmod(x * x, PRIME) * x, PRIME)
    return x / PRIME


def waves(terrain) -> ca.SX:
    """The waves (4 ``WAVES``,) of a terrain, for a root mean square height of 1 m.

    Of each: wave number to the east and to the north in rad/m, phase at the start in rad, amplitude
    in m. Directions and phases are uniform, the lengths one from each of equal parts of the
    logarithm; the amplitude is proportional to the length, as every length then has the same slope.
    """
    columns = [[uniform(terrain, 3 * i + j) for j in range(3)] for i in range(WAVES)]
    lengths = [
        SHORTEST * (LONGEST / SHORTEST) ** ((i + c[0]) / WAVES) for i, c in enumerate(columns)
    ]
    scale = ca.sqrt(2 / sum((x * x for x in lengths), 0))
    found = []
    for length, (_, direction, phase) in zip(lengths, columns, strict=True):
        number, angle = 2 * math.pi / length, 2 * math.pi * direction
        found += [number * ca.cos(angle), number * ca.sin(angle), 2 * math.pi * phase]
        found += [scale * length]
    return ca.vertcat(*found)


def wavy(found, east, north):
    """Height at a place of the ground of ``waves``."""
    return sum(
        (
            found[i + 3] * ca.sin(found[i] * east + found[i + 1] * north + found[i + 2])
            for i in range(0, 4 * WAVES, 4)
        ),
        0,
    )


def boulder(east, north, height, width):
    """Height by which a boulder lifts a wheel ``east`` and ``north`` of its middle.

    height (1 - (2 r / width)^2)^4 within ``width``, 0 around: what the centre of a wheel follows,
    whose radius rounds off the boulder's edges. Three derivatives are continuous.
    """
    inside = ca.fmax(1 - 4 * (east * east + north * north) / (width * width), 0)
    return height * inside * inside * inside * inside
