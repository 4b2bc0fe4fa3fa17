"""Attitudes and positions in a world whose vertical is another axis than z, as optical systems have
it: y up. Gravity would be added along the wrong one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.error import angle_between
from pyimu.errors import Finding
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.level import UP, WAYS, uncertain
from pyimu.identification.reference.moving import LEAST_ROWS, moving_pair, turned_onto
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import attitude_at
from pyimu.recording.reference.file import at_log
from pyimu.recording.reference.force import has_places
from pyimu.recording.reference.unfiltered_places import GROUPS, SIDEWAYS
from pyimu.units import STANDARD_GRAVITY

LEVEL = {way: up for way, up in WAYS.items() if up[2] == 0.0}
"""Ways that no convention of a vehicle's has, and up (3,) in each: attitudes of north-east-down may
have positions that are east, north and up."""


def with_upright_places(log: Recording, trials: Sequence[Trial]) -> Recording:
    """A log with attitudes and positions whose world has z up; as it is where it had, or where the
    accelerometer shows no other axis. The mounting is that which the gyro's ``trials`` show.
    """
    trial = next((t for t in trials if t.name == log.name and t.reference == "attitude"), None)
    if trial is None or log.accel is None or len(trial.axes) < 3 or not has_places(log):
        return log
    source = log if log.reference is None else log.reference
    way = _way_up(log, source, trial)
    if way is None:
        return log
    turn, _ = Rotation.align_vectors(UP[None], LEVEL[way][None])
    seen = np.isfinite(source.ref_q).all(axis=1)
    q = np.full_like(source.ref_q, np.nan)
    q[seen] = (turn * Rotation.from_quat(source.ref_q[seen], scalar_first=True)).as_quat(
        scalar_first=True
    )
    found = Finding(SIDEWAYS, "ref_q", 1, {"way": way})
    upright = replace(source, ref_q=q, findings=(*source.findings, found))
    for names in GROUPS.values():
        columns = [getattr(source, name) for name in names]
        if all(c is not None for c in columns):
            level = turn.apply(np.column_stack(columns))
            parts = level.T if len(names) > 1 else [level]
            upright = replace(upright, **dict(zip(names, parts, strict=True)))
    return at_log(log, upright)


def _way_up(log: Recording, source: Recording, trial: Trial) -> str | None:
    """Which axis of the world of a reference points up, in words; None for z, or for none.

    The mean of what an accelerometer shows, in a world, is gravity: a body that is somewhere all
    the time has no mean acceleration to speak of.
    """
    x, y = (v - v.mean(axis=0) for v in moving_pair(trial))
    q = attitude_at(source, log.time)
    known = np.isfinite(q).all(axis=1) & np.isfinite(log.accel).all(axis=1)
    if len(x) < LEAST_ROWS or not known.any():
        return None
    force = log.accel[known] @ turned_onto(x, y).T
    mean = Rotation.from_quat(q[known], scalar_first=True).apply(force).mean(axis=0)
    size = float(np.linalg.norm(mean))
    if abs(size / STANDARD_GRAVITY - 1.0) > uncertain():
        return None
    near = (w for w, up in LEVEL.items() if angle_between(mean / size, up) < uncertain())
    return next(near, None)
