"""The command line: each command a thin layer over the function of the same name."""

from __future__ import annotations

import gc
import os
import re
import sys
import warnings
from collections.abc import Callable
from io import TextIOWrapper
from typing import Annotated

import typer

from pyimu.cli.attitude import attitude_command
from pyimu.cli.bugs import said_of
from pyimu.cli.campaigns import campaign_command
from pyimu.cli.heading import heading_command
from pyimu.cli.inspect import inspect_command
from pyimu.cli.interrupt import Interrupts, ignore_at_exit
from pyimu.cli.logs import characterize_command, close_command, demo
from pyimu.cli.memory import keep_freed
from pyimu.cli.models import (
    build,
    derive_command,
    export_command,
    modelica_command,
    parts,
    plan_command,
    rover_command,
)
from pyimu.cli.navigation import navigate_command
from pyimu.errors import UserError, printable
from pyimu.files.held import held

# The matrices here are small: BLAS threads would wait for each other longer than they compute.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

app = typer.Typer(
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help=(
        "Example: pyimu demo\n\nMEMS inertial sensors, from a measured log to FMI co-simulation "
        "units and back. Exit status: 0, 2 for bad input, 130 if broken off; pyimu close "
        "--exit-code has one for each verdict, pyimu characterize --exit-code one for a log that "
        "moves; pyimu inspect ends with 1 where a log cannot be read as it is."
    ),
)

COLLECTED = (50_000, 20, 20)
"""How often objects are looked through for circles: of what the libraries make when they load there
are half a million, which stay; with Python's own numbers a tenth of a command's time went there."""

INTERRUPTED = 130
"""Exit status of a run that was broken off from the keyboard."""


def main() -> None:
    """Entry point of the command line.

    An error that the user can mend ends with one line on stderr and exit status 2.
    """
    if isinstance(sys.stdout, TextIOWrapper):  # it may not know every letter, as on Windows
        sys.stdout.reconfigure(errors="backslashreplace")  # as stderr does by itself
    warnings.filterwarnings("ignore", append=True)  # lines of libraries; -W and others go first
    gc.set_threshold(*COLLECTED)
    keep_freed()
    interrupts = Interrupts()
    try:
        with interrupts, held.holding():
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
            said = error.format_message()
            said += _with_argument(said)
            code = _refuse(f"{said} ({command} --help shows what is possible){_as_one_log(said)}")
        else:
            code = _refuse(*said_of(error))
    ignore_at_exit()
    gc.freeze()  # else the interpreter, as it ends, looks through everything three times more
    sys.exit(code if isinstance(code, int) else 0)


def _with_argument(said: str) -> str:
    """What an option is for that stands at the end without its value, else nothing."""
    asked = re.match(r"Option '(\S+)' requires an argument", said)
    command = getattr(typer.main.get_command(app), "commands", {}).get(" ".join(sys.argv[1:2]))
    if asked is None or command is None:
        return ""
    text = next((p.help for p in command.params if asked[1] in p.opts), None)
    return f" Write pyimu {command.name} ... {asked[1]} and its value: {text}" if text else ""


def _as_one_log(said: str) -> str:
    """How files that were given to a command for one log are one, else nothing."""
    extra = said.partition("unexpected extra argument")[2]
    if not any(os.path.isfile(word) for word in re.findall(r"[^()\s]+", extra)):
        return ""
    return (
        "; files of one log are one by a map: pyimu inspect FILE FILE --write-map map.toml, then "
        "the first of them with --columns map.toml"
    )


def _interrupted() -> int:
    return _refuse("interrupted; earlier results are as they were", INTERRUPTED)


def _refuse(text: str, code: int = 2) -> int:
    print(f"pyimu: {printable(' '.join(text.split()))}", file=sys.stderr)
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


def _add(name: str, command: Callable, text: str) -> None:
    app.command(name, short_help=text)(command)


_add("demo", demo, "The whole loop on a simulated recording.")
_add("inspect", inspect_command, "What is in a log, and the column map to read it by.")
_add(
    "characterize",
    characterize_command,
    "Noise, temperature effect and quality of a sensor at rest.",
)
_add("close", close_command, "Find what a sensor's model lacks to explain measured logs.")
_add("attitude", attitude_command, "The attitude filter over a log, with its page.")
_add("heading", heading_command, "Heading of an indoor robot from one gyro, by several methods.")
_add("navigate", navigate_command, "The path of a robot by its inertial unit alone.")
_add("plan", plan_command, "The motion that would show an effect of a part, and how well.")
_add("rover", rover_command, "The paper's four test drives of a rover beside its table 6.")
_add("build", build, "Build the co-simulation units of a part.")
_add("modelica", modelica_command, "A part as a Modelica class.")
_add("export", export_command, "A part as Kalibr, Gazebo, PX4 and others read it.")
_add("parts", parts, "The built-in parts, or one part with the source of each figure.")
_add(
    "campaign",
    campaign_command,
    "Many varied drives of a rover, on Dask: how large errors are, and why.",
)
_add("derive", derive_command, "The symbolic results, and what each was checked against.")
