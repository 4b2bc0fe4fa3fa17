"""Height of the ground over the plane: waves of random direction, and boulders."""

from __future__ import annotations

import math

import casadi as ca

from pyimu.symbolic.linear import reciprocal

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


def wavy(found, place, heading, offsets, moving) -> list[tuple]:
    """Height at ``offsets`` (forward, left) m from a place, and its first two derivatives in time.

    ``found`` are the ``waves``, ``place`` is (east, north) and the offsets lie along ``heading``;
    ``moving`` are the velocity and the acceleration (2,) of each offset's end.

    The phase at an offset is that of the place, plus one for the way forward, plus one for the way
    to the left: their sines and cosines are taken once, and multiplied as complex numbers.
    """
    c, s = ca.cos(heading), ca.sin(heading)
    totals = [(0, 0, 0)] * len(offsets)
    for i in range(0, 4 * WAVES, 4):
        east, north, phase, amplitude = (found[i + j] for j in range(4))
        here = _turn(east * place[0] + north * place[1] + phase)
        forward = _turns(c * east + s * north, [x for x, _ in offsets])
        left = _turns(c * north - s * east, [y for _, y in offsets])
        for j, (x, y) in enumerate(offsets):
            cosine, sine = _product(_product(here, left[y]), forward[x])
            first, second = (east * v[0] + north * v[1] for v in moving[j])
            along, across = amplitude * cosine, amplitude * sine
            totals[j] = (
                totals[j][0] + across,
                totals[j][1] + along * first,
                totals[j][2] + along * second - across * first * first,
            )
    return totals


def _turn(angle) -> tuple:
    """Cosine and sine."""
    return ca.cos(angle), ca.sin(angle)


def _turns(number, lengths) -> dict[float, tuple]:
    """Cosine and sine of ``number`` rad/m times each length, of opposite ones taken once."""
    found = {abs(x): _turn(number * abs(x)) if x else (1, 0) for x in lengths}
    return {x: (found[abs(x)][0], math.copysign(1, x) * found[abs(x)][1]) for x in lengths}


def _product(a: tuple, b: tuple) -> tuple:
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]


def boulder(east, north, height, width):
    """Height by which a boulder lifts a wheel ``east`` and ``north`` of its middle.

    height (1 - (2 r / width)^2)^4 within ``width``, 0 around: what the centre of a wheel follows,
    whose radius rounds off the boulder's edges. Three derivatives are continuous.
    """
    inside = ca.fmax(1 - (east * east + north * north) * reciprocal(width * width / 4), 0)
    return height * inside * inside * inside * inside
