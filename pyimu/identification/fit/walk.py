"""What is not known of a random walk, in the standard errors of the coefficients beside it.

A walk that nobody declared is fitted to the rows that show the coefficients, too, and a slow
coefficient takes a part of it for its own: the walk comes out too small, and with it the
coefficient's error. Here the coefficients are estimated beside every walk that the rows allow, each
weighed by its restricted likelihood (Patterson and Thompson 1971, "Recovery of inter-block
information when block sizes are unequal", Biometrika 58), with all sizes K alike beforehand (Gelman
2006, "Prior distributions for variance parameters in hierarchical models", Bayesian Analysis 1).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from scipy.special import logsumexp

from pyimu.identification.fit.columns import Linear, Stack
from pyimu.identification.fit.errors_in_variables import (
    column_changes,
    equations,
    has_noise,
    of_axis,
)
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Key
from pyimu.identification.fit.local_level import FEWEST, many_rows
from pyimu.identification.fit.mixture import standard_error
from pyimu.identification.fit.noise_fit import declared_variances
from pyimu.identification.fit.normal import (
    Normal,
    log_determinant,
    normal_equations,
    solve,
    variances,
)
from pyimu.identification.fit.whiten import RandomWalk

FACTOR = 2.0
"""From one K^2 that is tried to the next."""

LEAST_WEIGHT = 1e-3
"""Of a walk, in units of the likeliest's, below which those beyond it are not tried."""

BEYOND = 256.0
"""K^2 in units of the fitted one beside which rows are put together, where that is as many times
the least: it grows as large as the error of a mean in a sixteenth of the log then, which shows it
so often that larger ones weigh nothing."""


def with_unknown_walk(fit: Fit) -> Fit:
    """The fit with standard errors whose intervals hold although the random walk is not known."""
    wider = widening(fit)
    std = {k: v * wider.get(k, 1.0) for k, v in fit.std.items()}
    return replace(fit, std=std) if wider else fit


def widening(fit: Fit) -> Mapping[Key, float]:
    """By what factor a coefficient's standard error is larger for a walk that nobody knows."""
    walks = {i: n for i, n in fit.noise.items() if isinstance(n, RandomWalk)}
    unknown = {i: n for i, n in walks.items() if not 0.0 < n.k2 <= _declared(fit, i)}
    if not unknown:
        return {}
    sides = (fit.linearise(), column_changes(fit) if has_noise(fit) else [])
    whole = with_prior(equations(fit), fit)
    out: dict[Key, float] = {}
    for i, noise in unknown.items():
        rows, changed = ([of_axis(one, i) for one in side] for side in sides)
        axis = _Axis(rows, changed, i, noise, whole, _declared(fit, i))
        for key, factor in axis.widening().items():
            out[key] = out.get(key, 1.0) * factor
    return out


def _declared(fit: Fit, axis: int) -> float:
    return float(declared_variances(fit.sensor, fit.trials[0].h)[1][axis])


class _Axis:
    """The equations of all axes with those of one taken anew for each walk that is tried: its
    ``linears``, less what the noise of the reference ``changed`` in them.

    Where the walk is well known they are taken of means over rows: what rows say within a mean is
    the same beside each walk.
    """

    def __init__(
        self,
        linears: list[Linear],
        changed: list[Linear],
        axis: int,
        noise: RandomWalk,
        whole: Normal,
        declared: float,
    ) -> None:
        self.axis, self.noise = axis, noise
        # A walk that stays within the error of a mean is as good as none.
        rows = sum(len(one.time) for one in linears)
        lasts = [float(one.time[-1] - one.time[0]) for one in linears]
        self.least = max(declared, noise.r / rows / max(lasts))
        self.many = 1
        if noise.k2 > BEYOND * self.least:
            ratio = BEYOND * noise.k2 * sum(lasts) / rows / noise.r
            most = min(len(one.time) for one in linears) // FEWEST
            self.many = max(1, min(many_rows(float(np.log(ratio))), most))
        self.linears, self.changed = (
            [_in_means(one, axis, self.many) for one in side] for side in (linears, changed)
        )
        gram, score, _, self.keys = self._equations(noise)
        self.at = [whole.position[k] for k in self.keys]
        self.gram, self.score = np.array(whole.gram), np.array(whole.score)
        self.gram[np.ix_(self.at, self.at)] -= gram
        self.score[self.at] -= score

    def _equations(self, noise: RandomWalk) -> tuple[np.ndarray, np.ndarray, float, list[Key]]:
        """Gram matrix and score of the axis' columns beside a noise, the log-likelihood [nat] of
        the residual, and the columns' keys, less what no walk changes.
        """
        # Means are as large as makes their white variance that of a row.
        noise = replace(noise, k2=self.many * noise.k2)
        own = normal_equations(self.linears, {self.axis: noise})
        gram, score = np.array(own.gram), np.array(own.score)
        if self.changed:
            theirs = normal_equations(self.changed, {self.axis: noise})
            at = [own.position[k] for k in theirs.keys]
            gram[np.ix_(at, at)] -= theirs.gram
            score[at] -= theirs.score
        return gram, score, own.log_likelihood, own.keys

    def beside(self, k2: float) -> tuple[float, np.ndarray, np.ndarray]:
        """Restricted log-likelihood [nat] of a walk, and where the axis' coefficients (k,) lie
        beside it and their standard errors (k,).
        """
        own_gram, own_score, likely, _ = self._equations(replace(self.noise, k2=k2))
        gram, score = np.array(self.gram), np.array(self.score)
        gram[np.ix_(self.at, self.at)] += own_gram
        score[self.at] += own_score
        step = solve(gram, score)
        likely += 0.5 * float(step @ score) - 0.5 * log_determinant(gram)
        return likely, step[self.at], np.sqrt(variances(gram))[self.at]

    def widening(self) -> dict[Key, float]:
        """By what factor the standard errors of the axis' coefficients are larger."""
        fitted = max(self.noise.k2, self.least)
        tried = {fitted: self.beside(fitted)}
        for factor in (FACTOR, 1.0 / FACTOR):
            k2 = fitted * factor
            while k2 >= self.least:
                tried[k2] = self.beside(k2)
                if not _weight(k2, tried) >= LEAST_WEIGHT * max(_weight(k, tried) for k in tried):
                    break
                k2 *= factor
        log_weights = np.array([likely + 0.5 * np.log(k) for k, (likely, _, _) in tried.items()])
        if not np.all(np.isfinite(log_weights)):
            return {}
        weights = np.exp(log_weights - logsumexp(log_weights))
        steps, stds = (np.array([t[n] for t in tried.values()]) for n in (1, 2))
        return {
            key: standard_error(weights, steps[:, n] - steps[0, n], stds[:, n]) / stds[0, n]
            for n, key in enumerate(self.keys)
            if np.all(np.isfinite(stds[:, n])) and stds[0, n] > 0.0
        }


def _in_means(one: Linear, axis: int, many: int) -> Linear:
    """The rows of an axis in means of so ``many``, times the root of it; what is left at the end is
    left out.
    """
    if many == 1:
        return one
    # A product: ``mean`` goes through a call for each few rows.
    count, share = len(one.time) // many, np.full(many, 1.0 / many)

    def means(values: np.ndarray) -> np.ndarray:
        return values[: count * many].reshape(count, many) @ share

    root, residual = np.sqrt(many), np.zeros((count, 3))
    residual[:, axis] = root * means(one.residual[:, axis])
    columns = tuple(root * means(c) for c in one.columns[axis].arrays) if axis in one.keys else ()
    stacks = {i: Stack(count, columns) for i in one.keys}
    whole = [(0, count)]
    return replace(one, time=means(one.time), segments=whole, residual=residual, columns=stacks)


def _weight(k2: float, tried: Mapping[float, tuple]) -> float:
    """Of a walk, for steps that are all of one factor."""
    best = max(t[0] for t in tried.values())
    return float(np.sqrt(k2) * np.exp(tried[k2][0] - best))
