"""What a plan says, as frozen data, and its form in plan.json."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pyimu.display.brief import Brief
from pyimu.files import plain
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.plan.goals import Goal
from pyimu.identification.plan.motions import Motion
from pyimu.recording.recording import Recording


@dataclass(frozen=True)
class Step:
    """A motion, and how many times it is to be done."""

    motion: Motion
    times: int

    @property
    def duration(self) -> float:
        return self.times * self.motion.duration


@dataclass(frozen=True)
class Predicted:
    """A goal with the standard error (SI) that the plan would reach; infinite where it shows
    nothing, ``reason`` says why then.
    """

    goal: Goal
    std: float
    reason: str = ""

    @property
    def sigmas(self) -> float:
        """Its size in standard errors, NaN where nobody knows its size."""
        if self.goal.size is None or not self.std > 0.0:
            return np.nan
        return self.goal.size / self.std

    @property
    def reached(self) -> bool:
        return self.goal.wanted is None or self.std <= self.goal.wanted * (1 + 1e-9)


@dataclass(frozen=True)
class Pair:
    """Whether a motion tells two effects apart: the largest correlation of a direction of one with
    one of the other, and the size of the less separate coefficient in standard errors while the
    other effect is free; None for the whole plan.
    """

    motion: str | None
    effects: tuple[str, str]
    correlation: float
    distance: float


@dataclass(frozen=True, repr=False)
class Log(Brief):
    """Motions to be recorded in one go, and the truth of them as a recording."""

    steps: tuple[Step, ...]
    recording: Recording


@dataclass(frozen=True)
class Outcome:
    """What ``pyimu.plan`` says: the logs to take, what they would show, what each motion of the
    library would, which effects they tell apart, and what nothing shows.

    ``by_motion`` holds the standard errors (SI) of each motion done once, all asked effects
    estimated together.
    """

    part: str
    kind: str
    effects: tuple[str, ...]
    of_class: str
    sigmas: float
    noise: str
    logs: tuple[Log, ...]
    predicted: tuple[Predicted, ...]
    by_motion: Mapping[str, Mapping[Coefficient, float]]
    library: tuple[Log, ...]
    pairs: tuple[Pair, ...]
    notes: tuple[str, ...]

    @property
    def steps(self) -> tuple[Step, ...]:
        return tuple(s for log in self.logs for s in log.steps)

    @property
    def motions(self) -> tuple[Motion, ...]:
        """Those of the library."""
        return tuple(s.motion for log in self.library for s in log.steps)

    @property
    def duration(self) -> float:
        return sum(s.duration for s in self.steps)

    @property
    def reached(self) -> bool:
        """Whether every coefficient of the effects would be known as well as is wanted."""
        return bool(self.logs) and all(p.reached for p in self.predicted)

    def files(self) -> tuple[str, ...]:
        """Names of the files of the logs' motions."""
        if len(self.logs) == 1:
            return ("motion.csv",)
        return tuple(f"motion_{i + 1}.csv" for i in range(len(self.logs)))

    def as_dict(self) -> dict[str, Any]:
        """The contents of plan.json."""
        return plain(
            {
                "part": self.part,
                "sensor": self.kind,
                "effects": list(self.effects),
                "class": self.of_class,
                "sigmas": self.sigmas,
                "noise": self.noise,
                "reached": self.reached,
                "duration": {"value": self.duration, "unit": "s"},
                "logs": [
                    {"file": name, "steps": [_step(s) for s in log.steps]}
                    for name, log in zip(self.files(), self.logs, strict=True)
                ],
                "predicted": [_predicted(p) for p in self.predicted],
                "library": [_motion(m, self.by_motion[m.name]) for m in self.motions],
                "pairs": [
                    {
                        "motion": p.motion,
                        "effects": list(p.effects),
                        "correlation": p.correlation,
                        "distance": p.distance,
                    }
                    for p in self.pairs
                ],
                "notes": list(self.notes),
            }
        )


def _step(s: Step) -> dict[str, Any]:
    return {
        "motion": s.motion.name,
        "times": s.times,
        "duration": s.duration,
        "text": s.motion.text,
    }


def _named(key: Coefficient) -> dict[str, Any]:
    return {"effect": key.effect, "parameter": key.parameter, "index": list(key.index)}


def _predicted(p: Predicted) -> dict[str, Any]:
    return {
        **_named(p.goal.key),
        "unit": p.goal.unit,
        "size": p.goal.size,
        "size_from": p.goal.source,
        "wanted": p.goal.wanted,
        "std": p.std,
        "sigmas": p.sigmas,
        **({"reason": p.reason} if p.reason else {}),
    }


def _motion(m: Motion, errors: Mapping[Coefficient, float]) -> dict[str, Any]:
    return {
        "motion": m.name,
        "text": m.text,
        "duration": m.duration,
        "std": [{**_named(k), "std": v} for k, v in errors.items()],
    }
