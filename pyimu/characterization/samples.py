"""The samples of a log by sensor: its complete rows, and the segments without gap that they form.

A gap is a step of the time above 1.5 sample periods after which the stamps stay late
(``recording.gaps``). A row in which a cell of the sensor is missing is no sample of it, so that a
sensor that is logged in every second row has half the log's rate, and a lost sample is a gap.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from pyimu.characterization.store import Store
from pyimu.characterization.temperature.averages import AverageAccumulator, Averages
from pyimu.errors import Finding
from pyimu.model.part import AXES
from pyimu.recording.clock import Cadence, cadence_of
from pyimu.recording.gaps import GapFinder
from pyimu.recording.recording import Recording
from pyimu.recording.rest import motion_of

KINDS = ("gyro", "accel")

HELD = 60.0
"""Time [s] for which the last temperature counts where rows have none."""

PIECE = 1 << 20
"""Rows of a piece."""

LONGEST_CLOSED, MOST_LOST = 1.0, 0.05
"""s, and share of the samples: gaps up to so long are closed, the shortest first, until so much is
lost in them. A random walk is too large by half of that share then, a ramp by all of it; a bias
that another power-on set is behind longer gaps."""


@dataclass
class Samples:
    """The samples of one sensor: ``columns`` (3 arrays (n,)) in SI at ``time`` (n,) s.

    The sample period is ``h`` s, ``segments`` are ranges (start, stop) without gap, ``missing``
    (k,) are the rows of the log that are no samples. ``averages`` over intervals are None in a log
    without temperature. ``absent`` axes, by index and with the reason, have no samples: their
    columns are zero. ``before`` samples of the log are left out at its beginning. Gaps are closed
    until the share ``most_lost`` is lost in them.
    """

    kind: str
    h: float
    time: np.ndarray
    columns: list[np.ndarray]
    segments: list[tuple[int, int]]
    missing: np.ndarray
    averages: Averages | None
    absent: Mapping[int, str] = field(default_factory=dict)
    before: int = 0
    most_lost: float = MOST_LOST

    def place(self, row: int) -> int:
        """Number of the sample in row ``row`` of the log."""
        return int(row - np.searchsorted(self.missing, row)) - self.before

    def row(self, sample: int) -> int:
        """Row of the log in which a sample is."""
        return int(self.rows(np.array([sample]))[0])

    def rows(self, samples: np.ndarray) -> np.ndarray:
        """Rows (k,) of the log in which samples (k,) are."""
        # The rows before one that are no samples are those whose own place is not beyond it.
        number = samples + self.before
        place = self.missing - np.arange(len(self.missing))
        return number + np.searchsorted(place, number, side="right")

    def __len__(self) -> int:
        return len(self.time)

    def between(self, begin: float, end: float) -> Samples:
        """The samples from a time to another, s."""
        a, b = np.searchsorted(self.time, [begin, end]).tolist()
        inside = [(max(start, a) - a, min(stop, b) - a) for start, stop in self.segments]
        return replace(
            self,
            time=self.time[a:b],
            columns=[column[a:b] for column in self.columns],
            segments=[(start, stop) for start, stop in inside if stop > start],
            averages=None if self.averages is None else self.averages.between(begin, end),
            before=self.before + a,
        )

    def motion(self, wrapped: Container[str] = ()) -> list[Finding]:
        """A finding ``motion`` for each column that moves, ``first_row`` being one of the log.

        The columns ``wrapped`` are left out: they jump without a motion.
        """
        found = []
        for axis, column in zip(AXES, self.columns, strict=True):
            name = f"{self.kind}_{axis}"
            one = None if name in wrapped else motion_of(self.kind, column, self.segments, self.h)
            if one is not None:
                detail = {**one.detail, "first_row": int(self.row(one.detail["first_row"]))}
                found.append(replace(one, column=name, detail=detail))
        return found

    @cached_property
    def stretches(self) -> list[tuple[int, int]]:
        """Ranges (start, stop) of samples of which each follows the one before, but for the few
        that were lost in between: what deviations are made of. A sample in ten thousand that a
        radio loses would leave none as long as a minute.
        """
        closed, out = self._closed(), []
        for segment in self.segments:
            if out and segment[0] in closed:
                out[-1] = (out[-1][0], segment[1])
            else:
                out.append(segment)
        return out

    def _closed(self) -> set[int]:
        """First samples behind the gaps that are closed."""
        behind = [b for (_, a), (b, _) in pairwise(self.segments) if a == b]
        lost = np.array([self.time[b] - self.time[b - 1] - self.h for b in behind])
        order = np.argsort(lost, kind="stable")
        few = np.cumsum(lost[order]) <= self.most_lost * self.h * len(self)
        return {behind[i] for i in order[few & (lost[order] <= LONGEST_CLOSED)]}

    @property
    def longest(self) -> int:
        """Samples of the longest stretch."""
        return max((b - a for a, b in self.stretches), default=0)


class Collector:
    """Takes the rows of a sensor as they come and keeps its samples in a store."""

    def __init__(self, kind: str, store: Store) -> None:
        self.kind, self.store = kind, store
        self.cadence: Cadence | None = None
        self._gaps: GapFinder | None = None
        self._starts: list[np.ndarray] = [np.zeros(1, dtype=int)]
        self._rows, self._count = 0, 0
        self._averages: AverageAccumulator | None = None
        self._last_temperature = (-np.inf, np.nan)
        self._seen, self._late = np.zeros(3, dtype=bool), {}

    def add(self, piece: Recording) -> None:
        """Add the next piece of the log."""
        values = self._present(getattr(piece, self.kind))
        columns = [np.ascontiguousarray(column) for column in values.T]
        whole = _finite(columns)
        self.store.append(f"{self.kind}_missing", np.flatnonzero(~whole) + self._rows)
        self._rows += len(piece)
        time, *columns = _at(whole, [piece.time, *columns])
        if not len(time):
            return
        if self.cadence is None:
            self.cadence = _cadence(piece, time)
            self._gaps = GapFinder(self.cadence.period, self.cadence.longest)
        self._starts.append(self._gaps.add(time)[0])
        self._count += len(time)
        self.store.append(f"{self.kind}_time", time)
        for axis, column in zip(AXES, columns, strict=True):
            self.store.append(f"{self.kind}_{axis}", column)
        if piece.temperature is not None:
            self._average(time, *_at(whole, [self._temperature(piece)]), columns)

    def _present(self, values: np.ndarray) -> np.ndarray:
        """The values (k, 3), with zeros on axes that have had none so far.

        So an axis without samples does not make the rows of the others incomplete.
        """
        there = np.isfinite(values).any(axis=0)
        self._late |= {
            i: self._rows for i in np.flatnonzero(there & ~self._seen).tolist() if self._count
        }
        self._seen |= there
        empty = ~self._seen
        return values if not self._seen.any() or not empty.any() else np.where(empty, 0.0, values)

    def _average(
        self, time: np.ndarray, temperature: np.ndarray, columns: list[np.ndarray]
    ) -> None:
        if self._averages is None:
            self._averages = AverageAccumulator(self.cadence.period)
        self._averages.add(time, temperature, np.transpose(columns))

    def _temperature(self, piece: Recording) -> np.ndarray:
        """Temperature (k,) of the rows: the last known one, nan where that is ``HELD`` s ago."""
        known = np.flatnonzero(np.isfinite(piece.temperature))
        if len(known) == len(piece):
            self._last_temperature = (piece.time[-1], piece.temperature[-1])
            return piece.temperature
        last_time, last_reading = self._last_temperature
        times = np.append(last_time, piece.time[known])
        readings = np.append(last_reading, piece.temperature[known])
        self._last_temperature = (times[-1], readings[-1])
        last = np.searchsorted(times, piece.time, side="right") - 1
        return np.where(piece.time - times[last] <= HELD, readings[last], np.nan)

    def result(self) -> Samples | None:
        """The samples that came; None where there were none."""
        if not self._count:
            return None
        edges = np.concatenate([*self._starts, self._gaps.end()[0], [self._count]])
        segments = list(zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True))
        columns = [self.store.column(f"{self.kind}_{axis}") for axis in AXES]
        return Samples(
            self.kind,
            self.cadence.period,
            self.store.column(f"{self.kind}_time"),
            columns,
            segments,
            self.store.column(f"{self.kind}_missing"),
            self._averages.result() if self._averages else None,
            self._absent(),
        )

    def _absent(self) -> dict[int, str]:
        """Axes that have no samples or got them late, with the reason."""
        late = {
            i: f"its first {rows:,} cells are empty, give it from there on"
            for i, rows in self._late.items()
        }
        return late | {i: "all its cells are empty" for i in np.flatnonzero(~self._seen).tolist()}


def _finite(columns: list[np.ndarray]) -> np.ndarray:
    """Mask (k,) of the rows in which no column (k,) misses a cell."""
    return np.logical_and.reduce([np.isfinite(column) for column in columns])


def _at(rows: np.ndarray, columns: list[np.ndarray]) -> list[np.ndarray]:
    """The columns at the rows of a mask; those of a whole log are not copied."""
    return columns if rows.all() else [column[rows] for column in columns]


def _cadence(piece: Recording, time: np.ndarray) -> Cadence:
    """The cadence of the log, or the sensor's own where it has samples in fewer rows."""
    return piece.cadence if len(time) < 3 or len(time) > 0.9 * len(piece) else cadence_of(time)
