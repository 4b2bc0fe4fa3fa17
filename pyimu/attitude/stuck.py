"""How long samples must repeat for a sensor to be stuck, by the samples of a log themselves."""

from __future__ import annotations

import numpy as np

from pyimu.attitude.rest import Rest
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.clock import runs
from pyimu.recording.quality.resolution import quantization_step
from pyimu.recording.quality.stuck import longest_chance_run
from pyimu.recording.recording import Recording

LEAST, LEAST_SAMPLES, RUNS = 0.5, 20, 5
"""A triad is called stuck after that many s, that many samples, and that many times the longest run
of equal samples in its rest, whichever is longest; an axis, whose triad goes on, by the last two.
"""

COARSE = 1.7
"""Steps are coarse if they are larger than this many standard deviations of a sample at rest. With
noise of half a step that standard deviation is 0.58 of a step; where a sample with next to no noise
changes between two values it is half a step at most."""

FIRST = 65_536
"""Samples in which the step of a sensor is looked for."""

WINDOW, WINDOWS = 1024, 256
"""Samples of a window in which repeats are counted, and so many windows spread over a log."""


def stuck_times(recording: Recording, part: Part, rest: Rest) -> dict[str, float]:
    """Settings that follow from the log's own samples: how long they must repeat to be stuck.

    Never (0) where sensors have no noise, or steps coarser than their noise: equal samples then say
    nothing.
    """
    triads = [
        (part.gyro, recording.gyro, rest.rate_std),
        (part.accel, recording.accel, rest.force_std),
    ]
    h, at_rest = recording.sample_period, rest.rows.stop - rest.rows.start
    longest, coarse, axes = 0, False, np.zeros((2, 3))
    for i, (sensor, values, std) in enumerate(triads):
        if values is not None:
            step, still = _step(sensor, values), values[rest.rows]
            longest = max(longest, _longest_run(np.all(np.diff(still, axis=0) == 0, axis=1)))
            coarse |= bool(np.all(step > COARSE * std))
            axes[i] = [_axis_run(values, still, step[k], k) for k in range(3)]
    times = {f"axis_stuck_time[{i + 1}]": run * h for i, run in enumerate(axes.ravel().tolist())}
    if coarse or longest > at_rest / 4:
        return times | {"stuck_time": 0.0}
    return times | {"stuck_time": max(LEAST, LEAST_SAMPLES * h, RUNS * longest * h)}


def _axis_run(values: np.ndarray, still: np.ndarray, step: float, axis: int) -> float:
    """So many repeats of an axis of a triad (n, 3) are no chance while its others change; 0: never.

    ``still`` (m, 3) are those of its rest, ``step`` is that between its values.
    """
    at_rest = _longest_run(np.diff(still[:, axis]) == 0)
    windows = _windows(values, axis)
    if at_rest > len(still) / 4 or not windows:
        return 0.0
    noise = min(float(np.diff(v, 3).std()) / np.sqrt(20) for v in windows)
    chance = longest_chance_run([np.diff(v) == 0 for v in windows], len(values))
    if noise == 0 or step > COARSE * noise or not np.isfinite(chance):
        return 0.0
    return max(LEAST_SAMPLES, RUNS * at_rest, chance)


def _windows(values: np.ndarray, axis: int) -> list[np.ndarray]:
    """The samples of an axis of a triad (n, 3) in windows spread over a log.

    Left out are missing samples, rows in which the whole triad repeats, and of each window its
    longest run, in which the axis may be stuck. A window that is such a run in its greater part
    tells nothing: the noise may be far below the step, too.
    """
    size = min(WINDOW, len(values))
    count = min(WINDOWS, max(len(values) // size, 1))
    found = []
    for start in np.linspace(0, len(values) - size, count).astype(int):
        rows = values[start : start + size]
        column = rows[np.append(True, np.any(np.diff(rows, axis=0) != 0, axis=1)), axis]
        column = column[np.isfinite(column)]
        same = np.diff(column) == 0
        first, stop = max(runs(same), key=lambda run: run[1] - run[0], default=(0, 0))
        if len(column) >= LEAST_SAMPLES and 2 * (stop - first) <= len(column):
            found.append(np.delete(column, slice(first, stop)))
    return found


def _longest_run(same: np.ndarray) -> int:
    """The largest number of flags (n,) in succession that hold."""
    return max((stop - start for start, stop in runs(same)), default=0)


def _step(sensor: Sensor, values: np.ndarray) -> np.ndarray:
    """The step (3,) between the values that an output can have, 0 where there is none.

    It is that of the first samples, or the sensor's declared one if that is larger.
    """
    found = [quantization_step(column) or 0.0 for column in values[:FIRST].T]
    declared = sensor.reading("step")
    step = 0.0 if declared is None else sensor.values[declared[0]][declared[1]]
    return np.maximum(found, step)
