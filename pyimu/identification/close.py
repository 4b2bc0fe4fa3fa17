"""Close the loop: recordings in, the effects that the model lacks named and added, the error before
and after out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.identification.attitude_error import attitude_error
from pyimu.identification.fit.attenuation import floor_noise
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import slot_key
from pyimu.identification.fit.score import Tally, floor, held_state, tally
from pyimu.identification.fit.trial import Trial, accel_trial, gyro_trial, rest_noise
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.outcome import Added, Changed, Errors, LogEntry, Visibility
from pyimu.identification.result import Closed
from pyimu.identification.search.candidates import absent, has_columns
from pyimu.identification.search.forward import Investigation, Step, investigate
from pyimu.identification.search.leftover import (
    NoiseFigure,
    comb_gain,
    drift,
    lack_of_fit,
    noise_figures,
    rounding,
    walk_gain,
)
from pyimu.identification.search.screen import PENALTY
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.model.sensor import Sensor
from pyimu.recording.log import read_recording
from pyimu.recording.names import distinct_names
from pyimu.recording.quality.inspect import inspect
from pyimu.recording.recording import Recording

HELD_OUT = 0.3
"""Share of each log, its end, that is held out where no log is named for it."""

BAND_SHARE = 0.75
"""Share of the band in which gyro and derived reference agree that is used: at its edge a tenth of
the power is noise."""

FAR = 1.5
"""Ratio of the held-out error to its floor from which on the verdict says so."""

CONTRADICTION = 4.0
"""Standard errors by which data must differ from a declared noise to contradict it."""

SHORT = 500
"""Fitted rows below which finding nothing says nothing."""

SHORTEST = 64
"""Rows of a log below which nothing can be said of it."""

STRUCTURE = (
    "scale_factor",
    "misalignment",
    "turn_on_bias",
    "angle_random_walk",
    "rate_random_walk",
)
"""Baseline of a log whose part nobody declared: Hidalgo's structure less its thermal term, every
coefficient estimated."""

Log = Recording | str | Path


def close(
    recordings: Sequence[Log] | Log,
    part: Part | str | Path | None = None,
    holdout: Sequence[Log] | Log | None = None,
    *,
    latitude: float | None = None,
    say: Callable[[str], None] = lambda text: None,
) -> Closed:
    """Find what a sensor's model lacks to explain measured logs, and how much of the error that
    was.

    ``recordings`` are Recordings or paths; ``part`` is a Part, the name of a built-in one, a TOML
    path, or None for the baseline structure with every coefficient estimated. Without ``holdout``
    the last 30 % of each log is held out. ``latitude`` [rad] adds the Earth's rate to a reference
    rate derived from an attitude. Raises UserError for logs that cannot be read, are too short, or
    do not excite what the part asks to be estimated.
    """
    logs = [_read(r) for r in _many(recordings)]
    if not logs:
        raise UserError("no log given: name at least one recording")
    others = [_read(r) for r in _many(holdout)] if holdout is not None else []
    names = distinct_names([*logs, *others])
    logs = [replace(r, name=n) for r, n in zip(logs, names, strict=False)]
    others = [replace(r, name=n) for r, n in zip(others, names[len(logs) :], strict=True)]
    declared = find_part(part) if isinstance(part, (str, Path)) else part
    start = declared or Part(
        "estimated",
        logs[0].sample_rate,
        Sensor("gyro", {n: {} for n in STRUCTURE}),
        Sensor("accel", {n: {} for n in STRUCTURE}),
    )
    say("quality of the raw samples")
    quality = [_of(r.name, f) for r in [*logs, *others] for f in (*r.findings, *inspect(r))]
    found: dict[str, Investigation] = {}
    for kind, make in (("gyro", gyro_trial), ("accel", accel_trial)):
        trials, held = _trials(kind, make, logs, others, latitude)
        quality += list(
            {
                (t.name, f.kind): _of(t.name, f) for t in (*trials, *held) for f in t.findings
            }.values()
        )
        if trials:
            sensor = start.sensor(kind)
            found[kind] = investigate(
                sensor, _free(start, declared is None, sensor, trials), trials, held, say
            )
    if not found:
        if any(has_reference(r) for r in logs):
            raise UserError(
                f"{logs[0].name}: too short to say anything: fewer than {SHORTEST} rows that "
                "sensor and reference both cover"
            )
        raise UserError(
            f"{logs[0].name}: nothing to compare: the log has no reference (ref_rate, ref_q, "
            "ref_heading or ref_force) "
            "and moves; a log without reference must stand still"
        )
    return _conclude(start, declared, logs, others, found, tuple(quality), say)


def _of(name: str, finding: Finding) -> Finding:
    """A finding that says which log it is about."""
    return replace(finding, detail={"recording": name, **finding.detail})


def _many(value) -> list:
    return [value] if isinstance(value, (Recording, str, Path)) else list(value)


def _read(log: Log) -> Recording:
    recording = log if isinstance(log, Recording) else read_recording(log)
    if len(recording.time) < SHORTEST:
        raise UserError(
            f"{recording.name}: too short to say anything: {len(recording.time)} rows, at least "
            f"{SHORTEST} are needed"
        )
    return recording


def has_reference(recording: Recording) -> bool:
    return any(
        v is not None
        for v in (recording.ref_rate, recording.ref_q, recording.ref_heading, recording.ref_force)
    )


def is_static(recording: Recording) -> bool:
    """True where no reference is given and the samples, averaged over a second, stay put."""
    if has_reference(recording):
        return False
    length = max(1, round(1.0 / recording.sample_period))
    for values, limit in ((recording.gyro, 0.05), (recording.accel, 0.5)):
        if values is None or len(values) < 2 * length:
            continue
        means = values[: len(values) // length * length].reshape(-1, length, 3)
        means = np.nanmean(means, axis=1) if length > 1 else means[:, 0]
        if np.nanmax(np.abs(means - np.nanmedian(means, axis=0))) > limit:
            return False
    return True


def _trials(
    kind: str, make: Callable, logs: list[Recording], others: list[Recording], latitude
) -> tuple[list[Trial], list[Trial]]:
    """Trials to fit and to judge by, all seen through one band."""

    def trial(r: Recording) -> Trial | None:
        static = is_static(r)
        if kind == "accel":
            return make(r, static)
        return make(r, latitude) if static or has_reference(r) else None

    fitted = [t for t in map(trial, logs) if t is not None and t.count >= SHORTEST]
    apart = [t for t in map(trial, others) if t is not None and t.count >= SHORTEST]
    bands = [t.band_hz for t in fitted if t.band_hz is not None]
    if bands:
        band = BAND_SHARE * float(np.median(bands))
        fitted, apart = ([replace(t, band_hz=band) for t in ts] for ts in (fitted, apart))
    if others:
        return fitted, apart
    halves = [(a, b) for a, b in (t.split(HELD_OUT) for t in fitted) if a.count >= SHORTEST // 2]
    return [a for a, _ in halves], [b for _, b in halves if b.count]


def _free(start: Part, everything: bool, sensor: Sensor, trials: list[Trial]) -> frozenset:
    """Keys of the coefficients to estimate: all of the structure, or those that the part leaves to
    the data.
    """
    names = [
        s
        for s in sensor.slots
        if not CATALOGUE[s.effect].stochastic
        and s.effect != "turn_on_bias"
        and not s.definition.reference
    ]
    wanted = {
        slot_key(s)
        for s in names
        if everything or (sensor.kind, s.effect, s.parameter) in start.estimate
    }
    if all(t.free_rotation for t in trials):
        # A turn of the whole triad is the mounting's; what misalignment has of its own is three
        # angles, not six.
        wanted = {k for k in wanted if k[1] != "misalignment" or k[3][0] < k[3][1]}
    moving = any(t.reference != "static" for t in trials)
    for s in names:
        needs_motion = CATALOGUE[s.effect].stage in ("dynamics", "gain")
        if not everything and slot_key(s) in wanted and needs_motion and not moving:
            raise UserError(
                f"{trials[0].name}: no motion, yet part {start.name} asks to estimate "
                f"{sensor.kind}.{s.effect}.{s.parameter}; "
                "give a log that moves, with a reference, or declare the value"
            )
    return frozenset(wanted)


def _conclude(
    start: Part,
    declared: Part | None,
    logs,
    others,
    found: dict[str, Investigation],
    quality: tuple,
    say,
) -> Closed:
    """Put verdict, models and scores together."""
    after, before, added, changed, drifts = start, start, [], [], {}
    for kind, inv in found.items():
        say(f"{kind}: what is left")
        figures = noise_figures(inv.after)
        steps = _rounding(kind, inv)
        before = before.with_sensor(_finished(declared, inv.before))
        sensor = _finished(declared, inv.after)
        for a in steps:
            sensor = sensor.with_values(a.effect, **{n: v for n, (v, _, _) in a.parameters.items()})
        after = after.with_sensor(sensor)
        added += added_of(kind, sensor, inv) + steps
        changed += [_released(start.sensor(kind), inv.after, s) for s in inv.steps if s.declared]
        if declared is not None and figures:
            changed += [] if steps else _changed(start, kind, inv.after, figures)
            drifts |= {} if steps else _drift(kind, inv.after, start.sensor(kind))
    unexplained = tuple(u for u in (lack_of_fit(inv.after) for inv in found.values()) if u)
    say("error on held-out data")
    errors, entries, likelihood = _scores(found, logs, others)
    verdict, reason = _verdict(added, changed, unexplained, drifts, found)
    reason += "".join(
        _far_from_floor(k, e) for k, e in errors.items() if not found[k].after.trials[0].band_hz
    )
    say("attitude against the reference")
    attitude = _attitude(before, after, found.get("gyro"), logs, others)
    refused = tuple((k, r) for k, inv in found.items() for r in inv.refused)
    return Closed(
        verdict,
        reason,
        before,
        replace(after, estimate=frozenset()),
        tuple(added),
        tuple(changed),
        unexplained,
        drifts,
        tuple(v for k, inv in found.items() for v in _observability(k, inv)),
        errors,
        likelihood,
        attitude,
        quality,
        entries,
        refused,
        found,
        {k: inv.after.trials[0].band_hz for k, inv in found.items()},
        "holdout" if others else "last 30 %",
    )


def _finished(declared: Part | None, fit: Fit) -> Sensor:
    """The fitted sensor with what no regressor carries: bias, and for an undeclared part the noise
    found.
    """
    sensor = fit.sensor
    if declared is not None:
        return sensor
    figures = noise_figures(fit)
    if figures:
        n, k = (
            np.array([getattr(figures.get(i, NoiseFigure(0, 0, 0, 0)), name) for i in range(3)])
            for name in ("N", "K")
        )
    else:
        # A differentiated reference hides the sensor's own noise; its quiet stretches show the
        # white part only.
        n, k = (
            np.nan_to_num(np.mean([rest_noise(t) for t in fit.trials], axis=0))
            * np.sqrt(fit.trials[0].h),
            np.zeros(3),
        )
    bias = np.mean([fit.states[t.name].bias for t in fit.trials], axis=0)
    return (
        sensor.with_values("turn_on_bias", b0=bias)
        .with_values("angle_random_walk", N=n)
        .with_values("rate_random_walk", K=k)
    )


def _rounding(kind: str, inv: Investigation) -> list[Added]:
    """Rounding as an added effect where its steps are seen in the raw samples and weigh against the
    noise.
    """
    sensor = inv.after.sensor
    if "quantization" in sensor.values or not all(
        isinstance(n, RandomWalk) for n in inv.after.noise.values()
    ):
        # Against a differentiated reference the steps vanish in its noise; they stay a finding
        # about the raw samples.
        return []
    white = np.array(
        [np.sqrt(inv.after.noise[i].r) if i in inv.after.noise else np.nan for i in range(3)]
    )
    steps = rounding(inv.after.trials, white)
    if not steps:
        return []
    q = np.array([steps.get(i, 0.0) for i in range(3)])
    gain = comb_gain(inv.after.trials, steps)
    return [
        Added(
            kind,
            "quantization",
            (),
            {"q": (q, np.zeros(3), sensor.unit("{y}"))},
            gain,
            PENALTY * len(steps),
            "every raw sample lies on a comb of these steps",
        )
    ]


def _changed(start: Part, kind: str, fit: Fit, figures: dict[int, NoiseFigure]) -> list[Changed]:
    """Declared noise that the data contradict as clearly as four standard errors, and by 2 %.

    Rounding adds to the noise, so where it is declared nothing is said.
    """
    out, declared = [], start.sensor(kind)
    for effect, name in (("angle_random_walk", "N"), ("rate_random_walk", "K")):
        if (
            effect not in declared.values
            or "quantization" in declared.values
            or (kind, effect, name) in start.estimate
        ):
            continue
        had = declared.values[effect][name]
        fitted, std = (
            np.array(
                [getattr(figures[i], name + tail) if i in figures else np.nan for i in range(3)]
            )
            for tail in ("", "_std")
        )
        # The likelihood of a random walk is too skew for a standard error to judge by.
        surprise = (
            np.sqrt(2 * np.maximum(walk_gain(fit, had), 0.0))
            if name == "K"
            else np.abs(fitted - had) / std
        )
        with np.errstate(invalid="ignore"):
            off = (surprise > CONTRADICTION) & (np.abs(fitted - had) > 0.02 * had)
        if off.any():
            out.append(
                Changed(
                    declared.kind,
                    effect,
                    name,
                    np.array(had),
                    fitted,
                    std,
                    declared.unit(CATALOGUE[effect].parameters[name].unit),
                )
            )
    return out


def _released(declared: Sensor, fit: Fit, step: Step) -> Changed:
    """A declared coefficient that the data contradict, with what they say instead."""
    name = next(n for n, p in CATALOGUE[step.effect].parameters.items() if not p.reference)
    fitted = fit.sensor.values[step.effect][name]
    std = np.zeros(fitted.shape)
    for key in step.keys:
        std[key[3]] = fit.std.get(key, np.nan) * np.sqrt(step.dispersion)
    unit = declared.unit(CATALOGUE[step.effect].parameters[name].unit)
    return Changed(
        declared.kind,
        step.effect,
        name,
        np.array(declared.values[step.effect][name]),
        np.array(fitted),
        std,
        unit,
    )


def _drift(kind: str, fit: Fit, declared: Sensor) -> dict[str, dict[int, float]]:
    k = (
        declared.values["rate_random_walk"]["K"]
        if "rate_random_walk" in declared.values
        else np.zeros(3)
    )
    if "angle_random_walk" not in declared.values:
        return {}
    found = drift(fit, np.asarray(k))
    return {kind: found} if found else {}


def _scores(
    found: dict[str, Investigation], logs, others
) -> tuple[dict[str, Errors], tuple[LogEntry, ...], tuple[float, float] | None]:
    """Held-out errors of each sensor, in all and by recording, and the log-likelihood per
    sample.
    """
    errors, by_log, likelihood = {}, {r.name: {} for r in [*logs, *others]}, None
    for kind, inv in found.items():
        unit = inv.after.sensor.output.unit
        total = [Tally(), Tally(), Tally()]
        noise = floor_noise(inv.after)
        for trial in inv.held:
            three = [
                tally(inv.before, trial),
                tally(inv.after, trial),
                floor(noise, inv.after, trial),
            ]
            by_log[trial.name][kind] = Errors(unit, *three)
            total = [a + b for a, b in zip(total, three, strict=True)]
        if inv.held:
            errors[kind] = Errors(unit, *total)
            rows = max(total[0].rows.max(), 1.0)
            pair = (total[0].log_likelihood / rows, total[1].log_likelihood / rows)
            likelihood = (
                pair if likelihood is None else (likelihood[0] + pair[0], likelihood[1] + pair[1])
            )
    entries = []
    for r in [*logs, *others]:
        held = [t for inv in found.values() for t in inv.held if t.name == r.name]
        states = {k: _state_entry(inv, r.name) for k, inv in found.items()}
        entries.append(
            LogEntry(
                r.path.name if r.path else r.name,
                len(r.time),
                max((len(t.time) for t in held), default=0),
                by_log[r.name],
                {k: s for k, s in states.items() if s},
            )
        )
    return errors, tuple(entries), likelihood


def _attitude(
    before: Part, after: Part, inv: Investigation | None, logs, others
) -> tuple[float, float] | None:
    """RMS error [rad] of the attitude filter with the model before and after, over the held-out
    rows that ``ref_q`` covers.
    """
    squares, rows = np.zeros(2), 0
    for r in others or logs:
        held = (
            None
            if inv is None or r.ref_q is None or r.accel is None
            else next((t for t in inv.held if t.name == r.name), None)
        )
        if held is None:
            continue
        mounting = np.array(_state_entry(inv, r.name)["rotation"])
        pair = [
            attitude_error(r, p, mounting, len(r.time) - len(held.time)) for p in (before, after)
        ]
        squares += [np.sum(e.total**2) for e in pair]
        rows += len(pair[0].total)
    return tuple(np.sqrt(squares / rows).tolist()) if rows else None


def _state_entry(inv: Investigation, name: str) -> dict | None:
    """What was estimated of a log itself, under the model after."""
    state = inv.after.states.get(name)
    if state is None:
        held = next((t for t in inv.held if t.name == name), None)
        if held is None:
            return None
        state = held_state(inv.after, held)[0]
    return {"bias": state.bias.tolist(), "rotation": state.rotation.tolist()}


def _observability(kind: str, inv: Investigation) -> list[Visibility]:
    """What the logs could have shown of each absent effect, judged before looking for any."""
    seen = {c.effect: c for c in inv.first.candidates}
    out = []
    for e in CATALOGUE.values():
        if (
            kind not in e.sensors
            or e.name in inv.before.sensor.values
            or e.name == "turn_on_bias"
            or not (has_columns(e, kind) or e.name == "quantization")
        ):
            continue
        p = next(p for p in e.parameters.values() if not p.reference)
        unit = inv.before.sensor.unit(p.unit)
        if e.name in seen and np.isfinite(seen[e.name].smallest_visible):
            out.append(
                Visibility(
                    kind, e.name, seen[e.name].smallest_visible, unit, seen[e.name].inseparable_from
                )
            )
        else:
            known = {s.name for s in absent(inv.before)}
            why = (
                "looked for in the raw samples"
                if e.name == "quantization"
                else (
                    "no motion excites it"
                    if e.name in known
                    else "the log lacks "
                    f"{', '.join(sorted(e.signals(kind) - inv.before.trials[0].known))}"
                )
            )
            out.append(Visibility(kind, e.name, None, unit, (), why))
    return out


def _far_from_floor(kind: str, e: Errors) -> str:
    """What must be added to any verdict where the noise does not account for what is left."""
    if e.floor is None or not e.after.total > FAR * e.floor.total:
        return ""
    return (
        f"; the {kind} residual that is left is {e.after.total / e.floor.total:.1f} times what its "
        "noise accounts for"
    )


def _verdict(
    added: list, changed: list, unexplained: tuple, drifts: dict, found: dict[str, Investigation]
) -> tuple[str, str]:
    if added:
        return "named", ", ".join(f"{a.sensor} {a.effect}" for a in added)
    if unexplained:
        u = unexplained[0]
        return "unexplained", f"{u.sensor} {u.axis} depends on {' x '.join(u.depends_on)}"
    if drifts:
        return "drift", "more random walk than declared: an input that nobody logged"
    # What only time drives shows in any log; it says nothing about the effects that people ask for.
    if not any(
        np.isfinite(c.smallest_visible)
        for kind, inv in found.items()
        for c in inv.first.candidates
        if "time" not in CATALOGUE[c.effect].signals(kind)
    ):
        return (
            "undecidable",
            "no motion and no temperature: these logs could show little of what may be missing",
        )
    if max(sum(t.count for t in inv.after.trials) for inv in found.values()) < SHORT:
        return (
            "undecidable",
            f"fewer than {SHORT} rows were there to fit: too short to miss an effect in",
        )
    return "clean", "nothing is missing" + (
        "; declared values that the data contradict are listed as changed" if changed else ""
    )


def added_of(kind: str, sensor: Sensor, investigation: Investigation) -> list[Added]:
    """The steps of an investigation with the coefficients as they stand at its end."""
    out = []
    for step in (s for s in investigation.steps if not s.declared):
        e = CATALOGUE[step.effect]
        parameters = {}
        for name, p in e.parameters.items():
            std = np.zeros(p.shape)
            for key, value in investigation.after.std.items():
                if key[0] == "slot" and key[1] == step.effect and key[2] == name:
                    std[key[3]] = value * math.sqrt(step.dispersion)
            parameters[name] = (sensor.values[step.effect][name], std, sensor.unit(p.unit))
        out.append(
            Added(
                kind,
                step.effect,
                step.alternatives,
                parameters,
                step.gain,
                step.gate,
                _note(step.effect, parameters),
            )
        )
    return out


def _note(effect: str, parameters: dict) -> str:
    """What must be said of classes that no log separates."""
    if effect not in ("time_delay", "lag"):
        return ""
    delay = (
        float(parameters["td"][0])
        if effect == "time_delay"
        else float(2 * parameters["zeta"][0] / parameters["wn"][0])
    )
    return (
        f"time_delay and lag are one class: an effective delay of {delay * 1e3:.2f} ms of the "
        "sensor against the reference; "
        "the sensor's bandwidth, its sampling and the reference's clock cannot be told apart"
    )
