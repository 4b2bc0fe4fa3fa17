"""The logs that a command is given, each under a name of its own and with its reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pyimu.errors import UserError
from pyimu.identification.logs.trials import SHORTEST, has_reference
from pyimu.identification.reference.gravity import few
from pyimu.recording.folders import truth_beside
from pyimu.recording.log import Given, is_one, recording_of
from pyimu.recording.names import distinct_names
from pyimu.recording.recording import Recording
from pyimu.recording.reference.course import has_course
from pyimu.recording.reference.file import with_references
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.rest import is_at_rest

SLOWEST = 1.0
"""s; from row to row of a log that moves: a hand or a vehicle turns to and fro in less."""


def references_of(given: Sequence[Given] | Given | None) -> list[Recording]:
    return [recording_of(r, "reference") for r in _each(given)]


def logs_of(
    recordings: Sequence[Given] | Given,
    holdout: Sequence[Given] | Given | None,
    references: list[Recording],
) -> tuple[list[Recording], list[Recording]]:
    """The logs to fit and to judge by, with references of their own where there are any, under
    names that tell them apart. Raises UserError for none, and for one that says nothing.
    """
    fitted = [_read(r) for r in _each(recordings)]
    if not fitted:
        raise UserError("no log given: name at least one recording")
    held = [_read(r) for r in _each(holdout)]
    together = with_references([*fitted, *held], references)
    named = [replace(r, name=n) for r, n in zip(together, distinct_names(together), strict=True)]
    return named[: len(fitted)], named[len(fitted) :]


def _each(given: Sequence[Given] | Given | None) -> Sequence[Given]:
    return [] if given is None else [given] if is_one(given) else given


def _read(log: Given) -> Recording:
    recording = recording_of(log)
    if len(recording.time) < SHORTEST:
        raise UserError(
            f"{recording.name}: too short to say anything: {len(recording.time)} rows, at least "
            f"{SHORTEST} are needed"
        )
    turning = recording.ref_rate is not None or recording.ref_q is not None
    if turning and recording.sample_period > SLOWEST and not is_at_rest(recording):
        raise UserError(
            f"{recording.name}: a row every {recording.sample_period:.3g} s, and the sensor moves: "
            f"at most {SLOWEST:g} s would follow it; if its times are in ms, the header must say "
            "time [ms]"
        )
    return recording


def nothing_to_compare(logs: list[Recording]) -> str:
    """What is said of logs of which no sensor has a reference, and what they would need."""
    if all(has_course(r) and reference_rate(r).kind == "none" for r in logs):
        return (
            f"{logs[0].name}: nothing to compare: its positions never move so fast that they have "
            "a course, or it shows no turn (one on the spot has no course); give a log that drives "
            "curves, or leave the positions out where it stands still"
        )
    if any(has_reference(r) for r in logs):
        return (
            f"{logs[0].name}: too short to say anything: fewer than {SHORTEST} rows that sensor "
            "and reference both cover"
        )
    return (
        f"{logs[0].name}: nothing to compare: the log has no reference (ref_rate, ref_q, "
        "ref_heading, ref_force, positions or velocities) and moves; a log without reference must "
        f"stand still, or rest in several positions (here {few(logs)}){_beside(logs[0])}"
    )


def _beside(log: Recording) -> str:
    """Where its reference may be."""
    truth = truth_beside(log.path)
    if truth is None:
        return "; a reference in a file of its own is given by --reference FILE"
    return f"; the ground truth is beside it: --reference {truth}"
