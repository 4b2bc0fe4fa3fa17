"""What shows a finding: the samples around it, the levels that values keep to, the lengths of the
steps of the time, the gaps.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from pyimu.characterization.samples import CHUNK, Samples
from pyimu.errors import Finding
from pyimu.recording.quality.clipping import clipped

AROUND = 60
"""Samples before and after what an excerpt shows."""

LEVELS = 12
"""Levels to either side of the middle one."""

STEPS = np.linspace(0.0, 2.0, 81)
"""Edges of the bins of time steps, in sample periods; longer ones count with the last bin."""

MOST = 400
"""Stretches that are drawn."""


@dataclass(frozen=True)
class Excerpt:
    """Samples (k,) at ``time`` (k,) s, of which ``first`` to ``last`` - 1 are what was found."""

    time: np.ndarray
    values: np.ndarray
    first: int
    last: int


@dataclass(frozen=True)
class Comb:
    """Share of the samples [1] at each of the levels around the middle one, ``step`` apart in the
    unit of the samples.
    """

    share: np.ndarray
    step: float


@dataclass(frozen=True)
class Steps:
    """Number of time steps in the bins of ``STEPS``, of sample periods of ``h`` s."""

    count: np.ndarray
    h: float


@dataclass(frozen=True)
class Timeline:
    """Stretches (start, stop) s of samples without gap, the longest ``MOST``."""

    spans: tuple[tuple[float, float], ...]


Evidence = Excerpt | Comb | Steps | Timeline


def evidence(
    findings: Iterable[Finding], sensors: Mapping[str, Samples]
) -> dict[tuple[str, str], Evidence]:
    """By kind and column of the findings that can be shown; of clipping by column and side,
    ``gyro_x low``.
    """
    shown = {}
    for f in findings:
        kind, _, axis = f.column.partition("_")
        if f.column == "time" and sensors:
            found = _of_time(f, max(sensors.values(), key=len))
        elif kind in sensors and axis in ("x", "y", "z"):
            found = _of_column(f, sensors[kind], "xyz".index(axis))
        else:
            found = None
        if found is not None:
            # A column may be clipped on either side.
            shown[
                f.kind, f"{f.column} {f.detail['side']}" if f.kind == "clipping" else f.column
            ] = found
    return shown


def _of_time(f: Finding, samples: Samples) -> Evidence | None:
    if f.kind == "gaps":
        order = sorted(samples.stretches, key=lambda s: s[0] - s[1])[:MOST]
        return Timeline(
            tuple((float(samples.time[a]), float(samples.time[b - 1])) for a, b in sorted(order))
        )
    if f.kind in ("jitter", "two_rates"):
        count = np.zeros(len(STEPS) - 1)
        for a in range(0, len(samples) - 1, CHUNK):
            steps = np.diff(samples.time[a : a + CHUNK + 1]) / samples.h
            count += np.histogram(np.minimum(steps, STEPS[-1]), STEPS)[0]
        return Steps(count, samples.h)
    return None


def _of_column(f: Finding, samples: Samples, axis: int) -> Evidence | None:
    column = samples.columns[axis]
    if f.kind == "quantization_step":
        return _comb(column, f.detail["step"])
    if f.kind == "clipping":
        return _around(samples, column, _first_clipped(column, f.detail["level"]), 1)
    if "first_row" in f.detail:
        return _around(
            samples, column, samples.place(f.detail["first_row"]), f.detail.get("longest", 1)
        )
    return None


def _around(samples: Samples, column: np.ndarray, row: int, length: int) -> Excerpt | None:
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
    for a in range(0, len(column), CHUNK):
        piece = np.array(column[a : a + CHUNK])
        rows = np.flatnonzero(clipped(piece) & (np.abs(piece - level) < 0.1 * abs(level)))
        if len(rows):
            return a + int(rows[0])
    return -1


def _comb(column: np.ndarray, step: float) -> Comb:
    centre = float(np.median(column[:CHUNK]))
    number = np.rint((column[:CHUNK] - centre) / step).astype(int)
    near = number[np.abs(number) <= LEVELS] + LEVELS
    return Comb(np.bincount(near, minlength=2 * LEVELS + 1) / len(number), step)
