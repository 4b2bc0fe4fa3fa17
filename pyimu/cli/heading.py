"""The command that takes logs of a robot that turns about the vertical."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pyimu.cli.choices import complete_part, one_of, some_of
from pyimu.cli.options import (
    FORMATS,
    Columns,
    Effects,
    Json,
    Out,
    Quiet,
    add_effects,
    check_told,
    option,
    progress,
    tell,
    text_of,
)

if TYPE_CHECKING:
    from pyimu.heading.motion import Reference

Logs = Annotated[
    list[Path],
    typer.Argument(metavar="LOG", help=f"Recordings of one robot: {FORMATS}.", show_default=False),
]
PartName = Annotated[
    str | None,
    option(
        "--part",
        "Built-in part or a TOML file; else the noise is that of the start-up.",
        complete_part,
    ),
]
Method = Annotated[
    str,
    option(
        "--method",
        "integrate, self-calibration, threshold, paper, filter, or all; separated by commas.",
        some_of("heading --method"),
    ),
]
Known = Annotated[
    list[Path] | None,
    option("--known", "Log of the known motion with its reference: one for all, or one each."),
]
StartUp = Annotated[
    float, option("--start-up", "Seconds of each LOG that are its known motion, else.")
]
By = Annotated[
    str | None,
    option(
        "--reference",
        "heading or rate: what to calibrate by, of the two.",
        one_of("heading --reference"),
    ),
]
Threshold = Annotated[float, option("--threshold", "deg/s; slower rates count as none.")]
Release = Annotated[
    float | None, option("--release", "deg/s below which a turn ends; else the threshold.")
]
Hold = Annotated[float, option("--hold", "Seconds by which a turn outlasts its last fast rate.")]
Slip = Annotated[
    float,
    option("--slip", "Percent by which the known motion may be another, standard deviation."),
]


def heading_command(
    logs: Logs,
    out: Out = Path("out/heading"),
    part: PartName = None,
    method: Method = "all",
    known: Known = None,
    start_up: StartUp = 20.0,
    reference: By = None,
    threshold: Threshold = 0.3,
    release: Release = None,
    hold: Hold = 0.0,
    slip: Slip = 0.0,
    columns: Columns = None,
    effects: Effects = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu heading robot.csv --method all --out out/heading

    The heading of an indoor robot from one gyro about the vertical: added up, self-calibrated on a
    known start-up motion, with a threshold filter, both (Hong and Park 2008), and by a Kalman
    filter on heading, bias and scale factor that uses every stop. Each method's error against the
    log's reference heading, over several logs with intervals.
    """
    from pyimu.files import check_folder
    from pyimu.heading.run import run
    from pyimu.heading.threshold import check_not_negative
    from pyimu.recording.log import read_recording

    check_told(as_json, quiet)
    by = _reference(reference)
    given = {"--threshold": threshold, "--release": release, "--hold": hold}
    for name, value in (given | {"--start-up": start_up, "--slip": slip}).items():
        check_not_negative(name, value)
    check_folder(out)
    add_effects(effects)
    with progress("reading") as say:
        found = run(
            [read_recording(path, columns) for path in logs],
            part,
            method,
            known=[read_recording(path, columns) for path in known] if known else None,
            start_up=start_up,
            reference=by,
            threshold=math.radians(threshold),
            release=None if release is None else math.radians(release),
            hold=hold,
            slip_std=slip / 100,
            say=say,
        )
        say("drawing the report")
        page = found.write(out)
    lines = [f"report: {page}"]
    tell(found.report, text_of(out / "report.json"), lines, as_json=as_json, quiet=quiet)


def _reference(text: str | None) -> Reference | None:
    from pyimu.errors import UserError

    known: dict[str | None, Reference | None] = {None: None, "heading": "heading", "rate": "rate"}
    if text not in known:
        raise UserError(f"--reference {text}: unknown; known are heading, rate")
    return known[text]
