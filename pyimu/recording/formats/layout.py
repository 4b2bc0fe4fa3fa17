"""The layout of a table in text: that of its program or sensor, or else as its lines tell it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path

from pyimu.errors import UserError
from pyimu.recording.formats.bodies import total_capture
from pyimu.recording.formats.by_word import rows_by_word
from pyimu.recording.formats.echoed import echoed
from pyimu.recording.formats.flysight import flysight
from pyimu.recording.formats.headed import headed
from pyimu.recording.formats.labelled import labelled
from pyimu.recording.formats.lines import CARRIAGE, code_of, is_comment, lines
from pyimu.recording.formats.long_table import long_table
from pyimu.recording.formats.marked import (
    GNSS_LOGGER,
    SHARE,
    Marked,
    gnss_logger,
    sentences,
    vectornav,
)
from pyimu.recording.formats.mixed_rows import OF_OTHERS, Mixed, mixed_rows
from pyimu.recording.formats.novatel import novatel
from pyimu.recording.formats.optical import optical
from pyimu.recording.formats.plain_numbers import Plain, plain_numbers
from pyimu.recording.formats.prefixes import behind, without_prefixes
from pyimu.recording.formats.sections import Sections, sections
from pyimu.recording.formats.thousands import without_marks
from pyimu.recording.formats.told import HEAD, NO_TOPICS, Layout, told_from
from pyimu.recording.formats.whole_names import with_whole_names
from pyimu.recording.naming.name import named

UNCLOSED = "a quotation mark is not closed, so that the cells behind it are one"

FAR = 100_000
"""Lines among which a log of several kinds has each: satellites are logged from the start."""

MESSAGES = (
    "of ROS's messages take the bag, or a table of them: rostopic echo -p, ros2 topic echo --csv; "
    "whole messages as they are printed are read as .txt"
)
"""What is said of messages that were printed, a number on a line."""

_ROS = {"angular_velocity:", "linear_acceleration:"}

FIT = (
    "have a table with a row for each: timestamp_ms + sample_time_offset [ms], calibrated_gyro_x, "
    "_y, _z [deg/s] and calibrated_accel_x, _y, _z [g]"
)
"""What is said of Garmin's files as its FitCSVTool writes them."""


def layout_of(path: Path, topic: str = "") -> Layout:
    """The layout of the table in ``path``; ``topic`` is the word before the rows that are meant,
    of a log of several kinds.

    Raises UserError for what is no text, for names of which a quotation mark is left open, and for
    a topic that is not there.
    """
    head = with_whole_names(list(islice(lines(path), HEAD)))
    if not any(line.strip() for line in head):
        raise UserError(f"{path}: is empty")
    if any("\r" in line.rstrip("\r\n") for line in head[:1]):
        raise UserError(f"{path}: {CARRIAGE}")
    clean = without_prefixes(head)
    if clean is None:
        return replace(_told(head, path, topic), code=code_of(path))
    found = _told([clean(line) for line in head], path, topic)
    marked = behind(clean, found.marked, found.names, found.clocks)
    return replace(found, marked=marked, code=code_of(path))


def _told(head: Sequence[str], path: Path, topic: str) -> Layout:
    """The layout of a table with these first lines; raises UserError as ``layout_of`` does."""
    marked = None if topic else echoed(head)
    if marked is None and _ROS <= {line.strip() for line in head}:
        raise UserError(f"{path}: is no table; {MESSAGES}")
    marked = marked or _marked(head, path, topic)
    if marked is not None:
        told = (k for k, line in enumerate(head, 1) if _is_told(marked, line.strip()))
        return Layout(
            names=marked.names,
            first=next(told, 1),
            clocks=marked.clocks,
            rate=marked.rate,
            marked=marked,
        )
    ended = _ended(head)
    if ended is not None:
        return ended
    table = optical(head)
    if table is not None:
        return Layout(table.separator, ".", table.names, table.first, rate=table.rate)
    if any(line.startswith("Type,Local Number,Message,Field 1,") for line in head[:1]):
        raise UserError(
            f"{path}: is a list of FIT's messages, with several samples in a cell; {FIT}"
        )
    below = sections(head)
    if below is not None:
        return _behind(below)
    found = _of_table(head, topic)
    if long := long_table(head, found):
        raise UserError(f"{path}: {long}")
    for row, line in enumerate(head[: found.first - 1], 1):
        line = line.rstrip("\r\n")
        if not is_comment(line) and len(found.cells(line)) > 1 and found.is_open(line):
            raise UserError(f"{path}: row {row}: {UNCLOSED}")
    return found


def _behind(table: Sections) -> Layout:
    """The layout of a table behind sections."""
    found = Layout(table.separator, table.decimal, table.names, table.first, rate=table.rate)
    if table.rewrite is None:
        return found
    said = "columns separated by blanks"
    marked = Marked(table.names, table.rewrite, said, table.clocks)
    return replace(found, marked=marked, clocks=table.clocks)


def _of_table(head: Sequence[str], topic: str) -> Layout:
    """The layout of a table, whose numbers may be written otherwise, or its rows be of several
    sensors.
    """
    mixed = mixed_rows(head, topic)
    if mixed is not None:
        return _of_mixed(head, mixed)
    rewrite = without_marks(head)
    plain = plain_numbers(head) if rewrite is None else Plain(rewrite, "thousands that stand apart")
    if plain is None:
        return told_from(head)
    found = told_from([plain.rewrite(line.rstrip("\r\n")) + "\n" for line in head])
    names = tuple(
        f"{name} [{plain.units[k]}]" if k in plain.units and named(name).unit is None else name
        for k, name in enumerate(found.names)
    )
    marked = Marked(names, plain.rewrite, plain.said, found.clocks)
    return replace(found, names=names, marked=marked)


def _of_mixed(head: Sequence[str], mixed: Mixed) -> Layout:
    """The layout of the rows that are read of a table of several sensors; a column that is empty in
    them has no name that says what it is.
    """
    found = told_from([line for line in head if mixed.keeps(line)])
    names = tuple(
        f"column {k + 1} {OF_OTHERS}" if k in mixed.empty else name
        for k, name in enumerate(found.names)
    )
    marked = Marked(
        names,
        lambda line: line if mixed.keeps(line) else None,
        mixed.said,
        found.clocks,
        word=mixed.word,
        words=mixed.others if mixed.joined else (),
    )
    return replace(found, names=names, marked=marked)


def _marked(head: Sequence[str], path: Path, topic: str) -> Marked | None:
    """How lines are read that say what their values are, None of a table's.

    Raises UserError for a ``topic`` that is not there.
    """
    if topic:
        readings = (gnss_logger, total_capture, flysight, _by_word)
        found = next((m for reading in readings if (m := reading(head, topic)) is not None), None)
        if found is not None:
            return found
        bodies = total_capture(head)
        if bodies is not None:
            raise UserError(f"{path}: has no topic {topic}; read are {bodies.said}")
        there = [word for word in GNSS_LOGGER if gnss_logger(head, word)]
        if there:
            raise UserError(f"{path}: has no topic {topic}; there are {', '.join(there)}")
        if mixed_rows(head, topic) is not None:
            return None
        raise UserError(NO_TOPICS.format(path))
    there = next((t for t in GNSS_LOGGER[:2] if gnss_logger(head, t) and _holds(path, t)), None)
    if there is not None:
        return gnss_logger(head, there)
    rows = [line for line in head if line.strip() and not is_comment(line)]
    return (
        novatel(head)
        or flysight(head)
        or vectornav(rows)
        or sentences(rows)
        or total_capture(rows)
        or labelled(head, path)
        or headed(head, path)
        or rows_by_word(rows)
    )


def _by_word(head: Sequence[str], topic: str) -> Marked | None:
    return rows_by_word([line for line in head if line.strip() and not is_comment(line)], topic)


_ENDS = " ;\r\n"


def _ended(head: Sequence[str]) -> Layout | None:
    """The layout of a table between commas with a semicolon behind each row, None of any other."""
    rows = [line for line in head if line.strip() and not is_comment(line)]
    tail = rows[len(rows) // 2 :]
    ends = [line.rstrip().endswith(";") and line.count(";") == 1 for line in tail]
    if not tail or sum(ends) < SHARE * len(tail):
        return None
    found = told_from([line.rstrip(_ENDS) + "\n" for line in head])
    if found.separator != "," or len(found.names) < 3:
        return None
    said = "a semicolon behind each row"
    return replace(found, marked=Marked(found.names, lambda line: line.rstrip(_ENDS), said))


def _is_told(marked: Marked, line: str) -> bool:
    """Whether a line is made into another one: before the first some boards greet."""
    return marked.rewrite(line) not in (None, line)


def _holds(path: Path, word: str) -> bool:
    """Whether one of the first lines of a log begins with ``word``."""
    return any(line.startswith(word + ",") for line in islice(lines(path), FAR))
