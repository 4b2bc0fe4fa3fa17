"""Put together what was found: models, effects, verdict, error on held-out data."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

import numpy as np

from pyimu.attitude.error import AttitudeError
from pyimu.identification.advice import advice
from pyimu.identification.as_part import as_part
from pyimu.identification.confounds import what_no_log_tells_apart
from pyimu.identification.declared import changed_noise, drifting, released
from pyimu.identification.estimated import estimated
from pyimu.identification.exhibits import Exhibits, exhibits_of
from pyimu.identification.fates import TAKEN_BACK, Fate, fates
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.formula.formula import Formula
from pyimu.identification.formula.search import Look
from pyimu.identification.found import Added, Changed, LogEntry
from pyimu.identification.heading_error import heading_rms
from pyimu.identification.held_out import at_rest, attitudes, held_trials, scores
from pyimu.identification.made_with import MadeWith
from pyimu.identification.magnetometer.examine import examined
from pyimu.identification.magnetometer.model import magnetic, with_magnetometer
from pyimu.identification.model_of import Found, Model, model_of
from pyimu.identification.noise.named import Noise, noise_of
from pyimu.identification.overview import Overview, overview
from pyimu.identification.reference.gravity import few
from pyimu.identification.reference.order import other_order
from pyimu.identification.references import references
from pyimu.identification.result import Closed
from pyimu.identification.search.belief import most
from pyimu.identification.search.ceiling import is_ceiling
from pyimu.identification.search.forward import Investigation, form_error, without
from pyimu.identification.third_sensor import and_magnetometer
from pyimu.identification.verdict import WORSE, Evidence, Verdict, unfit, verdict
from pyimu.identification.visibility import visibility
from pyimu.model.catalogue import CATALOGUE, WALK, WHITE
from pyimu.model.effect import Effect
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

CALIBRATION = ("scale_factor", "misalignment")
"""Effects of the baseline that turn the gyro's rate into that of the body."""

MORE_THAN_NOISE = "kinds of noise are told apart only where nothing else is left"
AS_FORM = "what noise was found is no more than the form of an effect may leave"


def conclude(
    start: Part,
    declared: Part | None,
    logs: list[Recording],
    others: list[Recording],
    found: Found,
    quality: tuple,
    say: Callable[[str], None],
    made_with: MadeWith,
    looks: Mapping[str, Look],
) -> Closed:
    """The result of the investigations ``found`` of the sensors of a part, with what was made of
    what they leave.
    """
    say("attitude against the reference")
    found, model, attitude, lost = settled(start, declared, found, others or logs)
    not_examined = _unexamined(found, logs)
    another = unfit(found)
    magnetometer = examined(start, logs, others, found, another, say)
    say("what is random in what is left")
    fits = not another
    noises = {
        kind: _noise(start, inv, model, len(found), fits and _is_noise(inv, looks[kind]))
        for kind, inv in found.items()
    }
    model = model.with_noise(noises)
    model = replace(model, after=with_magnetometer(model.after, start, magnetometer))
    added, changed, drifts = _findings(start, declared, found, model, noises, say)
    unexplained = tuple(k.unexplained for k in looks.values() if k.unexplained)
    unexplained += tuple(s for n in noises.values() for s in n.shapes)
    formulas = _kept(looks.values(), found)
    refused = [(kind, r) for kind, inv in found.items() for r in inv.refused]
    refused += [(kind, r) for kind, n in noises.items() for r in n.refused]
    say("error on held-out data")
    errors, entries, likelihood = scores(found, logs, others, _gained(noises))
    heading, equations = heading_rms(found.get("gyro")), {f.name: f.said for f in formulas}
    beside = (errors, attitude, refused, not_examined, lost, heading, equations)
    together = [*logs, *others]
    became = tuple(f for kind in found for f in _fates(kind, found[kind], added, noises[kind]))
    evidence = Evidence(added, changed, unexplained, drifts, found, *beside, became)
    said = _said(evidence, together)
    say("the whole model, and what to measure next")
    model_after = estimated(start, model.after, found, added, noises)
    model_after += magnetic(start, model.after, magnetometer)
    seen = tuple(v for kind, inv in found.items() for v in visibility(kind, inv))
    closed = Closed(
        verdict=said.word,
        reason=said.reason,
        remarks=said.remarks,
        before=model.before,
        after=as_part(model.after, model_after, declared, not_examined),
        added=tuple(added),
        changed=tuple(changed),
        unexplained=unexplained,
        drift=drifts,
        observability=seen,
        errors=errors,
        log_likelihood=likelihood,
        attitude=attitude,
        quality=quality,
        recordings=_with_overviews(entries, together, found, quality),
        refused=tuple(refused),
        exhibits=_exhibits(found, added, formulas),
        band_hz={kind: inv.after.trials[0].band_hz for kind, inv in found.items()},
        held_out="holdout" if others else "last 30 %",
        estimated=model_after,
        not_examined=not_examined,
        candidates=became,
        references=references(found, together),
        next=advice(found, model_after, seen, logs, not_examined, not others),
        made_with=made_with,
        heading=heading,
        at_rest=at_rest(found),
        formulas=formulas,
    )
    return and_magnetometer(closed, magnetometer, together)


def _kept(looks: Iterable[Look], found: Found) -> tuple[Formula, ...]:
    """The formulas that were found, less those that were taken back."""
    formulas = (k.formula for k in looks if k.formula)
    return tuple(f for f in formulas if any(s.effect == f.name for s in found[f.sensor].steps))


def _findings(
    start: Part,
    declared: Part | None,
    found: Found,
    model: Model,
    noises: dict[str, Noise],
    say: Callable[[str], None],
) -> tuple[list[Added], list[Changed], dict[str, dict[int, float]]]:
    """The effects that were added, the values that changed, and the axes that wander, by sensor."""
    added, changed, drifts = [], [], {}
    for kind, inv in found.items():
        say(f"{kind}: what is left")
        added += _added(kind, model.after.sensor(kind), inv) + [*model.rounding[kind].added]
        added += noises[kind].added
        changed += [released(start.sensor(kind), inv.after, s) for s in inv.steps if s.declared]
        changed += noises[kind].changed
        drifts |= {kind: dict(noises[kind].drift)} if noises[kind].drift else {}
    return added, changed, drifts


def _noise(start: Part, inv: Investigation, model: Model, sensors: int, is_noise: bool) -> Noise:
    """What is random in what an investigation of a part left.

    Kinds are told apart where ``is_noise`` says that nothing else is known to be left.
    """
    rounded = model.rounding[inv.after.sensor.kind]
    sensor = rounded.of_increments(start.sensor(inv.after.sensor.kind))
    free = frozenset(e for kind, e, _ in start.estimate if kind == sensor.kind)
    rounds = rounded.relevant or sensor.reading("step") is not None
    unasked = MORE_THAN_NOISE
    if is_noise:
        found = noise_of(sensor, inv, free, rounds, sensors)
        if all(_counts(inv, a) for a in found.added):
            return found
        unasked = found.unasked or AS_FORM
    if rounds or free & {WHITE[0], WALK[0]}:
        return Noise(unasked=unasked)
    return Noise(
        changed=changed_noise(start, sensor.kind, inv.after),
        drift=drifting(sensor.kind, inv.after, sensor).get(sensor.kind, {}),
        unasked=unasked,
    )


def _counts(inv: Investigation, a: Added) -> bool:
    """Whether a noise is more than what the form of an effect may leave, and no larger than any."""
    values = a.parameters.items()
    sizes = [most(a.effect, a.sensor, name) >= np.nanmax(np.abs(v)) for name, (v, *_) in values]
    return a.gain > form_error(inv.steps) and all(sizes)


def _is_noise(inv: Investigation, look: Look) -> bool:
    """Whether what is left may be noise.

    It follows no input, nor a clock that wanders, nor the edges of what the output does.
    """
    if any(CATALOGUE[s.effect].stage == "output" for s in inv.steps):
        return False
    clocks = [t.clock for t in inv.after.trials if t.clock is not None and t.clock.is_seen]
    return look.unexplained is None and all(c.is_steady for c in clocks)


def _gained(noises: dict[str, Noise]) -> dict[str, float]:
    return {kind: n.gained for kind, n in noises.items()}


def _fates(kind: str, inv: Investigation, added: list[Added], noise: Noise) -> list[Fate]:
    return fates(kind, inv, [a for a in added if a.sensor == kind], noise.unasked)


def _said(evidence: Evidence, logs: list[Recording]) -> Verdict:
    """The verdict; beside a reference that does not fit, the order in which it would."""
    said = verdict(evidence)
    if said.word != "reference_unfit":
        return said
    return replace(said, remarks=(*filter(None, [other_order(logs)]), *said.remarks))


def _with_overviews(
    entries: tuple[LogEntry, ...], logs: list[Recording], found: Found, quality: tuple
) -> tuple[LogEntry, ...]:
    pairs = zip(entries, logs, strict=True)
    return tuple(replace(e, overview=_overview(r, found, quality)) for e, r in pairs)


def _overview(r: Recording, found: Found, quality: tuple) -> Overview:
    held = held_trials(found, r.name)
    return overview(r, held, [f for f in quality if f.detail.get("recording") == r.name])


def _unexamined(found: Found, logs: list[Recording]) -> dict[str, str]:
    """Why a sensor of the logs was not looked at, by its kind."""
    reasons = {
        "gyro": lambda: "the gyro was not examined: no reference of its rate, and it moves",
        "accel": lambda: (
            f"the accelerometer was not examined: no reference of its force, and {few(logs)}"
        ),
    }
    there = {k for k in reasons if any(getattr(r, k) is not None for r in logs)}
    return {k: reason() for k, reason in reasons.items() if k in there - set(found)}


def _exhibits(
    found: Found, added: list[Added], formulas: tuple[Formula, ...]
) -> dict[str, Exhibits]:
    return {
        kind: exhibits_of(inv, [a for a in added if a.sensor == kind], formulas)
        for kind, inv in found.items()
    }


# Attitude


def settled(
    start: Part, declared: Part | None, found: Found, logs: list[Recording]
) -> tuple[Found, Model, tuple[float, float] | None, tuple[str, ...]]:
    """What was found less the effects that make the filter's attitude worse.

    Gives the model that it makes, too, the attitude's error before and after, and of each log in
    which both are lost, so that they are not compared, what is to be said.
    """
    while True:
        model, inv = model_of(start, declared, found), found.get("gyro")
        old, new = (_as_filed(p, declared) for p in (model.before, model.after))
        before, after = (attitudes(p, inv, logs) for p in (old, new))
        lost = [n for n in before if before[n].is_lost and after[n].is_lost]
        said = tuple(_lost(n, before[n], after[n]) for n in lost)
        kept = [n for n in before if n not in lost]
        if not kept:
            return found, model, None, said
        was, now = (_pooled(e, kept) for e in (before, after))
        worst = _worst(new, inv, logs, kept, now) if now > WORSE * was else None
        if worst is None:
            model, now, more = _less_calibration(model, declared, inv, logs, kept, now)
            return found, model, (was, now), said + more
        name, error = worst
        degrees = [f"{np.degrees(v):.2f}" for v in (error, now)]
        reason = f"{TAKEN_BACK}, {degrees[0]} to {degrees[1]} deg"
        found = found | {"gyro": without(inv, name, reason)}


def _less_calibration(
    model: Model,
    declared: Part | None,
    inv: Investigation,
    logs: list[Recording],
    kept: list[str],
    now: float,
) -> tuple[Model, float, tuple[str, ...]]:
    """The model less the scale factors and axes by which the attitude is worse than without them.

    They are the baseline's, which nobody declared, and what a gyro that is not quite linear shows
    at the speed of the fitted logs: at another one they may be further off than none. Gives the
    error [rad] of the attitude that is left, too, and what is to be said.
    """
    names = [n for n in CALIBRATION if declared is None and n in model.after.gyro.values]
    if not names:
        return model, now, ()
    bare = replace(model, after=model.after.with_sensor(model.after.gyro.without(*names)))
    error = _pooled(attitudes(_as_filed(bare.after, declared), inv, logs), kept)
    if WORSE * error >= now:
        return model, now, ()
    degrees = [f"{np.degrees(v):.2f}" for v in (now, error)]
    said = (
        f"the gyro's {' and '.join(n.replace('_', ' ') for n in names)} are left out of the model: "
        f"the attitude is better without them, {degrees[0]} to {degrees[1]} deg"
    )
    return bare, error, (said,)


def _as_filed(part: Part, declared: Part | None) -> Part:
    """The part with its gyro's walk as ``as_part`` will have it: left out where nobody declared one
    and the logs do not show it.
    """
    if declared is not None or WALK[0] not in part.gyro.values or part.gyro.acts(WALK[0]):
        return part
    return _part_without(part, WALK[0])


def _worst(
    part: Part, inv: Investigation, logs: list[Recording], kept: list[str], now: float
) -> tuple[str, float] | None:
    """The added effect without which the attitude is best, and its error then.

    None where it is then hardly better than ``now``.
    """
    errors = {
        name: _pooled(attitudes(_part_without(part, name), inv, logs), kept)
        for name in (s.effect for s in inv.steps if not s.declared)
        if not is_ceiling(part.gyro, name)
    }
    worst = min(errors, key=errors.get, default=None)
    return (worst, errors[worst]) if worst and WORSE * errors[worst] < now else None


def _part_without(part: Part, effect: str) -> Part:
    return part.with_sensor(part.gyro.without(effect))


def _pooled(errors: dict[str, AttitudeError], names: list[str]) -> float:
    """RMS error [rad] over the rows of some logs."""
    return float(np.sqrt(np.mean(np.concatenate([errors[n].total for n in names]) ** 2)))


def _lost(name: str, before: AttitudeError, after: AttitudeError) -> str:
    degrees = [f"{np.degrees(e.rms):.0f}" for e in (before, after)]
    return (
        f"the filter loses the attitude of {name}, before ({degrees[0]} deg) and after "
        f"({degrees[1]} deg): not compared"
    )


# Effects that were added


def _added(kind: str, sensor: Sensor, inv: Investigation) -> list[Added]:
    """The steps of an investigation with the coefficients as they stand at its end."""
    out = []
    for step in (s for s in inv.steps if not s.declared):
        e = sensor.effect(step.effect)
        values = sensor.values[e.name]
        parameters = {
            name: (values[name], _standard_errors(inv.after, e, name, step.dispersion), unit)
            for name, unit in ((n, sensor.unit(p.unit)) for n, p in e.parameters.items())
        }
        note = what_no_log_tells_apart(e, sensor, inv.after.trials)
        out.append(Added(kind, e.name, step.alternatives, parameters, step.gain, step.gate, note))
    return out


def _standard_errors(fit: Fit, e: Effect, name: str, dispersion: float) -> np.ndarray:
    """Standard errors of a coefficient, zero where it was not estimated."""
    std = np.zeros(e.parameters[name].shape)
    for key, value in fit.std.items():
        if isinstance(key, Coefficient) and (key.effect, key.parameter) == (e.name, name):
            std[key.index] = value * math.sqrt(dispersion)
    return std
