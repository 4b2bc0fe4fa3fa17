"""Logs with references as they were before a filter that they are behind."""

from __future__ import annotations

from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.lagging import without_lag
from pyimu.identification.reference.smoothed import without_filter
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

LOOKS = without_lag, without_filter
"""What looks for a filter behind a trial's reference; the later where the earlier finds none."""


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
    for look in LOOKS:
        found = {t.name: look(t, sensor) for ts in trials for t in ts}
        undo = {name: one for name, one in found.items() if one is not None}
        if undo:
            fitted, apart = (
                [undo[r.name](r) if r.name in undo else r for r in rs] for rs in (logs, others)
            )
            return fitted, apart
    return None
