"""What to type once a log was looked into."""

from __future__ import annotations

import shlex
from pathlib import Path

from pyimu.inspection.outcome import Outcome, rest_share
from pyimu.recording.quality.false_force import false_force

MAP, OUT = "map.toml", "out"
"""Names of files and folders that nobody has chosen yet."""

MOSTLY = 0.9
"""Share of a log that is at rest from which on it is one at rest, which a hand began and ended."""


def next_step(found: Outcome, written: Path | None = None) -> list[str]:
    """Lines that say what to do next, the last a command as it is typed; none where the problem is
    one of the file, and says so.

    ``written`` is the column map that was written for the log. A log in several files that nobody
    gave as a folder takes one.
    """
    if found.problem and found.kind != "guessed":
        return []
    right = false_force(found.findings) is None
    if found.readable and right and (len(found.given) == 1 or found.given_map is not None):
        given = [] if found.given_map is None else ["--columns", str(found.given_map)]
        return ["next:", f"  {_use(found, given)}"]
    file = str(written or MAP)
    said = ["next:"]
    if written is None:
        said.append(f"  {_typed('inspect', *map(str, found.given), '--write-map', file)}")
    change = "make the choices in it" if found.problem or _asked(found) else "look it over"
    said.append(f"  # then {change}, and")
    if found.problem:
        said.append(f"  {_typed('inspect', found.log, '--columns', file)}")
    else:
        option = "--reference-columns" if _is_reference(found) else "--columns"
        said.append(f"  {_use(found, [option, file])}")
    return said


def _asked(found: Outcome) -> bool:
    """Whether something of the log is to be chosen that its map leaves open."""
    return any(p.open_questions or p.timeless for p in found.proposals)


def _is_reference(found: Outcome) -> bool:
    return bool(found.proposals) and found.proposals[0].holds == "reference"


def _use(found: Outcome, how: list[str]) -> str:
    """The command for a log of its kind: at rest, a reference, with one beside it, or none."""
    log = found.log
    if _is_reference(found):
        how = ["--reference-columns" if word == "--columns" else word for word in how]
        return _typed("close", "LOG", "--reference", log, *how, "--out", OUT)
    groups = {} if found.recording is None else found.recording.groups
    if found.still:
        return _typed("characterize", log, *how, "--out", OUT)
    if any(group.startswith("ref_") for group in groups):
        return _typed("close", log, *how, "--out", OUT)
    if found.recording is not None and rest_share(found.recording, found.rests) >= MOSTLY:
        return _typed("characterize", log, *how, "--out", OUT)
    whole = {"gyro", "accel"} <= set(groups)
    command = _typed("attitude" if whole else "characterize", log, *how, "--out", OUT)
    return f"{command}    # or, with a reference of its motion: pyimu close ... --reference FILE"


def _typed(*words: str) -> str:
    return " ".join(["pyimu", *map(shlex.quote, words)])
