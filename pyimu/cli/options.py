"""What the commands share: options, a progress bar, effects of the user's own."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from pyimu.errors import UserError

Out = Annotated[
    Path, typer.Option("--out", help="Folder for what is written; made if it is missing.")
]


def option(name: str, text: str) -> Any:
    """An option of a command, with what ``--help`` says of it."""
    return typer.Option(name, help=text)


FORMATS = "CSV(.gz), Parquet, MAT, HDF5, ROS bag or MCAP"
"""Files that a recording may be."""

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
