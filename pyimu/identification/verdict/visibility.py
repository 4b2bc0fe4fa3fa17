"""What logs could have shown of the effects that a model lacks, judged before looking for any."""

from __future__ import annotations

import numpy as np

from pyimu.errors import UserError
from pyimu.identification.found.entries import Visibility
from pyimu.identification.noise.rounding import is_read
from pyimu.identification.search.candidates import has_columns
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.verdict.unasked import UNEXCITED, why_unasked
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.typical import CLASSES, magnitudes

ROUNDING = 1e8
"""Times what is typical of a consumer part that an effect would have to be to stand out: then what
excites it is the rounding of a motion, or of a course of temperature, that is not there."""


def visibility(kind: str, inv: Investigation) -> list[Visibility]:
    """One entry for each effect that the loop can look for and that the model lacked."""
    lacking = [
        e
        for e in CATALOGUE.values()
        if kind in e.sensors
        and e.name not in inv.before.sensor.values
        and not e.per_power_on
        and (has_columns(e, kind) or is_read(e))
    ]
    return [_of(e, kind, inv) for e in lacking]


def _of(e: Effect, kind: str, inv: Investigation) -> Visibility:
    parameter = next(p for p in e.parameters.values() if not p.reference)
    unit = inv.before.sensor.unit(parameter.unit)
    seen = next((c for c in inv.first.candidates if c.effect == e.name), None)
    excited = "time" in e.signals(kind)  # which passes in every log
    if seen is not None and not excited and seen.smallest_visible > ROUNDING * _typical(e, kind):
        return Visibility(kind, e.name, None, unit, (), UNEXCITED)
    if seen is not None and np.isfinite(seen.smallest_visible):
        alike, each = seen.inseparable_from, seen.visible
        return Visibility(kind, e.name, seen.smallest_visible, unit, alike, each=each)
    return Visibility(kind, e.name, None, unit, (), why_unasked(kind, inv, e))


def _typical(e: Effect, kind: str) -> float:
    """What an effect has in a consumer part, in SI; infinite where nobody knows."""
    try:
        return magnitudes(e.name, kind)[CLASSES[-1]].si
    except UserError:
        return np.inf
