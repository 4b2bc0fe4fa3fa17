"""A formula that was found, as an effect of the user's own."""

from __future__ import annotations

from dataclasses import dataclass

from pyimu.identification.formula.effect import plain
from pyimu.identification.formula.terms import Term
from pyimu.identification.search.investigation import Step
from pyimu.model.effect import Effect

TWIN = 0.995
"""Correlation with an effect of the catalogue from which on a formula is nothing new, however well
the rest is seen: a tenth of its size is less than what formulas leave out."""


@dataclass(frozen=True)
class Formula:
    """A formula of one sensor as the effect ``name``: its terms with the axes of each, the text
    that defines it, and by effect of the catalogue how much it looks like it (correlation in
    these logs).
    """

    sensor: str
    name: str
    terms: tuple[Term, ...]
    axes: tuple[tuple[int, ...], ...]
    effect: Effect
    text: str
    resembles: tuple[tuple[str, float], ...] = ()

    def is_new(self, step: Step) -> bool:
        """Whether it says what no effect with a name would say in these logs: what the likest one
        leaves of its gain in the ``step`` that added it would pass the gate.
        """
        return all(r < TWIN and (1.0 - r**2) * step.gain > step.gate for _, r in self.resembles)

    @property
    def said(self) -> str:
        """Its terms in plain mathematics."""
        return plain(self.terms)

    def as_dict(self) -> dict[str, object]:
        return {
            "sensor": self.sensor,
            "effect": self.name,
            "formula": self.said,
            "resembles": [{"effect": n, "correlation": round(r, 3)} for n, r in self.resembles],
        }
