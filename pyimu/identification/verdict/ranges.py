"""Samples beyond the range that a part declares, and those set to zero, in words."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.model.as_part import SENSORS
from pyimu.identification.rivals.instead import DEAD_ZONES
from pyimu.model.kinds import KINDS
from pyimu.report.numbers import quantity


def beyond(findings: Iterable[Finding]) -> tuple[str, ...]:
    """Of each sensor how far its samples go beyond the declared range: nothing that is looked for
    explains what a range that it was not set to takes away.
    """
    largest: dict[str, Finding] = {}
    for f in findings:
        if f.kind == "beyond_range":
            sensor = f.column.partition("_")[0]
            known = largest.get(sensor)
            if known is None or f.detail["largest"] > known.detail["largest"]:
                largest[sensor] = f
    return tuple(_said(kind, f) for kind, f in largest.items())


def _said(kind: str, f: Finding) -> str:
    size, limit = (quantity(f.detail[n], KINDS[kind].unit) for n in ("largest", "declared"))
    return (
        f"the {SENSORS[kind]}'s samples go up to {size}, beyond the {limit} that the part "
        "declares: declare the range that it was set to"
    )


def set_to_zero(findings: Iterable[Finding], named: Iterable[tuple[str, str]]) -> tuple[str, ...]:
    """Of each sensor below which size its samples are set to zero, where no dead zone of it is
    among the ``named`` effects, (sensor, effect).
    """
    silent = {sensor for sensor, effect in named if effect in DEAD_ZONES}
    least: dict[str, float] = {}
    for f in findings:
        sensor = f.column.partition("_")[0]
        if f.kind == "zeroed" and sensor not in silent:
            least[sensor] = min(least.get(sensor, np.inf), f.detail["least"])
    return tuple(
        f"the {SENSORS[kind]}'s samples below {quantity(size, KINDS[kind].unit)} are set to zero: "
        "a dead zone, by firmware, which a reference that follows quick motion would show"
        for kind, size in least.items()
    )
