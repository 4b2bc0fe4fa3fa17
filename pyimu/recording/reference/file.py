"""A reference in a file of its own, with a rate and a clock of its own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from pyimu.errors import UserError
from pyimu.recording.columns import GROUPS
from pyimu.recording.recording import Recording, filled
from pyimu.recording.reference.attitude import attitude_at, within
from pyimu.recording.reference.epoch import time_apart
from pyimu.recording.reference.sampling import for_rows, through
from pyimu.recording.reference.track import Track, fresh, known_axes

TRUTHS = tuple(name for name in GROUPS if name.startswith("ref_"))
"""The groups that a reference may hold."""

DAY = 86400.0
"""s; clocks whose starts differ by more count from different epochs."""

LEAST_APART = 2.0
"""s; a clock that is off by less is set by itself, and no reason for what no reference shows."""


def with_reference(log: Recording, reference: Recording) -> Recording:
    """The log with the reference of another recording in place of its own.

    ``reference`` keeps its rate and its clock, which may be some seconds off: its samples are used
    as they are. Raises UserError where it holds no reference, or where the two do not overlap.
    """
    given = [g for g in TRUTHS if getattr(reference, g) is not None]
    if not given:
        raise UserError(
            f"{reference.name}: no reference in it, expected columns of {', '.join(TRUTHS)}"
        )
    moved = replace(
        reference,
        time=reference.time + (_origin(reference) - _origin(log)),
        **{g: None for g in GROUPS if g not in (*TRUTHS, "latitude")},
    )
    _check_overlap(log, moved)
    return replace(at_log(log, moved), reference_apart=True)


def at_log(log: Recording, reference: Recording) -> Recording:
    """The log with a ``reference`` on the same clock, at its own times, in place of its own."""
    seen = {g: None for g in TRUTHS} | {"reference": reference}
    if reference.ref_q is not None:
        seen["ref_q"] = attitude_at(reference, log.time)
    for group in ("ref_rate", "ref_force"):
        values = getattr(reference, group)
        if values is not None:
            seen[group] = _interpolated(reference.time, values, log)
    if log.latitude is None and reference.latitude is not None:
        known = filled(reference.time, reference.latitude)
        seen["latitude"] = np.interp(log.time, reference.time, known)
    return replace(log, **seen)


def with_references(logs: Sequence[Recording], references: Sequence[Recording]) -> list[Recording]:
    """Each of the first logs with its reference; the others as they are.

    Raises UserError for more references than logs.
    """
    if len(references) > len(logs):
        raise UserError(
            f"{len(references)} references for {len(logs)} logs: give one for each log, in order"
        )
    paired = [with_reference(a, b) for a, b in zip(logs, references, strict=False)]
    return [*paired, *logs[len(references) :]]


def _origin(recording: Recording) -> float:
    """s; what lies between the times of a recording and those of its file (a clock of its own such
    as Unix time) and of its map.
    """
    known = {"time_origin": "origin", "time_offset": "offset"}
    return sum(float(f.detail[known[f.kind]]) for f in recording.findings if f.kind in known)


def _check_overlap(log: Recording, reference: Recording) -> None:
    first, last = log.time[[0, -1]]
    begins, ends = reference.time[[0, -1]]
    epochs = abs(begins - first) > DAY
    if not epochs and min(last, ends) > max(first, begins):
        return
    what = (
        "their clocks count from different epochs" if epochs else "log and reference do not overlap"
    )
    apart = time_apart(log, reference)
    why = "if both begin together" if apart is None else "with which the two turn alike"
    raise UserError(
        f"{reference.name} covers {_span(reference, _origin(log))} and {log.name} "
        f"{_span(log, _origin(log))}: {what}; "
        f"{_to_write(reference, first - begins if apart is None else apart)}, {why}"
    )


def other_time(logs: Iterable[Recording]) -> str:
    """By how much the clock of the first reference, in a file of its own, must be set for it to
    turn when its log does; nothing where no such time is seen, or one within ``LEAST_APART``.
    """
    for log in logs:
        apart = time_apart(log, log.reference) if log.reference_apart else None
        if apart is not None and abs(apart) > LEAST_APART:
            when = "later" if apart > 0 else "earlier"
            return (
                f"the two turn alike where the times of {log.reference.name} are "
                f"{abs(apart):.6g} s {when}: {_to_write(log.reference, apart)}"
            )
    return ""


def _to_write(reference: Recording, apart: float) -> str:
    """What to write in a reference's column map to add ``apart`` s to its times."""
    given = sum(f.detail["offset"] for f in reference.findings if f.kind == "time_offset")
    return (
        f'write time_offset = {{value = {given + apart:.12g}, unit = "s"}} in the column map of '
        f"{reference.name} (--reference-columns)"
    )


def _span(recording: Recording, origin: float) -> str:
    first, last = (f"{t + origin:.12g}" for t in recording.time[[0, -1]])
    return f"{first} to {last} s"


def _interpolated(nodes: np.ndarray, values: np.ndarray, log: Recording) -> np.ndarray:
    """Values (m, 3) at a log's rows (n,), as these can show them, by splines of fifth degree
    through what is known without gap, else NaN; an axis that nobody knows stays unknown.
    """
    out, axes = np.full((len(log), values.shape[1]), np.nan), known_axes(values)
    seen = values[:, axes]
    track = Track(nodes, fresh(seen), lambda n: np.diff(seen[n], axis=0), np.inf)
    for part in track.segments:
        rows = within(log.time, nodes[part])
        shown = for_rows(seen[part], track.period, log.sample_period)
        out[np.ix_(rows, axes)] = through(nodes[part], shown, 5)(log.time[rows])
    return out
