"""The command line: each command a thin layer over the function of the same name."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from pyimu.errors import UserError
from pyimu.interrupt import Interrupts, ignore_at_exit

# The matrices here are small: BLAS threads would wait for each other longer than they compute.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

app = typer.Typer(
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help=(
        "Example: pyimu demo\n\nMEMS inertial sensors, from a measured log to FMI co-simulation "
        "units and back."
    ),
)

Out = Annotated[
    Path, typer.Option("--out", help="Folder for what is written; made if it is missing.")
]


Columns = Annotated[
    Path | None, typer.Option("--columns", help="TOML that renames a foreign log's columns.")
]
Effects = Annotated[
    list[Path] | None,
    typer.Option(
        "--effects", help="Python file with effects of your own; it is run. May be given twice."
    ),
]


INTERRUPTED = 130
"""Exit status of a run that was broken off from the keyboard."""


def main() -> None:
    """Entry point of the command line.

    An error that the user can mend ends with one line on stderr and exit status 2.
    """
    interrupts = Interrupts()
    try:
        with interrupts:
            code = app(prog_name="pyimu", standalone_mode=False)
        if code == INTERRUPTED:  # the parser's own way to say it
            raise KeyboardInterrupt
    except (KeyboardInterrupt, typer.Abort):
        code = _interrupted()
    except UserError as error:
        code = _interrupted() if interrupts.asked else _refuse(str(error))
    except Exception as error:
        # The command line parser's own errors know how to say themselves in a line.
        if interrupts.asked:
            code = _interrupted()
        elif hasattr(error, "format_message"):
            command = getattr(getattr(error, "ctx", None), "command_path", None) or "pyimu"
            code = _refuse(f"{error.format_message()} ({command} --help shows what is possible)")
        else:
            raise
    ignore_at_exit()
    sys.exit(code if isinstance(code, int) else 0)


def _interrupted() -> int:
    return _refuse("interrupted; earlier results are as they were", INTERRUPTED)


def _refuse(text: str, code: int = 2) -> int:
    print(f"pyimu: {' '.join(text.split())}", file=sys.stderr)
    return code


@app.callback(invoke_without_command=True)
def _top(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", help="Print the version and leave.")
    ] = False,
) -> None:
    if version:
        from pyimu import __version__

        print(__version__)
        raise typer.Exit
    if context.invoked_subcommand is None:
        print(context.get_help())


@app.command(short_help="The whole loop on a built-in recording.")
def demo(out: Out = Path("out/demo")) -> None:
    """Example: pyimu demo

    The whole loop on a built-in recording: a rover with an IMT30 whose gyros have a scale factor
    error that no data sheet declares. Finds it, adds it, and shows the heading error before and
    after.
    """
    from pyimu.rover.demo import run_demo

    with progress("simulating the rover") as say:
        shown = run_demo(out, say)
    print(shown.report())
    print(f"report: {out / 'report.html'}, picture: {out / 'heading.png'}")


@app.command(
    "characterize", short_help="Noise, temperature effect and quality of a sensor at rest."
)
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
    columns: Columns = None,
    level: Annotated[float, typer.Option("--level", help="Probability of the intervals.")] = 0.95,
) -> None:
    """Example: pyimu characterize static.csv --out out/static

    Allan deviation, spectrum, temperature effect and quality of the samples of a sensor at rest:
    its noise coefficients with intervals, the pictures of a data sheet, and a part file for pyimu
    build and pyimu close. Several logs of one part give means and their spread. The samples wait in
    temporary files (TMPDIR says where), so that a log may be larger than memory.
    """
    from pyimu.characterization.run import characterize
    from pyimu.files import check_folder
    from pyimu.recording.log import open_log

    check_folder(out)
    with progress("reading") as say:
        found = characterize([open_log(path, columns) for path in logs], level, say)
        say("drawing the report")
        page = found.write(out)
    print(found.report())
    print(f"report: {page}, part: {page.with_name('part.toml')}")


@app.command("close", short_help="Find what a sensor's model lacks to explain measured logs.")
def close_command(
    logs: Annotated[
        list[Path],
        typer.Argument(
            metavar="LOG",
            help="Recordings: CSV(.gz), Parquet, MAT, HDF5, ROS bag or MCAP.",
            show_default=False,
        ),
    ],
    out: Annotated[
        Path,
        typer.Option("--out", help="Folder for report.html, report.json, model.toml and the FMUs."),
    ] = Path("out/close"),
    part: Annotated[
        str | None,
        typer.Option("--part", help="Built-in part or a TOML file; without it all is estimated."),
    ] = None,
    holdout: Annotated[
        list[Path] | None,
        typer.Option("--holdout", help="Log to judge by; else the last 30 % of each."),
    ] = None,
    columns: Columns = None,
    reference: Annotated[
        list[Path] | None,
        typer.Option(
            "--reference",
            help="Reference in a file of its own: one for each LOG, then for each --holdout.",
        ),
    ] = None,
    reference_columns: Annotated[
        Path | None, typer.Option("--reference-columns", help="TOML that renames its columns.")
    ] = None,
    latitude: Annotated[
        float | None,
        typer.Option("--latitude", help="Degrees; adds the Earth's rate to a derived reference."),
    ] = None,
    effects: Effects = None,
) -> None:
    """Example: pyimu close rover.csv --part imt30 --out out/rover

    Compare a sensor's model with measured logs, find the effects that it lacks, add them, and
    report the error before and after on data that was not fitted, with the model as a part file and
    as FMUs.
    """
    from pyimu.identification.close import close
    from pyimu.identification.report.deliver import check_delivery
    from pyimu.recording.log import read_recording
    from pyimu.recording.reference.file import read_reference

    if latitude is not None and not abs(latitude) <= 90:
        raise UserError(f"--latitude {latitude:g}: must lie between -90 and 90 deg")
    check_delivery(out)
    _add_effects(effects)
    with progress("reading") as say:
        recordings, judges = (
            [read_recording(p, columns) for p in paths] for paths in (logs, holdout or [])
        )
        closed = close(
            recordings,
            part,
            judges or None,
            reference=[read_reference(p, reference_columns) for p in reference or []],
            latitude=None if latitude is None else math.radians(latitude),
            say=say,
        )
        closed = closed.by_command(sys.argv[1:])
        closed.write(out, say=say)
    print(closed.report())
    print(f"report: {out / 'report.html'}")


@app.command("plan", short_help="The motion that would show an effect of a part, and how well.")
def plan_command(
    part: Annotated[str, typer.Argument(help="Built-in part or a TOML file.", show_default=False)],
    wanted: Annotated[
        list[str],
        typer.Option(
            "--for",
            metavar="EFFECT",
            help="Effect to show, as docs/effects.md names it; several by commas or given again.",
            show_default=False,
        ),
    ],
    sensor: Annotated[
        str | None,
        typer.Option("--sensor", help="gyro or accel; else the first that has the effects."),
    ] = None,
    within: Annotated[
        list[str] | None,
        typer.Option(
            "--within",
            metavar="TARGET",
            help='Standard error to reach, as "0.5 deg/h/K"; with several effects EFFECT=TARGET.',
        ),
    ] = None,
    sigmas: Annotated[
        float,
        typer.Option(
            "--sigmas", help="Without --within: standard errors in the effect's size to reach."
        ),
    ] = 8.0,
    out: Annotated[
        Path, typer.Option("--out", help="Folder for plan.html, plan.json and motion.csv.")
    ] = Path("out/plan"),
    effects: Effects = None,
) -> None:
    """Example: pyimu plan mpu6050 --for g_sensitivity --out out/plan

    Of rest, six positions, a rate table, a turn by hand, a drive, a shaker and a climatic chamber,
    the shortest set of motions that shows the effects of a part that are asked for, with the
    standard error that pyimu close would report of each coefficient. The size of an effect is what
    the part declares, or else a typical one. Writes a page, the same as data, and the motion as a
    recording.
    """
    from pyimu.files import check_folder
    from pyimu.identification.plan.plan import plan

    check_folder(out)
    _add_effects(effects)
    names = [name.strip() for text in wanted for name in text.split(",") if name.strip()]
    with progress("reading") as say:
        planned = plan(part, names, sensor, within or (), sigmas, say)
        say("drawing the page")
        page = planned.write(out)
    print(planned.report())
    files = ", ".join(str(out / name) for name in planned.files()[: len(planned.logs)])
    print(f"page: {page}{f', motion: {files}' if files else ''}")


@app.command(short_help="Build the co-simulation units of a part.")
def build(
    part: Annotated[str, typer.Argument(help="Built-in part or a TOML file.", show_default=False)],
    out: Out = Path("out/fmus"),
    fmu: Annotated[
        str, typer.Option("--fmu", help="Which, separated by commas: sensor, ukf.")
    ] = "sensor,ukf",
    fmi: Annotated[
        str,
        typer.Option(
            "--fmi",
            help="Which forms, separated by commas: 2, 3, block (FMI 3, many samples a step).",
        ),
    ] = "2,3,block",
    platform: Annotated[
        str, typer.Option("--platform", help="host, all (needs ziglang), or one platform by name.")
    ] = "host",
    effects: Effects = None,
) -> None:
    """Example: pyimu build imt30 --out out/fmus

    Build the FMI co-simulation units of a part: the sensor with its errors, and the attitude filter
    that goes with it.
    """
    from pyimu.fmu.package import build as build_part
    from pyimu.fmu.sources import Form

    forms: dict[str, Form] = {"2": 2, "3": 3, "block": "block"}
    names = [name.strip() for name in fmi.split(",")]
    if not all(name in forms for name in names):
        raise UserError(f"--fmi {fmi}: unknown; known are {', '.join(forms)}, separated by commas")
    _add_effects(effects)
    with progress(f"compiling {part}"):
        paths = build_part(
            part,
            out,
            [f.strip() for f in fmu.split(",")],
            [forms[name] for name in names],
            platform,
        )
    for path in paths:
        print(path)


@app.command(short_help="The built-in parts, or one part with the source of each figure.")
def parts(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="PART",
            help="Built-in part or a TOML file; without it all are listed.",
            show_default=False,
        ),
    ] = None,
    effects: Effects = None,
) -> None:
    """Example: pyimu parts mpu6050

    List the built-in parts with their noise and range, or print one part: every coefficient, the
    figure as its data sheet quotes it, and the source. N is the root of the two-sided density; a
    dash stands where the part has no figure.
    """
    from pyimu.report.parts_table import detail, listing, terminal_width

    _add_effects(effects)
    print(detail(name, terminal_width()) if name is not None else listing(width=terminal_width()))


@app.command("derive", short_help="The symbolic results, and what each was checked against.")
def derive_command(
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", help="Folder for derivations.txt, .tex and .md; else they are only printed."
        ),
    ] = None,
) -> None:
    """Example: pyimu derive --out out/derivations

    Print the symbolic results that the package computes with: kinematics, attitude error, Earth
    rate, transition matrix and process noise. Each comes as text and LaTeX, with what it was
    checked against and the difference that was found just now.
    """
    from pyimu.derivations import derive
    from pyimu.files import check_folder

    if out is not None:
        check_folder(out)
    with progress("deriving") as say:
        derived = derive(say)
    print(derived.report(), end="")
    for path in derived.write(out) if out is not None else []:
        print(path)
    if not derived.passed:
        raise typer.Exit(1)


def _add_effects(files: list[Path] | None) -> None:
    if files:
        from pyimu.model.catalogue import add_effects

        add_effects(*files)


@contextmanager
def progress(text: str) -> Iterator[Callable[..., None]]:
    """A progress bar on a terminal, nothing elsewhere.

    Gives the function that says what is being done, and which share of it.
    """
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    with Progress(
        TextColumn("{task.description}"),
        BarColumn(bar_width=20),
        TimeElapsedColumn(),
        console=Console(stderr=True),
        transient=True,
        disable=not sys.stderr.isatty(),
    ) as bar:
        task = bar.add_task(text, total=None)
        # A task that is complete stops its clock.
        yield lambda now, share=None: bar.update(
            task, description=now, completed=0.999 * (share or 0.0), total=share and 1.0
        )


if __name__ == "__main__":
    main()
