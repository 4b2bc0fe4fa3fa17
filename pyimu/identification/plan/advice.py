"""What to measure next, and how well the model would then be known.

Each proposal is a motion or a temperature of the library of ``plan``, put through the model and the
noise as they were fitted: the standard errors follow from its information, as they do for
``pyimu.plan``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from pyimu.display.brief import Brief
from pyimu.errors import UserError
from pyimu.files import plain
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.mixture import REACH
from pyimu.identification.fit.noise_floor import own_noise, reference_variance
from pyimu.identification.fit.normal import variances
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.found.entries import Visibility
from pyimu.identification.model.estimated import Estimated
from pyimu.identification.plan.apart import separation
from pyimu.identification.plan.information import Information, information, is_shaped
from pyimu.identification.plan.motions import Limits, Motion, library
from pyimu.identification.plan.noise import noise_at
from pyimu.identification.plan.scene import step_of, trial
from pyimu.identification.search.candidates import has_columns, scanned
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.screen import VISIBLE
from pyimu.model.catalogue import CATALOGUE, POWER_ON
from pyimu.model.kinds import KINDS
from pyimu.model.sensor import Sensor
from pyimu.model.typical import magnitudes
from pyimu.recording.recording import Recording
from pyimu.recording.rest import seconds_of
from pyimu.report.numbers import joined, quantity

MOST = 5
"""Proposals that are made: nobody reads to the end of more."""

TRIED = {
    "gyro": ("table_sines", "by_hand", "rest_warmed"),
    "accel": ("six_positions", "rest_warmed"),
}
"""Motions that are proposed to know more; any of the library, to tell effects apart."""

BETTER = 2.0
"""Times by which a coefficient must become better known for a measurement to be proposed."""


@dataclass(frozen=True)
class Gain:
    """How well a coefficient would be known (SI), as half the width of its 95 % interval.

    ``now`` is None where these logs do not show it; ``std`` is the standard error itself.
    """

    effect: str
    parameter: str
    axes: str
    now: float | None
    then: float
    unit: str

    @property
    def factor(self) -> float:
        return np.inf if self.now is None else self.now / self.then

    @property
    def std(self) -> float:
        return self.then / REACH


@dataclass(frozen=True, repr=False)
class Advice(Brief):
    """A measurement that is worth making, and what it would show of a sensor.

    ``why`` says what its gain follows from where that is no noise. ``motion`` names one of the
    library of ``pyimu.plan``, which takes ``duration`` s; ``separates`` are effects that it tells
    apart, by ``distance`` standard errors; ``shows`` that it shows what these logs do not at all.
    """

    sensor: str
    measure: str
    gains: tuple[Gain, ...] = ()
    why: str = ""
    motion: str = ""
    duration: float | None = None
    separates: tuple[str, ...] = ()
    distance: float | None = None
    shows: bool = False

    @property
    def worth(self) -> float:
        return (
            np.inf
            if self.separates or self.shows
            else max((g.factor for g in self.gains), default=1.0)
        )

    def as_dict(self) -> dict[str, Any]:
        gains = [asdict(g) | {"std": g.std} for g in self.gains]
        return plain(asdict(self) | {"gains": gains})


def advice(
    found: Mapping[str, Investigation],
    entries: Sequence[Estimated],
    seen: Sequence[Visibility],
    logs: Sequence[Recording],
    unexamined: Mapping[str, str],
    own_holdout: bool,
) -> tuple[Advice, ...]:
    """At most ``MOST`` measurements, the one that gains most first."""
    made = [a for kind in unexamined for a in _unexamined(kind, logs)]
    for kind, inv in found.items():
        of_kind = ([v for v in vs if v.sensor == kind] for vs in (entries, seen))
        known = _Known(*of_kind)
        made += _more_positions(kind, inv)
        made += _separated(kind, inv)
        made += _planned(kind, inv, known)
        made += _unlogged(kind, inv, seen)
        made += _confounded(kind, entries)
        made += _better_reference(kind, inv)
    if own_holdout:
        made.append(
            Advice(
                "",
                "another log of the same part, given with --holdout",
                why="the end of a log shares its power-on, its mounting and its temperature with "
                "the rows that were fitted",
            )
        )
    # What is not known at all comes first; of equals, what was said first.
    return tuple(sorted(made, key=lambda a: -a.worth)[:MOST])


# What is known now


class _Known:
    """Half widths of 95 % intervals now, by coefficient; None of one that the logs do not show."""

    def __init__(self, entries: Iterable[Estimated], seen: Iterable[Visibility]) -> None:
        self.half: dict[tuple[str, str], np.ndarray] = {}
        for v in entries:
            if v.origin in ("estimated", "added", "changed"):
                # No motion shows what a mounting that nobody knows stands for.
                hidden = np.nan if CATALOGUE[v.effect].mounting and v.note else np.inf
                self.half[v.effect, v.parameter] = np.where(v.shown, REACH * v.std, hidden)
        for s in seen:
            e = CATALOGUE[s.effect]
            name = next(n for n, p in e.parameters.items() if not p.reference)
            if s.smallest_visible is None and not s.reason.startswith("no motion"):
                continue
            std = np.inf if s.smallest_visible is None else s.smallest_visible / VISIBLE
            if has_columns(e, s.sensor) and not scanned(e):
                self.half[s.effect, name] = np.full(e.parameters[name].shape, REACH * std)

    def of(self, key: Coefficient) -> float:
        """Of one coefficient; NaN of one that is held where it is."""
        half = self.half.get((key.effect, key.parameter))
        return np.nan if half is None else float(half[key.index])


def _more_positions(kind: str, inv: Investigation) -> Iterator[Advice]:
    """Positions at rest that would show what those of the logs do not."""
    for f in (f for t in inv.after.trials for f in t.findings if f.kind == "not_shown_at_rest"):
        why = f"these show nothing of the {kind}'s {f.detail['effects']}"
        yield Advice(kind, f.detail["wanted"], why=why, shows=True)


# Measurements that are put through the model


def _separated(kind: str, inv: Investigation) -> Iterator[Advice]:
    """What would tell each effect that was added from those that could stand in for it."""
    if any(t.reduction is not None for t in inv.after.trials):
        return
    for step in inv.steps:
        others = tuple(n for n in step.alternatives if n not in inv.after.sensor.values)
        best = separation(inv.after, step.effect, others)
        if best is not None:
            often = f"{best.times} times " if best.times > 1 else ""
            yield Advice(
                kind,
                f"{often}{best.motion.text}",
                motion=best.motion.name,
                duration=best.duration,
                separates=(step.effect, *others),
                distance=best.distance,
            )


def _planned(kind: str, inv: Investigation, known: _Known) -> Iterator[Advice]:
    fit = inv.after
    if fit.is_reduced:
        return  # the noise of its rows is that of whole rests, not of samples
    for motion in (m for m in library(Limits.of(fit.sensor)) if m.name in TRIED[kind]):
        h = step_of([motion])
        noise = noise_at(fit, motion.frequency, h)
        gains = _gains(fit.sensor, motion, noise, known)
        if gains:
            yield Advice(
                kind,
                motion.text,
                tuple(gains[:3]),
                motion=motion.name,
                duration=motion.duration,
            )


def _gains(
    sensor: Sensor, motion: Motion, noise: Mapping[int, RandomWalk], known: _Known
) -> list[Gain]:
    """The coefficients of which too little is known and that a motion would show.

    First come those of which nothing is known.
    """
    half = [k for k in known.half if k != POWER_ON and _has_slope(sensor, k[0])]
    names = list(dict.fromkeys(e for e, _ in half))
    one = _trial(sensor, motion, noise, names)
    told = information(sensor, one, dict(noise), names)
    gains = [_gain(sensor, told, effect, name, known) for effect, name in half]
    return sorted((g for g in gains if g is not None), key=lambda g: -g.factor)


def _has_slope(sensor: Sensor, effect: str) -> bool:
    """Whether a motion's worth for an effect is known without a guess at the effect's form."""
    e = CATALOGUE[effect]
    return not e.stochastic and (effect in sensor.values or not is_shaped(e, sensor.kind))


def _trial(
    sensor: Sensor, motion: Motion, noise: Mapping[int, RandomWalk], effects: Iterable[str]
) -> Trial:
    signals = frozenset().union(*(CATALOGUE[e].signals(sensor.kind) for e in effects))
    limits = Limits.of(sensor)
    one = _of_library(motion.name, sensor.kind, limits, step_of([motion]), signals)
    return replace(one, axes=tuple(sorted(noise)))


@lru_cache(maxsize=16)
def _of_library(name: str, kind: str, limits: Limits, h: float, signals: frozenset[str]) -> Trial:
    """The trial of a motion, which no log changes."""
    motion = next(m for m in library(limits) if m.name == name)
    return trial([motion], Sensor(kind), limits, h, signals)


def _gain(sensor: Sensor, told: Information, effect: str, name: str, known: _Known) -> Gain | None:
    present, half = effect in sensor.values, known.half[effect, name]
    std = _standard_errors(sensor, told, effect, known)
    size = _typical(effect, sensor.kind, name, "tactical" if present else "consumer")
    better: dict[tuple[int, ...], tuple[float, float]] = {}
    for key, error in sorted(std.items()):
        if (key.effect, key.parameter) == (effect, name):
            now, then = float(half[key.index]), REACH * error
            if then < size < now and BETTER * then < now:
                better[key.index] = now, then
    if not better:
        return None
    now, then = (max(v) for v in zip(*better.values(), strict=True))
    unit = sensor.unit(CATALOGUE[effect].parameters[name].unit)
    whole = len(better) == len(CATALOGUE[effect].parameters[name].indices)
    which = [CATALOGUE[effect].parameters[name].place(index) for index in better if index]
    axes = "all axes" if whole and len(better) > 3 else joined(which)
    return Gain(effect, name, axes, None if np.isinf(now) else now, then, unit)


def _standard_errors(
    sensor: Sensor, told: Information, effect: str, known: _Known
) -> dict[Coefficient, float]:
    """Of an effect's coefficients and of all that the model has, estimated together.

    They come from a motion and from what is known of each now.
    """
    beside = {*sensor.values, effect}
    keys = [k for k in told.keys if k.effect in beside and not np.isnan(known.of(k))]
    now = np.array([known.of(k) for k in keys])
    std = np.sqrt(variances(told.on(keys).gram + np.diag((now / REACH) ** -2.0)))
    return dict(zip(keys, map(float, std), strict=True))


def _typical(effect: str, kind: str, parameter: str, of: str) -> float:
    """The size of a coefficient in a class of parts; infinite where none is known."""
    try:
        typical = magnitudes(effect, kind)[of]
    except UserError:
        return np.inf
    return typical.si if typical.parameter == parameter else np.inf


# Measurements that follow from a reason


def _unexamined(kind: str, logs: Sequence[Recording]) -> Iterator[Advice]:
    if kind == "gyro":
        yield Advice(kind, "a reference of the rate or of the attitude", why="the log has none")
        return
    r = next((r for r in logs if r.accel is not None), None)
    if r is None:
        yield Advice(kind, "the accelerometer's own forces", why="these are without gravity")
        return
    motion = next(m for m in library() if m.name == "six_positions")
    white = [seconds_of(c, r.segments, r.sample_period).white for c in r.accel.T]
    per_row = r.sample_period / step_of([motion])
    noise = {i: RandomWalk(max(w, 1e-9) ** 2 * per_row, 0.0) for i, w in enumerate(white)}
    effects = ("scale_factor", "misalignment")
    known = _Known((), ())
    for effect in effects:
        name, q = next(iter(CATALOGUE[effect].parameters.items()))
        known.half[effect, name] = np.full(q.shape, np.inf)
    gains = _gains(Sensor(kind), motion, noise, known)
    why = "figured from its white noise alone"
    yield Advice(kind, motion.text, tuple(gains), why, motion.name, motion.duration)


def _confounded(kind: str, entries: Iterable[Estimated]) -> Iterator[Advice]:
    """What would tell an effect of the model from what no log tells it from."""
    effects = dict.fromkeys(v.effect for v in entries if v.sensor == kind and v.note)
    for effect in effects:
        confound = CATALOGUE[effect].confound
        if confound is not None:
            why = f"no log tells {effect.replace('_', ' ')} from {confound.of}"
            yield Advice(kind, confound.apart, why=why)


def _unlogged(kind: str, inv: Investigation, seen: Iterable[Visibility]) -> Iterator[Advice]:
    if any("temperature" not in t.known for t in inv.after.trials):
        effects = [
            v.effect
            for v in seen
            if v.sensor == kind and "temperature" in CATALOGUE[v.effect].signals(kind)
        ]
        if effects:
            why = f"without it nobody can look for {joined(effects)}"
            yield Advice(kind, "log the temperature of the part", why=why)


def _better_reference(kind: str, inv: Investigation) -> Iterator[Advice]:
    """Where the reference's noise hides the sensor's own in the band."""
    added, own = reference_variance(inv.after), own_noise(inv.after)
    share = np.mean([np.sum(np.square(t.band.weights)) for t in inv.after.trials])
    if not own or not np.any(added):
        return
    theirs = float(np.sqrt(np.mean([added[i] for i in own])))
    ours = float(np.sqrt(np.mean([n.r for n in own.values()]) * share))
    if theirs > BETTER * ours:
        unit = KINDS[kind].unit
        why = (
            f"in its band the reference adds {quantity(theirs, unit)} of noise, the "
            f"sensor's own is {quantity(ours, unit)}"
        )
        yield Advice(kind, "a reference with less noise", why=why)
