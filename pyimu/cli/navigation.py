"""The command ``pyimu navigate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyimu.cli.options import FORMATS, Columns, Effects, Latitude, add_effects, progress, radians


def navigate_command(
    log: Annotated[
        Path, typer.Argument(metavar="LOG", help=f"Recording: {FORMATS}.", show_default=False)
    ],
    out: Annotated[
        Path,
        typer.Option("--out", help="Folder for report.html, report.json and navigation.parquet."),
    ] = Path("out/navigate"),
    part: Annotated[
        str | None,
        typer.Option(
            "--part",
            help="Built-in part or a TOML file, such as the model.toml of pyimu close; without it "
            "the noise is the log's own.",
        ),
    ] = None,
    columns: Columns = None,
    method: Annotated[
        str,
        typer.Option("--method", help="paper, strapdown, filter, smoother, or all."),
    ] = "all",
    zupt: Annotated[
        str,
        typer.Option(
            "--zupt",
            help="Rests: auto (column stationary, else the samples), declared (that column), off.",
        ),
    ] = "auto",
    nhc: Annotated[
        bool,
        typer.Option("--nhc", help="A vehicle: its wheels slip neither sideways nor upwards."),
    ] = False,
    latitude: Latitude = None,
    heading0: Annotated[
        float | None,
        typer.Option(
            "--heading0",
            help="Degrees counter-clockwise from east at the start; else that of the log's heading "
            "or reference, or 0.",
        ),
    ] = None,
    top_speed: Annotated[
        float | None,
        typer.Option(
            "--top-speed", help="m/s; what may have been driven in a gap.", show_default="2"
        ),
    ] = None,
    effects: Effects = None,
) -> None:
    """Example: pyimu navigate square.csv --part mpu6050 --out out/navigate

    The path of a robot by its inertial unit alone: integrated as Wongwirat and Chaiyarat (2010)
    did, integrated exactly, by a filter that knows at each rest that the velocity is zero, and
    smoothed by the whole log, each beside the reference where the log has one.
    """
    from pyimu.files import check_folder
    from pyimu.navigation.run import run
    from pyimu.recording.log import read_recording

    at, heading = radians("--latitude", latitude, 90), radians("--heading0", heading0, 360)
    check_folder(out)
    add_effects(effects)
    with progress("reading") as say:
        recording = read_recording(log, columns)
        say("running the filter")
        found = run(
            recording,
            part,
            method=method,
            zupt=zupt,
            nhc=nhc,
            latitude=at,
            heading0=heading,
            settings={} if top_speed is None else {"top_speed": top_speed},
            say=say,
        )
        say("drawing the report")
        page = found.write(out)
    print(found.report())
    print(f"report: {page}, estimates: {page.with_name('navigation.parquet')}")
