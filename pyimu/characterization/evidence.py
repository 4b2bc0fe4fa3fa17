"""Evidence of the findings, to be drawn: samples, and histograms of levels and of time steps."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from pyimu.characterization.samples import PIECE, Samples
from pyimu.errors import Finding
from pyimu.model.part import AXES
from pyimu.recording.quality.clipping import clipped

AROUND = 60
"""Samples before and after the finding in an excerpt."""

LEVELS = 12
"""Quantization levels to either side of the middle one."""

STEP_EDGES = np.linspace(0.0, 2.0, 81)
"""Edges of the bins of time steps, in sample periods; longer ones count with the last bin."""

MOST = 400
"""Segments that are drawn."""


@dataclass(frozen=True)
class Excerpt:
    """Samples (k,) at ``time`` (k,) s, of which ``first`` to ``last`` - 1 are the finding."""

    time: np.ndarray
    values: np.ndarray
    first: int
    last: int


@dataclass(frozen=True)
class LevelHistogram:
    """Share of the samples [1] at each of the quantization levels around the middle one.

    There are ``LEVELS`` to either side, ``step`` apart in the unit of the samples.
    """

    share: np.ndarray
    step: float


@dataclass(frozen=True)
class StepHistogram:
    """Number of time steps in the bins of ``STEP_EDGES``, of sample periods of ``h`` s."""

    count: np.ndarray
    h: float


@dataclass(frozen=True)
class Timeline:
    """The segments of samples without gap, (start, stop) in s; the ``MOST`` longest of them."""

    segments: tuple[tuple[float, float], ...]


Evidence = Excerpt | LevelHistogram | StepHistogram | Timeline


def evidence(
    findings: Iterable[Finding], sensors: Mapping[str, Samples]
) -> dict[tuple[str, str], Evidence]:
    """Evidence of the findings that have any, by kind and column.

    That of clipping is by column and side, ``gyro_x low``, because a column may be clipped on
    either side.
    """
    found = {}
    for f in findings:
        kind, _, axis = f.column.partition("_")
        if f.column == "time" and sensors:
            own = _of_time(f, max(sensors.values(), key=len))
        elif kind in sensors and axis in tuple(AXES):
            own = _of_column(f, sensors[kind], AXES.index(axis))
        else:
            own = None
        if own is not None:
            side = f" {f.detail['side']}" if f.kind == "clipping" else ""
            found[f.kind, f"{f.column}{side}"] = own
    return found


def _of_time(f: Finding, samples: Samples) -> Evidence | None:
    if f.kind == "gaps":
        order = sorted(samples.segments, key=lambda s: s[0] - s[1])[:MOST]
        return Timeline(
            tuple((float(samples.time[a]), float(samples.time[b - 1])) for a, b in sorted(order))
        )
    if f.kind in ("jitter", "two_rates"):
        count = np.zeros(len(STEP_EDGES) - 1)
        for a in range(0, len(samples) - 1, PIECE):
            steps = np.diff(samples.time[a : a + PIECE + 1]) / samples.h
            count += np.histogram(np.minimum(steps, STEP_EDGES[-1]), STEP_EDGES)[0]
        return StepHistogram(count, samples.h)
    return None


def _of_column(f: Finding, samples: Samples, axis: int) -> Evidence | None:
    column = samples.columns[axis]
    if f.kind == "quantization_step":
        return _levels(column, f.detail["step"])
    if f.kind == "clipping":
        return _around(samples, column, _first_clipped(column, f.detail["level"]), 1)
    if "first_row" in f.detail:
        return _around(
            samples, column, samples.place(f.detail["first_row"]), f.detail.get("longest", 1)
        )
    return None


def _around(samples: Samples, column: np.ndarray, row: int, length: int) -> Excerpt | None:
    """The samples around ``length`` ones from ``row`` on; None where there is no such row."""
    if not 0 <= row < len(column):
        return None
    rows = slice(max(row - AROUND, 0), min(row + length, row + 4 * AROUND) + AROUND)
    return Excerpt(
        np.array(samples.time[rows]),
        np.array(column[rows]),
        row - rows.start,
        row - rows.start + length,
    )


def _first_clipped(column: np.ndarray, level: float) -> int:
    """The first sample of the first piece that is clipped at about this level; -1 where none is."""
    for a in range(0, len(column), PIECE):
        piece = np.array(column[a : a + PIECE])
        rows = np.flatnonzero(clipped(piece) & (np.abs(piece - level) < 0.1 * abs(level)))
        if len(rows):
            return a + int(rows[0])
    return -1


def _levels(column: np.ndarray, step: float) -> LevelHistogram:
    """Histogram of the first samples of a column, about their median."""
    centre = float(np.median(column[:PIECE]))
    number = np.rint((column[:PIECE] - centre) / step).astype(int)
    near = number[np.abs(number) <= LEVELS] + LEVELS
    return LevelHistogram(np.bincount(near, minlength=2 * LEVELS + 1) / len(number), step)
