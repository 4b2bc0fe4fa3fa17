"""The command that runs the attitude filter over a log."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

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
    place_in_radians,
    progress,
    radians,
    tell,
    text_of,
)
from pyimu.errors import UserError

if TYPE_CHECKING:
    from pyimu.model.part import Part

Folder = Annotated[
    Path, typer.Option("--out", help="Folder for report.html, report.json and attitude.parquet.")
]
OfPart = Annotated[
    str | None,
    typer.Option(
        "--part",
        help="Built-in part or a TOML file; without it the noise is the log's own.",
        autocompletion=complete_part,
    ),
]
Heading0 = Annotated[
    float | None,
    typer.Option(
        "--heading0",
        help="Degrees counter-clockwise from east at the start; else the first recorded one, "
        "or the magnetometer's, or 0.",
    ),
]
Calibration = Annotated[
    Path | None,
    typer.Option(
        "--magnetometer", help="Calibration of the log's magnetometer, as characterize writes it."
    ),
]
NoMagnetometer = Annotated[
    bool,
    typer.Option(
        "--no-magnetometer", help="Leave the log's magnetometer out; else it corrects the heading."
    ),
]
Declination = Annotated[
    float | None,
    typer.Option(
        "--declination", help="Degrees by which magnetic north is east of true north; else 0."
    ),
]
Place = Annotated[
    str | None,
    typer.Option(
        "--place",
        help="LAT,LON[,HEIGHT] in degrees north and east, and m: with --date, declination, "
        "strength and dip by the World Magnetic Model, and the latitude.",
    ),
]
Day = Annotated[
    str | None, typer.Option("--date", help="Day of the log, for --place, as 2026-05-01.")
]
Settings = Annotated[
    str | None,
    typer.Option(
        "--settings",
        help="Filter: ukf, the package's own, or hidalgo2012, as published.",
        autocompletion=one_of("--settings"),
        show_default="ukf",
    ),
]
Smooth = Annotated[
    bool, typer.Option("--smooth", help="Estimate each sample by all of the log, not by its past.")
]


def attitude_command(
    log: Log,
    out: Folder = Path("out/attitude"),
    part: OfPart = None,
    columns: Columns = None,
    latitude: Latitude = None,
    heading0: Heading0 = None,
    magnetometer: Calibration = None,
    no_magnetometer: NoMagnetometer = False,
    declination: Declination = None,
    place: Place = None,
    date: Day = None,
    settings: Settings = None,
    smooth: Smooth = False,
    effects: Effects = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu attitude rover.csv --part imt30 --out out/attitude

    Roll, pitch, yaw and gyro bias over a log with their standard deviations, by an unscented filter
    with the errors of a part undone: when gravity was used and how well it fitted, what
    contradicted the estimate, and, where the log has a reference attitude, the error against it.
    """
    from pyimu.attitude.calibration import MagnetometerCalibration
    from pyimu.attitude.filters import chosen
    from pyimu.attitude.run import run
    from pyimu.files import check_folder
    from pyimu.recording.log import read_recording

    check_told(as_json, quiet)
    at, heading = radians("--latitude", latitude, 90), radians("--heading0", heading0, 360)
    north = radians("--declination", declination, 180)
    where = place_in_radians("--place", place)
    if where is not None:
        _told_twice({"--declination": declination, "--latitude": latitude})
    method, given = chosen(settings)
    given |= {"filter": method} | ({} if north is None else {"declination": north})
    if magnetometer is not None and no_magnetometer:
        raise UserError("--magnetometer beside --no-magnetometer: give one of the two")
    check_folder(out)
    add_effects(effects)
    declared = _declared(part, quiet)
    with progress("reading") as say:
        undone = None if magnetometer is None else MagnetometerCalibration.read(magnetometer)
        recording = read_recording(log, columns)
        say("running the filter")
        found = run(
            recording,
            declared,
            latitude=at,
            place=where,
            date=date,
            heading0=heading,
            magnetometer=undone or not no_magnetometer,
            settings=given,
            smooth=smooth,
            heard=lambda share: say("running the filter", share),
        )
        say("drawing the report")
        page = found.write(out)
    lines = [f"report: {page}, estimates: {page.with_name('attitude.parquet')}"]
    tell(found.report, text_of(out / "report.json"), lines, as_json=as_json, quiet=quiet)


def _declared(name: str | None, quiet: bool) -> Part | None:
    """The part; which of its errors the filter leaves in is said before it runs."""
    from pyimu.attitude.filter.compensation import NOT_UNDONE, left_in
    from pyimu.model.part_file import part
    from pyimu.report.numbers import joined

    if name is None:
        return None
    declared = part(name)
    left = left_in(declared, retimed=True)
    if left and not quiet:
        print(f"{declared.name}: left in, {NOT_UNDONE}: {joined(left)}", file=sys.stderr)
    return declared


def _told_twice(values: dict[str, float | None]) -> None:
    """Raise UserError for an option that ``--place`` tells as well."""
    for option in (o for o, value in values.items() if value is not None):
        raise UserError(f"{option} beside --place, which tells it: give one of the two")
