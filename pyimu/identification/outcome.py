"""What the loop found, as frozen data, and its form in report.json."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pyimu.files import plain
from pyimu.identification.fit.score import WINDOW, Tally
from pyimu.identification.search.forward import Investigation, Refused
from pyimu.identification.search.leftover import Unexplained
from pyimu.model.part import Part


@dataclass(frozen=True)
class Added:
    """An effect that was added: coefficients by name as ``(value, std, unit)``, arrays of the
    parameter's shape.
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
    """A declared value that the data contradict."""

    sensor: str
    effect: str
    parameter: str
    declared: np.ndarray
    fitted: np.ndarray
    std: np.ndarray
    unit: str

    def as_dict(self) -> dict[str, Any]:
        return {
            "sensor": self.sensor,
            "effect": self.effect,
            "parameter": self.parameter,
            "unit": self.unit,
            "declared": plain(self.declared),
            "fitted": plain(self.fitted),
            "std": plain(self.std),
        }


@dataclass(frozen=True)
class Visibility:
    """The smallest coefficient of an absent effect that the logs would show, and the effects it
    looks like in them.
    """

    sensor: str
    effect: str
    smallest_visible: float | None
    unit: str
    inseparable_from: tuple[str, ...] = ()
    reason: str = ""

    def as_dict(self) -> dict[str, Any]:
        out = {
            "sensor": self.sensor,
            "effect": self.effect,
            "smallest_visible": plain(self.smallest_visible),
            "unit": self.unit,
            "inseparable_from": list(self.inseparable_from),
        }
        return out | ({"reason": self.reason} if self.reason else {})


@dataclass(frozen=True)
class Errors:
    """Held-out error of one sensor before, after, and as the noise alone would leave it."""

    unit: str
    before: Tally
    after: Tally
    floor: Tally | None

    def as_dict(self) -> dict[str, Any]:
        return {"unit": self.unit} | self._row("total") | {"per_axis": self._row("per_axis")}

    def angle_dict(self, window: float) -> dict[str, Any]:
        return (
            {"unit": "rad", "window": window}
            | self._row("angle")
            | {"per_axis": self._row("angle_per_axis")}
        )

    def _row(self, name: str) -> dict[str, Any]:
        tallies = {"before": self.before, "after": self.after, "floor": self.floor}
        return {k: None if t is None else plain(getattr(t, name)) for k, t in tallies.items()}


@dataclass(frozen=True)
class LogEntry:
    """One recording: its rows, those held out, its error by sensor, and what was estimated of the
    log itself.
    """

    file: str
    samples: int
    held_out: int
    errors: dict[str, Errors] = field(default_factory=dict)
    log_state: dict[str, dict] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        rows = {
            name: self.errors[kind].as_dict() if kind in self.errors else None
            for kind, name in (("gyro", "rate"), ("accel", "specific_force"))
        }
        return (
            {"file": self.file, "samples": self.samples, "held_out": self.held_out}
            | rows
            | {"log": self.log_state}
        )


@dataclass(frozen=True)
class Outcome:
    """What the loop found: the part before and after, the verdict, and the error on data that
    was not fitted.
    """

    verdict: str
    reason: str
    before: Part
    after: Part
    added: tuple[Added, ...]
    changed: tuple[Changed, ...]
    unexplained: tuple[Unexplained, ...]
    drift: dict[str, dict[int, float]]
    observability: tuple[Visibility, ...]
    errors: dict[str, Errors]
    log_likelihood: tuple[float, float] | None
    attitude: tuple[float, float] | None
    quality: tuple
    recordings: tuple[LogEntry, ...]
    refused: tuple[tuple[str, Refused], ...]
    investigations: dict[str, Investigation]
    band_hz: dict[str, float | None]
    held_out: str

    def as_dict(self, model: str = "model.toml", fmus: tuple[str, ...] = ()) -> dict[str, Any]:
        """The contents of report.json."""
        rate, force = self.errors.get("gyro"), self.errors.get("accel")
        both = (
            None
            if self.log_likelihood is None
            else {
                "unit": "nat/sample",
                "before": self.log_likelihood[0],
                "after": self.log_likelihood[1],
            }
        )
        attitude = (
            None
            if self.attitude is None
            else {"unit": "rad", "before": self.attitude[0], "after": self.attitude[1]}
        )
        first = self.unexplained[0] if self.unexplained else None
        return plain(
            {
                "verdict": self.verdict,
                "reason": self.reason,
                "added": [a.as_dict() for a in self.added],
                "changed": [c.as_dict() for c in self.changed],
                "unexplained": None
                if first is None
                else {
                    "sensor": first.sensor,
                    "axis": first.axis,
                    "depends_on": list(first.depends_on),
                    "p_value": first.p_value,
                },
                "drift": [
                    {"sensor": s, "axis": "xyz"[i], "gain": g}
                    for s, axes in self.drift.items()
                    for i, g in axes.items()
                ],
                "refused": [
                    {"sensor": s, "effect": r.effect, "gain": r.gain, "reason": r.reason}
                    for s, r in self.refused
                ],
                "observability": [v.as_dict() for v in self.observability],
                "error": {
                    "data": self.held_out,
                    "rate": rate and rate.as_dict(),
                    "angle": rate and rate.angle_dict(WINDOW),
                    "specific_force": force and force.as_dict(),
                    "log_likelihood": both,
                    "attitude": attitude,
                    "band_hz": self.band_hz,
                },
                "quality": [f.as_dict() for f in self.quality],
                "recordings": [r.as_dict() for r in self.recordings],
                "model": model,
                "fmus": list(fmus),
            }
        )
