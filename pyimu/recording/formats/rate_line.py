"""A sample rate that a line of comment states."""

from __future__ import annotations

import re

_RATE = re.compile(
    r"(?<![a-z])(?:(?:(?:update|sampl[a-z]*|output|data)[\s_-]*(?:data[\s_-]*)?(?:rate|freq[a-z]*)"
    r"|odr|fs)(?:\W{1,4}([\d.]+)\s*(k?)Hz|[\s_]*[(\[]?(k?)Hz[)\]]?\W{1,4}([\d.]+))"
    r"|date format \S+ at ([\d.]+)\s*(k?)Hz)",
    re.I,
)
"""With its unit behind the number or behind the name, and as the first line of ActiGraph's tables
says it."""

_PERIOD = re.compile(r"\bsampling (?:rate|time|period|interval) *[:=] *([\d.]+) *ms\b", re.I)
"""The time between samples, which HyperIMU calls their rate."""


def rate_in(line: str) -> float | None:
    """Hz; the sample rate that a line says, as such or as the time between samples."""
    match, period = _RATE.search(line), _PERIOD.search(line)
    try:
        if match:
            number, kilo = (match[1] or match[4] or match[5]), (match[2] or match[3] or match[6])
            value = float(number) * (1000 if kilo else 1)
        else:
            value = 1000 / float(period[1]) if period else 0.0
    except (ValueError, ZeroDivisionError):
        return None
    return value if value > 0 else None
