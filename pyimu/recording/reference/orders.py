"""What a reference attitude may be that is not what its columns say: its order, its axes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import permutations, product

import numpy as np

from pyimu.recording.angles import angles_of, of_angles
from pyimu.recording.column_map import BODY, ForeignMap
from pyimu.recording.columns import ANGLES
from pyimu.recording.recording import Recording

ORDERS = {
    "scalar last (x, y, z, w)": lambda q: np.roll(q, 1, axis=1),
    "world to body": lambda q: q * [1.0, -1.0, -1.0, -1.0],
}
"""What a quaternion may be that is not body to world, scalar first, and how it becomes that.

A gyro tells neither from the other: one is the other between two constant turns, of the world and
of the mounting."""

_MAPS = {
    "a world of north-east-down": ForeignMap(world="ned"),
    "a body of forward-right-down": ForeignMap(body=BODY["frd"]),
    "north-east-down and forward-right-down": ForeignMap(body=BODY["frd"], world="ned"),
}

FRAMES = {name: lambda q, m=m: m.turn({"ref_q": q})["ref_q"] for name, m in _MAPS.items()}
"""Axes in which it may be, and how it comes into those of the package."""


def other_readings(q: np.ndarray) -> dict[str, np.ndarray]:
    """Attitudes (n, 4) by name that the columns ``q`` (n, 4) are in another order or other axes."""
    found = {name: turn(q) for name, turn in (ORDERS | FRAMES).items()}
    both = product(ORDERS.items(), FRAMES.items())
    return found | {f"{a}, in {b}": into(order(q)) for (a, order), (b, into) in both}


Reading = Callable[[np.ndarray], np.ndarray]
"""How attitudes (n, 4) become those that they are in another reading."""

SIGNS = tuple(product((1.0, -1.0), repeat=3))

DOWN = "north-east-down and forward-right-down"
"""Of ``FRAMES``: axes in which roll, pitch and yaw are written as often as in the package's own."""


def read_as(recording: Recording, reading: Reading) -> Recording:
    """A recording with its reference attitude in another reading, in the reference's own samples
    too.
    """
    source = recording.reference
    if source is not None and source.ref_q is not None:
        source = replace(source, ref_q=reading(source.ref_q))
    return replace(recording, ref_q=reading(recording.ref_q), reference=source)


def is_of_angles(recording: Recording) -> bool:
    """Whether the reference attitude was read from roll, pitch and yaw."""
    source = recording if recording.reference is None else recording.reference
    return source.stated.get("ref_q", "1") != "1"


def units_of_angles() -> dict[str, Reading]:
    """Attitudes whose roll, pitch and yaw are in another unit, by what is said then.

    Of angles in deg that were read as rad whole turns are lost. Those of a yaw turn the world; no
    roll and no pitch of a vehicle has them.
    """
    degree = np.pi / 180
    return {
        "are in rad, not in deg": lambda q: of_angles(angles_of(q) / degree),
        "are in deg, not in rad": lambda q: of_angles(_unwound(angles_of(q)) * degree),
    }


def _unwound(angles: np.ndarray) -> np.ndarray:
    """Angles (n, 3) without steps of whole turns from one known row to the next."""
    known = np.isfinite(angles).all(axis=1)
    angles[known] = np.unwrap(angles[known], axis=0)
    return angles


def orders_of_angles() -> Iterator[dict[str, Reading]]:
    """Attitudes whose roll, pitch and yaw stand in other columns, have other signs or turn in
    another sequence, by what is said then; those that a gyro does not tell apart together.

    Two signs that change at once turn world and body by half a turn each, and one of the six
    sequences of three turns is, likewise, one of columns. Angles of other columns are looked for in
    both axes in which files have them.
    """
    for order, odd in product(permutations(range(3)), (1.0, -1.0)):
        own = order == tuple(range(3))
        if own and odd > 0:
            continue
        signs = [s for s in SIGNS if np.prod(s) == odd]
        sequence = "".join("xyz"[k] for k in reversed(order))
        # Axes that are exchanged, and not turned, mirror the turns about them.
        mirrored = np.linalg.det(np.eye(3)[list(order)])
        turned = [s for s in SIGNS if np.prod(s) * mirrored * odd > 0]
        for into in (_as_it_is,) if own else (_as_it_is, FRAMES[DOWN]):
            found = {_named(order, s): _in_order(order, s, into) for s in signs}
            if not own:
                found |= {
                    f"{_named(range(3), s)}, in the sequence {sequence}": _in_order(
                        order, s, into, sequence
                    )
                    for s in turned
                }
            yield found


def _as_it_is(q: np.ndarray) -> np.ndarray:
    return q


def _named(order: Sequence[int], signs: Sequence[float]) -> str:
    *most, last = (f"{'-' if s < 0 else ''}{ANGLES[k]}" for k, s in zip(order, signs, strict=True))
    return f"{', '.join(most)} and {last}"


def _in_order(
    order: Sequence[int], signs: Sequence[float], into: Reading, sequence: str = ""
) -> Reading:
    """The columns in their ``order``, or else in a ``sequence`` that turns in it, with ``signs``;
    in axes which ``into`` leads to and back.
    """

    def reading(q: np.ndarray) -> np.ndarray:
        angles = _written(into(q), order[1])
        if sequence:
            return into(of_angles(angles * signs, sequence))
        return into(of_angles(angles[:, list(order)] * signs))

    return reading


def _written(q: np.ndarray, middle: int) -> np.ndarray:
    """The angles (n, 3) rad of attitudes (n, 4) as they were written, but for whole turns, where
    the turn between the two others stands in column ``middle``.

    Of the two triples of an attitude, (r, p, y) and half a turn further (r + pi, pi - p, y + pi),
    that in which it is at most a quarter of a turn, as files have it.
    """
    angles = angles_of(q)
    far = np.cos(angles[:, middle]) < 0
    angles[far] = np.pi + angles[far] * [1.0, -1.0, 1.0]
    return angles
