"""Scale factor, bias and the reference's clock from a known motion, by the regression of the loop.

Measured on true, r_m(t) = (1 + s) r(t + late) + b + noise: the reference is the regressor, so the
gyro's noise pulls nothing. What is left is whitened as white noise plus random walk, fitted to it
(``pyimu.identification.fit.whiten``), and the normal equations are those of ``pyimu close``. How
late the reference is, of either sign, is a third coefficient: a reference that is late by d shows
at t + d what the gyro measured at t.

A heading is differenced over windows. Its own noise makes neighbouring differences opposite, from
which its size follows; the windows are as long as keeps what it pulls of s (errors in variables,
var(noise)/var(rate)) below a fifth of the standard error.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from pyimu.heading.calibration import (
    Calibration,
    check_seen,
    checked,
    condition_number,
    observed,
)
from pyimu.heading.motion import KnownMotion, Reference, Z, known_motion
from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.keys import Coefficient, Key, LogBias, LogClock
from pyimu.identification.fit.normal import normal_equations, solve, variances
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.recording.recording import Recording

LATEST = 1.0
"""s; by how much clocks are looked for at most: those of two computers that were set by hand."""

ROUNDS = 12
"""Steps of Gauss and Newton, at most: each squares the error of the one before, and the noise is
fitted anew in each."""

SETTLED = 1e-12
"""Change of scale factor, bias [rad/s] and clock [s] below which a step was the last."""

PULLED = 0.2
"""Share of its standard error by which the reference's noise may pull the scale factor."""

LONGEST_WINDOW = 5.0
"""s; longer windows would average over the turns themselves."""


@dataclass(frozen=True)
class _Truth:
    """The reference as a function of time, segment by segment: a spline of heading or rate."""

    one: KnownMotion
    reference: Reference
    splines: list[CubicSpline]

    @classmethod
    def of(cls, one: KnownMotion, reference: Reference) -> _Truth:
        values = one.heading if reference == "heading" else one.rate
        return cls(
            one, reference, [CubicSpline(one.time[a:b], values[a:b]) for a, b in one.segments]
        )

    def rows(self, late: float, window: int) -> Rows:
        """What a reference that is ``late`` by so many s says of windows of so many rows."""
        parts = [self._of_segment(k, late, window) for k in range(len(self.splines))]
        ends = np.cumsum([len(p[0]) for p in parts]).tolist()
        segments = [(a, b) for a, b in zip([0, *ends[:-1]], ends, strict=True) if b > a]
        return Rows(*(np.concatenate(v) for v in zip(*parts, strict=True)), segments)

    def _of_segment(self, k: int, late: float, window: int) -> tuple[np.ndarray, ...]:
        (a, b), spline, h = self.one.segments[k], self.splines[k], self.one.period
        first = a + (self.reference == "heading")
        count = (b - first) // window
        rows = first + np.arange(count * window).reshape(count, window)
        time, measured = self.one.time[rows], self.one.measured[rows].mean(axis=1)
        begin, end = time[:, 0] - h + late, time[:, -1] + late
        if self.reference == "heading":
            span = np.maximum(end - begin, h)
            rate = (spline(end) - spline(begin)) / span
            slope = (spline(end, 1) - spline(begin, 1)) / span
        else:
            rate, slope = (spline(time + late, n).mean(axis=1) for n in (0, 1))
            begin = begin + h
        # Half a period of what lies beside the reference is no invention, more is.
        inside = (begin >= spline.x[0] - h / 2) & (end <= spline.x[-1] + h / 2)
        return time[inside, -1], measured[inside], rate[inside], slope[inside]


@dataclass(frozen=True)
class Rows:
    """Rows (m,): ``time`` s, ``measured`` and true ``rate`` rad/s, its ``slope`` rad/s^2."""

    time: np.ndarray
    measured: np.ndarray
    rate: np.ndarray
    slope: np.ndarray
    segments: list[tuple[int, int]]


def fit(
    recording: Recording, reference: Reference | None = None, offset: bool = True
) -> Calibration:
    """The calibration of the gyro about the vertical by generalised least squares.

    ``offset`` says whether the reference's clock is estimated; without it the two are taken to
    agree. Without ``reference`` it is the one that the log has, the heading where it has both.

    Raises UserError as ``self_calibrate`` does.
    """
    one = known_motion(recording, reference)
    reference = reference or one.references[0]
    rate, seen = observed(one, reference)
    check_seen(one, *seen)
    truth, window = _Truth.of(one, reference), 1
    late = _roughly_late(one, rate) if offset else 0.0
    while True:
        found, pulled = _solved(truth, late, window, offset)
        longer = reference == "heading" and 2 * window * one.period <= LONGEST_WINDOW
        if pulled <= PULLED * found.s_std or not longer:
            return checked(found)
        window *= 2


def _roughly_late(one: KnownMotion, rate: np.ndarray) -> float:
    """How late the reference is to a sample, by the correlation of the two rates."""
    most = min(round(LATEST / one.period), len(rate) // 4)
    measured, true = one.measured - one.measured.mean(), rate - rate.mean()
    n = len(rate)
    shifts = np.arange(-most, most + 1)
    along = [
        measured[max(-k, 0) : n - max(k, 0)] @ true[max(k, 0) : n - max(-k, 0)] / (n - abs(k))
        for k in shifts
    ]
    return float(shifts[np.argmax(along)] * one.period)


def _solved(truth: _Truth, late: float, window: int, offset: bool) -> tuple[Calibration, float]:
    """The calibration over windows of so many rows, and by how much the reference's noise may have
    pulled s.
    """
    name, s, b = truth.one.name, 0.0, 0.0
    keys: list[Key] = [Coefficient("scale_factor", "s", (Z,)), LogBias(name, Z)]
    keys += [LogClock(name, 0)] * offset
    for _ in range(ROUNDS):
        rows = truth.rows(late, window)
        left = rows.measured - (1 + s) * rows.rate - b
        columns = np.column_stack([rows.rate, np.ones(len(left)), (1 + s) * rows.slope])
        columns = columns[:, : len(keys)]
        # The first step is far from the noise: what is left of it is the scale factor.
        if s == b == 0.0:
            first = np.linalg.lstsq(columns[:, :2], left)[0]
            noise = RandomWalk.fit([(left - columns[:, :2] @ first, rows.time, rows.segments)])
        else:
            noise = RandomWalk.fit([(left, rows.time, rows.segments)])
        # The bias is that of a row before the first: else that one row would weigh more than all
        # others together where there is walk and next to no white noise.
        noise = replace(noise, before=window * truth.one.period)
        linear = Linear(rows.time, rows.segments, left[:, None], {0: keys}, {0: columns})
        normal = normal_equations([linear], {0: noise})
        change = solve(normal.gram, normal.score)
        s, b = s + float(change[0]), b + float(change[1])
        late += float(change[2]) if offset else 0.0
        if np.max(np.abs(change)) < SETTLED:
            break
    covariance = np.linalg.pinv(normal.gram)
    std = np.sqrt(variances(normal.gram))
    found = _calibration(truth, rows, (s, b), covariance, columns, noise, window)
    if offset:
        found = replace(found, late=late, late_std=float(std[2]))
    return found, _pulled(truth, rows, left - columns @ change, window)


def _calibration(truth, rows, found, covariance, columns, noise, window) -> Calibration:
    s, b = found
    left = rows.measured - (1 + s) * rows.rate - b
    slope = np.array([[-1.0, 0.0], [b / (1 + s), -1.0]]) / np.array([[(1 + s) ** 2], [1 + s]])
    steps = truth.one.period * window
    return Calibration(
        f"{truth.reference} reference, whitened",
        truth.one.name,
        1.0 / (1 + s),
        -b / (1 + s),
        covariance=slope @ covariance[:2, :2] @ slope.T,
        condition=condition_number(columns[:, :2]),
        residual=float(np.sqrt(left @ left / len(left))),
        rows=len(left),
        seconds=len(left) * steps,
        segments=len(rows.segments),
        noise=(float(np.sqrt(noise.r * steps)), float(np.sqrt(noise.k2))),
        window=window,
    )


def _pulled(truth: _Truth, rows: Rows, left: np.ndarray, window: int) -> float:
    """Share of s that the noise of a heading reference takes away.

    White noise of variance v makes neighbouring differences over a window T have the covariance
    -v/T^2, and each the variance 2 v/T^2. Of a random walk neighbours have none.
    """
    if truth.reference == "rate":
        return 0.0
    smooth = np.diff(left)
    # Of the differences of what is left, so that a slow walk has no part in it: with g0 and g1 the
    # variance and the covariance of neighbours of white plus difference noise, the covariances
    # of the differences two and one rows apart give g1 alone.
    lag = [smooth[k:] @ smooth[: len(smooth) - k] / max(len(smooth) - k, 1) for k in (0, 1, 2)]
    opposite = max(-(lag[0] + lag[1]) - lag[2], 0.0) if len(smooth) > 3 else 0.0
    return 2 * opposite / max(float(np.var(rows.rate)), 1e-300)
