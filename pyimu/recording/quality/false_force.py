"""Forces whose gravity is that of another unit than their header states."""

from __future__ import annotations

from collections.abc import Iterable

from pyimu.errors import Finding, UserError
from pyimu.recording.quality.inspect import force_findings
from pyimu.recording.recording import Recording
from pyimu.units import convert

FALSE_FORCE = ("force_in_g", "force_unit")
"""Kinds of findings that say so."""

SAME = 0.1
"""Part by which a force that is gravity may differ from it."""


def false_force(findings: Iterable[Finding]) -> Finding | None:
    """The finding that says so, None where there is none."""
    return next((f for f in findings if f.kind in FALSE_FORCE), None)


def what_is_false(finding: Finding) -> str:
    """Which columns it concerns, and what would be right."""
    stated, right = finding.detail["stated"], finding.detail["as"]
    size = float(convert(finding.detail["magnitude"], "m/s^2", stated))
    return (
        f"accel_x, accel_y, accel_z show a gravity of {size:.3g} {stated}, as their header says, "
        f"so they are in {right}: write accel_x [{right}] and so on in the header, or map them "
        "there with --columns"
    )


def check_force(recording: Recording, gravity: float | None = None) -> None:
    """Raise UserError for a recording whose forces are in another unit than is stated.

    ``gravity`` in m/s^2 is that of the place, where it is known to be another than the Earth's.
    """
    found = false_force(force_findings(recording))
    if found is None:
        return
    if gravity is not None and abs(found.detail["magnitude"] / gravity - 1) < SAME:
        return
    raise UserError(f"{recording.name}: {what_is_false(found)}")
