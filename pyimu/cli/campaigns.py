"""The command that runs a campaign."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from pyimu.cli.choices import one_of, some_of
from pyimu.cli.options import (
    Json,
    Out,
    PartName,
    Quiet,
    check_told,
    option,
    progress,
    radians,
    tell,
    text_of,
)
from pyimu.errors import UserError

DriveName = Annotated[
    str,
    option("--drive", "turn-on-spot, straight, obstacle, ackermann or sol.", one_of("--drive")),
]
Runs = Annotated[int, typer.Option("--runs", help="Runs, from number 0 on.")]
Seed = Annotated[int, typer.Option("--seed", help="Begins all draws.")]
Scheduler = Annotated[
    str | None,
    typer.Option(
        "--scheduler",
        metavar="ADDRESS",
        help="Dask scheduler, as tcp://host:8786; else processes of this machine.",
    ),
]
Workers = Annotated[
    int | None,
    typer.Option("--workers", help="Processes; 0: this one alone. Else one for each core."),
]
Specimens = Annotated[
    bool | None,
    typer.Option(
        "--specimens/--no-specimens",
        help="Each run has a part of its own; else where the part has tolerances.",
        show_default=False,
    ),
]
Faults = Annotated[
    str,
    typer.Option(
        "--faults",
        help="A run has one of these or none: lost-axis, stuck, saturating, heading-lost, "
        "heading-wrong, separated by commas.",
        autocompletion=some_of("--faults"),
    ),
]
Sol = Annotated[
    bool,
    typer.Option("--sol", help="Sols without and with a heading once an hour, side by side."),
]
HeadingEvery = Annotated[
    float, typer.Option("--heading-every", help="Seconds between headings; 0: none.")
]
HeadingStd = Annotated[float, typer.Option("--heading-std", help="Degrees, of a heading.")]
Rate = Annotated[
    float | None,
    typer.Option("--rate", help="Hz of the sensors; else the part's, and 5 for a sol."),
]
Body = Annotated[
    str | None,
    option("--body", "Earth, Mars or Moon; else the Earth, and of a sol Mars.", one_of("--body")),
]
Terrains = Annotated[int, typer.Option("--terrains", help="Grounds among the runs.")]
Number = Annotated[
    int | None,
    typer.Option("--run", help="Only this run, with its log and picture; under --out."),
]


def campaign_command(
    part: PartName,
    out: Out = Path("out/campaign"),
    drive: DriveName = "turn-on-spot",
    runs: Runs = 1000,
    seed: Seed = 0,
    scheduler: Scheduler = None,
    workers: Workers = None,
    specimens: Specimens = None,
    faults: Faults = "",
    sol: Sol = False,
    heading_every: HeadingEvery = 0.0,
    heading_std: HeadingStd = 0.5,
    rate: Rate = None,
    body: Body = None,
    terrains: Terrains = 4,
    number: Number = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu campaign imt30 --drive turn-on-spot --runs 1000 --out out/campaign

    Many drives of a rover with a part, each with noise, specimen, ground, temperature and fault of
    its own: how large the errors are, whether the filter is as good as it says, and which parameter
    drives the error. A run follows from the settings and its number alone; what was broken off goes
    on where it was.
    """
    from pyimu.model.part_file import part as part_of
    from pyimu.rover.campaign.campaign import run
    from pyimu.rover.campaign.repeat import repeat
    from pyimu.rover.campaign.settings import Settings
    from pyimu.rover.campaign.sol import sols

    check_told(as_json, quiet)
    if sol and (heading_every or number is not None or drive not in ("turn-on-spot", "sol")):
        raise UserError("--sol goes without --drive, --heading-every and --run: it sets them")
    settings = Settings(
        part_of(part),
        "sol" if sol else drive,
        seed=seed,
        specimens=specimens,
        faults=tuple(name.strip() for name in faults.split(",") if name.strip()),
        terrains=terrains,
        rate=rate,
        body=body,
        heading_every=heading_every,
        heading_std=radians("--heading-std", heading_std, 180.0) or 0.0,
    )
    if number is not None:
        with progress(f"run {number}"):
            folder = repeat(settings, number, out)
        made = f"log: {folder / 'log.parquet'}, picture: {folder / 'errors.png'}"
        data = text_of(folder / "run.json")
        tell(lambda: made, data, as_json=as_json, quiet=quiet)
        return
    with progress("preparing") as say:
        go = sols if sol else run
        done = go(settings, runs, out, scheduler=scheduler, workers=workers, say=say)
    tell(done.report, text_of(done.data), [done.where], as_json=as_json, quiet=quiet)
