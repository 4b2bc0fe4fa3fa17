"""Findings of a log in words: their details with units, those of several axes as one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.header import some_of
from pyimu.report.meaning import MEANING
from pyimu.report.numbers import number, quantity

SENSORS = {"gyro": "gyro", "accel": "accelerometer"}
"""Names of the sensors."""

SAMPLE = (
    "level",
    "step",
    "least",
    "largest",
    "declared",
    "value",
    "amplitude",
    "span",
    "accel_x",
    "accel_y",
    "accel_z",
)
"""Details of findings that have the unit of the column."""

UNITS = {"gyro": "rad/s", "accel": "m/s^2", "ref_rate": "rad/s", "ref_force": "m/s^2"}
"""SI units of columns, by their names or what these begin with."""

SECONDS, SECONDS_OF_TIME = (
    ("time_constant", "period", "late", "least_late", "most_late", "late_std"),
    ("longest", "total", "rms", "first", "last", "origin", "until", "unit"),
)
"""Details of findings that are times; the latter those of the column ``time`` only."""


RATES = ("rate", "frequency")
"""How the names of details end that are in Hz."""

ANGLES = ("tilt", "angle", "_play", "latitude", "longitude")
"""How the names of details end that are angles in rad."""

SENTENCES = {
    "reference_heading": (
        "the positions were turned by {degrees:.3g} deg {way} about the vertical, into the world "
        "of the attitudes"
    ),
    "mount_slipped": "between {first:.5g} and {last:.5g} s",
    "positions_scale": (
        "the positions are {factor:.4f} times as large as the way of the body ({low:.4f} to "
        "{high:.4f}), told from the accelerometer's scale factors: {told:}"
    ),
    "reference_adapts": ("by {time_constant:.3g} s at rest, half of that at {halves_at:.3g} rad/s"),
    "reference_smoothed": "as by {filter:} {seconds:.3g} s",
    "unlikely_rate": "{rate:.6g} Hz; it would be {other_rate:.6g} Hz if the times were in a unit "
    "1,000 times {way:}",
    "time_offset": "the column map moves the times by {offset:.12g} s",
    "rate_of_part": "the part's rate is {other_rate:.6g} Hz, the log's {rate:.6g} Hz",
}
"""What findings say whose names of numbers alone say too little; a count would say nothing."""


def detail(f: Finding) -> str:
    """The finding's numbers with their units, or its sentence behind what that leaves."""
    sentence = SENTENCES.get(f.kind, "")
    rest = {n: value for n, value in f.detail.items() if f"{{{n}:" not in sentence}
    said = _numbers(f.column, rest)
    return ", ".join([*said, sentence.format(**f.detail)] if sentence else said)


def _numbers(column: str, details: Mapping[str, Any]) -> list[str]:
    """Details of a finding about a column with their units."""
    sample = UNITS.get(column, UNITS.get(column.partition("_")[0]))
    parts = []
    for name, value in details.items():
        text = (
            f"{value:,}"
            if isinstance(value, int)
            else str(value)
            if np.ndim(value) or isinstance(value, str)
            else number(float(value), 4)
        )
        if sample and name in SAMPLE:
            text = quantity(float(value), sample)
        elif name.endswith(ANGLES):
            text = quantity(float(value), "rad")
        elif name == "white_noise":
            text = quantity(float(value), "rad/sqrt(s)")
        elif name == "share":
            text = quantity(float(value), "1")
        elif name.endswith(RATES):
            text = f"{value:.6g} Hz"
        elif name in SECONDS or (column == "time" and name in SECONDS_OF_TIME):
            text = f"{text} s"
        parts.append(f"{name.replace('_', ' ')} {text}")
    return parts


class Said(NamedTuple):
    """A finding in words: its ``columns`` as ``gyro x, y, z``, its numbers as the ``detail``."""

    kind: str
    columns: str
    count: int
    detail: str
    meaning: str

    @property
    def line(self) -> str:
        """All but what it means in a line for a terminal."""
        if self.kind.replace(" ", "_") in SENTENCES:
            return f"{self.kind}: {self.detail}"
        where = f" of {self.columns}" if self.columns not in ("time", "") else ""
        return f"{self.kind}{where}: {self.count:,}{f' ({self.detail})' if self.detail else ''}"


def _in_short(findings: Iterable[Finding]) -> Iterator[Finding]:
    """The findings, several columns of one log that have no meaning as one."""
    rows: dict[tuple, list[Finding]] = {}
    for k, f in enumerate(findings):
        others = tuple((n, str(value)) for n, value in f.detail.items() if n != "header")
        rows.setdefault(others if f.kind == "unused_column" else (k,), []).append(f)
    for first, *more in rows.values():
        if not more:
            yield first
            continue
        names = [f.column for f in (first, *more)]
        rest = {n: value for n, value in first.detail.items() if n != "header"}
        yield Finding("columns_left_out", "", len(names), {**rest, "columns": some_of(names)})


def grouped(findings: Iterable[Finding]) -> list[Said]:
    """Findings in words; those that differ in the axis alone are one, and columns left out are."""
    rows: dict[tuple, list[Finding]] = {}
    for f in _in_short(findings):
        sensor = f.column.partition("_")[0] if f.column.startswith(tuple(SENSORS)) else f.column
        rows.setdefault((f.kind, sensor, f.count, detail(f)), []).append(f)
    return [
        Said(kind.replace("_", " "), _axes(sensor, found), count, text, MEANING.get(kind, ""))
        for (kind, sensor, count, text), found in rows.items()
    ]


def _axes(sensor: str, found: Sequence[Finding]) -> str:
    axes = [axis for f in found if (axis := f.column.partition("_")[2])]
    if sensor in SENSORS:
        return f"{sensor} {', '.join(axes)}".rstrip()
    return sensor.replace("_", " ")


def in_line(findings: Iterable[Finding]) -> Iterator[str]:
    """Each in a line for a terminal."""
    yield from (said.line for said in grouped(findings))
