"""The rest at the start of a recording, for levelling and for the gyro's turn-on bias."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.recording.recording import Recording
from pyimu.recording.rest import still_rows
from pyimu.units import STANDARD_GRAVITY

LONGEST = 30.0
"""s; more of a rest is not looked at."""

LENGTHS = (1.0, 0.25)
"""s; of the means by which a rest is found, the second where the first find none."""

SHORTEST = 0.5
"""s; of the rows that are looked at where there is no rest."""

FORCE_OFF = 2.0
"""m/s^2; a mean force whose magnitude differs more from gravity is not gravity: no accelerometer
at rest is off by 0.2 g of the Earth. On the Moon that is more than gravity, so that it may not
differ by more than half of that either."""


@dataclass(frozen=True)
class Rest:
    """The rows of a rest, its ``duration`` in s, and statistics of its samples.

    The means and standard deviations are (3,) in rad/s and m/s^2.

    ``seen`` is False where no rest was found: the rows are then those of the shortest window.
    ``declared`` says that the recording's own column ``stationary`` marks it. ``force`` is None
    where no accelerometer measures gravity. ``rate_std`` and ``force_std`` are those of a sample's
    white noise, ``rate_mean_std`` that of the mean rate. ``gravity`` in m/s^2 is that of the place.
    """

    seen: bool
    rows: slice
    duration: float
    rate: np.ndarray
    force: np.ndarray | None
    rate_std: np.ndarray
    force_std: np.ndarray
    rate_mean_std: np.ndarray
    gravity: float
    declared: bool = False


def find_rest(recording: Recording, gravity: float = STANDARD_GRAVITY) -> Rest:
    """The longest rest of up to 30 s at the start of a recording.

    ``gravity`` in m/s^2 is that of the place.

    Where the recording has a column ``stationary``, that decides.

    A steady turn about the vertical looks like a rest with a bias; only ``stationary`` tells the
    two apart.
    """
    declared = _declared(recording)
    if declared is not None and declared > 1:
        return _rest(recording, declared, gravity, seen=True, declared=True)
    for length in LENGTHS if declared is None else ():
        stop = _still_until(recording, length)
        if stop > 3 and _is_level(recording, stop, gravity):
            return _rest(recording, stop, gravity, seen=True)
    return _rest(recording, max(2, _rows(recording, SHORTEST)), gravity, seen=False)


def _rows(recording: Recording, seconds: float) -> int:
    """Number of rows in the first ``seconds`` of a recording."""
    return int(np.searchsorted(recording.time, recording.time[0] + seconds))


def _still_until(recording: Recording, length: float) -> int:
    """Row at which the rest at the start ends, by means over ``length`` s; 0 without a rest."""
    # Beyond the longest rest, so that what the rest is compared with is there.
    found = still_rows(recording.slice(0, _rows(recording, LONGEST + 2 * length)), length)
    stop = found[0][1] if found and found[0][0] == 0 else 0
    return min(stop, _rows(recording, LONGEST))


def _declared(recording: Recording) -> int | None:
    """Number of rows at the start that the column ``stationary`` marks; None without the column.

    It is at most the number of rows of the longest window.
    """
    marks = getattr(recording, "stationary", None)
    if marks is None:
        return None
    still = np.concatenate([np.nan_to_num(marks) > 0.5, [False]])
    return min(int(np.argmin(still)), _rows(recording, LONGEST))


def _finite(values: np.ndarray | None, stop: int) -> np.ndarray:
    """The finite ones of the rows before ``stop``."""
    if values is None:
        return np.empty((0, 3))
    rows = values[:stop]
    return rows[np.isfinite(rows).all(axis=1)]


def _is_gravity(force: np.ndarray, gravity: float, off: float) -> bool:
    """Whether the mean force has the magnitude of ``gravity``, to ``off`` m/s^2 and to half."""
    if not len(force):
        return False
    return abs(np.linalg.norm(force.mean(axis=0)) - gravity) < min(off, gravity / 2)


def _is_level(recording: Recording, stop: int, gravity: float) -> bool:
    """Whether the rows before ``stop`` have rates and gravity.

    A force of zeros alone says nothing about it.
    """
    rate, force = (_finite(v, stop) for v in (recording.gyro, recording.accel))
    return bool(len(rate)) and (not np.any(force) or _is_gravity(force, gravity, FORCE_OFF))


def _rest(
    recording: Recording, stop: int, gravity: float, seen: bool, declared: bool = False
) -> Rest:
    """The rest of the rows before ``stop``."""
    rate, force = (_finite(v, stop) for v in (recording.gyro, recording.accel))
    mean, mean_std = np.zeros(3), np.zeros(3)
    if len(rate):
        mean, mean_std = rate.mean(axis=0), rate.std(axis=0) / np.sqrt(len(rate))
    # In motion even a force of half the magnitude of gravity is a better direction than none.
    usable = _is_gravity(force, gravity, FORCE_OFF if seen else np.inf)
    return Rest(
        seen and len(rate) > 1,
        slice(0, stop),
        float(recording.time[stop - 1] - recording.time[0]),
        mean,
        force.mean(axis=0) if usable else None,
        _white_std(rate),
        _white_std(force),
        np.hypot(mean_std, 1e-6),
        gravity,
        declared,
    )


def _white_std(values: np.ndarray) -> np.ndarray:
    """Standard deviation (3,) of a sample's white noise.

    It is taken from the differences of neighbours, so that motion and drift are not in it.
    """
    return np.diff(values, axis=0).std(axis=0) / np.sqrt(2) if len(values) > 2 else np.zeros(3)
