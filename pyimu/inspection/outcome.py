"""What was seen in a log, as values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.columns import ANGLES, GROUPS, column_names
from pyimu.recording.guess.guessed import Guess, Proposal
from pyimu.recording.recording import Recording
from pyimu.report.findings import grouped
from pyimu.report.numbers import number, quantity

KINDS = {
    "own": "the header names columns and units as recordings do",
    "map": "the column map says what the columns are",
    "known": "recognised",
    "guessed": "guessed: look it over",
}
"""How it is known what the columns are."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """A log that was looked into.

    ``kind`` is one of ``KINDS``, ``format`` what was recognised; ``proposals`` hold what is known
    of the columns, ``column_map`` the same as text of a column map. ``problem`` says why the log
    could not be read, else there is a ``recording`` with ``findings``, ``rests`` (rows start,
    stop) and whether it is ``still`` throughout. ``given`` are the files that were asked for, and
    ``given_map`` the column map with them.
    """

    path: Path
    kind: str
    format: str
    proposals: Sequence[Proposal]
    column_map: str
    problem: str = ""
    recording: Recording | None = None
    findings: tuple[Finding, ...] = ()
    rests: Sequence[tuple[int, int]] = ()
    still: bool = False
    given: tuple[Path, ...] = ()
    given_map: Path | None = None

    @property
    def log(self) -> str:
        """What the other commands take for the log: its folder, or that file of it which its map is
        for.
        """
        if len(self.given) == 1:
            return str(self.given[0])
        return str(next((p.path for p in self.proposals if "gyro" in p.groups), self.path))

    @property
    def readable(self) -> bool:
        """Whether the other commands read the log so, without a column map that is yet to come."""
        return not self.problem and self.kind != "guessed"

    @cached_property
    def columns(self) -> list[tuple[str, str, str, str, str]]:
        """A row for each column of the file that has a meaning, by group.

        (columns in the file, meaning, unit, numbers, how it is known).
        """
        rows: dict[tuple[str, str], list[Guess]] = {}
        for proposal in self.proposals:
            for guess in proposal.guesses:
                rows.setdefault((proposal.path.name, guess.group), []).append(guess)
        return [
            (
                ", ".join(guess.cell for guess in guesses),
                group,
                _units(guesses),
                "" if guesses[0].target in ANGLES else self._range(group),
                guesses[0].why,
            )
            for (_, group), guesses in rows.items()
        ]

    def _range(self, group: str) -> str:
        values = None if self.recording is None else getattr(self.recording, group, None)
        if values is None or group == "time":
            return ""
        seen = values[np.isfinite(values)]
        if not len(seen):
            return "no numbers"
        unit = GROUPS[group].unit
        ends = float(seen.min()), float(seen.max())
        # A quaternion is no share of something.
        return " to ".join(number(v) if unit == "1" else quantity(v, unit) for v in ends)

    def lines(self) -> Iterator[str]:
        """What is to be said of the log as a whole."""
        yield f"columns: {self.format or KINDS[self.kind]}"
        for cells, group, unit, numbers, why in self.columns:
            span = f", {numbers}" if numbers else ""
            yield f"  {group} [{unit}] from {cells}{span}" + (
                "" if why == "declared" else f"; {why}"
            )
        for proposal in self.proposals:
            yield from (f"  or: {note}" for note in proposal.notes)
        if any(proposal.offers for proposal in self.proposals):
            yield "  lines to read what is left out stand in the map (--write-map), with a # before"
        if self.recording is not None:
            yield from _of_recording(self.recording, self.rests, self.still)
            for said in grouped(self.findings):
                yield f"  {said.line}"
                yield from [f"    {said.meaning}"] * bool(said.meaning)

    def as_dict(self) -> dict[str, Any]:
        """All of it as plain types, for JSON, in SI."""
        recording = self.recording
        return {
            "file": str(self.path),
            "columns_known_by": self.kind,
            "format": self.format or None,
            "columns": [
                {"column": g.cell, "meaning": g.target, "unit": g.unit, "why": g.why}
                | ({} if g.value is None else {"size_of_a_count": g.value})
                for p in self.proposals
                for g in p.guesses
            ],
            "open_questions": [q for p in self.proposals for q in p.open_questions],
            "problem": self.problem or None,
            "samples": None if recording is None else len(recording),
            "sample_rate": None if recording is None else recording.sample_rate,
            "duration": None if recording is None else float(np.ptp(recording.time)),
            "segments": None if recording is None else len(recording.segments),
            "at_rest": self.still,
            "rests": []
            if recording is None
            else [[float(recording.time[a]), float(recording.time[b - 1])] for a, b in self.rests],
            "findings": [f.as_dict() for f in self.findings],
        }


def _units(guesses: Sequence[Guess]) -> str:
    """The unit of the columns of a group, of each where they differ."""
    units = [_unit(guess) for guess in guesses]
    return ", ".join(units if len(set(units)) > 1 else units[:1])


def _unit(guess: Guess) -> str:
    if guess.unit is None:
        return "?"
    return guess.unit if guess.value is None else f"count of {guess.value:.6g} {guess.unit}"


def _of_recording(
    recording: Recording, rests: Sequence[tuple[int, int]], still: bool
) -> Iterator[str]:
    """Samples, rate, span, gaps and rests."""
    span = float(np.ptp(recording.time))
    yield (
        f"{len(recording):,} samples at {recording.sample_rate:.6g} Hz over {quantity(span, 's')}, "
        f"in {len(recording.segments)} {'piece' if len(recording.segments) == 1 else 'pieces'} "
        "without gap"
    )
    groups = (f"{g} ({', '.join(column_names(g))})" for g in recording.groups)
    yield f"groups: {'; '.join(groups)}"
    if recording.gyro is None and recording.accel is None:
        return
    if still:
        yield "at rest throughout: pyimu characterize is for such a log"
        return
    share = rest_share(recording, rests)
    yield (
        f"moves; {len(rests)} {'rest' if len(rests) == 1 else 'rests'} of "
        f"{quantity(share * span, 's')} together, {100 * share:.0f} % of it"
    )


def rest_share(recording: Recording, rests: Sequence[tuple[int, int]]) -> float:
    """Share of the time of a recording that its ``rests``, ranges of rows, take."""
    total = sum(float(recording.time[b - 1] - recording.time[a]) for a, b in rests)
    span = float(np.ptp(recording.time))
    return total / span if span > 0 else 0.0
