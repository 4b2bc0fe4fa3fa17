"""When a sensor stands still: tests over a window of samples against the noise of its part.

A generalised likelihood ratio (Skog et al. 2010, Zero-velocity detection, whose SHOE it is) tests a
rest, with a rate that is the gyro's bias and a force that is one constant vector, against anything
else. Skog's force has the magnitude of gravity; an accelerometer whose bias is not known does not
show that magnitude, so only the direction's and the magnitude's changes within the window count.
Under a rest the sum of squares over the noise is chi-square distributed, which gives the threshold
of a stated rate of false alarms.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d, uniform_filter1d
from scipy.spatial.transform import Rotation

from pyimu.ins.noise import LEAST_ROWS, Noise
from pyimu.ins.pushes import FOLLOWED, FORCE_STAYS, MOMENT, STEADY_GATE, unpushed
from pyimu.ins.short_rests import between_swings
from pyimu.numerics.laws import chi2
from pyimu.recording.clock import runs
from pyimu.units import STANDARD_GRAVITY

WINDOW = 0.3
"""s; of a test. Shorter than a stop, longer than the period of what shakes a small robot."""

FALSE_ALARM = 1e-6
"""Probability that a window at rest is taken for one in motion, by chance."""

FORCE_KEPT = 0.03
"""m/s^2; standard deviation by which the error of an accelerometer changes from rest to rest in one
attitude: temperature, hysteresis."""

FORCE_TURNED = 0.8
"""m/s^2 per rad of turn in between: the bias of an accelerometer that nobody calibrated (50 mg)
turns with the body and gravity does not, and gyros have scale factors and misalignments of some
percent."""

MOST_TURN = 2.0
"""rad; a body that has turned further since it rested may show any force."""


def ratio(gyro: np.ndarray, accel: np.ndarray, noise: Noise, rows: int) -> np.ndarray:
    """Sum of squares (n,) over windows of ``rows`` samples, centred.

    At rest it is chi-square distributed with 6 (rows - 1) degrees of freedom. The mean rate of a
    window is taken off as its mean force is; ``detect`` looks at it. Windows with missing samples
    are infinite.
    """
    total = np.zeros(len(gyro))
    for values, std in ((gyro, noise.rate), (accel, noise.force)):
        for column, size in zip(values.T, std, strict=True):
            total += variance(column / size, rows) * rows
    return total


def variance(column: np.ndarray, rows: int) -> np.ndarray:
    """Moving variance (n,) over centred windows, infinite where a sample is missing or the window
    leaves the log.
    """
    known = np.isfinite(column)
    middle = np.median(column[known]) if known.any() else 0.0
    filled = np.where(known, column - middle, 0.0)
    mean = uniform_filter1d(filled, rows, mode="nearest")
    square = uniform_filter1d(filled**2, rows, mode="nearest")
    out = np.maximum(square - mean**2, 0.0)
    holes = uniform_filter1d((~known).astype(float), rows, mode="nearest") > 0.5 / rows
    out[holes] = np.inf
    return out


def magnitude(accel: np.ndarray, noise: Noise, gravity: float, rows: int) -> np.ndarray:
    """Mean square (n,) over windows of the force's magnitude less gravity, over its noise: the
    acceleration-magnitude detector of the same paper.
    """
    off = (np.linalg.norm(accel, axis=1) - gravity) / np.sqrt(np.mean(noise.force**2))
    return uniform_filter1d(off**2, rows, mode="nearest") * rows


def threshold(rows: int, false_alarm: float = FALSE_ALARM) -> float:
    """That of ``ratio``."""
    return float(chi2.isf(false_alarm, 6 * (rows - 1)))


@dataclass(frozen=True)
class Detected:
    """Marks (n,) of rest, how many windows passed, and the turns (start, stop) that were steady.

    Steady pushes are no rests either.
    """

    still: np.ndarray
    windows: float
    steady: tuple[tuple[int, int], ...]


def detect(
    time: np.ndarray,
    gyro: np.ndarray,
    accel: np.ndarray,
    noise: Noise,
    period: float,
    window: float = WINDOW,
    false_alarm: float = FALSE_ALARM,
) -> Detected:
    """Where the sensor rests: samples all of whose windows pass, so that the ends of a rest are
    left out, in which a motion begins while it is still lost in noise. Of short rests between
    swings, as a foot's, the middles count.

    The mean rate of a rest must be the bias, as known from the rests before it and the walk since:
    a steady turn is none. The bias of the first is ``noise.bias``. The mean force must be that of
    the rest before, turned as the gyro says: a body that speeds up evenly does not rest. Within a
    stretch that looks still both must stay so. Where nothing shows the noise of a rest, and by that
    its bias, swings alone tell rests: a smooth moment of a drive is as still as the drive.
    """
    rows = max(LEAST_ROWS, round(window / period))
    passed = ratio(gyro, accel, noise, rows) <= threshold(rows, false_alarm)
    still = between_swings(passed, gyro - noise.bias, rows, period)
    if not noise.shown:
        return Detected(still, float(np.mean(passed)), ())
    still |= ~maximum_filter1d(~passed, rows, mode="nearest")
    bias, at = noise.bias, float(time[0])
    variance_of_bias = noise.rate**2 / rows
    steady, before = [], None
    waiting = [(*run, False) for run in runs(still)]
    while waiting:
        start, stop, one = waiting.pop(0)
        away = np.maximum(time[start:stop] - at, 0.0)
        spread = noise.rate**2 / rows + variance_of_bias + np.outer(away, noise.walk**2)
        parts, turns = np.ones(stop - start, dtype=bool), False
        if not one:
            rates = gyro[start:stop] - bias
            parts, turns = _parted(rates, accel[start:stop], spread, noise, rows, period)
        if not parts.all():
            still[start:stop] = parts
            steady += [(start + a, start + b) for a, b in runs(~parts) if turns]
            waiting[:0] = [(start + a, start + b, not turns) for a, b in runs(parts)]
            continue
        mean = np.nanmean(gyro[start:stop], axis=0)
        own = noise.of_mean(stop - start, period)
        away = max(float(time[start]) - at, 0.0)
        spread = own + variance_of_bias + noise.walk**2 * away
        force = np.mean(accel[start:stop], axis=0)
        if np.sum((mean - bias) ** 2 / spread) > STEADY_GATE + 3:
            change = _changes_at(gyro[start:stop], noise, rows, period)
            if change is not None:
                waiting[:0] = [(start, start + change, one), (start + change, stop, one)]
                continue
            still[start:stop] = False
            steady.append((start, stop))
            continue
        as_before = True
        if before is not None:
            rates = gyro[before.stop : start] - bias
            off = force - before.as_turned(rates, period)
            # White noise, the bias, and its walk, each integrated.
            tilt = noise.rate**2 * period * away + variance_of_bias * away**2
            tilt = STANDARD_GRAVITY**2 * (tilt + noise.walk**2 * away**3 / 3)
            white = noise.force**2 * (1 / (stop - start) + 1 / before.rows)
            spread = float(np.mean(tilt + white))
            pushed, as_before = _pushed_by(off, spread, way_of(rates, rows, period), away)
            if pushed:
                still[start:stop] = False
                continue
        known = variance_of_bias + noise.walk**2 * away
        bias, variance_of_bias = _followed(bias, known, gyro[start:stop], noise, period)
        at = float(time[stop - 1])
        # What is pushed evenly does not tell the force of what comes later.
        if before is None or (as_before and (stop - start) * period > MOMENT):
            before = _Rest(force, stop - start, stop)
    return Detected(still, float(np.mean(passed)), tuple(_joined(steady)))


def _joined(parts: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """The stretches in their order; those that follow each other are one."""
    found: list[tuple[int, int]] = []
    for start, stop in sorted(parts):
        if found and start <= found[-1][1]:
            found[-1] = found[-1][0], max(stop, found[-1][1])
        else:
            found.append((start, stop))
    return found


def _followed(
    bias: np.ndarray, known: np.ndarray, gyro: np.ndarray, noise: Noise, period: float
) -> tuple[np.ndarray, np.ndarray]:
    """The bias (3,) and its variance after a rest: the mean of its last rates of ``gyro`` (n, 3),
    as a bias does more than walk, but of a short rest only what that tells beside what was
    ``known``, the variance of ``bias``.
    """
    last = min(len(gyro), noise.longest_mean(period))
    mean, own = np.nanmean(gyro[len(gyro) - last :], axis=0), noise.of_mean(last, period)
    share = np.where(own > known, known / (known + own), 1.0)
    return bias + share * (mean - bias), np.where(own > known, share * own, own)


def _parted(
    rates: np.ndarray,
    force: np.ndarray,
    spread: np.ndarray,
    noise: Noise,
    rows: int,
    period: float,
) -> tuple[np.ndarray, bool]:
    """Marks (n,) of what of a still stretch rests by its means, and whether it is a turn that does
    not, or a push.
    """
    parts = _unturned(rates, spread, rows)
    if parts.any() and not parts.all():
        return parts, True
    return unpushed(force, noise.force, rows, period), False


def _unturned(rates: np.ndarray, spread: np.ndarray, rows: int) -> np.ndarray:
    """Marks (n,) of a still stretch, less where means over ``rows`` of its ``rates`` (n, 3) rad/s,
    without the bias, are further off than their variance ``spread`` (n, 3) allows: a turn so gentle
    that no window shows it lies between two rests.
    """
    n = len(rates) // rows
    if n < 3:
        return np.ones(len(rates), dtype=bool)
    means = rates[: n * rows].reshape(n, rows, 3).mean(axis=1)
    turned = np.sum(means**2 / spread[: n * rows : rows], axis=1) > STEADY_GATE + 3
    # It begins and ends within the blocks beside it.
    still = ~maximum_filter1d(turned, 3, mode="nearest")
    return np.append(np.repeat(still, rows), np.full(len(rates) - n * rows, still[-1]))


def _changes_at(gyro: np.ndarray, noise: Noise, rows: int, period: float) -> int | None:
    """The sample of a still stretch at which the mean of its rates (n, 3) changes, None where it
    does not: where a turn begins or ends that is too slow for a window and for ``_unturned``. It is
    that for which two means are likeliest beside one whose bias walks: of two stretches that follow
    each other the means of a walk differ by K sqrt(T / 3), with T that of both.
    """
    n = len(gyro)
    at = np.arange(rows, n - rows + 1)
    if not len(at):
        return None
    sums = np.cumsum(np.nan_to_num(gyro), axis=0)
    before, after = sums[at - 1] / at[:, None], (sums[-1] - sums[at - 1]) / (n - at)[:, None]
    spread = noise.rate**2 * (n / (at * (n - at)))[:, None] + noise.walk**2 * n * period / 3
    gain = np.sum((before - after) ** 2 / spread, axis=1)
    best = int(np.argmax(gain))
    return int(at[best]) if gain[best] > STEADY_GATE + 3 else None


@dataclass(frozen=True)
class _Rest:
    """The mean ``force`` (3,) of a rest of so many ``rows``, which ends before row ``stop``."""

    force: np.ndarray
    rows: int
    stop: int

    def as_turned(self, rates: np.ndarray, period: float) -> np.ndarray:
        """The force (3,) once the body has turned with ``rates`` (n, 3) rad/s."""
        turns = Rotation.from_rotvec(np.vstack([np.nan_to_num(rates) * period, np.zeros(3)]))
        while len(turns) > 1:  # the product of all, two by two
            if len(turns) % 2:
                turns = Rotation.concatenate([turns, Rotation.identity(1)])
            turns = turns[0::2] * turns[1::2]
        return turns[0].inv().apply(self.force)


def way_of(rates: np.ndarray, rows: int, period: float) -> float:
    """The way [rad] that rates (n, 3) turn, by their means over ``rows``, as noise turns nothing;
    infinite where one is missing.
    """
    if not len(rates):
        return 0.0
    parts = np.add.reduceat(rates, np.arange(0, len(rates), rows), axis=0) * period
    way = float(np.linalg.norm(parts, axis=1).sum())
    return way if np.isfinite(way) else np.inf


def _pushed_by(off: np.ndarray, spread: float, turned: float, away: float) -> tuple[bool, bool]:
    """Whether a mean force that is ``off`` (3,) m/s^2, ``away`` s after a rest and a turn of
    ``turned`` rad, is pushed, and whether it is as it was but for what an accelerometer's error
    changes by in that time; its variance ``spread`` is that of noise.
    """
    if turned > MOST_TURN:
        return False, True
    spread += (FORCE_TURNED * turned) ** 2
    kept = not _is_pushed(off, spread + kept_for(away) ** 2)
    return _is_pushed(off, spread + FORCE_KEPT**2), kept


def _is_pushed(off: np.ndarray, spread: float) -> bool:
    """Whether a mean force is ``off`` (3,) m/s^2 by more than its variance ``spread`` explains."""
    return float(np.sum(off**2)) > (STEADY_GATE + 3) * spread


def kept_for(seconds: float) -> float:
    """m/s^2; standard deviation by which an accelerometer's error may have changed since."""
    return min(FORCE_STAYS / 3 * (1 + seconds / FOLLOWED), FORCE_KEPT)
