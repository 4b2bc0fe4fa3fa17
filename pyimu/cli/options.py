"""What the commands share: options, a progress bar, effects of the user's own."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pyimu.cli.choices import Complete, complete_part, some_of
from pyimu.errors import UserError

if TYPE_CHECKING:
    from pyimu.export import Exported
    from pyimu.model.part import Part

Out = Annotated[
    Path, typer.Option("--out", help="Folder for what is written; made if it is missing.")
]


def option(name: str, text: str, complete: Complete | None = None) -> Any:
    """An option of a command, with what ``--help`` says of it and what the shell completes."""
    return typer.Option(name, help=text, autocompletion=complete)


FORMATS = "table in text, Parquet, MAT, HDF5, NumPy, JSON, ROS bag, MCAP, ULog or dataflash"
"""Files that a recording may be."""

Log = Annotated[
    Path, typer.Argument(metavar="LOG", help=f"Recording: {FORMATS}.", show_default=False)
]
Columns = Annotated[
    Path | None, typer.Option("--columns", help="TOML that renames a foreign log's columns.")
]
Latitude = Annotated[
    float | None,
    typer.Option(
        "--latitude",
        help="Degrees; else the log's. Without either, no Earth rate is taken off.",
    ),
]
Effects = Annotated[
    list[Path] | None,
    typer.Option(
        "--effects", help="Python file with effects of your own; it is run. May be given twice."
    ),
]


def radians(option: str, degrees: float | None, most: float) -> float | None:
    """An angle of the command line in rad. Raises UserError beyond ``most`` deg, and for NaN."""
    if degrees is not None and not abs(degrees) <= most:
        raise UserError(f"{option} {degrees:g}: must lie between {-most:g} and {most:g} deg")
    return None if degrees is None else math.radians(degrees)


def place_in_radians(option: str, text: str | None) -> tuple[float, ...] | None:
    """Latitude and longitude in rad, and the height in m if there is one, of ``LAT,LON[,HEIGHT]``.

    Raises UserError for anything else.
    """
    if text is None:
        return None
    try:
        numbers = [float(v) for v in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in (2, 3):
        raise UserError(
            f"{option} {text}: expected LAT,LON or LAT,LON,HEIGHT in degrees north, degrees east "
            "and m, such as 52.5,13.3,40"
        )
    latitude, longitude, *height = numbers
    if not abs(latitude) <= 90 and abs(longitude) <= 90:
        raise UserError(
            f"{option} {text}: the latitude comes first, and lies between -90 and 90 deg; "
            f"is it {longitude:g},{latitude:g}?"
        )
    bounds = (("latitude", latitude, 90), ("longitude", longitude, 360))
    for name, value, most in bounds:
        if not abs(value) <= most:
            raise UserError(
                f"{option} {text}: {name} {value:g}, must lie between {-most} and {most} deg"
            )
    return (math.radians(latitude), math.radians(longitude), *height)


def add_effects(files: list[Path] | None) -> None:
    if files:
        from pyimu.model.catalogue import add_effects as add

        add(*files)


Export = Annotated[
    str | None,
    typer.Option(
        "--export",
        metavar="PROJECTS",
        help="Also write the part as other projects read it, as pyimu export --to does.",
        autocompletion=some_of("--to"),
    ),
]


def check_exports(to: str | None) -> None:
    """Raise UserError now, not after a long run, for a project that is not known."""
    if to is not None:
        from pyimu.export import known

        known(to)


def write_exports(part: Part | str, to: str, out: Path, inflate: float | None = None) -> list[str]:
    """Write the files of the projects ``to``, all or none; gives a line on each."""
    return [f"{out / e.file}: {e.said()}" for e in exported(part, to, out, inflate)]


def exported(part: Part | str, to: str, out: Path, inflate: float | None = None) -> list[Exported]:
    """Write the files of the projects ``to``, all or none."""
    from pyimu.export.targets import export_all
    from pyimu.files import staged, write_text

    made = export_all(part, to, inflate)
    with staged(out) as stage:
        for e in made:
            write_text(stage / e.file, e.text)
    return made


def withdraw_exports(to: str, out: Path, reason: str) -> str:
    """Remove earlier files of the projects ``to``, which would pass for new; gives a line."""
    from pyimu.export import TARGETS, known

    for name in known(to):
        (out / TARGETS[name].file).unlink(missing_ok=True)
    return f"nothing exported ({', '.join(known(to))}): {reason}"


Json = Annotated[
    bool,
    typer.Option(
        "--json", help="Print the result as JSON alone, that of report.json where there is one."
    ),
]
Quiet = Annotated[bool, typer.Option("--quiet", help="Print nothing but errors.")]


def check_told(as_json: bool, quiet: bool) -> None:
    """Raise UserError where both are asked for."""
    if as_json and quiet:
        raise UserError("--json beside --quiet: give one of the two")


def text_of(file: Path) -> Callable[[], str]:
    """What reads a file that a command wrote, whatever the machine's own letters are."""
    return lambda: file.read_text(encoding="utf-8")


def tell(
    report: Callable[[], str],
    data: Callable[[], str],
    lines: Iterable[str] = (),
    *,
    as_json: bool = False,
    quiet: bool = False,
) -> None:
    """Print a result as text with ``lines`` below it, as JSON alone, or not at all."""
    if as_json:
        print(data().rstrip("\n"))
    elif not quiet:
        print("\n".join([report(), *lines]))


PartName = Annotated[
    str,
    typer.Argument(
        help="Built-in part or a TOML file.", show_default=False, autocompletion=complete_part
    ),
]


@contextmanager
def progress(text: str) -> Iterator[Callable[..., None]]:
    """A progress bar on a terminal, nothing elsewhere.

    Gives the function that says what is being done, and which share of it.
    """
    if not sys.stderr.isatty():
        yield lambda now, share=None: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    with Progress(
        TextColumn("{task.description}"),
        BarColumn(bar_width=20),
        TimeElapsedColumn(),
        console=Console(stderr=True),
        transient=True,
    ) as bar:
        task = bar.add_task(text, total=None)
        # A task that is complete stops its clock.
        yield lambda now, share=None: bar.update(
            task, description=now, completed=0.999 * (share or 0.0), total=share and 1.0
        )
