"""Findings about the logs, each once and with the log that it is about."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pyimu.errors import Finding
from pyimu.identification.fit.trial import Trial


def about(name: str, finding: Finding) -> Finding:
    """A finding that says which log it is about."""
    return replace(finding, detail={"recording": name, **finding.detail})


def of_trials(trials: Sequence[Trial]) -> list[Finding]:
    """What making the trials found, each kind once a column of a log."""
    found = {(t.name, f.kind, f.column): about(t.name, f) for t in trials for f in t.findings}
    return list(found.values())


def joined_with(quality: list[Finding], more: list[Finding]) -> list[Finding]:
    """Findings and ``more``, which say better what is said of the same column already."""

    def column(f: Finding) -> tuple[str, str, str]:
        return f.detail["recording"], f.kind, f.column

    better = {column(f) for f in more}
    # Two sensors of one log may say the same of its reference.
    once = [f for i, f in enumerate(more) if f not in more[:i]]
    return [f for f in quality if column(f) not in better] + once
