"""A recording as the attitude filter's inputs, on a regular grid of its sample period."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from pyimu.attitude.columns import (
    extra_column,
    recorded_age,
    recorded_heading,
    temperature_of,
)
from pyimu.attitude.driven import recorded_speed
from pyimu.attitude.filter.variables import EXTRA_INPUTS
from pyimu.attitude.retiming import Retiming
from pyimu.display.silent import silent
from pyimu.model.part import Part
from pyimu.recording.recording import Recording

LONGEST_GAP = 60.0
"""s; of a gap so much becomes missing samples, by which the attitude is lost; over the rest of it
only the bias still walks."""

SPAN = 0.25
"""s; so long the sample period is taken for one number where it wanders: of a wander over 10 s that
misses a part in a thousand."""

WANDERS = 1.0
"""Sample periods by which the stamps, as means over ``SPAN``, must leave the even grid before the
period is taken to wander: until then a turn is off by no more than what it makes in a period."""

CHUNK = 65_536
"""Samples that are run at a time, so that a long log takes no more memory than its results do."""


class Cut(NamedTuple):
    """A piece before it is made: its first sample, how many it has, the s left out before it."""

    first: int
    size: int
    left_out: float


class Piece(NamedTuple):
    """The inputs (m, nu) of successive samples, in an array that is used again.

    ``rows`` are the recording's rows among them, ``at`` the samples of ``inputs`` where these
    stand, ``left_out`` the s of a gap that are left out before the first, ``periods`` which samples
    have which period in s.
    """

    inputs: np.ndarray
    rows: slice
    at: np.ndarray
    left_out: float
    periods: list[tuple[slice, float]]


class InputGrid:
    """The block's inputs on the grid: the recording's rows, between them missing values.

    Between the rows the sensors are missing, and there is no mark.

    ``rows`` (n,) is the sample number of each row, ``after_gap`` the rows that follow a gap,
    ``left_out`` the s of each gap that exceed its missing samples. ``names`` are those of the
    block's inputs, ``more`` are columns (n,) for some of them, zero between the rows. ``heard``
    hears how often the grid has been gone through so far, 0.5 for a half of it.
    """

    def __init__(
        self,
        recording: Recording,
        part: Part,
        names: list[str],
        retiming: Retiming | None = None,
        more: Mapping[str, np.ndarray] | None = None,
        heard: Callable[[float], None] = silent,
    ) -> None:
        self.heard, self._asked = heard, 0
        self.rows, gaps, self.left_out = _grid(recording)
        self.after_gap = 1 + gaps
        self.period = recording.sample_period
        self.spans = _wandering(recording, self.rows, gaps, self.left_out)
        signals, marks = _signals(recording, part), _marks(recording)
        marks |= more or {}
        if retiming is not None:
            marks = _at_instants(marks, retiming.nearest_row())
        self.columns = [_column(name, signals, marks) for name in names]

    def pieces(self) -> Iterator[Piece]:
        """The inputs piece by piece."""
        u = np.empty((CHUNK, len(self.columns)))
        for cut in self.cuts(CHUNK):
            yield self.piece(cut, u)

    def cuts(self, most: int) -> list[Cut]:
        """The grid in pieces of at ``most`` so many samples, each of which ends where a long gap
        does.
        """
        long = np.flatnonzero(self.left_out)
        starts = [0, *self.rows[self.after_gap[long]].tolist()]
        ends = [*starts[1:], int(self.rows[-1]) + 1]
        before = [0.0, *self.left_out[long].tolist()]
        return [
            Cut(first, min(most, end - first), left_out if first == start else 0.0)
            for start, end, left_out in zip(starts, ends, before, strict=True)
            for first in range(start, end, most)
        ]

    def piece(self, cut: Cut, u: np.ndarray) -> Piece:
        """The inputs of a cut, in the array ``u`` (size or more, nu)."""
        self.heard(self._asked / (int(self.rows[-1]) + 1))
        self._asked += cut.size
        start, stop = np.searchsorted(self.rows, [cut.first, cut.first + cut.size]).tolist()
        rows, at = slice(start, stop), self.rows[start:stop] - cut.first
        for i, (values, otherwise) in enumerate(self.columns):
            u[:, i] = otherwise
            if values is not None:
                u[at, i] = values[rows]
        return Piece(u[: cut.size], rows, at, cut.left_out, self._periods(cut))

    def _periods(self, cut: Cut) -> list[tuple[slice, float]]:
        """The samples of a cut that have one period, and that in s.

        Where the period wanders it is that of each ``SPAN`` of the grid, wherever it is cut.
        """
        if self.spans is None:
            return [(slice(0, cut.size), self.period)]
        samples, late = self.spans
        step, end = max(1, round(SPAN / self.period)), cut.first + cut.size
        found = []
        for span in range(cut.first // step * step, end, step):
            within = slice(max(span, cut.first) - cut.first, min(span + step, end) - cut.first)
            change = np.diff(np.interp([span - 1, span + step - 1], samples, late))[0]
            found.append((within, self.period + float(change) / step))
        return found


def _signals(recording: Recording, part: Part) -> dict[str, np.ndarray | None]:
    """The sensors' columns by name, (n,) or (n, 3); they are missing between the rows."""
    temperature = np.broadcast_to(temperature_of(recording, part), len(recording.time))
    extra = {signal: extra_column(recording, part, signal) for signal in EXTRA_INPUTS}
    own = {"gyro": recording.gyro, "gyro_z": recording.gyro[:, 2], "accel": recording.accel}
    return own | {"temperature": temperature} | extra


def _marks(recording: Recording) -> dict[str, np.ndarray | None]:
    """The columns (n,) of headings, speeds and ``stationary`` by name, zero between the rows."""
    marks = {"stationary": getattr(recording, "stationary", None)}
    if getattr(recording, "heading", None) is not None:
        marks |= _measured("heading", *recorded_heading(recording))
        marks["heading_age"] = recorded_age(recording)
    if getattr(recording, "speed", None) is not None:
        marks |= _measured("speed", *recorded_speed(recording))
    return marks


def _measured(name: str, values: np.ndarray, std: np.ndarray) -> dict[str, np.ndarray]:
    """The columns (n,) of a measurement, with what stands where there is none."""
    valid = np.isfinite(values) & np.isfinite(std)
    return {
        name: np.where(valid, values, 0),
        f"{name}_variance": np.where(valid, std**2, 0),
        f"{name}_valid": valid,
    }


def _at_instants(marks: dict, row: np.ndarray) -> dict[str, np.ndarray | None]:
    """The marks of the ``row`` (n,) nearest to each sample; none where it is -1."""
    return {n: v if v is None else np.where(row < 0, 0, v[row]) for n, v in marks.items()}


def _column(name: str, signals: dict, marks: dict) -> tuple[np.ndarray | None, float]:
    """The recorded values (n,) of an input where there are any, and what stands between them."""
    signal, _, axis = name.partition("[")
    if signal not in signals:
        return marks.get(name), 0.0
    values = signals[signal]
    return (values if values is None or not axis else values[:, int(axis[:-1]) - 1]), np.nan


def _wandering(
    recording: Recording, rows: np.ndarray, gaps: np.ndarray, left_out: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """Samples (m,), ``SPAN`` apart, and by how many s (m,) the stamps are late there against the
    even grid; None where they are nowhere by a period.

    A stamp may be late by itself, which says nothing of its sample: their mean
    counts. Before the first and after the last mean the period goes on as it is there.
    """
    period = recording.sample_period
    over_gaps = np.zeros(len(rows))
    over_gaps[1 + gaps] = left_out
    even = recording.time[0] + rows * period + np.cumsum(over_gaps)
    length = max(1, round(SPAN / period))
    groups = np.array_split(np.arange(len(rows)), max(1, len(rows) // length))
    late = np.array([np.mean(recording.time[g] - even[g]) for g in groups])
    samples = np.array([np.mean(rows[g]) for g in groups])
    if np.ptp(late) <= WANDERS * period:
        return None
    samples, late = (np.array([2 * v[0] - v[1], *v, 2 * v[-1] - v[-2]]) for v in (samples, late))
    return samples, late


def _grid(recording: Recording) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sample number (n,) of each row on a regular grid, the rows before a gap, the s left out.

    The last is (gaps,): what each gap exceeds its missing samples by. A gap is where samples are
    missing, as ``Recording.segments`` has it: a stamp that is late by itself is none.
    """
    period = recording.sample_period
    steps = np.diff(recording.time) / period
    gaps = np.array([stop - 1 for _, stop in recording.segments[:-1]], dtype=int)
    if not len(gaps):
        return np.arange(len(recording.time)), gaps, np.zeros(0)
    # Only a gap counts: jitter of the time stamps neither drops nor adds a sample.
    counts, whole = np.ones(len(steps), dtype=int), np.round(steps[gaps])
    counts[gaps] = np.minimum(whole, max(1, round(LONGEST_GAP / period)))
    return np.concatenate([[0], np.cumsum(counts)]), gaps, (whole - counts[gaps]) * period
