"""The command that takes logs of a robot that turns about the vertical."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer

from pyimu.cli.options import FORMATS, Columns, Effects, Out, add_effects, progress


def heading_command(
    logs: Annotated[
        list[Path],
        typer.Argument(
            metavar="LOG", help=f"Recordings of one robot: {FORMATS}.", show_default=False
        ),
    ],
    out: Out = Path("out/heading"),
    part: Annotated[
        str | None,
        typer.Option(
            "--part", help="Built-in part or a TOML file; else the noise is that of the start-up."
        ),
    ] = None,
    method: Annotated[
        str,
        typer.Option(
            "--method",
            help="integrate, self-calibration, threshold, paper, filter, or all; separated by "
            "commas.",
        ),
    ] = "all",
    known: Annotated[
        list[Path] | None,
        typer.Option(
            "--known",
            help="Log of the known motion with its reference: one for all, or one for each LOG.",
        ),
    ] = None,
    start_up: Annotated[
        float,
        typer.Option("--start-up", help="Seconds of each LOG that are its known motion, else."),
    ] = 20.0,
    reference: Annotated[
        str | None,
        typer.Option("--reference", help="heading or rate: what to calibrate by, of the two."),
    ] = None,
    threshold: Annotated[
        float, typer.Option("--threshold", help="deg/s; slower rates count as none.")
    ] = 0.3,
    release: Annotated[
        float | None,
        typer.Option("--release", help="deg/s below which a turn ends; else the threshold."),
    ] = None,
    hold: Annotated[
        float, typer.Option("--hold", help="Seconds by which a turn outlasts its last fast rate.")
    ] = 0.0,
    slip: Annotated[
        float,
        typer.Option(
            "--slip", help="Percent by which the known motion may be another, standard deviation."
        ),
    ] = 0.0,
    columns: Columns = None,
    effects: Effects = None,
) -> None:
    """Example: pyimu heading robot.csv --method all --out out/heading

    The heading of an indoor robot from one gyro about the vertical: added up, self-calibrated on a
    known start-up motion, with a threshold filter, both (Hong and Park 2008), and by a Kalman
    filter on heading, bias and scale factor that uses every stop. Each method's error against the
    log's reference heading, over several logs with intervals.
    """
    from pyimu.errors import UserError
    from pyimu.files import check_folder
    from pyimu.heading.motion import Reference
    from pyimu.heading.run import run
    from pyimu.recording.log import read_recording

    references: dict[str | None, Reference | None] = {
        None: None,
        "heading": "heading",
        "rate": "rate",
    }
    if reference not in references:
        raise UserError(f"--reference {reference}: unknown; known are heading, rate")
    check_folder(out)
    add_effects(effects)
    with progress("reading") as say:
        found = run(
            [read_recording(path, columns) for path in logs],
            part,
            method,
            known=[read_recording(path, columns) for path in known] if known else None,
            start_up=start_up,
            reference=references[reference],
            threshold=math.radians(threshold),
            release=None if release is None else math.radians(release),
            hold=hold,
            slip_std=slip / 100,
            say=say,
        )
        say("drawing the report")
        page = found.write(out)
    print(found.report())
    print(f"report: {page}")
