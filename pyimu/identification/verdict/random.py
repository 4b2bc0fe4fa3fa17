"""What is random in what each sensor's model leaves, where it may be told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.formula.memory import Remembered
from pyimu.identification.formula.search import Look
from pyimu.identification.formula.wandering import wandering
from pyimu.identification.found.entries import Added
from pyimu.identification.model.model_of import Found, Model
from pyimu.identification.noise.named import Noise, noise_of
from pyimu.identification.noise.rounding import is_coarse
from pyimu.identification.search.belief import most
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.inexact import left_by_forms
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.rounded import less_rounding, without_rounding
from pyimu.identification.verdict.declared import changed_noise, drifting
from pyimu.model.catalogue import CATALOGUE, WALK, WHITE
from pyimu.model.part import Part

MORE_THAN_NOISE = "kinds of noise are told apart only where nothing else is left"
REMEMBERED = "what is left follows the motion, with a memory of it"
FOLLOWED = "what is left follows a signal by a share that wanders"
AS_FORM = "what noise was found is no more than the form of an effect may leave"


def noises_of(
    start: Part, found: Found, model: Model, looks: Mapping[str, Look], fits: bool
) -> dict[str, Noise]:
    """What is random in what each sensor leaves, told apart where the references fit."""
    return {
        kind: _unless_wandering(
            _unless_remembered(
                _beside_digits(start, inv, model, len(found), fits and _is_noise(inv, looks[kind])),
                looks[kind].memory,
            ),
            inv.after,
            (kind, *WALK) in start.estimate,
        )
        for kind, inv in found.items()
    }


def _unless_wandering(noise: Noise, fit: Fit, is_open: bool) -> Noise:
    """What is random in a residual, or what this follows by a share that wanders: that is slow as
    noise is, and random, and no noise. A walk whose size is left ``is_open`` takes it, too.
    """
    if not (noise.added or noise.drift or is_open) or not (followed := wandering(fit)):
        return noise
    return Noise(shapes=followed, unasked=FOLLOWED)


def _unless_remembered(noise: Noise, memory: Remembered | None) -> Noise:
    """What is random in a residual, or what this remembers of the motion where that explains more:
    slow noise follows whatever is slow, by less.
    """
    slow = sum(a.gain for a in noise.added) + sum(noise.drift.values())
    if memory is None or noise.shapes or memory.gain <= slow + SET_WIDTH:
        return noise
    return Noise(shapes=memory.unexplained, unasked=REMEMBERED)


def _beside_digits(
    start: Part, inv: Investigation, model: Model, sensors: int, is_noise: bool
) -> Noise:
    """What is random in what an investigation left, or nothing but what its reference's digits
    leave where they account for it.
    """
    found = _noise(start, inv, model, sensors, is_noise)
    after = without_rounding(inv.after) if found.is_more else None
    if after is None:
        return found
    less = replace(inv, after=after, held=tuple(less_rounding(inv.after, t) for t in inv.held))
    beside = _noise(start, less, model, sensors, is_noise)
    return found if beside.is_more else beside


def _noise(start: Part, inv: Investigation, model: Model, sensors: int, is_noise: bool) -> Noise:
    """What is random in what an investigation of a part left.

    Kinds are told apart where ``is_noise`` says that nothing else is known to be left.
    """
    rounded = model.rounding[inv.after.sensor.kind]
    sensor = rounded.of_increments(start.sensor(inv.after.sensor.kind))
    free = frozenset(e for kind, e, _ in start.estimate if kind == sensor.kind)
    rounds = rounded.relevant or is_coarse(sensor, inv.after)
    unasked = MORE_THAN_NOISE
    if is_noise:
        found = noise_of(sensor, inv, free, rounds, sensors)
        if all(_counts(inv, a) for a in found.added):
            return found
        unasked = found.unasked or AS_FORM
    if rounds or free & {WHITE[0], WALK[0]}:
        return Noise(unasked=unasked)
    return Noise(
        changed=changed_noise(start, sensor.kind, inv.after),
        drift=drifting(sensor.kind, inv.after, sensor).get(sensor.kind, {}),
        unasked=unasked,
    )


def _counts(inv: Investigation, a: Added) -> bool:
    """Whether a noise is more than what the form of an effect may leave, and no larger than any."""
    values = a.parameters.items()
    sizes = [most(a.effect, a.sensor, name) >= np.nanmax(np.abs(v)) for name, (v, *_) in values]
    return a.gain > left_by_forms(inv.after, inv.steps) and all(sizes)


def _is_noise(inv: Investigation, look: Look) -> bool:
    """Whether what is left may be noise.

    It follows no input, nor a clock that wanders, nor the edges of what the output does.
    """
    if any(CATALOGUE[s.effect].stage == "output" for s in inv.steps):
        return False
    clocks = [t.clock for t in inv.after.trials if t.clock is not None and t.clock.is_seen]
    known = look.unexplained is not None or bool(look.inconstant)
    return not known and all(c.is_steady for c in clocks)
