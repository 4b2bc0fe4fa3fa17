"""Put together what was found: models, effects, verdict, error on held-out data."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.errors.by_attitude import settled
from pyimu.identification.errors.heading_error import heading_rms
from pyimu.identification.errors.held_out import at_rest, held_trials, scores
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.sample_noise import rest_noise
from pyimu.identification.formula.formula import Formula
from pyimu.identification.formula.search import Look
from pyimu.identification.found.entries import Added, Changed, Errors, LogEntry
from pyimu.identification.found.exhibits import Exhibits, exhibits_of
from pyimu.identification.found.made_with import MadeWith
from pyimu.identification.logs.overview import Overview, overview
from pyimu.identification.logs.vibration import shaken_together
from pyimu.identification.magnetometer.examine import Examined, examined
from pyimu.identification.magnetometer.model import magnetic, with_magnetometer
from pyimu.identification.model.as_part import SENSORS, as_part
from pyimu.identification.model.estimated import estimated
from pyimu.identification.model.model_of import Found, Model
from pyimu.identification.model.unshown import with_unshown_held
from pyimu.identification.noise.named import Noise
from pyimu.identification.plan.advice import advice
from pyimu.identification.reference.gravity import few
from pyimu.identification.reference.order import other_order
from pyimu.identification.reference.scales import findings_of as scales_found
from pyimu.identification.reference.scales import scales_of
from pyimu.identification.report.clocks import or_gain, taken_out, undone
from pyimu.identification.report.references import references
from pyimu.identification.result import Closed
from pyimu.identification.rivals.confounds import what_no_log_tells_apart
from pyimu.identification.search.investigation import Investigation, Refused
from pyimu.identification.search.leftover import Unexplained
from pyimu.identification.search.rounded import OF_DIGITS
from pyimu.identification.third_sensor import and_magnetometer, of_magnetometer
from pyimu.identification.verdict.can_tell import rows_fitted, shows_anything, unfit
from pyimu.identification.verdict.declared import released
from pyimu.identification.verdict.fates import Fate, fates
from pyimu.identification.verdict.random import noises_of
from pyimu.identification.verdict.ranges import beyond, set_to_zero
from pyimu.identification.verdict.verdict import Evidence, Verdict, verdict
from pyimu.identification.verdict.visibility import visibility
from pyimu.model.effect import Effect
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.quality.inspect import NO_GRAVITY
from pyimu.recording.recording import Recording
from pyimu.recording.reference.course import looks_like_degrees
from pyimu.recording.reference.file import other_time
from pyimu.recording.reference.force import has_places
from pyimu.report.numbers import joined


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
    fitting = {kind: with_unshown_held(inv) for kind, inv in found.items() if not inv.unfit}
    fitting, model, *of_attitude = settled(start, declared, fitting, others or logs)
    found = found | fitting
    scales = scales_of(inv.after for inv in fitting.values())
    quality = (*quality, *scales_found(scales))
    another = unfit(found)
    magnetometer = examined(start, logs, others, found, another, say)
    say("what is random in what is left")
    noises = noises_of(start, fitting, model, looks, not another)
    model = model.with_noise(noises)
    model = replace(model, after=with_magnetometer(model.after, start, magnetometer))
    case = _Settled(
        start,
        declared,
        logs,
        others,
        found,
        another,
        fitting,
        model,
        noises,
        looks,
        magnetometer,
        quality,
    )
    named = _findings(case, say)
    say("error on held-out data")
    errors, entries, likelihood = scores(found, logs, others, noises)
    evidence = _evidence(case, *named, errors, entries, *of_attitude)
    say("the whole model, and what to measure next")
    closed = Closed(
        **_shown(evidence, case.together),
        **_model_shown(case, evidence),
        log_likelihood=likelihood,
        quality=quality,
        recordings=_with_overviews(entries, case.together, found, quality),
        exhibits=_exhibits(found, evidence.added, case.formulas),
        held_out="holdout" if others else _share(found),
        references=references(found, case.together, scales),
        made_with=made_with,
        heading=case.heading,
        at_rest=at_rest(found),
        formulas=case.formulas,
    )
    return and_magnetometer(closed, magnetometer, case.together)


def _share(found: dict[str, Investigation]) -> str:
    """Which 30 % of each log was held out."""
    places = set()
    for inv in found.values():
        fitted = {t.name: t for t in inv.after.trials if t.segments}
        for held in inv.held:
            if held.reduction is None and held.parent in fitted and len(held.time):
                rows = fitted[held.parent]
                begins = rows.time[rows.segments[0][0]]
                amid = "middle" if held.time[0] > begins else "first"
                places.add("last" if rows.precedes(held) else amid)
    return f"{places.pop()} 30 %" if len(places) == 1 else "30 %" if places else "last 30 %"


@dataclass(frozen=True, eq=False)
class _Settled:
    """What was ``found`` of a part's sensors in logs to fit and ``others`` to judge by, once it is
    settled; ``unfit`` says why a reference is another body's, ``fitting`` are the sensors whose
    reference fits, and the ``model`` has the ``noises``.
    """

    start: Part
    declared: Part | None
    logs: list[Recording]
    others: list[Recording]
    found: Found
    unfit: str
    fitting: Found
    model: Model
    noises: dict[str, Noise]
    looks: Mapping[str, Look]
    magnetometer: Examined | str
    quality: tuple

    @property
    def together(self) -> list[Recording]:
        return [*self.logs, *self.others]

    @cached_property
    def heading(self) -> tuple[float, float] | None:
        return heading_rms(self.found.get("gyro"))

    @cached_property
    def formulas(self) -> tuple[Formula, ...]:
        return _kept(self.looks.values(), self.found)


def _evidence(
    case: _Settled,
    added: list[Added],
    changed: list[Changed],
    drift: dict[str, dict[int, float]],
    errors: dict[str, Errors],
    entries: tuple[LogEntry, ...],
    attitude: tuple[float, float] | None,
    lost: tuple[str, ...],
) -> Evidence:
    """What the verdict goes by."""
    found, noises, quality, rounded = case.found, case.noises, case.quality, _rounded(case.found)
    clocks = undone(quality), or_gain(quality), taken_out(found, case.heading)
    return Evidence(
        examined=tuple(found),
        unexamined=_unexamined(found, case.logs, quality),
        unfit=case.unfit,
        shows=shows_anything(found),
        rows=rows_fitted(found),
        added=tuple(added),
        changed=tuple(changed),
        unexplained=_unexplained(rounded, case.looks, noises),
        dead=_dead(found, quality),
        rounded=bool(rounded),
        drift=drift,
        refused=_refused(found, noises),
        fates=tuple(f for k, inv in case.fitting.items() for f in _fates(k, inv, added, noises[k])),
        errors=errors,
        by_log={r.name: e.errors for r, e in zip(case.together, entries, strict=True)},
        band_hz={kind: inv.after.trials[0].band_hz for kind, inv in found.items()},
        beside=of_magnetometer(case.magnetometer, case.declared is not None),
        attitude=attitude,
        lost=lost,
        ranges=(*beyond(quality), *set_to_zero(quality, [(a.sensor, a.effect) for a in added])),
        clocks=tuple(filter(None, clocks)),
        formulas={f.name: f.said for f in case.formulas},
        unshown=_unshown(found),
        shaken=shaken_together(quality),
    )


def _model_shown(case: _Settled, evidence: Evidence) -> dict[str, Any]:
    """The model before and after that a result shows, what the logs say of its coefficients, and
    which measurement would say more.
    """
    start, fitting, after = case.start, case.fitting, case.model.after
    whole = estimated(start, after, fitting, evidence.added, case.noises)
    whole += magnetic(start, after, case.magnetometer)
    seen = tuple(v for kind, inv in fitting.items() for v in visibility(kind, inv))
    unfitting = {k: inv.unfit for k, inv in case.found.items() if inv.unfit}
    silent = {**evidence.unexamined, **unfitting}
    return {
        "before": case.model.before,
        "after": as_part(after, whole, case.declared, silent),
        "estimated": whole,
        "observability": seen,
        "next": advice(fitting, whole, seen, case.logs, silent, not case.others),
    }


def _shown(e: Evidence, logs: list[Recording]) -> dict[str, Any]:
    """The verdict and the evidence for it that a result shows."""
    said = _said(e, logs)
    return {
        "verdict": said.word,
        "reason": said.reason,
        "remarks": said.remarks,
        "added": e.added,
        "changed": e.changed,
        "unexplained": e.unexplained,
        "drift": dict(e.drift),
        "errors": dict(e.errors),
        "attitude": e.attitude,
        "refused": e.refused,
        "band_hz": dict(e.band_hz),
        "not_examined": dict(e.unexamined),
        "candidates": e.fates,
    }


def _unexplained(
    rounded: Collection[str], looks: Mapping[str, Look], noises: Mapping[str, Noise]
) -> tuple[Unexplained, ...]:
    """What no effect accounts for, but of sensors whose reference's rounding looks like it."""
    of = [(looks[k], noises[k]) for k in looks if k in noises and k not in rounded]
    of_inputs = tuple(k.unexplained for k, _ in of if k.unexplained)
    return of_inputs + tuple(s for k, n in of for s in (*k.inconstant, *n.shapes))


def _rounded(found: Found) -> set[str]:
    """The sensors of whose references the rounding has been taken for an effect, or is of a step
    beyond the sensor's own noise, so that it stands and jumps.
    """

    def stands(inv: Investigation) -> bool:
        trials = (t for t in inv.after.trials if any(t.digits))
        return any((np.array(t.digits) > rest_noise(t)).any() for t in trials)

    def is_refused(inv: Investigation) -> bool:
        return any(r.reason == OF_DIGITS for r in inv.refused)

    return {k for k, inv in found.items() if is_refused(inv) or stands(inv)}


def _refused(found: Found, noises: Mapping[str, Noise]) -> tuple[tuple[str, Refused], ...]:
    of_search = [(kind, r) for kind, inv in found.items() for r in inv.refused]
    return (*of_search, *((kind, r) for kind, n in noises.items() for r in n.refused))


def _unshown(found: Found) -> tuple[str, ...]:
    """Which coefficients of each sensor the positions at rest leave open, and what would not."""
    # The accelerometer first: its rests are those that the gyro's turns lie between.
    of_rests = [
        (kind, f.detail)
        for kind, inv in sorted(found.items())
        for t in inv.after.trials
        for f in t.findings
        if f.kind == "not_shown_at_rest"
    ]
    return tuple(
        f"the positions at rest do not show the {SENSORS[kind]}'s {said['effects']}; "
        f"{said['positions']}"
        for kind, said in of_rests
    )


def _kept(looks: Iterable[Look], found: Found) -> tuple[Formula, ...]:
    """The formulas that were found, less those that were taken back."""
    formulas = (k.formula for k in looks if k.formula)
    return tuple(f for f in formulas if any(s.effect == f.name for s in found[f.sensor].steps))


def _findings(
    case: _Settled, say: Callable[[str], None]
) -> tuple[list[Added], list[Changed], dict[str, dict[int, float]]]:
    """The effects that were added, the values that changed, and the axes that wander, by sensor."""
    added, changed, drifts = [], [], {}
    for kind, inv in case.fitting.items():
        say(f"{kind}: what is left")
        noise = case.noises[kind]
        added += _added(kind, case.model.after.sensor(kind), inv)
        added += [*case.model.rounding[kind].added, *noise.added]
        changed += [
            released(case.start.sensor(kind), inv.after, s) for s in inv.steps if s.declared
        ]
        changed += noise.changed
        drifts |= {kind: dict(noise.drift)} if noise.drift else {}
    return added, changed, drifts


def _fates(kind: str, inv: Investigation, added: list[Added], noise: Noise) -> list[Fate]:
    return fates(kind, inv, [a for a in added if a.sensor == kind], noise.unasked)


def _said(evidence: Evidence, logs: list[Recording]) -> Verdict:
    """The verdict; beside a reference that does not fit, the order or time in which it would."""
    said = verdict(evidence)
    if said.word != "reference_unfit":
        return said
    return replace(
        said, remarks=(*filter(None, [other_order(logs), other_time(logs)]), *said.remarks)
    )


def _with_overviews(
    entries: tuple[LogEntry, ...], logs: list[Recording], found: Found, quality: tuple
) -> tuple[LogEntry, ...]:
    pairs = zip(entries, logs, strict=True)
    return tuple(replace(e, overview=_overview(r, found, quality)) for e, r in pairs)


def _overview(r: Recording, found: Found, quality: tuple) -> Overview:
    held = held_trials(found, r.name)
    return overview(r, held, [f for f in quality if f.detail.get("recording") == r.name])


def weightless(quality: Iterable[Finding]) -> set[str]:
    """The logs whose forces are without gravity."""
    return {f.detail["recording"] for f in quality if f.kind == NO_GRAVITY}


def _unexamined(found: Found, logs: list[Recording], quality: Sequence[Finding]) -> dict[str, str]:
    """Why a sensor of the logs was not looked at, by its kind."""
    reasons = {
        "gyro": lambda: "the gyro was not examined: no reference of its rate, and it moves",
        "accel": lambda: f"the accelerometer was not examined: {_no_force(logs)}, and {few(logs)}",
    }
    there = {k for k in reasons if any(getattr(r, k) is not None for r in logs)}
    left_out = weightless(quality)
    if left_out and "accel" not in there:
        told = f"the forces of {joined(sorted(left_out))} are without gravity"
        reasons["accel"] = lambda: f"the accelerometer was not examined: {told}"
        there.add("accel")
    return {k: reason() for k, reason in reasons.items() if k in there - set(found)}


def _dead(found: Found, quality: Sequence[Finding]) -> tuple[str, ...]:
    """The axes of sensors that were looked at which show one value all the time; of zeros nobody
    measured them.
    """
    one = {f.column for f in quality if f.kind == "constant_channel" and f.detail["value"] != 0.0}
    names = {f"{kind}_{axis}": f"the {SENSORS[kind]}'s {axis}" for kind in found for axis in "xyz"}
    return tuple(words for name, words in names.items() if name in one)


def _no_force(logs: list[Recording]) -> str:
    """Why no reference of a log gives the force."""
    if any(has_places(r) for r in logs):
        return (
            "it does not show the force that the reference's positions and attitude make together "
            "(both must be in one east-north-up, and metres)"
        )
    if any(looks_like_degrees(r.reference or r) for r in logs):
        return "no reference of its force (the positions look like degrees, not metres)"
    return "no reference of its force"


def _exhibits(
    found: Found, added: Sequence[Added], formulas: tuple[Formula, ...]
) -> dict[str, Exhibits]:
    return {
        kind: exhibits_of(inv, [a for a in added if a.sensor == kind], formulas)
        for kind, inv in found.items()
    }


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
        note = what_no_log_tells_apart(e, sensor, inv.after.trials, step.alternatives)
        out.append(Added(kind, e.name, step.alternatives, parameters, step.gain, step.gate, note))
    return out


def _standard_errors(fit: Fit, e: Effect, name: str, dispersion: float) -> np.ndarray:
    """Standard errors of a coefficient, zero where it was not estimated."""
    std = np.zeros(e.parameters[name].shape)
    for key, value in fit.std.items():
        if isinstance(key, Coefficient) and (key.effect, key.parameter) == (e.name, name):
            std[key.index] = value * math.sqrt(dispersion)
    return std
