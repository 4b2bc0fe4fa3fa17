"""A column map for a table in which each sensor has rows of its own, as if all were in each row."""

from __future__ import annotations

from dataclasses import replace

from pyimu.recording.column_map import ForeignMap
from pyimu.recording.columns import own_name
from pyimu.recording.formats.reader import Reader
from pyimu.recording.formats.suffix import open_reader


def in_own_rows(reader: Reader, foreign: ForeignMap) -> ForeignMap:
    """``foreign`` with the columns that ``reader`` has in rows of other sensors as those of further
    files, each with the same times; as it is where there are none.
    """
    named = foreign.named(reader.header)
    away = {cell: target for cell, target in named.items() if cell not in reader.header}
    if not away or not reader.words:
        return foreign
    times = {cell: target for cell, target in named.items() if own_name(target) == "time"}
    files = []
    for word in reader.words:
        header = open_reader(reader.path, {"imu": word}).header
        its = {cell: target for cell, target in away.items() if cell in header}
        if its:
            other = replace(foreign, columns=times | its, topics={"imu": word}, files=())
            files.append((reader.path.name, other))
            away = {cell: target for cell, target in away.items() if cell not in its}
    taken = {cell for _, other in files for cell in other.columns if cell not in times}
    columns = {cell: target for cell, target in named.items() if cell not in taken}
    return replace(foreign, columns=columns, files=(*foreign.files, *files))
