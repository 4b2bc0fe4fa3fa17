"""Column maps: TOML files that rename columns, declare axes and scale raw counts.

They also give the sample rate of a log without times, say how far its clock is from another's, and
name the files that hold more columns.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import permutations
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding, UserError
from pyimu.files import read_toml
from pyimu.recording.angles import SEQUENCE
from pyimu.recording.clock import RATES
from pyimu.recording.columns import GROUPS, XYZ
from pyimu.recording.counts import Scale, finite_number, read_scales
from pyimu.recording.packing import Packing, packing_in
from pyimu.units import UnitError, convert, did_you_mean

_UNIT = re.compile(r" ?\([^()]*\)$")
_FRD = np.diag([1.0, -1.0, -1.0])
_NED = np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
BODY = {"flu": np.eye(3), "frd": _FRD}
"""Rotations to forward-left-up from the axes of a name."""
_WORLD = {"enu": np.eye(3), "ned": _NED}
SEQUENCES = (SEQUENCE, *(s for s in map("".join, permutations("xyz")) if s != SEQUENCE))
"""In which roll, pitch and yaw may turn, the usual one first."""
_AXES = tuple(name for name, g in GROUPS.items() if g.suffixes == XYZ)
"""The groups that are vectors in body axes."""


@dataclass(frozen=True)
class ForeignMap:
    """What the TOML file given as ``columns`` declares."""

    path: Path | None = None
    columns: Mapping[str, str] = field(default_factory=dict)
    scale: Mapping[str, Scale] = field(default_factory=dict)
    topics: Mapping[str, str] = field(default_factory=dict)
    body: np.ndarray | None = None
    world: str = "enu"
    q: str = "nb"
    angles: str = SEQUENCE
    rate: float | None = None
    offset: float = 0.0
    files: tuple[tuple[str, ForeignMap], ...] = ()
    binary: Packing | None = None
    """What the rows are of a file of binary numbers."""
    notes: tuple[Finding, ...] = ()
    """What was decided where no user wrote it."""

    def rename(self, path: Path, header: list[str]) -> list[str]:
        """The names of the columns by the map. Raises UserError for one that is not there."""
        columns = self.named(header)
        for name in columns:
            if name not in header:
                raise UserError(
                    f'{self.path}: key columns."{name}": {path} has no such '
                    f"column{did_you_mean(name, header)}"
                )
        return [columns.get(cell, cell) for cell in header]

    def named(self, header: Sequence[str]) -> dict[str, str]:
        """``columns`` by the cells of a header; it may leave out a unit that stands behind them:
        ``imu/gyro[0]`` of ``imu/gyro[0] (deg/s)``.
        """
        bare = [_UNIT.sub("", cell) for cell in header]
        return {
            header[bare.index(name)] if name not in header and bare.count(name) == 1 else name: to
            for name, to in self.columns.items()
        }

    @property
    def frame(self) -> dict[str, Any]:
        """The table ``[frame]`` that says its axes; empty of those of the package."""
        body = None if self.body is None else self.body.tolist()
        said = {
            "body": next((name for name, axes in BODY.items() if axes.tolist() == body), body),
            "world": self.world,
            "q": self.q,
            "angles": self.angles,
        }
        usual = ForeignMap()
        return {k: v for k, v in said.items() if v is not None and v != getattr(usual, k)}

    def turn(self, groups: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """The groups in forward-left-up and east-north-up axes.

        The result of a sample does not depend on its neighbours.
        """
        turned = dict(groups)
        if self.body is not None:
            turned |= {g: _rotated(self.body, groups[g]) for g in _AXES if g in groups}
        if self.world == "ned":
            turned |= {
                g: math.pi / 2 - groups[g] for g in ("heading", "ref_heading") if g in groups
            }
        if "ref_q" in groups and (self.body is not None or self.world == "ned" or self.q == "bn"):
            turned["ref_q"] = self._turned_attitude(groups["ref_q"])
        return turned

    def _turned_attitude(self, q: np.ndarray) -> np.ndarray:
        turned, seen = np.full_like(q, np.nan), np.all(np.isfinite(q), axis=1)
        if seen.any():
            attitude = Rotation.from_quat(q[seen], scalar_first=True)
            attitude = attitude.inv() if self.q == "bn" else attitude
            body = Rotation.from_matrix(np.eye(3) if self.body is None else self.body)
            turned[seen] = (
                Rotation.from_matrix(_WORLD[self.world]) * attitude * body.inv()
            ).as_quat(scalar_first=True)
        return turned


def _rotated(rotation: np.ndarray, v: np.ndarray) -> np.ndarray:
    """R v for each row of ``v`` (n, 3), with the same order of operations for any n.

    A matrix product does not guarantee an order.
    """
    x, y, z = v.T
    return np.column_stack([a * x + b * y + c * z for a, b, c in rotation])


def read_map(path: Path) -> ForeignMap:
    """The column map in the TOML file ``path``. Raises UserError, with the key."""
    return map_of(read_toml(path), path)


def map_of(data: Mapping[str, Any], path: Path) -> ForeignMap:
    """The column map that a TOML file's ``data`` are; messages call it ``path``."""
    known = ("columns", "frame", "scale", "topics", "sample_rate", "time_offset", "file", "binary")
    _known_keys(path, "", data, known)
    frame = data.get("frame", {})
    _known_keys(path, "frame.", frame, ("body", "world", "q", "R", "angles"))
    topics = _texts(path, "topics", data, "/imu/data")
    _known_keys(path, "topics.", topics, ("imu", "temperature"))
    foreign = ForeignMap(
        path,
        _texts(path, "columns", data, "gyro_x [deg/s]"),
        read_scales(path, data.get("scale", {})),
        topics,
        _body(path, frame),
        world=_choice(path, frame, "world", ("enu", "ned")),
        q=_choice(path, frame, "q", ("nb", "bn")),
        angles=_choice(path, frame, "angles", SEQUENCES),
        rate=_rate(path, data.get("sample_rate")),
        offset=_offset(path, data.get("time_offset")),
        binary=packing_in(data, path),
    )
    return replace(foreign, files=_files(path, data.get("file", []), foreign))


def _rate(path: Path, entry: Any) -> float | None:
    """Hz of the key ``sample_rate``. Raises UserError for a rate that no sensor has."""
    if entry is None:
        return None
    hertz = _quantity(path, "sample_rate", entry, 'sample_rate = {value = 100.0, unit = "Hz"}')
    if not RATES[0] <= hertz <= RATES[1]:
        raise UserError(
            f"{path}: key sample_rate: {hertz:g} Hz, must lie between {RATES[0]:g} and "
            f"{RATES[1]:g} Hz"
        )
    return hertz


def _offset(path: Path, entry: Any) -> float:
    """s of the key ``time_offset``, 0 where there is none."""
    if entry is None:
        return 0.0
    return _quantity(path, "time_offset", entry, 'time_offset = {value = 12.5, unit = "s"}')


def _quantity(path: Path, key: str, entry: Any, example: str) -> float:
    """A value with a unit, in that of the ``example``. Raises UserError, with the key."""
    unit = example.split('"')[1]
    if not isinstance(entry, dict) or set(entry) != {"value", "unit"}:
        raise UserError(f"{path}: key {key} must be such as {example}")
    value = finite_number(path, f"{key}.value", entry["value"])
    try:
        return float(convert(value, entry["unit"], unit))
    except UnitError as error:
        raise UserError(f"{path}: key {key}.unit: {error}; write {example}") from None


def _files(path: Path, entries: Any, whole: ForeignMap) -> tuple[tuple[str, ForeignMap], ...]:
    """The further files, each with its map; axes are those of the ``whole``."""
    example = '[[file]] with name = "Accelerometer.csv" and a table [file.columns]'
    if not isinstance(entries, list):
        raise UserError(f"{path}: key file must be such as {example}")
    found = []
    for entry in entries:
        known = ("name", "topic", "columns", "scale", "sample_rate", "binary")
        _known_keys(path, "file.", entry, known)
        name = entry.get("name")
        if not isinstance(name, str) or not name:
            raise UserError(f"{path}: key file.name is missing, write {example}")
        columns = _texts(path, "columns", entry, "accel_x [m/s^2]")
        scale = read_scales(path, entry.get("scale", {}))
        rate = _rate(path, entry.get("sample_rate"))
        topic = entry.get("topic", "")
        if not isinstance(topic, str):
            raise UserError(f'{path}: key file.topic must be text such as "UncalAccel"')
        topics = {"imu": topic} if topic else {}
        own = replace(whole, columns=columns, scale=scale, rate=rate, offset=0.0, topics=topics)
        own = replace(own, binary=packing_in(entry, path))
        found.append((name, own))
    return tuple(found)


def _texts(path: Path, key: str, data: Mapping[str, Any], example: str) -> Mapping[str, str]:
    """The table ``key``, of texts."""
    table = data.get(key, {})
    if not isinstance(table, dict):
        raise UserError(f"{path}: key {key} must be a table")
    for name, target in table.items():
        if not isinstance(target, str):
            raise UserError(f'{path}: key {key}."{name}" must be text such as "{example}"')
    return table


def _known_keys(path: Path, prefix: str, table: Any, known: Sequence[str]) -> None:
    if not isinstance(table, dict):
        raise UserError(f"{path}: key {prefix.rstrip('.')} must be a table")
    for key in table:
        if key not in known:
            raise UserError(
                f"{path}: unknown key {prefix}{key}{did_you_mean(key, known)}; known are "
                f"{', '.join(known)}"
            )


def _choice(path: Path, frame: Mapping[str, Any], key: str, choices: Sequence[str]) -> str:
    value = frame.get(key, choices[0])
    if value not in choices:
        raise UserError(
            f"{path}: key frame.{key} must be one of {', '.join(choices)}, not {value!r}"
        )
    return value


def _body(path: Path, frame: Mapping[str, Any]) -> np.ndarray | None:
    """The rotation from the log's body axes to forward-left-up, None where the file has none."""
    if "body" in frame and "R" in frame:
        raise UserError(f"{path}: keys frame.body and frame.R say the same, keep one")
    key = "R" if "R" in frame else "body"
    value = frame.get(key)
    if value is None or isinstance(value, str):
        return None if value is None else BODY[_choice(path, frame, key, tuple(BODY))]
    try:
        matrix = np.array(value, dtype=float)
    except (TypeError, ValueError):
        matrix = np.zeros(0)
    if (
        matrix.shape != (3, 3)
        or not np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-6)
        or np.linalg.det(matrix) < 0
    ):
        raise UserError(f'{path}: key frame.{key} must be "flu", "frd" or a 3 x 3 rotation matrix')
    return matrix
