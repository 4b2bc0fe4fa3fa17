"""The form of an effect whose size is linear beside it: a time constant, the width of a play,
instants, a frequency.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from pyimu.identification.fit.keys import Coefficient, Key
from pyimu.identification.fit.response import is_driven
from pyimu.identification.fit.trial import Trial
from pyimu.model.effect import Effect
from pyimu.model.signals import COLUMNS

BLOCK = 1.0
"""s; means over so long are tried, or over longer ones of a long log."""

UNUSED = 1e9
"""s; an event so late never happens."""


@dataclass(frozen=True)
class Form:
    """Values of an effect's form to start from, the coefficients of it that regression refines, and
    what the choice is to be charged for.
    """

    values: Mapping[str, np.ndarray]
    keys: tuple[Coefficient, ...]
    toll: float

    def beside(self, keys: Iterable[Key]) -> frozenset[Key]:
        """The coefficients of the form that shape those of ``keys``, by axis where each has one."""
        axes = {k.index[0] for k in keys}
        return frozenset(k for k in self.keys if not k.index or k.index[0] in axes)


def form_of(e: Effect) -> str:
    """The coefficient that is tried of an effect's form; empty where there is none."""
    found = (n for n, p in e.parameters.items() if p.form and p.scan and p.scan.measure != "phase")
    return next(found, "")


def can_be_formed(e: Effect, kind: str) -> bool:
    """Whether the form of an effect can be tried: each size belongs to one axis, and what the
    effect remembers follows from other signals than the sensor's own.
    """
    sizes = [p for p in e.parameters.values() if not (p.form or p.reference)]
    return (
        bool(form_of(e))
        and all(p.scan for p in e.parameters.values() if p.form)
        and all(p.shape and p.shape[0] == 3 for p in sizes)
        and (not e.remembers or is_driven(e, kind))
    )


def since_power_on(trial: Trial, time: np.ndarray) -> np.ndarray:
    """Seconds since power-on of instants of a trial."""
    return time - trial.time[0] + trial.u[0, COLUMNS["time"].start]
