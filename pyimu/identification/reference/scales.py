"""The scale of the positions that a force was made of, beside the accelerometer's own.

Gravity has no metre of the positions in it. A scale factor of the accelerometer acts on gravity,
too, the positions' scale on what moves the body alone: the two are told apart as far as gravity
turns in the body's axes. Of a body that keeps level they are one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.clock import WIDE
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, Last, with_prior
from pyimu.identification.fit.keys import LogPlace, coefficients_of
from pyimu.identification.fit.mixture import REACH
from pyimu.identification.fit.normal import solve, variances
from pyimu.identification.fit.place import SCALE
from pyimu.identification.fit.reduction import GAIN
from pyimu.identification.fit.structure import prior_of
from pyimu.identification.search.screen import fitted_dispersion
from pyimu.recording.reference.unfiltered_places import GROUPS

SAID = 0.002
"""A scale nearer to one is no more than how well cameras are calibrated."""

POSITIONS_SCALE = "positions_scale"
"""The finding of positions of another scale."""


@dataclass(frozen=True)
class Size:
    """How many times as large as the body's way positions are, and its standard error."""

    factor: float
    std: float

    @classmethod
    def of(cls, share: float, std: float) -> Size:
        """By which ``share`` the body's way is longer than the positions'."""
        factor = 1.0 / (1.0 + share)
        return cls(factor, factor**2 * std)

    @property
    def is_another(self) -> bool:
        """Whether it is not one, and by more than cameras are."""
        return abs(self.factor - 1.0) > max(WIDE * self.std, SAID)

    def as_dict(self) -> dict[str, float]:
        reach = REACH * self.std
        return {"factor": self.factor, "low": self.factor - reach, "high": self.factor + reach}


@dataclass(frozen=True)
class Scale:
    """The scale of the positions of a ``recording`` where the accelerometer's scale factors may be
    as those of any part, and ``beside`` those that the model has.
    """

    recording: str
    own: Size
    beside: Size

    @property
    def finding(self) -> Finding | None:
        """What is said of it; nothing where it is one by all that the log shows."""
        is_told = self.own.is_another
        size = self.own if is_told else self.beside
        if not size.is_another:
            return None
        detail = {"recording": self.recording, **size.as_dict(), "told": "yes" if is_told else "no"}
        return Finding(POSITIONS_SCALE, GROUPS["position"][0], 1, detail)

    def as_dict(self) -> dict[str, Any]:
        own = {"value": self.own.factor, "std": self.own.std, "unit": "1"}
        return own | {"told": self.own.is_another}


def scales_of(fits: Iterable[Fit]) -> dict[str, Scale]:
    """By log the scale of its positions, of those that the models of sensors were fitted to."""
    return {s.recording: s for fit in fits for s in _scales(fit)}


def findings_of(scales: Mapping[str, Scale]) -> tuple[Finding, ...]:
    return tuple(f for s in scales.values() if (f := s.finding) is not None)


def _scales(fit: Fit) -> Iterable[Scale]:
    keys = [LogPlace(t.name, SCALE) for t in fit.trials if t.place and t.place.scale_std]
    if not keys:
        return
    wider = with_gains(fit)
    normal = with_prior(equations(wider), wider)
    seen = normal.variance if normal.seen is not None else None
    step, variance = solve(normal.gram, normal.score), variances(normal.gram, seen)
    for key in (k for k in keys if k in normal.position):
        at, had = normal.position[key], float(fit.states[key.log].place[SCALE])
        scatter = float(np.sqrt(fitted_dispersion(normal, [key])))
        # A gain that the model has not may take a part of it.
        own = Size.of(had + float(step[at]), scatter * float(np.sqrt(variance[at])))
        yield Scale(key.log, own, Size.of(had, scatter * fit.std.get(key, np.inf)))


def with_gains(fit: Fit) -> Fit:
    """The model with the accelerometer's scale factors free, as they are among all parts."""
    sensor = fit.sensor if GAIN in fit.sensor.values else fit.sensor.with_values(GAIN)
    more = coefficients_of(sensor, GAIN) - fit.free
    prior = {**fit.prior, **prior_of(sensor, more)}
    return replace(fit, sensor=sensor, free=fit.free | more, prior=prior, last=Last())
