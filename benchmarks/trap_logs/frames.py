"""Traps of frames and units: numbers that mean something else than their names say."""

from __future__ import annotations

import numpy as np
from generators import rotation

from trap_logs.log import Columns, Log, new_scene

HALF_TURN = np.array([0.0, 1.0, 0.0, 0.0])
"""About x: of forward-left-up it makes forward-right-down."""


def reference_of_aircraft(rng) -> Log:
    """An attitude of forward-right-down axes in north-east-down."""
    scene = new_scene(rng)
    diagonal = np.array([0.0, np.sqrt(0.5), np.sqrt(0.5), 0.0])
    q = rotation.product(rotation.product(diagonal, scene.attitude()), HALF_TURN)
    return scene.log(scene.sensed() | {"ref_q": q}, "mounting", figures={"angle": np.pi})


def reference_left_handed(rng) -> Log:
    """An attitude in axes whose y counts the other way, as of a games engine."""
    scene = new_scene(rng)
    q = scene.attitude() * [1.0, -1.0, 1.0, -1.0]
    return scene.log(scene.sensed() | {"ref_q": q}, "mounting", figures={"angle": np.pi})


def _misread(rng, misread) -> Log:
    """Two logs of one part, of which the second's columns (n, 3) of the gyro are ``misread``."""
    one = new_scene(rng)
    first, second = (s.sensed() | {"ref_q": s.attitude()} for s in (one, one.again()))
    changed: Columns = second | {"gyro": misread(second["gyro"])}
    return one.log((first, changed), "misread", figures={"log": 1})


def axes_exchanged_in_one(rng) -> Log:
    return _misread(rng, lambda gyro: gyro[:, [1, 0, 2]])


def degrees_in_one(rng) -> Log:
    return _misread(rng, np.degrees)


def full_scale_doubled_in_one(rng) -> Log:
    return _misread(rng, lambda gyro: 2 * gyro)


def full_scale_doubled(rng) -> Log:
    """The counts of the gyro were taken for those of a range twice as large."""
    scene = new_scene(rng)
    columns = scene.sensed() | {"ref_q": scene.attitude()}
    columns["gyro"] = 2 * columns["gyro"]
    return scene.log(columns, "misread", figures={"log": 0})


TRAPS = (
    reference_of_aircraft,
    reference_left_handed,
    axes_exchanged_in_one,
    degrees_in_one,
    full_scale_doubled_in_one,
    full_scale_doubled,
)
