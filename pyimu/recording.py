"""Recordings: a log of an inertial sensor and what is known of the truth, read whole or in pieces.

Formats: CSV (also .gz), Parquet, MAT, HDF5, ROS bags and MCAP.  One row is a sample; a header cell is a name and its unit,
``gyro_x [deg/s]``.  ``GROUPS`` lists every column that has a meaning.  Inside, all is SI and radians (temperature degC), axes
are forward-left-up and east-north-up, and a missing value is NaN.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from itertools import chain
from pathlib import Path

import numpy as np

from pyimu.clock import Cadence, Clock, cadence_of, segments
from pyimu.columns import GROUPS, column_names
from pyimu.errors import Finding, UserError
from pyimu.gaps import GapFinder, gap_rows
from pyimu.rows import Rows, Source
from pyimu.table import stem, write_table
from pyimu.units import did_you_mean

__all__ = ["GROUPS", "Finding", "Log", "Recording", "column_names", "filled", "join", "open_log", "read_recording"]

HEAD = 1 << 16
"""Rows at the start of a log from which its sample period is taken before the rest is read."""


@dataclass(frozen=True, eq=False)
class Recording:
    """One log.  Arrays are (n,) or (n, columns) in SI, NaN where a value is missing, None where a group is absent.

    ``time`` [s] increases strictly; ``gyro`` [rad/s] and ``accel`` [m/s^2] are the measured rate against inertial space
    and specific force in body axes; ``temperature`` [degC].  Of the truth: ``ref_rate`` [rad/s], ``ref_q`` (n, 4) (unit
    quaternion, scalar first, body to world), ``ref_heading`` [rad] (counter-clockwise from east), ``ref_force``
    [m/s^2], ``ref_north``, ``ref_east``, ``ref_up`` [m], ``ref_velocity`` (n, 3) east, north, up [m/s], ``latitude``
    [rad], and the marks ``moving`` and ``stationary`` (0 or 1).  Further sensors: ``heading`` and ``heading_std`` [rad],
    ``supply`` [V], ``mag`` [T].  ``frame_declared`` says that the log's axes were stated, not assumed.  ``period`` [s] is the
    sample period, ``longest`` [s] the step above which there may be a gap, and ``gaps`` (m,) the rows that follow one, where they are
    known otherwise than from ``time``: of a piece of a log they are the log's.
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
    period: float | None = None
    longest: float | None = None
    gaps: np.ndarray | None = None

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
    def cadence(self) -> Cadence:
        """The sample period, and the step of the time above which there may be a gap."""
        if self.period is None:
            return cadence_of(self.time)
        return Cadence.of_period(self.period) if self.longest is None else Cadence(self.period, self.longest)

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
        """Index ranges (start, stop) without gap: no step above 1.5 sample periods after which the stamps stay late."""
        gaps = gap_rows(self.time, self.cadence.period, self.cadence.longest) if self.gaps is None else self.gaps
        return segments(gaps, len(self))

    def slice(self, start: int | None = None, stop: int | None = None) -> Recording:
        """The samples start <= k < stop, as a recording; findings stay those of the whole log."""
        rows = slice(start, stop)
        first, last, _ = rows.indices(len(self))
        gaps = None if self.gaps is None else self.gaps[(self.gaps >= first) & (self.gaps < last)] - first
        return replace(self, time=self.time[rows], gaps=gaps, **{name: values[rows] for name, values in self.groups.items()})

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


def filled(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """``values`` (n, ...) with missing cells drawn straight from neighbour to neighbour, column by column; one without any number stays missing."""
    out = np.array(values, dtype=float)
    for column in out.reshape(len(out), -1).T:
        known = np.isfinite(column)
        if known.any() and not known.all():
            column[~known] = np.interp(time[~known], time[known], column[known])
    return out


def join(pieces: Sequence[Recording]) -> Recording:
    """Consecutive pieces of one log as one recording.  Raises ValueError for no piece."""
    if not pieces:
        raise ValueError("no pieces to join")
    if len(pieces) == 1:
        return pieces[0]
    groups = {group: np.concatenate([getattr(piece, group) for piece in pieces]) for group in pieces[0].groups}
    return replace(pieces[0], time=np.concatenate([piece.time for piece in pieces]), gaps=_joined_gaps(pieces), **groups)


def _joined_gaps(pieces: Sequence[Recording]) -> np.ndarray | None:
    """The rows that follow a gap, None where a piece does not know its own."""
    starts = np.cumsum([0, *map(len, pieces)])
    known = [piece.gaps + start for piece, start in zip(pieces, starts) if piece.gaps is not None]
    return np.concatenate(known) if len(known) == len(pieces) else None


def copied(piece: Recording) -> Recording:
    """A piece that does not keep alive the arrays which it was cut from."""
    return replace(piece, time=piece.time.copy(), **{group: np.copy(values) for group, values in piece.groups.items()})


class Log:
    """A log in a file, opened to be read in pieces: ``name``, ``path``; see ``open_log``."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self.path: Path = source.header.path
        self.name = stem(self.path)
        self.findings: tuple[Finding, ...] = ()
        """What was seen in reading; complete once all of it was read."""

    def __repr__(self) -> str:
        return f"Log({self.name!r}: {self.count or 'unknown number of'} rows, {self.sample_rate:.6g} Hz, {', '.join(self.groups)})"

    @property
    def groups(self) -> tuple[str, ...]:
        """Names of the groups that the log holds, in the order of ``GROUPS``."""
        return self._source.header.groups

    @property
    def count(self) -> int | None:
        """Rows in the file, before repeats are dropped; None where only reading tells."""
        return self._source.table.count(self._source.header.time)

    @property
    def frame_declared(self) -> bool:
        """Whether the log's axes were stated."""
        return self._source.foreign.body is not None

    @cached_property
    def cadence(self) -> Cadence:
        """That of the first 65,536 samples."""
        times, known = [], 0
        for piece, _ in self._batches(Rows(self._source)):
            times.append(piece.time)
            known += len(piece)
            if known >= HEAD:
                break
        return cadence_of(np.concatenate(times)[:HEAD])

    @property
    def sample_period(self) -> float:
        """s; that of the first 65,536 samples."""
        return self.cadence.period

    @property
    def sample_rate(self) -> float:
        """Hz."""
        return 1 / self.sample_period

    def pieces(self, rows: int = 1_000_000) -> Iterator[tuple[Recording, float]]:
        """Consecutive pieces of ``rows`` samples, the last one shorter, and the share of the file read so far: 1 with the last.

        Joined they are what ``read_recording`` gives, for any ``rows``; the times run on from piece to piece.  Each
        piece carries the log's ``period`` and its own ``gaps``, by ``sample_period``.  Findings are the log's, not the pieces'.  Each call
        reads from the start; it can be left at any time.  Raises UserError as ``read_recording`` does, as far as it has read.
        """
        if rows < 1:
            raise ValueError(f"pieces of {rows} rows")
        passing, clock = Rows(self._source), Clock(self.cadence)
        for piece, share in _cut(_marked(self._batches(passing), self.cadence), rows):
            clock.add(piece.time)
            self.findings = (*passing.findings, *clock.findings())
            yield piece, share

    def stretches(self, rows: int = 1_000_000) -> Iterator[tuple[int, Recording, float]]:
        """As ``pieces``, cut at the gaps too: (segment, piece, share).

        ``segment`` counts the ranges of the log without gap from 0; consecutive pieces of one segment join without gap.
        """
        segment = 0
        for piece, share in self.pieces(rows):
            for start, stop in piece.segments:
                segment += bool(np.isin(start, piece.gaps))
                yield segment, piece.slice(start, stop), share

    def read(self) -> Recording:
        """The whole log; its sample period is that of all its samples."""
        passing = Rows(self._source)
        whole = join([piece for piece, _ in self._batches(passing)])
        clock = Clock(whole.cadence)
        clock.add(whole.time)
        self.findings = (*passing.findings, *clock.findings())
        return replace(whole, findings=self.findings)

    def _batches(self, passing: Rows) -> Iterator[tuple[Recording, float]]:
        for time, groups, share in passing.batches():
            yield Recording(self.name, time, **groups, path=self.path, frame_declared=self.frame_declared), share


def _marked(batches: Iterable[tuple[Recording, float]], cadence: Cadence) -> Iterator[tuple[Recording, float]]:
    """``batches`` with the log's cadence and their gaps; the last rows of one wait for the next, which tells whether a stamp stays late."""
    finder = GapFinder(cadence.period, cadence.longest)
    held: list[Recording] = []
    gaps, given = np.empty(0, dtype=np.int64), 0
    for batch, share in chain(batches, [(None, 1.0)]):
        rows, _ = finder.end() if batch is None else finder.add(batch.time)
        gaps, held = np.append(gaps, rows), held + ([] if batch is None else [batch])
        while held and given < finder.settled:
            part, rest = held[0].slice(0, finder.settled - given), held[0].slice(finder.settled - given)
            held = ([copied(rest)] if len(rest) else []) + held[1:]
            own = gaps[gaps < given + len(part)]
            yield replace(part, period=cadence.period, longest=cadence.longest, gaps=own - given), share
            gaps, given = gaps[len(own):], given + len(part)


def _cut(batches: Iterable[tuple[Recording, float]], rows: int) -> Iterator[tuple[Recording, float]]:
    """``batches`` in pieces of exactly ``rows`` samples, the last one shorter; nothing is given out before it is known not to be the last."""
    held: list[Recording] = []
    waiting, share = 0, 0.0
    for batch, share in batches:
        while waiting + len(batch) > rows:
            cut = rows - waiting
            yield join([*held, batch.slice(0, cut)]), share
            batch, held, waiting = batch.slice(cut), [], 0
        held.append(batch)
        waiting += len(batch)
    if waiting:
        yield join(held), 1.0


def open_log(path: str | os.PathLike, columns: str | os.PathLike | None = None) -> Log:
    """The log in ``path``, of any format and any length, opened to be read in pieces of bounded memory::

        log = open_log("day.parquet")
        for piece, share in log.pieces():
            ...                             # a Recording of a million samples; share of the file, 0 to 1
        log.findings

    ``columns`` is that of ``read_recording``.  The first 65,536 rows are read at once, for the sample period.  Raises UserError
    as ``read_recording`` does.
    """
    log = Log(Source.open(Path(path), None if columns is None else Path(columns)))
    _ = log.cadence  # so that what is wrong at the start of a file is said at once
    return log


def read_recording(path: str | os.PathLike, columns: str | os.PathLike | None = None) -> Recording:
    """The recording in ``path``: .csv, .csv.gz, .parquet, .mat, .h5, .hdf5, .bag, .db3, .mcap, or the folder of a bag of ROS 2.

    ``columns`` is a TOML file for a foreign log; it renames columns, declares axes, gives the size of raw counts, and picks the
    topics of a bag::

        [columns]
        "GyrX" = "gyro_x [deg/s]"
        "log/acc[0]" = "accel_x [count]"    # MAT and HDF5: the path of an array, and its column or field
        [frame]
        body = "frd"     # "flu", or a 3 x 3 rotation R with v_flu = R v_log (also as the key R)
        world = "ned"    # "enu"; in ned a heading is a compass heading
        q = "bn"         # world to body; "nb" is body to world
        [scale]
        accel = {value = 0.061, unit = "mg"}    # of one count; also an offset, in the same unit
        [topics]
        imu = "/imu/data"                       # of sensor_msgs/Imu; also temperature

    A bag's messages are in SI by their definition; every other file must state its units.  Raises UserError, one line with
    file, row (as a spreadsheet counts, the header is row 1) and column, for what cannot be used; what can is listed in
    ``Recording.findings``.
    """
    return Log(Source.open(Path(path), None if columns is None else Path(columns))).read()
