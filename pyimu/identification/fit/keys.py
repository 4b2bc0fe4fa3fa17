"""Names of the columns of a regression."""

from __future__ import annotations

from pyimu.model.sensor import Sensor, Slot

Key = tuple
"""Name of a column: ("slot", effect, parameter, index), ("bias", trial, axis), ("rotation", trial,
axis) or ("scan", ...)."""


def slot_key(slot: Slot) -> Key:
    return ("slot", slot.effect, slot.parameter, slot.index)


def slot_keys(sensor: Sensor, effect: str) -> frozenset[Key]:
    """Keys of all coefficients of an effect that can be estimated."""
    one = Sensor(sensor.kind, {effect: {}})
    return frozenset(slot_key(s) for s in one.slots if not s.definition.reference)
