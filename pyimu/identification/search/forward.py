"""Forward selection for one sensor: screen, fit the best few in full, ask the held-out data, add,
and look again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from pyimu.identification.fit.columns import LogState, in_band, reference_input, residual
from pyimu.identification.fit.fit import Fit, begin
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.normal import Normal, normal_equations
from pyimu.identification.fit.response import predict
from pyimu.identification.fit.score import held_state, log_likelihood
from pyimu.identification.fit.trial import Trial, rest_noise
from pyimu.identification.search.candidates import Group, equivalent, with_start
from pyimu.identification.search.screen import (
    PENALTY,
    Screened,
    Screening,
    fitted_dispersion,
    fitted_gain,
    keys_of,
    screen,
)
from pyimu.model.sensor import Sensor

SET_WIDTH = 6.0
"""Log-likelihood [nat] within which another effect explains the data as well as the best."""

LEAST_BESIDE_DYNAMICS = 0.01
"""Share of the held-out RMS error by which an effect must lower it where a lag or delay is in the
model."""

MOST_EFFECTS = 8
MOST_REFINED = 5

LEAST_SHARE = 0.1
"""Share of the best gain at first look below which a candidate is not fitted in full: noise fitted
anew reorders, but not so far."""


@dataclass(frozen=True)
class Step:
    """One effect that was added: the coefficients it brought, its evidence, and who could stand in
    for it.

    ``declared`` says that the effect was in the model already and only its declared values were set
    free.
    """

    effect: str
    keys: frozenset
    gain: float
    gate: float
    alternatives: tuple[str, ...]
    dispersion: float
    declared: bool = False


@dataclass(frozen=True)
class Refused:
    """An effect that passed the gate but not the held-out data."""

    effect: str
    gain: float
    reason: str


@dataclass(frozen=True)
class Investigation:
    """What the loop found for one sensor: the model before and after, and the way between."""

    before: Fit
    after: Fit
    steps: tuple[Step, ...]
    refused: tuple[Refused, ...]
    first: Screening
    last: Screening
    held: tuple[Trial, ...]


@dataclass(frozen=True)
class Refined:
    """A candidate fitted in full; ``gain`` [nat] over the model without it, corrected for scatter
    and penalised.
    """

    screened: Screened
    fit: Fit
    gain: float
    dispersion: float


def investigate(
    sensor: Sensor,
    free: frozenset,
    trials: list[Trial],
    held: list[Trial],
    say: Callable[[str], None] = lambda text: None,
) -> Investigation:
    """Find what ``sensor``, with coefficients ``free``, lacks to explain ``trials``, confirmed on
    ``held``.
    """
    say(f"{sensor.kind}: fitting the model as declared")
    before = fit(begin(sensor, free, trials))
    if "saturation" in sensor.values and np.any(sensor.values["saturation"]["limit"]):
        before = without_lost(before)
    after = before
    steps: list[Step] = []
    refused: dict[str, Refused] = {}
    first = last = screen(before, sensor.values)
    while len(steps) < MOST_EFFECTS:
        say(f"{sensor.kind}: {len(steps)} added, trying {len(last.candidates)} candidates")
        options = [c for c in last.above() if c.effect not in refused]
        chosen, names = _choose(after, options, last.gate)
        if chosen is None:
            break
        if not improves(after, chosen.fit, held):
            refused[chosen.screened.effect] = Refused(
                chosen.screened.effect, chosen.gain, "does not lower the error on held-out data"
            )
            continue
        name = chosen.screened.effect
        steps.append(
            Step(
                name,
                keys_of(chosen.screened),
                chosen.gain,
                last.gate,
                names,
                chosen.dispersion,
                name in before.sensor.values,
            )
        )
        after = without_lost(chosen.fit) if name == "saturation" else chosen.fit
        last = screen(after, sensor.values)
    after, steps = _backward(after, steps)
    return Investigation(
        before, after, tuple(steps), tuple(refused.values()), first, last, tuple(held)
    )


def _choose(
    current: Fit, options: list[Screened], gate: float
) -> tuple[Refined | None, tuple[str, ...]]:
    """The candidate that explains most once fitted in full, and the names of those that explain as
    much.
    """
    worth = [c for c in options[:MOST_REFINED] if c.gain > LEAST_SHARE * options[0].gain]
    refined = sorted((refine(current, c) for c in worth), key=lambda r: -r.gain)
    refined = [r for r in refined if r.gain > gate]
    if not refined:
        return None, ()
    best = refined[0]
    derived = any(t.band_hz is not None for t in current.trials)
    for other in refined[1:]:
        # Of one class take the one with fewer coefficients unless the data speak clearly for the
        # other; a reference that ends below the band in which the two differ cannot speak at all.
        if (
            other.screened.effect in equivalent(best.screened.effect)
            and (derived or best.gain - other.gain < SET_WIDTH)
            and len(keys_of(other.screened)) < len(keys_of(best.screened))
        ):
            best = other
    close = [
        r.screened.effect for r in refined if r is not best and best.gain - r.gain <= SET_WIDTH
    ]
    twins = [c.effect for c in options if c.effect in equivalent(best.screened.effect)]
    return best, tuple(dict.fromkeys(close + twins))


def refine(current: Fit, c: Screened) -> Refined:
    """Fit a candidate in full beside everything that is free already, less the axes that turn out
    not to need it.

    Its gain is taken with the noise fitted anew, which a missing effect had disguised, and
    corrected for the scatter of the scores at the fitted values.
    """
    sensor = with_start(current.sensor, c.values, c.effect)
    fitted = fit(replace(current, sensor=sensor, free=current.free | keys_of(c)).with_noise())
    normal = normal_equations(fitted.linearise(), fitted.noise)
    needed = tuple(
        g for g in c.groups if _needed(fitted, normal, g, c.effect in current.sensor.values)
    )
    if needed and len(needed) < len(c.groups):
        return refine(
            current,
            replace(
                c,
                groups=needed,
                values={k: v for k, v in c.values.items() if k in {g.keys[0][3] for g in needed}},
            ),
        )
    spread = fitted_dispersion(normal, keys_of(c))
    fitted = on_plateau(fitted) if c.effect == "saturation" else fitted
    gain = (fitted.log_likelihood - current.log_likelihood) / spread - PENALTY * len(keys_of(c))
    return Refined(c, fitted, gain if needed else -np.inf, spread)


def _needed(fitted: Fit, normal: Normal, group: Group, declared: bool) -> bool:
    """True where the part of an effect that a group stands for explains something once all is
    fitted together.
    """
    if group.effect == "saturation":
        return respects_limit(fitted, group.keys[0][3][0])
    return (
        declared or group.measure is not None or fitted_gain(normal, fitted.sensor, group.keys) > 0
    )


def respects_limit(fitted: Fit, axis: int) -> bool:
    """True where the samples really stop at the limit of an axis while the model's input is beyond
    it.
    """
    limit = float(fitted.sensor.values["saturation"]["limit"][axis])
    open_sensor, beyond, over = fitted.sensor.without("saturation"), 0, 0
    for t in fitted.trials:
        x = predict(open_sensor, reference_input(t, fitted.states[t.name]), t.segments, t.h)[
            :, axis
        ]
        outside = np.concatenate([np.abs(x[a:b]) > 1.02 * limit for a, b in t.row_segments])
        y = np.concatenate([np.abs(t.y[a:b, axis]) for a, b in t.row_segments])
        beyond += int(outside.sum())
        over += int((outside & (y > 1.02 * limit + 4 * rest_noise(t)[axis])).sum())
    return beyond >= 5 and over < 0.2 * beyond


def improves(old: Fit, new: Fit, held: list[Trial]) -> bool:
    """True where held-out rows are likelier under the new model, both judged with the new model's
    noise.

    Held-out data in which the two models hardly differ cannot speak against the new one. Beside a
    lag or delay an effect must also lower the error by ``LEAST_BESIDE_DYNAMICS``: sampled dynamics
    are right to third order in the sample period only, and what they miss looks like a little of
    every other effect.
    """
    gained, difference, squares = 0.0, 0.0, np.zeros(2)
    for trial in held:
        (state_old, rest), (state_new, _) = held_state(old, trial), held_state(new, trial)
        r_old, r_new = (
            in_band(rest, residual(f.sensor, rest, s))
            for f, s in ((old, state_old), (new, state_new))
        )
        judged = [log_likelihood(new, rest, r) for r in (r_new, r_old)]
        gained += judged[0] - judged[1]
        difference += log_likelihood(new, rest, np.zeros_like(r_new)) - log_likelihood(
            new, rest, r_new - r_old
        )
        squares += [np.sum(r_old**2), np.sum(r_new**2)]
    dynamic = any(
        e.stage == "dynamics" and not old.sensor.is_off(e.name) for e in old.sensor.effects
    )
    if dynamic and squares[1] > (1 - LEAST_BESIDE_DYNAMICS) ** 2 * squares[0] > 0:
        return False
    return gained > 0.0 or difference < 0.5


def on_plateau(fitted: Fit) -> Fit:
    """Put each limit where the raw samples sit while the model's input is well beyond it, and fit
    the rest again.

    In the band of a derived reference the edges of a clipped stretch are smeared; the samples
    themselves show the limit.
    """
    limit, std = np.array(fitted.sensor.values["saturation"]["limit"]), {}
    open_sensor = fitted.sensor.without("saturation")
    for i in np.flatnonzero(limit):
        beyond = [
            _plateau(open_sensor, t, fitted.states[t.name], int(i), limit[i]) for t in fitted.trials
        ]
        sides = [np.concatenate([b[side] for b in beyond]) for side in (0, 1)]
        levels = [(float(np.median(s)), _median_std(s)) for s in sides if len(s) >= 5]
        if levels:
            limit[i], std[("slot", "saturation", "limit", (int(i),))] = max(levels)
    sensor = fitted.sensor.with_values("saturation", limit=limit)
    free = frozenset(k for k in fitted.free if k[1] != "saturation")
    return fit(replace(fitted, sensor=sensor, free=free, std={**fitted.std, **std}).with_noise())


def _median_std(values: np.ndarray) -> float:
    """Standard error of a median from the scatter about it, sqrt(pi/2) that of a mean."""
    scatter = 1.4826 * float(np.median(np.abs(values - np.median(values))))
    return np.sqrt(np.pi / 2 / len(values)) * scatter


def without_lost(fitted: Fit) -> Fit:
    """Leave out the samples that sit at a limit: they carry no noise and no slope, and would bend
    what is looked for next.
    """
    limit = fitted.sensor.values["saturation"]["limit"]
    open_sensor = fitted.sensor.without("saturation")
    margin = np.array(
        [4 * np.sqrt(fitted.noise[i].r) if i in fitted.noise else 0.0 for i in range(3)]
    )
    trials = []
    for t in fitted.trials:
        # Judged by the model, not by the noisy sample: choosing by the sample would keep one half
        # of the noise.
        x = predict(open_sensor, reference_input(t, fitted.states[t.name]), t.segments, t.h)
        lost = ((limit > 0) & (np.abs(x) > limit - margin)).any(axis=1)
        trials.append(replace(t, left_out=lost if t.left_out is None else lost | t.left_out))
    return fit(replace(fitted, trials=tuple(trials)).with_noise())


def _plateau(
    sensor: Sensor, trial: Trial, state: LogState, axis: int, limit: float
) -> tuple[np.ndarray, np.ndarray]:
    """Magnitudes of the samples, positive and negative side, taken while the unlimited model is 10
    % beyond the limit.
    """
    x = predict(sensor, reference_input(trial, state), trial.segments, trial.h)[:, axis]
    inside = np.zeros(len(x), dtype=bool)
    for a, b in trial.row_segments:
        inside[a:b] = True
    return tuple(
        np.abs(
            trial.y[
                inside & (sign * x > 1.1 * limit) & (sign * trial.y[:, axis] > 0.8 * limit), axis
            ]
        )
        for sign in (1, -1)
    )


def _backward(after: Fit, steps: list[Step]) -> tuple[Fit, list[Step]]:
    """Drop what later additions made superfluous; a limit never is, the samples at it having been
    left out since.
    """
    for step in [s for s in steps[:-1] if not s.declared and s.effect != "saturation"]:
        rest = [s for s in steps if s is not step]
        kept = after.free - step.keys
        without = fit(
            replace(after, sensor=after.sensor.without(step.effect), free=kept).with_noise()
        )
        if (after.log_likelihood - without.log_likelihood) / step.dispersion - PENALTY * len(
            step.keys
        ) <= step.gate:
            after, steps = without, rest
    return after, steps
