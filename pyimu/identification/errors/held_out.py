"""Errors on the rows that were not fitted: by sensor, by log, and of the attitude."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from pyimu.attitude.error import AttitudeError, error_against
from pyimu.identification.errors.attitude_error import Compared, beside
from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.keys import LogClock
from pyimu.identification.fit.left_open import Open, left_open, what_is_open
from pyimu.identification.fit.left_out import as_measured, left_out
from pyimu.identification.fit.noise_fit import declared_variances
from pyimu.identification.fit.noise_floor import floor_noise, reference_variance
from pyimu.identification.fit.scatter import typical_wander, wander_of
from pyimu.identification.fit.score import (
    WINDOW,
    ErrorSums,
    UnitFloor,
    held_state,
    markov_floor,
    tally,
    unit_floor,
)
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.found.entries import AtRest, Errors, LogEntry
from pyimu.identification.noise.named import Noise
from pyimu.identification.reference.level import Leaning, leaning
from pyimu.identification.search.belief import FARTHEST, most
from pyimu.identification.search.investigation import Investigation
from pyimu.model.catalogue import WALK
from pyimu.model.part import Part
from pyimu.recording.recording import Recording

Scores = tuple[dict[str, Errors], tuple[LogEntry, ...], tuple[float, float] | None]

FOLDS = {"accel": "each position at rest in turn", "gyro": "each turn between rests in turn"}
"""What is left out of the fit and judged by it."""


def scores(
    found: dict[str, Investigation],
    logs: list[Recording],
    others: list[Recording],
    noises: Mapping[str, Noise],
) -> Scores:
    """Held-out errors of each sensor, in all and by recording, and log-likelihood per sample, with
    what was found of the ``noises`` of each.
    """
    together = [*logs, *others]
    by_log: dict[str, dict[str, Errors]] = {r.name: {} for r in together}
    errors, likelihood = {}, np.zeros(2)
    for kind, inv in found.items():
        noise = floor_noise(inv.after)
        judged = inv.after.prior and any(t.reduction is None for t in inv.held)
        unsure = what_is_open(inv.after) if judged and not inv.unfit else None
        for trial in inv.held:
            error = _errors(inv, trial, noise, unsure)
            by_log[trial.name][kind] = replace(error, named=_named(inv, trial, noises.get(kind)))
        each = [e[kind] for e in by_log.values() if kind in e]
        if each:
            errors[kind] = sum(each[1:], start=each[0])
            gained = noises[kind].gained if kind in noises else 0.0
            more = ErrorSums(log_likelihood=gained)
            likelihood += _per_row(replace(errors[kind], after=errors[kind].after + more))
    entries = tuple(_entry(r, found, by_log[r.name]) for r in together)
    return errors, entries, tuple(likelihood.tolist()) if errors else None


def _errors(
    inv: Investigation,
    trial: Trial,
    noise: dict[int, RandomWalk],
    unsure: Open | None,
) -> Errors:
    if trial.reduction is not None:
        return _errors_of_rows(inv, trial)
    unit, both = inv.after.sensor.output.unit, (tally(f, trial) for f in (inv.before, inv.after))
    if inv.unfit:
        # What another body's motion leaves says nothing of noise.
        return Errors(unit, *both, None)
    white = {i: RandomWalk(n.r, 0.0) for i, n in noise.items()}
    walk = {i: RandomWalk(0.0, k2) for i, k2 in _walk(inv, noise).items()}
    floor = unit_floor(inv.after, trial)
    drift = floor.of(walk) if any(n.k2 for n in walk.values()) else None
    # Two logs may have two references, or one that sees them from other distances.
    reference = reference_variance(inv.after, trial.name)
    least = floor.of(white).with_variance(reference)
    open_ = None if unsure is None else left_open(inv.after, trial, unsure)
    slow = _slow(inv, trial, floor, reference)
    return Errors(unit, *both, least, drift or ErrorSums(), unsure=open_, slow=slow)


def _named(inv: Investigation, trial: Trial, noise: Noise | None) -> ErrorSums | None:
    """What the slow noise that was named leaves of rows; None where there is none, or where no
    noise is told apart.
    """
    processes = {} if noise is None else noise.processes
    if not processes or trial.reduction is not None or inv.unfit:
        return None
    return markov_floor(inv.after, trial, processes)


def _slow(
    inv: Investigation, trial: Trial, floor: UnitFloor, reference: np.ndarray
) -> ErrorSums | None:
    """What the largest random walk that a sensor may have leaves, and in the integral over a window
    what ``reference`` (3,), the variance that the reference adds to a row, makes of it if it is
    white: of a derived rate it is less. None where no part's walk is known.
    """
    sensor = inv.after.sensor
    largest = most(WALK[0], sensor.kind, WALK[1]) ** 2
    if not np.isfinite(largest):
        return None
    _, declared = declared_variances(sensor, trial.h)
    walk = {i: RandomWalk(0.0, max(float(declared[i]), largest)) for i in trial.axes}
    made, step = floor.of(walk), trial.h * trial.band.stride
    white = made.windows * reference * WINDOW * step
    return replace(made, angle_squares=made.angle_squares + white)


def _walk(inv: Investigation, noise: dict[int, RandomWalk]) -> dict[int, float]:
    """Variance in a second of the random walk by axis.

    As declared, else as fitted, and no more than a sensor may have: a walk of any size would
    account for whatever a model lacks.
    """
    sensor, h = inv.after.sensor, inv.after.trials[0].h
    _, declared = declared_variances(sensor, h)
    largest = most(WALK[0], sensor.kind, WALK[1]) ** 2
    return {i: float(declared[i]) or min(n.k2, largest) for i, n in noise.items()}


def _errors_of_rows(inv: Investigation, trial: Trial) -> Errors:
    """Errors of rows that are each judged by a fit to the others."""
    before, after = left_out(inv.before, trial), left_out(inv.after, trial)
    likely = (ErrorSums(log_likelihood=one.log_likelihood) for one in (before, after))
    sums = (one.sums(one.error**2) + e for one, e in zip((before, after), likely, strict=True))
    # More than any sensor wanders is no noise, but something that the model lacks.
    share = min(1.0, (FARTHEST * typical_wander(trial.kind) / wander_of(trial)) ** 2)
    # The rest of what is expected is in what the other rows leave open of the model.
    open_ = np.maximum(after.variance - after.white - after.wander, 0.0)
    noise = (after.sums(v) for v in (after.white, share * after.wander))
    unit, unsure = inv.after.sensor.output.unit, after.sums(open_)
    return Errors(unit, *sums, *noise, data=FOLDS[trial.kind], unsure=unsure)


def at_rest(found: dict[str, Investigation]) -> tuple[AtRest, ...]:
    """The errors of gravity at rest where it was a sensor's reference."""
    of_rests = {
        kind: [t for t in found[kind].held if t.reduction is not None]
        for kind in ("accel", "gyro")
        if kind in found
    }
    return tuple(_at_rest(found[kind], trials) for kind, trials in of_rests.items() if trials)


def _at_rest(inv: Investigation, trials: list[Trial]) -> AtRest:
    bare, before, after = (
        np.concatenate([t.reduction.of_gravity(e(t)) for t in trials])
        for e in (
            as_measured,
            lambda t: left_out(inv.before, t).error,
            lambda t: left_out(inv.after, t).error,
        )
    )
    judged = np.isfinite(before) & np.isfinite(after)
    rows = int(judged.sum()) or np.nan
    rms = (float(np.sqrt(np.sum(e[judged] ** 2) / rows)) for e in (bare, before, after))
    folds = sum(len(np.unique(t.reduction.group)) for t in trials)
    kind = trials[0].kind
    unit = inv.after.sensor.output.unit if kind == "accel" else "rad"
    return AtRest(kind, unit, folds, len(judged), int(judged.sum()), *rms)


def _per_row(e: Errors) -> np.ndarray:
    rows = max(e.before.rows.max(), 1.0)
    return np.array([e.before.log_likelihood, e.after.log_likelihood]) / rows


def _entry(r: Recording, found: dict[str, Investigation], errors: dict[str, Errors]) -> LogEntry:
    held = held_trials(found, r.name)
    states = {kind: log_state(inv, r.name) for kind, inv in found.items()}
    return LogEntry(
        file=r.path.name if r.path else r.name,
        samples=len(r.time),
        held_out=max((len(t.time if t.reduction is None else r.time) for t in held), default=0),
        errors=errors,
        log_state={kind: s for kind, s in states.items() if s},
    )


def held_trials(found: dict[str, Investigation], name: str) -> list[Trial]:
    """The trials of a log whose rows were left out of the fit all at once, not each in turn."""
    held = [t for inv in found.values() for t in inv.held if t.name == name]
    return [t for t in held if t.reduction is None or t.parent is None]


def log_state(inv: Investigation, name: str) -> dict[str, Any] | None:
    """What was estimated of a log itself, under the model after.

    None for a log that was not looked at.
    """
    trial = next((t for t in (*inv.after.trials, *inv.held) if t.name == name), None)
    if trial is None:
        return None
    state = inv.after.states.get(name) or held_state(inv.after, trial)[0]
    bias = [float(b) if i in trial.axes else None for i, b in enumerate(state.bias)]
    found: dict[str, Any] = {"bias": bias, "rotation": state.rotation.tolist()}
    if trial.place is not None:
        found["place"] = state.place.tolist()
    return found | {"reference": _reference(replace(trial, clock=clock_of(inv, name)))}


def clock_of(inv: Investigation, name: str, before: bool = False) -> Clock | None:
    """The clock of a log as it was measured, with what the model after, or ``before``, found beside
    it: of a log of which no row was fitted, as it is held out.
    """
    fitted = inv.before if before else inv.after
    trials = [t for t in (*fitted.trials, *inv.held) if t.name == name]
    clock, state = trials[0].clock, fitted.states.get(name)
    if clock is not None and clock.apart and state is None:
        state = held_state(fitted, trials[0])[0]
    if clock is None or state is None or state.clock is None:
        return clock
    std = fitted.std.get(LogClock(name, 1), np.inf)
    return clock.corrected(state.clock, std, trials[0].time[0], trials[-1].time[-1])


def _reference(trial: Trial) -> dict[str, Any]:
    """What was found of a log's reference itself."""
    seen: dict[str, Any] = {
        "kind": trial.reference,
        "band_hz": trial.band_hz,
        # A derived rate is used up to a quarter of the rate of its own samples.
        "sample_rate": None if trial.band_limit is None else 4.0 * trial.band_limit,
    }
    if trial.up is not None:
        seen["up"] = trial.up.tolist()
    if trial.clock is None:
        return seen | {"clock": None, "explained": None}
    return seen | {"clock": trial.clock.as_dict(), "explained": trial.clock.explained}


def attitudes(
    part: Part, inv: Investigation | None, logs: list[Recording], before: bool = False
) -> dict[str, AttitudeError]:
    """Errors of the attitude filter with a part by log, on held-out rows that ``ref_q`` covers, by
    the clocks of the model after, or ``before``.

    Without recorded headings that of each ``WINDOW`` s begins anew.
    """
    found = {}
    for r in logs:
        compared = _beside(part, inv, r, before)
        if compared is None:
            continue
        error = error_against(*compared)
        error = error if r.heading is not None else error.in_windows(WINDOW)
        found |= {r.name: error} if len(error.total) else {}
    return found


def worlds(inv: Investigation | None, logs: list[Recording]) -> dict[str, Leaning]:
    """The worlds of the logs' reference attitudes that are not level, by log, as the attitude
    filter without a part shows them: one whose gyro drifts unlike the part says would go off, and
    take the world with it.
    """
    compared = {r.name: _beside(None, inv, r) for r in logs}
    found = {name: leaning(*c[1:]) for name, c in compared.items() if c is not None}
    return {name: world for name, world in found.items() if world is not None}


def _beside(
    part: Part | None, inv: Investigation | None, r: Recording, before: bool = False
) -> Compared | None:
    """The filter's attitudes beside the reference's; None of a log that does not show them."""
    held = None if inv is None else next((t for t in inv.held if t.name == r.name), None)
    if held is None or r.ref_q is None or r.accel is None:
        return None
    mounting = np.array(log_state(inv, r.name)["rotation"])
    first = int(np.searchsorted(r.time, held.time[0]))
    fitted = next((t for t in inv.after.trials if t.name == held.parent), None)
    ends = fitted is None or fitted.precedes(held)
    stop = None if ends else int(np.searchsorted(r.time, held.time[-1], side="right"))
    return beside(r, part, mounting, first, clock_of(inv, r.name, before), stop)
