"""What a trial's samples say by themselves: their white noise, and which of them say nothing."""

from __future__ import annotations

from functools import cache

import numpy as np

from pyimu.identification.fit.trial import Trial
from pyimu.recording.clock import runs
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.quality.zeroed import least_size
from pyimu.recording.rest import VIBRATION, seconds_of

QUIET = 4
"""Of so many seconds one is taken, the quietest: a hand is never quite still."""

DRAWN = 512
"""Seconds of white noise of one level that are drawn to know what the quietest show of it."""

SHORT = 16
"""Samples of a piece between zeros."""

MEANS = 2
"""Times as many rows in each longer mean, and means in a row of a band at least: third differences
leave the motion in it out of what these show."""

THIRD = 20.0
"""Power of third differences of white noise over its own: 1 + 9 + 9 + 1."""

LEAST_STILL = 3
"""Seconds at rest from which on they are taken for the sensor's noise."""

LEAST_MEANS = 8
"""Means in a second, fewer than which show the motion that is left."""

CORRELATED = 924 / 400
"""Sum of the squared autocorrelations of third differences of white noise, of 20, -15, 6 and -1
parts: by so much their mean square scatters more than one of independent values."""

SURE = 3.0
"""Standard errors by which longer means must show more noise to be believed."""


def rest_noise(trial: Trial) -> np.ndarray:
    """Standard deviation (3,) of the white noise of the samples, in the quietest seconds."""
    if trial.reduction is not None:
        return trial.reduction.sample_std
    found = quiet_noise(trial.y, _within_limits(trial), trial.h)
    if not np.isfinite(found).all():
        found = white_noise(trial, trial.y)
    for k, column in enumerate(trial.y.T):
        beside = _beside_zeros(column, trial.row_segments)
        found[k] = found[k] if beside is None else beside
    return found


def band_noise(trial: Trial) -> np.ndarray:
    """Standard deviation (3,) of white noise of the samples that is as strong as their noise in the
    trial's band: that of the quietest seconds, or less where means over several rows show less.

    What motors shake a body with is far above the band of a derived reference, and no white noise:
    of lines there means show nothing.
    """
    found = rest_noise(trial)
    if trial.reduction is not None:
        return found
    least, count = found, MEANS
    while count * MEANS <= trial.band.stride:
        if trial.count < LEAST_MEANS * QUIET * count:
            break
        means, segments = _means(trial, count)
        seen = np.sqrt(count) * quiet_noise(means, segments, count * trial.h)
        clearly = 1.0 - SURE * np.sqrt(0.5 * CORRELATED * QUIET / len(means))
        least = np.where(seen < clearly * found, np.minimum(seen, least), least)
        count *= MEANS
    return least


def _means(trial: Trial, count: int) -> tuple[np.ndarray, list[tuple[int, int]]]:
    """Means (m, 3) over so many rows of a trial's samples, and the segments of them."""
    y, out, segments = trial.y, [], []
    for a, b in trial.row_segments:
        rows = (b - a) // count
        start = segments[-1][1] if segments else 0
        segments.append((start, start + rows))
        out.append(y[a : a + rows * count].reshape(rows, count, y.shape[1]).mean(axis=1))
    return np.concatenate(out), segments


def _within_limits(trial: Trial) -> list[tuple[int, int]]:
    """The rows of a trial in which no sample is at a limit, where there is no noise."""
    at_limit = _clipped(trial)
    if not at_limit.any():
        return trial.row_segments
    return [(a + i, a + j) for a, b in trial.row_segments for i, j in runs(~at_limit[a:b])]


def _clipped(trial: Trial) -> np.ndarray:
    return np.any([clipped(trial.y[:, i]) for i in trial.axes], axis=0)


def _beside_zeros(values: np.ndarray, segments: list[tuple[int, int]]) -> float | None:
    """Standard deviation of the white noise of values (n,) that are set to zero where they are
    small, from those that are not; None of others, and without them.
    """
    if least_size(values) is None:
        return None
    inside = ((a + s, a + t) for a, b in segments for s, t in runs(values[a:b] != 0))
    pieces = [values[k : k + SHORT] for s, t in inside for k in range(s, t - SHORT + 1, SHORT)]
    if not pieces:
        return None
    third = _third_differences(np.array(pieces)[:, :, None])
    return float(np.sqrt(_of_one_level(third)[0] / THIRD))


def rest_density(trial: Trial) -> np.ndarray:
    """N (3,), the root of the two-sided density of the white noise at rest [unit of a sample times
    sqrt(s)].

    A sensor's low-pass filter takes away what differences of neighbouring samples show. Means over
    2, 4, 8 samples and so on reach down to where the noise is white: N is that of the shortest
    beyond which no longer ones show clearly more, up to an eighth of a second. Without seconds at
    rest, in which no motion is taken for noise, it is that of the quietest samples.
    """
    found = rest_noise(trial) * np.sqrt(trial.h)
    if trial.reduction is not None:
        return found
    each = [seconds_of(column, trial.row_segments, trial.h) for column in trial.y.T]
    # An axis that hardly turns while another does is not at rest: it has a share of that motion.
    moves = [s.moving(trial.kind) | (s.std > VIBRATION[trial.kind]) for s in each]
    still = ~np.any(moves, axis=0)
    if np.count_nonzero(still) >= LEAST_STILL:
        rows = each[0].first[still][:, None] + np.arange(each[0].length)
        for i, column in enumerate(trial.y.T):
            found[i] = np.sqrt(_level(column[rows]) * trial.h)
    return found


def _level(pieces: np.ndarray) -> float:
    """Variance of the means over m samples, times m, where it has grown to what white noise has.

    ``pieces`` (k, n) are samples at rest.
    """
    n, power, error, m = pieces.shape[1], [], [], 1
    while n // m >= LEAST_MEANS:
        third = _third_differences(pieces[:, : n // m * m].reshape(len(pieces), -1, m).mean(axis=2))
        drawn = np.random.default_rng(1).standard_normal((DRAWN, n // m))
        shown, own = (_quietest(v[:, :, None])[0] for v in (third, _third_differences(drawn)))
        power.append(m * shown / own)
        error.append(np.sqrt(2 * CORRELATED / max(1.0, third.size / QUIET)))
        m *= 2
    power, error = np.array(power), np.array(error)
    for k in range(len(power) - 1):
        clear = SURE * np.hypot(error[k], error[k + 1 :])
        if np.all(power[k + 1 :] <= power[k] * (1 + clear)):
            return float(power[k])
    return float(power[-1])


def _third_differences(values: np.ndarray) -> np.ndarray:
    return np.diff(values, n=3, axis=1)


def _quietest(pieces: np.ndarray) -> np.ndarray:
    """Mean square (k,) of the quietest of ``pieces`` (p, n, k), by all k columns together."""
    power = np.mean(pieces**2, axis=1)
    quiet = np.argsort(np.sqrt(power).sum(axis=1))[: max(1, len(power) // QUIET)]
    return np.mean(power[quiet], axis=0)


def white_noise(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Standard deviation (k,) of the white noise of a trial's values (n, k)."""
    return quiet_noise(values, trial.row_segments, trial.h)


def quiet_noise(values: np.ndarray, segments: list[tuple[int, int]], h: float) -> np.ndarray:
    """Standard deviation (k,) of the white noise of values (n, k), sampled every ``h`` s.

    From all second-long segments that are as quiet as the quietest, if these look like noise of one
    level; else from the quietest quarter.

    Third differences take out motion up to a tenth of the sample rate; those of white noise have 20
    times its variance.
    """
    length = max(8, round(1.0 / h))
    pieces = [values[k : k + length] for a, b in segments for k in range(a, b - length + 1, length)]
    if not pieces:
        return np.full(values.shape[1], np.nan)
    return np.sqrt(_of_one_level(_third_differences(np.array(pieces))) / THIRD)


def _of_one_level(third: np.ndarray) -> np.ndarray:
    """Mean square (k,) of the pieces (p, n, k) of third differences that show one level."""
    power, lowest = np.mean(third**2, axis=1), _quietest(third)
    by_chance = _quietest_of_white(*third.shape[1:])
    scatter = np.sqrt(2 * CORRELATED / third.shape[1])
    alike = third[np.all(power <= lowest / by_chance * (1 + SURE * scatter), axis=1)]
    if not len(alike):
        return lowest
    level = np.mean(alike**2, axis=(0, 1))
    error = scatter / np.sqrt(max(1, len(alike) // QUIET))
    one = _quietest(alike) >= level * (by_chance - SURE * error)
    return np.where(one, level, lowest)


@cache
def _quietest_of_white(rows: int, columns: int) -> float:
    """Share of its power that third differences of white noise show in the quietest pieces
    (``rows``, ``columns``).
    """
    drawn = np.random.default_rng(1).standard_normal((DRAWN, rows + 3, columns))
    third = _third_differences(drawn)
    return float(np.mean(_quietest(third)) / np.mean(third**2))


def without_information(trial: Trial) -> np.ndarray:
    """Mask (n,) of the samples that are left out, or at a limit."""
    bad = _clipped(trial)
    return bad if trial.left_out is None else bad | trial.left_out
