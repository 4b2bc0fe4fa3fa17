"""What the samples themselves say of the output, before anything is regressed: where they stop, and
below which input they are zero.

So few samples may lie there that they hardly change the sum of squares, and yet by chance none
would.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.limited import THRESHOLD, with_limited
from pyimu.identification.fit.maximum_likelihood import advantage, fit
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.candidates import equivalent, scanned
from pyimu.identification.search.ceiling import (
    CEILING,
    has_samples,
    is_reached,
    piled,
    read_to,
)
from pyimu.identification.search.screen import FALSE_ALARM, PENALTY, SHARE
from pyimu.identification.search.threshold import zeroed, zeros
from pyimu.model.catalogue import CATALOGUE, read_off

LOOKS = 6
"""Two effects on three axes."""

GATE = float(np.log(LOOKS / (SHARE * FALSE_ALARM)))
"""Log-likelihood [nat] that one of them gains by chance as often as it may (Ville 1939: a ratio of
likelihoods is above 1 / a with a probability of at most a)."""


DENIED = 2.0
"""Standard errors from nothing below which regression denies what zeros may say by chance."""


@dataclass(frozen=True)
class Read:
    """A coefficient (3,) of an effect that was read off samples, zero on the axes that show none,
    with its standard errors and the penalised log-likelihood [nat] that it gains.

    ``alternatives`` are effects that the samples do not tell it from.
    """

    effect: str
    parameter: str
    values: np.ndarray
    std: np.ndarray
    gain: float
    alternatives: tuple[str, ...] = ()

    @property
    def keys(self) -> frozenset[Coefficient]:
        axes = map(int, np.flatnonzero(self.values))
        return frozenset(Coefficient(self.effect, self.parameter, (i,)) for i in axes)

    def put_in(self, fitted: Fit) -> Fit:
        """A fit with the effect, all else fitted again, and the effect too where it has a slope: of
        samples that a band spreads those at a ceiling count for nothing, and leave it none.
        """
        sensor = fitted.sensor.with_values(self.effect, **{self.parameter: self.values})
        std = {**fitted.std, **{k: float(self.std[k.index]) for k in self.keys}}
        trials = tuple(with_limited(sensor, t) for t in fitted.trials)
        counting = all(t.limited is None for t in trials)
        sloped = counting and scanned(CATALOGUE[self.effect]) is None
        free = fitted.free | (self.keys if sloped else frozenset())
        return fit(replace(fitted, sensor=sensor, trials=trials, free=free, std=std).with_noise())

    def borne_out(self, before: Fit) -> tuple[Read | None, Fit]:
        """The coefficient on the axes on which regression does not deny it, None where it denies
        all, and the fit with it. It does where it sees a slope, and leaves no more than two
        standard errors.
        """
        values, fitted = np.array(self.values), self.put_in(before)
        for key in self.keys & fitted.free:
            left = fitted.sensor.values[self.effect][self.parameter][key.index]
            if left < DENIED * fitted.std.get(key, 0.0):
                values[key.index] = 0.0
        if not values.any():
            return None, before
        fewer = replace(self, values=values)
        return fewer, fitted if fewer.keys == self.keys else fewer.put_in(before)


def threshold_of(fitted: Fit, held: Sequence[Trial]) -> Read | None:
    """The input below which the output is zero, None where the samples show none.

    Hard or soft say the zeros, and regression, which sees whether larger inputs lose by it. Where
    rows are made of many samples by a band, the zeros alone say what they do of a hard one.
    """
    hard, every = _looked_for(fitted, THRESHOLD), [*fitted.trials, *held]
    if hard is None or fitted.is_reduced:
        return None
    if not has_samples(every):
        alone = {i: zeroed(every, i) for i in fitted.trials[0].axes}
        return _read(hard, {i: z for i, z in alone.items() if z is not None})
    seen = {i: zeros(fitted, held, i) for i in fitted.trials[0].axes}
    found = {i: z for i, z in seen.items() if z is not None}
    of_hard = _read(hard, {i: z.hard for i, z in found.items()})
    soft = next(((n, next(iter(CATALOGUE[n].parameters))) for n in equivalent(hard[0])), None)
    of_soft = soft and _read(soft, {i: z.soft for i, z in found.items()})
    if of_hard is None or of_soft is None:
        return of_hard or of_soft
    lost = advantage(of_soft.put_in(fitted), fitted) - PENALTY * len(of_soft.keys)
    for_hard = sum(z.for_hard for z in found.values()) - max(lost, 0.0)
    best, other = (of_hard, of_soft) if for_hard > 0.0 else (of_soft, of_hard)
    return replace(best, alternatives=() if abs(for_hard) > GATE else (other.effect,))


def ceiling_of(fitted: Fit, held: Sequence[Trial]) -> Read | None:
    """The level at which the output stops, None where the samples show none.

    They do so too where rows are made of many by a band, which are fitted to those below it then.
    """
    found = _looked_for(fitted, CEILING)
    if found is None or fitted.is_reduced:
        return None
    every = [*fitted.trials, *held]
    tops = {i: piled(every, i) for i in fitted.trials[0].axes}
    return _read(
        found,
        {
            i: (top, read_to(every, i, top), gain)
            for i, (top, gain) in tops.items()
            if gain > PENALTY and is_reached(fitted, held, i, top)
        },
    )


def _looked_for(fitted: Fit, what: str) -> tuple[str, str] | None:
    """Effect and coefficient that are read off as ``what``; None where the model has one of that
    family.
    """
    kind, had = fitted.sensor.kind, fitted.sensor.values
    found = read_off((e for e in CATALOGUE.values() if kind in e.sensors), what)
    if found is None:
        return None
    same = {found[0], *equivalent(found[0])} & set(had)
    return None if any(fitted.sensor.acts(name) for name in same) else found


def _read(found: tuple[str, str], axes: Mapping[int, tuple[float, float, float]]) -> Read | None:
    """What was read of a coefficient, by axis its value, standard error and gain."""
    values, std, total = np.zeros(3), np.zeros(3), 0.0
    for i, (value, error, gain) in axes.items():
        if gain > PENALTY:
            values[i], std[i], total = value, error, total + gain - PENALTY
    return Read(*found, values, std, total) if total > GATE else None
