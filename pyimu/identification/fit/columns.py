"""A trial linearised: its residual, and a column for each coefficient."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from pyimu.identification.fit.band import Band
from pyimu.identification.fit.inputs import LogState, before, own_rate, reference_input
from pyimu.identification.fit.keys import (
    Coefficient,
    Key,
    LogBias,
    LogClock,
    LogLag,
    LogPlace,
    LogTurn,
    coefficient_of,
)
from pyimu.identification.fit.limited import without_limit
from pyimu.identification.fit.reduction import Rows
from pyimu.identification.fit.response import (
    Columns,
    after_dynamics,
    before_dynamics,
    behind_dynamics,
    dynamics,
    is_driven,
    memoryless,
    predict,
    remembers,
    through_dynamics,
    with_memory,
)
from pyimu.identification.fit.trial import Trial
from pyimu.model.arguments import Parameter
from pyimu.model.catalogue import CATALOGUE, POWER_ON
from pyimu.model.chain import Slot
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS

TEMPERATURE, ITS_RATE = COLUMNS["temperature"].start, COLUMNS["temperature_rate"].start

SMALL_LAG = 0.1
"""s; a step of a thermometer's lag that changes a temperature by far less than its noise."""


@dataclass(frozen=True)
class Stack:
    """Columns (``count``, c), each an array of its own: together they would be too many to hold
    twice.
    """

    count: int
    arrays: tuple[np.ndarray, ...] = ()

    @classmethod
    def of(cls, columns: np.ndarray) -> Stack:
        """Those of an array (m, c)."""
        return cls(len(columns), tuple(np.ascontiguousarray(columns.T)))

    @property
    def shape(self) -> tuple[int, int]:
        return self.count, len(self.arrays)

    def __add__(self, other: Stack) -> Stack:
        """The columns of both, side by side."""
        return Stack(self.count, (*self.arrays, *other.arrays))

    def __array__(self, dtype=None, copy=None) -> np.ndarray:
        return self.after(np.zeros((self.count, 0)), 0, self.count)

    def after(self, first: np.ndarray, start: int, stop: int) -> np.ndarray:
        """Rows ``start`` to ``stop``, behind columns ``first`` of these rows, column by column."""
        out = np.empty((first.shape[1] + len(self.arrays), stop - start))
        out[: first.shape[1]] = first.T
        for at, values in enumerate(self.arrays, first.shape[1]):
            out[at] = values[start:stop]
        return out.T


@dataclass(frozen=True)
class Linear:
    """A trial linearised: residual (m, 3) in its band, and for each axis the columns that act on
    it.
    """

    time: np.ndarray
    segments: list[tuple[int, int]]
    residual: np.ndarray
    keys: dict[int, list[Key]]
    columns: dict[int, Stack]


def in_log(sensor: Sensor, state: LogState) -> Sensor:
    """The sensor as a log has it: its bias there comes before what the output does to it."""
    effect, parameter = POWER_ON
    declared = sensor.values[effect][parameter] if effect in sensor.values else 0.0
    return sensor.with_values(effect, **{parameter: declared + state.bias})


def residual(sensor: Sensor, trial: Trial, state: LogState) -> np.ndarray:
    """Measured less model (n, 3), at the sample rate; zero where the output is known to stop."""
    u = reference_input(trial, state)
    sensor, weights = without_limit(sensor, trial)
    y = predict(in_log(sensor, state), u, trial.segments, trial.h, before(trial, state))
    return _counting(trial.left(sensor, y), weights)


def _counting(values: np.ndarray, share: np.ndarray | None) -> np.ndarray:
    """Values of samples by what these count for."""
    return values if share is None else share * values


def in_band(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Rows (m, c) of values (n, c) as the trial's band shows them."""
    return trial.band.apply(values, trial.row_segments)


def band_segments(trial: Trial) -> list[tuple[int, int]]:
    """Segments of the rows that ``in_band`` gives."""
    lengths = [len(trial.band.rows(*s)) for s in trial.row_segments]
    ends = np.cumsum([n for n in lengths if n])
    return list(zip([0, *ends[:-1].tolist()], ends.tolist(), strict=True)) if len(ends) else []


def band_time(trial: Trial) -> np.ndarray:
    return trial.row_time


class Regressors:
    """Collects regressors as (key, axis, values at the sample rate) and filters them together.

    Many are kept in single precision (``many``): what others must leave of a column to count
    (``normal.DEAD``) is far above its rounding.
    """

    def __init__(self, trial: Trial, many: bool = False, weights: np.ndarray | None = None) -> None:
        self.weights = weights
        self.trial, self.precision = trial, np.float32 if many else np.float64
        self.items: list[tuple[Key, int, np.ndarray]] = []

    def add(self, key: Key, axis: int, values: np.ndarray) -> None:
        if axis in self.trial.axes and _is_any(values):
            share = None if self.weights is None else self.weights[:, axis]
            values = _counting(values, share)
            self.items.append((key, axis, values.astype(self.precision, copy=False)))

    def filtered(self) -> tuple[dict[int, list[Key]], dict[int, Stack]]:
        keys = {i: [k for k, axis, _ in self.items if axis == i] for i in self.trial.axes}
        columns = {i: self._filtered([v for _, axis, v in self.items if axis == i]) for i in keys}
        return keys, columns

    def _filtered(self, arrays: list[np.ndarray]) -> Stack:
        trial = self.trial
        count = len(trial.row_time)
        if trial.band == Band():
            return Stack(count, tuple(trial.band.apply(v, trial.row_segments) for v in arrays))
        stacked = np.array(arrays).reshape(len(arrays), len(trial.time))
        return Stack(count, tuple(in_band(trial, stacked.T).T))


def _is_any(values: np.ndarray) -> bool:
    """Whether any of values (n,) is not zero: one in the middle mostly says so."""
    return bool(values[len(values) // 2 :][:1].any() or values.any())


def linearise(
    sensor: Sensor, trial: Trial, state: LogState, wanted: Iterable[Key], extra: Iterable = ()
) -> Linear:
    """Residual and columns of a trial.

    ``sensor`` holds the model and any candidates at their identity; ``wanted`` are the keys of the
    coefficients that get columns; ``extra`` are functions ``(trial, u, y, add)`` that add columns
    of their own (scans, generic inputs).
    """
    wanted = frozenset(wanted)
    rows = None if trial.reduction is None else trial.rows(sensor, state.bias)
    u = reference_input(trial, state) if rows is None else rows.u
    sensor, weights = without_limit(sensor, trial)
    own, sensor = OWN[trial.kind], in_log(sensor, state)
    rest = after_dynamics(sensor)
    earlier = None if rows is not None else before(trial, state)
    moved = behind_dynamics(sensor, u, trial.segments, trial.h, earlier)
    moved = with_memory(rest, moved, trial.h, earlier)
    response = memoryless(rest.chain)
    keys = [_keys_of(s, trial, sensor.kind, wanted) for s in rest.slots]
    some = np.array([bool(k) for k in keys], dtype=bool)
    out = Regressors(trial, bool(extra), weights)
    y, slope, entries = response(moved, rest.p, trial.h, some[response.slot], out.precision)
    if remembers(sensor):
        y = predict(sensor, u, trial.segments, trial.h)
    for axis, slot, values in zip(response.axis, response.slot, entries, strict=True):
        for key in keys[slot]:
            out.add(key, int(axis), values)
    _turn_columns(out, trial, moved[own], slope)
    _place_columns(out, sensor, trial, state, slope)
    _clock_columns(out, sensor, trial, state, u, slope)
    _thermometer_columns(out, rest, trial, moved)
    _motion_columns(out, sensor, trial, u, slope, wanted)
    _stepped_columns(out, sensor, trial, u, wanted)
    for function in extra:
        function(trial, u, y, out.add)
    if rows is not None:
        return reduced(trial, rows, out.items)
    keys, columns = out.filtered()
    return Linear(
        band_time(trial),
        band_segments(trial),
        in_band(trial, _counting(trial.left(sensor, y), weights)),
        keys,
        columns,
    )


def _keys_of(s: Slot, trial: Trial, kind: str, wanted: frozenset[Key]) -> list[Key]:
    """What the slope against a coefficient is a column of: itself, and the log's own bias."""
    itself = coefficient_of(s) in wanted and not _remembered(s, kind)
    found: list[Key] = [coefficient_of(s)] if itself else []
    if (s.effect, s.parameter) == POWER_ON:
        found.append(LogBias(trial.name, s.index[0]))
    return found


def with_columns(
    one: Linear, sensor: Sensor, trial: Trial, state: LogState, extra: Iterable
) -> Linear:
    """A linearised trial of samples with the columns that functions ``(trial, u, add)`` add."""
    u = reference_input(trial, state)
    out = Regressors(trial, weights=without_limit(sensor, trial)[1])
    for function in extra:
        function(trial, u, out.add)
    keys, columns = out.filtered()
    return replace(
        one,
        keys={i: one.keys[i] + keys[i] for i in one.keys},
        columns={i: one.columns[i] + columns[i] for i in one.keys},
    )


def reduced(trial: Trial, rows: Rows, items: Iterable[tuple[Key, int, np.ndarray]] = ()) -> Linear:
    """A trial of rows that are not samples, white, as one axis: ``items`` are columns at the sample
    rate, by axis.
    """
    columns: dict[Key, np.ndarray] = {}
    for key, axis, values in items:
        if not (trial.reduction.any_turn and _is_turn(key)):
            columns[key] = columns.get(key, 0.0) + rows.weights[axis] @ values
    made = np.column_stack([rows.residual, *columns.values()])
    white = trial.reduction.whiten(made)
    time = trial.reduction.time
    stack = Stack(len(time), tuple(white[:, 1:].T))
    return Linear(time, [(0, len(time))], white[:, :1], {0: list(columns)}, {0: stack})


def _is_turn(key: Key) -> bool:
    """Whether a coefficient of a mounting's effect lies below the diagonal: where the whole triad
    may turn, those above it say all there is.
    """
    return isinstance(key, Coefficient) and (
        CATALOGUE[key.effect].mounting and key.index[0] > key.index[1]
    )


def _turn_columns(out: Regressors, trial: Trial, x: Columns, slope: np.ndarray) -> None:
    """Where the mounting is free, a small turn about each axis k: e_k x ``x``, x being three
    columns (n,).
    """
    if trial.free_rotation:
        for k in range(3):
            one, other = (k + 1) % 3, (k + 2) % 3
            for i in range(3):
                turned = slope[:, i, other] * x[one] - slope[:, i, one] * x[other]
                out.add(LogTurn(trial.name, k), i, turned)


def _behind(slope: np.ndarray, change: np.ndarray) -> Columns:
    """What a ``change`` (n, 3) of the own signal is behind a ``slope`` (n, 3, 3), axis by axis.

    Column by column, as the slope lies in memory: einsum, row by row, takes several times longer.
    """
    return [sum(slope[:, i, j] * change[:, j] for j in range(3)) for i in range(3)]


def _place_columns(
    out: Regressors, sensor: Sensor, trial: Trial, state: LogState, slope: np.ndarray
) -> None:
    """Where the reference force acts at a point that is not known, what it would be elsewhere."""
    if trial.place is None:
        return
    for number in trial.place.unknown:
        there = trial.place.forces[number].T @ state.rotation.T
        moved = through_dynamics(sensor, there, trial.segments, trial.h)
        for i, change in enumerate(_behind(slope, moved)):
            out.add(LogPlace(trial.name, number), i, change)


def _clock_columns(
    out: Regressors,
    sensor: Sensor,
    trial: Trial,
    state: LogState,
    u: np.ndarray,
    slope: np.ndarray,
) -> None:
    """What is left of the log's clock: each second of it takes the motion's rate off the sensor's
    own signal, and each second per second as much as has passed since the middle.
    """
    if state.clock is None:
        return
    rate = u[:, own_rate(trial.kind)]
    since = (trial.time - state.clock.middle)[:, None]
    for order in trial.clock.room(1.0):
        later = through_dynamics(sensor, -rate * since**order, trial.segments, trial.h)
        for i, turned in enumerate(_behind(slope, later)):
            out.add(LogClock(trial.name, order), i, turned)


def _thermometer_columns(out: Regressors, rest: Sensor, trial: Trial, moved: Columns) -> None:
    """What a lag of the log's thermometer changes in all that depends on temperature."""
    if not has_thermometer(rest, trial):
        return
    ends = []
    for sign in (1.0, -1.0):
        later = list(moved)
        later[TEMPERATURE] = moved[TEMPERATURE] + sign * SMALL_LAG * moved[ITS_RATE]
        ends.append(memoryless(rest.chain).output(later, rest.p, trial.h))
    change = (ends[0] - ends[1]) / (2 * SMALL_LAG)
    for i in range(3):
        out.add(LogLag(trial.name), i, change[:, i])


def has_thermometer(sensor: Sensor, trial: Trial) -> bool:
    """Whether a lag of the log's thermometer matters to a model: one that follows temperature."""
    logged = {"temperature", "temperature_rate"} <= trial.known and trial.reduction is None
    return logged and any("temperature" in e.signals(sensor.kind) for e in sensor.effects)


def _motion_columns(
    out: Regressors,
    sensor: Sensor,
    trial: Trial,
    u: np.ndarray,
    slope: np.ndarray,
    wanted: frozenset[Key],
) -> None:
    """Slopes against the coefficients of what comes before the dynamics: through these, and through
    what follows.
    """
    chain = before_dynamics(sensor)
    if not any(coefficient_of(s) in wanted for s in chain.slots):
        return
    response = memoryless(chain.chain)
    known = with_memory(chain, list(u.T), trial.h)
    entries = response(known, chain.p, trial.h)[2]
    for number, s in enumerate(chain.slots):
        of_slot = np.flatnonzero(response.slot == number)
        if coefficient_of(s) not in wanted or not len(of_slot):
            continue
        change = np.zeros((len(u), 3))
        for e in of_slot:
            change[:, response.axis[e]] = entries[e]
        change = through_dynamics(sensor, change, trial.segments, trial.h)
        for i, behind in enumerate(_behind(slope, change)):
            out.add(coefficient_of(s), i, behind)


def _remembered(s: Slot, kind: str) -> bool:
    """Whether a coefficient shapes what its effect remembers."""
    return s.definition.form and is_driven(CATALOGUE[s.effect], kind)


def _stepped_columns(
    out: Regressors, sensor: Sensor, trial: Trial, u: np.ndarray, wanted: frozenset[Key]
) -> None:
    """Slopes against the coefficients of dynamics that are switched on, and of what shapes a
    memory, by central differences, one-sided at a bound.
    """
    filters = {e.name for e in dynamics(sensor).effects}
    for s, value in zip(sensor.slots, sensor.p, strict=True):
        shapes = _remembered(s, sensor.kind) and sensor.acts(s.effect)
        switched_on = s.effect in filters and not sensor.is_off(s.effect)
        if coefficient_of(s) not in wanted or not (shapes or switched_on):
            continue
        step = 1e-3 * max(abs(value), 1e-3 * trial.h)
        ends = clipped(s.definition, value + step), clipped(s.definition, value - step)
        high, low = (predict(_moved(sensor, s, v), u, trial.segments, trial.h) for v in ends)
        for i in range(3):
            out.add(coefficient_of(s), i, (high[:, i] - low[:, i]) / (ends[0] - ends[1]))


def _moved(sensor: Sensor, slot, value: float) -> Sensor:
    array = np.array(sensor.values[slot.effect][slot.parameter])
    array[slot.index] = value
    return sensor.with_values(slot.effect, **{slot.parameter: array})


def clipped(definition: Parameter, value: float) -> float:
    """A value of a coefficient, or the bound that it is beyond."""
    least, most = (
        bound if bound is not None else unbounded
        for bound, unbounded in ((definition.minimum, -np.inf), (definition.maximum, np.inf))
    )
    return min(max(value, least), most)
