"""The rest at the start of a recording, for levelling and for the gyro's turn-on bias."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import solve_banded
from scipy.special import fdtri

from pyimu.attitude.filter.prediction import DRIVES
from pyimu.attitude.filter.stillness import FAST, SHARE, SLOW, swaying_density
from pyimu.attitude.underway import Underway, underway
from pyimu.display.brief import Brief
from pyimu.errors import Finding
from pyimu.recording.recording import Recording
from pyimu.recording.rest import still_rows
from pyimu.units import STANDARD_GRAVITY

LONGEST = 30.0
"""s; more of a rest is not looked at."""

LENGTHS = (1.0, 0.25)
"""s; of the means by which a rest is found, the second where the first find none."""

SHORTEST = 0.5
"""s; of the rows whose rates and noise are looked at where there is no rest."""

PARTS = 10
"""Means of the force over a rest, by which a turn is looked for."""

BY_CHANCE = 1e-4
"""Probability that a rest is taken for a turn."""

STEADY = 2e-3
"""m/s^3; change of an accelerometer at rest, that of a consumer part that warms up by 0.2 K in a
second (1 mg/K)."""

SHOWN = 4.0
"""By which factor the square of a turn must exceed what shows it in a part of a rest, for that part
to show it with certainty: at the limit itself it does so half of the times."""

SHORTER = 0.7
"""A rest that turns is looked at once more over so much of it: it may have begun to turn later."""

FORCE_OFF = 2.0
"""m/s^2; a mean force whose magnitude differs more from gravity is not gravity: no accelerometer
at rest is off by 0.2 g of the Earth. On the Moon that is more than gravity, so that it may not
differ by more than half of that either."""


GRAVITY_OFF = 0.02
"""Share by which the mean force of a rest may differ from gravity before it is said: a scale factor
or a unit."""


MEAN_TIME = 0.1
"""s; means over so long show the noise that a sensor's own low-pass leaves, down to 5 Hz."""

FEWEST_MEANS = 20
"""Of such means, from whose differences a variance is known to a fifth."""

UNFILTERED = -0.4
"""Correlation of a step between samples with the next one: -1/2 where noise is white. An AR(1) of
which a fifth stays has this, and twice the density at 0 Hz that its steps show; in 300 samples of
three axes chance makes 0.03 of it."""


@dataclass(frozen=True)
class EvenTurn:
    """By which ``turn`` rad/s about the vertical a body turned that seemed to rest at the start,
    and the standard deviation in rad/s of that.
    """

    turn: float = 0.0
    std: float = 0.0

    @property
    def in_doubt(self) -> bool:
        """Whether nothing tells which of several levels is that of the bias."""
        return self.std > 0 and self.turn == 0


@dataclass(frozen=True, repr=False)
class Rest(Brief):
    """The rows of a rest, its ``duration`` in s, and statistics of its samples.

    The means and standard deviations are (3,) in rad/s and m/s^2.

    ``seen`` is False where no rest was found: the rows are then those of the shortest window, and
    what the log tells of its start is in ``underway``, None where that is nothing.
    ``declared`` says that the recording's own column ``stationary`` marks it. ``force`` is None
    where no accelerometer measures gravity. ``rate_std`` and ``force_std`` are those of a sample's
    white noise, ``rate_mean_std`` that of the mean rate; ``rate_density`` in rad/s/sqrt(Hz) and
    ``force_density`` in m/s^2/sqrt(Hz) are the roots of the densities of what is white up to some
    hertz. ``gravity`` in m/s^2 is that of the place.
    ``sways`` says that the body stands on nothing solid, and may turn slowly about the vertical.
    ``even`` is the turn that it may be, as the rest of the log shows (``even_turns``).
    ``other_force`` in m/s^2 is the size of the mean force of a start that would be a rest if that
    were gravity; None where there is no such start.
    """

    seen: bool
    rows: slice
    duration: float
    rate: np.ndarray
    force: np.ndarray | None
    rate_std: np.ndarray
    force_std: np.ndarray
    rate_mean_std: np.ndarray
    rate_density: np.ndarray
    force_density: np.ndarray
    gravity: float
    declared: bool = False
    sways: bool = False
    even: EvenTurn = EvenTurn()
    other_force: float | None = None
    underway: Underway | None = None


def gravity_findings(rest: Rest | None) -> tuple[Finding, ...]:
    """A finding ``gravity_off`` where the force at rest is not gravity, beyond ``GRAVITY_OFF``."""
    if rest is None:
        return ()
    size = rest.other_force
    if size is None and rest.seen and rest.force is not None:
        size = float(np.linalg.norm(rest.force))
    if size is None or abs(size / rest.gravity - 1) <= GRAVITY_OFF:
        return ()
    detail = {"magnitude": size, "share": size / rest.gravity - 1}
    return (Finding("gravity_off", "accel", 1, detail),)


def find_rest(recording: Recording, gravity: float = STANDARD_GRAVITY) -> Rest:
    """The longest rest of up to 30 s at the start of a recording.

    ``gravity`` in m/s^2 is that of the place.

    Where the recording has a column ``stationary``, that decides.

    A steady turn about the vertical looks like a rest with a bias; only ``stationary`` tells the
    two apart. An even drive looks like one, too; a recorded ``speed`` tells that.
    """
    declared = _declared(recording)
    if declared is not None and declared > 1:
        return _rest(recording, declared, gravity, seen=True, declared=True)
    other = None
    for length in LENGTHS if declared is None else ():
        stop = _without_turn(recording, _still_until(recording, length))
        last = stop - _rows(recording, LENGTHS[0])
        if _drives(recording, 0, stop) or _drives(recording, max(last, 0), stop):
            stop = _before_drive(recording, stop)
        if stop <= 3:
            continue
        if _is_level(recording, stop, gravity):
            return _rest(recording, stop, gravity, seen=True)
        other = _size(recording, stop) if other is None else other
    found = _rest(recording, max(2, _rows(recording, SHORTEST)), gravity, seen=False)
    return replace(found, other_force=other)


def _rows(recording: Recording, seconds: float) -> int:
    """Number of rows in the first ``seconds`` of a recording."""
    return int(np.searchsorted(recording.time, recording.time[0] + seconds))


def _still_until(recording: Recording, length: float) -> int:
    """Row at which the rest at the start ends, by means over ``length`` s; 0 without a rest."""
    # Beyond the longest rest, so that what the rest is compared with is there.
    found = still_rows(recording.slice(0, _rows(recording, LONGEST + 2 * length)), length)
    stop = found[0][1] if found and found[0][0] == 0 else 0
    return min(stop, _rows(recording, LONGEST))


def _without_turn(recording: Recording, stop: int) -> int:
    """The row, at most ``stop``, before which gravity does not turn in the body's axes; 0 without.

    A slow turn that is no faster than a bias shows there, unless it is about the vertical: the
    slope of the force over time is tested against what the scatter of its means allows. Where it
    turns over the whole, a part without a turn counts if it would have shown that one.
    """
    whole = None
    while stop > 3 and recording.time[stop - 1] - recording.time[0] >= SHORTEST:
        slope, least = _slope(recording, stop)
        whole = slope if whole is None else whole
        if slope @ slope <= least and (slope is whole or whole @ whole > SHOWN * least):
            return stop
        stop = int(SHORTER * stop)
    return 0


def _slope(recording: Recording, stop: int) -> tuple[np.ndarray, float]:
    """The slope (3,) m/s^3 of the force before ``stop``, and the square that shows a turn."""
    force = recording.accel
    if force is None:
        return np.zeros(3), np.inf
    rows = np.flatnonzero(np.isfinite(force[:stop]).all(axis=1))
    parts = [p for p in np.array_split(rows, PARTS) if len(p)]
    if len(parts) < PARTS:
        return np.zeros(3), np.inf
    time = np.array([recording.time[p].mean() for p in parts])
    means = np.array([force[p].mean(axis=0) for p in parts])
    away = time - time.mean()
    slope = away @ means / (away @ away)
    left = means - means.mean(axis=0) - np.outer(away, slope)
    degrees = 3 * (PARTS - 2)
    variance = np.sum(left**2) / degrees / (away @ away)
    return slope, 3 * fdtri(3, degrees, 1 - BY_CHANCE) * variance + STEADY**2


def _declared(recording: Recording) -> int | None:
    """Number of rows at the start that the column ``stationary`` marks; None without the column.

    It is at most the number of rows of the longest window.
    """
    marks = getattr(recording, "stationary", None)
    if marks is None:
        return None
    still = np.concatenate([np.nan_to_num(marks) > 0.5, [False]])
    return min(int(np.argmin(still)), _rows(recording, LONGEST))


def finite_rows(values: np.ndarray | None, stop: int) -> np.ndarray:
    """The finite ones of the rows before ``stop``."""
    if values is None:
        return np.empty((0, 3))
    rows = values[:stop]
    return rows[np.isfinite(rows).all(axis=1)]


def _is_gravity(force: np.ndarray, gravity: float, off: float) -> bool:
    """Whether a mean ``force`` (3,) has the size of ``gravity``, to ``off`` m/s^2 and to half."""
    return bool(abs(np.linalg.norm(force) - gravity) < min(off, gravity / 2))


def _is_level(recording: Recording, stop: int, gravity: float) -> bool:
    """Whether the rows before ``stop`` have rates and gravity.

    A force of zeros alone says nothing about it.
    """
    rate, force = (finite_rows(v, stop) for v in (recording.gyro, recording.accel))
    return bool(len(rate)) and (
        not np.any(force) or _is_gravity(force.mean(axis=0), gravity, FORCE_OFF)
    )


def _size(recording: Recording, stop: int) -> float | None:
    """m/s^2; of the mean force before the row ``stop``, None without a force or a rate."""
    rate, force = (finite_rows(v, stop) for v in (recording.gyro, recording.accel))
    return float(np.linalg.norm(force.mean(axis=0))) if len(force) and len(rate) else None


def _drives(recording: Recording, start: int, stop: int) -> bool:
    """Whether a body that looks still from a row to another has a speed there, and drives on."""
    speed = getattr(recording, "speed", None)
    known = np.zeros(0) if speed is None else speed[start:stop]
    known = known[np.isfinite(known)]
    return bool(len(known)) and abs(float(np.median(known))) > DRIVES


def _before_drive(recording: Recording, stop: int) -> int:
    """The row before ``stop`` at which the first speed is above ``DRIVES``; 0 of a body that drives
    from the start. What begins gently may look still for longer than it is.
    """
    moves = np.flatnonzero(np.abs(np.nan_to_num(recording.speed[:stop])) > DRIVES)
    return int(moves[0]) if recording.time[moves[0]] - recording.time[0] > LENGTHS[0] else 0


def _rest(
    recording: Recording, stop: int, gravity: float, seen: bool, declared: bool = False
) -> Rest:
    """The rest of the rows before ``stop``."""
    rate, force = (finite_rows(v, stop) for v in (recording.gyro, recording.accel))
    mean, mean_std = np.zeros(3), np.zeros(3)
    if len(rate):
        mean, mean_std = rate.mean(axis=0), rate.std(axis=0) / np.sqrt(len(rate))
    moving = None if seen or not len(force) else underway(recording)
    shown = force.mean(axis=0) if len(force) else np.zeros(3)
    shown = shown if moving is None else moving.force
    # In motion even a force of half the magnitude of gravity is a better direction than none.
    usable = len(force) and _is_gravity(shown, gravity, FORCE_OFF if seen else np.inf)
    period = recording.sample_period
    rate_density, force_density = (root_density(v, period, seen) for v in (rate, force))
    return Rest(
        seen and len(rate) > 1,
        slice(0, stop),
        float(recording.time[stop - 1] - recording.time[0]),
        mean,
        shown if usable else None,
        white_std(rate),
        white_std(force),
        np.hypot(mean_std, 1e-6),
        rate_density,
        force_density,
        gravity,
        declared,
        seen and not declared and sways(rate, period, float(np.mean(rate_density**2))),
        underway=moving,
    )


def sways(rate: np.ndarray, period: float, noise: float) -> bool:
    """Whether the ``rate`` (n, 3) rad/s of a body that looks still is that of one that stands on
    nothing solid, as the filter judges it (``stillness.sways``); ``noise`` in (rad/s)^2/Hz is the
    density of its gyro's white noise.
    """
    if len(rate) * period < SLOW:
        return False
    left = rate - rate.mean(axis=0)
    density = np.mean((lagged(left, period, FAST) - lagged(left, period, SLOW)) ** 2) / SHARE
    return bool(density > swaying_density(len(rate) * period, noise))


def lagged(values: np.ndarray, period: float, time: float) -> np.ndarray:
    """Samples (n, 3), one a ``period`` s, behind a lag of the first order with a ``time`` constant
    in s, from zero on: (time + period) y[k] - time y[k - 1] = period x[k].

    As equations in all y at once, since ``scipy.signal`` takes a quarter of a second to load.
    """
    bands = np.empty((2, len(values)))
    bands[0], bands[1] = time + period, -time
    return solve_banded((1, 0), bands, period * values, check_finite=False)


def root_density(values: np.ndarray, period: float, still: bool) -> np.ndarray:
    """Root (3,) of the density of what is white up to some hertz in samples (n, 3), one a
    ``period`` s.

    Behind a low-pass, as sensors have it on the chip, neighbours are alike, and their differences
    show a fraction of it: there it is taken from the differences of means, if the body is
    ``still``. The noise of a sample that is none's neighbour hides nothing of a hand that trembles.
    """
    own = white_std(values) * np.sqrt(period)
    count = min(round(MEAN_TIME / period), len(values) // FEWEST_MEANS)
    if not still or count < 2 or not _is_filtered(values):
        return own
    means = values[: len(values) // count * count].reshape(-1, count, 3).mean(axis=1)
    return np.maximum(own, white_std(means) * np.sqrt(count * period))


def _is_filtered(values: np.ndarray) -> bool:
    """Whether samples (n, 3) of a body at rest are like their neighbours."""
    step = np.diff(values, axis=0)
    step = step - step.mean(axis=0)
    power = np.sum(step**2, axis=0)
    moves = power > 0
    alike = np.sum(step[1:] * step[:-1], axis=0)[moves] / power[moves]
    return bool(moves.any()) and float(alike.mean()) > UNFILTERED


def white_std(values: np.ndarray) -> np.ndarray:
    """Standard deviation (3,) of a sample's white noise.

    It is taken from the differences of neighbours, so that motion and drift are not in it.
    """
    return np.diff(values, axis=0).std(axis=0) / np.sqrt(2) if len(values) > 2 else np.zeros(3)
