"""What a reference attitude may be that is not what its columns say: its order, its axes."""

from __future__ import annotations

from itertools import product

import numpy as np

from pyimu.recording.column_map import BODY, ForeignMap

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
