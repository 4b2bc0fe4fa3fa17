"""What is said of rests: what was taken for one, what was not, and what contradicts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pyimu.errors import Finding
from pyimu.ins.creeps import CREEP
from pyimu.ins.outcome import Outcome
from pyimu.report.numbers import counted, number, quantity

SHOWN = 5
"""So many rests that contradict the estimate are named at most."""

FIXES = ("position_fixes", "velocity_fixes")
"""Kinds of the findings about measured positions and velocities."""

STEADY = (
    (
        "steady_turn",
        "turned steadily",
        " to the accelerometer, but the gyro was off its bias, so it was taken for a turn",
    ),
    (
        "steady_drive",
        "was driven at a constant speed",
        ", but a speed came before it and went after it",
    ),
)
"""Kinds of finding that look like a rest: what the sensor did, and how that was told."""


def of_kind(a: Outcome, kind: str) -> Iterator[Finding]:
    """What was found of a kind."""
    return (f for f in a.findings if f.kind == kind)


def steady(a: Outcome) -> Iterator[str]:
    """What looked like a rest and was told to be none by the samples."""
    for kind, what, why in STEADY:
        for said in _longest([f.detail for f in of_kind(a, kind)]):
            yield f"The sensor {what}, {said}: that looks like a rest{why}"


def _longest(stretches: list[dict[str, Any]]) -> Iterator[str]:
    """How many stretches there are, and the longest; nothing of none."""
    if stretches:
        longest = max(stretches, key=lambda d: d["seconds"])
        yield (
            f"{counted(len(stretches), 'time')}, the longest at {longest['first']:.6g} s for "
            f"{quantity(longest['seconds'], 's')}"
        )


def in_doubt(a: Outcome) -> Iterator[str]:
    """That rests and drives may be the other way round."""
    for f in of_kind(a, "rests_or_drives"):
        yield (
            f"{f.count} stretches at a constant speed are as alike as the rests: a log that "
            f"begins {'at rest' if not a.still[0] else 'in a drive'} would show the same, with "
            "rests and drives the other way round, and the path would be another; " + _would_tell(a)
        )


def unsure(a: Outcome) -> Iterator[str]:
    """That a speed seems to be left at rests."""
    for f in of_kind(a, "unsure_rests"):
        yield (
            f"At {counted(f.count, 'rest')}, the first at {f.detail['first']:.6g} s, a speed "
            "is left by what came before: it or the rest before may be a push too gentle to be "
            f"seen, and the path further off than its standard deviation; {_would_tell(a)}"
        )


def creeps(a: Outcome) -> Iterator[str]:
    """That a body creeps, and what its rests may hide."""
    for f in of_kind(a, "creeps"):
        yield (
            f"The body creeps {counted(f.count, 'time')}, the first at "
            f"{f.detail['first']:.6g} s, at less than {quantity(CREEP, 'm/s')}: slower creeps "
            "look like a rest, and the standard deviations allow for "
            f"{quantity(f.detail['hides'], 'm/s', 2)} in each; {_would_tell(a)}"
        )


def _would_tell(a: Outcome) -> str:
    """What tells rests from drives that the log has not."""
    if a.fixes is None and a.recording.speed is None:
        return "a column stationary, a speed or positions would tell"
    return "a column stationary would tell, which what else the log measures does not"


def on_a_foot(a: Outcome) -> Iterator[str]:
    """That a log is that of a foot, where nobody said so."""
    for f in of_kind(a, "on_a_foot"):
        yield (
            f"This looks like a sensor on a foot, by {counted(f.count, 'step')}: the velocity "
            "of its stances was taken for 0, as --zupt foot does; --zupt live, declared and "
            "off do not"
        )


WITNESSES = {
    "position": "The measured position moves",
    "velocity": "By the measured velocity the body moves",
    "speed": "By the measured speed the body moves",
    "reference": "The reference moves",
}
"""What a witness of a rest says, by its name."""


def witnessed(a: Outcome) -> Iterator[str]:
    """What positions, speeds and references say of rests: those that were none, and those that
    the path was made by all the same.
    """
    for f in a.findings:
        if f.kind == "rest_denied":
            one = f.count == 1
            what = "stretch that looks" if one else "stretches that look"
            yield (
                f"{WITNESSES[f.column]} during {f.count} {what} like rest to gyro and "
                f"accelerometer (the first at {f.detail['first']:.6g} s, "
                f"{quantity(f.detail['seconds'], 's')} in all): "
                f"{'it was taken for a drive' if one else 'they were taken for drives'}"
                + (
                    ". Without a reference in the log they would count as rests, and the path be "
                    "another"
                    if f.column == "reference"
                    else ""
                )
            )
        if f.kind == "rest_moves":
            yield (
                f"{WITNESSES[f.column]} during {counted(f.count, 'rest')}, by up to "
                f"{number(f.detail['largest'])} m (the first at {f.detail['first']:.6g} s, "
                f"{quantity(f.detail['seconds'], 's')} in all): these are none"
                + (
                    ", whatever the column stationary says"
                    if a.declares_rests
                    else ", as a drive at constant speed looks like a rest; a column stationary or "
                    "--zupt off leaves them out"
                )
            )


def wrong_rest(a: Outcome) -> str:
    """What may be wrong where zero velocities contradict the estimate."""
    if any(f.kind in FIXES and f.count for f in a.findings):
        return ""  # those that are wrong may have made it
    where = _contradicting(a)
    if a.declares_rests:
        return f". The column stationary may declare a rest that is none{where}"
    return (
        ". A drive at constant speed looks like a rest; a column stationary would tell the two "
        f"apart{where}"
    )


def _contradicting(a: Outcome) -> str:
    """Which rests contradict the drives before them, and by how much."""
    wrong = a.contradicting_stops
    if not wrong:
        return ""
    listed = ", ".join(f"{at:.6g} s by {number(off, 2)}" for at, off in wrong[:SHOWN])
    more = " and more" if len(wrong) > SHOWN else ""
    of = f"{len(wrong)} of {counted(len(a.later_stops), 'rest')}"
    return (
        f". {of} {'contradicts' if len(wrong) == 1 else 'contradict'} the drive before (at "
        f"{listed} standard deviations of the velocity{more}): one of these rests or the one "
        "before it is none, or the sensors are worse than is claimed"
    )
