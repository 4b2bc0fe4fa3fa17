"""What a trial's samples say by themselves: their white noise, and which of them say nothing."""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.trial import Trial
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.rest import VIBRATION, seconds_of

QUIET, DRAWN = 0.25, 512
"""Share of the seconds at rest that is taken, the quietest: a hand is never quite still. What it
shows of white noise of one level is known from so many seconds that are drawn."""

LEAST_STILL = 3
"""Seconds at rest from which on they are taken for the sensor's noise."""

LEAST_MEANS = 8
"""Means in a second, fewer than which show the motion that is left."""

CORRELATED = 2.31
"""Sum of the squared autocorrelations of third differences of white noise, of 20, -15, 6 and -1
parts: by so much their mean square scatters more than one of independent values."""

SURE = 3.0
"""Standard errors by which longer means must show more noise to be believed."""


def rest_noise(trial: Trial) -> np.ndarray:
    """Standard deviation (3,) of the white noise of the samples, in the quietest seconds."""
    return (
        trial.reduction.sample_std if trial.reduction is not None else white_noise(trial, trial.y)
    )


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
    for i, column in enumerate(trial.y.T):
        seconds = seconds_of(column, trial.row_segments, trial.h)
        still = ~(seconds.moving(trial.kind) | (seconds.std > VIBRATION[trial.kind]))
        if np.count_nonzero(still) >= LEAST_STILL:
            rows = seconds.first[still][:, None] + np.arange(seconds.length)
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
        power.append(m * _quietest(third) / _quietest(_third_differences(drawn)))
        error.append(np.sqrt(2 * CORRELATED / max(1.0, QUIET * third.size)))
        m *= 2
    power, error = np.array(power), np.array(error)
    for k in range(len(power) - 1):
        clear = SURE * np.hypot(error[k], error[k + 1 :])
        if np.all(power[k + 1 :] <= power[k] * (1 + clear)):
            return float(power[k])
    return float(power[-1])


def _third_differences(values: np.ndarray) -> np.ndarray:
    return np.diff(values, n=3, axis=1)


def _quietest(pieces: np.ndarray) -> float:
    """Mean square of the quietest quarter of the rows of ``pieces`` (k, m)."""
    power = np.sort(np.mean(pieces**2, axis=1))
    return float(np.mean(power[: max(1, round(QUIET * len(power)))]))


def white_noise(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Standard deviation (k,) of the white noise of a trial's values (n, k)."""
    return quiet_noise(values, trial.row_segments, trial.h)


def quiet_noise(values: np.ndarray, segments: list[tuple[int, int]], h: float) -> np.ndarray:
    """Standard deviation (k,) of the white noise of values (n, k), sampled every ``h`` s.

    From the quietest quarter of second-long segments.

    Third differences take out motion up to a tenth of the sample rate; those of white noise have 20
    times its variance.
    """
    length = max(8, round(1.0 / h))
    pieces = [values[k : k + length] for a, b in segments for k in range(a, b - length + 1, length)]
    if not pieces:
        return np.full(values.shape[1], np.nan)
    spreads = np.sqrt(np.mean(np.diff(np.array(pieces), n=3, axis=1) ** 2, axis=1) / 20)
    quiet = np.argsort(spreads.sum(axis=1))[: max(1, len(pieces) // 4)]
    return np.sqrt(np.mean(spreads[quiet] ** 2, axis=0))


def without_information(trial: Trial) -> np.ndarray:
    """Mask (n,) of the samples that are left out, or at a limit."""
    bad = np.any([clipped(trial.y[:, i]) for i in trial.axes], axis=0)
    return bad if trial.left_out is None else bad | trial.left_out
