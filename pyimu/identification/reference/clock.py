"""The clock of a log's reference against the sensor's.

How much later than the reference says the sensor shows the motion.

A coarse lag is where the sizes of the two rates correlate best, which no mounting changes. The fine
one is the coefficient of -dx/dt, x being the reference's rate, in the sensor's output; in windows
of some seconds it shows whether the two clocks keep step.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from scipy.ndimage import uniform_filter1d

from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.columns import band_time, in_band
from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.interpolated import interpolated
from pyimu.identification.fit.response import through_dynamics
from pyimu.identification.fit.sample_noise import band_noise
from pyimu.identification.fit.trial import MOVING, Trial, marked
from pyimu.identification.reference.moving import (
    LEAST_ROWS,
    in_own_band,
    moving_pair,
    moving_rows,
    turned_onto,
)
from pyimu.identification.reference.place import placed
from pyimu.identification.reference.track import LEAST, Level, level_of
from pyimu.identification.reference.wandering import wandering_lag
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS
from pyimu.recording.reference.epoch import PERIOD, correlations

WINDOW, ROWS = 2.5, 32
"""s; windows of the fine lag, and the least rows of the band that one covers."""

REPEATS = 1.2
"""Times what the best lag leaves of the correlation, within which another is as good."""

FARTHEST = 30.0
"""s; the coarse lag is looked for so far, and within a quarter of the log: GPS time is 18 s ahead
of UTC."""

FITTING = 0.3
"""Share of the rate by which a row may miss the fit: clipped samples and faults miss by more."""

SEEN = 3.0
"""Standard errors of a correlation from which on two slopes show one motion, and not noise."""

MOTION = 5.0
"""Times its own noise that a sensor must show for a reference to be judged by it."""

FASTEST_DRIFT = 1e-3
"""Relative difference of two clocks that run: quartz keeps to some 1e-4, a bare RC oscillator to a
percent, and that is no clock to log by."""

LEAST_SLIP = 0.2
"""Sample periods of the sensor by which a clock slips at least: it slips by a sample, of the sensor
or of a reference up to five times faster."""

BENT = 0.01
"""Share of the gain, as a standard deviation, that a bias which wanders may be taken for."""

CHI2_MEDIAN = 0.4549
"""Median of the square of a standard normal."""

ROUNDING = 1e-12
"""Share of a constant that its mean is off by, at most: sums of 10^4 doubles."""

WHOLE = 0.999
"""Share of the sensor's power from which on one lag explains a log."""

CLEARLY = 0.5
"""Of what one lag leaves unexplained, what lags that change from window to window may leave."""

ROUNDS = 5


def measure(trial: Trial, sensor: Sensor) -> Clock | None:
    """The clock of a trial, by the model ``sensor`` with its dynamics; None without motion.

    Where too few rows follow the reference for a lag to be seen, its ``std`` is infinite.
    """
    if (
        trial.reference == "static"
        or trial.reduction is not None
        or not trial.segments
        or not moves(trial)
    ):
        return None
    coarse = _coarse(trial)
    found = _followed(trial, sensor, Clock(trial.time[:1], np.array([coarse]), 0.0, 0.0))
    if found.explained >= WHOLE:
        return found
    wanders = wandering_lag(trial.time, *_both(trial), about=coarse)
    clock = None if wanders is None else _clock(level_of(*wanders, LEAST_SLIP * trial.h))
    if clock is None or clock.keeps_step:
        return found
    other = _followed(trial, sensor, clock)
    return other if 1 - other.explained < CLEARLY * (1 - found.explained) else found


def _followed(trial: Trial, sensor: Sensor, clock: Clock) -> Clock:
    """The clock that the windows of a trial show, from a coarse one on."""
    for _ in range(ROUNDS):
        seen = _windows(placed(shifted(trial, clock)), sensor)
        if seen is None:
            explained = explained_by(placed(shifted(trial, clock)))
            return replace(clock, std=np.inf, explained=explained)
        time, late, std = seen
        before = clock
        if clock.keeps_step or len(time) >= LEAST:
            clock = _clock(level_of(time, late + clock.at(time), std, LEAST_SLIP * trial.h))
        else:
            # Too few to show how it changes: that was seen before.
            level = level_of(time, late, std, np.inf)
            clock = replace(clock, late=clock.late + float(level.value.mean()), std=level.std)
        if np.abs(clock.at(time) - before.at(time)).max() < 0.1 * clock.std:
            break
    return replace(clock, explained=explained_by(placed(shifted(trial, clock))))


def _clock(level: Level) -> Clock:
    found = Clock(level.time, level.value, level.std, 0.0)
    return replace(found, skew=level.slope, slips=level.steps)


def moves(trial: Trial) -> bool:
    """Whether sensor and reference both show more than the sensor's own noise.

    A sensor alone that does may follow its temperature.
    """
    axes, trial = list(trial.axes), in_own_band(trial)
    return not any(are_still(trial, trial.u[:, OWN[trial.kind]][:, axes], trial.y[:, axes]))


def are_still(trial: Trial, *signals: np.ndarray) -> list[bool]:
    """Of each of the ``signals`` (n, axes) whether it shows no more than the sensor's own noise in
    the trial's band, or is too short to tell.
    """
    shown = [in_band(trial, values) for values in signals]
    if max(map(len, shown)) < LEAST_ROWS:
        return [True] * len(shown)
    gain = np.sqrt(np.sum(np.square(trial.band.weights)))
    least = MOTION * gain * np.linalg.norm(band_noise(trial)[list(trial.axes)])

    def is_still(x: np.ndarray) -> bool:
        rounding = ROUNDING * np.linalg.norm(x, axis=1).max()
        return bool(np.linalg.norm(x.std(axis=0)) <= max(least, rounding))

    return [len(x) < LEAST_ROWS or is_still(x) for x in shown]


def explained_by(trial: Trial) -> float:
    """Share of the sensor's power in the band that the reference, once turned, accounts for.

    Below zero where it is further off than nothing.
    """
    x, y = moving_pair(trial)
    if len(y) < LEAST_ROWS:
        return 1.0
    x, y = x - x.mean(axis=0), y - y.mean(axis=0)
    left = y - (x @ turned_onto(x, y) if trial.free_rotation else x)
    return float(1 - np.sum(left**2) / max(np.sum(y**2), 1e-300))


# The reference, moved


def shifted(trial: Trial, clock: Clock) -> Trial:
    """The trial with its reference as late as ``clock`` says, over the rows where it is known."""
    late = clock.at(trial.time)
    if not np.any(late):
        return trial
    u, segments = copied(trial.u), []
    columns = [OWN[trial.kind], COLUMNS[KINDS[trial.kind].own_rate]]
    if trial.place is not None:
        columns += [COLUMNS[name] for name in ("rate", "angular_acceleration", "attitude")]
    for a, b in trial.segments:
        row = np.interp(trial.time[a:b] - late[a:b], trial.time[a:b], np.arange(b - a), -1, b - a)
        inside = np.flatnonzero((row >= 0) & (row <= b - a - 1))
        if len(inside) < 2:
            continue
        for at in columns:
            u[a:b, at] = interpolated(trial.u[a:b, at], np.clip(row, 0, b - a - 1))
            if trial.band_hz is not None and trial.place is None and b - a > 1:
                u[a:b, at] *= 1.0 - _drift(trial.time[a:b], late[a:b])[:, None]
        segments.append((a + int(inside[0]), a + int(inside[-1]) + 1))
    place = None if trial.place is None else trial.place.by(u)
    seen_at = None if trial.seen_at is None else trial.seen_at + clock.at(trial.seen_at)
    return replace(trial, u=u, segments=segments, place=place, seen_at=seen_at)


def _drift(time: np.ndarray, late: np.ndarray) -> np.ndarray:
    """Rate (n,) at which a lag grows.

    An attitude that is read at a pace of its own turns at that pace. A slip is none.
    """
    rate = np.gradient(late, time)
    return np.where(np.abs(rate) < FASTEST_DRIFT, rate, 0.0)


def rebanded(trial: Trial) -> Trial:
    """The trial with the band in which its reference, as it stands now, can be trusted.

    One whose reference was not derived has none.
    """
    return trial if trial.band_hz is None else in_own_band(trial)


# How late


def _coarse(trial: Trial) -> float:
    """Lag in s at which the sizes of the two rates, in means over ``PERIOD``, correlate best: the
    noise of an attitude, once differentiated, may be larger than the motion from row to row. Of
    forces it is what they change: gravity has the same size however the body is turned.

    0 where that is hardly better than without a lag; of a motion that repeats, with which many
    correlate alike, the shortest.
    """
    x, y, counted = _both(trial)
    means = max(round(PERIOD / trial.h), 1)
    centred = (v - np.median(v[counted], axis=0) for v in (x, y))
    x, y = (uniform_filter1d(v, means, axis=0) for v in centred)
    x, y = np.linalg.norm(x, axis=1), np.linalg.norm(y, axis=1)
    most = round(min(FARTHEST, (trial.time[-1] - trial.time[0]) / 4) / trial.h)
    lags = np.arange(-most, most + 1)
    both = counted.astype(float)
    least = 0.5 * len(both) * both.mean() ** 2
    r = correlations(x, both, y, both, lags, least)
    peaks = np.flatnonzero((r >= np.roll(r, 1)) & (r >= np.roll(r, -1)))
    alike = peaks[1 - r[peaks] <= REPEATS * (1 - r.max())]
    best = int(min(alike, key=lambda i: abs(lags[i]), default=np.argmax(r)))
    return float(lags[best] * trial.h) if 1 - r[best] < 0.5 * (1 - r[most]) else 0.0


def _both(trial: Trial) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rates (n, axes) of reference and sensor, and the rows (n,) in which both are known."""
    axes = list(trial.axes)
    rate = trial.u[:, OWN[trial.kind]][:, axes]
    return rate, trial.y[:, axes], marked(trial.row_segments, len(trial.time))


def _windows(trial: Trial, sensor: Sensor):
    """Middle (k,) s, lag (k,) s and standard error (k,) s of each window that moves.

    None where too little does.
    """
    axes = list(trial.axes)
    rate = trial.u[:, OWN[trial.kind]]
    x, slope = (
        through_dynamics(sensor, v, trial.segments, trial.h)[:, axes]
        for v in (rate, _slope(trial, rate))
    )
    seen = _slope(trial, trial.y[:, axes])
    trial = in_own_band(trial)
    time, rows = band_time(trial), moving_rows(trial)
    x, slope, y, seen = (in_band(trial, v)[rows] for v in (x, slope, trial.y[:, axes], seen))
    time = time[rows]
    speed = np.linalg.norm(x - np.median(x, axis=0), axis=1)
    if len(speed) < 4 * LEAST_ROWS or not np.any(speed):
        return None
    moving = speed > MOVING * np.sqrt(np.mean(speed**2))
    size = np.linalg.norm(y - np.median(y, axis=0), axis=1)
    good = moving & (np.abs(size - speed) < FITTING * speed)
    for _ in range(3):
        if good.sum() < 4 * LEAST_ROWS:
            return None
        known = np.column_stack([np.ones(len(x)), x])
        gain = np.linalg.lstsq(known[good], y[good], rcond=1e-6)[0]
        left = y - known @ gain
        turned = slope @ gain[1:]
        power = np.sum((turned * seen)[good])
        if power <= 0.0:  # sensor and reference do not turn alike: they have no lag to measure
            return None
        late = -np.sum(turned[good] * left[good]) / power
        missed = np.linalg.norm(left + late * turned, axis=1)
        good = moving & (missed < FITTING * speed)
    if good.sum() < LEAST_ROWS:
        return None
    length = max(WINDOW, ROWS * trial.band.stride * trial.h)
    places = _places(time[good] - trial.time[0], length)
    known = [v[good] for v in (x, slope, y - gain[0], seen)]
    return _by_window(time[good], *known, gain[1:], late, places)


def _places(time: np.ndarray, length: float) -> list[tuple[int, int]]:
    """First and next row of each window of moving rows at ``time`` (m,) s that says something.

    Short moves between rests leave few rows in each: windows are twice as long, and again, until
    half of the rows are in one; all of them are in the last. Rows are ``LEAST_ROWS`` at least.
    """
    while True:
        window = (time / length).astype(int)
        edges = [*np.flatnonzero(np.diff(window, prepend=-1)), len(time)]
        places = [(a, b) for a, b in pairwise(edges) if b - a >= LEAST_ROWS]
        if 2 * sum(b - a for a, b in places) >= len(time):
            return places
        length *= 2.0


def _slope(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Rate of change of values (n, k), between neighbours on both sides."""
    out = np.zeros_like(values)
    for a, b in trial.segments:
        if b - a > 1:
            out[a:b] = np.gradient(values[a:b], trial.time[a:b], axis=0)
    return out


def _by_window(time, x, slope, y, seen, gain, late: float, places: list[tuple[int, int]]):
    """The lag in each of the ``places`` whose slope sensor and reference both show.

    The slope of the reference holds its noise, and its square would make the lag small: the product
    with the slope ``seen`` by the sensor, whose noise is another, has the motion's power alone
    (instrumental variables, Fuller 1987, "Measurement Error Models", section 1.4).

    A bias that wanders is no lag, although what turns steadily makes it look like one, in its
    window, and in all of them by the ``gain`` (k, k) that it bends: as much of each window's mean
    is taken out as biases may have wandered, and the gain fitted anew to the rest.
    """
    share = _mean_share(y - (x - late * slope) @ gain, places)
    signals = (x, slope, y, seen)
    taken = np.stack([share * _means(v, places) for v in signals], axis=1)
    parts = [
        [v[a:b] - n for v, n in zip(signals, some, strict=True)]
        for (a, b), some in zip(places, taken, strict=True)
    ]
    gain = _regained(parts, gain)
    middles, lates, stds = [], [], []
    for (a, b), (known, rate, measured, to) in zip(places, parts, strict=True):
        left, by = measured - known @ gain, rate @ gain
        power, size = np.sum(by * to), np.linalg.norm(by)
        if power <= SEEN * size * np.linalg.norm(to) / np.sqrt(by.size):
            continue
        late = -np.sum(by * left) / power
        middles.append(float(time[a:b].mean()))
        lates.append(late)
        stds.append(np.sqrt(np.mean((left + late * by) ** 2)) * size / power + 1e-12)
    if not middles:
        return None
    return np.array(middles), np.array(lates), np.array(stds)


def _regained(parts: list[list[np.ndarray]], gain: np.ndarray) -> np.ndarray:
    """The gain of windows, as far as they show another than ``gain``, which may be bent by
    ``BENT``.
    """
    gram = np.sum([known.T @ known for known, *_ in parts], axis=0)
    lefts = [(known, measured - known @ gain) for known, _, measured, _ in parts]
    score = np.sum([known.T @ left for known, left in lefts], axis=0)
    noise = np.mean(np.concatenate([left for _, left in lefts]) ** 2)
    return gain + np.linalg.solve(gram + noise / BENT**2 * np.eye(len(gram)), score)


def _mean_share(left: np.ndarray, places: list[tuple[int, int]]) -> np.ndarray:
    """Share (windows, k) of each window's mean that leaves errors of equal size, where a bias of
    its own is added to white errors (Fuller and Battese 1973, "Transformations for estimation of
    linear models with nested-error structure", JASA 68).
    """
    count = np.array([b - a for a, b in places])[:, None]
    means = _means(left, places)
    apart = [(left[a:b] - mean) ** 2 for (a, b), mean in zip(places, means, strict=True)]
    white = np.mean([np.add.reduce(v) / len(v) for v in apart], axis=0)
    bias = np.maximum(np.median(means**2, axis=0) / CHI2_MEDIAN - white / np.median(count), 0.0)
    return 1.0 - np.sqrt(white / np.maximum(white + count * bias, 1e-300))


def _means(values: np.ndarray, places: list[tuple[int, int]]) -> np.ndarray:
    """Means (windows, k) of values (m, k) in places that follow one another."""
    edges = np.ravel(places)
    inside = edges[: len(edges) - int(edges[-1] == len(values))]
    return np.add.reduceat(values, inside)[::2] / np.diff(places)
