"""The interval of a share."""

from __future__ import annotations

import math


def wilson(count: int, of: int, z: float = 1.959964) -> tuple[float, float]:
    """Wilson's 95 % interval of a probability from ``count`` of ``of`` (Wilson 1927)."""
    if not of:
        return 0.0, 1.0
    share, extra = count / of, z**2 / of
    centre = share + extra / 2
    width = z * math.sqrt(share * (1 - share) / of + extra / (4 * of))
    low, high = (centre - width) / (1 + extra), (centre + width) / (1 + extra)
    return max(0.0, low), min(1.0, high)


def shown(count: int, of: int) -> str:
    """``"12 of 20, .60 (.39 to .78)"``"""
    if not of:
        return "-"
    low, high = wilson(count, of)
    return f"{count} of {of}, {count / of:.3f} ({low:.3f} to {high:.3f})"
