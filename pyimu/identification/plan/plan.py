"""Plan the next experiment: ``pyimu.plan``."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from pyimu.display.silent import silent
from pyimu.errors import UserError
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.plan.choice import LONGEST, Chooser, Question
from pyimu.identification.plan.goals import (
    Goal,
    at_typical,
    class_of,
    goals,
    left_to_data,
    sensor_of,
    wanted_errors,
)
from pyimu.identification.plan.information import Information, information
from pyimu.identification.plan.motions import Limits, Motion, library
from pyimu.identification.plan.noise import declared_noise
from pyimu.identification.plan.outcome import Log, Pair, Predicted, Step
from pyimu.identification.plan.reasons import (
    confound_note,
    hidden,
    not_known,
    not_planned,
    too_small,
)
from pyimu.identification.plan.result import Plan
from pyimu.identification.plan.scene import STEP, recorded, step_of, trial_of
from pyimu.model.catalogue import CATALOGUE, WHITE, read_off
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.model.sensor import Sensor
from pyimu.model.typical import magnitudes
from pyimu.numerics.threads import on_one_thread
from pyimu.recording.recording import Recording
from pyimu.report.numbers import quantity

SIGMAS = 8.0
"""Standard errors that an effect's size is to be, unless somebody says otherwise."""

LONG = 600.0
"""s; from then on the random walk of a sensor is most of its noise."""

RELAXED = 1.25
"""Times by which the wanted errors grow until a plan is found that is no day's work."""

TRIED, CHOSEN = 0.2, 0.7
"""Shares of the work until the motions are tried, and until the plan is made of them; the rest is
the page and the files. They differ with the plan's length: so it is for one of an hour."""

Say = Callable[..., None]


@on_one_thread
def plan(
    part: Part | str | os.PathLike,
    effects: str | Sequence[str],
    sensor: str | None = None,
    within: Sequence[str] | str = (),
    sigmas: float = SIGMAS,
    say: Say = silent,
) -> Plan:
    """The shortest set of motions that would show effects of a part, and how well.

    ``part`` is a Part, the name of a built-in one or a file; ``effects`` are names of the
    catalogue, looked at together; ``sensor`` is "gyro" or "accel", by itself the first that has
    them. Each coefficient is wanted to a standard error of its declared or else typical size over
    ``sigmas``, or as ``within`` says: a number with its unit, as "0.5 deg/h/K", with several
    effects "EFFECT=0.5 deg/h/K".

    What is predicted is the Cramer-Rao bound of the columns by which ``close`` fits, with the noise
    that the part declares and none of the reference, the bias of each log and what the part leaves
    to the data estimated beside it (Kay 1993, eq. 3.31). ``say(text, share)`` hears what is being
    done. Raises UserError for an unknown part, effect or sensor, and for a ``within`` that is no
    standard error.
    """
    part = find_part(part)
    names = tuple(dict.fromkeys([effects] if isinstance(effects, str) else effects))
    kind = sensor_of(names, sensor)
    texts = [within] if isinstance(within, str) else within
    if not sigmas > 0.0:
        raise UserError(f"sigmas {sigmas:g}: must be positive")
    asked = goals(part, kind, names, sigmas, wanted_errors(texts, kind, names))
    return _Planner(part, kind, names, sigmas, asked, say).plan()


@dataclass
class _Planner:
    """Everything that a plan is made of."""

    part: Part
    kind: str
    names: tuple[str, ...]
    sigmas: float
    asked: list[Goal]
    say: Say

    def __post_init__(self) -> None:
        self.sensor = self.part.sensor(self.kind)
        self.limits = Limits.of(*self._kept())
        self.signals = frozenset().union(*(CATALOGUE[n].signals(self.kind) for n in self.names))
        self.motions = [m for m in library(self.limits) if self._matters(m)]
        self.values = {n: at_typical(self.sensor, self.part, n) for n in self.names}
        self.free = left_to_data(self.part, self.sensor)
        self.beside = {*self.names, *(k.effect for k in self.free)}
        self.noisy, self.noise = noise_model(self.part, self.kind)
        self.reasons = {n: self._why_not(n) for n in self.names}
        self.looked = [n for n in self.names if not self.reasons[n]]

    def _matters(self, motion: Motion) -> bool:
        """Whether what a motion changes beside the motion itself is felt by what is asked."""
        warmed = {"temperature", "temperature_rate"} & self.signals
        return bool(warmed or not motion.warm) and ("supply" in self.signals or not motion.supply)

    def _kept(self) -> list[Sensor]:
        """The sensors to whose ranges the motions keep: not that of which a range is asked."""
        past = read_off([CATALOGUE[n] for n in self.names], "ceiling") is not None
        return [s for s in (self.part.gyro, self.part.accel) if not past or s.kind != self.kind]

    def _why_not(self, name: str) -> str:
        short = recorded(self.motions[:1], self.limits, 60.0, self.signals)
        e = CATALOGUE[name]
        return not_planned(e) or not_known(e, self.kind, trial_of(short, self.kind))

    def plan(self) -> Plan:
        found = []
        for i, m in enumerate(self.motions):
            self.say(f"trying {m.name.replace('_', ' ')}", TRIED * i / len(self.motions))
            found.append(self._of([m]))
        self.say("choosing", TRIED)
        counts, why = self._chosen(found)
        self.say("the plan itself", TRIED)
        logs = self._logs(counts)
        total = self._total(logs, found, counts) if logs else Information((), np.zeros((0, 0)))
        keys = self._keys(total)
        errors = self._errors(total)
        return Plan(
            part=self.part.name,
            kind=self.kind,
            effects=self.names,
            of_class=class_of(self.part, self.kind),
            sigmas=self.sigmas,
            noise=self.noise,
            logs=logs,
            predicted=tuple(self._predicted(g, errors, why) for g in self.asked),
            by_motion={m.name: self._errors(i) for m, i in zip(self.motions, found, strict=True)},
            library=tuple(Log((Step(m, 1),), self._shown(m)) for m in self.motions),
            pairs=tuple(self._pairs(found, total.on(keys))),
            notes=self._notes(sum(s.duration for log in logs for s in log.steps)),
        )

    def _shown(self, motion: Motion) -> Recording:
        """A motion as it is drawn."""
        return recorded([motion], self.limits, step_of([motion]), self.signals)

    def _of(
        self, motions: Sequence[Motion], heard: Callable[[float], None] = silent
    ) -> Information:
        """What motions one after the other show; ``heard`` hears which share of that is done."""
        h = step_of(motions, self.part.sample_period, self.beside)
        log = recorded(motions, self.limits, h, self.signals)
        heard(1 / 4)
        one = trial_of(log, self.kind, all(m.fixed for m in motions))
        heard(3 / 4)
        noise = declared_noise(self.noisy, h, self.part.sample_period)
        return information(self.sensor, one, noise, self.looked, self.free, self.values)

    # What is asked, of what can be shown

    def _keys(self, found: Information) -> tuple[Coefficient, ...]:
        return tuple(sorted({*found.keys, *(g.key for g in self.asked), *self.free}))

    def _errors(self, found: Information) -> dict[Coefficient, float]:
        """Of all asked coefficients together; of an effect that only alone is shown, alone."""
        errors = found.on(self._keys(found)).errors()
        return {g.key: errors[g.key] for g in self.asked}

    def _chosen(self, found: Sequence[Information]) -> tuple[list[int], dict[Coefficient, str]]:
        """How often to do each motion, and why some coefficients are not shown by that."""
        most = [i.times(LONGEST / m.duration) for i, m in zip(found, self.motions, strict=True)]
        total = sum(most[1:], most[0])
        keys = self._keys(total)
        joint = total.on(keys)
        errors, why, wanted = joint.errors(), {}, {}
        for g in self.asked:
            std = errors[g.key]
            if self.reasons[g.key.effect]:
                why[g.key] = self.reasons[g.key.effect]
            elif not np.isfinite(std):
                why[g.key] = hidden(g, total, joint, self.looked)
            elif g.wanted is not None and std > g.wanted:
                why[g.key] = too_small(g, std)
            elif g.wanted is not None:
                wanted[g.key] = g.wanted
        if not wanted:
            return [0] * len(found), why
        return self._shortest(found, keys, wanted), why

    def _shortest(self, found, keys, wanted: Mapping[Coefficient, float]) -> list[int]:
        durations = [m.duration for m in self.motions]
        while True:
            counts = Chooser(found, durations, [Question(keys, wanted)]).shortest()
            if counts is not None:
                return counts
            wanted = {k: RELAXED * w for k, w in wanted.items()}

    # The plan

    def _logs(self, counts: Sequence[int]) -> tuple[Log, ...]:
        """Logs of motions that share a reference: with a known mounting or not, at rest or not."""
        steps = [Step(m, n) for m, n in zip(self.motions, counts, strict=True) if n]
        kinds = dict.fromkeys((s.motion.fixed, s.motion.still) for s in steps)
        logs = []
        for which in kinds:
            some = tuple(s for s in steps if (s.motion.fixed, s.motion.still) == which)
            motions = [s.motion for s in some for _ in range(s.times)]
            h = step_of(motions, self.part.sample_period)
            logs.append(Log(some, recorded(motions, self.limits, h, self.signals)))
        return tuple(logs)

    def _total(
        self, logs: Sequence[Log], found: Sequence[Information], counts: Sequence[int]
    ) -> Information:
        """What all logs show; where their rows are many, as if each motion were a log."""
        if step_of(self.motions, effects=self.beside) < STEP:
            done = [i.times(n) for i, n in zip(found, counts, strict=True) if n]
            return sum(done[1:], done[0])
        made, size = [], sum(len(log.recording) for log in logs)
        for log in logs:
            behind = sum(len(before.recording) for before in logs[: len(made)])

            def heard(share: float, behind: int = behind, own: int = len(log.recording)) -> None:
                done = (behind + share * own) / size
                self.say("the plan itself", TRIED + (CHOSEN - TRIED) * done)

            made.append(self._of([s.motion for s in log.steps for _ in range(s.times)], heard))
        return sum(made[1:], made[0])

    def _predicted(
        self, g: Goal, errors: Mapping[Coefficient, float], why: Mapping[Coefficient, str]
    ) -> Predicted:
        std = errors.get(g.key, np.inf)
        reason = why.get(g.key, "")
        if not reason and not np.isfinite(std):
            reason = "these motions do not show it, and nothing was wanted of it"
        return Predicted(g, std, reason)

    def _pairs(self, found: Sequence[Information], total: Information):
        named = [(m.name, i) for m, i in zip(self.motions, found, strict=True)]
        for pair in combinations(self.looked, 2):
            for motion, i in [*named, (None, total)]:
                yield self._pair(motion, i, pair)

    def _pair(self, motion: str | None, found: Information, pair: tuple[str, str]) -> Pair:
        keys = [[k for k in found.keys if k.effect == n] for n in pair]
        beside = [k for k in found.keys if k in self.free and k not in (*keys[0], *keys[1])]
        errors = found.on([*keys[0], *keys[1], *beside]).errors()
        left = self._beside(found, [*keys[0], *keys[1]], beside)
        distances = [
            g.size / errors[g.key]
            for g in self.asked
            if g.wanted is not None and g.size and np.isfinite(errors.get(g.key, np.inf))
        ]
        return Pair(motion, pair, left.canonical(*keys), min(distances, default=0.0))

    def _beside(self, found: Information, keys, beside) -> Information:
        """What is left of the information on some coefficients beside others."""
        if not beside:
            return found.on(keys)
        g = found.on([*keys, *beside]).gram
        n = len(keys)
        left = g[:n, :n] - g[:n, n:] @ np.linalg.pinv(g[n:, n:], rcond=1e-12) @ g[n:, :n]
        return Information(tuple(keys), left)

    def _notes(self, duration: float) -> tuple[str, ...]:
        notes = [confound_note(CATALOGUE[n]) for n in self.names]
        if duration > LONG and not self._walks():
            notes.append(
                "the part declares no random walk: what takes longer than minutes would be known "
                "less well than this says"
            )
        return tuple(dict.fromkeys(n for n in notes if n))

    def _walks(self) -> bool:
        return any(n.k2 > 0.0 for n in declared_noise(self.noisy, 1.0, 1.0).values())


def noise_model(part: Part, kind: str) -> tuple[Sensor, str]:
    """The sensor whose noise a plan reckons with, and that noise in words: a part that declares
    none has the typical one of its class.
    """
    sensor = part.sensor(kind)
    effect, parameter = WHITE
    white = sensor.values.get(effect, {}).get(parameter)
    unit = sensor.unit(CATALOGUE[effect].parameters[parameter].unit)
    if white is not None and np.all(white > 0.0) and (kind, effect, parameter) not in part.estimate:
        return sensor, f"as {part.name} declares it, {quantity(float(np.max(white)), unit, 3)}"
    typical = magnitudes(effect, kind)[class_of(part, kind)].si
    said = f"{part.name} declares none: typical of its class, {quantity(typical, unit, 3)}"
    return sensor.with_values(effect, **{parameter: typical}), said
