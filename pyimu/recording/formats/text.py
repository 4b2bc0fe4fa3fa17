"""Tables in text, plain and gzipped, read in pieces, and with the place of what is wrong."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from pyarrow import csv as pacsv

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.cells import MISSING, is_number, padded
from pyimu.recording.formats.clock_times import ClockTimes, is_clock_time
from pyimu.recording.formats.ends import LAST
from pyimu.recording.formats.layout import UNCLOSED, layout_of
from pyimu.recording.formats.lines import UTF_16, Body, is_comment, is_gzip, lines, opened
from pyimu.recording.formats.reader import Columns, Reader
from pyimu.recording.formats.told import HEAD, Layout

SECOND = "'{}' is no number, and none is in the row: put a second table into a file of its own"
"""What is said of a row of texts between rows of numbers."""

BROKEN = 0.01
"""Share of the rows that may be no whole ones, as where a line to a serial port lost letters; with
more of them the table is not what it was taken for."""


@dataclass(frozen=True)
class CsvReader(Reader):
    """A table in text, plain or gzipped, as ``layout`` says; ``header`` are its columns' names.

    Lines of comment are left out wherever they stand, and lines at the end that are no samples: a
    logger that lost its power leaves one, others write a last remark, sheets have sums and means
    below. So are few rows of another length between whole ones (``BROKEN``).
    """

    path: Path
    header: list[str]
    is_sheet = True
    layout: Layout = field(default_factory=Layout)
    _ended: list[Finding] = field(default_factory=list, compare=False, repr=False)
    _broken: list[Finding] = field(default_factory=list, compare=False, repr=False)
    _again: list[Finding] = field(default_factory=list, compare=False, repr=False)

    @classmethod
    def open(cls, path: Path, topic: str = "") -> CsvReader:
        """Open a table, of a log of several kinds that of ``topic``.

        Raises UserError for a file that cannot be read, and for a topic that is not there.
        """
        layout = layout_of(path, topic)
        return cls(path, list(layout.names), layout)

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        said = self.layout.unusual
        return (Finding("layout", "", 1, {"read_as": said}),) if said else ()

    @property
    def rate(self) -> float | None:  # type: ignore[override]
        """Hz; what a comment says."""
        return self.layout.rate

    @property
    def crowded(self) -> bool:  # type: ignore[override]
        """Whether a sensor's messages hold what is no sample of it."""
        return self.body is not None

    @property
    def body(self) -> str | None:  # type: ignore[override]
        return None if self.layout.marked is None else self.layout.marked.body

    @property
    def clocks(self) -> tuple[str, ...]:  # type: ignore[override]
        return tuple(self.header[k] for k in self.layout.clocks)

    @property
    def word(self) -> str:  # type: ignore[override]
        return "" if self.layout.marked is None else self.layout.marked.word

    @property
    def words(self) -> tuple[str, ...]:  # type: ignore[override]
        return () if self.layout.marked is None else self.layout.marked.words

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        """``long`` is int64 where its numbers need it.

        Raises UserError, with row and column, for a cell that is no number and for rows of another
        length that whole rows follow, where these are not few.
        """
        if self._first_row() is None:
            return
        clocks = {k: ClockTimes() for k, p in enumerate(positions) if p in self.layout.clocks}
        for batch, share in self._whole(positions, long):
            columns = enumerate(batch.columns)
            yield [clocks[k].add(c) if k in clocks else to_numpy(c) for k, c in columns], share
        # What reading took beside the numbers would be held for the next file.
        pa.default_memory_pool().release_unused()

    def _whole(self, positions: Sequence[int], long: int) -> Iterator[tuple[Any, float]]:
        """The batches of rows up to the last whole one, and the share that was read so far."""
        done, first, stop = 0, self.layout.first, None
        told = self.layout
        cleaned = told.commented or told.separator == " " or told.code == UTF_16
        cleaned = cleaned or told.marked is not None
        while True:
            try:
                for batch, share in self._parsed(positions, long, first, stop, cleaned):
                    done += batch.num_rows
                    yield batch, share
                return
            except (pa.ArrowException, OSError) as error:
                known = len(self._broken + self._again)
                end = self._explain(positions, long, done)
                if cleaned and end == stop and known == len(self._broken + self._again):
                    reason = (str(error).splitlines() or [type(error).__name__])[0]
                    raise UserError(f"{self.path}: cannot be read as CSV ({reason})") from None
            # A comment was between the rows, the first of this log, or a row was none, or its end.
            cleaned, stop = True, end
            first = next((row for row, _ in islice(self._lines(), done, None)), None)
            if first is None or (stop is not None and first >= stop):
                return

    def _parsed(
        self, positions: Sequence[int], long: int, first: int, stop: int | None, cleaned: bool
    ) -> Iterator[tuple[Any, float]]:
        """The lines from ``first`` to before ``stop`` in batches, and the share read so far."""
        names = [str(position) for position in range(len(self.header))]
        kept = [names[position] for position in positions]
        kinds = {name: pa.float64() for name in kept} | (
            {names[long]: pa.int64()} if self._is_long(long) else {}
        )
        kinds |= {names[position]: pa.string() for position in self.layout.clocks}
        parse = pacsv.ParseOptions(delimiter=self.layout.separator)
        convert = pacsv.ConvertOptions(
            column_types=kinds,
            include_columns=kept,
            null_values=padded(),
            decimal_point=self.layout.decimal,
        )
        if not cleaned:
            yield from self._streamed(
                pacsv.ReadOptions(column_names=names, skip_rows=first - 1), parse, convert
            )
            return
        read = pacsv.ReadOptions(column_names=names, use_threads=False)
        size = max(self.path.stat().st_size, 1)
        with opened(self.path) as (stream, raw):
            whole = self._is_row if self._broken or self._again else None
            marked = self.layout.marked
            rewrite = None if marked is None else marked.rewriter()
            blanks, comments = self.layout.separator == " ", not self._begin_so
            body = Body(stream, first, stop, blanks, whole, rewrite, comments)
            for block in body.blocks():
                table = pacsv.read_csv(_held_by_arrow(block), read, parse, convert)
                for batch in table.to_batches():
                    yield batch, raw.tell() / size

    def _streamed(
        self, read: pacsv.ReadOptions, parse: pacsv.ParseOptions, convert: pacsv.ConvertOptions
    ) -> Iterator[tuple[Any, float]]:
        """The lines as they are in batches, and the share read so far.

        To leave out lines of comment takes as long as reading, so it is done only where need is.

        Arrow's threads read ahead, and go on for a moment where no more is asked for: a file that
        was closed under them would have them read from the next one that is opened, whose number
        is the same, and that one would be read with a piece missing. The last of them closes it.
        """
        raw = pa.OSFile(str(self.path))
        size = max(raw.size(), 1)
        stream = pa.CompressedInputStream(raw, "gzip") if is_gzip(self.path) else raw
        for batch in pacsv.open_csv(stream, read, parse, convert):
            yield batch, 1.0 if raw.closed else raw.tell() / size
        raw.close()

    def at_end(self) -> tuple[Finding, ...]:
        """That the last lines were left out, and rows between whole ones."""
        return (*self._again, *self._broken, *self._ended)

    def count(self, long: int) -> None:
        return None

    def lines(self) -> Iterator[str]:
        return lines(self.path)

    def numeric(self) -> list[int]:
        """Positions of the columns whose cells are numbers in the first rows."""
        rows = [cells for _, cells in islice(self._rows(), HEAD) if len(cells) == len(self.header)]
        return [
            k
            for k in range(len(self.header))
            if k in self.layout.clocks
            or all(is_number(row[k], self.layout.decimal) for row in rows)
            and any(row[k].strip() not in MISSING for row in rows)
        ]

    def place(self, index: int) -> str:
        """Row of the sample ``index``, as a spreadsheet counts it; blank rows hold no sample."""
        row = next(islice(self._rows(), index, None), None)
        return f"row {index + self.layout.first if row is None else row[0]}"

    @property
    def _begin_so(self) -> bool:
        """Whether the rows themselves begin as comments do."""
        return self.layout.marked is not None and self.layout.marked.commented

    def _rows(self) -> Iterator[tuple[int, list[str]]]:
        """(row, cells) of each row of numbers that is not blank, as a spreadsheet counts them."""
        return ((row, self.layout.cells(line)) for row, line in self._lines())

    def _lines(self) -> Iterator[tuple[int, str]]:
        """(row, line) of each row of numbers that is not blank, as a spreadsheet counts them."""
        layout, began = self.layout, 0
        rewrite = None if layout.marked is None else layout.marked.rewriter()
        several = layout.marked is not None and layout.marked.anew is not None
        for number, line in enumerate(lines(self.path), 1):
            comment = is_comment(line) and not self._begin_so
            if number >= layout.first and line.strip() and not comment:
                line = line.rstrip("\r\n")
                began = began or number
                if rewrite is not None:
                    row = rewrite(line)
                    if row is None:
                        continue
                    line = row
                if self._again and line.strip().encode() in self._heads:
                    continue
                if not self._broken or len(layout.cells(line)) == len(self.header):
                    yield began if several else number, line
                began = 0

    def _first_row(self) -> list[str] | None:
        return next(self._rows(), (0, None))[1]

    def _is_long(self, position: int) -> bool:
        """Whether a column starts with an integer that float64 would round (Unix time in ns)."""
        cells = self._first_row() or []
        return (
            len(cells) > position
            and re.fullmatch(r"\d{16,19}", cells[position].strip()) is not None
        )

    def _explain(self, positions: Sequence[int], long: int, good: int) -> int | None:
        """Raise UserError for the first wrong cell or row after ``good`` rows.

        A cell is wrong where it is not a number, a row where it is too long or too short and whole
        rows follow, which are not many times as many. Gives the row from which on none does, None
        where there is none.
        """
        rows = islice(self._lines(), good, None)
        for number, (row, line) in enumerate(rows, good):
            cells = self.layout.cells(line)
            if len(cells) != len(self.header):
                if number and self._is_end(row, [line, *_next(rows)], positions, long):
                    return row
                if self.layout.is_open(line):
                    raise UserError(f"{self.path}: row {row}: {UNCLOSED}")
                if number and self._are_few_broken(row):
                    return None
                raise UserError(
                    f"{self.path}: row {row}: {len(cells)} cells, expected {len(self.header)} as "
                    f"in {'the header' if self.layout.named else 'the others'}"
                )
            if not self._again and line.strip().encode() in self._heads:
                count = sum(text.strip().encode() in self._heads for _, text in self._lines())
                self._again[:] = [Finding("header_again", "", count, {"first_row": row})]
                return None
            for position in positions:
                if position in self.layout.clocks:
                    continue
                if not is_number(cells[position], self.layout.decimal):
                    if number and self._is_end(row, [line, *_next(rows)], positions, long):
                        return row
                    if not any(is_number(c, self.layout.decimal) for c in cells if c.strip()):
                        raise UserError(f"{self.path}: row {row}: {SECOND.format(cells[position])}")
                    place = f"{self.path}: row {row}, column {self.header[position]}"
                    apart = re.fullmatch(
                        r"[-+]?\d{1,3}([,.' ])\d{3}(\1\d{3})*(?!\1)[,.]\d+", cells[position]
                    )
                    help = "; thousands stand apart from the first rows on, or not at all"
                    raise UserError(
                        f"{place}: '{cells[position]}' is not a number{help if apart else ''}"
                    )
        return None

    def _are_few_broken(self, first: int) -> bool:
        """Whether the rows of another length are few; that they are left out is among the findings
        then. ``first`` is the row of the first of them.
        """
        width = len(self.header)
        lengths = Counter(len(self.layout.cells(line)) == width for _, line in self._lines())
        if lengths[False] > BROKEN * lengths[True]:
            return False
        self._broken[:] = [Finding("rows_left_out", "", lengths[False], {"first_row": first})]
        return True

    @cached_property
    def _heads(self) -> set[bytes]:
        """The lines above the numbers that have a cell for each column: a log that was begun anew
        in the same file has them again.
        """
        above = islice(lines(self.path), self.layout.first - 1)
        rows = [line.strip() for line in above if not is_comment(line)]
        return {row.encode() for row in rows if len(self.layout.cells(row)) == len(self.header)}

    def _is_row(self, line: bytes) -> bool:
        """Whether a line has a cell for each column and is not the header's again; blank ones are
        the parser's to leave out.
        """
        if self._again and line.strip() in self._heads:
            return False
        if not self._broken:
            return True
        separator, width = self.layout.separator.encode(), len(self.header)
        if b'"' in line:
            return len(self.layout.cells(line.decode("utf-8", "replace"))) == width
        return not line.strip() or line.rstrip(b"\r").count(separator) == width - 1

    def _is_end(self, row: int, last: list[str], positions: Sequence[int], long: int) -> bool:
        """Whether the ``last`` lines, from that of ``row`` on, are few and no samples; that they
        are left out is among the findings then.
        """
        if len(last) > LAST or any(self._is_sample(line, positions, long) for line in last):
            return False
        self._ended[:] = [Finding("end_left_out", "", len(last), {"row": row})]
        return True

    def _is_sample(self, line: str, positions: Sequence[int], long: int) -> bool:
        """Whether a line has a time and numbers, or more cells than there are columns."""
        cells, decimal = self.layout.cells(line), self.layout.decimal
        if len(cells) != len(self.header):
            return len(cells) > len(self.header)
        if long in self.layout.clocks:
            timed = is_clock_time(cells[long])
        else:
            timed = cells[long].strip() not in MISSING
        return timed and all(
            p in self.layout.clocks or is_number(cells[p], decimal) for p in positions
        )


def _next(rows: Iterator[tuple[int, str]]) -> Iterator[str]:
    """The next lines, one more than an end has with the one before them."""
    return (line for _, line in islice(rows, LAST))


def _held_by_arrow(block: bytes) -> pa.BufferReader:
    """``block`` in memory that is none of Python's.

    Arrow's own threads let go of what they read when they come to it, which may be while Python is
    ending: what was Python's would abort the process then.
    """
    sink = pa.BufferOutputStream()
    sink.write(block)
    return pa.BufferReader(sink.getvalue())


def to_numpy(column: pa.Array) -> np.ndarray:
    """A column of numbers as (n,), NaN where it is null.

    Numbers of eight bytes are taken from their memory: pyarrow's own way loads pandas first.
    """
    if column.null_count:
        column = column.cast(pa.float64()).fill_null(np.nan)
    types = {pa.float64(): float, pa.int64(): np.int64}
    if column.type in types and len(column):
        values = column.buffers()[1]
        return np.frombuffer(values, types[column.type], len(column), 8 * column.offset)
    return column.to_numpy(zero_copy_only=False)
