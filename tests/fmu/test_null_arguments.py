"""No function of a unit follows a pointer that is NULL: it says so, and the unit lives on.

Each function of the standard's header is called, in a process of its own, with NULL for one pointer
after the other (``null_calls.py``). What is NULL by right is listed here.
"""

import subprocess
import sys

import pytest
from built import built
from fmu_toy import toy
from places import CHECKOUT, same_path

CALLS = CHECKOUT / "tests" / "support" / "null_calls.py"

OK, DISCARD, ERROR = "0", "2", "3"

LIFE = {"SetDebugLogging", "EnterInitializationMode", "ExitInitializationMode"}
LIFE |= {"Terminate", "Reset", "DoStep"}

OFFERED = {
    2: LIFE
    | {"SetupExperiment", "GetFMUstate", "SetFMUstate", "FreeFMUstate"}
    | {"SerializedFMUstateSize", "SerializeFMUstate", "DeSerializeFMUstate"}
    | {f"{way}{kind}" for way in ("Get", "Set") for kind in ("Real", "Integer", "Boolean")},
    3: LIFE
    | {"GetFMUState", "SetFMUState", "FreeFMUState"}
    | {"SerializedFMUStateSize", "SerializeFMUState", "DeserializeFMUState"}
    | {f"{way}{kind}" for way in ("Get", "Set") for kind in ("Float64", "Int32", "Boolean")}
    | {"GetUInt64"},
}
"""Functions that succeed with good arguments; all others of the header say that they are not
offered. ``SetUInt64`` sets the seed, which is fixed once the unit steps."""

BY_RIGHT = {
    "FreeFMUstate FMUstate": OK,
    "FreeFMUState FMUState": OK,
    "Instantiate instanceName": "an instance",
    "InstantiateCoSimulation instanceName": "an instance",
}
"""Freeing no state is fine (FMI 2.0.4, 2.1.8; FMI 3.0, 2.2.6.4), and no name is no harm."""

OPTIONAL = ("resource", "Resource", "required", "Environment", "logMessage", "intermediateUpdate")
"""Of what a unit is made with, what it has no need of."""


def answers(path):
    """What each call was answered, and what is left to say of how the process ended."""
    done = subprocess.run(
        [sys.executable, CALLS, path], capture_output=True, text=True, check=False, env=same_path()
    )
    assert done.returncode == 0, f"{done.stdout.splitlines()[-1:]}: {done.stderr[-2000:]}"
    return dict(line.rsplit(" ", 1) for line in done.stdout.splitlines())


def wanted(call, version, form):
    """What the function must answer, by the lists above."""
    name, _, argument = call.partition(" ")
    if name == "FreeInstance":
        return "None"  # it answers nothing
    if name in ("GetVersion", "GetTypesPlatform"):
        return "an instance"  # a text, that is
    if name.startswith("Instantiate"):
        made = name in ("Instantiate", "InstantiateCoSimulation") and (
            argument == "-" or any(word in argument for word in OPTIONAL)
        )
        return BY_RIGHT.get(call, "an instance" if made else "None")
    if argument != "-":
        return BY_RIGHT.get(call, ERROR)
    if name.endswith("Status") and version == 2:
        return DISCARD
    return OK if name in OFFERED[version] | in_blocks(form) else ERROR


def in_blocks(form):
    return {"EnterConfigurationMode", "ExitConfigurationMode"} if form == "block" else set()


@pytest.mark.parametrize("form", [2, 3, "block"])
def test_null_is_refused_by_every_function(form, tmp_path_factory):
    version = 2 if form == 2 else 3
    found = answers(built(toy(), tmp_path_factory)[form])
    assert len(found) == (138 if version == 2 else 291)  # calls, by the standards' headers
    said = {c: a if a in (OK, DISCARD, ERROR, "None") else "an instance" for c, a in found.items()}
    want = {call: wanted(call, version, form) for call in found}
    wrong = {call: (said[call], want[call]) for call in found if said[call] != want[call]}
    assert not wrong
