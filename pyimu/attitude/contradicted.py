"""What of a recording its own samples contradict, and the recording without it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from pyimu.attitude.driven import speed_findings
from pyimu.attitude.headed import heading_findings
from pyimu.errors import Finding
from pyimu.recording.quality.gyro_axes import gyro_findings
from pyimu.recording.recording import Recording


def contradicted(recording: Recording) -> tuple[Finding, ...]:
    """What contradicts the gyro, or else by the gyro the speed and the headings."""
    return gyro_findings(recording) or _by_gyro(recording)


def believed(recording: Recording) -> Recording:
    """The recording without a speed and without headings that a gyro to be trusted contradicts."""
    found = _by_gyro(recording)
    return recording if not found or gyro_findings(recording) else without(recording, found)


def without(recording: Recording, found: Iterable[Finding]) -> Recording:
    """The recording without the speed and the headings that ``contradicted`` ``found`` wrong."""
    wrong = {f.column for f in found} - {"gyro"}
    return replace(recording, **dict.fromkeys(wrong)) if wrong else recording


def _by_gyro(recording: Recording) -> tuple[Finding, ...]:
    return (*speed_findings(recording), *heading_findings(recording))
