"""All traps by name: functions of a random generator that make one case each."""

from __future__ import annotations

from collections.abc import Callable

from trap_logs import (
    clocks,
    drivers,
    flights,
    frames,
    handling,
    mounts,
    places,
    references,
    robots,
    samples,
    surroundings,
)
from trap_logs.log import Log

Trap = Callable[..., Log]

TRAPS: dict[str, Trap] = {
    trap.__name__: trap
    for room in (
        clocks,
        references,
        places,
        surroundings,
        samples,
        flights,
        frames,
        handling,
        mounts,
        drivers,
        robots,
    )
    for trap in room.TRAPS
}
