"""What the loop found, as frozen data, and its form in report.json."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from pyimu.errors import Finding
from pyimu.files import plain
from pyimu.identification.fit.score import WINDOW
from pyimu.identification.formula.formula import Formula
from pyimu.identification.found.entries import Added, AtRest, Changed, Errors, LogEntry, Visibility
from pyimu.identification.found.exhibits import Exhibits
from pyimu.identification.found.made_with import MadeWith
from pyimu.identification.magnetometer.examine import Examined
from pyimu.identification.magnetometer.words import as_dict as magnetic
from pyimu.identification.model.estimated import Estimated
from pyimu.identification.model.simulated import Simulated
from pyimu.identification.plan.advice import Advice
from pyimu.identification.search.investigation import Refused
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.verdict.fates import Fate
from pyimu.model.kinds import MAGNETOMETER
from pyimu.model.part import Part


@dataclass(frozen=True)
class Outcome:
    """What the loop found: verdict, part before and after, error on data that was not fitted."""

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
    quality: tuple[Finding, ...]
    recordings: tuple[LogEntry, ...]
    refused: tuple[tuple[str, Refused], ...]
    exhibits: dict[str, Exhibits]
    band_hz: dict[str, float | None]
    held_out: str
    remarks: tuple[str, ...] = ()
    estimated: tuple[Estimated, ...] = ()
    not_examined: dict[str, str] = field(default_factory=dict)
    candidates: tuple[Fate, ...] = ()
    references: tuple[dict[str, Any], ...] = ()
    next: tuple[Advice, ...] = ()
    made_with: MadeWith | None = None
    heading: tuple[float, float] | None = None
    at_rest: tuple[AtRest, ...] = ()
    formulas: tuple[Formula, ...] = ()
    simulated: Simulated | None = None
    magnetometer: Examined | None = None

    def as_dict(self, model: str = "model.toml", fmus: tuple[str, ...] = ()) -> dict[str, Any]:
        """The contents of report.json."""
        found = {
            "verdict": self.verdict,
            "reason": self.reason,
            "remarks": list(self.remarks),
            "added": [a.as_dict() for a in self.added],
            "changed": [c.as_dict() for c in self.changed],
            "unexplained": self.unexplained[0].as_dict() if self.unexplained else None,
            "formulas": [f.as_dict() for f in self.formulas],
            "drift": [
                {"sensor": s, "axis": "xyz"[i], "gain": gain}
                for s, axes in self.drift.items()
                for i, gain in axes.items()
            ],
            "estimated": [v.as_dict() for v in self.estimated],
            "not_examined": [{"sensor": s, "reason": r} for s, r in self.not_examined.items()],
            "candidates": [c.as_dict() for c in self.candidates],
            "refused": [{"sensor": s} | r.as_dict() for s, r in self.refused],
            "observability": [v.as_dict() for v in self.observability],
            "error": self._error(),
            "quality": [f.as_dict() for f in self.quality],
            "recordings": [r.as_dict() for r in self.recordings],
            "reference": list(self.references),
            "next": [a.as_dict() for a in self.next],
            "model": model,
            "fmus": list(fmus),
            "made_with": self.made_with and self.made_with.as_dict(),
        }
        known = {"simulated": self.simulated.as_dict()} if self.simulated else {}
        if self.magnetometer is not None:
            known["magnetometer"] = magnetic(self.magnetometer)
        return plain(found | known)

    def _error(self) -> dict[str, Any]:
        rate, force = self.errors.get("gyro"), self.errors.get("accel")
        field = self.errors.get(MAGNETOMETER)
        found = {
            "data": self.held_out,
            "rate": rate and rate.as_dict(),
            "angle": rate and rate.angle_dict(WINDOW),
            "specific_force": force and force.as_dict(),
            "log_likelihood": _pair("nat/sample", self.log_likelihood),
            "attitude": _pair("rad", self.attitude),
            "heading": _pair("rad", self.heading),
            "band_hz": self.band_hz,
            "gravity": self._gravity("accel"),
            "gravity_direction": self._gravity("gyro"),
        }
        return found | ({} if field is None else {"magnetic_field": field.as_dict()})

    def _gravity(self, kind: str) -> dict[str, Any] | None:
        return next((g.as_dict() for g in self.at_rest if g.sensor == kind), None)


def _pair(unit: str, values: tuple[float, float] | None) -> dict[str, Any] | None:
    return values and {"unit": unit, "before": values[0], "after": values[1]}
