"""What a part would measure of a known motion: arrays or a whole recording through the C of its FMU.

The inputs go through in pieces that stay in the processor's cache, so that nothing is made of the length of the log but the
measurements.  Sample 1 of the noise belongs to the first row, as in an FMU that is started one sample period before it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise

import numpy as np

from pyimu.block import Block, Run
from pyimu.columns import column_names
from pyimu.errors import Finding, UserError
from pyimu.imu import Part
from pyimu.partfile import part as find_part
from pyimu.recording import Recording, filled
from pyimu.reference import reference_rate
from pyimu.sensor import Sensor
from pyimu.signals import SIGNALS, inputs_for, inputs_of
from pyimu.units import did_you_mean

PIECE = 8192
"""Rows that go through at a time."""

LONGEST_GAP = 3600.0
"""s; a longer gap in a recording counts as that long."""

SAME_PERIOD = 1e-6
"""Up to this share of it a recording's sample period is the part's own: time stamps are rounded."""

GROUPS = {"specific_force": "ref_force", "temperature": "temperature", "supply": "supply", "mag": "mag", "attitude": "ref_q",
          "latitude": "latitude", "velocity": "ref_velocity"}
"""Where a recording holds the inputs of a part, less the rate, which may follow from other columns."""

MEASURED = {"rate": "gyro", "specific_force": "accel"}
"""What stands for an unknown truth where it only enters another sensor's small errors."""


# ---- arrays ---------------------------------------------------------------------------------------------------------------


def simulate(part: Part | str | os.PathLike, rate: np.ndarray, specific_force: np.ndarray, temperature: np.ndarray | float = 25.0, *,
             seed: int | None = 0, sample_period: float | None = None, **others: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
    """Measured rate and specific force, each (n, 3), of a part that moves as given (rad/s, m/s^2, degC).

    The part may be a name or a file (see ``pyimu.part``).
    ``others`` are inputs by their names in ``SIGNALS`` that the part's effects need: ``supply`` (n,) V, ``mag`` (n, 3) T and so
    on; one that they do not need is ignored.  Any input but the rate may be a constant.

    Row k draws the noise that the FMU draws for its sample k + 1 under the same seed; ``seed=None`` is noise off.  A row that
    is NaN gives NaN; the sensors' memories hold their last values through it.  Raises UserError for an input that is unknown,
    missing, no number or of a wrong shape, and for a part, a seed or a sample period that is none.
    """
    part = find_part(part)
    given = {"rate": rate, "specific_force": specific_force, "temperature": temperature, **others}
    names = inputs_for(part.signals)
    for name in others:
        if name not in SIGNALS or SIGNALS[name].derived:
            known = [n for n, s in SIGNALS.items() if not s.derived]
            raise UserError(f"unknown input '{name}'{did_you_mean(name, known)}; known are {', '.join(known)}")
    missing = [name for name in names if name not in given]
    if missing:
        raise UserError(f"part {part.name} has effects of {', '.join(missing)}: give them as arguments of these names")
    h = part.sample_period if sample_period is None else sample_period
    arrays = {name: _numbers(name, given[name]) for name in names}
    if arrays["rate"].ndim != 2:
        raise UserError(f"rate has shape {arrays['rate'].shape}, expected (n, 3)")
    y = _measure(part.block, arrays, len(arrays["rate"]), {}, seed, h)
    return y["gyro"], y["accel"]


def _numbers(name: str, values: np.ndarray | float) -> np.ndarray:
    """An input as an array, its kind of number as it is.  Raises UserError for what is no array of real numbers."""
    try:
        array = np.asarray(values)
    except ValueError:
        raise UserError(f"{name}: its rows are of unequal length") from None
    if array.dtype.kind not in "fiub":
        raise UserError(f"{name} must be an array of real numbers, not {array.dtype} as in {str(values)[:40]!r}")
    return array


def _measure(block: Block, given: Mapping[str, np.ndarray | float], n: int, missing: Mapping[int, int], seed: int | None,
             sample_period: float) -> dict[str, np.ndarray]:
    """Each group of outputs (n, size) by name; ``missing`` says how many samples no row has been kept of before a row."""
    inputs, outputs = _places(block.inputs), _places(block.outputs)
    source = _Inputs(block, inputs, given, n)
    measured = {name: np.empty((n, at.stop - at.start)) for name, at in outputs.items()}
    columns = [(at.start + i, column) for name, at in outputs.items() for i, column in enumerate(measured[name].T)]
    run = Run(block, n + sum(missing.values()), seed=seed, sample_period=sample_period)
    y = np.empty((PIECE, len(block.outputs)))
    for start, stop in pairwise([0, *sorted(missing), n]):
        if start:
            for u in source.between(start - 1, start, missing[start]):
                run.advance(u, y=y[:len(u)])
        for k in range(start, stop, PIECE):
            rows = slice(k, min(k + PIECE, stop))
            made = run.advance(source.rows(rows), y=y[:rows.stop - k])
            for column, to in columns:
                to[rows] = made[:, column]
    return measured


def _places(variables) -> dict[str, slice]:
    """Where each array stands in a vector of scalars that are named ``name`` or ``name[i]``."""
    names = [v.name.partition("[")[0] for v in variables]
    return {name: slice(names.index(name), names.index(name) + names.count(name)) for name in names}


class _Inputs:
    """The inputs of a block, a piece at a time: rows of arrays beside constants, and start values where nothing is given."""

    def __init__(self, block: Block, places: Mapping[str, slice], given: Mapping[str, np.ndarray | float], n: int) -> None:
        self._u = np.tile([v.start for v in block.inputs], (PIECE, 1))
        self._held = places.get("attitude", slice(0))
        self._columns = []  # one by one, as numpy copies narrow rows slowly
        for name, values in given.items():
            at, values = places[name], np.asarray(values)
            size = at.stop - at.start
            row = () if size == 1 else (size,)
            if values.shape == row:
                self._u[:, at] = values
            elif values.shape == (n, *row):
                self._columns += [(at.start + i, column) for i, column in enumerate(values.reshape(n, size).T)]
            else:
                raise UserError(f"{name} has shape {values.shape}, expected {(n, *row)} or {row}")

    def rows(self, rows: slice) -> np.ndarray:
        """Inputs (rows, nu), good until the next call."""
        u = self._u[:rows.stop - rows.start]
        for at, values in self._columns:
            u[:, at] = values[rows]
        return u

    def between(self, before: int, after: int, count: int) -> Iterator[np.ndarray]:
        """``count`` inputs on the straight way from a row to another; an attitude, which has no straight way, is held."""
        first, last = self.rows(slice(before, before + 1))[0].copy(), self.rows(slice(after, after + 1))[0].copy()
        last[self._held] = first[self._held]
        for k in range(0, count, PIECE):
            share = np.arange(k + 1, min(k + PIECE, count) + 1)[:, None] / (count + 1)
            yield first + share * (last - first)


# ---- recordings -----------------------------------------------------------------------------------------------------------


def simulate_recording(model: Part | Sensor, recording: Recording, *, seed: int | None = 0) -> Recording:
    """The recording as ``model`` would have measured it: ``gyro`` and ``accel`` (of a ``Sensor`` its own) replaced, all else kept.

    The truth comes from the recording: the rate from ``ref_rate``, else differentiated from ``ref_q`` as ``reference_rate``
    says; the specific force from ``ref_force``; both are those of a part at rest where there is no reference at all: no rate,
    and the mean of ``accel`` or, without one, level.  What enters only the errors of the other sensor may be the measured ``gyro`` or
    ``accel``.  The temperature is 25 degC where none was recorded.  ``supply``, ``mag``, ``ref_q``, ``latitude`` and
    ``ref_velocity`` are taken where an effect needs them.

    The sample period is the recording's (a part's own where the two agree), and the sensor runs on where rows are missing: through
    a gap, of at most an hour, and empty cells its inputs go straight from neighbour to neighbour, and its noise and time go on.
    Rows without the truth that a sensor measures become NaN, and a finding ``unknown_truth`` counts them.  The noise is
    that of ``simulate``; ``seed=None`` is noise off.

    Raises UserError for a truth that the recording lacks and the model needs, naming the column.
    """
    if len(recording) < 2:
        raise UserError(f"{recording.name}: one row has no sample period, a simulation needs at least 2")
    part, sensors = (_alone(model), (model,)) if isinstance(model, Sensor) else (model, (model.gyro, model.accel))
    truth = _Truth(recording, sensors)
    given = {name: truth.filled(name) for name in truth.needed}
    y = _measure(part.block, given, len(recording), _missing(recording), seed, _period(model, recording))
    findings = [f for f in recording.findings if not f.column.startswith(tuple(s.kind for s in sensors))]
    for sensor in sensors:
        unknown = truth.unknown(sensor.output.own)
        if unknown is not None:
            y[sensor.kind][unknown] = np.nan
            findings.append(Finding("unknown_truth", sensor.kind, int(unknown.sum())))
    return replace(recording, **{s.kind: y[s.kind] for s in sensors}, path=None, findings=tuple(findings))


@lru_cache(maxsize=16)
def _alone(sensor: Sensor) -> Part:
    return Part(sensor.kind, 1.0, **{sensor.kind: sensor})


def _period(model: Part | Sensor, recording: Recording) -> float:
    h = recording.sample_period
    own = h if isinstance(model, Sensor) else model.sample_period
    return own if abs(own - h) < SAME_PERIOD * h else h


def _missing(recording: Recording) -> dict[int, int]:
    """How many samples are missing before the rows that follow a gap."""
    h, longest = recording.sample_period, max(1, round(LONGEST_GAP / recording.sample_period))
    starts = [start for start, _ in recording.segments[1:]]
    return {k: min(round((recording.time[k] - recording.time[k - 1]) / h), longest) - 1 for k in starts}


class _Truth:
    """What a recording knows of the inputs that the effects of some sensors need."""

    def __init__(self, recording: Recording, sensors: tuple[Sensor, ...]) -> None:
        self.recording = recording
        self.own = {s.output.own: s.kind for s in sensors}
        named = frozenset().union(*(s.signals for s in sensors))
        others = inputs_of(named)
        self.needed = [*self.own, *sorted(others - set(self.own))]
        self.rate, self.at_rest = recording.ref_rate, False
        if self.rate is None:
            reference = reference_rate(recording)
            self.at_rest = reference.kind == "static"
            self.rate = np.zeros(3) if self.at_rest else reference.rate
        self.values = {name: self._values(name) for name in self.needed}

    def _values(self, name: str) -> np.ndarray:
        """The best that the recording knows of an input: an array (n, ...), or a constant."""
        for values in self._sources(name):
            if values is not None and _seen(values):
                return values
        columns = ", ".join(column_names("ref_rate" if name == "rate" else GROUPS[name]))
        which = self.own.get(name) or " and ".join(self.own.values())
        raise UserError(f"{self.recording.name}: no {columns}: the {which} cannot be simulated without the true {SIGNALS[name].text}")

    def _sources(self, name: str) -> Iterator[np.ndarray | None]:
        yield self.rate if name == "rate" else getattr(self.recording, GROUPS[name])
        if name == "specific_force" and self.at_rest:
            yield self._resting()
        if name not in self.own and name in MEASURED:
            yield getattr(self.recording, MEASURED[name])
        if name == "temperature":
            yield np.array(SIGNALS[name].start[0])

    def _resting(self) -> np.ndarray:
        accel = self.recording.accel
        if accel is None or not _seen(accel):
            return np.array(SIGNALS["specific_force"].start)
        return np.mean(accel, axis=0) if _whole(accel) else np.nanmean(accel, axis=0)

    def filled(self, name: str) -> np.ndarray:
        """The values of an input, its missing cells drawn straight from neighbour to neighbour; an attitude's are held."""
        values, time = self.values[name], self.recording.time
        if _whole(values):
            return values
        if name != "attitude":
            return filled(time, values)
        out = np.array(values, dtype=float)
        for column in out.T:
            known = np.flatnonzero(np.isfinite(column))
            column[:] = column[known[np.maximum(np.searchsorted(known, np.arange(len(column)), "right") - 1, 0)]]
        return out

    def unknown(self, name: str) -> np.ndarray | None:
        """Mask (n,) of the rows in which an axis of an input is missing, None where there are none."""
        values = self.values[name]
        return None if _whole(values) else ~np.isfinite(values).all(axis=1)


def _whole(values: np.ndarray) -> bool:
    """True where nothing is missing; a sum needs no memory."""
    return bool(np.isfinite(np.sum(values)))


def _seen(values: np.ndarray) -> bool:
    """True where no column is missing altogether."""
    return _whole(values) or bool(np.isfinite(values).any(axis=0).all())
