"""A log in a file, read whole or in pieces."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import Finding, UserError, printable
from pyimu.recording.clock import RATES, Cadence, Clock, cadence_of
from pyimu.recording.coarse import evened
from pyimu.recording.column_map import ForeignMap, map_of, read_map
from pyimu.recording.columns import GROUPS
from pyimu.recording.companions import Companion
from pyimu.recording.formats.frame import FrameReader, is_frame
from pyimu.recording.formats.suffix import stem
from pyimu.recording.gaps import GapFinder
from pyimu.recording.guess.numbers import SECONDS, USUAL
from pyimu.recording.recording import Recording, check_marks, copied, join
from pyimu.recording.reference.file import with_reference
from pyimu.recording.rows import LEAST_ROWS, Rows, Source
from pyimu.recording.waking import Batch

HEAD = 1 << 16
"""Rows at the start of a log from which its sample period is taken before the rest is read."""


class Log:
    """A log in a file, opened to be read in pieces: ``name``, ``path``; see ``open_log``."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self.path: Path = source.header.path
        self.name = printable(source.name or stem(self.path))
        self.findings: tuple[Finding, ...] = ()
        """What was seen in reading; complete once all of it was read."""

    def __repr__(self) -> str:
        return (
            f"Log({self.name!r}: {self.count or 'unknown number of'} rows, {self.sample_rate:.6g} "
            f"Hz, {', '.join(self.groups)})"
        )

    @property
    def groups(self) -> tuple[str, ...]:
        """Names of the groups that the log holds, in the order of ``GROUPS``."""
        found = [self._source.header.groups, *(c.header.groups for c in self._source.companions)]
        return tuple(g for g in GROUPS if any(g in groups for groups in found))

    @property
    def count(self) -> int | None:
        """Rows in the file, before repeats are dropped; None where only reading tells."""
        return self._source.reader.count(self._source.header.time)

    @property
    def frame_declared(self) -> bool:
        """Whether the log's axes were stated."""
        return self._source.foreign.body is not None

    @property
    def stated(self) -> dict[str, str]:
        """The unit that the files state of each group, by its name; none of counts."""
        found = [c.header.group_units for c in self._source.companions]
        return {
            g: unit
            for units in [*found, self._source.header.group_units]
            for g, unit in units.items()
        }

    @cached_property
    def cadence(self) -> Cadence:
        """That of the first 65,536 samples."""
        times, known = [], 0
        for piece, _ in self._batches(Rows(self._source)):
            times.append(piece.time)
            known += len(piece)
            if known >= HEAD:
                break
        cadence = cadence_of(np.concatenate(times)[:HEAD])
        self._check_rate(cadence)
        return cadence

    @property
    def sample_period(self) -> float:
        """s; that of the first 65,536 samples."""
        return self.cadence.period

    @property
    def sample_rate(self) -> float:
        """Hz."""
        return 1 / self.sample_period

    def pieces(self, rows: int = 1_000_000) -> Iterator[tuple[Recording, float]]:
        """Consecutive pieces of ``rows`` samples, and the share of the file read so far.

        The last piece is shorter, and its share is 1.

        Joined they are what ``read_recording`` gives, for any ``rows``; the times run on from piece
        to piece. Each piece carries the log's ``period`` and its own ``gaps``, by
        ``sample_period``. Findings are the log's, not the pieces'. Each call reads from the
        start; it can be left at any time. Raises UserError as ``read_recording`` does, as far as
        it has read.
        """
        if rows < 1:
            raise ValueError(f"pieces of {rows} rows")
        passing, clock = Rows(self._source), Clock(self.cadence)
        for piece, share in _cut(_marked(self._batches(passing), self.cadence), rows):
            clock.add(piece.time)
            self.findings = self._found(passing, clock)
            yield piece, share

    def segments(self, rows: int = 1_000_000) -> Iterator[tuple[int, Recording, float]]:
        """As ``pieces``, cut at the gaps too: (segment, piece, share).

        ``segment`` counts the ranges of the log without gap from 0; consecutive pieces of one
        segment join without gap.
        """
        segment = 0
        for piece, share in self.pieces(rows):
            for start, stop in piece.segments:
                segment += bool(np.isin(start, piece.gaps))
                yield segment, piece.slice(start, stop), share

    def read(self) -> Recording:
        """The whole log; its sample period is that of all its samples.

        A sequence of a data set has the ground truth beside it.
        """
        passing = Rows(self._source)
        whole = join([piece for piece, _ in self._batches(passing)])
        self._check_rate(whole.cadence)
        clock = Clock(whole.cadence)
        clock.add(whole.time)
        self.findings = self._found(passing, clock)
        log, truth = replace(whole, findings=self.findings), self._source.truth
        return log if truth is None else with_reference(log, read_reference(truth))

    def _check_rate(self, cadence: Cadence) -> None:
        """Raise UserError for a rate that no sensor has: the times are in another unit."""
        rate, header = 1 / cadence.period, self._source.header
        if RATES[0] <= rate <= RATES[1]:
            return
        fits = [u for u, s in SECONDS.items() if USUAL[0] <= rate * header.seconds / s < USUAL[1]]
        asked = "is their unit right?"
        if fits:
            asked = f"are they in {fits[0]}, at {rate * header.seconds / SECONDS[fits[0]]:.6g} Hz?"
        raise UserError(
            f"{self.path}: its times make a sample rate of {rate:.3g} Hz, and no sensor is outside "
            f"{RATES[0]:g} to {RATES[1]:g} Hz; {asked}"
        )

    @cached_property
    def _companions(self) -> list[Companion]:
        return [Companion.read(source) for source in self._source.companions]

    def _found(self, passing: Rows, clock: Clock) -> tuple[Finding, ...]:
        others = [finding for c in self._companions for finding in c.said()]
        return (*passing.findings, *passing.waking.findings(), *others, *clock.findings())

    def _batches(self, passing: Rows) -> Iterator[tuple[Recording, float]]:
        kept = 0
        for time, groups, share in passing.waking.awake(self._whole(passing)):
            kept += len(time)
            check_marks(self.path, time, groups)
            yield (
                Recording(
                    self.name,
                    time,
                    **groups,
                    path=self.path,
                    frame_declared=self.frame_declared,
                    stated=self.stated,
                ),
                share,
            )
        if kept < LEAST_ROWS:
            raise UserError(
                f"{self.path}: a recording needs at least {LEAST_ROWS} rows, and behind rows of "
                f"zeros this one has {kept}"
            )

    def _whole(self, passing: Rows) -> Iterator[Batch]:
        """The batches with the groups of further files beside their own."""
        for time, groups, share in passing.batches():
            for companion in self._companions:
                groups |= companion.at(time, passing)
            yield time, groups, share


def _marked(
    batches: Iterable[tuple[Recording, float]], cadence: Cadence
) -> Iterator[tuple[Recording, float]]:
    """``batches`` with the log's cadence and their gaps.

    The last rows of a batch wait for the next, which shows whether a stamp stays late.
    """
    finder = GapFinder(cadence.period, cadence.longest)
    held: list[Recording] = []
    gaps, given = np.empty(0, dtype=np.int64), 0
    for batch, share in chain(batches, [(None, 1.0)]):
        rows, _ = finder.end() if batch is None else finder.add(batch.time)
        gaps, held = np.append(gaps, rows), held + ([] if batch is None else [batch])
        while held and given < finder.settled:
            part, rest = (
                held[0].slice(0, finder.settled - given),
                held[0].slice(finder.settled - given),
            )
            held = ([copied(rest)] if len(rest) else []) + held[1:]
            own = gaps[gaps < given + len(part)]
            yield (
                replace(part, period=cadence.period, longest=cadence.longest, gaps=own - given),
                share,
            )
            gaps, given = gaps[len(own) :], given + len(part)


def _cut(
    batches: Iterable[tuple[Recording, float]], rows: int
) -> Iterator[tuple[Recording, float]]:
    """``batches`` in pieces of exactly ``rows`` samples, the last one shorter.

    A piece is held back until it is known whether it is the last.
    """
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
    """Open the log in ``path``, of any format and any length, to read it in bounded memory.

    For example::

        log = open_log("day.parquet")
        for piece, share in log.pieces():
            ...             # a Recording of a million samples; share of the file, 0 to 1
        log.findings

    ``columns`` is that of ``read_recording``. The first 65,536 rows are read at once, for the
    sample period. Raises UserError as ``read_recording`` does.
    """
    log = Log(Source.open(Path(path), None if columns is None else Path(columns)))
    _ = log.cadence  # so that what is wrong at the start of a file is said at once
    return log


def read_recording(path: str | os.PathLike, columns: str | os.PathLike | None = None) -> Recording:
    """Read the recording in ``path``, in the format of its suffix.

    Suffixes are .csv, .csv.gz, .parquet, .mat, .h5, .hdf5, .npy, .npz, .json, .jsonl, .bag, .db3
    and .mcap; the path may also be the folder of a bag of ROS 2.

    ``columns`` is a TOML file for a foreign log; it renames columns, declares axes, gives the size
    of raw counts, and picks the topics of a bag::

        [columns]
        "GyrX" = "gyro_x [deg/s]"
        "log/acc[0]" = "accel_x [count]"    # MAT, HDF5: path of an array, and its column or field
        [frame]
        body = "frd"     # "flu", or a 3 x 3 rotation R with v_flu = R v_log (also as the key R)
        world = "ned"    # "enu"; in ned a heading is a compass heading
        q = "bn"         # world to body; "nb" is body to world
        angles = "xyz"   # ref_roll, ref_pitch, ref_yaw turn about x first; else "zyx"
        [scale]
        accel = {value = 0.061, unit = "mg"}    # of one count; also an offset, in the same unit
        [topics]
        imu = "/imu/data"                       # of sensor_msgs/Imu; also temperature

    A bag's messages are in SI by their definition; every other file must state its units. Raises
    UserError, one line with file, row (as a spreadsheet counts, the header is row 1) and column,
    for what cannot be used; what can is listed in ``Recording.findings``.
    """
    return Log(Source.open(Path(path), None if columns is None else Path(columns))).read()


def read_reference(path: str | os.PathLike, columns: str | os.PathLike | None = None) -> Recording:
    """Read a reference in a file of its own: ``time`` and columns ``ref_*``, in any format that
    ``read_recording`` reads; it needs neither gyro nor accelerometer.

    ``columns`` is that of ``read_recording``. Raises UserError as that does, and for a file without
    a reference.
    """
    source = Source.open(Path(path), None if columns is None else Path(columns), "reference")
    return Log(source).read()


Given = Recording | str | os.PathLike | Any
"""What is taken for a recording: one, the path of its file, or a data frame."""


def is_one(given: Given | Iterable[Given]) -> bool:
    """Whether ``given`` is taken for one recording, not for several."""
    return isinstance(given, (Recording, Log, str, os.PathLike)) or is_frame(given)


def recording_of(given: Given, wanted: str = "sensor") -> Recording:
    """A recording: itself, that in a file, or that in a data frame.

    The columns of a frame are named as those of a file, ``gyro_x [deg/s]``. ``wanted`` is
    "reference" where it needs no sensor. Raises UserError as ``read_recording`` does, and for
    anything else.
    """
    if isinstance(given, Recording):
        return evened(given)
    if isinstance(given, (str, os.PathLike)):
        return Log(Source.open(Path(given), None, wanted)).read()
    if not is_frame(given):
        raise UserError(
            f"a {type(given).__name__} is no recording: give a Recording, the path of a file, or "
            "a data frame with columns as 'time [s]', 'gyro_x [rad/s]'"
        )
    source = Source.of(FrameReader.of(given), ForeignMap(), wanted)
    return replace(Log(source).read(), path=None)


def from_frame(
    cls: type[Recording],
    frame: Any,
    name: str = "frame",
    columns: Mapping[str, Any] | str | os.PathLike | None = None,
) -> Recording:
    """A recording of a data frame, its columns named with their units as those of a file.

    ``gyro_x [deg/s]``, ``accel_x [g]``, ``time [ms]`` are such. Other names are given theirs by
    ``columns``, ``{"gx": "gyro_x [deg/s]"}``, or all that a column map declares, as its tables or
    as the file. An index of dates or spans of time, or one that is named as a time, is the time of
    a frame without such a column. Raises UserError as ``read_recording`` does.
    """
    if not is_frame(frame):
        raise UserError(
            f"a {type(frame).__name__} is no data frame; recordings of arrays: from_arrays"
        )
    source = Source.of(FrameReader.of(frame), _map_of(columns))
    return replace(Log(source).read(), path=None, name=name)


def _map_of(columns: Mapping[str, Any] | str | os.PathLike | None) -> ForeignMap:
    """The column map in a file, of its tables, or of new names alone."""
    if columns is None:
        return ForeignMap()
    if isinstance(columns, (str, os.PathLike)):
        return read_map(Path(columns))
    if not isinstance(columns, Mapping):
        raise UserError(
            f"columns is a {type(columns).__name__}, expected a table of names such as "
            "{'gx': 'gyro_x [deg/s]'}, or the path of a column map"
        )
    renames = columns and all(isinstance(value, str) for value in columns.values())
    return map_of({"columns": dict(columns)} if renames else columns, Path("columns"))


# Reading lies above what is read; so it gives the class its constructor from a frame.
from_frame.__qualname__ = "Recording.from_frame"
Recording.from_frame = classmethod(from_frame)
