"""Effects that the search took in and that go again: what later ones made superfluous, what
another does as well, or for a reason found elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Coefficient, Key, coefficients_of
from pyimu.identification.fit.maximum_likelihood import advantage, fit
from pyimu.identification.fit.walk import with_unknown_walk
from pyimu.identification.search.candidates import has_form, scanned
from pyimu.identification.search.ceiling import is_ceiling
from pyimu.identification.search.investigation import Investigation, Refused, Step
from pyimu.identification.search.left_out import with_left_out
from pyimu.identification.search.projected import Scatter
from pyimu.identification.search.screen import PENALTY, Screening, fitted_dispersion, screen
from pyimu.model.sensor import Values


def may_grow(effect: str, after: Fit) -> bool:
    """Whether elements of an effect may be let in one by one: no form is theirs to find."""
    e = after.sensor.effect(effect)
    return not (has_form(e) or scanned(e) or after.is_reduced)


def by_fewer(
    after: Fit, steps: list[Step], last: Screening, values: Values
) -> tuple[Fit, list[Step], Screening]:
    """The model, its steps and the last look without an effect that came in where another would
    have done as well that is in the model, too, if that one does on the axes of both.
    """
    for one in steps:
        others = [s for s in steps if s.effect in one.alternatives and may_grow(s.effect, after)]
        for other in () if one.declared or one.as_sampled else others:
            more = _on_axes_of(one, other, after) - other.keys
            free = (after.free - one.keys) | more
            sensor = after.sensor.without(one.effect)
            fewer = fit(replace(after, sensor=sensor, free=free).with_noise())
            lost = advantage(after, fewer) / one.dispersion - PENALTY * (len(one.keys) - len(more))
            if lost <= one.gate:
                grown = replace(other, keys=other.keys | more, gain=other.gain + one.gain)
                kept = [grown if s is other else s for s in steps if s is not one]
                return fewer, kept, screen(fewer, values)
    return after, steps, last


def _on_axes_of(one: Step, other: Step, after: Fit) -> frozenset[Key]:
    """The coefficients of another step's effect on the axes on which one acts."""
    axes = {k.index[0] for k in one.keys if isinstance(k, Coefficient) and k.index}
    every = coefficients_of(after.sensor, other.effect)
    return frozenset(k for k in every if k.index and k.index[0] in axes)


def without(inv: Investigation, effect: str, reason: str) -> Investigation:
    """The investigation with an added effect taken back, for a ``reason`` found elsewhere; as it is
    where that went with another one, to which it had leant.
    """
    step = next((s for s in inv.steps if s.effect == effect), None)
    if step is None:
        return inv
    sensor = inv.after.sensor.without(effect)
    after = fit(replace(inv.after, sensor=sensor, free=inv.after.free - step.keys).with_noise())
    # What was found beside it may have leant on it.
    after, kept = backward(after, [s for s in inv.steps if s is not step], made=0)
    steps = tuple(kept)
    return replace(
        inv,
        after=with_intervals(after, steps),
        steps=steps,
        refused=(*inv.refused, Refused(effect, step.gain, reason)),
        last=screen(after, inv.before.sensor.values),
    )


def less_of_baseline(inv: Investigation, effects: Iterable[str]) -> Investigation:
    """The investigation with its model after fitted anew without some effects that it began with;
    what was found stays.
    """
    sensor, out = inv.after.sensor, set(effects)
    for effect in out:
        sensor = sensor.without(effect)
    free = {k for k in inv.after.free if not (isinstance(k, Coefficient) and k.effect in out)}
    prior = {k: s for k, s in inv.after.prior.items() if k.effect not in out}
    less = replace(inv.after, sensor=sensor, free=frozenset(free), prior=prior)
    return replace(inv, after=with_intervals(fit(less.with_noise()), inv.steps))


def with_intervals(after: Fit, steps: Iterable[Step]) -> Fit:
    """The fit with standard errors that hold although noise and elements were chosen by the same
    rows.
    """
    return with_unknown_walk(with_left_out(after, [s.effect for s in steps if not s.declared]))


def scattering_at_last(after: Fit, steps: list[Step], last: Screening) -> list[Step]:
    """Steps with no more scatter than scores have beside all that was found: what was missing when
    an effect was taken in, and has come in since, no longer makes its standard errors large.
    """
    if len(steps) < 2:
        return steps
    normal = with_prior(equations(after), after)
    usual = next((c.scatter for c in last.candidates), Scatter())
    *earlier, latest = steps
    fewer = [
        replace(s, dispersion=min(s.dispersion, fitted_dispersion(normal, s.keys, usual)))
        for s in earlier
    ]
    return [*fewer, latest]


def backward(after: Fit, steps: list[Step], made: int = 1) -> tuple[Fit, list[Step]]:
    """Drop what later additions made superfluous; the last that was ``made`` is not.

    A ceiling never is, the samples at it having been left out since, nor what samples show.
    """
    for step in [
        s
        for s in steps[: len(steps) - made]
        if not (s.declared or s.as_sampled or is_ceiling(after.sensor, s.effect))
    ]:
        rest = [s for s in steps if s is not step]
        kept = after.free - step.keys
        without = fit(
            replace(after, sensor=after.sensor.without(step.effect), free=kept).with_noise()
        )
        if advantage(after, without) / step.dispersion - PENALTY * len(step.keys) <= step.gate:
            after, steps = without, rest
    return after, steps
