"""A number estimated from data, with its error."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Estimate:
    """A value with its standard error and interval, all in one unit."""

    value: float
    std: float
    low: float
    high: float

    def holds(self, value: float) -> bool:
        """Whether the interval contains ``value``."""
        return self.low <= value <= self.high
