"""Findings of one kind, made in many pieces of a log, added up to those of the log."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any

from pyimu.errors import Finding

_RULES: Mapping[str, Callable[[Any, Any], Any]] = MappingProxyType(
    {
        "largest": max,
        "longest": max,
        "least": min,
        "first_row": min,
        "total": operator.add,
        "runs": operator.add,
    }
)
"""How a detail of two pieces becomes one of both; what is not here stays that of the first."""


class Tally:
    """Adds findings of the same kind, column and side; in the order in which the kinds came."""

    def __init__(self, findings: Iterable[Finding] = ()) -> None:
        self._sums: dict[tuple, Finding] = {}
        self.add(findings)

    def add(self, findings: Iterable[Finding]) -> None:
        for finding in findings:
            key = (finding.kind, finding.column, finding.detail.get("side"))
            known = self._sums.get(key)
            self._sums[key] = finding if known is None else _both(known, finding)

    def findings(self) -> tuple[Finding, ...]:
        return tuple(self._sums.values())


def _both(a: Finding, b: Finding) -> Finding:
    detail = dict(a.detail)
    for key in detail.keys() & b.detail.keys():
        if key == "rms":  # of ``count`` samples each
            detail[key] = math.sqrt(
                (a.count * detail[key] ** 2 + b.count * b.detail[key] ** 2) / (a.count + b.count)
            )
        elif key == "level":
            detail[key] = (min if detail.get("side") == "low" else max)(detail[key], b.detail[key])
        elif key in _RULES:
            detail[key] = _RULES[key](detail[key], b.detail[key])
    return Finding(a.kind, a.column, a.count + b.count, detail)
