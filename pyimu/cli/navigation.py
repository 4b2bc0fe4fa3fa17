"""The command ``pyimu navigate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyimu.cli.choices import complete_part, one_of
from pyimu.cli.options import (
    Columns,
    Effects,
    Json,
    Latitude,
    Log,
    Quiet,
    add_effects,
    check_told,
    option,
    progress,
    radians,
    tell,
    text_of,
)

Out = Annotated[
    Path, typer.Option("--out", help="Folder for report.html, report.json and navigation.parquet.")
]
PartName = Annotated[
    str | None,
    option(
        "--part",
        "Built-in part or a TOML file, such as the model.toml of pyimu close; without it the noise "
        "is the log's own.",
        complete_part,
    ),
]
Method = Annotated[
    str,
    option("--method", "paper, strapdown, filter, smoother, or all.", one_of("navigate --method")),
]
Zupt = Annotated[
    str,
    option(
        "--zupt",
        "Rests: auto (column stationary, else the samples), live (as the unit finds them, without "
        "what comes later), foot (auto, and the stances of a sensor on a foot), declared (that "
        "column), off.",
        one_of("--zupt"),
    ),
]
Nhc = Annotated[bool, option("--nhc", "A vehicle: its wheels slip neither sideways nor upwards.")]
UseFixes = Annotated[
    bool,
    option("--fixes/--no-fixes", "Columns position_east, velocity_east and so on correct it."),
]
PositionStd = Annotated[
    float | None,
    option("--position-std", "m; of those positions, else the column position_std."),
]
VelocityStd = Annotated[
    float | None,
    option("--velocity-std", "m/s; of those velocities, else the column velocity_std."),
]
PositionAge = Annotated[
    float | None,
    option("--position-age", "s; by which those positions are late, else the column position_age."),
]
VelocityAge = Annotated[
    float | None,
    option("--velocity-age", "s; by which those velocities are late, else velocity_age."),
]
Antenna = Annotated[
    str | None,
    option(
        "--antenna",
        "X,Y,Z m forward, left and up from the sensor to where position and velocity are measured.",
    ),
]
Heading0 = Annotated[
    float | None,
    option(
        "--heading0",
        "Degrees counter-clockwise from east at the start; else that of the log's heading or "
        "reference, the course of its positions, or 0.",
    ),
]
TopSpeed = Annotated[
    float | None,
    typer.Option("--top-speed", help="m/s; what may have been driven in a gap.", show_default="2"),
]


def navigate_command(
    log: Log,
    out: Out = Path("out/navigate"),
    part: PartName = None,
    columns: Columns = None,
    method: Method = "all",
    zupt: Zupt = "auto",
    nhc: Nhc = False,
    fixes: UseFixes = True,
    position_std: PositionStd = None,
    velocity_std: VelocityStd = None,
    position_age: PositionAge = None,
    velocity_age: VelocityAge = None,
    antenna: Antenna = None,
    latitude: Latitude = None,
    heading0: Heading0 = None,
    top_speed: TopSpeed = None,
    effects: Effects = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu navigate square.csv --part mpu6050 --out out/navigate

    The path of a robot by its inertial unit: integrated as Wongwirat and Chaiyarat (2010) did,
    integrated exactly, by a filter that knows at each rest that the velocity is zero, and smoothed
    by the whole log, each beside the reference where the log has one.
    """
    from pyimu.files import check_folder
    from pyimu.ins.run import run
    from pyimu.recording.log import read_recording

    check_told(as_json, quiet)
    at, heading = radians("--latitude", latitude, 90), radians("--heading0", heading0, 360)
    settings: dict[str, object] = {} if top_speed is None else {"top_speed": top_speed}
    settings |= {} if antenna is None else {"antenna": _three("--antenna", antenna)}
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
            fixes=fixes,
            position_std=position_std,
            velocity_std=velocity_std,
            position_age=position_age,
            velocity_age=velocity_age,
            latitude=at,
            heading0=heading,
            settings=settings,
            say=say,
        )
        say("drawing the report")
        page = found.write(out)
    lines = [f"report: {page}, estimates: {page.with_name('navigation.parquet')}"]
    tell(found.report, text_of(out / "report.json"), lines, as_json=as_json, quiet=quiet)


def _three(name: str, text: str) -> tuple[float, ...]:
    """The numbers of ``X,Y,Z``. Raises UserError for anything else."""
    from pyimu.errors import UserError

    try:
        numbers = tuple(float(v) for v in text.split(","))
    except ValueError:
        numbers = ()
    if len(numbers) != 3:
        raise UserError(f"{name} {text}: expected X,Y,Z in m, such as 0.2,0,0.5")
    return numbers
