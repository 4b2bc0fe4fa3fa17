"""What is known of the sensors of a recording: its part, and of what that is silent the samples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.attitude.columns import NOMINAL_SCALE_STD, informed, nominal_part, of_a_sensor
from pyimu.attitude.rest import Rest
from pyimu.model.catalogue import CATALOGUE, read_off
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.tolerance import Tolerance
from pyimu.model.typical import magnitudes
from pyimu.recording.quality.clipping import touched_level
from pyimu.recording.recording import Recording
from pyimu.recording.rest import LARGEST_RATE

STEPS = 20
"""A limit of so few steps of a coarse converter or less is none, nor is that of a column that goes
over no more: at rest most samples are one of two or three values, which looks like a pile at the
end of a range."""

SAME = 1e-3
"""Share by which the limits of a triad's axes may differ, by corrections of each."""

LEAST = 0.5
"""Share of a declared range, or of what another axis of the triad shows, below which no sensor is
clipped: a coarse converter shows a steady turn, the fastest of a log, by two or three values as
well."""


SHOWN = 5
"""Samples of an axis that must go so far: fewer may be spikes."""


def known_part(declared: Part | None, recording: Recording, rest: Rest) -> Part:
    """The part as the filter takes it; without one, the noise of the samples at rest."""
    if declared is None:
        tolerances = (*unknown_tolerances(), *_null(rest))
        part = replace(nominal_part(recording, rest), tolerances=tolerances)
        own = Part(part.name, part.sample_rate)
    else:
        part, own = informed(declared, recording, rest), declared
    sensors = []
    for kind in ("gyro", "accel"):
        sensor, samples = part.sensor(kind), getattr(recording, kind)
        if declared is None or of_a_sensor(declared):
            sensor = _with_touched_limit(sensor, samples)
        sensors.append(_with_true_limit(sensor, own.sensor(kind), samples))
    gyro, accel = sensors
    return replace(part, gyro=gyro, accel=accel)


def unknown_tolerances() -> tuple[Tolerance, ...]:
    """How far scale factors and axes of sensors may be off of which nothing is known.

    A gyro's scale factor is that of ``NOMINAL_SCALE_STD``; the others what ``typical.toml`` has of
    a consumer part, whose data sheets quote limits.
    """
    found = [Tolerance(("gyro", "scale_factor", "s"), (NOMINAL_SCALE_STD,) * 3, "normal")]
    for key in (
        ("accel", "scale_factor", "s"),
        ("gyro", "misalignment", "m"),
        ("accel", "misalignment", "m"),
    ):
        kind, effect, _ = key
        most = magnitudes(effect, kind)["consumer"].si
        free = len(CATALOGUE[effect].parameters[key[2]].indices)
        found.append(Tolerance(key, (most,) * free, "uniform"))
    return tuple(found)


def _null(rest: Rest) -> tuple[Tolerance, ...]:
    """How far the null of an unknown gyro may lie from zero, whose rest shows a large one."""
    size = float(np.max(np.abs(rest.rate), initial=0.0))
    if not rest.seen or size <= LARGEST_RATE:
        return ()
    return (Tolerance(("gyro", "turn_on_bias", "b0"), (size,) * 3, "normal"),)


def _with_touched_limit(sensor: Sensor, samples: np.ndarray) -> Sensor:
    """The sensor with the limits of axes (n, 3) that touch one too seldom for a plateau."""
    effect, parameter = read_off(CATALOGUE.values(), "ceiling")
    limit = np.array(sensor.values.get(effect, {}).get(parameter, np.zeros(3)))
    for axis, column in enumerate(samples.T):
        seen = [abs(level) for level in touched_level(column) if level is not None]
        limit[axis] = min([*seen, limit[axis] or np.inf]) if seen else limit[axis]
    return sensor.with_values(effect, **{parameter: limit}) if limit.any() else sensor


def _with_true_limit(sensor: Sensor, own: Sensor, samples: np.ndarray) -> Sensor:
    """The sensor without a limit that was read off the samples and is none."""
    effect, parameter = read_off(CATALOGUE.values(), "ceiling")
    if effect not in sensor.values:
        return sensor
    limit = np.array(sensor.values[effect][parameter])
    declared = own.values.get(effect, {}).get(parameter, np.zeros(3))
    shown = np.sort(np.nan_to_num(np.abs(samples)), axis=0)[-SHOWN:][0].max()
    least = LEAST * np.maximum(declared, shown)
    for axis, column in enumerate(samples.T):
        narrow = min(limit[axis], np.nanmax(column) - np.nanmin(column))
        none = narrow <= STEPS * _step(column) or limit[axis] < least[axis]
        if limit[axis] != declared[axis] and none:
            limit[axis] = declared[axis]
    limit = _of_triad(limit, samples)
    if not limit.any() and effect not in own.values:
        return Sensor(sensor.kind, {k: v for k, v in sensor.values.items() if k != effect})
    return sensor.with_values(effect, **{parameter: limit})


def _of_triad(limit: np.ndarray, samples: np.ndarray) -> np.ndarray:
    """The limits (3,) of a triad, whose axes have one range: an axis of which none was seen has
    that of another that it reaches and never passes, however short its samples stay there.
    """
    found = limit.copy()
    for axis, most in enumerate(np.nanmax(np.abs(samples), axis=0)):
        near = limit[(limit > 0) & (np.abs(most / np.where(limit > 0, limit, np.inf) - 1) < SAME)]
        if not limit[axis] and len(near):
            found[axis] = most
    return found


def _step(column: np.ndarray) -> float:
    """The smallest step between two values of a column, rounding apart."""
    values = np.unique(column[np.isfinite(column)])
    steps = np.diff(values)
    large = steps[steps > 1e-9 * np.max(np.abs(values), initial=0.0)]
    return float(large.min()) if len(large) else 0.0
