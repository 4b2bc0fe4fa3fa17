"""Samples at the level where an output stops, or set to zero, in rows that a band makes of many.

A sample there says nothing but that the input was beyond. The model says so too, but of a reference
with noise not of the same samples: where the input is about to reach the level the mean of what
stops is below what the mean makes, and a band spreads that over the rows about it, as a lag or a
bend of the scale factor would have it. Which samples lie there the samples themselves tell, and
these count for nothing: what is measured and what is modelled of them are taken for the same. Of a
sample in a hard dead zone the same is true: the model's zone takes in other ones.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.ndimage import maximum_filter1d

from pyimu.identification.fit.sample_noise import rest_noise
from pyimu.identification.fit.trial import Trial, marked
from pyimu.model.sensor import Sensor
from pyimu.recording.quality.clipping import clipping_level

CEILING, THRESHOLD = "ceiling", "threshold"

CHANCE = 4.0
"""Standard deviations of its noise within which a sample is at a level by chance."""

OVER, LEAST_OVER = 1.02, 5
"""Multiple of a level from which on samples are beyond it, and how many show that it is none."""

NEARLY = 0.8
"""Share of a level from which on samples that pile up are at it on their side."""

ABOUT = 2
"""Samples on either side of one at a level that may be there but for their noise: leaving out those
alone that are would keep one half of it."""


def ceiling_levels(sensor: Sensor) -> np.ndarray:
    """The levels (3,) at which the output of a sensor stops, zero where it does not."""
    return _levels(sensor, CEILING)


def _levels(sensor: Sensor, what: str) -> np.ndarray:
    """The coefficient (3,) of a sensor that is read off samples as ``what``."""
    found = sensor.reading(what)
    return np.zeros(3) if found is None else np.array(sensor.values[found[0]][found[1]])


def with_limited(sensor: Sensor, trial: Trial) -> Trial:
    """A trial with the samples marked that lie at the levels of a sensor or in its hard dead zone,
    and those beside them, where its band would spread them; as it is where samples lie beyond the
    levels, which are none of theirs then.
    """
    if trial.band_hz is None:
        return trial
    found = [_at_levels(sensor, trial), _in_zone(sensor, trial)]
    each = [v for v in found if v is not None]
    if not each:
        return trial
    at = np.any(each, axis=0)
    for a, b in trial.segments:
        at[a:b] = maximum_filter1d(at[a:b], 2 * ABOUT + 1, axis=0, mode="nearest")
    return replace(trial, limited=at)


def _in_zone(sensor: Sensor, trial: Trial) -> np.ndarray | None:
    """The samples (n, 3) that are zero on axes with a hard dead zone; None without one."""
    zones = _levels(sensor, THRESHOLD) > 0.0
    return (as_sampled(trial) == 0.0) & zones if zones.any() else None


def as_sampled(trial: Trial) -> np.ndarray:
    """What a trial's sensor gave (n, 3), with what was taken off of what looks like a spike."""
    return trial.y if trial.healed is None else trial.y + trial.healed


def _at_levels(sensor: Sensor, trial: Trial) -> np.ndarray | None:
    """The samples (n, 3) that lie at the levels of a sensor; None where there are none, or where
    others lie beyond.
    """
    levels = ceiling_levels(sensor)
    if not levels.any():
        return None
    noise, y = CHANCE * np.nan_to_num(rest_noise(trial)), np.abs(trial.y)
    over = (y > OVER * levels + noise) & (levels > 0.0)
    over &= marked(trial.segments, len(y))[:, None]
    if trial.healed is not None:
        over &= trial.healed == 0.0
    if (over.sum(axis=0) >= LEAST_OVER).any():
        return None
    low, high = _sides(trial.y, levels)
    return ((trial.y > high - noise) | (trial.y < noise - low)) & (levels > 0.0)


def _sides(y: np.ndarray, levels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sizes (3,) of the least and of the largest output: of ``levels``, or smaller where samples
    pile up on one side before that, as a bias after the clipping has them.
    """
    found = [[abs(v or 0.0) for v in clipping_level(column)] for column in y.T]
    low, high = np.array(found).T
    return tuple(np.where(v > NEARLY * levels, np.minimum(v, levels), levels) for v in (low, high))


def without_limit(sensor: Sensor, trial: Trial) -> tuple[Sensor, np.ndarray | None]:
    """A sensor as those samples show it that do not lie where its output stops or is zero, and what
    each (n, 3) counts for, None where all do and the sensor is as it was.
    """
    had = [(what, _levels(sensor, what) > 0.0) for what in (CEILING, THRESHOLD)]
    stopped = np.any([axes for _, axes in had], axis=0)
    if trial.limited is None or not stopped.any():
        return sensor, None
    for what, axes in had:
        sensor = sensor.without(sensor.reading(what)[0]) if axes.any() else sensor
    return sensor, np.where(trial.limited & stopped, 0.0, 1.0)
