"""The rows of a file made into samples, a batch at a time.

This sets units and axes, checks the order of the time, drops repeats and marks missing values.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.angles import of_angles
from pyimu.recording.coarse import COARSE_STAMPS, EvenTimes, even_times
from pyimu.recording.column_map import BODY, ForeignMap, read_map
from pyimu.recording.columns import ANGLES, GROUP_OF, GROUPS, column_names, own_name
from pyimu.recording.counter import NEARLY, SHORT, Unwrapped, spans
from pyimu.recording.counts import RawCounts
from pyimu.recording.fixes import Fixes
from pyimu.recording.folders import log_in
from pyimu.recording.formats.ends import without_end
from pyimu.recording.formats.reader import Reader
from pyimu.recording.formats.suffix import open_reader
from pyimu.recording.formats.timed import TIME, TimedReader
from pyimu.recording.header import Header
from pyimu.recording.known import left_out, merged, recognised, said
from pyimu.recording.made import with_made_columns
from pyimu.recording.own_rows import in_own_rows
from pyimu.recording.quality.tally import Tally
from pyimu.recording.untimed import without_time
from pyimu.recording.waking import Waking

NORM_TOLERANCE = 1e-2
"""How far the norm of a reference quaternion may be from one before it is reported."""

STEEPEST = 1.01 * np.pi
"""rad; more is no pitch, in whatever way it is counted, but for rounding."""

LEAST_ROWS = 3
"""A recording has at least so many samples."""

HEAD = 1 << 16
"""Rows at the start of a log by which it is known whether its stamps are coarse."""

KINDS = (
    "time_origin",
    "time_offset",
    "repeated_rows",
    "repeated_time",
    "coarse_stamps",
    "place_origin",
    "reference_norm",
    "missing_cells",
    "counts",
)
"""The order of the findings, behind those of the file's format and header."""

Values = dict[str, np.ndarray]


@dataclass(frozen=True)
class Source:
    """A file, opened: its reader, what its columns mean, and the user's column map.

    ``companions`` are further files with columns of the same log, each with times of its own. Of a
    folder that is a log, ``name`` is what the log is called, and ``truth`` the file of its ground
    truth.
    """

    reader: Reader
    header: Header
    foreign: ForeignMap
    companions: tuple[Source, ...] = ()
    name: str = ""
    truth: Path | None = None

    @classmethod
    def open(cls, path: Path, columns: Path | None, wanted: str = "sensor") -> Source:
        """Open a log; ``wanted`` is what it must hold, see ``Header``.

        A folder of a phone's files is a log, too, and so is one of a data set. Raises
        UserError for a file or a map that cannot be used.
        """
        foreign = read_map(columns) if columns is not None else ForeignMap()
        whole = log_in(path)
        if whole is None:
            return cls.of(open_reader(path, foreign.topics, foreign.binary), foreign, wanted)
        own = whole.foreign
        foreign = foreign if foreign.columns else merged(own, foreign, own.files)
        source = cls.of(open_reader(whole.path, foreign.topics), foreign, wanted)
        return replace(source, name=whole.name, truth=whole.truth)

    @classmethod
    def of(
        cls,
        reader: Reader,
        foreign: ForeignMap,
        wanted: str = "sensor",
        held: Container[str] = (),
    ) -> Source:
        """What ``reader`` has opened, without the groups that are ``held`` by another file where no
        map names their columns. Raises UserError as ``open`` does.
        """
        findings: tuple[Finding, ...] = ()
        is_known, mapped = False, foreign.path is not None and bool(foreign.columns)
        reader, foreign = with_made_columns(reader, foreign)
        if foreign.columns and reader.words:
            foreign = in_own_rows(reader, foreign)
        if not foreign.columns:
            known = recognised(reader, wanted, foreign.rate)
            if known is not None:
                foreign = merged(known[1], foreign, (*known[1].files, *foreign.files))
                findings, is_known = tuple(said(known, reader.header)), True
        if foreign.body is None and reader.body is not None:
            foreign = replace(foreign, body=BODY[reader.body])
        names = foreign.rename(reader.path, reader.header)
        names = [
            f"other {n}" if n == cell and GROUP_OF.get(own_name(n) or "") in held else n
            for n, cell in zip(names, reader.header, strict=True)
        ]
        for k, (name, cell) in enumerate(zip(names, reader.header, strict=True)):
            if own_name(name) == "time" and cell in reader.clocks:
                names[k] = TIME
                findings = (*findings, Finding("clock_times", "time", 1, {"from": cell}))
        reader = _timed(reader, foreign, names, mapped)
        header = Header(
            reader.path,
            [*names, *reader.header[len(names) :]],
            foreign.scale,
            reader.crowded or is_known,
            reader.skipped,
            wanted,
            reader.header[
                : len(names)
            ],  # without the times of a rate, which are none of the file's
            reader.in_memory,
        )
        header.findings = [*findings, *foreign.notes, *header.findings]
        if foreign.offset:
            header.findings.append(Finding("time_offset", "time", 1, {"offset": foreign.offset}))
        companions = _companions(reader.path, foreign, header)
        if wanted == "sensor" and not is_known:
            groups = [g for source in companions for g in source.header.groups]
            header.findings += left_out(reader.header, header.positions, [*header.groups, *groups])
        return cls(reader, header, foreign, companions)


def _timed(reader: Reader, foreign: ForeignMap, names: list[str], mapped: bool) -> Reader:
    """``reader``, with the times of a rate where it has none.

    Raises UserError where a user has ``mapped`` columns, and none for the time.
    """
    there = any(name.partition("[")[0].strip() == "time" for name in names)
    if foreign.rate is not None:
        if there:
            raise UserError(
                f"{foreign.path}: key sample_rate is for a log without times, but {reader.path} "
                "has a column that is its time: leave one of the two out"
            )
        by = "the log's layout" if foreign.path is None else "the column map"
        return TimedReader(reader, foreign.rate, by)
    if mapped and not there and reader.rate is None:
        raise without_time(reader, foreign)
    if there or reader.rate is None:
        return reader
    return TimedReader(reader, reader.rate, "what the file says")


def _companions(path: Path, foreign: ForeignMap, header: Header) -> tuple[Source, ...]:
    """The further files that a map names, beside the log or where their paths say."""
    found = []
    for name, own in foreign.files:
        reader = open_reader(path.parent / name, own.topics, own.binary)
        source = Source.of(reader, own, "any", header.groups)
        twice = next((g for g in source.header.groups if g in header.groups), None)
        if twice is not None:
            raise UserError(f"{source.header.path}: holds {twice}, which {path} holds too")
        found.append(source)
    return tuple(found)


class Rows:
    """One pass over a ``source``, in batches that suit the file.

    ``findings`` are complete at its end.
    """

    def __init__(self, source: Source) -> None:
        self.source = source
        self.kept = 0
        self.waking = Waking()
        self._tally = Tally([*source.reader.findings, *source.header.findings])
        header = source.header
        self._raw = RawCounts(
            header.stated, [header.units[header.names.index(name)] for name in header.stated]
        )
        self._seen = 0
        self._single = True
        self._before: Values | None = None
        self._even: EvenTimes | None = None
        self._fixes = Fixes(header.path)
        self._last = np.zeros(0)
        self.origin: float | np.integer = 0

    @property
    def findings(self) -> tuple[Finding, ...]:
        names = ["time", *self.source.header.names]

        def rank(finding: Finding) -> tuple[int, int]:
            known = finding.kind in KINDS
            return (KINDS.index(finding.kind) if known else -1), (
                names.index(finding.column) if known and finding.column in names else 0
            )

        return tuple(sorted(map(self._coarse, self._tally.findings()), key=rank))

    def _coarse(self, finding: Finding) -> Finding:
        """``finding``, with share and reason where stamps are coarser than the sample period."""
        share = finding.count / max(self._seen, 1)
        if finding.kind != "repeated_time" or share <= COARSE_STAMPS:
            return finding
        stamps = "coarser than the sample period" + (
            ", as numbers of 32 bits are" if self._single else ""
        )
        return replace(finding, detail={**finding.detail, "share": share, "stamps": stamps})

    def _spread(self) -> Iterator[Finding]:
        """The finding ``coarse_stamps`` of a log whose rows were spread over their stamps."""
        if self._even is not None:
            single = {"stamps": "numbers of 32 bits"} if self._single else {}
            yield self._even.finding(**single)

    def batches(self) -> Iterator[tuple[np.ndarray, Values, float]]:
        """Strictly increasing time (n,), the groups by name, and the share of the file read so far.

        The time increases from batch to batch too.

        Raises UserError with the row for a time that is missing or runs backwards, and for a file
        of fewer than three rows.
        """
        counter = Unwrapped(self.source.header.seconds)
        for values, share in self._headed(self._converted(counter)):
            time, values = self._ordered(values)
            self.kept += len(time)
            yield time, self._grouped(values), share
        if self.kept < LEAST_ROWS:
            raise UserError(
                f"{self.source.header.path}: a recording needs at least {LEAST_ROWS} rows of data, "
                f"this one has {self.kept}{self._at_one_time()}"
            )
        at_end = [*self._fixes.findings(), *self.source.reader.at_end(), *self._spread()]
        self._tally.add([*self._raw.findings(), *at_end])
        if counter.count:
            detail = {"after": counter.after}
            self._tally.add([Finding("counter_wrapped", "time", counter.count, detail)])

    def _at_one_time(self) -> str:
        """What to add where too few rows have a time of their own."""
        more = self._seen - self.kept
        same = "have the time of the row before: is it rounded, or another column's?"
        return f"; {more:,} more {same}" if more > 0 else ""

    def _converted(self, counter: Unwrapped) -> Iterator[tuple[Values, float]]:
        """The columns of each batch in units of the package, and the share of the file read."""
        header, first = self.source.header, True
        batches = self.source.reader.batches(header.positions, header.time)
        if self.source.reader.is_sheet:
            batches = without_end(batches, header.positions.index(header.time), self._end)
        for columns, share in batches:
            if not len(columns[0]):
                continue
            if first:
                found: list[Finding] = []
                self.origin = header.origin(columns[header.positions.index(header.time)][0], found)
                self._tally.add(found)
                first = False
            at = header.positions.index(header.time)
            columns = [*columns[:at], counter.add(columns[at]), *columns[at + 1 :]]
            self._single = self._single and _is_single(columns[at])
            self._raw.add(dict(zip(header.names, columns)))
            yield header.convert(columns, self.origin), share

    def _end(self, index: int, count: int) -> None:
        """Note that the last ``count`` rows, from that of the sample ``index`` on, are none."""
        row = int(self.source.reader.place(index).rpartition(" ")[2])
        self._tally.add([Finding("end_left_out", "", count, {"row": row})])

    def _headed(self, batches: Iterator[tuple[Values, float]]) -> Iterator[tuple[Values, float]]:
        """``batches``, the first of them once ``HEAD`` rows have told whether stamps are coarse."""
        head: list[tuple[Values, float]] = []
        stamps, held, last = [], [], None
        for values, share in batches:
            head.append((values, share))
            stamps.append(values["time"])
            held.append(_held(values, last))
            last = {name: column[-1:] for name, column in values.items()}
            if sum(map(len, stamps)) >= HEAD:
                break
        if head:
            self._even = even_times(np.concatenate(stamps)[:HEAD], np.concatenate(held)[:HEAD])
        del stamps, held
        while head:
            yield head.pop(0)
        yield from batches

    def _ordered(self, values: Values) -> tuple[np.ndarray, Values]:
        """Time and the other columns at the rows that are the first with their time."""
        lead = 0 if self._before is None else 1
        if self._before is not None:
            values = {
                name: np.concatenate((self._before[name], column))
                for name, column in values.items()
            }
        stamps = values.pop("time")
        self._check_times(stamps, self._seen - lead)
        time = self._on_even_times(stamps, lead)
        keep = np.concatenate((np.full(1, not lead), np.diff(time) > 0))
        self._report_repeats(time, values, np.flatnonzero(~keep[lead:]) + lead)
        self._before = {"time": stamps[-1:]} | {
            name: column[-1:] for name, column in values.items()
        }
        self._seen += len(time) - lead
        return time[keep], {name: column[keep] for name, column in values.items()}

    def _on_even_times(self, stamps: np.ndarray, lead: int) -> np.ndarray:
        """The times of rows, the first ``lead`` of which had theirs before."""
        if self._even is None:
            return stamps
        last = self._last[:lead]
        time = np.concatenate((last, self._even.add(stamps[lead:])))
        self._last = time[-1:]
        return time

    def _check_times(self, time: np.ndarray, first: int) -> None:
        """``first`` is the number of the first row in ``time``."""
        missing = np.flatnonzero(~np.isfinite(time))
        if len(missing):
            raise UserError(f"{self._place(first + missing[0])}: the time is missing")
        back = np.flatnonzero(np.diff(time) < 0)
        if len(back):
            before, after = time[back[0]], time[back[0] + 1]
            raise UserError(
                f"{self._place(first + back[0] + 1)}: the time runs backwards, {after:.9g} s "
                f"follows {before:.9g} s"
                f"{self._wrapped(before - after)}"
            )

    def _place(self, row: int) -> str:
        return f"{self.source.header.path}: {self.source.reader.place(int(row))}"

    def _wrapped(self, step: float) -> str:
        """What to add where the time went back by nearly all that it may count up to."""
        seconds = self.source.header.seconds
        for ticks, name in spans(seconds).items():
            if NEARLY * ticks * seconds < step <= ticks * seconds and name not in SHORT:
                what = f"a counter of {name}" if name.endswith("bits") else f"a {name}"
                return (
                    f"; {what} begins anew after {ticks * seconds:.9g} s, but here more is "
                    "missing: cut the log there"
                )
        return (
            "; cut the log where its clock was set anew or another sensor's rows begin, or sort "
            "the rows by time"
        )

    def _report_repeats(
        self, time: np.ndarray, values: Mapping[str, np.ndarray], again: np.ndarray
    ) -> None:
        """``again`` are the rows whose time is that of the row before."""
        if not len(again):
            return
        same = np.all([_equal(v[again], v[again - 1]) for v in values.values()], axis=0)
        for kind, rows in (("repeated_rows", again[same]), ("repeated_time", again[~same])):
            if len(rows):
                self._tally.add([Finding(kind, "time", len(rows), {"first": float(time[rows[0]])})])

    def _grouped(self, values: Mapping[str, np.ndarray]) -> Values:
        """The groups, in the axes of the package."""
        groups = {}
        for group in self.source.header.groups:
            columns = [values[name] for name in self.source.header.written_as(group)]
            groups[group] = np.column_stack(columns) if GROUPS[group].suffixes else columns[0]
        made = ((g, v) for g, v in self._fixes.metres(values) if g not in values)
        groups |= {group: column for group, column in made if group in groups}
        if "ref_q" in groups:
            groups["ref_q"] = self._attitude(groups["ref_q"])
        for name in (
            name for group in ("gyro", "accel") if group in groups for name in column_names(group)
        ):
            missing = int(np.count_nonzero(np.isnan(values[name])))
            self._tally.add([Finding("missing_cells", name, missing)] if missing else [])
        return self.source.foreign.turn(groups)

    def _attitude(self, columns: np.ndarray) -> np.ndarray:
        """Unit quaternions of those in a file, or of its angles (n, 3) rad."""
        header = self.source.header
        if header.written_as("ref_q") != ANGLES:
            return self._normalised(columns)
        steepest = float(np.nanmax(np.abs(columns[:, 1]), initial=0.0))
        if header.group_units["ref_q"] == "rad" and steepest > STEEPEST:
            raise UserError(
                f"{header.path}: ref_pitch goes to {steepest:.3g} rad, and no pitch is beyond half "
                "a turn: are ref_roll, ref_pitch and ref_yaw in deg?"
            )
        return of_angles(columns, self.source.foreign.angles)

    def _normalised(self, q: np.ndarray) -> np.ndarray:
        """Unit quaternions.

        A norm far from one is reported, and one below a half (zeros for "not seen") is missing.
        """
        norm = np.linalg.norm(q, axis=1)
        odd = np.abs(norm - 1) > NORM_TOLERANCE
        if odd.any():
            detail = {"largest": float(norm[odd].max()), "least": float(norm[odd].min())}
            self._tally.add([Finding("reference_norm", "ref_q", int(odd.sum()), detail)])
        return q / np.where(norm < 0.5, np.nan, norm)[:, None]


def _is_single(time: np.ndarray) -> bool:
    """Whether all of ``time`` (n,) are numbers of 32 bits."""
    with np.errstate(over="ignore"):
        return time.dtype.kind == "f" and bool(np.all(time == time.astype(np.float32)))


def _held(columns: Values, before: Values | None) -> np.ndarray:
    """Rows (n,) in which a sensor has the values of the row before, or none; without gyro and
    accelerometer those in which all columns have. ``before`` is the row before the first, if any.
    """
    sensors = [g for g in ("gyro", "accel") if all(n in columns for n in column_names(g))]
    groups = [column_names(g) for g in sensors] or [[n for n in columns if n != "time"]]
    held = np.zeros(len(columns["time"]), dtype=bool)
    for names in groups:
        same, missing = np.ones_like(held), np.zeros_like(held)
        for column in (columns[n] for n in names):
            same[1:] &= _equal(column[1:], column[:-1])
            missing |= np.isnan(column)
        same[0] = before is not None and all(_equal(columns[n][:1], before[n])[0] for n in names)
        held |= same | missing
    return held


def _equal(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (a == b) | (np.isnan(a) & np.isnan(b))
