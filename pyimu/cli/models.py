"""The commands that take a part, or nothing."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pyimu.cli.choices import complete_effect, complete_part, one_of, some_of
from pyimu.cli.options import (
    Effects,
    Json,
    Out,
    PartName,
    Quiet,
    add_effects,
    check_told,
    exported,
    option,
    progress,
    tell,
    text_of,
)
from pyimu.errors import UserError

if TYPE_CHECKING:
    from pyimu.fmu.sources import Form

FORMS: dict[str, Form] = {"2": 2, "3": 3, "block": "block"}
"""The forms of a unit, by how ``--fmi`` names them."""


def rover_command(
    part: Annotated[
        str, option("--part", "Built-in part or a TOML file.", complete_part)
    ] = "imt30",
    out: Annotated[
        Path, typer.Option("--out", help="Folder for report.html and report.json.")
    ] = Path("out/rover"),
    seeds: Annotated[
        int, typer.Option("--seeds", min=1, help="Noises that each drive is simulated with.")
    ] = 3,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu rover --part imt30 --out out/rover

    The four test drives of Hidalgo 2012 (straight, over boulders, Ackermann steering, turn on the
    spot), simulated from the rover's motion through sensor and low-pass to the attitude, beside
    that paper's table 6: the gyros alone, the filter as published, and our filter once the loop is
    closed on the scale factor that nobody declared. Says what the noise of the part allows.
    """
    from pyimu.files import check_folder
    from pyimu.model.part_file import part as find_part
    from pyimu.rover.table6 import rover_tests

    check_told(as_json, quiet)
    check_folder(out)
    with progress("simulating the rover") as say:
        found = rover_tests(find_part(part), range(1, seeds + 1), say=say)
        say("drawing the report")
        page = found.write(out)
    data = text_of(out / "report.json")
    tell(found.report, data, [f"report: {page}"], as_json=as_json, quiet=quiet)


def plan_command(
    part: PartName,
    wanted: Annotated[
        list[str],
        typer.Option(
            "--for",
            metavar="EFFECT",
            help="Effect to show, as docs/effects.md names it; several by blanks or commas, or "
            "given again.",
            show_default=False,
            autocompletion=complete_effect,
        ),
    ],
    further: Annotated[
        list[str] | None,
        # A blank ends the value of an option: what follows it are arguments.
        typer.Argument(
            metavar="EFFECT",
            help="Further effects, behind that of --for.",
            autocompletion=complete_effect,
        ),
    ] = None,
    sensor: Annotated[
        str | None,
        option(
            "--sensor",
            "gyro or accel; else the first that has the effects.",
            one_of("plan --sensor"),
        ),
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
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu plan mpu6050 --for g_sensitivity --out out/plan

    Of rest, six positions, a rate table, a turn by hand, a drive, a shaker and a climatic chamber,
    the shortest set of motions that shows the effects of a part that are asked for, with the
    standard error that pyimu close would report of each coefficient against a reference without
    noise. The size of an effect is what the part declares, or else a typical one. Writes a page,
    the same as data, and the motion as a recording.
    """
    from pyimu.files import check_folder
    from pyimu.identification.plan.plan import CHOSEN, plan

    check_told(as_json, quiet)
    check_folder(out)
    add_effects(effects)
    texts = [*wanted, *(further or ())]
    names = [name.strip() for text in texts for name in text.split(",") if name.strip()]
    with progress("reading") as say:
        planned = plan(part, names, sensor, within or (), sigmas, say)
        page = planned.write(out, lambda text, share: say(text, CHOSEN + (1 - CHOSEN) * share))
    files = ", ".join(str(out / name) for name in planned.files()[: len(planned.logs)])
    lines = [f"page: {page}{f', motion: {files}' if files else ''}"]
    tell(planned.report, text_of(out / "plan.json"), lines, as_json=as_json, quiet=quiet)


Units = Annotated[
    str,
    typer.Option(
        "--fmu",
        help="Which, separated by commas: sensor, ukf, hidalgo2012, heading, rover, low-pass, ins.",
        autocompletion=some_of("--fmu"),
    ),
]
Forms = Annotated[
    str,
    typer.Option(
        "--fmi",
        help="Which forms, separated by commas: 2, 3, block (FMI 3, many samples a step).",
        autocompletion=some_of("--fmi"),
    ),
]
Platform = Annotated[
    str,
    option(
        "--platform",
        "host, or with the package ziglang all, or one by name.",
        one_of("--platform"),
    ),
]
Specimen = Annotated[
    int | None,
    typer.Option(
        "--specimen",
        metavar="SEED",
        help="Draw one specimen from the part's tolerances; the sensor starts at its values.",
    ),
]
Drive = Annotated[
    str | None,
    typer.Option(
        "--ssp",
        metavar="DRIVE",
        help="Also Rover.ssp, the system of drive, sensor, low-pass and filter: straight, "
        "obstacle, ackermann, turn_on_spot or free.",
        show_default=False,
        autocompletion=one_of("--ssp"),
    ),
]


def build(
    part: PartName,
    out: Out = Path("out/fmus"),
    fmu: Units = "sensor,ukf",
    fmi: Forms = "2,3,block",
    platform: Platform = "host",
    specimen: Specimen = None,
    effects: Effects = None,
    as_json: Json = False,
    quiet: Quiet = False,
    ssp: Drive = None,
) -> None:
    """Example: pyimu build imt30 --out out/fmus

    Build the FMI co-simulation units of a part: the sensor with its errors, the attitude filter
    that goes with it, and of the system around them the true motion of a rover and a low-pass.
    With --specimen the sensor is one of the production, as its data sheet's tolerances allow
    (pyimu parts NAME shows them), and the filter still knows the data sheet alone.
    """
    from pyimu.files import json_text
    from pyimu.fmu.package import build as build_part
    from pyimu.rover.system import check_drive, write_rover

    check_told(as_json, quiet)
    chosen = _forms(fmi)
    add_effects(effects)
    wired: Form = next((form for form in FORMS.values() if form in chosen), "block")
    if ssp is not None:
        check_drive(ssp, wired)
    with progress(f"compiling {part}") as say:
        blocks = [f.strip() for f in fmu.split(",")]
        paths = build_part(part, out, blocks, chosen, platform, specimen, say)
        if ssp is not None:
            rover = write_rover(part, out, ssp, form=wired, platform=platform, specimen=specimen)
            paths.append(rover)
    names = [str(path) for path in paths]
    data = {"part": part, "specimen": specimen, "files": names}
    tell(lambda: "\n".join(names), lambda: json_text(data), as_json=as_json, quiet=quiet)


def _forms(fmi: str) -> list[Form]:
    """The forms of an ``--fmi``, of which several are separated by commas."""
    names = [name.strip() for name in fmi.split(",")]
    if not all(name in FORMS for name in names):
        raise UserError(f"--fmi {fmi}: unknown; known are {', '.join(FORMS)}, separated by commas")
    return [FORMS[name] for name in names]


def modelica_command(
    part: PartName,
    out: Annotated[Path, typer.Option("--out", help="Folder for the file NAME.mo.")] = Path(
        "out/modelica"
    ),
    effects: Effects = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu modelica mypart.toml --out out/modelica

    Print a part as a Modelica class: a package with the blocks Gyroscope, Accelerometer and Imu,
    which need the library PyImu (the folder modelica/PyImu of the source) and give the samples of
    the part's co-simulation unit. Effects of your own are printed into it.
    """
    from pyimu.files import json_text
    from pyimu.modelica.export import export

    check_told(as_json, quiet)
    add_effects(effects)
    path = str(export(part, out))
    data = {"part": part, "files": [path]}
    tell(lambda: path, lambda: json_text(data), as_json=as_json, quiet=quiet)


def export_command(
    part: PartName,
    to: Annotated[
        str,
        typer.Option(
            "--to",
            help="Projects, separated by commas: kalibr, openvins, vins, gazebo, isaac, ros2, "
            "matlab, px4.",
            show_default=False,
            autocompletion=some_of("--to"),
        ),
    ],
    out: Out = Path("out/export"),
    inflate: Annotated[
        float | None,
        typer.Option(
            "--inflate",
            help="Factor on the noise; else what the project's docs recommend. 1 is as it is.",
        ),
    ] = None,
    effects: Effects = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu export mpu6050 --to kalibr,px4 --out out/export

    Write a part's noise as other projects read it: the file of each, in its units and its
    convention of a density, with the inflation that its docs recommend. A part that pyimu
    characterize or pyimu close wrote is a part as well.
    """
    from pyimu.files import check_folder, json_text

    check_told(as_json, quiet)
    check_folder(out)
    add_effects(effects)
    made = exported(part, to, out, inflate)
    files = [
        {"target": e.target, "file": str(out / e.file), "inflate": e.inflate}
        | {"reason": e.reason, "missing": e.missing or None}
        for e in made
    ]
    lines = [f"{out / e.file}: {e.said()}" for e in made]
    data = {"part": part, "files": files}
    tell(lambda: "\n".join(lines), lambda: json_text(data), as_json=as_json, quiet=quiet)


def parts(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="PART",
            help="Built-in part or a TOML file; without it all are listed.",
            show_default=False,
            autocompletion=complete_part,
        ),
    ] = None,
    new: Annotated[
        str | None,
        typer.Option(
            "--new",
            metavar="NAME",
            help="Write NAME.toml here: a part to fill in, with a place for each figure of a data "
            "sheet.",
        ),
    ] = None,
    effects: Effects = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu parts mpu6050

    List the built-in parts with their noise and range, or print one part: every coefficient, the
    figure as its data sheet quotes it, and the source. N is the root of the two-sided density; a
    dash stands where the part has no figure. Tolerances follow, from which pyimu build draws a
    specimen: uniform is anywhere within the figure, normal has it for one standard deviation.
    """
    from pyimu.files import json_text
    from pyimu.model.part_file import new_part
    from pyimu.model.part_file import part as find_part
    from pyimu.report.parts_table import as_data, detail, listing, terminal_width

    check_told(as_json, quiet)
    if new is not None:
        if name is not None:
            raise UserError(f"--new {new} beside {name}: give one of the two")
        path = new_part(new)
        said = f"{path}: take the '#' from what your data sheet has; pyimu parts {path} prints it"
        data = {"files": [str(path)]}
        tell(lambda: said, lambda: json_text(data), as_json=as_json, quiet=quiet)
        return
    add_effects(effects)
    if name is not None:
        find_part(name)  # with --quiet it is still checked
    width = terminal_width()
    tell(
        lambda: listing(width=width) if name is None else detail(name, width),
        lambda: json_text(as_data(name)),
        as_json=as_json,
        quiet=quiet,
    )


def derive_command(
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", help="Folder for derivations.txt, .tex and .md; else they are only printed."
        ),
    ] = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Example: pyimu derive --out out/derivations

    Print the symbolic results that the package computes with: kinematics, attitude error, Earth
    rate, transition matrix and process noise. Each comes as text and LaTeX, with what it was
    checked against and the difference that was found just now.

    Exit status: 0, 1 where a check failed, or 2 for bad input.
    """
    from pyimu.derivations import derive
    from pyimu.files import check_folder, json_text

    check_told(as_json, quiet)
    if out is not None:
        check_folder(out)
    with progress("deriving") as say:
        derived = derive(say)
    files = [str(path) for path in derived.write(out)] if out is not None else []
    data = derived.as_dict() | {"files": files}
    tell(
        lambda: derived.report().rstrip("\n"),
        lambda: json_text(data),
        files,
        as_json=as_json,
        quiet=quiet,
    )
    if not derived.passed:
        raise typer.Exit(1)
