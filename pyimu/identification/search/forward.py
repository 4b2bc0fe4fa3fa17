"""Forward selection for one sensor.

Screen, fit the best few in full, ask the held-out data, add, and look again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import reduce
from types import MappingProxyType
from typing import Any

import numpy as np

from pyimu.identification.fit.fit import Fit, begin
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.maximum_likelihood import advantage, fit, fit_and_normal
from pyimu.identification.fit.normal import Normal
from pyimu.identification.fit.reduction import STRUCTURE
from pyimu.identification.fit.reference_noise import with_reference_noise
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.as_sampled import GATE, ceiling_of, threshold_of
from pyimu.identification.search.belief import unbelievable
from pyimu.identification.search.candidates import Group, equivalent, with_start
from pyimu.identification.search.ceiling import (
    at_samples,
    has_ceiling,
    is_ceiling,
    stops_there,
    without_lost,
)
from pyimu.identification.search.confirm import LEAST_OF_EXCESS, SPEAKS, Evidence, evidence
from pyimu.identification.search.instants import at_instants
from pyimu.identification.search.screen import (
    PENALTY,
    Scatter,
    Screened,
    Screening,
    fitted_dispersion,
    fitted_gain,
    keys_of,
    screen,
)
from pyimu.identification.search.threshold import at_threshold, is_held_there, is_threshold
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor

SET_WIDTH = 6.0
"""Log-likelihood [nat] within which another effect explains the data as well as the best."""

ALIKE = 1.0
"""Log-likelihood [nat] within which the data do not tell two effects apart: both are supported as
well as the other (two units of Akaike's criterion, Burnham and Anderson 2002, section 2.6)."""

CHANCE = 3.0
"""Standard errors by which held-out squares must be more than a true effect would leave."""

FORM = 0.01
"""Share of what a lag or a delay explains that its form may leave: a tenth of its amplitude, as the
sampled form of a pole is off at a quarter of the sample rate."""

MOST_EFFECTS = 8
MOST_REFINED = 5

LEAST_SHARE = 0.1
"""Share of the best gain at first look below which a candidate is not fitted in full: noise fitted
anew reorders, but not so far."""


@dataclass(frozen=True)
class Step:
    """One effect that was added.

    The coefficients it brought, its evidence, and who could stand in for it.

    ``declared`` says that the effect was in the model already and only its declared values were set
    free, ``as_sampled`` that the samples themselves show it, whatever squares it explains.
    """

    effect: str
    keys: frozenset
    gain: float
    gate: float
    alternatives: tuple[str, ...]
    dispersion: float
    declared: bool = False
    as_sampled: bool = False


@dataclass(frozen=True)
class Refused:
    """An effect that passed the gate but not belief or the held-out data."""

    effect: str
    gain: float
    reason: str

    def as_dict(self) -> dict[str, Any]:
        return asdict(self)


@dataclass(frozen=True)
class Investigation:
    """What the loop found for one sensor: the model before and after, and the way between."""

    before: Fit
    after: Fit
    steps: tuple[Step, ...]
    refused: tuple[Refused, ...]
    first: Screening
    last: Screening
    held: tuple[Trial, ...]


@dataclass(frozen=True)
class Refined:
    """A candidate fitted in full.

    ``gain`` [nat] over the model without it, corrected for scatter and penalised.
    """

    screened: Screened
    fit: Fit
    gain: float
    dispersion: float
    normal: Normal


@dataclass
class Tried:
    """Candidates beside one model, each fitted in full once.

    ``impossible`` are those whose coefficients are beyond belief; ``views`` are the model with the
    noises by which it is still to be looked at, and whether for slow effects alone.
    """

    current: Fit
    declared: Iterable[str]
    refined: dict[str, Refined] = field(default_factory=dict)
    impossible: list[Refined] = field(default_factory=list)
    views: list[tuple[Fit, bool]] = field(init=False)
    usual: Screening | None = None

    def __post_init__(self) -> None:
        held, less = self.current.as_declared(), self.current.wandering_less()
        self.views = [(held, False)]
        if held is not self.current:
            # What is left may wander more than the part declares after all.
            self.views.append((self.current, False))
        if less is not self.current:
            self.views.append((less, True))

    def looked(self) -> tuple[Screening, bool]:
        """The candidates by the next of the views, and whether only slow effects are among them.

        Beside less than the walk that there is gains are too large and scores scatter too much: it
        orders the candidates, and the gate and the scatter are those of the view before.
        """
        view, slow = self.views.pop(0)
        seen = screen(view, self.declared, slow=slow)
        if slow and self.usual is not None:
            scatter = next((c.scatter for c in self.usual.candidates), Scatter())
            few = tuple(replace(c, scatter=scatter) for c in seen.candidates)
            seen = Screening(few, max(seen.gate, self.usual.gate))
        self.usual = seen
        return seen, slow

    def refine(self, c: Screened) -> Refined:
        if c.effect not in self.refined:
            self.refined[c.effect] = refine(self.current, c)
        return self.refined[c.effect]


def investigate(
    sensor: Sensor,
    free: frozenset,
    trials: list[Trial],
    held: list[Trial],
    say: Callable[[str], None] = lambda text: None,
    prior: Mapping[Coefficient, float] = MappingProxyType({}),
) -> Investigation:
    """Find what ``sensor``, with coefficients ``free``, lacks to explain ``trials``, confirmed on
    ``held``; ``prior`` are standard deviations of coefficients that nobody declared.
    """
    say(f"{sensor.kind}: fitting the model as declared")
    before, held = with_reference_noise(fit(begin(sensor, free, trials, prior)), held)
    before = fit(before) if before.echo else before
    if has_ceiling(sensor):
        before = without_lost(before)
    after, steps = _as_sampled(before, held)
    refused: dict[str, Refused] = {}
    tried = Tried(after, sensor.values)
    first = last = seen = tried.looked()[0]
    while len(steps) < MOST_EFFECTS:
        say(f"{sensor.kind}: {len(steps)} added, trying {len(seen.candidates)} candidates")
        options = _in_order([c for c in seen.above() if c.effect not in refused], after)
        chosen, names = _choose(tried, options, seen.gate)
        if chosen is None:
            if not tried.views:
                break
            seen, slow = tried.looked()
            last = last if slow else seen
            continue
        reason = _within_form(chosen, steps)
        if not reason:
            chosen, reason = _judged(tried, chosen, held, seen.gate)
        name = chosen.screened.effect
        if reason:
            refused[name] = Refused(name, chosen.gain, reason)
            continue
        steps.append(
            Step(
                name,
                keys_of(chosen.screened),
                chosen.gain,
                seen.gate,
                names,
                chosen.dispersion,
                name in before.sensor.values,
            )
        )
        after = without_lost(chosen.fit) if is_ceiling(chosen.fit.sensor, name) else chosen.fit
        tried = Tried(after, sensor.values)
        last = seen = tried.looked()[0]
    after, steps = _backward(after, steps)
    return Investigation(
        before, after, tuple(steps), tuple(refused.values()), first, last, tuple(held)
    )


def _as_sampled(before: Fit, held: list[Trial]) -> tuple[Fit, list[Step]]:
    """A model with what the samples themselves say of the output."""
    after, steps = before, []
    for look in (threshold_of, ceiling_of):
        read = look(after, held)
        if read is not None:
            after = read.put_in(after)
            after = without_lost(after) if is_ceiling(after.sensor, read.effect) else after
            found = (read.effect, read.keys, read.gain, GATE, read.alternatives, 1.0)
            steps.append(Step(*found, as_sampled=True))
    return after, steps


def form_error(steps: Iterable[Step]) -> float:
    """Gain [nat] that the form of dynamics and output in a model may leave: it is not exact."""
    known = [
        s.gain
        for s in steps
        if CATALOGUE[s.effect].stage in ("dynamics", "output") and not s.as_sampled
    ]
    return FORM * max(known, default=0.0)


def _within_form(chosen: Refined, steps: list[Step]) -> str:
    """Why a candidate may be nothing but what the form of the model's dynamics leaves."""
    if chosen.gain > form_error(steps):
        return ""
    return f"explains less than {FORM:.0%} of what the lag or delay does, whose form is not exact"


def _in_order(options: list[Screened], fit: Fit) -> list[Screened]:
    """The candidates that come first where rows are stretches of a log: gains before all else.

    So few rows hardly tell a bend from a slope, and slopes are the commoner (effect hierarchy, Wu
    and Hamada 2009, section 4.6).
    """
    if all(t.reduction is None for t in fit.trials):
        return options
    return [c for c in options if c.effect in STRUCTURE] or options


def _choose(
    tried: Tried, options: list[Screened], gate: float
) -> tuple[Refined | None, tuple[str, ...]]:
    """The candidate that explains most once fitted in full, and the names of those that explain as
    much.
    """
    worth = [c for c in options[:MOST_REFINED] if c.gain > LEAST_SHARE * options[0].gain]
    refined = sorted(map(tried.refine, worth), key=lambda r: -r.gain)
    refined = [r for r in refined if r.gain > gate]
    if not refined:
        return None, ()
    derived = any(t.band_hz is not None for t in tried.current.trials)
    family = equivalent(refined[0].screened.effect)
    forms = [r for r in refined if r.screened.effect in family | {refined[0].screened.effect}]
    best = _form(forms, derived)
    others = [r for r in refined if all(r is not f for f in forms) and _ahead(best, r) < ALIKE]
    best = min([best, *others], key=_how_plain)
    close = [r.screened.effect for r in refined if r is not best and _ahead(best, r) <= SET_WIDTH]
    if derived or CATALOGUE[best.screened.effect].delay is not None:
        # Of a reference that ends below the band, or its clock, another form may be the truth.
        close += [c.effect for c in options if c.effect in equivalent(best.screened.effect)]
    return best, tuple(dict.fromkeys(close))


def _how_plain(r: Refined) -> tuple[int, int, int]:
    """What is to be taken in to understand a candidate: its coefficients, and what it follows
    beside the sensor's own signal; then the order of the catalogue, which goes from plain to bent.
    """
    e = CATALOGUE[r.screened.effect]
    signals = len(e.signals(r.fit.sensor.kind))
    return len(keys_of(r.screened)), signals, list(CATALOGUE).index(e.name)


def _form(forms: list[Refined], derived: bool) -> Refined:
    """The one of several forms of an effect that the data speak for.

    Unless they speak clearly it is the one with the fewest coefficients, of those the last in the
    catalogue, which lists a family's plainest form last; a derived reference ends below the band in
    which delays differ, and cannot speak at all.
    """
    best = reduce(lambda one, other: other if _ahead(other, one) > 0.0 else one, forms)
    blind = derived and CATALOGUE[best.screened.effect].delay is not None
    near = [other for other in forms if blind or _ahead(best, other) < SET_WIDTH]
    order = list(CATALOGUE)

    def plainness(r: Refined) -> tuple[int, int]:
        return -len(keys_of(r.screened)), order.index(r.screened.effect)

    return max(near, key=plainness)


def _ahead(one: Refined, other: Refined) -> float:
    """Log-likelihood [nat] by which one candidate explains more than another, penalised.

    Both are corrected for the larger scatter: by each its own, what they explain together would
    decide.
    """
    more = len(keys_of(one.screened)) - len(keys_of(other.screened))
    apart = one.fit.log_likelihood - other.fit.log_likelihood
    toll = one.screened.toll - other.screened.toll
    return apart / max(one.dispersion, other.dispersion) - PENALTY * more - toll


def refine(current: Fit, c: Screened) -> Refined:
    """Fit a candidate in full beside everything that is free already, less the axes that turn out
    not to need it.

    Its gain is taken with the noise fitted anew, which a missing effect had disguised, and
    corrected for the scatter of the scores at the fitted values.
    """
    sensor = with_start(current.sensor, c.values, c.effect, c.form)
    fitted, normal = fit_and_normal(
        replace(current, sensor=sensor, free=current.free | keys_of(c)).with_noise()
    )
    declared = c.effect in current.sensor.values
    needed = tuple(g for g in c.groups if _needed(fitted, normal, g, declared, c.scatter))
    if needed and len(needed) < len(c.groups):
        return refine(current, c.only(needed))
    spread = fitted_dispersion(normal, keys_of(c), c.scatter)
    fitted = at_samples(fitted) if is_ceiling(sensor, c.effect) else fitted
    fitted = at_threshold(fitted) if is_threshold(sensor, c.effect) else fitted
    fitted = at_instants(fitted, c.effect)
    gain = advantage(fitted, current) / spread - PENALTY * len(keys_of(c)) - c.toll
    return Refined(c, fitted, gain if needed else -np.inf, spread, normal)


def _needed(fitted: Fit, normal: Normal, group: Group, declared: bool, scatter: Scatter) -> bool:
    """True where the part of an effect that a group stands for explains something once all is
    fitted together.
    """
    if is_ceiling(fitted.sensor, group.effect):
        return stops_there(fitted, group.keys[0].index[0])
    if is_threshold(fitted.sensor, group.effect):
        return is_held_there(fitted, group.keys[0].index[0])
    whole = any(t.reduction is not None for t in fitted.trials) and group.effect in STRUCTURE
    return (
        declared
        or whole
        or group.measure is not None
        or fitted_gain(normal, fitted.sensor, group.keys, scatter) > 0
    )


def _judged(tried: Tried, chosen: Refined, held: list[Trial], gate: float) -> tuple[Refined, str]:
    """A chosen candidate on the axes that held-out rows leave it, and why it is refused all the
    same; nothing where it is not.
    """
    old = tried.current
    if chosen.screened.effect not in old.sensor.values:
        reason = unbelievable(chosen.fit, keys_of(chosen.screened))
        if reason:
            tried.impossible.append(chosen)
            return chosen, reason
    chosen, seen = _confirmed(old, chosen, held)
    return chosen, _against(chosen, seen, gate) or _stands_in(tried, chosen, gate)


def _confirmed(old: Fit, chosen: Refined, held: list[Trial]) -> tuple[Refined, Evidence]:
    """The chosen candidate less the axes on which held-out and fitted rows together speak against
    it, and the evidence for what is left.
    """
    seen = evidence(old, chosen.fit, held)
    groups = chosen.screened.groups
    kept = tuple(g for g in groups if not _denied(g, chosen, seen))
    if not seen.speaks or len(kept) in (0, len(groups)):
        return chosen, seen
    fewer = refine(old, chosen.screened.only(kept))
    return fewer, evidence(old, fewer.fit, held)


def _denied(group: Group, chosen: Refined, seen: Evidence) -> bool:
    """True where held-out rows lose more on the axis of a group than fitted rows gain by it."""
    if len(chosen.screened.groups) < 2 or not group.keys[0].index:
        return False
    axis = group.keys[0].index[0]
    if seen.difference[axis] < SPEAKS or seen.held[1, axis] <= seen.held[0, axis]:
        return False
    scatter = chosen.screened.scatter
    fitted = fitted_gain(chosen.normal, chosen.fit.sensor, group.keys, scatter)
    return fitted + seen.gained[axis] / chosen.dispersion <= 0.0


def _against(chosen: Refined, seen: Evidence, gate: float) -> str:
    """What fitted and held-out rows say against a chosen candidate."""
    if seen.speaks and seen.rise > 0.0 and seen.surprise > CHANCE:
        return f"raises the error on held-out data by {100 * seen.rise:.2g} %"
    apart = float(seen.gained.sum()) / chosen.dispersion
    if seen.speaks and chosen.gain + apart <= gate:
        return f"held-out data lose {-apart:.0f} nat by it"
    if seen.share < LEAST_OF_EXCESS:
        return (
            f"explains {seen.share:.0%} of what is left above the noise, where something unknown "
            f"may look like {LEAST_OF_EXCESS:.0%}"
        )
    return ""


def _stands_in(tried: Tried, chosen: Refined, gate: float) -> str:
    """The effect beyond belief that leaves a chosen candidate nothing to explain, if any does."""
    for other in (o for o in tried.impossible if o.gain > chosen.gain + SET_WIDTH):
        beside = refine(other.fit, chosen.screened)
        if beside.gain <= gate:
            name = other.screened.effect
            return f"explains what {name} would explain, whose size is beyond belief"
    return ""


def without(inv: Investigation, effect: str, reason: str) -> Investigation:
    """The investigation with an added effect taken back, for a ``reason`` found elsewhere."""
    step = next(s for s in inv.steps if s.effect == effect)
    sensor = inv.after.sensor.without(effect)
    after = fit(replace(inv.after, sensor=sensor, free=inv.after.free - step.keys).with_noise())
    return replace(
        inv,
        after=after,
        steps=tuple(s for s in inv.steps if s is not step),
        refused=(*inv.refused, Refused(effect, step.gain, reason)),
        last=screen(after, inv.before.sensor.values),
    )


def _backward(after: Fit, steps: list[Step]) -> tuple[Fit, list[Step]]:
    """Drop what later additions made superfluous.

    A ceiling never is, the samples at it having been left out since, nor what samples show.
    """
    for step in [
        s
        for s in steps[:-1]
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
