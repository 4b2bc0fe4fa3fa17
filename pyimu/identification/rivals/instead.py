"""Effects that a kind of noise would explain as well: what wanders follows many a slow input."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.sample_noise import rest_noise
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.formula.search import Look
from pyimu.identification.noise.rounding import rounding
from pyimu.identification.noise.shapes import likelihood_of
from pyimu.identification.search.investigation import AS_NOISE, AS_ROUNDING, Investigation, Step
from pyimu.identification.search.screen import PENALTY
from pyimu.identification.search.taken_back import without
from pyimu.model.catalogue import CATALOGUE, INCREMENTS

DEAD_ZONES = ("dead_zone", "hard_dead_zone")

WANDERS = 0.5
"""Share of what an effect explains that is left once the residual may walk as it likes, below which
the effect is held against noise: what follows the motion keeps nearly all."""


def less_than_noise(inv: Investigation, free: frozenset[str]) -> Investigation:
    """An investigation less the effects that explain no more than noise of some kind would;
    ``free`` are the kinds of noise that the part leaves to the data. No noise piles samples up,
    where these themselves show an effect.
    """
    suspects = [s for s in inv.steps if not (s.declared or s.as_sampled) and _may_be_noise(inv, s)]
    for some in [suspects, *([s] for s in reversed(suspects))]:
        left = [s for s in some if s in inv.steps]
        if left and _as_noise(inv, _refitted(inv, left), _count(left), free):
            for s in left:
                inv = without(inv, s.effect, AS_NOISE)
    return inv


def less_than_rounding(inv: Investigation) -> Investigation:
    """An investigation less the steps of the bias, the lines and the dead zones that the rounding
    of samples makes: where these scatter so little that they do not dither, it shifts their mean,
    by another amount at each level.
    """
    suspects = [s for s in inv.steps if not s.declared and _may_be_rounding(s)]
    most = _of_rounding(inv) if suspects else np.zeros(3)
    for s in suspects:
        if _is_within(inv, s, most):
            inv = without(inv, s.effect, AS_ROUNDING)
    return inv


def _may_be_rounding(step: Step) -> bool:
    effect = CATALOGUE[step.effect]
    return effect.has_events or effect.is_line or step.effect in DEAD_ZONES


def _of_rounding(inv: Investigation) -> np.ndarray:
    """How far (3,) rounding shifts the mean of samples at most: q/2 exp(-2 pi^2 (sigma/q)^2), with
    q the step and sigma the noise at rest (the first harmonic of the sawtooth that rounding adds,
    times the characteristic function of Gaussian noise: Widrow and Kollar 2008, "Quantization
    Noise", chapters 3 and 4).
    """
    sensor, trials = inv.after.sensor, inv.after.trials
    found = sensor.reading("step")
    if found is not None:
        q = np.broadcast_to(sensor.values[found[0]][found[1]], 3)
    else:
        added = rounding(sensor.kind, inv).added
        steps = [v for a in added if a.effect != INCREMENTS[0] for v, _, _ in a.parameters.values()]
        q = steps[0] if steps else np.zeros(3)
    # What samples show at rest has the rounding in it.
    seen = np.min([np.square(rest_noise(t)) for t in trials], axis=0)
    noise = np.maximum(seen - q**2 / 12, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        shift = 0.5 * q * np.exp(-2.0 * np.pi**2 * noise / q**2)
    return np.where(q > 0.0, shift, 0.0)


def _is_within(inv: Investigation, step: Step, most: np.ndarray) -> bool:
    """Whether all sizes that an effect brought are at most those (3,)."""
    parameters, values = CATALOGUE[step.effect].parameters, inv.after.sensor.values[step.effect]
    sizes = [
        k for k in step.keys if not (parameters[k.parameter].form or parameters[k.parameter].scan)
    ]
    return bool(sizes) and all(abs(values[k.parameter][k.index]) <= most[k.index[0]] for k in sizes)


def formula_less_than_noise(inv: Investigation, found: Look, free: frozenset[str]) -> bool:
    """Whether noise explains what an investigation left as well as the formula that was found."""
    larger = found.investigation
    own = [s for s in larger.steps if found.formula and s.effect == found.formula.name]
    more = _count(larger.steps) - _count(inv.steps)
    return bool(own) and _may_be_noise(larger, own[0]) and _as_noise(larger, inv.after, more, free)


def _may_be_noise(inv: Investigation, step: Step) -> bool:
    """Whether a residual that walks as it likes explains most of what an effect does, or it happens
    at instants: noise may jump, which no walk does.
    """
    if any(not isinstance(n, RandomWalk) for n in inv.after.seen.values()):
        return False
    if CATALOGUE[step.effect].has_events:
        return True
    apart = inv.after.log_likelihood - _refitted(inv, [step]).log_likelihood
    cost = PENALTY * len(step.keys)
    return apart / step.dispersion - cost < WANDERS * (step.gain + cost)


def _refitted(inv: Investigation, steps: Iterable[Step]) -> Fit:
    """The model without some effects, and the noise that it then shows."""
    sensor, free = inv.after.sensor, inv.after.free
    for s in steps:
        sensor, free = sensor.without(s.effect), free - s.keys
    return fit(replace(inv.after, sensor=sensor, free=free).with_noise())


def _count(steps: Iterable[Step]) -> int:
    return sum(len(s.keys) for s in steps)


def _as_noise(larger: Investigation, smaller: Fit, more: int, free: frozenset[str]) -> bool:
    """Whether the smaller model, beside its noise, is as likely as the larger one beside its own,
    which has some ``more`` coefficients.
    """
    sensor = larger.before.sensor
    rounds = sensor.reading("step") is not None or rounding(sensor.kind, larger).relevant
    likelihood = partial(likelihood_of, sensor, held=larger.held, free=free, rounds=rounds)
    with_effects, with_noise = likelihood(fit=larger.after), likelihood(fit=smaller)
    if with_effects is None or with_noise is None:
        return False
    return with_noise >= with_effects - PENALTY * more
