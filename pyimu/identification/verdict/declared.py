"""What the data say of values that a part declares."""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.found.entries import Changed
from pyimu.identification.noise.rounding import is_coarse
from pyimu.identification.search.investigation import Step
from pyimu.identification.search.leftover import NoiseFigure, drift, noise_figures, walk_gain
from pyimu.model.catalogue import WALK, WHITE
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor

CONTRADICTION = 4.0
"""Standard errors by which data must differ from a declared noise to contradict it."""

RELEVANT = 0.02
"""Share of a declared noise by which data must differ from it, too."""


def changed_noise(start: Part, kind: str, fit: Fit) -> list[Changed]:
    """Declared noise that the data contradict.

    Rounding adds to the noise, so nothing is said where it is declared and is no small part of it;
    nor where the reference was differentiated.
    """
    declared, figures = start.sensor(kind), noise_figures(fit)
    if figures is None or is_coarse(declared, fit):
        return []
    held = [
        (effect, parameter)
        for effect, parameter in (WHITE, WALK)
        if effect in declared.values and (kind, effect, parameter) not in start.estimate
    ]
    found = [_contradicted(declared, fit, figures, *name) for name in held]
    return [c for c in found if c is not None]


def _contradicted(
    declared: Sensor, fit: Fit, figures: dict[int, NoiseFigure], effect: str, parameter: str
) -> Changed | None:
    had, walks = declared.values[effect][parameter], (effect, parameter) == WALK
    fitted, std = np.full(3, np.nan), np.full(3, np.nan)
    for i, f in figures.items():
        fitted[i], std[i] = (f.K, f.K_std) if walks else (f.N, f.N_std)
    with np.errstate(invalid="ignore"):
        # The likelihood of a random walk is too skew for a standard error to judge by.
        gain = walk_gain(fit, had) if walks else None
        surprise = np.abs(fitted - had) / std if gain is None else np.sqrt(2 * np.maximum(gain, 0))
        off = (surprise > CONTRADICTION) & (np.abs(fitted - had) > RELEVANT * had)
    if not off.any():
        return None
    unit = declared.unit(declared.effect(effect).parameters[parameter].unit)
    return Changed(declared.kind, effect, parameter, np.array(had), fitted, std, unit)


def released(declared: Sensor, fit: Fit, step: Step) -> Changed:
    """A declared coefficient that the data contradict, with what they say instead."""
    parameters = declared.effect(step.effect).parameters
    name = next(n for n, p in parameters.items() if not p.reference)
    fitted = fit.sensor.values[step.effect][name]
    std = np.zeros(fitted.shape)
    for key in step.keys:
        std[key.index] = fit.std.get(key, np.nan) * np.sqrt(step.dispersion)
    return Changed(
        sensor=declared.kind,
        effect=step.effect,
        parameter=name,
        declared=np.array(declared.values[step.effect][name]),
        fitted=np.array(fitted),
        std=std,
        unit=declared.unit(parameters[name].unit),
        alternatives=step.alternatives,
    )


def drifting(kind: str, fit: Fit, declared: Sensor) -> dict[str, dict[int, float]]:
    """By sensor, the axes that walk more than declared, and the gain [nat] of letting them."""
    (white, _), (walk, parameter) = WHITE, WALK
    if white not in declared.values or noise_figures(fit) is None:
        return {}
    k = declared.values[walk][parameter] if walk in declared.values else np.zeros(3)
    found = drift(fit, np.asarray(k))
    return {kind: found} if found else {}
