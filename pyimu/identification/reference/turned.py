"""Rate references whose axes are turned against the sensor's: a second unit that was mounted
otherwise.

No log tells such a turn from a misalignment of the whole triad. A large one is no sensor's, and
what is a turn and nothing else was made by who mounted the two.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.clock import explained_by
from pyimu.identification.reference.moving import in_own_band, moving_rows, turned_onto
from pyimu.model.kinds import OWN
from pyimu.numerics.columns import columns_at
from pyimu.recording.recording import Recording

LEAST = float(np.radians(1.0))
"""rad; below it a turn may as well be the misalignment of a coarse sensor."""

PURE = 0.2
"""Share of a turn by which what is found may differ from one: scale factors and misalignments."""


def with_mounting(trials: Sequence[Trial]) -> list[Trial]:
    """The trials, those of rates with a mounting to be found where one of them has a turn that is
    no sensor's.
    """
    angles = {t.name: _angle(t) for t in trials if _may_be_turned(t)}
    if not any(angles.values()):
        return list(trials)
    return [_mounted(t, angles[t.name]) if t.name in angles else t for t in trials]


def with_turned_force(log: Recording, trials: Sequence[Trial]) -> Recording:
    """A log whose reference of force comes from the unit that the gyro, in one of its ``trials``,
    showed to be turned, with that unit's force and rate in the sensor's axes; as it is where that
    leaves more.
    """
    trial = next((t for t in trials if t.name == log.name and _may_be_turned(t)), None)
    if trial is None or not trial.free_rotation or log.ref_force is None or log.accel is None:
        return log
    turn = turn_of(trial)[0]

    def turned(r: Recording) -> Recording:
        rate = None if r.ref_rate is None else r.ref_rate @ turn
        return r if r.ref_force is None else replace(r, ref_force=r.ref_force @ turn, ref_rate=rate)

    force = _on_time(log, trial)
    known = np.isfinite(force).all(axis=1) & np.isfinite(log.accel).all(axis=1)
    left = [(log.accel - f)[known].std(axis=0) for f in (force, force @ turn)]
    if not known.any() or np.linalg.norm(left[1]) >= np.linalg.norm(left[0]):
        return log
    other = turned(log)
    return replace(other, reference=None if log.reference is None else turned(log.reference))


def _on_time(log: Recording, trial: Trial) -> np.ndarray:
    """The force (n, 3) that a log's reference says, by the clock that the gyro showed; NaN where it
    says none.
    """
    if trial.clock is None or not trial.clock.taken_out:
        return log.ref_force
    then = log.time - trial.clock.at(log.time)
    return columns_at(then, log.time, log.ref_force, beyond=np.nan)


def with_rest_of_turn(make: Callable, turned: Collection[str]) -> Callable:
    """What makes trials as ``make`` does, with a mounting to be found where the force of a log, by
    name, was ``turned``: the gyro shows the turn as well as its motion and noise let it, and what
    that lacks is no misalignment of the accelerometer.
    """

    def made(recording: Recording, *given) -> Trial | None:
        trial = make(recording, *given)
        return replace(trial, free_rotation=True) if trial and recording.name in turned else trial

    return made


def _may_be_turned(trial: Trial) -> bool:
    return trial.reference == "rate" and len(trial.axes) == 3 and trial.reduction is None


def _mounted(trial: Trial, angle: float) -> Trial:
    found = Finding("reference_turned", trial.kind, 1, {"angle": angle})
    said = (found,) if angle else ()
    free = replace(trial, free_rotation=True, findings=(*trial.findings, *said))
    if trial.clock is None:
        return free
    return replace(free, clock=replace(trial.clock, explained=explained_by(free)))


def _angle(trial: Trial) -> float:
    """By how much the reference is turned, rad; zero where that is no turn, or a small one."""
    turn, gain = turn_of(trial)
    angle = float(Rotation.from_matrix(turn).magnitude())
    size = 2.0 * np.sqrt(2.0) * np.sin(angle / 2.0)
    pure = np.linalg.norm(gain - turn) < PURE * size
    return angle if angle > LEAST and pure else 0.0


def turn_of(trial: Trial) -> tuple[np.ndarray, np.ndarray]:
    """The rotation (3, 3) with reference @ rotation nearest to what the sensor shows, and the gain
    (3, 3) with reference @ gain nearest; none where the motion does not show all of it.
    """
    band = in_own_band(trial)
    rows = moving_rows(band)
    x, y = (in_band(band, v)[rows] for v in (trial.u[:, OWN[trial.kind]], trial.y))
    if len(x) <= 3:
        return np.eye(3), np.eye(3)
    gain, _, rank, _ = np.linalg.lstsq(x - x.mean(axis=0), y - y.mean(axis=0), rcond=1e-3)
    return (turned_onto(np.eye(3), gain), gain) if rank == 3 else (np.eye(3), np.eye(3))
