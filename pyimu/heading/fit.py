"""Scale factor, bias and the reference's clock from a known motion, by the regression of the loop.

Measured on true, r_m(t) = (1 + s) r(t + late) + b + noise: the reference is the regressor, so the
gyro's noise pulls nothing. What is left is whitened as white noise plus random walk, fitted to it
(``pyimu.identification.fit.whiten``), and the normal equations are those of ``pyimu close``. How
late the reference is, of either sign, is a third coefficient: a reference that is late by d shows
at t + d what the gyro measured at t.

A heading is differenced over windows. Its own noise makes neighbouring differences opposite, from
which its size follows; the windows are as long as keeps what it pulls of s (errors in variables,
var(noise)/var(rate)) below a fifth of the standard error, and within a window the heading is
smoothed by a cubic, for else a clock offset of half a sample, where interpolation averages two,
would look better than any other.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import savgol_filter

from pyimu.errors import UserError
from pyimu.heading.calibration import (
    Calibration,
    check_seen,
    checked,
    condition_number,
    observed,
)
from pyimu.heading.motion import KnownMotion, Reference, Z, known_motion
from pyimu.identification.fit.columns import Linear, Stack
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

CUBIC = 3
"""Order of the polynomials that smooth a heading."""

LONGEST_WINDOW = 5.0
"""s; longer windows would average over the turns themselves."""


@dataclass(frozen=True)
class _Truth:
    """The reference as a function of time, segment by segment: a spline of heading or rate."""

    one: KnownMotion
    reference: Reference
    splines: list[CubicSpline]

    @classmethod
    def of(cls, one: KnownMotion, reference: Reference, window: int) -> _Truth:
        values = one.heading if reference == "heading" else one.rate
        splines = [
            CubicSpline(one.time[a:b], _smoothed(values[a:b], window)) for a, b in one.segments
        ]
        return cls(one, reference, splines)

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
    window = _window(one, rate) if reference == "heading" else 1
    truth = _Truth.of(one, reference, window)
    late = _roughly_late(one, rate) if offset else 0.0
    return checked(_solved(truth, late, window, offset))


def _window(one: KnownMotion, rate: np.ndarray) -> int:
    """Samples of a window, by what the noise of a heading reference would pull s over one.

    White noise of variance v makes neighbouring differences over T have the covariance -v/T^2, and
    each the variance 2 v/T^2; the gyro's own N^2/T has no such covariance.
    """
    columns = np.column_stack([rate, np.ones(len(rate))])
    left = one.measured - columns @ np.linalg.lstsq(columns, one.measured)[0]
    # By differences of what is left, so that a slow walk has no part in it.
    change = np.diff(left)
    lag = [
        float(change[k:] @ change[: len(change) - k]) / max(len(change) - k, 1) for k in (0, 1, 2)
    ]
    # With g0 and g1 the variance and the covariance of neighbours: lag 0 is 2 g0 - 2 g1, lag 1 is
    # 2 g1 - g0, lag 2 is -g1. Of what is smooth, as the rest of a clock offset, lag 1 is not below
    # zero.
    opposite, h = max(min(lag[2], -lag[1] / 4.0), 0.0), one.period
    own = max((lag[0] - 6.0 * opposite) / 2.0, 0.0) * h
    power = float(np.var(rate))
    most, window = PULLED * np.sqrt(own * power / (len(rate) * h)), 1
    while 2 * opposite / window**2 > most and 2 * window * h <= LONGEST_WINDOW:
        window *= 2
    return window


def _smoothed(values: np.ndarray, window: int) -> np.ndarray:
    """Values (n,) smoothed by cubics over windows of so many samples."""
    length = min(window, len(values) - 1) // 2 * 2 + 1
    return savgol_filter(values, length, CUBIC) if length > CUBIC + 1 else values


def _roughly_late(one: KnownMotion, rate: np.ndarray) -> float:
    """How late the reference is to a sample, by the correlation of the two rates where they
    overlap.
    """
    n, most = len(rate), min(round(LATEST / one.period), len(rate) // 4)
    shifts = np.arange(-most, most + 1)

    def alike(k: int) -> float:
        measured, true = one.measured[max(-k, 0) : n - max(k, 0)], rate[max(k, 0) : n - max(-k, 0)]
        along = (measured - measured.mean()) @ (true - true.mean())
        return along / max(len(true) * measured.std() * true.std(), 1e-300)

    # Of shifts that are equally good, as of a ramp, the shortest.
    found = np.array([alike(k) for k in shifts])
    good = shifts[found >= found.max() - 1e-9]
    return float(good[np.argmin(np.abs(good))] * one.period)


def _solved(truth: _Truth, late: float, window: int, offset: bool) -> Calibration:
    """The calibration over windows of so many rows, from a first guess of the clock offset."""
    keys: list[Key] = [Coefficient("scale_factor", "s", (Z,)), LogBias(truth.one.name, Z)]
    keys += [LogClock(truth.one.name, 0)] * offset
    s, b, count = 0.0, 0.0, len(keys)
    for round_ in range(ROUNDS):
        rows = truth.rows(late, window)
        left = rows.measured - (1 + s) * rows.rate - b
        columns = np.column_stack([rows.rate, np.ones(len(left)), (1 + s) * rows.slope])[:, :count]
        # The first step is far from the noise: what is left there is scale factor and bias.
        far = columns[:, :2] @ np.linalg.lstsq(columns[:, :2], left)[0] if round_ == 0 else 0.0
        noise = RandomWalk.fit([(left - far, rows.time, rows.segments)])
        # The bias is that of a row before the first: else that one row would weigh more than all
        # others together where there is walk and next to no white noise.
        noise = replace(noise, before=window * truth.one.period)
        linear = Linear(rows.time, rows.segments, left[:, None], {0: keys}, {0: Stack.of(columns)})
        normal = normal_equations([linear], {0: noise})
        if offset and not np.isfinite(variances(normal.gram)).all():
            # A ramp that is late is a ramp with another bias.
            return _solved(truth, 0.0, window, False)
        change = solve(normal.gram, normal.score)
        s, b = s + float(change[0]), b + float(change[1])
        late += float(change[2]) if offset else 0.0
        if abs(late) > 2 * LATEST:
            raise UserError(
                f"{truth.one.name}: no clock offset of up to {LATEST:g} s brings the reference to "
                "the gyro: they do not belong together, or their clocks are farther apart"
            )
        if np.max(np.abs(change)) < SETTLED:
            break
    std = np.sqrt(variances(normal.gram))
    found = _calibration(truth, rows, (s, b), np.linalg.pinv(normal.gram), columns, noise, window)
    return replace(found, late=late, late_std=float(std[2])) if offset else found


def _calibration(truth, rows, found, covariance, columns, noise, window) -> Calibration:
    s, b = found
    left = rows.measured - (1 + s) * rows.rate - b
    slope = np.array([[-1.0, 0.0], [b / (1 + s), -1.0]]) / np.array([[(1 + s) ** 2], [1 + s]])
    steps = truth.one.period * window
    return Calibration(
        f"{truth.reference}, whitened",
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
