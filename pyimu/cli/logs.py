"""The commands that take a log."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from pyimu.cli.choices import complete_part
from pyimu.cli.options import (
    FORMATS,
    Columns,
    Effects,
    Export,
    Json,
    Out,
    Quiet,
    add_effects,
    check_exports,
    check_told,
    progress,
    radians,
    tell,
    text_of,
    withdraw_exports,
    write_exports,
)
from pyimu.cli.stages import Stages

EXIT_CODES = {
    "clean": 0,
    "named": 10,
    "partly": 11,
    "not_confirmed": 12,
    "unexplained": 13,
    "drift": 14,
    "reference_unfit": 15,
    "undecidable": 16,
}
"""Exit status of ``pyimu close --exit-code`` by verdict; 2 is bad input, 130 a run broken off."""

NO_PART = 17
"""Exit status of ``pyimu characterize --exit-code`` where no part is made; not one of close's."""

ExitCode = Annotated[
    bool,
    typer.Option("--exit-code", help="Exit status by verdict, for scripts: see below."),
]


def demo(out: Out = Path("out/demo"), as_json: Json = False, quiet: Quiet = False) -> None:
    """Example: pyimu demo

    The whole loop on a simulated recording: a rover with an IMT30 whose gyros have a scale factor
    error that no data sheet declares. Finds it, adds it, and shows what was put in beside what was
    found, and the heading error before and after.
    """
    from pyimu.identification.report.deliver import without_units
    from pyimu.rover.demo import run_demo

    check_told(as_json, quiet)
    with progress("simulating the rover") as say:
        shown = run_demo(out, Stages(say, ("gyro", "accel")))
    lines = [said] if (said := without_units()) else []
    lines.append(f"report: {out / 'report.html'}, picture: {out / 'heading.png'}")
    tell(shown.report, text_of(out / "report.json"), lines, as_json=as_json, quiet=quiet)


def characterize_command(
    logs: Annotated[
        list[Path],
        typer.Argument(
            metavar="LOG", help="Recordings of one part at rest; of any length.", show_default=False
        ),
    ],
    out: Annotated[
        Path, typer.Option("--out", help="Folder for report.html, report.json and part.toml.")
    ] = Path("out/characterize"),
    part: Annotated[
        str | None,
        typer.Option(
            "--part",
            help="Data sheet to set beside: a built-in part or a TOML file.",
            autocompletion=complete_part,
        ),
    ] = None,
    columns: Columns = None,
    level: Annotated[float, typer.Option("--level", help="Probability of the intervals.")] = 0.95,
    export: Export = None,
    as_json: Json = False,
    quiet: Quiet = False,
    exit_code: ExitCode = False,
) -> None:
    """Example: pyimu characterize static.csv --out out/static

    Allan deviation, spectrum, temperature effect and quality of the samples of a sensor at rest:
    its noise coefficients with intervals, the pictures of a data sheet, and a part file for pyimu
    build and pyimu close. A log in which it turns every way calibrates its magnetometer as well
    (magnetometer.toml). With --part each figure stands beside the data sheet's. Several logs of one
    part give means and their spread. The samples wait in temporary files (TMPDIR says where), so
    that a log may be larger than memory.

    Exit status: 0, or 2 for bad input. With --exit-code it is 17 where a log moves, holds raw
    counts, or forces in another unit than is stated, of which no part is made and nothing exported.
    """
    from pyimu.characterization.run import characterize
    from pyimu.files import check_folder
    from pyimu.recording.log import open_log

    check_told(as_json, quiet)
    check_folder(out)
    check_exports(export)
    with progress("reading") as say:
        found = characterize([open_log(path, columns) for path in logs], level, say, part)
        say("drawing the report")
        page = found.write(out)
    made, why = page.with_name("part.toml"), found.no_part
    lines = [f"report: {page}, " + (f"no part: {why}" if why else f"part: {made}")]
    if export is not None and why:
        withdrawn = withdraw_exports(export, out, why)
        # A file that was asked for and is not there is an error to a script.
        print(f"pyimu: {withdrawn}", file=sys.stderr) if as_json or quiet else lines.append(
            withdrawn
        )
    elif export is not None:
        lines += write_exports(str(made), export, out)
    tell(found.report, text_of(out / "report.json"), lines, as_json=as_json, quiet=quiet)
    if exit_code and why:
        raise typer.Exit(NO_PART)


Logs = Annotated[
    list[Path],
    typer.Argument(
        metavar="LOG",
        help=f"Recordings: {FORMATS}.",
        show_default=False,
    ),
]
CloseOut = Annotated[
    Path,
    typer.Option("--out", help="Folder for report.html, report.json, model.toml and the FMUs."),
]
ClosePart = Annotated[
    str | None,
    typer.Option(
        "--part",
        help="Built-in part or a TOML file; without it all is estimated.",
        autocompletion=complete_part,
    ),
]
HoldOut = Annotated[
    list[Path] | None,
    typer.Option("--holdout", help="Log to judge by; else 30 % of each, mostly its end."),
]
References = Annotated[
    list[Path] | None,
    typer.Option(
        "--reference",
        help="Reference in a file of its own: one for each LOG, then for each --holdout.",
    ),
]
ReferenceColumns = Annotated[
    Path | None, typer.Option("--reference-columns", help="TOML that renames its columns.")
]
EarthRate = Annotated[
    float | None,
    typer.Option("--latitude", help="Degrees; adds the Earth's rate to a derived reference."),
]


def close_command(
    logs: Logs,
    out: CloseOut = Path("out/close"),
    part: ClosePart = None,
    holdout: HoldOut = None,
    columns: Columns = None,
    reference: References = None,
    reference_columns: ReferenceColumns = None,
    latitude: EarthRate = None,
    effects: Effects = None,
    export: Export = None,
    as_json: Json = False,
    quiet: Quiet = False,
    exit_code: ExitCode = False,
) -> None:
    """Example: pyimu close rover.csv --part imt30 --out out/rover

    Compare a sensor's model with measured logs, find the effects that it lacks, add them, and
    report the error before and after on data that was not fitted, with the model as a part file and
    as FMUs.

    Exit status: 0, or 2 for bad input. With --exit-code a verdict has its own: clean 0, named 10,
    partly 11, not_confirmed 12, unexplained 13, drift 14, reference_unfit 15, undecidable 16.
    """
    from pyimu.identification.close import close
    from pyimu.identification.report.deliver import check_delivery, without_units
    from pyimu.recording.log import read_recording, read_reference

    check_told(as_json, quiet)
    at = radians("--latitude", latitude, 90)
    check_delivery(out)
    check_exports(export)
    add_effects(effects)
    with progress("reading") as say:
        recordings, judges = (
            [read_recording(p, columns) for p in paths] for paths in (logs, holdout or [])
        )
        groups = {g for r in recordings for g in ("gyro", "accel") if getattr(r, g) is not None}
        stages = Stages(say, groups)
        closed = close(
            recordings,
            part,
            judges or None,
            reference=[read_reference(p, reference_columns) for p in reference or []],
            latitude=at,
            say=stages,
        )
        closed = closed.by_command(sys.argv[1:])
        closed.write(out, say=stages)
    lines = [said] if (said := without_units()) else []
    lines.append(f"report: {out / 'report.html'}")
    if export is not None:
        lines += write_exports(str(out / "model.toml"), export, out)
    tell(closed.report, text_of(out / "report.json"), lines, as_json=as_json, quiet=quiet)
    if exit_code:
        raise typer.Exit(EXIT_CODES[closed.verdict])
