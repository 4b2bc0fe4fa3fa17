"""Logs with references as they were before a filter that they are behind."""

from __future__ import annotations

from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.behind import without_filter
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording


def unfiltered_logs(
    trials: tuple[list[Trial], list[Trial]],
    sensor: Sensor,
    logs: list[Recording],
    others: list[Recording],
) -> tuple[list[Recording], list[Recording]] | None:
    """``logs`` and ``others`` with references that are behind no filter; None where none was.

    ``trials`` are the gyro's of both, their references on the sensor's clock. A reference that was
    behind a filter has a finding that says so.
    """
    found = {t.name: without_filter(t, sensor) for ts in trials for t in ts}
    undo = {name: one for name, one in found.items() if one is not None}
    if not undo:
        return None
    fitted, apart = (
        [undo[r.name](r) if r.name in undo else r for r in each] for each in (logs, others)
    )
    return fitted, apart
