"""The command that looks into a log."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from pyimu.cli.options import FORMATS, Columns, Json, Quiet, check_told, progress, tell

UNREADABLE = 1
"""Exit status where a log was looked into and cannot be read as it is; 2 is bad input."""


def inspect_command(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE",
            help=f"A log ({FORMATS}), or the files of one log.",
            show_default=False,
        ),
    ],
    write_map: Annotated[
        Path | None,
        typer.Option("--write-map", metavar="MAP.toml", help="Write the column map there."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for report.html with pictures.")
    ] = None,
    columns: Columns = None,
    sensor: Annotated[
        str,
        typer.Option(
            "--sensor",
            metavar="NAME",
            help="Of a table with several sensors the one to read, as its columns call it.",
            show_default=False,
        ),
    ] = "",
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu inspect log.csv --write-map map.toml

    What is in a log, of any layout: its columns and their units as the header or the numbers say,
    rates, gaps, rests and the quality of the samples; and the column map by which the other
    commands read it (--columns map.toml). What nobody can know stands in the map to be chosen.

    Exit status: 0, 1 for a log that cannot be read without more said, in a column map, or 2 for bad
    input.
    """
    from pyimu.errors import UserError
    from pyimu.files import check_folder, json_text
    from pyimu.inspection.run import inspect

    check_told(as_json, quiet)
    if sensor and columns is not None:
        raise UserError("--sensor: a column map (--columns) says which columns are read; give one")
    if out is not None:
        check_folder(out)
    with progress("opening") as say:
        found = inspect(files, columns, say, sensor)
        if out is not None:
            say("drawing the report")
            found.write(out)
    lines = []
    if write_map is not None:
        found.write_map(write_map)
        lines.append(f"map: {write_map}")
    if out is not None:
        lines.append(f"report: {out / 'report.html'}")
    data = found.as_dict()
    said = partial(found.report, write_map)
    tell(said, lambda: json_text(data), lines, as_json=as_json, quiet=quiet)
    if not found.readable:
        raise typer.Exit(UNREADABLE)
