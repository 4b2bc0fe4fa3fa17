"""Logs with references behind the play of a gear that they were taken before, and before a filter
that they are behind.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.trials import accel_trial
from pyimu.identification.reference.adapts import without_adapting
from pyimu.identification.reference.behind import Undo, without_filter
from pyimu.identification.reference.behind_places import without_filter_of_places
from pyimu.identification.reference.place import is_differentiated
from pyimu.identification.reference.play import unplayed
from pyimu.identification.reference.resized import resized
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.reference.force import has_places

Logs = tuple[list[Recording], list[Recording]]
"""Those to fit, and those to judge by."""


def unplayed_logs(trials: tuple[list[Trial], list[Trial]], logs: Logs) -> Logs | None:
    """``logs`` with references behind the play of a gear; None where none was taken before one.

    ``trials`` are the gyro's, as of ``unfiltered_logs``.
    """
    return _undone(trials, unplayed, logs)


def unfiltered_logs(
    trials: tuple[list[Trial], list[Trial]],
    logs: Logs,
    sensor: Sensor,
    made: Callable[..., tuple[list[Trial], list[Trial]]],
) -> Logs | None:
    """``logs`` with references that are behind no filter; None where none was.

    ``trials`` are the gyro's of both, their references on the sensor's clock, as they are ``made``
    of logs. A reference that was behind a filter has a finding that says so.
    """
    found = _undone(trials, lambda t: without_adapting(t) or without_filter(t, sensor), logs)
    if found is None:
        return None
    sizes = {t.name: resized(t) for ts in made(*found) for t in ts}
    return tuple(
        [undo(was) if (undo := sizes.get(r.name)) else r for was, r in zip(*both, strict=True)]
        for both in zip(logs, found, strict=True)
    )


def _undone(
    trials: tuple[list[Trial], list[Trial]], find: Callable[[Trial], Undo | None], logs: Logs
) -> Logs | None:
    found = {t.name: find(t) for ts in trials for t in ts}
    undo = {name: one for name, one in found.items() if one is not None}
    if not undo:
        return None
    fitted, apart = ([undo[r.name](r) if r.name in undo else r for r in each] for each in logs)
    return fitted, apart


def with_sharp_places(
    log: Recording, clocks: Mapping[str, Clock], latitude: float | None
) -> Recording:
    """A log with places that are behind no filter; as it is where they were behind none.

    ``clocks`` are those that the gyro shows, by log.
    """
    if log.accel is None or log.ref_force is not None or not has_places(log):
        return log
    trial = accel_trial(log, False, latitude)
    if trial is None or not is_differentiated(trial):
        return log
    undo = without_filter_of_places(trial, log, clocks.get(log.name))
    return log if undo is None else undo(log)
