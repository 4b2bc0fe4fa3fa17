"""The command that runs a campaign."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyimu.cli.options import Out, progress


def campaign_command(
    part: Annotated[str, typer.Argument(help="Built-in part or a TOML file.", show_default=False)],
    out: Out = Path("out/campaign"),
    drive: Annotated[
        str, typer.Option("--drive", help="turn-on-spot, straight, ackermann or sol.")
    ] = "turn-on-spot",
    runs: Annotated[int, typer.Option("--runs", help="Runs, from number 0 on.")] = 1000,
    seed: Annotated[int, typer.Option("--seed", help="Begins all draws.")] = 0,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help="Dask scheduler, as tcp://host:8786; else processes of this machine.",
        ),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option("--workers", help="Processes; 0: this one alone. Else one for each core."),
    ] = None,
    specimens: Annotated[
        bool, typer.Option("--specimens/--no-specimens", help="Each run has a part of its own.")
    ] = True,
    faults: Annotated[
        str,
        typer.Option(
            "--faults",
            help="Separated by commas: lost-axis, stuck, saturating, heading-lost, heading-wrong.",
        ),
    ] = "",
) -> None:
    """Example: pyimu campaign imt30 --drive turn-on-spot --runs 1000 --out out/campaign

    Many drives of a rover with a part, each with noise, specimen, ground, temperature and fault of
    its own: how large the errors are, whether the filter is as good as it says, and which parameter
    drives the error. A run follows from the settings and its number alone; what was broken off goes
    on where it was.
    """
    from pyimu.model.part_file import part as part_of
    from pyimu.rover.campaign.campaign import run
    from pyimu.rover.campaign.settings import Settings

    names = tuple(name.strip() for name in faults.split(",") if name.strip())
    settings = Settings(part_of(part), drive, seed=seed, specimens=specimens, faults=names)
    with progress("preparing") as say:
        done = run(settings, runs, out, scheduler=scheduler, workers=workers, say=say)
    print(done.report())
    print(f"table: {done.folder.runs}, report: {done.folder.page}")
