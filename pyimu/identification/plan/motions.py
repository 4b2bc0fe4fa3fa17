"""The library of motions and temperature profiles that can be measured next.

Each is a motion of a rigid body, whose force and attitude follow from its rate and acceleration:
what a person, a rate table, a vehicle, a shaker or a climatic chamber can do with a part. It is
made for a part, whose ranges it keeps to.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyimu.identification.plan.kinematics import (
    TURN_OVER,
    Piece,
    joined_pieces,
    rests,
    sine,
    steps,
    times,
    turned_over,
)
from pyimu.model.sensor import Sensor
from pyimu.units import STANDARD_GRAVITY

PEAK, TURN, TURNING = np.radians(90.0), 10.0, 60.0
"""rad/s, s and s: what a hand or a simple turntable does; a saturation below keeps the peak at 0.8
of it."""

RATES = np.radians((30.0, 90.0, 180.0))
"""rad/s; steady rates of a rate table."""

SHARE = 0.8
"""Of a sensor's range that a motion uses."""

WARMING, CYCLE = 20.0, 1800.0
"""K and s; a refrigerator or a warm room, and back."""

LYING = 60.0
"""s; in each of six positions."""

REST = 3600.0
"""s."""

BY_HAND, DRIVING, SHAKING = 120.0, 300.0, 40.0
"""s; of a tumble, of a drive, and along each axis."""

SHAKE, SWEEP = 20.0, (4.0, 8.0)
"""m/s^2 and Hz; of a shaker."""

SUPPLY = 0.1
"""V; by which the supply is raised and lowered."""

FACES = np.concatenate([np.eye(3), -np.eye(3)])


@dataclass(frozen=True)
class Limits:
    """What a motion may not exceed: rad/s about and m/s^2 along any axis."""

    rate: float = np.inf
    force: float = np.inf

    @classmethod
    def of(cls, *sensors: Sensor) -> Limits:
        """The share of the ranges of a part's sensors that a motion uses."""
        return cls(**{name: _range(s) for s in sensors for name in _named(s.kind)})


@dataclass(frozen=True)
class Motion:
    """A motion of the library: a ``name`` to call it by, what to do in words, its ``duration`` in
    s, and ``moves(h, limits)``, its rate and acceleration (n, 3) every ``h`` s.

    ``still`` says that it is at rest throughout, so that rows of a second say all there is;
    ``warm`` that the temperature goes up and down meanwhile, ``supply`` that the supply does.
    ``fixed`` says that the reference's axes are known to be the sensor's, as on a table;
    ``driven`` says that a machine makes it as it is written down; ``frequency`` [Hz] is where it
    shows most.
    """

    name: str
    text: str
    duration: float
    frequency: float
    moves: Callable[[float, Limits], Piece]
    still: bool = False
    warm: bool = False
    supply: bool = False
    fixed: bool = True
    driven: bool = False


def _named(kind: str) -> tuple[str, ...]:
    return {"gyro": ("rate",), "accel": ("force",)}[kind]


def _range(sensor: Sensor) -> float:
    found = sensor.reading("ceiling")
    limit = sensor.values[found[0]][found[1]] if found else np.zeros(3)
    return float(min([np.inf, *(SHARE * limit[limit > 0])]))


# What moves


def _rests(duration: float) -> Callable[[float, Limits], Piece]:
    return lambda h, limits: rests(duration, h)


def _positions(each: float, rounds: int = 1) -> Callable[[float, Limits], Piece]:
    """Each of six faces up in turn, level at the end."""

    def moves(h: float, limits: Limits) -> Piece:
        order = [FACES[k] for k in (2, 0, 1, 5, 3, 4)] * rounds
        pieces = []
        for up, following in zip(order, [*order[1:], FACES[2]], strict=True):
            pieces += [rests(each, h), turned_over(up, following, h)]
        return joined_pieces(pieces)

    return moves


def _axes_up(turned: Callable[[int, float, Limits], Piece], offset: int = 0, rounds: int = 1):
    """Each axis is turned about in turn, with the axis ``offset`` places after it up."""

    def moves(h: float, limits: Limits) -> Piece:
        up, pieces = FACES[2], []
        for k in (0, 1, 2) * rounds:
            wanted = FACES[(k + offset) % 3]
            if not np.array_equal(up, wanted):
                pieces.append(turned_over(up, wanted, h))
            pieces.append(turned(k, h, limits))
            up = wanted
        return joined_pieces([*pieces, turned_over(up, FACES[2], h)])

    return moves


def _sine(axis: int, h: float, limits: Limits) -> Piece:
    return sine(axis, min(PEAK, limits.rate), TURN, TURNING, h)


def _steps(each: float) -> Callable[[int, float, Limits], Piece]:
    def turned(axis: int, h: float, limits: Limits) -> Piece:
        levels = [s * min(r, limits.rate) for r in RATES for s in (1, -1)]
        return steps(axis, levels, each, h)

    return turned


def _tones(t: np.ndarray, tones: tuple[float, ...], phase: float) -> np.ndarray:
    """A sum of sines (n,) of no common period, of unit variance."""
    waves = [np.sin(2 * np.pi * f * t + phase + 2.4 * k) for k, f in enumerate(tones)]
    return np.sum(waves, axis=0) * np.sqrt(2 / len(tones))


def _eased(t: np.ndarray, duration: float) -> np.ndarray:
    """0 at both ends, 1 from 2 s on."""
    return 0.5 - 0.5 * np.cos(np.pi * np.clip(np.minimum(t, duration - t) / 2.0, 0.0, 1.0))


def _by_hand(h: float, limits: Limits) -> Piece:
    t = times(BY_HAND, h)
    share = _eased(t, BY_HAND)[:, None]
    rate = [_tones(t, f, p) for f, p in (((0.11, 0.31, 0.53), 0.0), ((0.13, 0.29, 0.61), 1.0))]
    rate.append(_tones(t, (0.17, 0.37, 0.47), 2.0))
    push = [_tones(t, (0.7 + 0.1 * k, 1.3 + 0.1 * k), k) for k in range(3)]
    # Three sines of unit variance together reach sqrt(6) at the most.
    size = min(1.2, limits.rate / np.sqrt(6))
    return size * share * np.column_stack(rate), share * np.column_stack(push)


def _drive(h: float, limits: Limits) -> Piece:
    t = times(DRIVING, h)
    share = _eased(t, DRIVING)[:, None]
    turn = min(0.4, limits.rate / np.sqrt(6)) * _tones(t, (0.023, 0.07, 0.19), 0.0)
    ripple = [0.08 * _tones(t, (1.1 + 0.3 * k, 2.3, 3.7), k) for k in range(2)]
    push = [0.3 * _tones(t, (0.05 + 0.02 * k, 1.7, 4.1), k) for k in range(3)]
    return share * np.column_stack([*ripple, turn]), share * np.column_stack(push)


def _shaking(limits: Limits) -> float:
    """m/s^2; what gravity leaves of the range."""
    return float(min(SHAKE, max(limits.force - STANDARD_GRAVITY, 0.0)))


def _shake(h: float, limits: Limits) -> Piece:
    """Along each axis in turn, level, a sine that sweeps up and down."""
    t = times(SHAKING, h)
    low, high = SWEEP
    middle, half = 0.5 * (high + low), 0.5 * (high - low)
    phase = (
        2 * np.pi * (middle * t - half * SHAKING / (2 * np.pi) * np.cos(2 * np.pi * t / SHAKING))
    )
    push = _shaking(limits) * _eased(t, SHAKING) * np.sin(phase)
    pieces = [(np.zeros((len(t), 3)), np.outer(push, np.eye(3)[k])) for k in range(3)]
    return joined_pieces([p for piece in pieces for p in (piece, rests(5.0, h))])


def _in_a_cycle(moves: Callable[[float, Limits], Piece]) -> Callable[[float, Limits], Piece]:
    """Moves, and rest until the cycle of temperature is over."""

    def filled(h: float, limits: Limits) -> Piece:
        done = moves(h, limits)
        return joined_pieces([done, rests(CYCLE - len(done[0]) * h, h)])

    return filled


# The library


ABOUT = "about x, about y and about z"


def library(limits: Limits = Limits()) -> tuple[Motion, ...]:
    """All motions, those that need least first, said as they are within ``limits``."""
    said = dict.fromkeys(f"{np.degrees(min(r, limits.rate)):.0f}" for r in RATES)
    rates = ", ".join(said)
    return (*_lying(), *_turned(limits, rates), *_moved(limits), *_warmed(rates), _supplied())


def _lying() -> tuple[Motion, ...]:
    """At rest, in one position or several."""
    return (
        Motion(
            "rest", f"let the part rest for {REST / 60:g} min", REST, 1 / REST, _rests(REST), True
        ),
        Motion(
            "six_positions",
            f"let the part lie on each of its six faces, {LYING:g} s each: gravity is the "
            "reference",
            6 * (LYING + TURN_OVER),
            1 / LYING,
            _positions(LYING),
        ),
    )


def _turned(limits: Limits, rates: str) -> tuple[Motion, ...]:
    """On a rate table."""
    peak = np.degrees(min(PEAK, limits.rate))
    return (
        Motion(
            "table_sines",
            f"turn {ABOUT}, each up and for {TURNING:g} s to and fro with "
            f"{peak:.0f} deg/s at the most, against a reference",
            3 * TURNING + 4 * TURN_OVER,
            1 / TURN,
            _axes_up(_sine),
            driven=True,
        ),
        Motion(
            "table_steps",
            f"turn {ABOUT}, each up, with {rates} deg/s one way and the other, 10 s each, on a "
            "rate table",
            3 * 60.0 + 4 * TURN_OVER,
            0.05,
            _axes_up(_steps(10.0)),
            driven=True,
        ),
        Motion(
            "table_level",
            f"turn {ABOUT}, each level, with {rates} deg/s one way and the other, 10 s each, on a "
            "rate table whose axis is level",
            3 * 60.0 + 4 * TURN_OVER,
            0.25,
            _axes_up(_steps(10.0), 1),
            driven=True,
        ),
    )


def _moved(limits: Limits) -> tuple[Motion, ...]:
    """By hand, on a vehicle, on a shaker."""
    shake = _shaking(limits)
    return (
        Motion(
            "by_hand",
            f"turn the part in the hand about all axes at once, to all sides, for {BY_HAND:g} s, "
            "with its attitude tracked",
            BY_HAND,
            0.3,
            _by_hand,
            fixed=False,
        ),
        Motion(
            "drive",
            f"drive for {DRIVING / 60:g} min with turns, with the attitude tracked",
            DRIVING,
            0.07,
            _drive,
            fixed=False,
        ),
        Motion(
            "shaker",
            f"shake along x, along y and along z for {SHAKING:g} s each with {shake:.0f} m/s² at "
            f"{SWEEP[0]:g} to {SWEEP[1]:g} Hz, level",
            3 * (SHAKING + 5.0),
            0.5 * sum(SWEEP),
            _shake,
            driven=True,
        ),
    )


def _warmed(rates: str) -> tuple[Motion, ...]:
    """In a climatic chamber."""
    warmed = f"while it is warmed by {WARMING:g} K and cools again within {CYCLE / 60:g} min"
    in_cycle = int(CYCLE // (6 * (45.0 + TURN_OVER)))
    rounds = int(CYCLE // (3 * (60.0 + TURN_OVER)))
    return (
        Motion(
            "rest_warmed",
            f"let the part rest {warmed}",
            CYCLE,
            1 / CYCLE,
            _rests(CYCLE),
            True,
            warm=True,
        ),
        Motion(
            "six_positions_warmed",
            f"let the part lie on each of its six faces, 45 s each, over and over {warmed}",
            CYCLE,
            1 / CYCLE,
            _in_a_cycle(_positions(45.0, in_cycle)),
            warm=True,
        ),
        Motion(
            "table_steps_warmed",
            f"turn {ABOUT}, each up, with {rates} deg/s one way and the other, 10 s each, over and "
            f"over on a rate table {warmed}",
            CYCLE,
            1 / CYCLE,
            _in_a_cycle(_axes_up(_steps(10.0), 0, rounds)),
            warm=True,
            driven=True,
        ),
    )


def _supplied() -> Motion:
    """At rest, with a supply that changes."""
    return Motion(
        "supply_steps",
        f"let the part rest for 5 min while its supply is raised and lowered by {SUPPLY:g} V "
        "every 30 s",
        300.0,
        1 / 60.0,
        _rests(300.0),
        True,
        supply=True,
    )
