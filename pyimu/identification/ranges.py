"""Samples beyond the range that a part declares, in words."""

from __future__ import annotations

from collections.abc import Iterable

from pyimu.errors import Finding
from pyimu.identification.as_part import SENSORS
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
