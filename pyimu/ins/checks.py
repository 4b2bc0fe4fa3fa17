"""What of a recording cannot be navigated by, and what should be known of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.attitude.rest import Rest, gravity_findings
from pyimu.errors import Finding, UserError
from pyimu.ins.filtered import Filtered
from pyimu.ins.measured import MOST_WRONG
from pyimu.ins.track import Reference, Track
from pyimu.recording.clock import runs
from pyimu.recording.columns import XYZ
from pyimu.recording.integration import integrated
from pyimu.recording.quality.false_force import check_force
from pyimu.recording.quality.spikes import spikes
from pyimu.recording.recording import Recording
from pyimu.recording.reference.course import CRAWL
from pyimu.units import STANDARD_GRAVITY

ANY_UNIT = 2.0
"""A median force that is off gravity by this factor, up or down, is no force in that unit, unless
its mean is gravity, as of what runs; one of about 1 is in g."""

MEAN_TIME = 5.0
"""s; over which the velocity of a body changes by less than gravity does."""

UPRIGHT = 0.7
"""Share of gravity on z below which a body at rest leans by more than 45 deg."""

CONING = 0.2
"""rad; turn between two samples from which on the rotation vector of two samples is off by 1e-4."""

IMPOSSIBLE = 10.0
"""A single sample that is off by so many times what a robot of the stated top acceleration and top
turn rate does is no measurement. Assumed."""

SHOCKS, BEYOND_SHOCKS = 5, 2.0
"""What so many places of a log show that are no single samples its motion does, as that of a foot
that lands; a single sample must be off by so many times that. Assumed."""

JUMP = 1.0
"""m; least step of a reference that is called a jump."""

JUMPS_BY = 10.0
"""And how many times what it goes in that time at its largest speed but that of one step in a
hundred."""

OTHER_SIZE = 2.0
"""Least factor between the sizes of two paths that may be a unit's: yards are metres to 9 %, and no
navigation is off by so much in size alone; feet are 3.3 to a metre."""

FRAME = 5.0
"""A turn of the reference must lower its distance from the path by this factor to be said."""


ASKEW = np.radians(20.0)
"""A vehicle that moves no further off its x axis, forward or backward, is mounted so."""

LEAST_KNOWN = 0.1
"""Share of a drive of which the velocity must be known for its direction in the body to count."""

CONSTRAINT = 8
"""Bit of the filter's status of a constraint that contradicted the estimate."""


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
    check_force(recording, gravity)
    known = recording.accel[np.isfinite(recording.accel).all(axis=1)]
    force = float(np.median(np.linalg.norm(known, axis=1))) if len(known) else gravity
    if 1 / ANY_UNIT < force / gravity < ANY_UNIT:
        return
    force = _mean_force(recording)
    if 1 / ANY_UNIT < force / gravity < ANY_UNIT:
        return
    in_g = 1 / ANY_UNIT < force < ANY_UNIT
    hint = "are they in g? Then the header is accel_x [g]" if in_g else "in which unit are they?"
    raise UserError(
        f"{recording.name}: accel_x, accel_y, accel_z have a magnitude of {force:.3g} m/s^2 as "
        f"their header says, expected about {gravity:.2g}: {hint}"
    )


def _mean_force(recording: Recording) -> float:
    """m/s^2; the size of the mean force over ``MEAN_TIME`` in axes that do not turn, its median.

    It is gravity but for the change of the velocity in that time, however hard the body is shaken.
    """
    known = np.isfinite(recording.gyro).all(axis=1) & np.isfinite(recording.accel).all(axis=1)
    rate, force = (np.where(known[:, None], v, 0.0) for v in (recording.gyro, recording.accel))
    world = integrated(rate, recording.sample_period, Rotation.identity()).apply(force)
    count = max(1, round((recording.time[-1] - recording.time[0]) / MEAN_TIME))
    parts = np.array_split(np.arange(len(world)), min(count, len(world)))
    means = [world[rows].sum(axis=0) / max(known[rows].sum(), 1) for rows in parts]
    return float(np.median(np.linalg.norm(means, axis=1)))


def without_outliers(
    recording: Recording, acceleration: float, turn_rate: float
) -> tuple[Recording, list[Finding]]:
    """The recording with single samples missing that no robot's motion is, and what they were.

    ``acceleration`` m/s^2 and ``turn_rate`` rad/s are the largest of the robot.
    """
    found, groups = [], {}
    for name, most in (("gyro", turn_rate), ("accel", acceleration)):
        values = np.where(np.isfinite(getattr(recording, name)), getattr(recording, name), np.nan)
        off = np.nan_to_num(np.abs(values - np.nanmedian(values, axis=0)))
        limit = IMPOSSIBLE * most
        wrong = (off > limit).any(axis=1)
        if wrong.any():
            alone = spikes(values, recording.segments)
            limit = max(limit, _of_shocks(np.where(alone, 0.0, off).max(axis=1), limit))
            wrong = (alone & (off > limit)).any(axis=1)
        if wrong.any():
            first = float(recording.time[np.argmax(wrong)])
            found.append(Finding("outliers", name, int(wrong.sum()), {"first": first}))
        groups[name] = np.where(wrong[:, None], np.nan, values)
    return replace(recording, **groups), found


def _of_shocks(off: np.ndarray, limit: float) -> float:
    """How far off a single sample must be of a body that is ``off`` (n,) as far as ``SHOCKS`` times
    in its motion, where that is beyond a ``limit``; 0 of any other.
    """
    peaks = sorted(off[a:b].max() for a, b in runs(off > limit / BEYOND_SHOCKS))
    return BEYOND_SHOCKS * float(peaks[-SHOCKS]) if len(peaks) >= SHOCKS else 0.0


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
    if not rest.seen and rest.other_force is None:
        found.append(Finding("no_rest", "", 1, {"seconds": rest.duration}))
    found += gravity_findings(rest)
    turns = np.nan_to_num(np.linalg.norm(recording.gyro, axis=1)) * recording.sample_period
    most = int(np.argmax(turns))
    if turns[most] > CONING:
        detail = {"turn": float(turns[most]), "at": float(recording.time[most])}
        found.append(Finding("coning", "gyro", int(np.sum(turns > CONING)), detail))
    return found


def after(
    still: np.ndarray, reference: Reference | None, track: Track | None, moves: bool
) -> list[Finding]:
    """What the run showed; ``track`` is the best there is; ``moves`` says that rests are none."""
    out = []
    if not still.any():
        out.append(Finding("never_still", "", 1, {}))
    elif still.all():
        out.append(Finding("always_still", "", len(still), {}))
    if reference is not None and track is not None:
        out += _jumps(reference, track.time)
        fit = _Fit.of(reference, track)
        if fit is not None:
            # A rest that is none makes the path shorter: no unit of the reference does.
            out += [*_turned(fit, reference, track), *(() if moves else _sized(fit))]
    return out


def constraint(found: Filtered, still: np.ndarray, free: Filtered) -> Iterator[Finding]:
    """Whether the run ``free`` of a vehicle's constraint moves along another axis than x, and
    whether most of the drive contradicts the constraint; ``along`` rad in the body's axes is NaN
    where that is x, or not clear.
    """
    used = found.scalar("nhc_nis") > 0
    wrong = used & (found.scalar("status").astype(int) & CONSTRAINT > 0)
    share = float(np.sum(wrong) / max(np.sum(used), 1))
    along = _along(free, still)
    askew = ASKEW < abs(along) < np.pi - ASKEW
    if askew or share > MOST_WRONG:
        along = along if askew else np.nan
        yield Finding("constraint", "", int(np.sum(wrong)), {"share": share, "along": along})


def _along(free: Filtered, still: np.ndarray) -> float:
    """rad; the direction in body axes in which a body moves, where its velocity is known."""
    velocity = free.vector("velocity")
    known = np.linalg.norm(velocity, axis=1) > CRAWL * free.vector("velocity_std").max(axis=1)
    rows = known & ~still
    if np.sum(rows) < LEAST_KNOWN * np.sum(~still):
        return np.nan
    turn = Rotation.from_quat(free.vector("q", 4)[rows], scalar_first=True)
    speed = turn.inv().apply(velocity[rows])[:, :2]
    sizes, axes = np.linalg.eigh(speed.T @ speed)
    x, y = axes[:, 1] * np.sign(speed.sum(axis=0) @ axes[:, 1])
    return float(np.arctan2(y, x)) if sizes[1] > FRAME**2 * sizes[0] else np.nan


def _jumped(reference: Reference, time: np.ndarray) -> np.ndarray:
    """The steps of the reference that are far beyond what its others go in the same time."""
    steps = np.linalg.norm(np.diff(reference.position[:, :2], axis=0), axis=1)
    seconds = np.diff(time[reference.rows])
    fastest = float(np.quantile(steps / seconds, 0.99)) if len(steps) else 0.0
    return np.flatnonzero(steps > np.maximum(JUMP, JUMPS_BY * fastest * seconds))


def _jumps(reference: Reference, time: np.ndarray) -> Iterator[Finding]:
    """Jumps of the reference, the first and the largest."""
    at = _jumped(reference, time)
    if len(at):
        step = np.diff(reference.position[:, :2], axis=0)[at]
        largest = float(np.linalg.norm(step, axis=1).max())
        detail = {"largest": largest, "first": float(time[reference.rows[at[0] + 1]])}
        yield Finding("reference_jump", "ref_east", len(at), detail)


@dataclass(frozen=True)
class _Fit:
    """The path of a track (m, 2) and that of its reference, from their first row on, the orthogonal
    ``turn`` (2, 2) that brings the second to the first (Procrustes), and how many times as large as
    the path the reference is (Umeyama 1991).
    """

    path: np.ndarray
    place: np.ndarray
    turn: np.ndarray
    factor: float

    @classmethod
    def of(cls, reference: Reference, track: Track) -> _Fit | None:
        """None where the track has no number, or no way."""
        place = reference.position[:, :2]
        path = track.position[reference.rows, :2] - track.position[reference.rows[0], :2]
        if not np.isfinite(path).all() or not path.any() or not place.any():
            return None
        u, sizes, v = np.linalg.svd(path.T @ place)
        return cls(path, place, u @ v, float(sizes.sum() / np.sum(path**2)))

    @property
    def unmirrored(self) -> np.ndarray:
        """The turn (2, 2) that is no mirror (Kabsch 1976)."""
        u, _, v = np.linalg.svd(self.path.T @ self.place)
        return u @ np.diag([1.0, np.linalg.det(u @ v)]) @ v

    @property
    def before(self) -> float:
        """m; from the path to the reference, RMS."""
        return self._apart(self.place)

    def after(self, factor: float = 1.0) -> float:
        """m; the same of a reference that is turned, and smaller by a ``factor``."""
        return self._apart(self.place @ self.turn.T / factor)

    def _apart(self, place: np.ndarray) -> float:
        return float(np.sqrt(np.mean(np.sum((self.path - place) ** 2, axis=1))))


def check_not_mirrored(name: str, fixes: Reference, track: Track) -> None:
    """Raise UserError where measured positions have the way of a ``track`` without them only in a
    mirror.
    """
    fit = _Fit.of(fixes, track)
    if fit is None or np.linalg.det(fit.turn) > 0:
        return
    turned = replace(fit, turn=fit.unmirrored)
    if turned.after() > FRAME * fit.after():
        raise UserError(
            f"{name}: the measured positions have the way of gyro and accelerometer mirrored, "
            f"{fit.after():.3g} m from it, and {turned.after():.3g} m as they are: position_east "
            "and position_north are swapped, or one has the other sign"
        )


def _sized(fit: _Fit) -> Iterator[Finding]:
    """How many times as large as the path the reference is, where a unit may be the cause."""
    before, after = fit.before, fit.after(fit.factor)
    if max(fit.factor, 1 / fit.factor) > OTHER_SIZE and before > FRAME * after:
        detail = {"factor": fit.factor, "before": before, "after": after}
        yield Finding("reference_scale", "ref_east", len(fit.place), detail)


def _turned(fit: _Fit, reference: Reference, track: Track) -> Iterator[Finding]:
    """By which turn, or mirror and turn, the reference's path would be that of the track, where
    that is what tells them apart.
    """
    before, after, claimed = fit.before, fit.after(), 0.0
    if track.position_std is not None:
        variance = track.position_std[reference.rows, :2] ** 2
        claimed = float(np.sqrt(np.mean(variance.sum(axis=1))))
    if before < max(FRAME * after, 3 * claimed) or before < 1e-6:
        return
    angle = float(np.arctan2(fit.turn[1, 0], fit.turn[0, 0]))
    mirrored = bool(np.linalg.det(fit.turn) < 0)
    detail = {"before": before, "after": after, "turn": angle, "mirrored": int(mirrored)}
    yield Finding("reference_frame", "ref_east", len(fit.place), detail)
