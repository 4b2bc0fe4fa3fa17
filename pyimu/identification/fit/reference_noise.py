"""The noise of a reference among the regressors (errors in variables), and what it does to them.

A reference is x + e. Every column c(x + e) meets the residual's own -J e: their product has a mean,
-J var(e) E[dc/dx] by Stein's lemma, although nothing is missing. It pulls a scale factor down, and
makes a dead zone or a lag look as if they explained something. What a draw e' of like noise changes
in residual and columns has that same product, and its sums of squares and products are taken out
again: the corrected score and likelihood (Nakamura 1990, "Corrected score function for
errors-in-variables models", Biometrika 77), the means taken over the draw.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.signal import lfilter

from pyimu.identification.fit.columns import Linear, Stack, band_segments, band_time, in_band
from pyimu.identification.fit.fit import Fit, Last, power
from pyimu.identification.fit.incoherent import (
    NOTHING,
    Spectrum,
    drawn,
    of_white_attitude,
    unseen_spectrum,
)
from pyimu.identification.fit.noise_floor import (
    LAGS,
    QUIET,
    beyond_own,
    colour,
    lowness,
    own_noise,
    quiet,
    quietest,
    windows,
)
from pyimu.identification.fit.normal import Normal, normal_equations
from pyimu.identification.fit.trial import Trial
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.signals import COLUMNS

LEAST = 1e-3
"""Share of the residual's variance below which the noise of a reference is left alone: what it does
to a gain is less than the scatter of that gain in a million rows."""

STEP = 0.3
"""Share of its standard deviation by which the reference is moved either way to see what changes:
slopes are limits, and the kinks of a dead zone scatter them the more the smaller the step."""

MOST_ROWS = 20000
"""Rows of a log in which the residual is compared with what the sensor shows."""

REST = 1 / 16
"""Share of the windows in which a reference is taken to be at rest, if it ever is."""

LEAST_SEEN = 0.01
"""Share of a column's power that must not be noise of the reference; of the rest there is nothing
to be seen."""

SMOOTH = 1e-3
"""Share of white noise's third differences below which what a reference shows in its quiet is a
slow motion: noise that ends at a tenth of the sample rate has more, motion that ends at a thirtieth
less."""

CHANCE = 4.0
"""Standard errors by which a variance may be more than it seems."""

CORRELATED = 0.2
"""Size of a coefficient of the autoregression from which on noise is not white: six standard errors
in a thousand rows."""


# Drawing it


def with_reference_noise(fit: Fit, held: list[Trial], seed: int = 1) -> tuple[Fit, list[Trial]]:
    """The fit and the held-out trials with a draw of their reference's noise, where there is any
    to speak of.
    """
    if any(t.reduction is not None for t in fit.trials):
        return fit, held
    linears = fit.residuals()
    variance = _variance(fit, linears)
    slow = _slow(fit, linears)
    most = np.max([variance, *([s.variance for s in one] for one in slow.values())], axis=0)
    total = np.var(np.concatenate([one.residual for one in linears]), axis=0)
    if not np.any(most > LEAST * np.maximum(total, 1e-300)):
        return fit, held
    rng, shape = np.random.default_rng(seed), _shape(fit, linears)

    def draw(trial: Trial) -> Trial:
        found = _drawn(trial, variance, shape, rng)
        return _with_slow(found, slow.get(trial.parent or trial.name, ()), rng)

    trials, apart = tuple(map(draw, fit.trials)), list(map(draw, held))
    known = replace(fit, trials=trials, coloured=bool(shape)).with_noise()
    return replace(known, echo=_echo(known)), apart


def _variance(fit: Fit, linears: Sequence[Linear]) -> np.ndarray:
    """Variance (3,) in a row of the band that the noise of the reference has.

    It is the least of what must be at least as much. A rate shows it by itself in its quiet; what
    the residual has beyond the sensor's own noise is the difference of two large numbers then, and
    speaks only where that quiet is more than it may be by chance.
    """
    beyond, seen = beyond_own(fit), np.array([_in_quiet(fit, i) for i in range(3)])
    if all(t.band_hz is None for t in fit.trials):
        rough = np.mean([_high(t, t.u[:, OWN[t.kind]]) ** 2 / 20 for t in fit.trials], axis=0)
        beyond = np.where(seen <= beyond_own(fit, CHANCE), seen, beyond)
        beyond = np.where(rough > SMOOTH * beyond, beyond, 0.0)
    return np.minimum.reduce([beyond, seen, _unseen(fit, linears)])


def _in_quiet(fit: Fit, axis: int) -> float:
    """Variance in a row of the band that the reference itself shows in its quiet."""
    trials = [t for t in fit.trials if axis in t.axes and t.reference != "static"]
    own = [in_band(t, t.u[:, OWN[t.kind]][:, [axis]])[:, 0] for t in trials]
    pieces = [windows(x, band_segments(t)) for x, t in zip(own, trials, strict=True)]
    found = np.concatenate(pieces) if pieces else np.zeros((0, 1))
    return quiet(found, REST) / lowness(found, REST) if len(found) else 0.0


def _unseen(fit: Fit, linears: Sequence[Linear]) -> np.ndarray:
    """Variance (3,) of a residual that the sensor from ``LAGS`` rows before to ``LAGS`` after does
    not show: it shows what an effect leaves, and nothing of the noise of its reference.

    Infinite where a band lies between the two.
    """
    left, rows = np.zeros(3), np.zeros(3)
    for t, one in zip(fit.trials, linears, strict=True):
        if t.band_hz is not None:
            return np.full(3, np.inf)
        axes, measured = list(t.axes), in_band(t, t.y[:, list(t.axes)])
        for a, b in one.segments:
            b = min(b, a + MOST_ROWS)
            if b - a > 40 * LAGS:
                around = sliding_window_view(measured[a:b], 2 * LAGS + 1, axis=0)
                columns = np.column_stack([np.ones(len(around)), around.reshape(len(around), -1)])
                r = one.residual[a + LAGS : b - LAGS, axes]
                rest = r - columns @ np.linalg.lstsq(columns, r)[0]
                left[axes] += np.sum(rest**2, axis=0)
                rows[axes] += len(r) - columns.shape[1]
    return np.where(rows > 0, left / np.maximum(rows, 1), np.inf)


def _shape(fit: Fit, linears: Sequence[Linear]) -> tuple[float, ...]:
    """Coefficients of an autoregression like what is left in the quiet against a reference that is
    no derivative; none where that is white.
    """
    if any(t.band_hz is not None for t in fit.trials):
        return ()
    pieces = [windows(one.residual[:, i], one.segments) for one in linears for i in one.keys]
    found = colour(np.concatenate([quietest(p, QUIET) for p in pieces]))
    return found if np.any(np.abs(found) > CORRELATED) else ()


def _drawn(
    trial: Trial, variance: np.ndarray, shape: tuple[float, ...], rng: np.random.Generator
) -> Trial:
    """The trial with a draw (n, 3) of noise that has a ``variance`` (3,) in its band.

    White, of the ``shape`` of an autoregression, or as a white attitude has it once it is
    differentiated.

    A derivative has no more of it than its high differences show: its band hides from the sensor
    what is left beyond.
    """
    draw = rng.standard_normal(trial.y.shape)
    if trial.band_hz is not None:
        draw = np.gradient(draw, axis=0)
    draw = lfilter([1.0], [1.0, *(-c for c in shape)], draw, axis=0)
    seen = in_band(trial, draw).var(axis=0) if trial.count else np.ones(3)
    wanted = np.isin(np.arange(3), trial.axes) & (seen > 0.0)
    scale = np.sqrt(np.where(wanted, variance / np.where(seen > 0.0, seen, 1.0), 0.0))
    if trial.band_hz is None:
        return replace(trial, noise=draw * scale)
    most = _high(trial, trial.u[:, OWN[trial.kind]]) / np.maximum(_high(trial, draw), 1e-300)
    return replace(trial, noise=draw * np.minimum(scale, most))


def _slow(fit: Fit, linears: Sequence[Linear]) -> dict[str, list[Spectrum]]:
    """Spectra (3,) of the noise of derived references, by the names of their trials."""
    own = own_noise(fit)
    return {
        t.name: [unseen_spectrum(t, one, i, own[i]) if i in one.keys else NOTHING for i in range(3)]
        for t, one in zip(fit.trials, linears, strict=True)
        if t.band_hz is not None
    }


def _with_slow(trial: Trial, spectra: Sequence[Spectrum], rng: np.random.Generator) -> Trial:
    """The trial with what its noise has at low frequencies beside the high ones."""
    if not any(len(s.psd) for s in spectra):
        return trial
    noise = np.array(trial.noise)
    for i, spectrum in enumerate(spectra):
        if not len(spectrum.psd):
            continue
        more = spectrum.beyond(of_white_attitude(trial, spectrum.frequency, noise[:, i].var()))
        if more.any():
            noise[:, i] += drawn(trial, spectrum.frequency, more, rng)
    return replace(trial, noise=noise, noise_error=tuple(s.error for s in spectra))


def _high(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Root mean square (3,) of third differences of values (n, 3), in their quietest quarter."""
    pieces = [np.diff(values[a:b], n=3, axis=0) for a, b in trial.segments]
    out = np.zeros(3)
    for i in range(3):
        short = [windows(p[:, i], [(0, len(p))]) for p in pieces]
        kept = np.concatenate(short) if short else np.zeros((0, 1))
        out[i] = np.sqrt(quiet(kept)) if len(kept) else np.nan
    return np.nan_to_num(out)


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


def changes(fit: Fit, linearised: Callable[[Fit], list[Linear]]) -> list[Linear]:
    """What the noise of the reference makes of each trial's residual and columns."""
    up, down = (
        linearised(replace(fit, trials=tuple(moved(t, sign) for t in fit.trials), last=Last()))
        for sign in (1, -1)
    )
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


def equations(fit: Fit, linearised: Callable[[Fit], list[Linear]] = Fit.linearise) -> Normal:
    """Normal equations of a fit's columns as a reference without noise would have them."""
    found = normal_equations(linearised(fit), fit.noise)
    if not has_noise(fit):
        return found
    changed, seen = changes(fit, linearised), found.gram
    gram, score, power = found.batch_gram, found.batch_score, found.power
    doubt, unknown = np.zeros((len(fit.noise), len(seen))), np.zeros(len(seen))
    for row, axis in zip(doubt, fit.noise, strict=True):
        noise = normal_equations([_of_axis(one, axis) for one in changed], fit.noise)
        at, own = _same(found, noise)
        error = _error(fit, axis)
        row[at] = error * noise.score[own]
        unknown[at] += error * np.diag(noise.gram)[own]
        # Gram matrices by batch are large: they are taken off where they stand.
        score[:, at] -= noise.batch_score[:, own]
        for whole, part in zip(gram, noise.batch_gram, strict=True):
            whole[np.ix_(at, at)] -= part[np.ix_(own, own)]
        power -= noise.power
    whole = np.diag(gram.sum(axis=0))
    hidden = whole <= np.maximum(LEAST_SEEN * np.diag(seen), CHANCE * unknown)
    score[:, hidden] = gram[:, hidden] = gram[:, :, hidden] = doubt[:, hidden] = 0.0
    return Normal(found.keys, gram, score, power, found.rows, found.log_det, seen, doubt)


def power_without_noise(fit: Fit) -> float:
    """Sum of squares of the whitened residual as a reference without noise would have it."""
    noise = changes(fit, Fit.residuals)
    return power(fit) - sum(whitened(fit.noise[i], one, i) for one in noise for i in one.keys)


def _of_axis(one: Linear, axis: int) -> Linear:
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
    linears = changes(fit, Fit.residuals)
    for i, noise in fit.noise.items():
        power = sum(whitened(noise, one, i) for one in linears if i in one.keys)
        grown[i] = power / max(rows[i], 1) * noise.r
    return grown


def _rows(fit: Fit) -> dict[int, int]:
    return {i: sum(len(band_time(t)) for t in fit.trials if i in t.axes) for i in fit.noise}


def whitened(noise, one: Linear, axis: int) -> float:
    """Sum of squares of a residual, whitened."""
    r = one.residual[:, axis : axis + 1]
    return float(np.sum(noise.whiten(r, one.time, one.segments) ** 2))
