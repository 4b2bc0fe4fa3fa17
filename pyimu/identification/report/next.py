"""What to measure next, in words."""

from __future__ import annotations

from pyimu.identification.advice import Advice, Gain
from pyimu.identification.as_part import SENSORS
from pyimu.identification.outcome import Outcome
from pyimu.identification.report.words import si_of
from pyimu.report.numbers import quantity
from pyimu.report.page import Table, prose


def next_table(closed: Outcome) -> Table:
    """The measurements that are worth making, the one that gains most first."""
    return Table(
        ("measure", "for the", "what it gives"),
        [
            (
                prose(f"{a.measure[0].upper()}{a.measure[1:]}."),
                SENSORS.get(a.sensor, "verdict"),
                prose("; ".join((*gains(a), *([a.why] if a.why else [])))),
            )
            for a in closed.next
        ],
    )


def gains(a: Advice) -> list[str]:
    """Each coefficient with how well it would be known, and how well it is."""
    return [_gain(g) for g in a.gains]


def _gain(g: Gain) -> str:
    si = si_of(g.effect, g.parameter, g.unit)
    now = "which nothing shows now" if g.now is None else f"now ±{quantity(g.now, si, 2)}"
    of = f" of {g.axes}" if g.axes else ""
    return f"{g.effect.replace('_', ' ')}{of} to ±{quantity(g.then, si, 2)}, {now}"
