"""The samples of a log by sensor: rows that are complete, the stretches without gap in which they
lie, and what accompanies them.

A gap is a step of the time above 1.5 sample periods after which the stamps stay late (``gaps``). A
row in which a cell of the sensor is missing is no sample of it, so that a sensor that is logged in
every second row has half the log's rate, and a lost sample is a gap.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from pyimu.characterization.store import Store
from pyimu.characterization.temperature.averages import BlockAccumulator, Blocks
from pyimu.model.part import AXES
from pyimu.recording.clock import Cadence, cadence_of
from pyimu.recording.gaps import GapFinder
from pyimu.recording.recording import Recording

KINDS = ("gyro", "accel")

HELD = 60.0
"""s for which the last temperature stands where rows have none."""

CHUNK = 1 << 20
"""Rows of a piece."""


@dataclass
class Samples:
    """One sensor's samples: ``columns`` (3 arrays (n,)) in SI, ``time`` (n,) s, sample period ``h``
    s, ``stretches`` (start, stop) without gap.

    ``absent`` axes, by index and with the reason, have no samples: their columns are zero.
    """

    kind: str
    h: float
    time: np.ndarray
    columns: list[np.ndarray]
    stretches: list[tuple[int, int]]
    missing: np.ndarray
    blocks: Blocks | None
    absent: Mapping[int, str] = field(default_factory=dict)

    def place(self, row: int) -> int:
        """The sample that row ``row`` of the log is."""
        return int(row - np.searchsorted(self.missing, row))

    def row(self, sample: int) -> int:
        """The row of the log that a sample is."""
        # Rows before it that are no sample are those whose own place is not beyond it.
        return int(
            sample
            + np.searchsorted(self.missing - np.arange(len(self.missing)), sample, side="right")
        )

    def __len__(self) -> int:
        return len(self.time)

    @property
    def longest(self) -> int:
        return max((b - a for a, b in self.stretches), default=0)


class Collector:
    """Takes a sensor's rows as they come and keeps them in a store."""

    def __init__(self, kind: str, store: Store) -> None:
        self.kind, self.store = kind, store
        self.cadence: Cadence | None = None
        self._gaps: GapFinder | None = None
        self._starts: list[np.ndarray] = [np.zeros(1, dtype=int)]
        self._rows, self._count = 0, 0
        self._blocks: BlockAccumulator | None = None
        self._warm = (-np.inf, np.nan)
        self._seen, self._late = np.zeros(3, dtype=bool), {}

    def add(self, piece: Recording) -> None:
        """The next piece of the log."""
        values = self._present(getattr(piece, self.kind))
        whole = np.isfinite(values).all(axis=1)
        self.store.append(f"{self.kind}_missing", np.flatnonzero(~whole) + self._rows)
        self._rows += len(piece)
        time, rows = piece.time[whole], values[whole]
        if not len(time):
            return
        if self.cadence is None:
            self.cadence = _cadence(piece, time)
            self._gaps = GapFinder(self.cadence.period, self.cadence.longest)
        self._starts.append(self._gaps.add(time)[0])
        self._count += len(time)
        self.store.append(f"{self.kind}_time", time)
        for axis, column in zip(AXES, rows.T, strict=True):
            self.store.append(f"{self.kind}_{axis}", column)
        if piece.temperature is not None:
            self._warmth(time, self._temperature(piece)[whole], rows)

    def _present(self, values: np.ndarray) -> np.ndarray:
        """The values (k, 3), zero on axes that have had none so far, so that these do not take the
        other axes along.
        """
        there = np.isfinite(values).any(axis=0)
        self._late |= {
            i: self._rows for i in np.flatnonzero(there & ~self._seen).tolist() if self._count
        }
        self._seen |= there
        empty = ~self._seen
        return values if not self._seen.any() or not empty.any() else np.where(empty, 0.0, values)

    def _warmth(self, time: np.ndarray, temperature: np.ndarray, rows: np.ndarray) -> None:
        if self._blocks is None:
            self._blocks = BlockAccumulator(self.cadence.period)
        self._blocks.add(time, temperature, rows)

    def _temperature(self, piece: Recording) -> np.ndarray:
        """Temperature (k,) of the rows, the last known one where there is none, unless that is
        ``HELD`` s ago.
        """
        known = np.flatnonzero(np.isfinite(piece.temperature))
        times = np.append(self._warm[0], piece.time[known])
        readings = np.append(self._warm[1], piece.temperature[known])
        self._warm = (times[-1], readings[-1])
        last = np.searchsorted(times, piece.time, side="right") - 1
        return np.where(piece.time - times[last] <= HELD, readings[last], np.nan)

    def result(self) -> Samples | None:
        """What came; None where nothing did."""
        if not self._count:
            return None
        edges = np.concatenate([*self._starts, self._gaps.end()[0], [self._count]])
        stretches = list(zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True))
        columns = [self.store.column(f"{self.kind}_{axis}") for axis in AXES]
        blocks = self._blocks.result() if self._blocks else None
        return Samples(
            self.kind,
            self.cadence.period,
            self.store.column(f"{self.kind}_time"),
            columns,
            stretches,
            self.store.column(f"{self.kind}_missing"),
            blocks,
            self._absent(),
        )

    def _absent(self) -> dict[int, str]:
        late = {
            i: f"its first {rows:,} cells are empty, give it from there on"
            for i, rows in self._late.items()
        }
        return late | {i: "all its cells are empty" for i in np.flatnonzero(~self._seen).tolist()}


def _cadence(piece: Recording, time: np.ndarray) -> Cadence:
    """That of the log, or this sensor's own where it is in fewer rows."""
    return piece.cadence if len(time) < 3 or len(time) > 0.9 * len(piece) else cadence_of(time)
