"""Selection: how much each candidate explains, how much chance alone would, and which to take.

The gain of an effect is the log-likelihood [nat] that its best coefficients add, less a penalty for
each, summed over the axes where that is positive. The gate is what the largest gain of all
candidates exceeds by chance alone no oftener than it may, from scores drawn with the covariance
that the data's own Gram matrix gives them (max-T).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pyimu.display.brief import Brief
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Coefficient, Key
from pyimu.identification.fit.normal import Normal, solve
from pyimu.identification.search.by_chance import Chance
from pyimu.identification.search.candidates import (
    Choice,
    Group,
    absent,
    contestable,
    groups,
    scan_columns,
    scanned,
    with_start,
)
from pyimu.identification.search.form import Form, form_of
from pyimu.identification.search.forms import forms
from pyimu.identification.search.projected import ONE, Projected, Scatter, dispersion, scatter_of
from pyimu.model.effect import Effect
from pyimu.model.sensor import Sensor

PENALTY = 3.0
FALSE_ALARM = 0.01
"""Chance that a command names anything where nothing is missing."""

SHARE = 0.25
"""Part of that chance which one sensor's effects have: there are two sensors, and noise to name."""

DRAWS = 4000
VISIBLE = 6.0
"""How many standard errors a coefficient must exceed to count as visible in a log."""


@dataclass(frozen=True, repr=False)
class Screened(Brief):
    """Gain of one effect before any correction, the groups that take part, the scanned values and
    the form to start from.

    ``visible`` are the smallest coefficients that would stand out, by element, and
    ``smallest_visible`` that of them which is nearest to none.
    """

    effect: str
    gain: float
    groups: tuple[Group, ...]
    values: dict[tuple, float]
    smallest_visible: float
    inseparable_from: tuple[str, ...] = ()
    form: Form | None = None
    scatter: Scatter = ONE
    visible: Mapping[tuple[int, ...], float] = field(default_factory=dict)
    by_chance: float = 0.0

    @property
    def toll(self) -> float:
        """What it is charged [nat]: the choice of its form, or what it gains ``by_chance`` beside a
        walk whose size nobody knows.
        """
        return self.by_chance if self.form is None else self.form.toll

    @property
    def toll_of_form(self) -> float:
        """The part of that which tells it from another effect."""
        return self.toll - self.by_chance

    def only(self, kept: tuple[Group, ...]) -> Screened:
        """The same effect on the axes of some of its groups."""
        indices = {g.keys[0].index for g in kept}
        values = {k: v for k, v in self.values.items() if k in indices}
        return replace(self, groups=kept, values=values)


@dataclass(frozen=True, repr=False)
class Screening(Brief):
    candidates: tuple[Screened, ...]
    gate: float

    def above(self) -> list[Screened]:
        """Candidates above the gate, best first."""
        return sorted((c for c in self.candidates if c.gain > self.gate), key=lambda c: -c.gain)


def is_slow(e: Effect) -> bool:
    """Whether an effect may be slow: a bias that depends on something else than the sensor's own
    signal, and is no vibration.
    """
    return e.stage == "bias" and not e.is_line


def screen(
    fit: Fit,
    declared: Iterable[str],
    seed: int = 1,
    *,
    slow: bool = False,
    chance: Chance | None = None,
) -> Screening:
    """Rank every absent effect, and those of ``declared`` whose values could be wrong, by the gain
    over the fitted model; with ``slow`` those alone that may be slow. ``chance`` are draws of what
    the fit leaves, where there are some.
    """
    new, held = absent(fit), contestable(fit, declared)
    if slow:
        new, held = [e for e in new if is_slow(e)], []
    found_forms = forms(fit, new, PENALTY, chance)
    new = [e for e in new if not form_of(e) or e.name in found_forms]
    scans = scan_columns(fit, new)
    for name, form in found_forms.items():
        fit = replace(fit, sensor=with_start(fit.sensor, {}, name, form))
    effects = new + held
    linear = [e.name for e in new if not scanned(e)] + [e.name for e in held]
    normal = with_prior(equations(fit, lambda f: f.linearise(linear, [scans])), fit)
    whole = fit.is_reduced
    all_groups = groups(normal, fit.sensor, effects, whole)
    taken = sorted({c for g in all_groups for choice in g.choices for c in choice.columns})
    base = [i for i in range(len(normal.keys)) if i not in set(taken)]
    projected = Projected.of(normal, base, taken)
    place = {column: i for i, column in enumerate(taken)}
    moved = [replace(g, choices=tuple(c.at(place) for c in g.choices)) for g in all_groups]
    gate = _gate(projected, moved, np.random.default_rng(seed))
    by_effect = {e.name: [g for g in moved if g.effect == e.name] for e in effects}
    scatter = scatter_of(projected)
    found = tuple(
        replace(_with_form(_screened(name, gs, projected), found_forms.get(name)), scatter=scatter)
        for name, gs in by_effect.items()
        if gs
    )
    return Screening(tuple(_with_twins(found, by_effect, projected)), gate)


def _with_form(one: Screened, form: Form | None) -> Screened:
    return one if form is None else replace(one, gain=one.gain - form.toll, form=form)


def _gains(score: np.ndarray, choice: Choice, variance: np.ndarray) -> np.ndarray:
    """Gain [nat] of one choice for scores (d, P) of a covariance, the penalty taken off.

    A scan's amplitude must not be negative.
    """
    at = list(choice.columns)
    s = score[:, at]
    if not np.any(np.diag(variance)[at]):
        return np.zeros(len(score))
    if len(at) == 1:
        gain = 0.5 * s[:, 0] ** 2 / variance[at[0], at[0]]
    else:
        gain = 0.5 * np.einsum("di,id->d", s, solve(variance[np.ix_(at, at)], s.T))
    if choice.value is not None:
        gain = np.where(s[:, 0] > 0, gain, 0.0)
    return gain - PENALTY * len(at)


def _gate(projected: Projected, all_groups: list[Group], rng: np.random.Generator) -> float:
    """The largest gain over all effects that chance exceeds no oftener than it may."""
    if not all_groups:
        return np.inf
    scale = np.sqrt(np.maximum(np.diag(projected.variance), 1e-300))
    values, vectors = np.linalg.eigh(projected.variance / np.outer(scale, scale))
    root = vectors * np.sqrt(np.maximum(values, 0.0)) * scale[:, None]
    draws = rng.standard_normal((DRAWS, len(scale))) @ root.T
    total: dict[str, np.ndarray] = {}
    for g in all_groups:
        best = np.max([_gains(draws, c, projected.variance) for c in g.choices], axis=0)
        total[g.effect] = total.get(g.effect, 0.0) + np.maximum(best, 0.0)
    return float(np.quantile(np.max(list(total.values()), axis=0), 1.0 - SHARE * FALSE_ALARM))


def _screened(effect: str, gs: list[Group], projected: Projected) -> Screened:
    picked, gain, values = [], 0.0, {}
    seen = {g.keys[0].index: _smallest(projected, g) for g in gs}
    visible = {index: v for index, v in seen.items() if v is not None}
    for g in gs:
        options = [
            (c, float(_gains(projected.score[None], c, projected.variance)[0])) for c in g.choices
        ]
        choice, best = max(options, key=lambda o: o[1])
        if best > 0:
            picked.append(g.only(choice))
            gain += best
            if choice.value is not None:
                values[g.keys[0].index] = choice.value
    nearest = max if gs[0].measure in ("rate", "range") else min
    least = nearest(visible.values(), default=np.inf)
    return Screened(effect, gain, tuple(picked), values, least, visible=visible)


def _smallest(projected: Projected, g: Group) -> float | None:
    """The coefficient of a group nearest to the identity that would stand out, None where none
    would.

    A scanned delay or dead zone does more, a natural frequency or a limit less, the larger it is;
    delay and frequency do so in proportion near the identity, so the grid's nearest value gives the
    answer.
    """
    gram, variance = np.diag(projected.gram), np.diag(projected.variance)
    power = gram**2 / np.where(gram > 0.0, variance, 1.0)
    seen = sorted((c.value or 0.0, float(power[list(c.columns)].max())) for c in g.choices)
    seen = [(v, np.sqrt(p) / VISIBLE) for v, p in seen if p > 0]
    if not seen:
        return None
    if g.measure is None:
        return 1.0 / max(ratio for _, ratio in seen)
    if g.measure == "period":
        return seen[0][0] / seen[0][1]
    if g.measure == "rate":
        return seen[-1][0] * seen[-1][1]
    nearest = min if g.measure == "zone" else max
    return nearest((v for v, ratio in seen if ratio > 1), default=None)


def fitted_dispersion(normal: Normal, keys: Iterable[Key], scatter: Scatter = ONE) -> float:
    """The correction for coefficients that are fitted, from the slopes at their values and the
    noise beside them.
    """
    projected = _projected(normal, keys)
    if projected is None:
        return 1.0
    return dispersion(projected, range(len(projected.gram)), scatter)


def fitted_gain(
    normal: Normal, sensor: Sensor, keys: Iterable[Key], scatter: Scatter = ONE, wider: float = 1.0
) -> float:
    """Gain [nat] of coefficients that are fitted over their being zero, corrected for scatter and
    penalised; their standard errors are ``wider`` than the noise says by a factor.

    The form of their effect is taken as it was fitted: of an effect that is zero any form will do
    (Davies 1977, "Hypothesis testing when a nuisance parameter is present only under the
    alternative", Biometrika 64), and what choosing it gains is charged for as a toll.
    """
    keys = [k for k in keys if k in normal.position]
    projected = _projected(normal, keys, _forms_beside(normal, sensor, keys))
    if projected is None:
        return -np.inf
    value = np.array([sensor.values[k.effect][k.parameter][k.index] for k in keys])
    score = projected.gram @ value
    gain = 0.5 * float(score @ solve(projected.variance, score))
    spread = wider**2 * dispersion(projected, range(len(keys)), scatter)
    return gain / spread - PENALTY * len(keys)


def _forms_beside(normal: Normal, sensor: Sensor, keys: Iterable[Key]) -> set[Key]:
    """Coefficients that form the effects whose sizes are ``keys``."""
    effects = {k.effect for k in keys}
    beside = (k for k in normal.keys if isinstance(k, Coefficient) and k.effect in effects)
    return {k for k in beside if sensor.effect(k.effect).parameters[k.parameter].form} - {*keys}


def _projected(
    normal: Normal, keys: Iterable[Key], fixed: Collection[Key] = ()
) -> Projected | None:
    """Columns ``keys`` without what all others explain but those of ``fixed`` coefficients."""
    wanted = [normal.position[k] for k in keys if k in normal.position]
    apart = {*wanted, *(normal.position[k] for k in fixed)}
    base = [i for i in range(len(normal.keys)) if i not in apart]
    return Projected.of(normal, base, wanted) if wanted else None


def _with_twins(
    found: tuple[Screened, ...], by_effect: dict[str, list[Group]], projected: Projected
) -> list[Screened]:
    """Note for each effect which others its columns could stand in for."""
    spaces = {name: _space(gs, projected) for name, gs in by_effect.items() if gs}
    d = np.sqrt(np.maximum(np.diag(projected.gram), 0.0))
    correlation = projected.gram / np.where(np.outer(d, d) > 0, np.outer(d, d), 1.0)
    out = []
    for one in found:
        twins = tuple(
            other
            for other in spaces
            if other != one.effect and _alike(spaces[one.effect], spaces[other], correlation)
        )
        out.append(replace(one, inseparable_from=twins))
    return out


def _space(gs: list[Group], projected: Projected) -> list[int]:
    """Columns of an effect near its identity: of a scan the value that does least."""
    least = [g.choices[-1] if g.measure in ("rate", "range") else g.choices[0] for g in gs]
    return [c for choice in least for c in choice.columns if projected.gram[c, c] > 0]


def _alike(a: list[int], b: list[int], correlation: np.ndarray, limit: float = 0.98) -> bool:
    """True where some direction of ``a`` correlates with one of ``b`` above ``limit``."""
    if not a or not b:
        return False
    return bool(np.abs(correlation[np.ix_(a, b)]).max() > limit)


def keys_of(screened: Screened) -> frozenset[Key]:
    """Coefficients that an effect brings in: of the groups that take part, and of its form."""
    keys = frozenset(k for g in screened.groups for k in g.keys)
    return keys if screened.form is None else keys | screened.form.beside(keys)
