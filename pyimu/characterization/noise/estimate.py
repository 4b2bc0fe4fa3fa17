"""A number that data gave, with what is known of its error."""

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
        """Whether the interval contains it."""
        return self.low <= value <= self.high
