"""What of a recording cannot be navigated by, and what should be known of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from pyimu.attitude.rest import GRAVITY_OFF, Rest
from pyimu.errors import Finding, UserError
from pyimu.navigation.track import Reference, Track
from pyimu.recording.columns import XYZ
from pyimu.recording.quality.spikes import spikes
from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY

ANY_UNIT = 2.0
"""A median force that is off gravity by this factor, up or down, is no force in that unit; one of
about 1 is in g."""

UPRIGHT = 0.7
"""Share of gravity on z below which a body at rest leans by more than 45 deg."""

CONING = 0.2
"""rad; turn between two samples from which on the rotation vector of two samples is off by 1e-4."""

IMPOSSIBLE = 10.0
"""A single sample that is off by so many times what a robot of the stated top acceleration and top
turn rate does is no measurement. Assumed."""

JUMP = 1.0
"""m; least step of a reference that is called a jump."""

JUMPS_BY = 10.0
"""And how many times the largest step but that of one in a hundred."""

FRAME = 5.0
"""A turn of the reference must lower its distance from the path by this factor to be said."""


def check_columns(recording: Recording, gravity: float = STANDARD_GRAVITY) -> None:
    """Raise UserError for a recording by which no position can be found.

    ``gravity`` in m/s^2 is that of the place.
    """
    for name in ("gyro", "accel"):
        values = getattr(recording, name)
        unit = "rad/s" if name == "gyro" else "m/s^2"
        if values is None or not np.isfinite(values).any():
            raise UserError(
                f"{recording.name}: no {name}; a position takes {name}_x [{unit}], {name}_y, "
                f"{name}_z"
            )
        for axis, column in zip(XYZ, values.T, strict=True):
            if not np.isfinite(column).any():
                raise UserError(
                    f"{recording.name}: {name}_{axis} has no number in any row; a position takes "
                    f"all three axes of {name}"
                )
    if len(recording.time) < 2:
        raise UserError(f"{recording.name}: one sample, a position over time needs two or more")
    known = recording.accel[np.isfinite(recording.accel).all(axis=1)]
    force = float(np.median(np.linalg.norm(known, axis=1))) if len(known) else gravity
    if 1 / ANY_UNIT < force / gravity < ANY_UNIT:
        return
    in_g = 1 / ANY_UNIT < force < ANY_UNIT
    hint = "are they in g? Then the header is accel_x [g]" if in_g else "in which unit are they?"
    raise UserError(
        f"{recording.name}: accel_x, accel_y, accel_z have a magnitude of {force:.3g} m/s^2 as "
        f"their header says, expected about {gravity:.2g}: {hint}"
    )


def without_outliers(
    recording: Recording, acceleration: float, turn_rate: float
) -> tuple[Recording, list[Finding]]:
    """The recording with single samples missing that no robot's motion is, and what they were.

    ``acceleration`` m/s^2 and ``turn_rate`` rad/s are the largest of the robot.
    """
    found, groups = [], {}
    for name, most in (("gyro", turn_rate), ("accel", acceleration)):
        values = np.where(np.isfinite(getattr(recording, name)), getattr(recording, name), np.nan)
        off = np.abs(values - np.nanmedian(values, axis=0)) > IMPOSSIBLE * most
        wrong = (off & spikes(values)).any(axis=1) if off.any() else off.any(axis=1)
        if wrong.any():
            first = float(recording.time[np.argmax(wrong)])
            found.append(Finding("outliers", name, int(wrong.sum()), {"first": first}))
        groups[name] = np.where(wrong[:, None], np.nan, values)
    return replace(recording, **groups), found


def findings(recording: Recording, rest: Rest, gravity: float) -> list[Finding]:
    """What the samples show before the filter runs. Raises UserError for gravity on -z."""
    found = []
    force = rest.force if rest.force is not None else np.nanmean(recording.accel, axis=0)
    if force[2] < -0.5 * gravity and not recording.frame_declared:
        raise UserError(
            f"{recording.name}: gravity is on -z (mean accel_z {force[2]:.3g} m/s^2), the axes are "
            'not forward-left-up; --columns MAP.toml with [frame] body = "frd" says how they lie'
        )
    size = float(np.linalg.norm(force))
    if rest.force is not None and force[2] < UPRIGHT * size:
        axis = XYZ[int(np.argmax(np.abs(force)))]
        found.append(Finding("leaning", "accel", 1, {"axis": axis, "share": force[2] / size}))
    if not rest.seen:
        found.append(Finding("no_rest", "", 1, {"seconds": rest.duration}))
    elif abs(size / gravity - 1) > GRAVITY_OFF:
        found.append(
            Finding("gravity_off", "accel", 1, {"magnitude": size, "share": size / gravity - 1})
        )
    turns = np.nan_to_num(np.linalg.norm(recording.gyro, axis=1)) * recording.sample_period
    most = int(np.argmax(turns))
    if turns[most] > CONING:
        detail = {"turn": float(turns[most]), "at": float(recording.time[most])}
        found.append(Finding("coning", "gyro", int(np.sum(turns > CONING)), detail))
    return found


def after(still: np.ndarray, reference: Reference | None, track: Track | None) -> list[Finding]:
    """What the run showed; ``track`` is the best there is."""
    out = []
    if not still.any():
        out.append(Finding("never_still", "", 1, {}))
    elif still.all():
        out.append(Finding("always_still", "", len(still), {}))
    if reference is not None and track is not None:
        out += [*_jumps(reference, track.time), *_turned(reference, track)]
    return out


def _jumps(reference: Reference, time: np.ndarray) -> Iterator[Finding]:
    """Steps of the reference that are far beyond its others."""
    steps = np.linalg.norm(np.diff(reference.position[:, :2], axis=0), axis=1)
    at = np.flatnonzero(steps > max(JUMP, JUMPS_BY * float(np.quantile(steps, 0.99))))
    if len(at):
        first = float(time[reference.rows[at[0] + 1]])
        detail = {"largest": float(steps[at].max()), "first": first}
        yield Finding("reference_jump", "ref_east", len(at), detail)


def _turned(reference: Reference, track: Track) -> Iterator[Finding]:
    """By which turn, or mirror and turn, the reference's path would be that of the track, where
    that is what tells them apart (the orthogonal Procrustes problem in the plane).
    """
    place = reference.position[:, :2]
    path = track.position[reference.rows, :2] - track.position[reference.rows[0], :2]
    if not np.isfinite(path).all():
        return
    apart = float(np.sqrt(np.mean(np.sum((path - place) ** 2, axis=1))))
    u, _, v = np.linalg.svd(path.T @ place)
    turn = u @ v
    left = float(np.sqrt(np.mean(np.sum((path - place @ turn.T) ** 2, axis=1))))
    claimed = 0.0
    if track.position_std is not None:
        variance = track.position_std[reference.rows, :2] ** 2
        claimed = float(np.sqrt(np.mean(variance.sum(axis=1))))
    if apart < max(FRAME * left, 3 * claimed) or apart < 1e-6:
        return
    angle = float(np.arctan2(turn[1, 0], turn[0, 0]))
    mirrored = bool(np.linalg.det(turn) < 0)
    detail = {"before": apart, "after": left, "turn": angle, "mirrored": int(mirrored)}
    yield Finding("reference_frame", "ref_east", len(place), detail)
