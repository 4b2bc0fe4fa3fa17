"""Knocks on a sensor that lies still: found by the second, and left out of its noise.

A knock rings on several axes at once, for a fraction of a second, and has as much energy as the
noise of minutes to hours: left in, one makes N twice as large, a line of the mounting's ringing and
a roll-off of a bandwidth that no sensor has.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from pyimu.characterization.samples import PIECE, Samples
from pyimu.errors import Finding
from pyimu.model.part import AXES
from pyimu.numerics.laws import norm
from pyimu.recording.rest import ONE_SHOCK, RARE, SECOND

CHANCE = 1e-3
"""Probability that noise alone makes a column's loudest second a loud one, in a log of any length.
Two columns at once are asked for, so that a log of noise loses a second once in a million."""

TOGETHER = 2
"""Columns that a knock shakes at once. Bursts and steps of one alone are its own noise."""

LEAST = 8
"""Seconds from which the quartiles of a column's are taken."""

QUARTILES = 1.349
"""Distance of a normal distribution's quartiles in standard deviations."""


@dataclass(frozen=True)
class _Loud:
    """A loud second of the column ``name``: from sample ``first`` at ``time`` [s] on."""

    name: str
    time: float
    first: int


def without_shocks(
    sensors: Mapping[str, Samples], ignored: Container[str] = ()
) -> tuple[dict[str, Samples], list[Finding]]:
    """The sensors with the segments cut where they were knocked, and a finding ``shocks`` a column.

    The finding has the number of seconds, the ``largest`` distance of a sample from its second's
    mean [rad/s or m/s^2], and the ``first_row`` of the log in which the first shock is largest. The
    columns ``ignored`` are not looked at. Nothing is left out where more than ``RARE`` of the
    seconds are loud: that is no shock, it is how the log is.
    """
    loud = [v for s in sensors.values() for v in _loud(s, ignored)]
    knocks = _together(loud)
    seconds = len({round(v.time / SECOND) for v in knocks})
    total = max((len(s) * s.h / SECOND for s in sensors.values()), default=0.0)
    if not knocks or seconds > max(RARE * total, ONE_SHOCK):
        return dict(sensors), []
    times = np.unique([v.time for v in knocks])
    findings = [f for s in sensors.values() for f in _findings(s, knocks)]
    return {k: _cut(s, times) for k, s in sensors.items()}, findings


def _together(loud: list[_Loud]) -> list[_Loud]:
    """Those within a second of which ``TOGETHER`` columns are loud: the seconds of two sensors
    begin anywhere.
    """
    loud = sorted(loud, key=lambda v: v.time)
    times = np.array([v.time for v in loud])
    first = np.searchsorted(times, times - SECOND, side="right")
    stop = np.searchsorted(times, times + SECOND)
    names = ({v.name for v in loud[a:b]} for a, b in zip(first, stop, strict=True))
    return [v for v, at in zip(loud, names, strict=True) if len(at) >= TOGETHER]


def _loud(samples: Samples, ignored: Container[str]) -> Iterator[_Loud]:
    """The loud seconds of the columns of a sensor.

    The cube root of a chi-squared is all but normal (Wilson and Hilferty 1931), of however many
    degrees of freedom: those of filtered noise show in the quartiles.
    """
    length = max(round(SECOND / samples.h), 1)
    for axis, column in zip(AXES, samples.columns, strict=True):
        name = f"{samples.kind}_{axis}"
        if name in ignored or length < 3:
            continue
        first, variance = _seconds(column, samples.segments, length)
        if len(first) < LEAST:
            continue
        root = np.cbrt(variance)
        low, middle, high = np.percentile(root, (25, 50, 75))
        # No noise has more degrees of freedom than samples: rounding may hide its scatter.
        scatter = max((high - low) / QUARTILES, middle * np.sqrt(2 / (9 * (length - 2))))
        beyond = middle + norm.isf(CHANCE / len(first)) * scatter
        for row in first[root > beyond] if middle > 0 else ():
            yield _Loud(name, float(samples.time[row]), int(row))


def _seconds(
    column: np.ndarray, segments: list[tuple[int, int]], length: int
) -> tuple[np.ndarray, np.ndarray]:
    """First sample and variance of each second of ``length`` samples, (k,) and (k,).

    The sample farthest from the others is left out of the variance: a corrupt row is alone, and
    counts as a spike.
    """
    first, variance = [np.empty(0, dtype=int)], [np.empty(0)]
    for start, stop in segments:
        for a in range(start, stop - length + 1, max(PIECE // length, 1) * length):
            count = min((stop - a) // length, max(PIECE // length, 1))
            values = np.array(column[a : a + count * length]).reshape(count, length)
            square = (values - values.mean(axis=1, keepdims=True)) ** 2
            # What is left of a sum of squares about the mean once the mean is that of the others.
            left = square.sum(axis=1) - square.max(axis=1) * length / (length - 1)
            first.append(a + length * np.arange(count))
            variance.append(np.maximum(left, 0.0) / (length - 2))
    return np.concatenate(first), np.concatenate(variance)


def _findings(samples: Samples, knocks: list[_Loud]) -> Iterator[Finding]:
    """A finding ``shocks`` for each column of a sensor that was knocked."""
    length = max(round(SECOND / samples.h), 1)
    for axis, column in zip(AXES, samples.columns, strict=True):
        name = f"{samples.kind}_{axis}"
        rows = sorted(v.first for v in knocks if v.name == name)
        if not rows:
            continue
        seconds = [np.array(column[row : row + length]) for row in rows]
        far = [np.abs(values - values.mean()) for values in seconds]
        detail = {
            "largest": float(max(d.max() for d in far)),
            "first_row": samples.row(rows[0] + int(np.argmax(far[0]))),
        }
        yield Finding("shocks", name, len(rows), detail)


def _cut(samples: Samples, times: np.ndarray) -> Samples:
    """The samples in segments that leave out the seconds from ``times`` (k,) on.

    The second before and the one after go with them, in which a knock may begin and ring on.
    """
    begins = np.searchsorted(samples.time, times - SECOND).tolist()
    ends = np.searchsorted(samples.time, times + 2 * SECOND).tolist()
    kept = list(samples.segments)
    for begin, end in zip(begins, ends, strict=True):
        kept = [
            (a, b)
            for start, stop in kept
            for a, b in ((start, min(stop, begin)), (max(start, end), stop))
            if b > a
        ]
    return replace(samples, segments=kept)
