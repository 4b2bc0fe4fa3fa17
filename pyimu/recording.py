"""Recordings: a log of an inertial sensor and what is known of the truth, read from CSV or Parquet.

One row is a sample; a header cell is a name and its unit, ``gyro_x [deg/s]``.  ``GROUPS`` lists every column that has a
meaning.  Inside, all is SI and radians (temperature degC), axes are forward-left-up and east-north-up, and a missing
value is NaN.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import numpy as np

from pyimu.columns import GROUPS, Header, column_names
from pyimu.errors import Finding, UserError
from pyimu.foreign import ForeignMap, read_map
from pyimu.table import CsvTable, ParquetTable, open_table, write_table
from pyimu.units import did_you_mean

__all__ = ["GROUPS", "Finding", "Recording", "column_names", "read_recording"]

GAP = 1.5
"""A step of the time above so many sample periods is a gap."""

NORM_TOLERANCE = 1e-2
"""How far the norm of a reference quaternion may be from one before it is reported."""


@dataclass(frozen=True, eq=False)
class Recording:
    """One log.  Arrays are (n,) or (n, columns) in SI, NaN where a value is missing, None where a group is absent.

    ``time`` [s] increases strictly; ``gyro`` [rad/s] and ``accel`` [m/s^2] are the measured rate against inertial space
    and specific force in body axes; ``temperature`` [degC].  Of the truth: ``ref_rate`` [rad/s], ``ref_q`` (n, 4) (unit
    quaternion, scalar first, body to world), ``ref_heading`` [rad] (counter-clockwise from east), ``ref_force``
    [m/s^2], ``ref_north``, ``ref_east``, ``ref_up`` [m], ``ref_velocity`` (n, 3) east, north, up [m/s], ``latitude``
    [rad], and the marks ``moving`` and ``stationary`` (0 or 1).  Further sensors: ``heading`` and ``heading_std`` [rad],
    ``supply`` [V], ``mag`` [T].  ``frame_declared`` says that the log's axes were stated, not assumed.
    """

    name: str
    time: np.ndarray
    gyro: np.ndarray | None = None
    accel: np.ndarray | None = None
    temperature: np.ndarray | None = None
    ref_rate: np.ndarray | None = None
    ref_q: np.ndarray | None = None
    ref_heading: np.ndarray | None = None
    ref_force: np.ndarray | None = None
    ref_north: np.ndarray | None = None
    ref_east: np.ndarray | None = None
    ref_up: np.ndarray | None = None
    ref_velocity: np.ndarray | None = None
    moving: np.ndarray | None = None
    stationary: np.ndarray | None = None
    heading: np.ndarray | None = None
    heading_std: np.ndarray | None = None
    supply: np.ndarray | None = None
    mag: np.ndarray | None = None
    latitude: np.ndarray | None = None
    path: Path | None = None
    findings: tuple[Finding, ...] = ()
    frame_declared: bool = False

    @classmethod
    def from_arrays(cls, name: str = "recording", *, time, **groups) -> Recording:
        """A recording of array-likes: ``time`` (n,) s, and groups by name, such as ``gyro=`` (n, 3) rad/s.

        Raises UserError for an unknown group, a wrong shape, or a time that does not increase.
        """
        time = np.asarray(time, dtype=float)
        if time.ndim != 1 or len(time) < 1 or not np.all(np.isfinite(time)) or np.any(np.diff(time) <= 0):
            raise UserError(f"{name}: time must be a (n,) array of finite seconds that increases")
        known = {f.name for f in fields(cls)}
        for group in groups:
            if group not in known:
                near = did_you_mean(group, GROUPS)
                raise UserError(f"{name}: unknown group '{group}'{near}; known are {', '.join(GROUPS)}")
        arrays = {g: _shaped(name, g, groups.pop(g), len(time)) for g in GROUPS if groups.get(g) is not None}
        return cls(name=name, time=time, **(groups | arrays))

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        return f"Recording({self.name!r}: {len(self)} samples, {self.sample_rate:.6g} Hz, {', '.join(self.groups)})"

    @property
    def groups(self) -> dict[str, np.ndarray]:
        """The groups that the recording holds, by name, in the order of ``GROUPS``."""
        return {group: getattr(self, group) for group in GROUPS if getattr(self, group) is not None}

    @cached_property
    def sample_period(self) -> float:
        """s; the median step of the time, refined by the mean of the steps that are no gap (a file's times are rounded)."""
        step = np.diff(self.time)
        if not len(step):
            return math.nan
        median = float(np.median(step))
        regular = step[np.abs(step - median) < (GAP - 1) * median]
        return float(regular.mean()) if len(regular) > 0.9 * len(step) else median

    @property
    def sample_rate(self) -> float:
        """Hz."""
        return 1 / self.sample_period

    @cached_property
    def segments(self) -> list[tuple[int, int]]:
        """Index ranges (start, stop) without gap."""
        breaks = np.flatnonzero(np.diff(self.time) > GAP * self.sample_period) + 1 if len(self) > 1 else []
        edges = [0, *map(int, breaks), len(self)]
        return list(pairwise(edges))

    def slice(self, start: int | None = None, stop: int | None = None) -> Recording:
        """The samples start <= k < stop, as a recording; findings stay those of the whole log."""
        rows = slice(start, stop)
        return replace(self, time=self.time[rows], **{name: values[rows] for name, values in self.groups.items()})

    def write(self, path: str | os.PathLike) -> Path:
        """Writes the recording to ``path`` (.csv, .csv.gz or .parquet), exactly, in SI.

        The file appears whole or not at all.  Raises UserError for another suffix or a folder that cannot be written.
        """
        write_table(Path(path), self._table())
        return Path(path)

    def _table(self) -> dict[str, np.ndarray]:
        table = {"time [s]": self.time}
        for group, values in self.groups.items():
            columns = values.reshape(len(self), -1).T
            table |= {f"{name} [{GROUPS[group][1]}]": column for name, column in zip(column_names(group), columns)}
        return table


def _shaped(name: str, group: str, values, n: int) -> np.ndarray:
    array = np.asarray(values, dtype=float)
    width = len(GROUPS[group][0])
    shape = (n, width) if width else (n,)
    if array.shape != shape:
        raise UserError(f"{name}: {group} has shape {array.shape}, expected {shape}")
    return array


def read_recording(path: str | os.PathLike, columns: str | os.PathLike | None = None) -> Recording:
    """The recording in ``path`` (.csv, .csv.gz or .parquet).

    ``columns`` is a TOML file for a foreign log; it renames columns and declares axes::

        [columns]
        "GyrX" = "gyro_x [deg/s]"
        [frame]
        body = "frd"     # "flu", or a 3 x 3 rotation R with v_flu = R v_log (also as the key R)
        world = "ned"    # "enu"; in ned a heading is a compass heading
        q = "bn"         # world to body; "nb" is body to world

    Raises UserError, one line with file, row (as a spreadsheet counts, the header is row 1) and column, for what cannot
    be used; what can is listed in ``Recording.findings``.
    """
    path = Path(path)
    foreign = read_map(Path(columns)) if columns is not None else ForeignMap()
    table = open_table(path)
    header = Header(path, foreign.rename(path, table.header))
    findings = list(header.findings)
    values = header.convert(table.read(header.positions, header.positions[header.names.index("time")]), findings)
    time, values = _clean_time(table, values, findings)
    groups = _grouped(values, findings)
    _report_missing(groups, findings)
    return Recording(_stem(path), time, **foreign.turn(groups), path=path, findings=tuple(findings),
                     frame_declared=foreign.body is not None)


def _stem(path: Path) -> str:
    return re.sub(r"(?i)(\.csv(\.gz)?|\.parquet)$", "", path.name)


# Rows: the order of the time, repeats, gaps, missing values


def _clean_time(table: CsvTable | ParquetTable, values: dict[str, np.ndarray], findings: list[Finding],
                ) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Time (n,) that increases strictly, and the other columns at the rows that were kept."""
    time = values.pop("time")
    missing = np.flatnonzero(~np.isfinite(time))
    if len(missing):
        raise UserError(f"{table.path}: row {table.row(missing[0])}: the time is missing")
    back = np.flatnonzero(np.diff(time) < 0)
    if len(back):
        before, after = time[back[0]], time[back[0] + 1]
        place = f"{table.path}: row {table.row(back[0] + 1)}"
        raise UserError(f"{place}: the time runs backwards, {after:.9g} s follows {before:.9g} s")
    keep = _not_repeated(time, values, findings)
    if keep.sum() < 3:
        raise UserError(f"{table.path}: {keep.sum()} rows of data, a recording needs at least 3")
    time = time[keep]
    _report_gaps(time, findings)
    return time, {name: column[keep] for name, column in values.items()}


def _not_repeated(time: np.ndarray, values: Mapping[str, np.ndarray], findings: list[Finding]) -> np.ndarray:
    """Mask of the rows that are the first with their time."""
    keep = np.concatenate(([True], np.diff(time) > 0)) if len(time) else np.zeros(0, bool)
    again = np.flatnonzero(~keep)
    if len(again):
        same = np.all([_equal(v[again], v[again - 1]) for v in values.values()], axis=0)
        for kind, rows in (("repeated_rows", again[same]), ("repeated_time", again[~same])):
            if len(rows):
                findings.append(Finding(kind, "time", len(rows), {"first": float(time[rows[0]])}))
    return keep


def _equal(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (a == b) | (np.isnan(a) & np.isnan(b))


def _report_gaps(time: np.ndarray, findings: list[Finding]) -> None:
    step = np.diff(time)
    gaps = step[step > GAP * np.median(step)]
    if len(gaps):
        findings.append(Finding("gaps", "time", len(gaps), {"longest": float(gaps.max()), "total": float(gaps.sum())}))


def _grouped(values: Mapping[str, np.ndarray], findings: list[Finding]) -> dict[str, np.ndarray]:
    groups = {}
    for group, (suffixes, _) in GROUPS.items():
        names = column_names(group)
        if names[0] in values:
            groups[group] = np.column_stack([values[name] for name in names]) if suffixes else values[names[0]]
    if "ref_q" in groups:
        groups["ref_q"] = _normalised(groups["ref_q"], findings)
    return groups


def _normalised(q: np.ndarray, findings: list[Finding]) -> np.ndarray:
    """Unit quaternions; a norm far from one is reported, and one below a half (zeros for "not seen") is missing."""
    norm = np.linalg.norm(q, axis=1)
    odd = np.abs(norm - 1) > NORM_TOLERANCE
    if odd.any():
        detail = {"largest": float(norm[odd].max()), "least": float(norm[odd].min())}
        findings.append(Finding("reference_norm", "ref_q", int(odd.sum()), detail))
    return q / np.where(norm < 0.5, np.nan, norm)[:, None]


def _report_missing(groups: Mapping[str, np.ndarray], findings: list[Finding]) -> None:
    for group in ("gyro", "accel"):
        if group in groups:
            for name, count in zip(column_names(group), np.isnan(groups[group]).sum(axis=0)):
                if count:
                    findings.append(Finding("missing_cells", name, int(count)))
