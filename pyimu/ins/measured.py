"""Positions and velocities that a recording has, as a satellite receiver's, for the filter."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from pyimu.block.parameters import number
from pyimu.errors import Finding, UserError
from pyimu.ins.filtered import Filtered
from pyimu.recording.recording import Recording
from pyimu.recording.reference.track import fresh

ENU = ("east", "north", "up")

MEASURED = tuple(f"{name}_{axis}" for name in ("position", "velocity") for axis in ENU)
"""Columns of a recording."""

COURSE = 2.0
"""m; of a way, by whose direction the first heading is known where nothing tells it."""

MOST_WRONG = 0.5
"""Share of what was told of the motion that contradicts the estimate, beyond which it is of another
frame."""


@dataclass(frozen=True, eq=False)
class Fixes:
    """What of a recording's positions and velocities corrects the filter.

    ``columns`` (n,) are the filter's inputs by name; ``rows`` (m,) are those with a position,
    ``position`` (m, 3) m the positions from the first on, NaN where an axis is missing. The first
    is the origin, and no measurement: its error is that of the position at the start, ``std`` m.
    """

    columns: Mapping[str, np.ndarray]
    rows: np.ndarray
    position: np.ndarray
    std: float

    def of_antenna(self, arm: np.ndarray) -> Mapping[str, np.ndarray]:
        """The columns where the sensor is the origin, and the antenna begins at ``arm`` (3,) m."""
        names = [f"position_measured[{i}]" for i in (1, 2, 3)]
        if names[0] not in self.columns:
            return self.columns
        moved = {n: self.columns[n] + v for n, v in zip(names, arm, strict=True)}
        return {**self.columns, **moved}

    @property
    def settings(self) -> dict[str, float]:
        """Parameters of the filter that follow."""
        return {"position_std0": self.std} if len(self.rows) else {}

    def ways(self, time: np.ndarray) -> Iterator[tuple[str, np.ndarray, np.ndarray, float]]:
        """The ways that positions, and velocities over the ``time`` (n,), tell: of what, their rows
        (k,), the positions there (k, 3) m from the first on, and the standard deviation of one.
        """
        if len(self.rows):
            yield "positions", self.rows, self.position, self.std
        rows = np.flatnonzero(self.columns.get("velocity_valid", np.zeros(0)))
        if len(rows) < 2:
            return
        velocity = np.column_stack([self.columns[f"velocity_measured[{i}]"][rows] for i in (1, 2)])
        step = np.diff(time[rows])
        moved = (velocity[1:] + velocity[:-1]) / 2 * step[:, None]
        position = np.zeros((len(rows), 3))
        position[1:, :2] = np.cumsum(moved, axis=0)
        end = np.argmax(np.linalg.norm(position, axis=1) > COURSE) or len(rows) - 1
        errors = self.columns["velocity_variance"][rows[1 : end + 1]] * step[:end] ** 2
        yield "measured velocities", rows, position, float(np.sqrt(errors.sum()))


@dataclass(frozen=True)
class Told:
    """What was told of positions and velocities beside the recording: their standard deviations in
    m and m/s, and how many s before its row each was true; None where its column says it.
    """

    position_std: float | None = None
    velocity_std: float | None = None
    position_age: float | None = None
    velocity_age: float | None = None


def measures_speed(recording: Recording) -> bool:
    """Whether a recording has measured speeds."""
    return recording.speed is not None and bool(np.isfinite(recording.speed).any())


def fixes_of(
    recording: Recording,
    told: Told | None = None,
    top_speed: float = 0.0,
) -> Fixes | None:
    """The recording's positions and velocities, None without; what was ``told`` of them stands for
    columns. At a ``top_speed`` in m/s the body may have moved before the first position.

    Raises UserError where a standard deviation is missing or not above zero, an age is below zero
    or as long as the recording, and where something was told of measurements that are not there.
    """
    columns: dict[str, np.ndarray] = {}
    found, told = {}, told or Told()
    for name, unit, given, age in (
        ("position", "m", told.position_std, told.position_age),
        ("velocity", "m/s", told.velocity_std, told.velocity_age),
    ):
        values = _values(recording, name)
        if values is None:
            _check_needed(recording, name, {"std": given, "age": age})
            continue
        rows = np.flatnonzero(np.isfinite(values[:, :2]).all(axis=1))
        std = _std(recording, name, unit, given, rows)
        late = _age(recording, name, age, rows)
        values, std = _at_their_rows(recording, values, std, late)
        measured, rows = rows, np.flatnonzero(np.isfinite(values[:, :2]).all(axis=1))
        if len(measured) and not len(rows):
            raise UserError(
                f"{recording.name}: {name}_age is {late[measured].min():g} s or more, by which "
                f"each measured {name} is of before the log or of a gap; an age is in s"
            )
        if name == "position" and len(rows):
            values = values - _origin(values[rows])
        found[name] = rows, values[rows], std[rows]
        columns |= _columns(name, values, std, rows[1:] if name == "position" else rows)
    if not columns:
        return None
    none = np.zeros(0, dtype=int), np.zeros((0, 3)), np.zeros(0)
    rows, position, std = found.get("position", none)
    if not len(rows):
        return Fixes(columns, rows, position, 0.0)
    waited = float(recording.time[rows[0]] - recording.time[0])
    return Fixes(columns, rows, position, float(np.hypot(std[0], top_speed * waited)))


def _check_needed(recording: Recording, name: str, told: Mapping[str, float | None]) -> None:
    """Raise UserError where something was told of measurements that the recording has not."""
    for what, value in told.items():
        if value is not None:
            raise UserError(
                f"{recording.name}: {name}_{what} was told, and there is no measured {name}; the "
                f"log's columns {name}_east, {name}_north, {name}_up are one"
            )


def _age(recording: Recording, name: str, given: float | None, rows: np.ndarray) -> np.ndarray:
    """How many s (n,) before its row each measurement was true."""
    age = _told(recording, f"{name}_age", given)
    if age is None:
        return np.zeros(len(recording))
    _check(recording, f"{name}_age", "s", age, given, rows[~(age[rows] >= 0)], "0 or more")
    return age


def _told(recording: Recording, name: str, given: float | None) -> np.ndarray | None:
    """A figure of measurements (n,): what was ``given``, else the column of its name."""
    if given is not None:
        return np.full(len(recording), number(name, given))
    return getattr(recording, name)


def _check(
    recording: Recording,
    name: str,
    unit: str,
    values: np.ndarray,
    given: float | None,
    wrong: np.ndarray,
    expected: str,
) -> None:
    """Raise UserError at the first of the rows that are ``wrong``."""
    if len(wrong):
        where = "" if given is not None else f" at {recording.time[wrong[0]]:g} s"
        raise UserError(
            f"{recording.name}: {name} is {values[wrong[0]]:g} {unit}{where}, expected {expected}"
        )


def _at_their_rows(
    recording: Recording, values: np.ndarray, std: np.ndarray, age: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The measurements (n, 3) and their standard deviations (n,) at the rows of their ``age`` ago.

    Between the instants of two measurements a row's is on the line through them: it is at most
    half a sample from one of them. What is of before the first row, or of a gap, is left out.
    """
    seen = np.flatnonzero(np.isfinite(values[:, :2]).all(axis=1))
    if not np.any(age[seen]):
        return values, std
    time = recording.time
    order = np.argsort(time[seen] - age[seen], kind="stable")
    seen, instant = seen[order], (time[seen] - age[seen])[order]
    rows = np.searchsorted((time[1:] + time[:-1]) / 2, instant)
    near = np.abs(time[rows] - instant) <= recording.sample_period
    out, wide = np.full(values.shape, np.nan), np.full(std.shape, np.nan)
    for axis, column in enumerate(values[seen].T):
        known = np.isfinite(column)
        if known.any():
            line = np.interp(time[rows], instant[known], column[known])
            out[rows[near & known], axis] = line[near & known]
    wide[rows[near]] = std[seen[near]]
    return out, wide


def _values(recording: Recording, name: str) -> np.ndarray | None:
    """East, north, up (n, 3), NaN where missing, and where a log holds the last one until the next
    is there; None where one of the first two is.
    """
    east, north, up = (getattr(recording, f"{name}_{axis}") for axis in ENU)
    if east is None and north is None:
        return None
    for axis, values in (("east", east), ("north", north)):
        if values is None:
            raise UserError(
                f"{recording.name}: {name}_{axis} is missing beside its other axis; a {name} takes "
                f"{name}_east and {name}_north"
            )
    values = np.column_stack([east, north, np.full(len(recording), np.nan) if up is None else up])
    held = np.ones(len(values), dtype=bool)
    held[fresh(values[:, :2])] = False
    values[held] = np.nan
    return values


def _origin(values: np.ndarray) -> np.ndarray:
    """The first position (3,), of the height the first there is."""
    heights = values[np.isfinite(values[:, 2]), 2]
    return np.array([values[0, 0], values[0, 1], heights[0] if len(heights) else 0.0])


def _std(
    recording: Recording, name: str, unit: str, given: float | None, rows: np.ndarray
) -> np.ndarray:
    """The standard deviations (n,)."""
    std = _told(recording, f"{name}_std", given)
    if std is None:
        raise UserError(
            f"{recording.name}: {name}_east, {name}_north come without a standard deviation; a "
            f"column '{name}_std [{unit}]' or --{name}-std says it, --no-fixes leaves them out"
        )
    _check(recording, f"{name}_std", unit, std, given, rows[~(std[rows] > 0)], "above 0")
    return std


def _columns(
    name: str, values: np.ndarray, std: np.ndarray, rows: np.ndarray
) -> dict[str, np.ndarray]:
    valid = np.zeros(len(values))
    valid[rows] = 1.0
    measured = {f"{name}_measured[{i + 1}]": c for i, c in enumerate(values.T)}
    return measured | {f"{name}_valid": valid, f"{name}_variance": np.nan_to_num(std) ** 2}


class NoFoot(UserError):
    """What was taken for the stances of a foot is none, by the rest of the log."""


CONTRADICTED = {"position": 16, "velocity": 32}
"""Bits of the filter's status."""


def wrong_rows(found: Filtered, name: str, fixes: Fixes) -> np.ndarray:
    """Marks (n,) of the measurements, of ``CONTRADICTED``, that contradicted the estimate."""
    status = found.scalar("status").astype(int)
    return (status & CONTRADICTED[name] > 0) & (fixes.columns[f"{name}_valid"] > 0)


def check_fixes(
    recording: Recording, fixes: Fixes | None, found: Filtered, moves: bool, foot: bool = False
) -> list[Finding]:
    """What the filter's run says of the positions and velocities; ``moves`` says that the positions
    go a way during rests, ``foot`` that the velocities are those of stances.

    Raises UserError where most of them contradict it.
    """
    out = []
    for name in CONTRADICTED:
        valid = None if fixes is None else fixes.columns.get(f"{name}_valid")
        if fixes is None or valid is None or not valid.any():
            continue
        wrong = wrong_rows(found, name, fixes)
        share = np.count_nonzero(wrong) / np.count_nonzero(valid)
        first = float(recording.time[np.argmax(wrong)])
        if share > MOST_WRONG and foot and name == "velocity":
            raise NoFoot(
                f"{recording.name}: {share:.0%} of what --zupt foot takes for stances contradicts "
                f"gyro and accelerometer, the first at {first:.6g} s; is the sensor on a foot?"
            )
        if share > MOST_WRONG:
            raise (NoFoot if foot else UserError)(
                f"{recording.name}: {share:.0%} of the measured {name} contradicts gyro and "
                f"accelerometer by more than {name}_std allows, the first at {first:.6g} s; "
                + _why(name, moves)
            )
        detail = {"share": share, "of": int(valid.sum()), "first": first}
        out.append(Finding(f"{name}_fixes", name, int(wrong.sum()), detail))
    return out


def _why(name: str, moves: bool) -> str:
    """What may be wrong with measurements of which most contradict the estimate."""
    if moves:
        return (
            "the positions move during what was taken for rests: a drive at constant speed looks "
            "like a rest, and a column stationary or --zupt off leaves such rests out"
        )
    return (
        f"is {name}_east, {name}_north in another frame, unit or order, did it jump there, is it "
        f"later than its rows (--{name}-age), or its antenna beside the sensor (--antenna)? "
        "--no-fixes leaves it out"
    )
