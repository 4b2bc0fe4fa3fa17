"""What speaks against a chosen candidate: fitted and held-out rows together, axis by axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pyimu.identification.fit.columns import Linear, band_time, in_band, linearise, residual
from pyimu.identification.fit.errors_in_variables import STEP, has_noise, moved, residual_changes
from pyimu.identification.fit.fit import Fit, bare, squares, whitened
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import LogClock
from pyimu.identification.fit.left_out import left_out
from pyimu.identification.fit.maximum_likelihood import wander_is_declared
from pyimu.identification.fit.noise_fit import declared_variances
from pyimu.identification.fit.noise_floor import own_noise, reference_variance
from pyimu.identification.fit.normal import BATCHES, Noise
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import WALKS
from pyimu.identification.search.leftover import axis_likelihood
from pyimu.identification.search.strayed import strayed
from pyimu.numerics.laws import chi2

SPEAKS = 0.5
"""Log-likelihood [nat] by which two models must differ on held-out rows for these to decide."""

CHANCE = 3.0
"""Standard errors by which held-out squares must be more than a true effect would leave."""

DECLARED = 4.0
"""The same where the part declares its noise, so that nothing that was taken for noise makes the
errors small: of the hundreds of looks that a campaign takes none comes there by chance."""

BORNE_OUT = 0.5
"""Share of its own difference that a true effect gains on held-out rows, all of it on the average,
at least: one that is not there loses as much."""

PLAINLY = 0.02
"""Share by which a held-out residual must rise to be more than a motion that weighs noise
otherwise."""

POSSIBLE = 2.0
"""Log-likelihood [nat] that a size of the random walk may lack: two standard errors."""

LIMITS = 13
"""Sizes of the walk that are tried, over four decades of its variance."""

LEAST_OF_EXCESS = float(chi2.isf(1e-4, 1)) / BATCHES
"""Share of what is left above the noise of sensor and reference that an effect must explain.

What neither accounts for has a cause that nobody knows, and a form. Where it is spread over the
batches of a log it looks, once in a hundred, like so much of the best of some hundred columns."""


@dataclass(frozen=True)
class Evidence:
    """What old and new model leave, by axis (3,).

    ``gained`` is the log-likelihood [nat] that held-out rows gain, ``difference`` by how much the
    models differ on them; ``apart`` is the sum of squares of what is between the two, and
    ``chance`` the variance of its product with the noise; ``held`` (2, 3) and ``whole`` (2, 3) are
    sums of squares, old and new, of the held-out rows and of all, less what the noise of references
    makes of them, ``plain`` (2, 3) those of the held-out rows as they are; ``noise`` (3,) is what
    the noise of sensor and reference leaves of ``whole``, None where only the residual itself tells
    of it.
    ``unsure`` (3,) are standard errors of ``noise`` and of what was taken off of references'.
    ``strays`` are mean and variance of what ``held`` falls less because the new model's
    coefficients are known only so well; beyond so many standard errors as ``chance_ends`` a rise is
    none by chance.
    """

    gained: np.ndarray
    difference: np.ndarray
    apart: np.ndarray
    chance: np.ndarray
    held: np.ndarray
    plain: np.ndarray
    whole: np.ndarray
    noise: np.ndarray | None
    unsure: np.ndarray = field(default_factory=lambda: np.zeros(3))
    strays: tuple[float, float] = (0.0, 0.0)
    chance_ends: float = CHANCE

    @property
    def speaks(self) -> bool:
        return float(self.difference.sum()) >= SPEAKS

    @property
    def rise(self) -> float:
        """Relative rise of the held-out RMS error; negative where it falls. As it stands where less
        than nothing is left of it once the noise of the reference is taken off.
        """
        return _rise(self.held if min(self.held.sum(axis=1)) > 0.0 else self.plain)

    @property
    def surprise(self) -> float:
        """Standard errors by which the held-out sum of squares is larger than a true new model
        would leave it: old less new is then the square of what is between them, less twice its
        product with the noise.
        """
        old, new = self.held.sum(axis=1)
        mean, variance = self.strays
        missing = float(self.apart.sum()) - (old - new) - mean
        chance = float(np.sqrt(4.0 * self.chance.sum() + variance))
        return missing / chance if chance > 0.0 else np.inf

    @property
    def bears_out(self) -> bool:
        """Whether held-out rows gain, by the sensor's own noise, nearer to what a true effect gains
        than to nothing; a sum of squares is mostly of slow noise, which that noise weighs.
        """
        return self.noise is None and self.gained.sum() > BORNE_OUT * self.difference.sum()

    @property
    def raises(self) -> bool:
        """Whether the held-out error rises by more than chance, and the rows do not bear out what
        raises it.
        """
        rises = self.rise > 0.0 and self.surprise > self.chance_ends
        return (self.speaks and rises and not self.bears_out) or self.plainly_raises

    @property
    def plainly_raises(self) -> bool:
        """Whether the held-out residual itself rises beside a reference whose noise was drawn: that
        may be more than there is, and what is left once it is taken off less than nothing.
        """
        return self.noise is not None and self.speaks and _rise(self.plain) > PLAINLY

    @property
    def worse(self) -> float:
        """Relative rise of the held-out RMS error for which a model is refused."""
        return _rise(self.plain) if self.plainly_raises else self.rise

    @property
    def is_little(self) -> bool:
        """Whether so little is explained that something unknown may look like it."""
        return self.share < LEAST_OF_EXCESS

    @property
    def share(self) -> float:
        """The largest share on any axis of what was left above the noise that is explained.

        Without end where nothing was left above it that its standard error does not account for.
        Such a sum may be negative, too: of what is left the draw of a reference's noise is taken
        off, which is as large as that on the average.
        """
        if self.noise is None:
            return np.inf
        above = self.whole[0] - self.noise
        sure = above > CHANCE * self.unsure
        if not sure.any():
            return np.inf
        shares = (self.whole[0] - self.whole[1]) / np.where(sure, above, 1e-300)
        return float(np.max(shares[self.whole[0] != 0.0], initial=0.0))


def _rise(sums: np.ndarray) -> float:
    """Relative rise of the root of sums of squares (2, 3), old and new."""
    old, new = sums.sum(axis=1)
    return float(np.sqrt(new / old)) - 1.0 if old > 0.0 else 0.0


def evidence(old: Fit, new: Fit, held: Sequence[Trial]) -> Evidence:
    """The evidence of all rows for ``new`` over ``old``, judged with the noise of ``new``, or the
    largest walk that it leaves possible.
    """
    sums = {name: np.zeros(3) for name in ("gained", "difference", "apart", "chance")}
    wander = _wandering_most(new, old)
    held_out, plain = np.zeros((2, 3)), np.zeros((2, 3))
    for trial in held:
        if trial.reduction is not None:
            was, now = left_out(old, trial), left_out(new, trial)
            sums["gained"][0] += now.log_likelihood - was.log_likelihood
            between = was.error - now.error
            sums["difference"][0] += 0.5 * float(np.nansum(between**2 / now.variance))
            held_out[:, 0] += [np.nansum(was.error**2), np.nansum(now.error**2)]
            sums["apart"][0] += float(np.nansum(between**2))
            sums["chance"][0] += float(np.nansum(between**2 * now.variance))
            continue
        (state_old, rest), (state_new, _) = held_state(old, trial), held_state(new, trial)
        pairs = ((old.sensor, state_old), (new.sensor, state_new))
        there = _on_held_out(wander, trial, rest)
        drift = _drift(there, rest, state_new)
        for sign, rows in _rows(rest, pairs):
            first, second = (drift.taken_from(bare(rest, r)) for r in rows)
            rows = (first.residual, second.residual)
            between = bare(rest, rows[1] - rows[0])
            powers = [_whitened(there, rest, one) for one in (first, second, between)]
            sums["gained"] += sign * 0.5 * (powers[0] - powers[1])
            sums["difference"] += sign * 0.5 * powers[2]
            # Of an axis that the reference does not know the motion is left.
            known = np.isin(np.arange(3), rest.axes)
            left = np.array([known * np.sum(r**2, axis=0) for r in rows])
            held_out += sign * left
            plain += left if sign > 0 else 0.0
            sums["apart"] += sign * np.sum(between.residual**2, axis=0)
            if sign > 0:
                sums["chance"] += _chance(there, between)
    if any(t.reduction is not None for t in held):
        return Evidence(**sums, held=held_out, plain=held_out, whole=held_out, noise=None)
    fitted = np.array([_squares(f) for f in (old, new)])
    both = {"held": held_out, "plain": plain, "whole": held_out + fitted}
    ends = DECLARED if wander_is_declared(new) else CHANCE
    noise, unsure = _noise(new, held), _unsure(new, held)
    found = Evidence(**sums, **both, noise=noise, unsure=unsure, chance_ends=ends)
    return replace(found, strays=strayed(old, new, held)) if found.raises else found


def _wandering_most(new: Fit, old: Fit) -> Fit:
    """The new model with as large a random walk as the data leave possible, up to that of the old
    one, where nobody declared it: an effect that takes a walk's place leaves the smallest.
    """
    _, walk = declared_variances(new.sensor, new.trials[0].h)
    residuals, noise = new.residuals(), dict(new.noise)
    for i, least in new.noise.items():
        most = old.noise[i]
        if not all(isinstance(n, WALKS) for n in (least, most)) or walk[i]:
            continue
        if most.k2 > least.k2:
            tried = [replace(least, k2=k2) for k2 in np.geomspace(most.k2 * 1e-4, most.k2, LIMITS)]
            best = axis_likelihood(residuals, i, least)
            seen = [n for n in tried if axis_likelihood(residuals, i, n) > best - POSSIBLE]
            noise[i] = max([least, *seen], key=lambda n: n.k2)
    return replace(new, noise=noise)


def _on_held_out(fit: Fit, held: Trial, rest: Trial) -> Fit:
    """The model with its noise as it is on held-out rows.

    Their bias is the mean over the rows before them, from which a walk differs at their begin by as
    much as it walks in a third of the time; or over those before and after, each in proportion to
    its time, the second being further off by the time between.
    """
    first = held
    if held.parent is not None:
        first = next(t for t in fit.trials if t.name == held.parent)
    before = 0.0
    if len(rest.time):
        early = float(rest.time[0] - first.time[0])
        late = max(float(first.time[-1] - rest.time[-1]), 0.0) if first is not held else 0.0
        share = late / max(early + late, 1e-300)
        between = float(rest.time[-1] - rest.time[0])
        before = (1 - share) ** 2 * early / 3.0 + share**2 * (between + late / 3.0)
    noise = {
        i: replace(n, before=before) if isinstance(n, WALKS) else n for i, n in fit.noise.items()
    }
    return replace(fit, noise=noise)


@dataclass(frozen=True)
class _Drift:
    """What a drift of a log's clock changes in held-out rows (m, 3), by its standard error on the
    fitted rows, and the ``noise`` of a fit.
    """

    noise: Noise
    change: Linear | None = None

    def taken_from(self, one: Linear) -> Linear:
        """A residual whose square, once whitened, is what is left where the drift is as likely
        another as its variance has it.

        With v the whitened change, r'r - (v'r)^2 / (1 + v'v) is the square of
        r - (1 - 1 / sqrt(1 + v'v)) v (v'r) / (v'v).
        """
        v = self.change
        if v is None:
            return one
        axes = [i for i in one.keys if i in self.noise]
        own = sum(whitened(self.noise[i], v, i) for i in axes)
        if own <= 0.0:
            return one
        both = replace(v, residual=v.residual + one.residual)
        sums = [whitened(self.noise[i], w, i) for i in axes for w in (both, one)]
        product = 0.5 * (sum(sums[0::2]) - sum(sums[1::2]) - own)
        share = 1.0 - 1.0 / np.sqrt(1.0 + own)
        return replace(one, residual=one.residual - share * product / own * v.residual)


def _drift(fit: Fit, rest: Trial, state: LogState) -> _Drift:
    """The drift of the clock of a log whose end is held out: it is carried on to there from the
    fitted rows, and an effect that makes a sensor late is known no better.
    """
    key = LogClock(rest.name, 1)
    std = fit.std.get(key)
    if rest.parent is None or state.clock is None or std is None or not np.isfinite(std):
        return _Drift(fit.noise)
    one = linearise(fit.sensor, rest, state, ())
    change = np.zeros_like(one.residual)
    for i, keys in one.keys.items():
        for k, column in zip(keys, one.columns[i].arrays, strict=True):
            if k == key:
                change[:, i] = std * column
    return _Drift(fit.noise, bare(rest, change))


def _chance(fit: Fit, one: Linear) -> np.ndarray:
    """Variance (3,) of the product of a fit's noise with the rows of a residual."""
    out = np.zeros(3)
    for i, noise in fit.noise.items():
        if i in one.keys:
            out[i] = noise.variance_along(one.residual[:, i], one.time, one.segments)
    return out


def _rows(rest: Trial, pairs):
    """The residuals (m, 3) of sensors with their states, and with -1 as the sign what the noise of
    the reference makes of them.
    """

    def left(trial: Trial) -> list[np.ndarray]:
        return [in_band(trial, residual(sensor, trial, state)) for sensor, state in pairs]

    yield 1, left(rest)
    if rest.noise is not None:
        up, down = (left(moved(rest, sign)) for sign in (1, -1))
        yield -1, [(a - b) / (2 * STEP) for a, b in zip(up, down, strict=True)]


def _whitened(fit: Fit, trial: Trial, one: Linear) -> np.ndarray:
    """Sums of squares (3,) of a residual whitened by the noise of a fit."""
    seen = [whitened(fit.noise[i], one, i) if i in trial.axes else 0.0 for i in range(3)]
    return np.array(seen)


def _squares(fit: Fit) -> np.ndarray:
    """Sums of squares (3,) on fitted rows, as a reference without noise would leave them."""
    seen = squares(fit.residuals())
    if not has_noise(fit):
        return seen
    return seen - squares(residual_changes(fit))


def _noise(fit: Fit, held: Sequence[Trial]) -> np.ndarray | None:
    """Sum of squares (3,) over fitted and held-out rows that sensor and reference account for.

    None where a reference was not derived: the noise is fitted to the residual itself then.
    """
    if any(t.band_hz is None for t in fit.trials):
        return None
    own, out = own_noise(fit), np.zeros(3)
    # The echo of a reference's noise is taken out of the sums already.
    for t in (*fit.trials, *held):
        reference = np.zeros(3) if fit.echo else reference_variance(fit, t.name)
        rows, share = len(band_time(t)), float(np.sum(np.square(t.band.weights)))
        for i in t.axes:
            out[i] += rows * (own[i].r * share + reference[i])
    return out


def _unsure(fit: Fit, held: Sequence[Trial]) -> np.ndarray:
    """Standard errors (3,) of the sum of squares, over fitted and held-out rows, that was drawn of
    the noise of references.
    """
    if not has_noise(fit):
        return np.zeros(3)
    rows = [sum(len(band_time(t)) for t in some) for some in (fit.trials, held)]
    errors = np.mean([t.noise_error for t in fit.trials], axis=0)
    drawn = squares(residual_changes(fit)) * (1.0 + rows[1] / max(rows[0], 1))
    return np.where(np.isfinite(errors), errors, 0.0) * drawn
