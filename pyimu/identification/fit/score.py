"""The error of a model on data that was not fitted, and the floor that the noise alone would leave.

What belongs to a log and not to the part is found the same way for every model: on the first 30 s
of a held-out log, left out of the score, or, where the held-out rows are the end of a fitted log,
on that log's fitted rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.clock import ClockChange
from pyimu.identification.fit.columns import band_segments, in_band, in_log, linearise, residual
from pyimu.identification.fit.fit import Fit, bare, initial_state
from pyimu.identification.fit.inputs import LogState, before, reference_input
from pyimu.identification.fit.keys import Key, LogClock, LogLag, LogPlace, LogTurn
from pyimu.identification.fit.noise_floor import Processes, markov_noise, unit_noise
from pyimu.identification.fit.normal import normal_equations, solve
from pyimu.identification.fit.place import SCALE
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.trial import Trial, marked
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.model.sensor import Sensor

WINDOW = 10.0
"""Seconds over which a rate residual is integrated to an angle."""

ROTATION_PRIOR, LEAST_PRIOR = 0.05, 1e-4
"""Standard deviation [rad] of a log's mounting about that of the fitted logs: of one alone, and the
least that is taken where several agree."""

KNOWN = 1e-6
"""s; standard deviation of a thermometer's lag that other logs have shown."""

LATE, LEAST_LATE = 0.1, 1e-6
"""Share of what clocks lack that were measured without a lag of the sensor by which they differ, as
a lag is another at each frequency, and s that it is at least."""

STEADY = 1e-9
"""Standard deviation of the drift of such a clock, which all of its log has shown."""

PLACED = 0.01
"""m, m/s^2 and rad; standard deviation of where a log's reference force acts about that of the
fitted logs: a sensor is put back to a centimetre."""

FLOOR_DRAWS = 8

STEPS = 3
"""Newton steps to the state of a log that was not fitted."""


@dataclass(frozen=True)
class ErrorSums:
    """Sums over held-out rows, by axis: squares of the residual, of its integral over windows, and
    log-likelihood.
    """

    squares: np.ndarray = field(default_factory=lambda: np.zeros(3))
    rows: np.ndarray = field(default_factory=lambda: np.zeros(3))
    angle_squares: np.ndarray = field(default_factory=lambda: np.zeros(3))
    windows: np.ndarray = field(default_factory=lambda: np.zeros(3))
    log_likelihood: float = 0.0

    def __add__(self, other: ErrorSums) -> ErrorSums:
        return ErrorSums(*(getattr(self, n) + getattr(other, n) for n in self.__dataclass_fields__))

    def with_variance(self, variance: np.ndarray) -> ErrorSums:
        """With a ``variance`` (3,) more in each row."""
        return replace(self, squares=self.squares + self.rows * variance)

    @property
    def per_axis(self) -> np.ndarray:
        """RMS residual of each axis, NaN where no row counts."""
        return _root(self.squares, self.rows)

    @property
    def total(self) -> float:
        return float(_root(self.squares.sum(), self.rows.sum()))

    @property
    def angle_per_axis(self) -> np.ndarray:
        return _root(self.angle_squares, self.windows)

    @property
    def angle(self) -> float:
        return float(_root(self.angle_squares.sum(), self.windows.sum()))


def _root(squares, count):
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.sqrt(np.where(np.asarray(count) > 0, squares / count, np.nan))


def held_state(fit: Fit, trial: Trial) -> tuple[LogState, Trial]:
    """State of a held-out log under a model, and the rows that are left to score."""
    if trial.reduction is not None:
        return fit.states[trial.name] if trial.name in fit.states else _own_state(fit, trial), trial
    if trial.parent is not None:
        parent = next(t for t in fit.trials if t.name == trial.parent)
        state = fit.states[parent.name]
        left = in_band(parent, residual(fit.sensor, parent, state)).mean(axis=0)
        return replace(state, bias=state.bias + left), trial
    head, rest = trial.head()
    return _head_state(fit, head), rest


def _own_state(fit: Fit, trial: Trial) -> LogState:
    """State of a log whose rows are judged by each other, from all of them."""
    state = LogState(np.array(trial.reduction.bias))
    for _ in range(STEPS):
        normal = normal_equations([linearise(fit.sensor, trial, state, ())], fit.noise)
        for key, change in zip(normal.keys, solve(normal.gram, normal.score), strict=True):
            state = state.moved(key, change)
    return state


def _head_state(fit: Fit, head: Trial) -> LogState:
    """Bias and, where it is free, mounting from the first seconds, the mounting drawn towards that
    of the fitted logs.
    """
    if not head.count:
        return LogState()
    # The thermometer goes with the part.
    lag = float(np.mean([s.lag for s in fit.states.values()]))
    place = np.mean([s.place for s in fit.states.values()], axis=0)
    place[SCALE:] = 0.0  # their scale, and what is left of a filter, is each log's own
    clock = _clock_to_begin(fit, head)
    mountings = [LogState(np.zeros(3), r, lag, clock, place) for r in _mountings(fit, head)]
    state = min(mountings, key=lambda s: float(np.sum(_centred(fit, head, s) ** 2)))
    spread, late = _spread(fit), max(LATE * abs(clock.offset), LEAST_LATE) if clock else np.inf
    white = {i: RandomWalk(n.r, 0.0) for i, n in fit.noise.items()}
    for _ in range(2):
        normal = normal_equations([linearise(fit.sensor, head, state, ())], white)
        if not normal.keys:
            return state
        known = {LogTurn: spread**-2, LogLag: KNOWN**-2, LogPlace: PLACED**-2, LogClock: STEADY**-2}
        known |= {LogClock(head.name, 0): late**-2, **_of_positions(head)}
        prior = np.diag([known.get(k, known.get(type(k), 0.0)) for k in normal.keys])
        for key, change in zip(normal.keys, solve(normal.gram + prior, normal.score), strict=True):
            state = state.moved(key, change)
    return state


def _of_positions(head: Trial) -> dict[Key, float]:
    """What is known beforehand of the scale of positions and of what is left of a filter over them,
    one over variances.
    """
    if head.place is None:
        return {}
    own = (k for k in head.place.unknown if k >= SCALE)
    return {LogPlace(head.name, k): head.place.std[k] ** -2.0 for k in own}


def _clock_to_begin(fit: Fit, head: Trial) -> ClockChange | None:
    """What the clock of a log lacks that was measured without a lag of the sensor: what those of
    the fitted logs do.
    """
    found = [s.clock.offset for s in fit.states.values() if s.clock is not None]
    if head.clock is None or not head.clock.apart or not found:
        return None
    return ClockChange(float(head.time[0]), float(np.mean(found)))


def _mountings(fit: Fit, head: Trial) -> list[np.ndarray]:
    """The mountings to begin with: that of the fitted logs, and the one the log itself shows."""
    if not head.free_rotation:
        return [np.eye(3)]
    return [fit.states[fit.trials[0].name].rotation, initial_state(fit.sensor, head).rotation]


def _centred(fit: Fit, head: Trial, state: LogState) -> np.ndarray:
    r = in_band(head, residual(fit.sensor, head, state))
    return r - r.mean(axis=0) if len(r) else r


def _spread(fit: Fit) -> float:
    """How far, in rad, the mountings of the fitted logs lie apart."""
    mountings = [fit.states[n].rotation for n in {t.name for t in fit.trials if t.free_rotation}]
    if len(mountings) < 2:
        return ROTATION_PRIOR
    turns = [Rotation.from_matrix(m @ mountings[0].T).magnitude() for m in mountings[1:]]
    return max(LEAST_PRIOR, float(np.sqrt(np.mean(np.square(turns)))))


def compared(fit: Fit, held: Iterable[Trial], axis: int) -> tuple[np.ndarray, np.ndarray]:
    """The output of an axis by the model, and as it was measured, in the fitted and held-out rows
    that count.
    """
    pairs = [(t, fit.states[t.name]) for t in fit.trials]
    pairs += [(rest, state) for state, rest in (held_state(fit, t) for t in held)]
    made = [sides(fit.sensor, t, state, axis) for t, state in pairs]
    x, y = (np.concatenate(values) for values in zip(*made, strict=True))
    return x, y


def sides(
    sensor: Sensor, trial: Trial, state: LogState, axis: int
) -> tuple[np.ndarray, np.ndarray]:
    """The output of an axis by a sensor, and as measured, in the rows that count."""
    u, earlier = reference_input(trial, state), before(trial, state)
    x = predict(in_log(sensor, state), u, trial.segments, trial.h, earlier)
    counted = marked(trial.row_segments, len(x))
    return x[counted, axis], trial.y[counted, axis]


def tally(fit: Fit, trial: Trial) -> ErrorSums:
    """Score of a fitted model on one held-out trial."""
    state, rest = held_state(fit, trial)
    r = in_band(rest, residual(fit.sensor, rest, state))
    return sums(rest, r) + ErrorSums(log_likelihood=log_likelihood(fit, rest, r))


def log_likelihood(fit: Fit, trial: Trial, r: np.ndarray) -> float:
    """Gaussian log-likelihood [nat] of a residual under the model's noise, summed over axes."""
    normal = normal_equations([bare(trial, r)], fit.noise)
    return normal.log_likelihood - 0.5 * normal.rows * np.log(2 * np.pi)


def sums(trial: Trial, r: np.ndarray) -> ErrorSums:
    """Sums of the squares of rows (m, 3) in a trial's band, on the axes of its reference."""
    squares, rows = np.zeros(3), np.zeros(3)
    angle, windows = np.zeros(3), np.zeros(3)
    step = float(np.median(np.diff(trial.time))) * trial.band.stride
    length = max(1, round(WINDOW / step))
    for i in trial.axes:
        squares[i], rows[i] = np.sum(r[:, i] ** 2), len(r)
        for a, b in band_segments(trial):
            whole = (b - a) // length * length
            sums = r[a : a + whole, i].reshape(-1, length).sum(axis=1) * step
            angle[i] += np.sum(sums**2)
            windows[i] += len(sums)
    return ErrorSums(squares, rows, angle, windows)


@dataclass(frozen=True)
class UnitFloor:
    """What noise alone leaves of a trial's rows: ``white`` of unit variance, and a random ``walk``
    that grows by one a second. Noise of any size leaves as many times its variance.
    """

    white: ErrorSums
    walk: ErrorSums

    def of(self, noise: Mapping[int, RandomWalk]) -> ErrorSums:
        """What a ``noise`` by axis leaves, its two parts being independent."""
        r, k2 = np.zeros(3), np.zeros(3)
        for i, n in noise.items():
            r[i], k2[i] = n.r, n.k2
        return replace(
            self.white,
            squares=r * self.white.squares + k2 * self.walk.squares,
            angle_squares=r * self.white.angle_squares + k2 * self.walk.angle_squares,
        )


def unit_floor(fit: Fit, trial: Trial, seed: int = 1) -> UnitFloor:
    """What the noise of a fitted model's axes leaves of a held-out trial, by simulation through the
    same band and bias estimate.
    """
    return UnitFloor(*_left_of(fit, trial, partial(unit_noise, fit.noise), seed))


def markov_floor(fit: Fit, trial: Trial, processes: Processes, seed: int = 1) -> ErrorSums:
    """What Gauss-Markov ``processes`` of a sensor leave of a held-out trial, likewise."""

    def draw(time: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray]:
        return (markov_noise(processes, time, rng),)

    return _left_of(fit, trial, draw, seed)[0]


def _left_of(
    fit: Fit,
    trial: Trial,
    draw: Callable[[np.ndarray, np.random.Generator], tuple[np.ndarray, ...]],
    seed: int,
) -> list[ErrorSums]:
    """What noises that are drawn (n, 3) each at times (n,) leave of a held-out trial."""
    rng = np.random.default_rng(seed)
    parent = next((t for t in fit.trials if t.name == trial.parent), None)
    head, rest = (parent, trial) if parent is not None else trial.head()
    time, total = np.union1d(head.time, rest.time), []
    of_head, of_rest = (np.searchsorted(time, t.time) for t in (head, rest))
    for _ in range(FLOOR_DRAWS):
        left = []
        for noise in draw(time, rng):
            first, last = noise[of_head], noise[of_rest]
            bias = in_band(head, first).mean(axis=0) if head.count else np.zeros(3)
            left.append(sums(rest, in_band(rest, last - bias)))
        total = [a + b for a, b in zip(total, left, strict=True)] if total else left
    return total
