"""What of a recording cannot be navigated by, and what should be known of it."""

from __future__ import annotations

import numpy as np

from pyimu.attitude.rest import Rest
from pyimu.errors import Finding, UserError
from pyimu.recording.recording import Recording

IN_G = (0.5, 2.0)
"""Between these a mean force is one of gravity in g, whatever its header says."""

GRAVITY_OFF = 0.02
"""Share by which the mean force of a rest may differ from gravity before it is said: a scale factor
or a unit."""

CONING = 0.2
"""rad; turn between two samples from which on the rotation vector of two samples is off by 1e-4."""


def check_columns(recording: Recording) -> None:
    """Raise UserError for a recording by which no position can be found."""
    for name in ("gyro", "accel"):
        values = getattr(recording, name)
        unit = "rad/s" if name == "gyro" else "m/s^2"
        if values is None or not np.isfinite(values).any():
            raise UserError(
                f"{recording.name}: no {name}; a position takes {name}_x [{unit}], {name}_y, "
                f"{name}_z"
            )
    if len(recording.time) < 2:
        raise UserError(f"{recording.name}: one sample, a position over time needs two or more")
    known = recording.accel[np.isfinite(recording.accel).all(axis=1)]
    force = float(np.median(np.linalg.norm(known, axis=1)))
    if IN_G[0] < force < IN_G[1]:
        raise UserError(
            f"{recording.name}: accel_x, accel_y, accel_z have a magnitude of {force:.3g} m/s^2 as "
            "their header says, expected about 9.8: are they in g? Then the header is accel_x [g]"
        )


def findings(recording: Recording, rest: Rest, gravity: float) -> list[Finding]:
    """What the samples show before the filter runs. Raises UserError for gravity on -z."""
    found = []
    force = rest.force if rest.force is not None else _mean_force(recording)
    if force[2] < -0.5 * gravity and not recording.frame_declared:
        raise UserError(
            f"{recording.name}: gravity is on -z (mean accel_z {force[2]:.3g} m/s^2), the axes are "
            'not forward-left-up; --columns MAP.toml with [frame] body = "frd" says how they lie'
        )
    if not rest.seen:
        found.append(Finding("no_rest", "", 1, {"seconds": rest.duration}))
    elif abs(np.linalg.norm(force) / gravity - 1) > GRAVITY_OFF:
        size = float(np.linalg.norm(force))
        found.append(
            Finding("gravity_off", "accel", 1, {"magnitude": size, "share": size / gravity - 1})
        )
    turn = np.nanmax(np.linalg.norm(recording.gyro, axis=1)) * recording.sample_period
    if turn > CONING:
        found.append(Finding("coning", "gyro", 1, {"turn": float(turn)}))
    return found


def _mean_force(recording: Recording) -> np.ndarray:
    return np.nanmean(recording.accel, axis=0)


def after(still: np.ndarray) -> list[Finding]:
    """What the run showed."""
    out = []
    if not still.any():
        out.append(Finding("never_still", "", 1, {}))
    elif still.all():
        out.append(Finding("always_still", "", len(still), {}))
    return out
