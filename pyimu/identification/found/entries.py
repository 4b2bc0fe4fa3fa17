"""What the loop found, entry by entry: effects, declared values, visibility, errors, logs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from pyimu.display.brief import Brief
from pyimu.files import plain
from pyimu.identification.fit.score import ErrorSums
from pyimu.identification.logs.overview import Overview
from pyimu.model.kinds import MAGNETOMETER


@dataclass(frozen=True, repr=False)
class Added(Brief):
    """An effect that was added.

    Coefficients by name as ``(value, std, unit)``, arrays of the parameter's shape.
    """

    sensor: str
    effect: str
    alternatives: tuple[str, ...]
    parameters: dict[str, tuple[np.ndarray, np.ndarray, str]]
    gain: float
    gate: float
    note: str = ""

    def as_dict(self) -> dict[str, Any]:
        parameters = {
            n: {"value": plain(v), "std": plain(s), "unit": u}
            for n, (v, s, u) in self.parameters.items()
        }
        out = {
            "sensor": self.sensor,
            "effect": self.effect,
            "alternatives": list(self.alternatives),
            "parameters": parameters,
            "evidence": {"gain": round(self.gain, 3), "gate": round(self.gate, 3)},
        }
        return out | ({"note": self.note} if self.note else {})


@dataclass(frozen=True)
class Changed:
    """A declared value that the data contradict; ``alternatives`` are effects that would explain
    as much instead.
    """

    sensor: str
    effect: str
    parameter: str
    declared: np.ndarray
    fitted: np.ndarray
    std: np.ndarray
    unit: str
    alternatives: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        return {
            "sensor": self.sensor,
            "effect": self.effect,
            "parameter": self.parameter,
            "unit": self.unit,
            "declared": plain(self.declared),
            "fitted": plain(self.fitted),
            "std": plain(self.std),
            "alternatives": list(self.alternatives),
        }


@dataclass(frozen=True)
class Visibility:
    """The smallest coefficient of an absent effect that the logs would show, of all its elements
    and of ``each`` that they show at all, by its index.

    ``inseparable_from`` are the effects that it looks like in them.
    """

    sensor: str
    effect: str
    smallest_visible: float | None
    unit: str
    inseparable_from: tuple[str, ...] = ()
    reason: str = ""
    each: Mapping[tuple[int, ...], float] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        out = {
            "sensor": self.sensor,
            "effect": self.effect,
            "smallest_visible": plain(self.smallest_visible),
            "unit": self.unit,
            "inseparable_from": list(self.inseparable_from),
        }
        return out | ({"reason": self.reason} if self.reason else {})


@dataclass(frozen=True, repr=False)
class Errors(Brief):
    """Held-out error of one sensor before, after, and as the noise alone would leave it.

    ``floor`` is what the white noise of sensor and reference leaves, ``drift`` what the random walk
    of the sensor would add to it, ``named`` what slow noise that was named does, ``unsure`` what
    gravity there and coefficients that nobody declared may add, as far as the other rows leave them
    open, ``slow`` the most that the random walk of any part and the reference's noise make of a
    mean over seconds. ``data`` says what was held out where that is not the same for all sensors.
    """

    unit: str
    before: ErrorSums
    after: ErrorSums
    floor: ErrorSums | None
    drift: ErrorSums | None = None
    data: str = ""
    unsure: ErrorSums | None = None
    slow: ErrorSums | None = None
    named: ErrorSums | None = None

    @property
    def noise(self) -> float:
        """RMS that white noise, random walk and named noise leave together; NaN without a floor."""
        if self.floor is None:
            return float("nan")
        slow = (np.nan_to_num(one.total) for one in (self.drift, self.named) if one is not None)
        return float(np.linalg.norm([self.floor.total, *slow]))

    @property
    def noise_per_axis(self) -> np.ndarray:
        """The same of each axis (3,)."""
        if self.floor is None:
            return np.full(3, np.nan)
        slow = [np.nan_to_num(s.per_axis) for s in (self.drift, self.named) if s is not None]
        return np.linalg.norm([self.floor.per_axis, *slow], axis=0)

    @property
    def expected(self) -> float:
        """RMS that noise leaves, and what nobody knows beforehand."""
        unsure = 0.0 if self.unsure is None else np.nan_to_num(self.unsure.total)
        return float(np.hypot(self.noise, unsure))

    @property
    def expected_per_axis(self) -> np.ndarray:
        """The same of each axis (3,)."""
        unsure = 0.0 if self.unsure is None else np.nan_to_num(self.unsure.per_axis)
        return np.hypot(self.noise_per_axis, unsure)

    @property
    def expected_slow(self) -> np.ndarray:
        """RMS (3,) of the integral over a window that all of this may leave at most; NaN where no
        part's walk is known.
        """
        parts = [one for one in (self.floor, self.unsure, self.named) if one is not None]
        if self.slow is None or self.floor is None:
            return np.full(3, np.nan)
        squares = sum(np.nan_to_num(one.angle_per_axis) ** 2 for one in parts)
        return np.sqrt(self.slow.angle_per_axis**2 + squares)

    def __add__(self, other: Errors) -> Errors:
        sums = {
            n: _both(getattr(self, n), getattr(other, n))
            for n in ("before", "after", "floor", "drift", "unsure", "slow", "named")
        }
        return Errors(self.unit, **sums, data=self.data)

    def as_dict(self) -> dict[str, Any]:
        data = {"data": self.data} if self.data else {}
        row = {"unit": self.unit} | self._row("total") | {"per_axis": self._row("per_axis")}
        return row | data

    def angle_dict(self, window: float) -> dict[str, Any]:
        return (
            {"unit": "rad", "window": window}
            | self._row("angle")
            | {"per_axis": self._row("angle_per_axis")}
        )

    def _row(self, name: str) -> dict[str, Any]:
        tallies = {n: getattr(self, n) for n in ("before", "after", "floor", "drift")}
        seldom = {"unsure": self.unsure, "named": self.named}
        tallies |= {n: one for n, one in seldom.items() if one is not None}
        return {k: None if t is None else plain(getattr(t, name)) for k, t in tallies.items()}


def _both(one: ErrorSums | None, other: ErrorSums | None) -> ErrorSums | None:
    return None if one is None or other is None else one + other


@dataclass(frozen=True)
class AtRest:
    """RMS error of gravity at rest in all logs.

    As measured, and before and after with each of ``folds`` left out of the fit in turn.

    Of an accelerometer it is that of gravity's size, in m/s^2, and a fold is a position; of a gyro
    the angle, in rad, by which its turn from one rest to the next misses gravity's direction, and a
    fold is a turn; as measured less the bias of its rests. Of ``errors`` some are not ``judged``,
    because they alone show a coefficient.
    """

    sensor: str
    unit: str
    folds: int
    errors: int
    judged: int
    as_measured: float
    before: float
    after: float

    def as_dict(self) -> dict[str, Any]:
        return {k: plain(v) for k, v in asdict(self).items() if k != "sensor"}


@dataclass(frozen=True, repr=False)
class LogEntry(Brief):
    """One recording: its rows, its error by sensor, and what was estimated of the log itself."""

    file: str
    samples: int
    held_out: int
    errors: dict[str, Errors] = field(default_factory=dict)
    log_state: dict[str, dict] = field(default_factory=dict)
    overview: Overview | None = None

    def as_dict(self) -> dict[str, Any]:
        rows = {
            name: self.errors[kind].as_dict() if kind in self.errors else None
            for kind, name in (("gyro", "rate"), ("accel", "specific_force"))
        }
        if MAGNETOMETER in self.errors:
            rows["magnetic_field"] = self.errors[MAGNETOMETER].as_dict()
        return (
            {"file": self.file, "samples": self.samples, "held_out": self.held_out}
            | rows
            | {"log": self.log_state, "overview": self.overview and self.overview.as_dict()}
        )
