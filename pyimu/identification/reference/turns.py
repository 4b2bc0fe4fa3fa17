"""The turns between a log's rests as the reference of its gyro.

Where the accelerometer was examined in them, gravity of one must be that of the next.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.scatter import typical_wander, wander_of, weighed, with_wander
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.trials import environment
from pyimu.identification.fit.turns import Turns, at_middle
from pyimu.identification.reference.gravity import rest_rows, sample_std
from pyimu.identification.search.investigation import Investigation
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, N_INPUT
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.recording import Recording

LEAST_TURNS = 3
"""Turns from which on the gyro is looked at: two rows each, and a bias has three coefficients."""


def turn_trials(
    sensor: Sensor,
    logs: Sequence[Recording],
    others: Sequence[Recording],
    accel: Investigation | None,
) -> tuple[list[Trial], list[Trial]] | None:
    """Trials of turns to fit and to judge by, given what gravity at rest showed of the
    accelerometer; None where it showed nothing, or the logs turn too little between rests.
    """
    if accel is None or not accel.after.is_reduced:
        return None
    fitted, held = (
        [t for t in (_turn_trial(r, accel, rests) for r in rs) if t is not None]
        for rs, rests in ((logs, accel.after.trials), (others, accel.held))
    )
    if not fitted:
        return None
    shown = weighed(fitted, sensor)
    if not others:
        return shown, [t.split(0.0)[1] for t in shown]
    return shown, [with_wander(t, wander_of(shown[0])) for t in held]


def _turn_trial(recording: Recording, accel: Investigation, rests: Sequence[Trial]) -> Trial | None:
    """The gyro of a recording whose rests are one of the trials ``rests``; None without it."""
    trial = next((t for t in rests if t.name == recording.name), None)
    if trial is None or recording.gyro is None:
        return None
    pieces = rest_rows(recording)
    turns = _turns(recording, pieces)
    if len(turns) < LEAST_TURNS:
        return None
    u, known = environment(recording)
    u[:, COLUMNS["vibration"]] = 0.0
    y = np.nan_to_num(recording.gyro)
    u[:, OWN["gyro"]] = y
    detail = {"turns": len(turns), "rests": len(pieces)}
    return Trial(
        recording.name,
        "gyro",
        recording.sample_period,
        recording.time,
        y,
        u,
        recording.segments,
        known - {"vibration"},
        "gravity",
        reduction=_reduction(recording, pieces, turns, accel.after, trial),
        findings=(Finding("turns_between_rests", "gyro", len(turns), detail),),
    )


def _turns(recording: Recording, pieces: Sequence[np.ndarray]) -> list[tuple[int, int]]:
    """Pairs of rests that follow each other with every sample between them measured."""
    whole = np.isfinite(recording.gyro).all(axis=1)
    for column in recording.gyro.T:
        whole &= ~clipped(column)
    segment = np.zeros(len(whole), dtype=int)
    for number, (a, b) in enumerate(recording.segments):
        segment[a:b] = number
    return [
        (i, i + 1)
        for i in range(len(pieces) - 1)
        if segment[pieces[i][0]] == segment[pieces[i + 1][-1]]
        and whole[pieces[i][0] : pieces[i + 1][-1] + 1].all()
    ]


def _reduction(
    recording: Recording,
    pieces: list[np.ndarray],
    turns: list[tuple[int, int]],
    accel: Fit,
    rests: Trial,
) -> Turns:
    """The turns, with the covariance of their rows at the measured rates."""
    rows = rests.rows(accel.sensor, held_state(accel, rests)[0].bias)
    used = sorted({k for pair in turns for k in pair})
    place = {k: n for n, k in enumerate(used)}
    kept = tuple(pieces[k] for k in used)
    pairs = tuple((place[i], place[j]) for i, j in turns)
    m, ends = 2 * len(pairs), [kept[j][0] for _, j in pairs]
    std = sample_std(recording.gyro, kept)
    bias = np.mean([recording.gyro[at].mean(axis=0) for at in kept], axis=0)
    seconds = np.gradient(recording.time)
    rate = np.nan_to_num(recording.gyro) - bias
    made = Turns(
        white=np.eye(m),
        wander=typical_wander("gyro") ** 2 * np.eye(m),
        common=np.zeros((m, m)),
        group=np.arange(len(pairs)).repeat(2),
        time=recording.time[ends].repeat(2),
        samples=len(recording.time),
        sample_std=std,
        any_turn=False,
        bias=bias,
        rests=kept,
        turns=pairs,
        down=at_middle(rows.along[used], rate, seconds, kept),
        seconds=seconds,
    )
    return replace(made, **_covariance(made, recording, rests, used))


def _covariance(
    made: Turns, recording: Recording, rests: Trial, used: list[int]
) -> dict[str, np.ndarray]:
    """What the gyro's white noise, and the accelerometer's of each rest, do to the rows."""
    y = np.nan_to_num(recording.gyro) - made.bias
    u = np.zeros((len(y), N_INPUT))
    rows = made.rows(Sensor("gyro"), y, u, recording.segments, recording.sample_period)
    white = sum((w @ w.T).toarray() * s**2 for w, s in zip(rows.weights, made.sample_std))
    shape = rests.reduction
    tilt = np.sqrt(np.diag(shape.white + shape.wander))[used] / shape.gravity
    moved = np.concatenate([made.tilted(y, k) * tilt[k] for k in range(len(used))], axis=1)
    return {"white": white, "common": moved @ moved.T}
