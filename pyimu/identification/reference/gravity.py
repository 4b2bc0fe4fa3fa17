"""Gravity at rest as the reference of an accelerometer: a log's rests as a trial."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.rests import Rests
from pyimu.identification.fit.scatter import typical_wander, wander_of, weighed, with_wander
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.trials import environment
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS
from pyimu.recording.gravity import gravity_of
from pyimu.recording.recording import Recording
from pyimu.recording.rest import is_at_rest, rests

SAME = math.radians(5.0)
"""Rests whose gravity lies within this angle are in one position: what is left out with one of them
is left out with all."""

LEAST_POSITIONS = 4
"""Positions from which on gravity's size shows anything: a bias has three coefficients."""


def rest_trial(recording: Recording, latitude: float | None = None) -> Trial | None:
    """The accelerometer of a recording against gravity in its rests.

    None where the log has no accelerometer, or rests in fewer than ``LEAST_POSITIONS`` positions.
    """
    if recording.accel is None or not np.isfinite(recording.accel).any(axis=0).all():
        return None
    if is_at_rest(recording) and recording.stationary is None:
        return None
    pieces = rest_rows(recording)
    group = positions(np.array([recording.accel[rows].mean(axis=0) for rows in pieces]))
    if len(np.unique(group)) < LEAST_POSITIONS:
        return None
    u, known = environment(recording)
    u[:, COLUMNS["vibration"]] = 0.0
    time, y, means = (
        np.array([values[rows].mean(axis=0) for rows in pieces])
        for values in (recording.time, recording.accel, u)
    )
    means[:, OWN["accel"]] = y
    each = list(zip(range(len(y)), range(1, len(y) + 1), strict=True))
    return Trial(
        recording.name,
        "accel",
        recording.sample_period,
        time,
        y,
        means,
        each,
        known - {"vibration"},
        "gravity",
        reduction=_reduction(recording, pieces, y, time, group, latitude),
        findings=_findings(recording, len(y), group, latitude),
    )


def rest_trials(
    sensor: Sensor,
    logs: Sequence[Recording],
    others: Sequence[Recording],
    latitude: float | None,
) -> tuple[list[Trial], list[Trial]] | None:
    """Trials of rests to fit and to judge by.

    None for a gyro, where a log has a reference of force, and where none has rests in enough
    positions.
    """
    if sensor.kind != "accel" or any(r.ref_force is not None for r in logs):
        return None
    fitted, held = (
        [t for t in (rest_trial(r, latitude) for r in rs) if t is not None] for rs in (logs, others)
    )
    if not fitted:
        return None
    fitted = weighed(fitted, sensor)
    if not others:
        return fitted, [t.split(0.0)[1] for t in fitted]
    return fitted, [with_wander(t, wander_of(fitted[0])) for t in held]


def few(logs: Sequence[Recording]) -> str:
    """Why the rests of logs are too few to be a reference."""
    most = max((_positions(r) for r in logs if r.accel is not None), default=0)
    have = f"{most} position{'s' * (most != 1)}" if most else "no position"
    return (
        f"gravity's size is known in {have} at rest (its bias takes {LEAST_POSITIONS}, the scale "
        "factors six, each axis up and down, the misalignment nine)"
    )


def _positions(recording: Recording) -> int:
    force = [recording.accel[rows].mean(axis=0) for rows in rest_rows(recording)]
    return len(np.unique(positions(np.array(force))))


def rest_rows(recording: Recording) -> list[np.ndarray]:
    """The rows of each rest that have a measurement on all axes."""
    whole = np.isfinite(recording.accel).all(axis=1)
    pieces = [a + np.flatnonzero(whole[a:b]) for a, b in rests(recording)]
    return [rows for rows in pieces if len(rows)]


def positions(force: np.ndarray) -> np.ndarray:
    """The number (k,) of the position in which each of the forces (k, 3) was measured."""
    found: list[np.ndarray] = []
    out = np.zeros(len(force), dtype=int)
    for i, f in enumerate(force):
        down = f / np.linalg.norm(f)
        near = [k for k, other in enumerate(found) if down @ other > math.cos(SAME)]
        if not near:
            found.append(down)
        out[i] = near[0] if near else len(found) - 1
    return out


def _reduction(
    recording: Recording,
    pieces: Sequence[np.ndarray],
    y: np.ndarray,
    time: np.ndarray,
    group: np.ndarray,
    latitude: float | None,
) -> Rests:
    std = sample_std(recording.accel, pieces)
    count = np.array([len(rows) for rows in pieces])
    share = (y / np.linalg.norm(y, axis=1)[:, None]) ** 2
    gravity, unsure = gravity_of(recording, latitude)
    return Rests(
        white=np.diag(share @ std**2 / count),
        wander=np.eye(len(y)) * typical_wander("accel") ** 2,
        common=np.full((len(y), len(y)), unsure**2),
        group=group,
        time=time,
        samples=int(count.sum()),
        sample_std=std,
        any_turn=True,
        bias=np.zeros(3),
        gravity=gravity,
    )


def sample_std(values: np.ndarray, pieces: Sequence[np.ndarray]) -> np.ndarray:
    """Standard deviation (3,) of a sample's white noise, by the changes from sample to sample.

    A hand that holds the sensor changes the mean, too (von Neumann 1941).
    """
    squares = sum((np.diff(values[rows], axis=0) ** 2).sum(axis=0) for rows in pieces)
    return np.sqrt(squares / (2 * max(sum(len(rows) - 1 for rows in pieces), 1)))


def _findings(
    recording: Recording, count: int, group: np.ndarray, latitude: float | None
) -> tuple[Finding, ...]:
    gravity, unsure = gravity_of(recording, latitude)
    detail = {"positions": len(np.unique(group)), "gravity": gravity, "gravity_std": unsure}
    return (Finding("gravity_at_rest", "accel", count, detail),)
