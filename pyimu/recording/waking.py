"""Rows of zeros that a logger writes before its sensor has measured anything."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from pyimu.errors import Finding

SENSORS = ("gyro", "accel")
"""The triads that are zero together: one alone may be at rest or fall."""

LONGEST = 60.0
"""s; a log that is zero for longer at its start is taken as it is."""

Batch = tuple[np.ndarray, Mapping[str, np.ndarray], float]
"""Times (n,), groups by name, and the share of the file read so far."""


class Waking:
    """Leaves out the rows at the start of a log in which gyro and accelerometer are zero.

    No sensor with noise measures six zeros at once. A log that never measures anything else keeps
    its rows, and is found to be constant.
    """

    def __init__(self) -> None:
        self._count, self._until = 0, 0.0

    def findings(self) -> list[Finding]:
        """How many rows were left out, and until which time in s."""
        if not self._count:
            return []
        return [Finding("zeros_left_out", "time", self._count, {"until": self._until})]

    def awake(self, batches: Iterable[Batch]) -> Iterator[Batch]:
        """``batches`` from the first sample on."""
        batches = iter(batches)
        held = self._until_awake(batches)
        while held:
            # What was given is not kept: a log is longer than memory.
            yield held.pop(0)
        yield from batches

    def _until_awake(self, batches: Iterator[Batch]) -> list[Batch]:
        """The batches up to that of the first sample, less the zeros before it."""
        held: list[Batch] = []
        for batch in filter(lambda b: len(b[0]), batches):
            held.append(batch)
            first, start = _first_sample(batch), held[0][0][0]
            if first is not None and batch[0][first] - start <= LONGEST:
                self._count = sum(len(b[0]) for b in held[:-1]) + first
                self._until = float(batch[0][first])
                return [_from_row(batch, first)]
            if first is not None or batch[0][-1] - start > LONGEST:
                break
        return held


def _first_sample(batch: Batch) -> int | None:
    """The first row in which a sensor measures something; None where there is none."""
    _, groups, _ = batch
    if not all(name in groups for name in SENSORS):
        return 0
    rows = np.flatnonzero(np.any([np.any(groups[name] != 0, axis=1) for name in SENSORS], axis=0))
    return int(rows[0]) if len(rows) else None


def _from_row(batch: Batch, row: int) -> Batch:
    time, groups, share = batch
    return time[row:], {name: values[row:] for name, values in groups.items()}, share
