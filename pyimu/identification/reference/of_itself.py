"""Attitudes that were computed from the gyro that they are compared with: the orientation that a
phone, or a unit with a filter of its own, gives beside its samples.

What such a one shows is what its gyro shows, noise and all, but for what gravity or a field puts
right (``common_noise``). And what such a filter turns beside the gyro, towards the accelerometer's
up, follows the force however a body is pushed: Mahony et al. 2008, their explicit filter, w =
w_gyro + k (u x v), with the direction u of the force and v of the vertical by the attitude. Such an
attitude leans where the body is pushed, and an accelerometer that is judged by it seems to be
wrong.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.common_noise import shows_noise_of_gyro
from pyimu.identification.search.belief import most
from pyimu.recording.recording import Recording
from pyimu.recording.reference.attitude import attitude_at
from pyimu.recording.turning import carried
from pyimu.report.numbers import number
from pyimu.units import STANDARD_GRAVITY

BLOCK = 0.2
"""s; over so long the turns of reference and gyro are compared."""

LEAST_BLOCKS = 64
"""Of which there must be so many: of unrelated turns the correlation scatters by 0.07 then."""

FOLLOWS = 0.5
"""Correlation of what the reference turns beside the gyro with what pulls it towards the force,
from which on a filter made it: simulated ones have 0.63 to 0.99 (Mahony's, with an integral or a
gain that forces lower, Madgwick's, behind a low-pass), cameras below 0.03, and of measured logs
whose clocks were not even set none more than 0.22."""


def made_of_it(trials: Iterable[Trial], logs: Iterable[Recording]) -> str:
    """Why an attitude tells nothing of the sensors that it is compared with: it was computed from
    them. Nothing where none was. ``trials`` are the gyro's of the ``logs``.
    """
    known = {r.name: r for r in logs}
    return next(filter(None, (_made_of_it(t, known) for t in trials)), "")


def _made_of_it(trial: Trial, logs: Mapping[str, Recording]) -> str:
    others = "and tells nothing of {} errors; cameras, encoders or a second unit would"
    pull = 0.0 if trial.name not in logs else pulled(trial, logs[trial.name])
    if pull:
        return (
            f"the attitude of {trial.name} is the gyro's, drawn towards the accelerometer's force "
            f"by {number(pull, 2)} rad/s for each rad: a filter computed it from these two, "
            f"{others.format('their')}"
        )
    own = trial.reference == "attitude" and shows_noise_of_gyro(trial)
    return _shows_noise("attitude", trial, others.format("its")) if own else ""


def rate_made_of_it(trials: Iterable[Trial]) -> str:
    """The same of a measured rate, which may be the gyro's with other noise beside it."""
    others = "and tells nothing of its errors; another instrument would"
    own = (t for t in trials if t.reference == "rate" and shows_noise_of_gyro(t))
    return next((_shows_noise("ref_rate", t, others) for t in own), "")


def _shows_noise(what: str, trial: Trial, others: str) -> str:
    return (
        f"the {what} of {trial.name} shows the gyro's own noise: it was computed from this gyro, "
        f"{others}"
    )


def pulled(trial: Trial, recording: Recording) -> float:
    """The gain [rad/s for each rad] with which the reference attitude of a trial's ``recording``
    turns, beside the gyro, towards the accelerometer's up; zero where it does not.

    A gyro whose drift depends on the force would show the same. The gain is more than any part
    has of that. What is proportional to the rate is left out of both: a mounting turns by that, and
    a body that goes round a bend is pushed by it.
    """
    if trial.reference != "attitude" or recording.accel is None or len(trial.axes) < 3:
        return 0.0
    late = 0.0 if trial.clock is None else trial.clock.mean
    rate, beside, pull = _beside_and_pull(recording, late)
    if len(beside) < LEAST_BLOCKS:
        return 0.0
    known = np.column_stack([np.ones(len(rate)), rate])
    beside, pull = (v - known @ np.linalg.lstsq(known, v, rcond=None)[0] for v in (beside, pull))
    both, powers = np.sum(beside * pull), [np.sum(v * v) for v in (beside, pull)]
    gain = float(both / max(powers[1], 1e-300))
    follows = both > FOLLOWS * np.sqrt(powers[0] * powers[1])
    return gain if follows and gain > most("g_sensitivity", "gyro", "G") * STANDARD_GRAVITY else 0.0


def _beside_and_pull(
    recording: Recording, late: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """In blocks of a recording whose reference is ``late`` s ahead, the gyro's rate (m, 3) rad/s,
    the rate (m, 3) rad/s at which the reference turns beside it, and the turn (m, 3) rad from its
    up to the force's.
    """
    source = recording if recording.reference is None else recording.reference
    q = attitude_at(source, recording.time - late)
    size = max(round(BLOCK / recording.sample_period), 1)
    first = [k for a, b in recording.segments for k in range(a, b - size, size)]
    rows = np.array(first, dtype=int)[:, None] + np.arange(size + 1)
    with np.errstate(invalid="ignore"):  # rows of zeros, as a logger writes, have no direction
        force = recording.accel / np.linalg.norm(recording.accel, axis=1, keepdims=True)
    seen = np.isfinite(np.column_stack([q, force, recording.gyro])).all(axis=1)
    rows = rows[seen[rows].all(axis=1)]
    if not len(rows):
        return np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3))
    gyro, step = recording.gyro[rows], np.diff(recording.time[rows], axis=1)[:, :, None]
    turns = (0.5 * (gyro[:, 1:] + gyro[:, :-1]) * step).swapaxes(0, 1)
    none = np.zeros((*turns.shape, 0))
    turned, _ = carried(turns, none, np.full(len(rows), size))
    ends = [Rotation.from_quat(q[rows[:, k]], scalar_first=True) for k in (0, -1)]
    beside = (turned.inv() * ends[0].inv() * ends[1]).as_rotvec() / step.sum(axis=1)
    attitude = Rotation.from_quat(q[rows].reshape(-1, 4), scalar_first=True)
    up = attitude.inv().apply([0.0, 0.0, 1.0]).reshape(*rows.shape, 3)
    return gyro.mean(axis=1), beside, np.cross(force[rows], up).mean(axis=1)
