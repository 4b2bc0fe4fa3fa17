"""Every coefficient of the model that came out: its value, its interval, and where it is from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pyimu.files import plain
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import with_prior
from pyimu.identification.fit.keys import Coefficient, LogBias
from pyimu.identification.fit.mixture import REACH
from pyimu.identification.found.entries import Added
from pyimu.identification.model.unshown import OUTWEIGHED
from pyimu.identification.noise.named import Noise
from pyimu.identification.rivals.confounds import what_no_log_tells_apart
from pyimu.identification.search.belief import most
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.leftover import noise_figures
from pyimu.identification.search.screen import fitted_dispersion
from pyimu.model.catalogue import POWER_ON, WALK, WHITE
from pyimu.model.effect import Effect
from pyimu.model.part import Part


@dataclass(frozen=True)
class Estimated:
    """A coefficient, arrays of the parameter's shape in SI.

    ``origin`` is "declared", "fixed" (an origin or a form that is never estimated), "estimated",
    "changed" (declared, and contradicted by the data) or "added". ``std`` is NaN where there is no
    standard error. ``shown`` is False where these logs do not show an element: it stands at its
    start value then, or where the prior holds it. ``source`` is that of a declared value, ``note``
    what no log tells its effect from.
    """

    sensor: str
    effect: str
    parameter: str
    unit: str
    value: np.ndarray
    std: np.ndarray
    shown: np.ndarray
    origin: str
    source: str = ""
    note: str = ""

    @property
    def low(self) -> np.ndarray:
        return self.value - REACH * self.std

    @property
    def high(self) -> np.ndarray:
        return self.value + REACH * self.std

    def as_dict(self) -> dict[str, Any]:
        """A value that the logs say nothing of is null; one that the prior holds is not."""
        silent = ~self.shown & ~np.isfinite(self.std)
        numbers = {k: getattr(self, k) for k in ("value", "std", "low", "high")}
        return {
            "sensor": self.sensor,
            "effect": self.effect,
            "parameter": self.parameter,
            "unit": self.unit,
            **{k: plain(np.where(silent, np.nan, v)) for k, v in numbers.items()},
            "shown": plain(self.shown),
            "from": self.origin,
            **({"source": self.source} if self.source else {}),
            **({"note": self.note} if self.note else {}),
        }


Errors = tuple[np.ndarray, np.ndarray]
"""Standard errors of a coefficient's elements, NaN where there are none, and which are shown."""


def estimated(
    start: Part,
    after: Part,
    found: Mapping[str, Investigation],
    added: Iterable[Added],
    noises: Mapping[str, Noise],
) -> tuple[Estimated, ...]:
    """The coefficients of the model ``after`` that investigations of the part ``start`` gave, and
    the noise of each kind of sensor.
    """
    new = {(a.sensor, a.effect): a for a in added}
    return tuple(
        entry
        for kind in ("gyro", "accel")
        for entry in _of_sensor(start, after, kind, found.get(kind), new, noises.get(kind, Noise()))
    )


def _of_sensor(
    start: Part, after: Part, kind: str, inv: Investigation | None, new: Mapping, noise: Noise
) -> Iterator[Estimated]:
    sensor = after.sensor(kind)
    errors = None if inv is None else _Regression(inv)
    changed = set() if inv is None else {s.effect for s in inv.steps if s.declared}
    for e in sensor.effects:
        added = new.get((kind, e.name))
        forms = None if added is None else added.alternatives
        note = "" if inv is None else what_no_log_tells_apart(e, sensor, inv.after.trials, forms)
        for name, q in e.parameters.items():
            key, value = (kind, e.name, name), sensor.values[e.name][name]
            if (kind, e.name) in new:
                origin, (std, shown) = "added", _of_added(new[kind, e.name], e, name)
            elif (e.name, name) in noise.std:
                origin, (std, shown) = "changed", (noise.std[e.name, name], _known(value)[1])
            elif q.reference or not (key in start.estimate or e.name in changed):
                origin, (std, shown) = "declared", _known(value)
            elif errors is None:
                origin, (std, shown) = "estimated", _hidden(value)
            else:
                origin = "changed" if e.name in changed else "estimated"
                std, shown = errors.of(e, name, value)
            source = start.notes.get(key, {}).get("source", "") if origin == "declared" else ""
            if origin in ("added", "declared") and (q.reference and not source):
                origin = "fixed"
            estimates = note if origin not in ("declared", "fixed") else ""
            unit = sensor.unit(q.unit)
            yield Estimated(kind, e.name, name, unit, value, std, shown, origin, source, estimates)


def _known(value: np.ndarray) -> Errors:
    return np.full(value.shape, np.nan), np.ones(value.shape, dtype=bool)


def _hidden(value: np.ndarray) -> Errors:
    return np.full(value.shape, np.nan), np.zeros(value.shape, dtype=bool)


def _of_added(a: Added, e: Effect, name: str) -> Errors:
    """Those of an added effect; an element that was not needed has none, nor needs one."""
    std = np.asarray(a.parameters[name][1], dtype=float)
    return np.where((std > 0) & np.isfinite(std), std, np.nan), ~np.isinf(std)


class _Regression:
    """Standard errors of what was estimated, each corrected for the scatter of its scores."""

    def __init__(self, inv: Investigation) -> None:
        self.inv, self.fit = inv, inv.after
        self.normal = with_prior(equations(self.fit), self.fit)
        self.figures = noise_figures(self.fit)

    def of(self, e: Effect, name: str, value: np.ndarray) -> Errors:
        if (e.name, name) == POWER_ON:
            return self._bias(value)
        if (e.name, name) in (WHITE, WALK):
            return self._noise(value, (e.name, name) == WALK)
        free, held = (
            [
                k
                for k in some
                if isinstance(k, Coefficient) and (k.effect, k.parameter) == (e.name, name)
            ]
            for some in (self.fit.free, self.fit.prior.keys() - self.fit.free)
        )
        std, shown = _hidden(value)
        scatter = np.sqrt(self._dispersion(e.name, free))
        for key in (*free, *held):
            known = key in self.normal.position or key in held
            raw = self.fit.std.get(key, np.inf) if known else np.inf
            std[key.index] = scatter * raw if np.isfinite(raw) else np.nan
            shown[key.index] = np.isfinite(raw) and key in free and not self._outweighed(key, raw)
        return std, shown

    def _outweighed(self, key: Coefficient, raw: float) -> bool:
        """Whether the prior says more of a coefficient: of samples those were held before."""
        return self.fit.is_reduced and raw > OUTWEIGHED * self.fit.prior.get(key, np.inf)

    def _dispersion(self, effect: str, keys: Iterable[Coefficient]) -> float:
        step = next((s for s in self.inv.steps if s.effect == effect), None)
        return fitted_dispersion(self.normal, keys) if step is None else step.dispersion

    def _bias(self, value: np.ndarray) -> Errors:
        """Of the mean over the logs, each log's bias having its own.

        An accelerometer that is compared with its own mean shows none.
        """
        trials, kind = self.fit.trials, self.fit.sensor.kind
        if kind == "accel" and all(t.reference == "static" for t in trials):
            return _hidden(value)
        std, names = np.full(3, np.nan), [t.name for t in self.fit.trials]
        for i in range(3):
            keys = [LogBias(n, i) for n in names if LogBias(n, i) in self.normal.position]
            each = [self.fit.std.get(k, np.inf) for k in keys]
            spread = fitted_dispersion(self.normal, keys) if keys else 1.0
            total = np.sqrt(spread * np.sum(np.square(each))) / max(len(each), 1)
            std[i] = total if keys and total <= most(POWER_ON[0], kind, POWER_ON[1]) else np.nan
        return std, np.isfinite(std)

    def _noise(self, value: np.ndarray, walks: bool) -> Errors:
        """Of white noise, or of the random walk.

        Against a differentiated reference the white part of quiet seconds alone is known, and
        nothing of its error.
        """
        std, shown = np.full(3, np.nan), np.zeros(3, dtype=bool)
        if self.figures is None:
            return std, shown if walks else value > 0
        for i, f in self.figures.items():
            found = f.K_std if walks else f.N_std
            std[i], shown[i] = (found, True) if np.isfinite(found) else (np.nan, False)
        return std, shown
