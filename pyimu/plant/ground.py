"""Height of the ground over the plane: waves of random direction, and boulders."""

from __future__ import annotations

import math
from dataclasses import dataclass

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


@dataclass(frozen=True)
class Phase:
    """The phase of a wave at a place that moves: cosine and sine, and two derivatives in time."""

    cosine: ca.SX
    sine: ca.SX
    rate: ca.SX
    acceleration: ca.SX

    @classmethod
    def of(cls, angle, rate, acceleration, amplitude=1.0) -> Phase:
        return cls(amplitude * ca.cos(angle), amplitude * ca.sin(angle), rate, acceleration)

    def __add__(self, other: Phase) -> Phase:
        """The sum of two phases: their cosines and sines multiply as complex numbers."""
        return Phase(
            self.cosine * other.cosine - self.sine * other.sine,
            self.sine * other.cosine + self.cosine * other.sine,
            self.rate + other.rate,
            self.acceleration + other.acceleration,
        )

    def __neg__(self) -> Phase:
        return Phase(self.cosine, -self.sine, -self.rate, -self.acceleration)

    def height(self) -> tuple:
        """The sine and its first two derivatives."""
        square = self.rate * self.rate
        return (
            self.sine,
            self.cosine * self.rate,
            self.cosine * self.acceleration - self.sine * square,
        )


def wavy(found, plane: tuple, offsets, roughness) -> list[list]:
    """Heights m of a ground at ``offsets`` (forward, left) m from a body, and two derivatives each.

    ``found`` are the ``waves``; ``plane`` are the body's place and heading (east, north, rad) and
    their first and second derivatives.

    The phase at an offset is that of the body, plus one for the way forward, plus one for the way
    to the left, whose sines and cosines are taken once each. Ahead of a body that turns, the wave
    number k along it grows by the turn rate times that to its left, and this falls by as much.
    """
    here, first, second = plane
    c, s = ca.cos(here[2]), ca.sin(here[2])
    turn, gain, square = first[2], second[2], first[2] * first[2]
    totals = [[0, 0, 0] for _ in offsets]
    for i in range(0, 4 * WAVES, 4):
        east, north, phase, amplitude = (found[i + j] for j in range(4))
        at = Phase.of(
            east * here[0] + north * here[1] + phase,
            east * first[0] + north * first[1],
            east * second[0] + north * second[1],
            roughness * amplitude,
        )
        ahead, aside = c * east + s * north, c * north - s * east
        forward = _offset(
            ahead, turn * aside, gain * aside - square * ahead, {x for x, _ in offsets}
        )
        left = _offset(
            aside, -turn * ahead, -gain * ahead - square * aside, {y for _, y in offsets}
        )
        sides = {y: at + left[y] if y else at for y in left}
        for total, (x, y) in zip(totals, offsets, strict=True):
            there = sides[y] + forward[x] if x else sides[y]
            for j, height in enumerate(there.height()):
                total[j] += height
    return totals


def _offset(number, rate, acceleration, lengths) -> dict[float, Phase]:
    """The phase by each length for a wave number and its derivatives; of opposite ones only one."""
    found = {abs(x): Phase.of(*(abs(x) * n for n in (number, rate, acceleration))) for x in lengths}
    return {x: found[x] if x >= 0 else -found[-x] for x in lengths}


def boulder(square, height, width):
    """Height by which a boulder lifts a wheel at the squared distance ``square`` from its middle.

    height (1 - (2 r / width)^2)^4 within ``width``, 0 around: what the centre of a wheel follows,
    whose radius rounds off the boulder's edges. Three derivatives are continuous.
    """
    inside = ca.fmax(1 - square * reciprocal(width * width / 4), 0)
    return height * inside * inside * inside * inside
