"""Motions as recordings of the truth, and as trials that a sensor would be compared in."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.trials import accel_trial, gyro_trial
from pyimu.identification.plan.kinematics import attitude, force, joined_pieces
from pyimu.identification.plan.motions import CYCLE, SUPPLY, WARMING, Limits, Motion
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, SIGNALS, inputs_of
from pyimu.recording.recording import Recording

STEP, STILL_STEP = 0.02, 1.0
"""s; rows of what is planned, and of a rest: a density counts, not how many rows share it."""

FINE_STEP = 0.001
"""s; rows where effects that both make the signal late are told apart. They differ in the third
order of their time against that of the motion, which a step as long as that time would not have."""

FIELD = np.array([0.0, 2.0e-5, -4.4e-5])
"""T, east, north and up; the Earth's field in middle latitudes."""

LATITUDE = np.radians(50.0)
"""Where the Earth's rotation is to be seen."""

ALWAYS = ("ref_rate", "ref_force", "temperature")
"""What a recorded motion holds, whoever asks for it."""


def step_of(
    motions: Iterable[Motion], sample_period: float = 0.0, effects: Iterable[str] = ()
) -> float:
    """The step in s in which motions are planned for a sensor of this sample period, of which
    ``effects`` are estimated together.
    """
    if all(m.still for m in motions):
        return STILL_STEP
    late = sum(CATALOGUE[name].family == "delay" for name in set(effects))
    return max(FINE_STEP if late > 1 else STEP, sample_period)


def recorded(
    motions: Sequence[Motion], limits: Limits, h: float, also: Iterable[str] = ()
) -> Recording:
    """The truth of motions that are made one after the other, every ``h`` s.

    ``also`` names further signals that effects need: ``supply``, ``mag``, the attitude and place.
    """
    pieces = [m.moves(h, limits) for m in motions]
    lengths = [len(rate) for rate, _ in pieces]
    rate, push = joined_pieces(pieces)
    q = attitude(rate, h)
    groups = {
        "ref_rate": rate,
        "ref_force": force(q, push),
        "temperature": _warmth(motions, lengths, h),
    }
    wanted = {SIGNALS[s].group for s in inputs_of(also)}
    made = {
        "supply": lambda: _supply(motions, lengths, h),
        "mag": lambda: q.inv().apply(FIELD),
        "ref_q": lambda: q.as_quat(scalar_first=True),
        "latitude": lambda: np.full(len(rate), LATITUDE),
        "ref_velocity": lambda: np.zeros((len(rate), 3)),
    }
    groups |= {name: make() for name, make in made.items() if name in wanted}
    name = motions[0].name if len(motions) == 1 else "motion"
    return Recording.from_arrays(name, time=np.arange(len(rate)) * h, **groups)


def _warmth(motions: Sequence[Motion], lengths: Sequence[int], h: float) -> np.ndarray:
    """degC (n,): up and down again in whole cycles within each motion that is warm."""
    parts = []
    for m, n in zip(motions, lengths, strict=True):
        cycles = max(1, round(n * h / CYCLE))
        phase = 2 * np.pi * cycles * np.arange(n) / n
        parts.append(25.0 + m.warm * WARMING / 2 * (1 - np.cos(phase)))
    return np.concatenate(parts)


def _supply(motions: Sequence[Motion], lengths: Sequence[int], h: float) -> np.ndarray:
    """V (n,): raised and lowered every 30 s in a motion that has it so."""
    start = SIGNALS["supply"].start[0]
    return np.concatenate(
        [
            start + m.supply * SUPPLY * np.where((np.arange(n) * h // 30.0) % 2, 1.0, -1.0)
            for m, n in zip(motions, lengths, strict=True)
        ]
    )


def trial_of(recording: Recording, kind: str, fixed: bool = True) -> Trial:
    """What ``close`` would compare a sensor with in a log of a motion.

    The sensor measures the truth; where the reference is not ``fixed`` its mounting is unknown.
    """
    own = {"gyro": recording.ref_rate, "accel": recording.ref_force}
    log = replace(recording, gyro=own["gyro"], accel=own["accel"])
    # A truth without noise repeats itself, holds still and jumps: nothing of that is a fault here.
    log = replace(log, period=float(log.time[1] - log.time[0]))
    trial = gyro_trial(log) if kind == "gyro" else accel_trial(log, False)
    whole = [(0, len(log.time))]
    if np.ptp(log.temperature) == 0.0:
        trial.u[:, COLUMNS["temperature_rate"]] = 0.0  # its slope by differences is rounding
    return replace(
        trial, left_out=None, limited=None, segments=whole, findings=(), free_rotation=not fixed
    )


def trial(
    motions: Sequence[Motion], sensor: Sensor, limits: Limits, h: float, also: Iterable[str] = ()
) -> Trial:
    """The trial of motions that a sensor makes one after the other."""
    fixed = all(m.fixed for m in motions)
    return trial_of(recorded(motions, limits, h, also), sensor.kind, fixed)
