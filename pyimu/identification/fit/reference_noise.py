"""The noise of a reference among the regressors (errors in variables), and what it does to them.

A reference is x + e. Every column c(x + e) meets the residual's own -J e: their product has a mean,
-J var(e) E[dc/dx] by Stein's lemma, although nothing is missing. It pulls a scale factor down, and
makes a dead zone or a lag look as if they explained something. What a draw e' of like noise changes
in residual and columns has that same product, and its sums of squares and products are taken out
again: the corrected score and likelihood (Nakamura 1990, "Corrected score function for
errors-in-variables models", Biometrika 77), the means taken over the draw.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import Linear, Stack, band_segments, band_time, in_band
from pyimu.identification.fit.doubted import doubted
from pyimu.identification.fit.fit import Fit, Last, power, whitened, whitened_power
from pyimu.identification.fit.incoherent import (
    CHANCE,
    NOTHING,
    Spectrum,
    drawn,
    of_reference,
    of_white_attitude,
    unseen_spectra,
)
from pyimu.identification.fit.noise_floor import (
    QUIET,
    WINDOW,
    beyond_own,
    lowness,
    own_noise,
    quiet,
    windows,
)
from pyimu.identification.fit.normal import DEAD, Normal, normal_equations
from pyimu.identification.fit.sample_noise import CORRELATED, THIRD, rest_noise
from pyimu.identification.fit.trial import Doubt, Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.signals import COLUMNS

LEAST = 1e-3
"""Share of the residual's variance below which the noise of a reference is left alone: what it does
to a gain is less than the scatter of that gain in a million rows."""

STEP = 0.3
"""Share of its standard deviation by which the reference is moved either way to see what changes:
slopes are limits, and the kinks of a dead zone scatter them the more the smaller the step."""

REST = 1 / 16
"""Share of the windows in which a reference is taken to be at rest, if it ever is."""

LEAST_SEEN = 0.01
"""Share of a column's power that must not be noise of the reference; of the rest there is nothing
to be seen."""

WEIGHT = 4 * CORRELATED
"""Rows that say as much of the power of third differences as one by itself would: a quarter of them
is used."""


# Drawing it


def with_reference_noise(
    fit: Fit, held: list[Trial], believed: bool = False, seed: int = 1
) -> tuple[Fit, list[Trial]]:
    """The fit and the held-out trials with a draw of their reference's noise, where there is any
    to speak of. Where that is coloured and may as well be what an effect left, it is drawn only if
    it is ``believed``, and the trials are marked as doubted else.
    """
    if any(t.reduction is not None for t in fit.trials):
        return fit, held
    linears = fit.residuals()
    variance, spectra = _variance(fit), _spectra(fit, linears)
    if not believed:
        fit, spectra = _without_doubted(fit, spectra)
    most = np.max([variance, *([s.variance for s in one] for one in spectra.values())], axis=0)
    total = np.var(np.concatenate([one.residual for one in linears]), axis=0)
    if not np.any(most > LEAST * np.maximum(total, 1e-300)):
        return fit, held
    rng = np.random.default_rng(seed)

    def draw(trial: Trial) -> Trial:
        found = _drawn(trial, variance, rng)
        return _with_spectrum(found, _spectrum_of(trial, spectra), rng)

    trials, apart = tuple(map(draw, fit.trials)), list(map(draw, held))
    coloured = any(s.coloured for each in spectra.values() for s in each)
    known = replace(fit, trials=trials, coloured=coloured).with_noise()
    return replace(known, echo=_echo(known)), apart


def drawn_again(fit: Fit, held: list[Trial], believed: bool) -> tuple[Fit, list[Trial]]:
    """The fit and the held-out trials with a new draw of their reference's noise, as what this
    model leaves has it, where the draw that they have is more than all of that on some axis: part
    of it was what an effect left that has come into the model since. Else as they are.
    """
    if not _is_outdrawn(fit):
        return fit, held
    trials = tuple(map(_without_draw, fit.trials))
    plain = replace(fit, trials=trials, echo={}, coloured=False, last=Last()).with_noise()
    return with_reference_noise(plain, list(map(_without_draw, held)), believed)


def _is_outdrawn(fit: Fit) -> bool:
    """Whether the drawn noise of the references is more than all that a model leaves."""
    if not has_noise(fit):
        return False
    drawn, left = (
        np.sum([np.sum(one.residual**2, axis=0) for one in linears], axis=0)
        for linears in (residual_changes(fit), fit.residuals())
    )
    return any(drawn[i] > left[i] for i in fit.noise)


def _without_draw(trial: Trial) -> Trial:
    return replace(trial, noise=None, noise_error=(0.0, 0.0, 0.0))


def _variance(fit: Fit) -> np.ndarray:
    """Variance (3,) in a row of the band that the high noise of derived references has, which is
    that of a white attitude: the least of what must be at least as much. Zero for others.
    """
    if all(t.band_hz is None for t in fit.trials):
        return np.zeros(3)
    return np.minimum(beyond_own(fit), [_in_quiet(fit, i) for i in range(3)])


def _in_quiet(fit: Fit, axis: int) -> float:
    """Variance in a row of the band that the reference itself shows in its quiet."""
    trials = [t for t in fit.trials if axis in t.axes and t.reference != "static"]
    own = [in_band(t, t.u[:, OWN[t.kind]][:, [axis]])[:, 0] for t in trials]
    pieces = [windows(x, band_segments(t)) for x, t in zip(own, trials, strict=True)]
    found = np.concatenate(pieces) if pieces else np.zeros((0, 1))
    return quiet(found, REST) / lowness(found, REST) if len(found) else 0.0


def _drawn(trial: Trial, variance: np.ndarray, rng: np.random.Generator) -> Trial:
    """The trial with a draw (n, 3) of what white noise of an attitude, or of a position, becomes
    once it is differentiated, of a ``variance`` (3,) in its band.

    It is no more than the high differences of the reference show: its band hides from the sensor
    what is left beyond.
    """
    if trial.band_hz is None:
        return replace(trial, noise=np.zeros(trial.y.shape))
    draw = rng.standard_normal(trial.y.shape)
    for _ in range(trial.derivatives):
        draw = np.gradient(draw, axis=0)
    draw = draw if trial.place is None else trial.place.below(draw, trial.segments)
    seen = in_band(trial, draw).var(axis=0) if trial.count else np.ones(3)
    wanted = np.isin(np.arange(3), trial.axes) & (seen > 0.0)
    scale = np.sqrt(np.where(wanted, variance / np.where(seen > 0.0, seen, 1.0), 0.0))
    most = _high(trial, trial.u[:, OWN[trial.kind]]) / np.maximum(_high(trial, draw), 1e-300)
    return replace(trial, noise=draw * np.minimum(scale, most))


def _spectra(fit: Fit, linears: Sequence[Linear]) -> dict[str, list[Spectrum]]:
    """Spectra (3,) of the noise of references, by the names of their trials."""
    own = own_noise(fit)
    found = {
        t.name: _of_direct(t, one, own) if t.band_hz is None else unseen_spectra(t, one, own)
        for t, one in zip(fit.trials, linears, strict=True)
        if t.reference != "static"
    }
    return {name: [by.get(i, NOTHING) for i in range(3)] for name, by in found.items()}


def _of_direct(trial: Trial, one: Linear, own: Mapping[int, RandomWalk]) -> dict[int, Spectrum]:
    """The noise by axis of a reference that is no derivative; what the sensor has beyond its
    ``own`` declared noise is not the reference's.
    """
    seen, high = np.square(rest_noise(trial)), 2.0 * trial.h * _white(trial)
    known = {i: replace(n, r=max(n.r, float(seen[i]))) for i, n in own.items()}
    error = float(np.sqrt(2.0 * WEIGHT / len(one.time)))
    found = {
        i: of_reference(s, float(high[i]), error)
        for i, s in unseen_spectra(trial, one, known).items()
    }
    return doubted(found)


def _without_doubted(
    fit: Fit, spectra: Mapping[str, list[Spectrum]]
) -> tuple[Fit, dict[str, list[Spectrum]]]:
    """The fit with the doubts of its trials, and the spectra less what is doubted."""
    kept = {n: [NOTHING if s.doubt else s for s in each] for n, each in spectra.items()}
    doubts = {n: max(s.doubt for s in each) for n, each in spectra.items()}
    trials = tuple(replace(t, doubt=doubts.get(t.name, Doubt.NONE)) for t in fit.trials)
    return (replace(fit, trials=trials) if any(doubts.values()) else fit), kept


def _spectrum_of(trial: Trial, spectra: Mapping[str, list[Spectrum]]) -> Sequence[Spectrum]:
    """The spectra of a trial's reference: its own, else, where it is no derivative, those of the
    first fitted log.
    """
    name = trial.parent or trial.name
    if name in spectra or trial.band_hz is not None or trial.reference == "static":
        return spectra.get(name, ())
    return next(iter(spectra.values()), ())


def _with_spectrum(trial: Trial, spectra: Sequence[Spectrum], rng: np.random.Generator) -> Trial:
    """The trial with what its noise has by its spectrum beside what it was drawn with."""
    if not any(len(s.psd) for s in spectra):
        return trial
    noise = np.array(trial.noise)
    for i, spectrum in enumerate(spectra):
        if not len(spectrum.psd):
            continue
        more = spectrum.beyond(of_white_attitude(trial, spectrum.frequency, noise[:, i].var()))
        if more.any():
            noise[:, i] += drawn(trial, spectrum.frequency, more, rng)
    errors = tuple(s.error if s.variance > 0.0 else 0.0 for s in spectra)
    return replace(trial, noise=noise, noise_error=errors)


def _white(trial: Trial) -> np.ndarray:
    """Variance (3,) of white noise that a reference shows itself, by its high differences."""
    rough = _third_differences(trial, trial.u[:, OWN[trial.kind]])
    each = [quiet(w) / lowness(w) / THIRD if len(w) else 0.0 for w in rough]
    return np.where(np.isin(np.arange(3), trial.axes), each, 0.0)


def _high(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Root mean square (3,) of third differences of values (n, 3), in their quietest quarter."""
    rough = _third_differences(trial, values)
    return np.nan_to_num([np.sqrt(quiet(w)) if len(w) else 0.0 for w in rough])


def sensor_white(trial: Trial, left: np.ndarray) -> np.ndarray:
    """Variance (3,) of white noise that the sensor shows where a model leaves ``left`` (n, 3).

    High differences of sensor and residual have the sensor's noise in common, and neither the
    motion nor the reference's noise. The windows are those in which the reference is quiet: taken
    by the sensor's own quiet they would be quieter than it is.
    """
    by_reference, seen, rest = (
        _third_differences(trial, v) for v in (trial.u[:, OWN[trial.kind]], trial.y, left)
    )
    each = [
        _common(*pieces) / THIRD if len(pieces[0]) else 0.0
        for pieces in zip(by_reference, seen, rest, strict=True)
    ]
    return np.where(np.isin(np.arange(3), trial.axes), np.maximum(each, 0.0), 0.0)


def _common(by: np.ndarray, one: np.ndarray, other: np.ndarray) -> float:
    """Mean product of two signals' windows (k, m) where a third is quiet."""
    calm = np.argsort(by.var(axis=1))[: max(1, int(len(by) * QUIET))]
    return float(np.mean(one[calm] * other[calm]))


def _third_differences(trial: Trial, values: np.ndarray) -> list[np.ndarray]:
    """Windows of the third differences of values (n, 3), by axis."""
    pieces = [np.diff(values[a:b], n=3, axis=0) for a, b in trial.segments]
    none = [np.zeros((0, WINDOW))]
    return [
        np.concatenate(none + [windows(p[:, i], [(0, len(p))]) for p in pieces]) for i in range(3)
    ]


# Taking it out


def moved(trial: Trial, sign: int) -> Trial:
    """The trial with its reference moved by ``STEP`` of its noise."""
    if trial.noise is None:
        return trial
    u, more = np.array(trial.u), sign * STEP * trial.noise
    u[:, OWN[trial.kind]] += more
    for a, b in trial.segments:
        if b - a > 1:
            rate = np.gradient(more[a:b], trial.time[a:b], axis=0)
            u[a:b, COLUMNS[KINDS[trial.kind].own_rate]] += rate
    return replace(trial, u=u)


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
    if not fit.last.changes:
        fit.last.changes = changes(beside_moved(fit), linearised)
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
        score[:, at] -= noise.batch_score[:, own]
        here, there = np.ix_(at, at), np.ix_(own, own)
        for one, part in zip(gram, noise.batch_gram, strict=True):
            one[here] -= part[there]
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
    echo, rows = _echo(fit), _rows(fit)
    change = {i: (e0 - echo[i]) / fit.noise[i].r for i, e0 in fit.echo.items()}
    return sum(0.5 * rows[i] * float(np.log1p(max(c, -0.5))) for i, c in change.items())


def _echo(fit: Fit) -> dict[int, float]:
    """What the reference's noise adds, by axis, to the variance of a fit's innovations."""
    rows, grown = _rows(fit), {}
    linears = residual_changes(fit)
    for i, noise in fit.noise.items():
        power = sum(whitened(noise, one, i) for one in linears if i in one.keys)
        grown[i] = power / max(rows[i], 1) * noise.r
    return grown


def _rows(fit: Fit) -> dict[int, int]:
    return {i: sum(len(band_time(t)) for t in fit.trials if i in t.axes) for i in fit.noise}
