"""What the noise of a reference does to regressors, taken out (errors in variables).

A reference is x + e. Every column c(x + e) meets the residual's own -J e: their product has a mean,
-J var(e) E[dc/dx] by Stein's lemma, although nothing is missing. It pulls a scale factor down, and
makes a dead zone or a lag look as if they explained something. What a draw e' of like noise changes
in residual and columns has that same product, and its sums of squares and products are taken out
again: the corrected score and likelihood (Nakamura 1990, "Corrected score function for
errors-in-variables models", Biometrika 77), the means taken over the draw.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import product

import numpy as np

from pyimu.identification.fit.columns import Linear, Stack, band_time
from pyimu.identification.fit.fit import Fit, Last, power, whitened, whitened_power
from pyimu.identification.fit.incoherent import CHANCE
from pyimu.identification.fit.inputs import copied
from pyimu.identification.fit.normal import DEAD, Normal, in_slices, normal_equations
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.signals import COLUMNS

STEP = 0.3
"""Share of its standard deviation by which the reference is moved either way to see what changes:
slopes are limits, and the kinks of a dead zone scatter them the more the smaller the step."""

LEAST_SEEN = 0.01
"""Share of a column's power that must not be noise of the reference; of the rest there is nothing
to be seen."""


def moved(trial: Trial, sign: int) -> Trial:
    """The trial with its reference moved by ``STEP`` of its noise, made once for all fits to it."""
    if trial.noise is None:
        return trial
    if sign not in trial.moved:
        trial.moved[sign] = _moved(trial, sign)
    return trial.moved[sign]


def _moved(trial: Trial, sign: int) -> Trial:
    u, more = copied(trial.u), sign * STEP * trial.noise
    u[:, OWN[trial.kind]] += more
    for a, b in trial.segments:
        if b - a > 1:
            rate = np.gradient(more[a:b], trial.time[a:b], axis=0)
            u[a:b, COLUMNS[KINDS[trial.kind].own_rate]] += rate
    place = None if trial.place is None else trial.place.scattered(more)
    return replace(trial, u=u, place=place)


def has_noise(fit: Fit) -> bool:
    return any(t.noise is not None for t in fit.trials)


Pair = tuple[Fit, Fit]
"""A model beside references moved by their noise, up and down."""


def beside_moved(fit: Fit) -> Pair:
    """A model beside its references moved by their noise, each linearised once however many
    columns are asked for.
    """
    up, down = (
        replace(fit, trials=tuple(moved(t, sign) for t in fit.trials), last=Last())
        for sign in (1, -1)
    )
    return up, down


def changes(pair: Pair, linearised: Callable[[Fit], list[Linear]]) -> list[Linear]:
    """What the noise of the reference makes of each trial's residual and columns."""
    up, down = map(linearised, pair)
    return [_difference(a, b) for a, b in zip(up, down, strict=True)]


def _difference(up: Linear, down: Linear) -> Linear:
    columns = {}
    for i, keys in up.keys.items():
        below = dict(zip(down.keys[i], down.columns[i].arrays, strict=True))
        pairs = zip(keys, up.columns[i].arrays, strict=True)
        changed = ((column - below.get(key, 0.0)) / (2 * STEP) for key, column in pairs)
        columns[i] = Stack(len(up.time), tuple(changed))
    change = (up.residual - down.residual) / (2 * STEP)
    return replace(up, residual=change, columns=columns)


def _changes(
    fit: Fit, linearised: Callable[[Fit], list[Linear]], pair: Pair | None
) -> list[Linear]:
    """The same, once for all fits that differ in their noise alone."""
    if linearised is not Fit.linearise:
        return changes(pair or beside_moved(fit), linearised)
    return column_changes(fit)


def column_changes(fit: Fit) -> list[Linear]:
    """The same of the columns that the model has."""
    if not fit.last.changes:
        fit.last.changes = changes(beside_moved(fit), Fit.linearise)
    return fit.last.changes


def residual_changes(fit: Fit) -> list[Linear]:
    """What the noise of the reference makes of each trial's residual."""
    if fit.last.changes and (fit.is_last or fit.last.near):
        return fit.last.changes
    return changes(beside_moved(fit), Fit.residuals)


def equations(
    fit: Fit,
    linearised: Callable[[Fit], list[Linear]] = Fit.linearise,
    pair: Pair | None = None,
) -> Normal:
    """Normal equations of a fit's columns as a reference without noise would have them; ``pair``
    is the fit ``beside_moved`` references, for many calls.
    """
    found = normal_equations(linearised(fit), fit.noise)
    if not has_noise(fit):
        return found
    changed, seen = _changes(fit, linearised, pair), found.gram
    gram, score, power = found.batch_gram, found.batch_score, found.power
    doubt, unknown = np.zeros((len(fit.noise), len(seen))), np.zeros(len(seen))
    for row, axis in zip(doubt, fit.noise, strict=True):
        noise = normal_equations([of_axis(one, axis) for one in changed], fit.noise)
        at, own = _same(found, noise)
        error = _error(fit, axis)
        row[at] = error * noise.score[own]
        unknown[at] += error * np.diag(noise.gram)[own]
        # Gram matrices by batch are large: they are taken off where they stand.
        same = in_slices(at, own)
        for here, there in same:
            score[:, here] -= noise.batch_score[:, there]
        for (to, a), (across, b) in product(same, same):
            gram[:, to, across] -= noise.batch_gram[:, a, b]
        power -= noise.power
    whole = gram.sum(axis=0)
    hidden = np.diag(whole) <= np.maximum(LEAST_SEEN * np.diag(seen), CHANCE * unknown)
    score[:, hidden] = gram[:, hidden] = gram[:, :, hidden] = doubt[:, hidden] = 0.0
    shown = np.flatnonzero(~hidden)
    both = np.ix_(shown, shown)
    onto, off = _unseen_directions(whole[both], seen[both])
    if onto.size:
        _without(gram, score, doubt, shown, onto, off)
        gone = np.diag(gram.sum(axis=0)) <= DEAD * np.diag(seen)
        score[:, gone] = gram[:, gone] = gram[:, :, gone] = doubt[:, gone] = 0.0
    return Normal(found.keys, gram, score, power, found.rows, found.log_det, seen, doubt)


def _unseen_directions(gram: np.ndarray, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Directions of the columns whose power is the noise of the reference, all but ``LEAST_SEEN``:
    columns that show something each may add up to one that does not.

    Two of (P, k): I - first second' takes them out of scores, and from both sides out of a Gram
    matrix. With S = U W U' the Gram matrix of the columns as they are, they are the eigenvectors V
    of W^-1/2 U' G U W^-1/2 of small eigenvalues: U W^1/2 V and U W^-1/2 V.
    """
    scale = np.sqrt(np.diag(seen))
    values, vectors = np.linalg.eigh(seen / np.outer(scale, scale))
    keep = values > DEAD * values.max(initial=0.0)
    root, vectors = np.sqrt(values[keep]), vectors[:, keep]
    inner = (vectors / root).T @ (gram / np.outer(scale, scale)) @ (vectors / root)
    share, turned = np.linalg.eigh(inner)
    turned = turned[:, share <= LEAST_SEEN]
    onto, off = (vectors * root) @ turned, (vectors / root) @ turned
    return onto * scale[:, None], off / scale[:, None]


def _without(gram, score, doubt, at: np.ndarray, onto: np.ndarray, off: np.ndarray) -> None:
    """Take directions of the columns ``at`` out of ``gram`` (b, P, P), ``score`` (b, P) and
    ``doubt`` (k, P).
    """
    for rows in (score, doubt):
        rows[:, at] -= (rows[:, at] @ off) @ onto.T
    for one in gram:
        left = one[at] - onto @ (off.T @ one[at])
        one[at] = left
        one[:, at] -= (one[:, at] @ off) @ onto.T


def power_without_noise(fit: Fit) -> float:
    """Sum of squares of the whitened residual as a reference without noise would have it."""
    return power(fit) - whitened_power(fit, residual_changes(fit))


def of_axis(one: Linear, axis: int) -> Linear:
    """The rows of one axis."""
    if axis not in one.keys:
        return replace(one, keys={}, columns={})
    return replace(one, keys={axis: one.keys[axis]}, columns={axis: one.columns[axis]})


def _error(fit: Fit, axis: int) -> float:
    """Standard error of the power of the reference's noise on an axis, over that power."""
    return float(np.sqrt(np.mean([t.noise_error[axis] ** 2 for t in fit.trials])))


def _same(one: Normal, other: Normal) -> tuple[list[int], list[int]]:
    """Where the columns that both have stand in each."""
    at = [i for i, k in enumerate(one.keys) if k in other.position]
    return at, [other.position[one.keys[i]] for i in at]


def smoothing(fit: Fit) -> float:
    """Log-likelihood [nat] that a fit gains by smoothing the reference's noise, not by explaining.

    With r the variance of the innovations, q r what that noise makes of it, and q0 r0 the same of
    the first model: -1/2 log(r (1 - q) + q0 r0) a row is the likelihood where that noise goes
    through as it did, -1/2 log r the one that was taken.
    """
    if not fit.echo:
        return 0.0
    now, rows = echo(fit), _rows(fit)
    change = {i: (e0 - now[i]) / fit.noise[i].r for i, e0 in fit.echo.items()}
    return sum(0.5 * rows[i] * float(np.log1p(max(c, -0.5))) for i, c in change.items())


def echo(fit: Fit) -> dict[int, float]:
    """What the reference's noise adds, by axis, to the variance of a fit's innovations."""
    rows, grown = _rows(fit), {}
    linears = residual_changes(fit)
    for i, noise in fit.noise.items():
        power = sum(whitened(noise, one, i) for one in linears if i in one.keys)
        grown[i] = power / max(rows[i], 1) * noise.r
    return grown


def _rows(fit: Fit) -> dict[int, int]:
    return {i: sum(len(band_time(t)) for t in fit.trials if i in t.axes) for i in fit.noise}
