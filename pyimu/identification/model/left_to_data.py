"""Which coefficients the data are to tell, and which of them they can."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.identification.fit.keys import Coefficient, Key, coefficient_of
from pyimu.identification.fit.reduction import STRUCTURE
from pyimu.identification.fit.structure import prior_of
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.positions import positions_wanted, unshown
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.report.numbers import joined


def left_to_data(
    start: Part, declared: bool, sensor: Sensor, trials: list[Trial]
) -> frozenset[Key]:
    """The coefficients to estimate.

    Those that the part leaves to the data, less what a log's own bias and mounting stand for.
    """
    left = [
        s
        for s in sensor.slots
        if (sensor.kind, s.effect, s.parameter) in start.estimate and not s.definition.reference
    ]
    effects = {s.effect: sensor.effect(s.effect) for s in left}
    left = [s for s in left if not (effects[s.effect].stochastic or effects[s.effect].per_power_on)]
    if declared and all(t.reference == "static" for t in trials):
        _refuse_without_motion(start, sensor, left, trials[0].name)
    if all(t.any_turn for t in trials):
        # A turn of the whole triad is the mounting's; what such an effect has of its own is three
        # angles, not six.
        left = [s for s in left if not effects[s.effect].mounting or s.index[0] < s.index[1]]
    return frozenset(map(coefficient_of, left))


def shown(start: Part, declared: bool, free: frozenset[Key], trials: list[Trial]) -> list[Trial]:
    """The trials with a finding of the free coefficients that rests do not show.

    They stay free, near zero by their prior: held at zero they would bend those that are shown.
    Raises UserError for one that the part asks for, and that has no prior therefore.
    """
    if all(t.reduction is None for t in trials):
        return trials
    sensor, name = start.sensor(trials[0].kind), trials[0].name
    hidden = unshown(sensor, free, trials)
    if not hidden:
        return trials
    names = joined([f"{k.effect}.{k.parameter}{list(k.index)}" for k in hidden])
    more = positions_wanted(sensor, free, trials)
    turns = "turns by 90 deg and more about each of its axes, from rest to rest"
    wanted = turns if sensor.kind == "gyro" else "rests in many more positions"
    said = f"{wanted}, would"
    if more:
        wanted = f"rests with {joined(more)}"
        said = f"{len(more)} more at rest would: {joined(more)}"
    if declared:
        have = sum(len(np.unique(t.reduction.group)) for t in trials)
        raise UserError(
            f"{name}: {have} positions at rest do not show {names} of the {sensor.kind}, which "
            f"part {start.name} asks to estimate; {said}"
        )
    effects = joined([e.replace("_", " ") for e in dict.fromkeys(k.effect for k in hidden)])
    detail = {"coefficients": names, "effects": effects, "positions": said, "wanted": wanted}
    found = Finding("not_shown_at_rest", sensor.kind, len(hidden), detail)
    first = replace(trials[0], findings=(*trials[0].findings, found))
    return [first, *trials[1:]]


def prior_of_structure(sensor: Sensor, free: frozenset[Key]) -> dict[Coefficient, float]:
    """What is known of the structure of a sensor where nobody declared it: its typical size in the
    coarsest class of parts.
    """
    return prior_of(
        sensor, (k for k in free if isinstance(k, Coefficient) and k.effect in STRUCTURE)
    )


def _refuse_without_motion(start: Part, sensor: Sensor, left: list, log: str) -> None:
    """Raise UserError for the first coefficient that only motion would show."""
    for s in left:
        if sensor.effect(s.effect).stage in ("dynamics", "gain"):
            raise UserError(
                f"{log}: no motion, yet part {start.name} asks to estimate "
                f"{sensor.kind}.{s.effect}.{s.parameter}; give a log that moves, with a "
                "reference, or declare the value"
            )
