"""Which candidate to take: each of the best few fitted in full, the forms of one effect against
each other, and of those that the data do not tell apart the plainest.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce

import numpy as np

from pyimu.identification.fit.errors_in_variables import has_noise
from pyimu.identification.fit.fit import Fit, squares
from pyimu.identification.fit.keys import Key
from pyimu.identification.fit.maximum_likelihood import (
    advantage,
    advantage_by_its_noise,
    fit,
    fit_and_normal,
    wander_is_declared,
)
from pyimu.identification.fit.noise_fit import less_levels
from pyimu.identification.fit.normal import Normal
from pyimu.identification.fit.reduction import STRUCTURE
from pyimu.identification.fit.scatter import (
    explained_beside_wander,
    reweighed,
    with_less_wander,
)
from pyimu.identification.fit.walk import widening
from pyimu.identification.fit.whiten import WALKS, Autoregressive
from pyimu.identification.search.belief import unbelievable
from pyimu.identification.search.by_chance import Chance
from pyimu.identification.search.candidates import Group, equivalent, subsets, with_start
from pyimu.identification.search.ceiling import (
    at_samples,
    is_ceiling,
    stops_there,
)
from pyimu.identification.search.confirm import PLAINLY
from pyimu.identification.search.instants import at_instants
from pyimu.identification.search.projected import Scatter
from pyimu.identification.search.screen import (
    PENALTY,
    Screened,
    Screening,
    fitted_dispersion,
    fitted_gain,
    is_slow,
    keys_of,
    screen,
)
from pyimu.identification.search.threshold import at_threshold, is_held_there, is_threshold
from pyimu.model.catalogue import CATALOGUE

SET_WIDTH = 6.0
"""Log-likelihood [nat] within which another effect explains the data as well as the best."""

ALIKE = 1.0
"""Log-likelihood [nat] within which the data do not tell two effects apart: both are supported as
well as the other (two units of Akaike's criterion, Burnham and Anderson 2002, section 2.6)."""

MUCH_THE_SAME = 0.8
"""Share of what one candidate explains from which on another may explain it all: of n rows an
autoregression of order p knows the power at its slow end, where motions are, with a variance of
4 p / n (Berk 1974, "Consistent autoregressive spectral estimates", Ann. Stat. 2): of 10,000 rows
and order 32 a tenth, twice that for a share."""

MOST_REFINED = 5

CLEAR = 0.5
"""Share of the power that one form of a delay leaves which another leaves at most where it is the
clearly better one beside a derived reference: of half of what is left there, that reference's own
rows, filters and joints may be the cause."""

LEAST_SHARE = 0.1
"""Share of the best gain at first look below which a candidate is not fitted in full: noise fitted
anew reorders, but not so far."""


@dataclass(frozen=True)
class Refined:
    """A candidate fitted in full.

    ``gain`` [nat] over the model without it, corrected for scatter, its sizes penalised and its
    form charged for; ``explained`` the same as it stands.
    """

    screened: Screened
    fit: Fit
    gain: float
    explained: float
    dispersion: float
    normal: Normal


@dataclass
class Tried:
    """Candidates beside one model, each fitted in full once.

    ``denied`` are those that were refused whatever they explain, and what they are: beyond belief,
    or not so on held-out rows; ``views`` are the model with the noises by which it is still to be
    looked at, and whether for slow effects alone.
    """

    current: Fit
    declared: Iterable[str]
    refined: dict[str, Refined] = field(default_factory=dict)
    denied: list[tuple[Refined, str]] = field(default_factory=list)
    views: list[tuple[Fit, bool]] = field(init=False)
    usual: Screening | None = None

    def __post_init__(self) -> None:
        if self.current.is_reduced:
            self.views = [(self.current, False), (with_less_wander(self.current), False)]
            return
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
        chance = self.chance if view is self.current else None
        seen = screen(view, self.declared, slow=slow, chance=chance)
        wanders_less = slow or (view.is_reduced and view is not self.current)
        if wanders_less and self.usual is not None:
            scatter = next((c.scatter for c in self.usual.candidates), Scatter())
            few = tuple(replace(c, scatter=scatter) for c in seen.candidates)
            seen = Screening(few, max(seen.gate, self.usual.gate))
        self.usual = seen
        return seen, slow

    @property
    def gains(self) -> tuple[tuple[str, float], ...]:
        """What each candidate that was fitted in full explains [nat], by its name."""
        return tuple((name, max(float(r.gain), 0.0)) for name, r in self.refined.items())

    def refine(self, c: Screened) -> Refined:
        if c.effect not in self.refined:
            self.refined[c.effect] = refine(self.current, self._charged(c))
        return self.refined[c.effect]

    def _charged(self, c: Screened) -> Screened:
        """A slow effect without a form, charged for what it gains by chance beside a walk whose
        size nobody knows.
        """
        if (
            c.form is not None
            or c.effect in self.current.sensor.values
            or not is_slow(CATALOGUE[c.effect])
            or self.chance is None
        ):
            return c
        return replace(c, by_chance=self.chance.toll(self.current.linearise([c.effect]), c.effect))

    @cached_property
    def chance(self) -> Chance | None:
        """Draws of what the model leaves; None where no walk is looked for."""
        walks = any(isinstance(n, WALKS) for n in self.current.noise.values())
        if not walks or self.current.is_reduced:
            return None
        return Chance(self.current, self.current.linearise(), PENALTY)


def chosen_of(
    tried: Tried, options: list[Screened], gate: float
) -> tuple[Refined | None, tuple[str, ...]]:
    """The candidate that explains most once fitted in full, and the names of those that explain as
    much by a size that a sensor may have.
    """
    share = 0.0 if _takes_it_for_noise(tried.current) else LEAST_SHARE
    worth = [c for c in options[:MOST_REFINED] if c.gain > share * options[0].gain]
    refined = _above(gate, map(tried.refine, worth))
    if not refined:
        return None, ()
    derived = any(t.band_hz is not None for t in tried.current.trials)
    forms = _forms_of(refined[0], refined)
    best = plainest_form(forms, derived)
    others = [r for r in refined if all(r is not f for f in forms) and ahead(best, r) < ALIKE]
    plainest = min([best, *others], key=_how_plain)
    if plainest is not best:
        best = plainest_form(_forms_of(plainest, refined), derived)
    as_good = [r for r in refined if r is not best and ahead(best, r) <= SET_WIDTH]
    close = [r.screened.effect for r in as_good if not unbelievable(r.fit, keys_of(r.screened))]
    if derived or CATALOGUE[best.screened.effect].delay is not None:
        # Of a reference that ends below the band, or its clock, another form may be the truth.
        worse = {f.screened.effect for f in forms if _leaves_much_less(best, f)}
        family = equivalent(best.screened.effect) - worse
        close += [c.effect for c in options if c.effect in family]
    return best, tuple(dict.fromkeys(close))


def _above(gate: float, refined: Iterable[Refined]) -> list[Refined]:
    """Those whose gain is above the gate, the best first."""
    return [r for r in sorted(refined, key=lambda r: -r.gain) if r.gain > gate]


def _forms_of(one: Refined, refined: list[Refined]) -> list[Refined]:
    """Of candidates those that are forms of one effect, that of ``one``."""
    family = equivalent(one.screened.effect) | {one.screened.effect}
    return [r for r in refined if r.screened.effect in family]


def _how_plain(r: Refined) -> tuple[int, int, int]:
    """What is to be taken in to understand a candidate: its coefficients, and what it follows
    beside the sensor's own signal; then the order of the catalogue, which goes from plain to bent.
    """
    e = CATALOGUE[r.screened.effect]
    signals = len(e.signals(r.fit.sensor.kind))
    return len(keys_of(r.screened)), signals, list(CATALOGUE).index(e.name)


def plainest_form(forms: list[Refined], derived: bool = False) -> Refined:
    """The one of several forms of an effect that the data speak for.

    Unless they speak clearly it is the one with the fewest coefficients, of those the last in the
    catalogue, which lists a family's plainest form last; a derived reference ends below the band in
    which most delays differ, and speaks only where one form leaves much less than the other.
    """
    best = reduce(lambda one, other: other if ahead(other, one) > 0.0 else one, forms)
    mostly_blind = derived and CATALOGUE[best.screened.effect].delay is not None

    def is_near(other: Refined) -> bool:
        close = ahead(best, other) < SET_WIDTH
        return close or (mostly_blind and not _leaves_much_less(best, other))

    near = [other for other in forms if is_near(other)]
    order = list(CATALOGUE)

    def plainness(r: Refined) -> tuple[int, int]:
        return -len(keys_of(r.screened)), order.index(r.screened.effect)

    return max(near, key=plainness)


def _leaves_much_less(one: Refined, other: Refined) -> bool:
    """Whether a candidate leaves less than ``CLEAR`` of the power that another one leaves."""
    return share_left(one.fit, other.fit) < CLEAR


def share_left(one: Fit, other: Fit) -> float:
    """Share of a row's power that another model leaves which one leaves, in the (geometric) mean
    over the axes; the rows need not be the same.
    """
    powers = []
    for linears in (one.residuals(), other.residuals()):
        powers.append(squares(linears)[list(one.noise)] / sum(len(r.time) for r in linears))
    return float(np.exp(np.mean(np.log(powers[0] / powers[1]))))


def ahead(one: Refined, other: Refined) -> float:
    """Log-likelihood [nat] by which one candidate explains more than another, penalised.

    Both are corrected for the larger scatter: by each its own, what they explain together would
    decide. The noise of a derived reference may be of any colour, and takes what a model leaves for
    its own, so that the likelihood hardly falls: there each is judged by what it explains, and
    where that is ``MUCH_THE_SAME`` by one noise, that of the likelier, since what a motion weighs
    differs from noise to noise.
    """
    more = len(keys_of(one.screened)) - len(keys_of(other.screened))
    if one.fit.is_reduced:
        apart = one.explained - other.explained
    elif not (_takes_it_for_noise(one.fit) and _takes_it_for_noise(other.fit)):
        apart = _apart(one.fit, other.fit)
    elif min(one.explained, other.explained) < MUCH_THE_SAME * max(one.explained, other.explained):
        apart = one.explained - other.explained
    elif one.fit.log_likelihood >= other.fit.log_likelihood:
        apart = advantage(one.fit, other.fit)
    else:
        apart = -advantage(other.fit, one.fit)
    toll = one.screened.toll_of_form - other.screened.toll_of_form
    return apart / max(one.dispersion, other.dispersion) - PENALTY * more - toll


def _apart(one: Fit, other: Fit) -> float:
    """Log-likelihood [nat] by which one fit is ahead of another.

    Where one leaves no more random walk than the part declares and the other does, both are judged
    by the part's word: by a larger walk what is slow and not explained would hardly count.
    """
    first, second = (f.as_declared() is f for f in (one, other))
    if first and not second:
        return advantage(one, other)
    if second and not first:
        return -advantage(other, one)
    return one.log_likelihood - other.log_likelihood


def _takes_it_for_noise(fitted: Fit) -> bool:
    """True where noise of any colour is fitted though the part says how much the sensor wanders."""
    coloured = any(isinstance(n, Autoregressive) for n in fitted.noise.values())
    return coloured and wander_is_declared(fitted)


def promise(c: Screened, start: Fit, current: Fit) -> float:
    """Log-likelihood [nat] that a candidate gains by the noise that a model has, which is not
    fitted anew to what it leaves, some steps from where it ``start``s.
    """
    return advantage_by_its_noise(_with(start, c), current)


def beside(current: Fit, c: Screened) -> Fit:
    """A model with a candidate fitted in full, whatever it explains."""
    return fit(_with(current, c).with_noise())


def _with(current: Fit, c: Screened) -> Fit:
    """A model beside which a candidate is free, at the values where it begins."""
    sensor = with_start(current.sensor, c.values, c.effect, c.form)
    return replace(current, sensor=sensor, free=current.free | keys_of(c))


def likeliest_first(current: Fit, c: Screened, group: Group) -> list[tuple[Group, ...]]:
    """The groups of a candidate with all elements of a further one, or some: in the order of what
    they explain, penalised, by one fit of them all.
    """
    fitted, normal = fit_and_normal(
        _with(current, replace(c, groups=(*c.groups, group))).with_noise()
    )

    def lost(keys: tuple[Key, ...]) -> float:
        without = [k for k in group.keys if k not in keys]
        return fitted_gain(normal, fitted.sensor, without, c.scatter) if without else 0.0

    ordered = sorted(subsets(group.keys), key=lost)
    return [(*c.groups, replace(group, keys=keys)) for keys in ordered]


def refine(current: Fit, c: Screened) -> Refined:
    """Fit a candidate in full beside everything that is free already, less the axes that turn out
    not to need it.

    Its gain is taken with the noise fitted anew, which a missing effect had disguised, and
    corrected for the scatter of the scores at the fitted values.
    """
    start = _with(current, c).with_noise()
    sensor = start.sensor
    if is_slow(sensor.effect(c.effect)):
        # It is still part of what is left, and by a noise that predicts it would hardly come in.
        start = replace(start, noise=less_levels(start.residuals(), start.noise))
    fitted, normal = fit_and_normal(start)
    # The wander of rows is that beside all structure there may be: what is bent, it may be itself.
    bends = current.is_reduced and c.effect not in STRUCTURE
    if bends:
        fitted, normal = fit_and_normal(reweighed(fitted))
    if is_ceiling(sensor, c.effect):
        # Beside a scale factor that clipped samples bend the levels stray from where these lie.
        fitted = at_samples(fitted)
    declared = c.effect in current.sensor.values
    wider = widening(fitted) if len(c.groups) > 1 and is_slow(sensor.effect(c.effect)) else {}
    needed = tuple(g for g in c.groups if _needed(fitted, normal, g, declared, c.scatter, wider))
    if needed and len(needed) < len(c.groups):
        return refine(current, c.only(needed))
    spread = fitted_dispersion(normal, keys_of(c), c.scatter)
    if _leaves_more(fitted, current):
        needed = ()
    fitted = at_threshold(fitted) if is_threshold(sensor, c.effect) else fitted
    fitted = at_instants(fitted, c.effect)
    if bends:
        explained = explained_beside_wander(fitted, current, len(keys_of(c)))
    else:
        explained = advantage(fitted, current)
    # What the choice of a form gains by chance is its toll, however many coefficients it has.
    gain = explained / spread - PENALTY * sum(len(g.keys) for g in c.groups) - c.toll
    return Refined(c, fitted, gain if needed else -np.inf, explained, spread, normal)


def _leaves_more(fitted: Fit, current: Fit) -> bool:
    """Whether an effect beside a reference with noise leaves more than there was: of the draws of
    that noise more is then taken off, but a draw is none of what the log holds.
    """
    if not has_noise(current):
        return False
    powers = [squares(f.residuals())[list(f.noise)].sum() for f in (fitted, current)]
    return bool(powers[0] > (1.0 + PLAINLY) ** 2 * powers[1])


def _needed(
    fitted: Fit,
    normal: Normal,
    group: Group,
    declared: bool,
    scatter: Scatter,
    wider: Mapping[Key, float],
) -> bool:
    """True where the part of an effect that a group stands for explains something once all is
    fitted together; ``wider`` are factors by which standard errors are larger than the fitted noise
    says.
    """
    if is_ceiling(fitted.sensor, group.effect):
        return stops_there(fitted, group.keys[0].index[0])
    if is_threshold(fitted.sensor, group.effect):
        return is_held_there(fitted, group.keys[0].index[0])
    whole = fitted.is_reduced and group.effect in STRUCTURE
    beyond = max((wider.get(k, 1.0) for k in group.keys), default=1.0)
    return (
        declared
        or whole
        or group.measure is not None
        or fitted_gain(normal, fitted.sensor, group.keys, scatter, beyond) > 0
    )
