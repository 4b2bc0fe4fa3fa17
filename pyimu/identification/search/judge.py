"""Whether a chosen candidate stands: belief, held-out rows, and what else would explain as much."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient, coefficients_of
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.belief import hidden, unbelievable
from pyimu.identification.search.candidates import Group
from pyimu.identification.search.choice import (
    ALIKE,
    SET_WIDTH,
    Refined,
    Tried,
    ahead,
    likeliest_first,
    refine,
)
from pyimu.identification.search.confirm import LEAST_OF_EXCESS, SPEAKS, Evidence, evidence
from pyimu.identification.search.own_signal import AT_ZERO, is_of_reference
from pyimu.identification.search.passing import passing
from pyimu.identification.search.reference_line import is_line_of_reference
from pyimu.identification.search.rounded import OF_DIGITS, within_digits
from pyimu.identification.search.screen import Screened, fitted_gain, is_slow, keys_of
from pyimu.identification.search.unseen_instants import with_unseen_instants
from pyimu.model.catalogue import CATALOGUE

OF_REFERENCE = "is the reference's noise: the sensor's own signal does not show it"
"""The reason for which an effect is refused that the reference alone makes look like one."""

OF_REFERENCE_AT_ZERO = "is the reference's noise about zero, which the sensor does not show"
"""As ``OF_REFERENCE``, of noise that is nothing beside the sensor's, and need not be known."""

GROWTH = "growth with time"
"""The family of effects whose bias grows as long as a log goes on."""


def judged(tried: Tried, chosen: Refined, held: list[Trial], gate: float) -> tuple[Refined, str]:
    """A chosen candidate on the axes that held-out rows leave it, and why it is refused all the
    same; nothing where it is not.
    """
    old = tried.current
    name = chosen.screened.effect
    is_line = CATALOGUE[name].is_line and name not in old.sensor.values
    damps = CATALOGUE[name].delay is not None
    if (
        is_line_of_reference(chosen.fit, name)
        if is_line
        else is_of_reference(old, chosen.fit, follows=damps)
    ):
        return chosen, OF_REFERENCE
    if name in AT_ZERO and is_of_reference(old, chosen.fit, follows=True):
        return chosen, OF_REFERENCE_AT_ZERO
    if within_digits(old, chosen.fit):
        return chosen, OF_DIGITS
    if reason := passing(chosen.fit, name):
        return chosen, reason
    if chosen.screened.effect not in old.sensor.values:
        chosen, reason = _shown(old, _within_belief(old, chosen), gate)
        beyond = unbelievable(chosen.fit, keys_of(chosen.screened))
        if beyond:
            tried.denied.append((chosen, "whose size is beyond belief"))
        if reason or beyond:
            return chosen, reason or beyond
    fitted = with_unseen_instants(old, chosen.fit, chosen.screened.effect, held)
    chosen, seen = _confirmed(old, replace(chosen, fit=fitted), held)
    reason = _against(chosen, seen, gate)
    if not reason:
        return chosen, _stands_in(tried, chosen, gate)
    tried.denied.append((chosen, "and was refused"))
    return chosen, reason


def _within_belief(old: Fit, chosen: Refined) -> Refined:
    """The chosen candidate by other elements of its axes where some of its own are beyond belief,
    and others, of a size that a sensor may have, explain as much: columns that are nearly one are
    told apart by chance, and one that is nearly nothing takes a coefficient for all of them.
    """
    seen = chosen.screened
    beyond = {k for k in keys_of(seen) if unbelievable(chosen.fit, [k])}
    if not beyond or seen.form is not None or seen.values:
        return chosen
    others = sorted(coefficients_of(chosen.fit.sensor, seen.effect) - beyond)
    best, groups = chosen, seen.groups
    for group in seen.groups:
        if beyond.isdisjoint(group.keys):
            continue
        # Each axis has samples of its own, so that what stands on the others makes no difference.
        kept = tuple(g for g in groups if g is not group)
        found = _instead(old, chosen, replace(seen, groups=kept), group, others)
        if found is None:
            return chosen
        best, groups = found, found.screened.groups
    return best


def _believed(found: Refined, kept: tuple[Group, ...]) -> bool:
    """Whether a candidate has no element beyond belief but for groups that were ``kept``."""
    own = [g for g in found.screened.groups if g not in kept]
    return not unbelievable(found.fit, [k for g in own for k in g.keys])


def _instead(
    old: Fit, chosen: Refined, beside: Screened, group: Group, others: Sequence[Coefficient]
) -> Refined | None:
    """The likeliest candidate with some of the ``others`` on the axis of a group in its place, or
    with nothing where there are none; None where none within belief explains as much.
    """
    kept = beside.groups
    row = tuple(k for k in others if k.index[:1] == group.keys[0].index[:1])
    whole = replace(group, keys=row)
    ways = likeliest_first(old, beside, whole) if row else [kept] if kept else []
    for groups in ways:
        found = refine(old, replace(beside, groups=groups))
        if ahead(chosen, found) > SET_WIDTH:
            return None
        if _believed(found, kept):
            return found
    return None


def _shown(old: Fit, chosen: Refined, gate: float) -> tuple[Refined, str]:
    """The chosen candidate less the elements that the data do not show beside the others, and why
    nothing is left of it where that is so.
    """
    unseen, reason = hidden(chosen.fit, keys_of(chosen.screened)), ""
    while unseen:
        reason = reason or next(iter(unseen.values()))
        kept = tuple(
            replace(g, keys=keys)
            for g in chosen.screened.groups
            if (keys := tuple(k for k in g.keys if k not in unseen))
        )
        if not kept:
            return chosen, reason
        fewer = refine(old, chosen.screened.only(kept))
        if fewer.gain <= gate:
            return chosen, reason
        chosen, unseen = fewer, hidden(fewer.fit, keys_of(fewer.screened))
    return chosen, ""


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
    if chosen.gain <= gate:
        return "explains no more than chance would on the axes that held-out data leave it"
    if seen.raises:
        return f"raises the error on held-out data by {100 * seen.worse:.2g} %"
    apart = float(seen.gained.sum()) / chosen.dispersion
    if seen.speaks and chosen.gain + apart <= gate:
        return f"held-out data lose {-apart:.0f} nat by it"
    if seen.is_little:
        return (
            f"explains {seen.share:.0%} of what is left above the noise, where something unknown "
            f"may look like {LEAST_OF_EXCESS:.0%}"
        )
    return ""


def _least(other: Refined, chosen: Refined) -> float:
    """What a refused effect must explain more [nat] than a chosen one to stand for it: a growth
    with time that no part has is a bias that wanders, as each does, and no effect is as likely.
    """
    grows, taken = (CATALOGUE[one.screened.effect] for one in (other, chosen))
    return ALIKE if grows.family == GROWTH and is_slow(taken) else SET_WIDTH


def _stands_in(tried: Tried, chosen: Refined, gate: float) -> str:
    """The refused effect that explains more than a chosen candidate and leaves it nothing to
    explain, if any does: what it stands for is not known, and the candidate only mimics it.
    """
    denied = ((o, what) for o, what in tried.denied if ahead(o, chosen) > _least(o, chosen))
    for other, what in denied:
        beside = refine(other.fit, chosen.screened)
        if beside.gain <= gate:
            return f"explains what {other.screened.effect} would explain, {what}"
    return ""
