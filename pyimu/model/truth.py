"""Simulation from a recording: the true inputs that it knows, and what sensors measure of them.

Sample 1 of the noise belongs to the first row, as in an FMU that is started one sample period
before it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from pyimu.block.block import Block
from pyimu.errors import Finding, UserError
from pyimu.model.measure import measure
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS, inputs_of
from pyimu.recording.columns import column_names
from pyimu.recording.recording import Recording, filled

SAME_PERIOD = 1e-6
"""Up to this share of it a recording's sample period is the part's own: time stamps are rounded."""

LONGEST_GAP = 3600.0
"""s; a longer gap in a recording counts as that long."""

MEASURED = {"rate": "gyro", "specific_force": "accel"}
"""What stands for an unknown truth where it only enters another sensor's small errors."""


def measured_recording(
    block: Block,
    sensors: tuple[Sensor, ...],
    recording: Recording,
    own_period: float | None,
    seed: int | None,
) -> Recording:
    """What ``pyimu.model.simulate.simulate_recording`` says, for the block of these sensors.

    ``own_period`` [s] is that of the part, which is taken where it agrees with the recording's.
    """
    if len(recording) < 2:
        raise UserError(
            f"{recording.name}: one row has no sample period, a simulation needs at least 2"
        )
    sample_period = recording.sample_period
    if own_period is not None and abs(own_period - sample_period) < SAME_PERIOD * sample_period:
        sample_period = own_period
    truth = Truth(recording, sensors)
    given = {name: truth.filled(name) for name in truth.needed}
    kinds = [s.kind for s in sensors]
    y = measure(block, given, len(recording), _missing(recording), seed, sample_period, kinds)
    findings = [f for f in recording.findings if not f.column.startswith(tuple(kinds))]
    for sensor in sensors:
        unknown = truth.unknown(sensor.output.own)
        if unknown is not None:
            y[sensor.kind][unknown] = np.nan
            findings.append(Finding("unknown_truth", sensor.kind, int(unknown.sum())))
    return replace(
        recording, **{s.kind: y[s.kind] for s in sensors}, path=None, findings=tuple(findings)
    )


def _missing(recording: Recording) -> dict[int, int]:
    """How many samples are missing before the rows that follow a gap."""
    h, longest = recording.sample_period, max(1, round(LONGEST_GAP / recording.sample_period))
    starts = [start for start, _ in recording.segments[1:]]
    return {
        k: min(round((recording.time[k] - recording.time[k - 1]) / h), longest) - 1 for k in starts
    }


class Truth:
    """What a recording knows of the inputs that the effects of some sensors need."""

    def __init__(self, recording: Recording, sensors: tuple[Sensor, ...]) -> None:
        self.recording = recording
        self.own = {s.output.own: s.kind for s in sensors}
        named = frozenset().union(*(s.signals for s in sensors))
        others = inputs_of(named)
        self.needed = [*self.own, *sorted(others - set(self.own))]
        self.rate, self.at_rest = recording.ref_rate, False
        if self.rate is None:
            from pyimu.recording.reference.rate import reference_rate

            reference = reference_rate(recording)
            self.at_rest = reference.kind == "static"
            self.rate = np.zeros(3) if self.at_rest else reference.rate
        self.values = {name: self._values(name) for name in self.needed}

    def _values(self, name: str) -> np.ndarray:
        """The best that the recording knows of an input: an array (n, ...), or a constant."""
        for values in self._sources(name):
            if values is not None and _seen(values):
                return values
        columns = ", ".join(column_names(SIGNALS[name].group))
        which = self.own.get(name) or " and ".join(self.own.values())
        raise UserError(
            f"{self.recording.name}: no {columns}: the {which} cannot be simulated without the "
            f"true {SIGNALS[name].text}"
        )

    def _sources(self, name: str) -> Iterator[np.ndarray | None]:
        yield self.rate if name == "rate" else getattr(self.recording, SIGNALS[name].group)
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
        """The values of an input, missing cells interpolated linearly; an attitude's are held."""
        values, time = self.values[name], self.recording.time
        if _whole(values):
            return values
        if name != "attitude":
            return filled(time, values)
        out = np.array(values, dtype=float)
        for column in out.T:
            known = np.flatnonzero(np.isfinite(column))
            column[:] = column[
                known[np.maximum(np.searchsorted(known, np.arange(len(column)), "right") - 1, 0)]
            ]
        return out

    def unknown(self, name: str) -> np.ndarray | None:
        """Mask (n,) of rows in which an axis of an input is missing, None where there are none."""
        values = self.values[name]
        return None if _whole(values) else ~np.isfinite(values).all(axis=1)


def _whole(values: np.ndarray) -> bool:
    """True where nothing is missing; a sum needs no memory."""
    return bool(np.isfinite(np.sum(values)))


def _seen(values: np.ndarray) -> bool:
    """True where no column is missing altogether."""
    return _whole(values) or bool(np.isfinite(values).any(axis=0).all())
