"""The part that a run has, and the values in which it differs from the nominal one."""

from __future__ import annotations

from pyimu.model.part import Part


def specimen_of(part: Part, seed: int) -> Part:
    """The specimen of that number."""
    return part


def values_of(part: Part, specimen: Part) -> dict[str, float]:
    """What is drawn of a specimen, by the names of the block's parameters with units."""
    return {}
