"""The noise of a reference, as what is left against it and the reference itself show it, drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import Linear, band_segments, in_band
from pyimu.identification.fit.doubted import doubted
from pyimu.identification.fit.errors_in_variables import echo, has_noise, residual_changes
from pyimu.identification.fit.fit import Fit, Last, squares
from pyimu.identification.fit.high_differences import (
    WEIGHT,
    differences,
    roughness,
    white_of,
    white_of_reference,
)
from pyimu.identification.fit.incoherent import (
    NOTHING,
    Spectrum,
    drawn,
    in_rows,
    of_reference,
    of_white_attitude,
    unseen_spectra,
)
from pyimu.identification.fit.noise_floor import beyond_own, lowness, own_noise, quiet, windows
from pyimu.identification.fit.response import power_through_dynamics
from pyimu.identification.fit.sample_noise import rest_noise
from pyimu.identification.fit.standing import all_noise, standing
from pyimu.identification.fit.trial import MEASURED, Doubt, Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.reference.filters import below_hz

LEAST = 1e-3
"""Share of the residual's variance below which the noise of a reference is left alone: what it does
to a gain is less than the scatter of that gain in a million rows."""

REST = 1 / 16
"""Share of the windows in which a reference is taken to be at rest, if it ever is."""

LEAST_THROUGH = 0.01
"""Share of its power from which on noise that went through dynamics is told from nothing."""


def with_reference_noise(
    fit: Fit, held: list[Trial], believed: bool = False, seed: int = 1
) -> tuple[Fit, list[Trial]]:
    """The fit and the held-out trials with a draw of their reference's noise, where there is any
    to speak of. Where that is coloured and may as well be what an effect left, it is drawn only if
    it is ``believed``, and the trials are marked as doubted else.
    """
    if fit.is_reduced:
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
        found, white = _drawn(trial, variance, rng)
        return _with_turn(_with_spectrum(found, _spectrum_of(trial, spectra), white, rng))

    trials, apart = tuple(map(draw, fit.trials)), list(map(draw, held))
    if fit.free:
        trials, apart = _as_the_reference_has_it(replace(fit, trials=trials, last=Last()), apart)
    coloured = any(s.coloured for each in spectra.values() for s in each)
    known = replace(fit, trials=trials, coloured=coloured).with_noise()
    return replace(known, echo=echo(known)), apart


def drawn_again(fit: Fit, held: list[Trial], believed: bool) -> tuple[Fit, list[Trial]]:
    """The fit and the held-out trials with a new draw of their reference's noise, as what this
    model leaves has it, where the draw that they have is more than all of that on some axis: part
    of it was what an effect left that has come into the model since. Else as they are.
    """
    if not _is_outdrawn(fit):
        return fit, held
    return drawn_anew(fit, held, believed)


def drawn_anew(fit: Fit, held: list[Trial], believed: bool) -> tuple[Fit, list[Trial]]:
    """The fit and the held-out trials with a new draw of their reference's noise, as what this
    model leaves has it.
    """
    return with_reference_noise(undrawn(fit), list(map(_without_draw, held)), believed)


def undrawn(fit: Fit) -> Fit:
    """The model beside its references as they are."""
    trials = tuple(map(_without_draw, fit.trials))
    return replace(fit, trials=trials, echo={}, coloured=False, last=Last()).with_noise()


def _is_outdrawn(fit: Fit) -> bool:
    """Whether the drawn noise of the references is more than all that a model leaves."""
    if not has_noise(fit):
        return False
    drawn, left = map(squares, (residual_changes(fit), fit.residuals()))
    return any(drawn[i] > left[i] for i in fit.noise)


def _without_draw(trial: Trial) -> Trial:
    return replace(trial, noise=None, noise_error=(0.0, 0.0, 0.0))


def _variance(fit: Fit) -> np.ndarray:
    """Variance (3,) in a row of the band that the high noise of derived references has, which is
    that of a white attitude: the least of what must be at least as much. Zero for others.
    """
    if not any(map(_is_derived, fit.trials)):
        return np.zeros(3)
    return np.minimum(beyond_own(fit), [_in_quiet(fit, i) for i in range(3)])


def _in_quiet(fit: Fit, axis: int) -> float:
    """Variance in a row of the band that the reference itself shows in its quiet."""
    trials = [t for t in fit.trials if axis in t.axes and t.reference != "static"]
    own = [in_band(t, t.u[:, OWN[t.kind]][:, [axis]])[:, 0] for t in trials]
    pieces = [windows(x, band_segments(t)) for x, t in zip(own, trials, strict=True)]
    found = np.concatenate(pieces) if pieces else np.zeros((0, 1))
    return quiet(found, REST) / lowness(found, REST) if len(found) else 0.0


def _drawn(
    trial: Trial, variance: np.ndarray, rng: np.random.Generator
) -> tuple[Trial, np.ndarray]:
    """The trial with a draw (n, 3) of what white noise of an attitude, or of a position, becomes
    once it is differentiated, of a ``variance`` (3,) in its band; and the variance (3,) that the
    draw had in its rows before it went through the low-pass of its force.

    It is no more than the high differences of the reference show: its band hides from the sensor
    what is left beyond.
    """
    if not _is_derived(trial):
        return replace(trial, noise=np.zeros(trial.y.shape)), np.zeros(3)
    draw = rng.standard_normal(trial.y.shape)
    for _ in range(trial.derivatives):
        draw = np.gradient(draw, axis=0)
    whole = draw.var(axis=0)
    draw = _as_shown(trial, draw)
    seen = in_band(trial, draw).var(axis=0) if trial.count else np.ones(3)
    wanted = np.isin(np.arange(3), trial.axes) & (seen > 0.0)
    scale = np.sqrt(np.where(wanted, variance / np.where(seen > 0.0, seen, 1.0), 0.0))
    most = roughness(trial, trial.u[:, OWN[trial.kind]]) / np.maximum(
        roughness(trial, draw), 1e-300
    )
    scale = np.minimum(scale, most)
    return replace(trial, noise=draw * scale), whole * scale**2


def _as_shown(trial: Trial, draw: np.ndarray) -> np.ndarray:
    """What is left of a draw (n, 3) that was differentiated once it has gone through all that the
    reference has.
    """
    if trial.place is not None:
        return trial.place.as_the_force(draw, trial.segments)
    return below_hz(draw, trial.segments, trial.h, trial.cutoff)


def _spectra(fit: Fit, linears: Sequence[Linear]) -> dict[str, list[Spectrum]]:
    """Spectra (3,) of the noise of references, by the names of their trials."""
    own = own_noise(fit)
    found = {
        t.name: _of_trial(fit.sensor, t, one, own)
        for t, one in zip(fit.trials, linears, strict=True)
        if t.reference != "static"
    }
    return {name: [by.get(i, NOTHING) for i in range(3)] for name, by in found.items()}


def _of_trial(
    sensor: Sensor, trial: Trial, one: Linear, own: Mapping[int, RandomWalk]
) -> dict[int, Spectrum]:
    """The noise by axis of the reference of a trial, as it goes into a sensor."""
    direct = trial.band_hz is None
    seen = unseen_spectra(trial, one, _with_quiet(trial, own) if direct else own)
    still = {i: all_noise(seen[i]) for i in standing(trial) if i in seen}
    if _is_derived(trial):
        return seen | still
    moving = {i: s for i, s in seen.items() if i not in still}
    if not moving:
        return still
    frequency = next(iter(moving.values())).frequency
    shares = np.maximum(power_through_dynamics(sensor, frequency, trial.h), LEAST_THROUGH)
    through = {i: shares[:, i] for i in moving}
    found = _of_direct(trial, one, moving, through) if direct else _in_band(trial, moving, through)
    return still | {i: _before(s, through[i]) for i, s in found.items()}


def _before(seen: Spectrum, through: np.ndarray) -> Spectrum:
    """A spectrum before dynamics that let the share ``through`` (f,) of it through."""
    if not len(seen.psd):
        return seen
    return replace(seen, psd=seen.psd / through, std=seen.std / through)


def _with_quiet(trial: Trial, own: Mapping[int, RandomWalk]) -> dict[int, RandomWalk]:
    """The ``own`` noise of a sensor, no less of it white than its quiet rows show: what it has
    beyond its declared noise is not the reference's.
    """
    quiet_rows = np.square(rest_noise(trial))
    return {i: replace(n, r=max(n.r, float(quiet_rows[i]))) for i, n in own.items()}


def _in_band(
    trial: Trial, seen: Mapping[int, Spectrum], through: Mapping[int, np.ndarray]
) -> dict[int, Spectrum]:
    """The noise by axis of a reference that was measured itself, on times of its own: its rows,
    made between its samples, show nothing of it by their high differences, but these do.
    """
    high, error = np.full(3, np.inf), 0.0
    if trial.samples is not None:
        count = len(trial.samples)
        white = white_of(differences(trial.samples, [(0, count)]))
        high, error = white / (2.0 * trial.band_limit), float(np.sqrt(2.0 * WEIGHT / count))
    shapes = {i: through[i] * in_rows(trial, s.frequency, np.ones_like) for i, s in seen.items()}
    return {i: of_reference(s, float(high[i]), error, shapes[i]) for i, s in seen.items()}


def _is_derived(trial: Trial) -> bool:
    return trial.band_hz is not None and trial.reference not in MEASURED


def _of_direct(
    trial: Trial, one: Linear, seen: Mapping[int, Spectrum], through: Mapping[int, np.ndarray]
) -> dict[int, Spectrum]:
    """The noise by axis of a reference that is no derivative."""
    high = 2.0 * trial.h * white_of_reference(trial)
    error = float(np.sqrt(2.0 * WEIGHT / len(one.time)))
    return doubted({i: of_reference(s, float(high[i]), error, through[i]) for i, s in seen.items()})


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


def _with_spectrum(
    trial: Trial, spectra: Sequence[Spectrum], white: np.ndarray, rng: np.random.Generator
) -> Trial:
    """The trial with what its noise has by its spectrum beside what it was drawn with, which was of
    a variance ``white`` (3,) before any low-pass.
    """
    if not any(len(s.psd) for s in spectra):
        return trial
    noise = np.array(trial.noise)
    for i, spectrum in enumerate(spectra):
        if not len(spectrum.psd):
            continue
        known = of_white_attitude(trial, spectrum.frequency, float(white[i]))
        more = spectrum.beyond(known)
        if more.any():
            noise[:, i] += drawn(trial, spectrum.frequency, more, rng)
    errors = tuple(s.error if s.variance > 0.0 else 0.0 for s in spectra)
    return replace(trial, noise=noise, noise_error=errors)


def _with_turn(trial: Trial) -> Trial:
    """The trial with what the body's turn makes of the noise of its attitudes.

    Of an attitude that is wrong by a small a(t) in body axes the rate is wrong by da/dt + w x a: a
    turns with the body. That meets the second derivative of a, and what follows angular
    acceleration and rate would seem to be there.
    """
    if trial.reference != "attitude" or trial.noise is None or len(trial.axes) < 3:
        return trial
    noise, rate = np.array(trial.noise), trial.u[:, OWN[trial.kind]]
    for a, b in trial.segments:
        wrong = trial.h * np.cumsum(noise[a:b], axis=0)
        noise[a:b] += np.cross(rate[a:b], wrong - wrong.mean(axis=0))
    return replace(trial, noise=noise)


def _as_the_reference_has_it(
    fit: Fit, held: Sequence[Trial]
) -> tuple[tuple[Trial, ...], list[Trial]]:
    """The trials of a fit and those held out, with noise as the reference has it where it was
    drawn as a model leaves it: a scale factor makes it smaller or larger.
    """
    left = residual_changes(fit)
    shares = {t.name: _share_left(t, one.residual) for t, one in zip(fit.trials, left, strict=True)}
    common = np.mean(list(shares.values()), axis=0)

    def whole(trial: Trial) -> Trial:
        if trial.noise is None:
            return trial
        share = shares.get(trial.parent or trial.name, common)
        return replace(trial, noise=trial.noise / share)

    return tuple(map(whole, fit.trials)), list(map(whole, held))


def _share_left(trial: Trial, left: np.ndarray) -> np.ndarray:
    """Share (3,) of the drawn noise that is ``left`` (m, 3) of it in rows of the band, and no less
    than makes it all that the reference shows; all of it where the axes of the two are not the
    same.
    """
    if trial.noise is None or not trial.count or trial.free_rotation:
        return np.ones(3)
    both = trial.noise, trial.u[:, OWN[trial.kind]]
    noise, shown = (in_band(trial, v).std(axis=0) for v in both)
    least = np.minimum(noise / np.maximum(shown, 1e-300), 1.0)
    share = np.maximum(left.std(axis=0) / np.maximum(noise, 1e-300), least)
    return np.where(noise > 0.0, share, 1.0)
