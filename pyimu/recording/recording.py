"""Recordings: a log of an inertial sensor and what is known of the truth, read whole or in pieces.

Formats: CSV (also .gz), Parquet, MAT, HDF5, ROS bags and MCAP. One row is a sample; a header cell
is a name and its unit, ``gyro_x [deg/s]``. ``GROUPS`` lists every column that has a meaning.
Inside, all is SI and radians (temperature degC), axes are forward-left-up and east-north-up, and a
missing value is NaN.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, make_dataclass, replace
from functools import cached_property
from inspect import cleandoc
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pyimu.display import notebook
from pyimu.errors import Finding, UserError
from pyimu.recording import show
from pyimu.recording.clock import Cadence, cadence_of, segments
from pyimu.recording.columns import GROUPS, MARKS, column_names
from pyimu.recording.formats.suffix import write_table
from pyimu.recording.gaps import gap_rows
from pyimu.units import did_you_mean

if TYPE_CHECKING:
    from pandas import DataFrame

_Columns = make_dataclass(
    "_Columns",
    [("name", str), ("time", np.ndarray), *((g, np.ndarray | None, None) for g in GROUPS)],
    frozen=True,
    eq=False,
)


@dataclass(frozen=True, eq=False)
class Recording(_Columns):
    """One log: its ``name``, its strictly increasing ``time`` (n,) [s], and groups of columns.

    A group is an attribute by its name in ``GROUPS``, listed below: an array (n,) or (n, columns)
    in SI, NaN where a value is missing, or None where the log has no such group.

    ``stated`` has the unit that a file states of a group, by the group's name: none of arrays, nor
    of counts. ``frame_declared`` says that the log's axes were stated, not assumed. ``period`` [s]
    is the sample period, ``longest`` [s] the step above which there may be a gap, and ``gaps``
    (m,) the rows that follow one, where they are known otherwise than from ``time``: of a piece of
    a log they are the log's. ``reference`` is where the log's reference came from, if that has
    times of its own, and ``reference_apart`` whether another clock gave them.
    """

    path: Path | None = None
    findings: tuple[Finding, ...] = ()
    frame_declared: bool = False
    stated: Mapping[str, str] = field(default_factory=dict)
    period: float | None = None
    longest: float | None = None
    gaps: np.ndarray | None = None
    reference: Recording | None = None
    reference_apart: bool = False

    if TYPE_CHECKING:

        def __getattr__(self, group: str) -> Any: ...

    @classmethod
    def from_arrays(
        cls, name: str = "recording", *, time: ArrayLike, **groups: ArrayLike
    ) -> Recording:
        """A recording of arrays: ``time`` (n,) s, and groups by name.

        A group is such as ``gyro`` (n, 3) rad/s.

        Raises UserError for an unknown group, a wrong shape, a time that does not increase, or a
        mark that is not from 0 to 1.
        """
        time = np.asarray(time, dtype=float)
        if (
            time.ndim != 1
            or len(time) < 1
            or not np.all(np.isfinite(time))
            or np.any(np.diff(time) <= 0)
        ):
            raise UserError(f"{name}: time must be a (n,) array of finite seconds that increases")
        known = {f.name for f in fields(cls)}
        for group in groups:
            if group not in known:
                near = did_you_mean(group, GROUPS)
                raise UserError(
                    f"{name}: unknown group '{group}'{near}; known are {', '.join(GROUPS)}"
                )
        arrays = {
            g: _shaped(name, g, groups.pop(g), len(time))
            for g in GROUPS
            if groups.get(g) is not None
        }
        check_marks(name, time, arrays)
        return cls(name=name, time=time, **(groups | arrays))

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        return (
            f"Recording({self.name!r}: {len(self)} samples, {self.sample_rate:.6g} Hz, "
            f"{', '.join(self.groups)})"
        )

    _repr_html_ = show.as_html
    plot = show.plot

    if TYPE_CHECKING:  # ``pyimu.recording.log``, which reads files, gives it

        @classmethod
        def from_frame(
            cls,
            frame: Any,
            name: str = "frame",
            columns: Mapping[str, Any] | str | os.PathLike | None = None,
        ) -> Recording: ...

    def to_frame(self) -> DataFrame:
        """The columns as a pandas data frame, named with their units in SI: ``gyro_x [rad/s]``.

        ``Recording.from_frame`` of it is the same recording.
        """
        return notebook.data_frame(self._table())

    @property
    def groups(self) -> dict[str, np.ndarray]:
        """The groups that the recording holds, by name, in the order of ``GROUPS``."""
        return {group: getattr(self, group) for group in GROUPS if getattr(self, group) is not None}

    @cached_property
    def cadence(self) -> Cadence:
        """The sample period, and the step of the time above which there may be a gap."""
        if self.period is None:
            return cadence_of(self.time)
        return (
            Cadence.of_period(self.period)
            if self.longest is None
            else Cadence(self.period, self.longest)
        )

    @property
    def sample_period(self) -> float:
        """s; the time between gaps over its steps."""
        return self.cadence.period

    @property
    def sample_rate(self) -> float:
        """Hz."""
        return 1 / self.sample_period

    @cached_property
    def segments(self) -> list[tuple[int, int]]:
        """Index ranges (start, stop) without gap.

        A gap is a step above 1.5 sample periods after which the stamps stay late.
        """
        gaps = (
            gap_rows(self.time, self.cadence.period, self.cadence.longest)
            if self.gaps is None
            else self.gaps
        )
        return segments(gaps, len(self))

    def slice(self, start: int | None = None, stop: int | None = None) -> Recording:
        """The samples start <= k < stop, as a recording; findings stay those of the whole log."""
        rows = slice(start, stop)
        first, last, _ = rows.indices(len(self))
        gaps = (
            None
            if self.gaps is None
            else self.gaps[(self.gaps >= first) & (self.gaps < last)] - first
        )
        return replace(
            self,
            time=self.time[rows],
            gaps=gaps,
            **{name: values[rows] for name, values in self.groups.items()},
        )

    def write(self, path: str | os.PathLike) -> Path:
        """Writes the recording to ``path`` (.csv, .csv.gz or .parquet), exactly, in SI.

        The file appears whole or not at all. Raises UserError for another suffix or a folder that
        cannot be written.
        """
        write_table(Path(path), self._table())
        return Path(path)

    def _table(self) -> dict[str, np.ndarray]:
        table = {"time [s]": self.time}
        for group, values in self.groups.items():
            columns = values.reshape(len(self), -1).T
            table |= {
                f"{name} [{GROUPS[group].unit}]": column
                for name, column in zip(column_names(group), columns)
            }
        return table


Recording.__doc__ = (
    cleandoc(Recording.__doc__)
    + "\n\nGroups:\n\n"
    + "".join(
        f"``{name}`` {f'(n, {len(g.suffixes)})' if g.suffixes else '(n,)'} [{g.unit}]: {g.text}\n"
        for name, g in GROUPS.items()
    )
)


def _shaped(name: str, group: str, values, n: int) -> np.ndarray:
    array = np.asarray(values, dtype=float)
    width = len(GROUPS[group].suffixes)
    shape = (n, width) if width else (n,)
    if array.shape != shape:
        raise UserError(f"{name}: {group} has shape {array.shape}, expected {shape}")
    return array


def check_marks(name: str | os.PathLike, time: np.ndarray, groups: Mapping[str, Any]) -> None:
    """Raise UserError for a mark of rows (``stationary``, ``moving``) that is below 0 or above 1:
    a count or a code, which says something else. ``name`` is that of the log.
    """
    for mark in MARKS:
        values = groups.get(mark)
        wrong = () if values is None else np.flatnonzero((values < 0.0) | (values > 1.0))
        if len(wrong):
            raise UserError(
                f"{name}: {mark} is {values[wrong[0]]:g} at {time[wrong[0]]:g} s, expected 0 or 1: "
                f"the {GROUPS[mark].text}"
            )


def at_own_times(recording: Recording, time: np.ndarray, **groups: np.ndarray) -> Recording:
    """The recording with these groups alone, at times (k,) s of their own."""
    alone = {g: None for g in GROUPS} | groups
    return replace(recording, time=time, period=None, gaps=None, longest=None, **alone)


def filled(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """``values`` (n, ...) with missing cells interpolated linearly, column by column.

    A column without any number stays missing.
    """
    out = np.array(values, dtype=float)
    for column in out.reshape(len(out), -1).T:
        known = np.isfinite(column)
        if known.any() and not known.all():
            column[~known] = np.interp(time[~known], time[known], column[known])
    return out


def join(pieces: Sequence[Recording]) -> Recording:
    """Consecutive pieces of one log as one recording. Raises ValueError for no piece."""
    if not pieces:
        raise ValueError("no pieces to join")
    if len(pieces) == 1:
        return pieces[0]
    groups = {
        group: np.concatenate([getattr(piece, group) for piece in pieces])
        for group in pieces[0].groups
    }
    return replace(
        pieces[0],
        time=np.concatenate([piece.time for piece in pieces]),
        gaps=_joined_gaps(pieces),
        **groups,
    )


def _joined_gaps(pieces: Sequence[Recording]) -> np.ndarray | None:
    """The rows that follow a gap, None where a piece does not know its own."""
    starts = np.cumsum([0, *map(len, pieces)])
    known = [piece.gaps + start for piece, start in zip(pieces, starts) if piece.gaps is not None]
    return np.concatenate(known) if len(known) == len(pieces) else None


def copied(piece: Recording) -> Recording:
    """A piece that does not keep alive the arrays which it was cut from."""
    return replace(
        piece,
        time=piece.time.copy(),
        **{group: np.copy(values) for group, values in piece.groups.items()},
    )
