"""By how much a recording's headings are late, where no column says so: by the gyro's own course.

Compasses are smoothed, and satellite receivers take their time. A heading that belongs to an
earlier attitude is off by the turn since then, in the one sense while the body turns to the left
and in the other while it turns to the right: that tells its lag from an error of the heading.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from pyimu.attitude.columns import recorded_heading
from pyimu.attitude.headed import LEVEL
from pyimu.errors import Finding
from pyimu.recording.recording import Recording

WINDOW = 20.0
"""s; in each a constant and an even turn are taken off, which are the offset and the gyro's bias:
nobody knows them, and a bias does not change by much meanwhile."""

LEAST = 4
"""Headings in a window with which it tells something beside these two."""

WINDOWS = 3.0
"""Windows that must tell a lag, those of a small share of it counted as less than one."""

LATEST, STEP = 2.0, 0.05
"""s; the largest lag that is looked for, and the steps in which it is."""

SIGMAS = 4.0
"""Standard errors from zero from which on a lag is believed."""

BY_CHANCE = 1e-3
"""Likelihood of no lag over that of the lag that is found, below which it is believed."""

WILD = 3.0
"""Standard deviations from which on a heading counts less, as one near iron may be anything."""

ROUNDS = 5
"""In which the lag is refined: it then stands to a thousandth of its standard error."""

Course = Callable[[np.ndarray], np.ndarray]
"""The yaw in rad at times in s, beside a constant and a slow drift, without wraps."""


def late_finding(recording: Recording, q: np.ndarray) -> Finding | None:
    """A finding ``heading_late`` where the headings lag behind the attitude ``q`` (n, 4).

    That is the filter's without headings and without magnetometer. The ``lag`` in s is that of the
    least weighted squares of what the headings miss its yaw by, a constant and an even turn in each
    window beside. Its ``std`` is by the scatter of the windows' own scores (White 1980, for
    clusters), at least that of independent headings: what lasts for seconds in a compass then
    counts as it is. Beside that is the rounding of an age to samples. It is said where it is
    ``SIGMAS`` of them, and where by errors with the density of Laplace no lag is less likely by
    ``BY_CHANCE``. A body that sways evenly shows several lags alike: the least of them counts.
    """
    headings = _headings(recording, q)
    if headings is None:
        return None
    course, n = _course(recording.time, q), len(headings.time)
    grid = np.arange(0.0, LATEST + STEP / 2, STEP)
    missed = np.array([headings.missed_by(course, lag) for lag in grid])
    least = (missed <= np.append(missed[1:], np.inf)) & (missed < np.insert(missed[:-1], 0, np.inf))
    found = [_refined(headings, course, lag) for lag in grid[least].tolist()]
    by_lag = np.array([headings.missed_by(course, lag) for lag, _ in found])
    alike = n * np.log(by_lag / max(by_lag.min(), 1e-12)) < -np.log(BY_CHANCE)
    lag, std = found[int(np.argmax(alike))]
    std = float(np.hypot(std, recording.sample_period / np.sqrt(12)))
    likelier = n * np.log(missed[0] / max(by_lag[np.argmax(alike)], 1e-12))
    if not SIGMAS * std < lag <= LATEST or likelier < -np.log(BY_CHANCE):
        return None
    return Finding("heading_late", "heading", n, {"lag": lag, "std": std})


def timed(recording: Recording, found: Finding) -> Recording:
    """The recording with the age of its headings that was ``found``, without those that were true
    before it begins.
    """
    n, lag = len(recording.time), float(found.detail["lag"])
    before = recording.time - recording.time[0] < lag
    heading = np.where(before, np.nan, recording.heading)
    return replace(recording, heading=heading, heading_age=np.full(n, lag))


@dataclass(frozen=True)
class Headings:
    """Headings (m,) in rad at the ``time`` (m,) in s with the ``weight`` (m,) in 1/rad^2.

    ``window`` (m,) is the number of that of each, ``since`` (m,) the time in s since its middle.
    """

    time: np.ndarray
    angle: np.ndarray
    weight: np.ndarray
    window: np.ndarray
    since: np.ndarray

    def off(self, course: Course, lag: float, weight: np.ndarray) -> np.ndarray:
        """What they miss the ``course`` of ``lag`` s before by, rad (m,)."""
        off = self.angle - course(self.time - lag)
        mean = np.angle(self.summed(weight * np.exp(1j * off)))[self.window]
        return self.left(np.angle(np.exp(1j * (off - mean))), weight)

    def left(self, values: np.ndarray, weight: np.ndarray) -> np.ndarray:
        """The ``values`` (m,) without the line of each window that fits them best."""
        whole = np.maximum(self.summed(weight), 1e-300)
        since = self.since - (self.summed(weight * self.since) / whole)[self.window]
        values = values - (self.summed(weight * values) / whole)[self.window]
        square = np.maximum(self.summed(weight * since**2), 1e-300)
        return values - since * (self.summed(weight * since * values) / square)[self.window]

    def summed(self, values: np.ndarray) -> np.ndarray:
        """The sums of ``values`` (m,) of each window; they may be complex."""
        out = np.zeros(int(self.window.max()) + 1, dtype=values.dtype)
        np.add.at(out, self.window, values)
        return out

    def missed_by(self, course: Course, lag: float) -> float:
        """The sum of what they miss the course by, in standard deviations."""
        off = self.off(course, lag, self.weight)
        return float(np.sum(np.abs(off) * np.sqrt(self.weight)))


def _headings(r: Recording, q: np.ndarray) -> Headings | None:
    """The headings of a body whose x axis has had one for ``LATEST`` s, in windows with enough of
    them.
    """
    angle, std = recorded_heading(r)
    w, x, y, z = q.T
    usable = np.isfinite(angle) & np.isfinite(std) & (std > 0)
    steep = np.cumsum(2 * np.abs(x * z - w * y) > np.sqrt(1 - LEVEL**2))
    usable &= steep == steep[np.maximum(np.searchsorted(r.time, r.time - LATEST - STEP) - 1, 0)]
    usable &= r.time - r.time[0] > LATEST
    rows = np.flatnonzero(usable)
    number = ((r.time[rows] - r.time[0]) // WINDOW).astype(int)
    there, window, counts = np.unique(number, return_inverse=True, return_counts=True)
    enough = counts[window] >= LEAST
    if not enough.any():
        return None
    rows, number = rows[enough], number[enough]
    since = r.time[rows] - r.time[0] - (number + 0.5) * WINDOW
    window = np.unique(number, return_inverse=True)[1]
    return Headings(r.time[rows], angle[rows], 1 / std[rows] ** 2, window, since)


def _course(time: np.ndarray, q: np.ndarray) -> Course:
    w, x, y, z = q.T
    yaw = np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    return lambda at: np.interp(at, time, yaw)


def _refined(headings: Headings, course: Course, lag: float) -> tuple[float, float]:
    """The lag in s next to one that is right to a ``STEP``, and its standard error.

    That is infinite where fewer than ``WINDOWS`` tell it: their scatter is then not known.
    """
    weight, std = headings.weight, np.inf
    for _ in range(ROUNDS):
        off = headings.off(course, lag, weight)
        early, late = (course(headings.time - lag + s * STEP / 2) for s in (1, -1))
        slope = headings.left((early - late) / STEP, weight)
        square = float(np.sum(weight * slope**2))
        told = headings.summed(weight * slope**2)
        if square <= 0 or square**2 < WINDOWS * np.sum(told**2):
            return lag, np.inf
        score = weight * slope * off
        lag -= float(np.sum(score)) / square
        free = max(len(off) - 2 * int(headings.window.max() + 1) - 1, 1)
        alone = np.sum(score**2) * len(off) / free
        std = float(np.sqrt(max(alone, np.sum(headings.summed(score) ** 2)))) / square
        size = np.abs(off) * np.sqrt(headings.weight)
        usual = max(float(np.median(size)) / 0.6745, 1e-12)
        weight = headings.weight * np.minimum(1, WILD * usual / np.maximum(size, 1e-12))
    return lag, std
