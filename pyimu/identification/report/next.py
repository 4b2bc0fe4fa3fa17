"""What to measure next, in words."""

from __future__ import annotations

from pyimu.identification.model.as_part import SENSORS, si_of
from pyimu.identification.outcome import Outcome
from pyimu.identification.plan.advice import Advice, Gain
from pyimu.identification.plan.words import lasting
from pyimu.report.numbers import MISSING, joined, number, quantity
from pyimu.report.page import Table, prose


def next_table(closed: Outcome) -> Table:
    """The measurements that are worth making, the one that gains most first."""
    return Table(
        ("measure", "for the", "takes", "what it gives"),
        [
            (
                prose(f"{a.measure[0].upper()}{a.measure[1:]}."),
                SENSORS.get(a.sensor, "verdict"),
                MISSING if a.duration is None else lasting(a.duration),
                prose("; ".join((*gains(a), *([a.why] if a.why else [])))),
            )
            for a in closed.next
        ],
    )


def gains(a: Advice) -> list[str]:
    """Which effects it tells apart, and each coefficient with how well it would be known, and how
    well it is.
    """
    return [*_separated(a), *map(_gain, a.gains)]


def _separated(a: Advice) -> list[str]:
    if not a.separates:
        return []
    first, *others = (n.replace("_", " ") for n in a.separates)
    return [f"{first} told from {joined(others)}, {number(a.distance, 2)} standard errors apart"]


def _gain(g: Gain) -> str:
    si = si_of(g.effect, g.parameter, g.unit)
    now = "which nothing shows now" if g.now is None else f"now ±{quantity(g.now, si, 2)}"
    of = f" of {g.axes}" if g.axes else ""
    return f"{g.effect.replace('_', ' ')}{of} to ±{quantity(g.then, si, 2)}, {now}"
