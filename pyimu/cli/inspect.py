"""The command that looks into a log."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyimu.cli.options import FORMATS, Columns, progress


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
    as_json: Annotated[bool, typer.Option("--json", help="Print it as JSON.")] = False,
) -> None:
    """Example: pyimu inspect log.csv --write-map map.toml

    What is in a log, of any layout: its columns and their units as the header or the numbers say,
    rates, gaps, rests and the quality of the samples; and the column map by which the other
    commands read it (--columns map.toml). What nobody can know stands in the map to be chosen.
    """
    import json

    from pyimu.files import check_folder, plain
    from pyimu.inspection.run import inspect

    if out is not None:
        check_folder(out)
    with progress("opening") as say:
        found = inspect(files, columns, say)
        if out is not None:
            say("drawing the report")
            found.write(out)
    print(json.dumps(plain(found.as_dict()), indent=2) if as_json else found.report())
    if write_map is not None:
        found.write_map(write_map)
    if not as_json:
        if write_map is not None:
            print(f"map: {write_map}")
        if out is not None:
            print(f"report: {out / 'report.html'}")
