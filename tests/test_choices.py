"""What the shell completes: the names that options take, as what defines them has it."""

from __future__ import annotations

import subprocess
import sys

import click
import pytest
import typer.main

from pyimu.attitude.filters import FILTERS
from pyimu.cli import app
from pyimu.cli.choices import NAMES, complete_effect, some_of
from pyimu.export import TARGETS
from pyimu.fmu.build import FORMS, PLATFORMS
from pyimu.fmu.package import BLOCKS
from pyimu.heading.run import METHODS as OF_HEADING
from pyimu.ins.run import METHODS as OF_POSITION
from pyimu.ins.stops import ZUPT
from pyimu.model.kinds import KINDS
from pyimu.plant.bodies import BODIES
from pyimu.plant.rover_variables import DRIVES
from pyimu.rover.campaign.faults import FAULTS
from pyimu.rover.campaign.motion import DRIVES as OF_CAMPAIGNS

DEFINED = {
    "--to": TARGETS,
    "--fmu": BLOCKS,
    "--fmi": map(str, FORMS),
    "--platform": ("host", "all", *PLATFORMS),
    "--ssp": DRIVES,
    "plan --sensor": KINDS,
    "--settings": FILTERS,
    "navigate --method": (*OF_POSITION, "all"),
    "--zupt": ZUPT,
    "heading --method": (*OF_HEADING, "all"),
    "--drive": OF_CAMPAIGNS,
    "--faults": FAULTS,
    "--body": BODIES,
}


def test_names_are_those_of_the_definitions():
    assert {k: set(v) for k, v in DEFINED.items()} == {
        k: set(v) for k, v in NAMES.items() if k != "heading --reference"
    }


def test_the_last_of_several_is_completed():
    complete = some_of("--to")
    assert complete("kalibr,ga") == ["kalibr,gazebo"]
    assert "px4,px4" not in complete("px4,") and "px4,vins" in complete("px4,")
    assert complete_effect("g_sensitivity,g2") == ["g_sensitivity,g2_sensitivity"]


def options():
    """Commands and those of their options whose help lists names."""
    group = typer.main.get_command(app)
    for command in group.commands.values():
        for parameter in command.params:
            own = {*parameter.opts, *(f"{command.name} {name}" for name in parameter.opts)}
            if own & {*NAMES, "--part", "--for", "--export"}:
                yield command, parameter


@pytest.mark.parametrize(
    "command, parameter", list(options()), ids=lambda v: v.name if v.name else str(v)
)
def test_every_such_option_is_completed(command, parameter):
    assert parameter.shell_complete(click.Context(command), ""), parameter.opts


def test_the_shell_asks_for_them():
    done = subprocess.run(
        [sys.executable, "-m", "pyimu"],
        env={
            "_PYIMU_COMPLETE": "complete_bash",
            "COMP_WORDS": "pyimu navigate --zupt ",
            "COMP_CWORD": "3",
        },
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.stdout.split() == list(NAMES["--zupt"])
