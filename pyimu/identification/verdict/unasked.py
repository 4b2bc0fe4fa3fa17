"""Why nothing was asked of an effect that a model lacks."""

from __future__ import annotations

from pyimu.identification.fit.surroundings import PLACE
from pyimu.identification.fit.trial import known_to_all
from pyimu.identification.noise.rounding import HIDDEN, is_read, shows_samples
from pyimu.identification.search.candidates import (
    CONING,
    absent,
    has_columns,
    has_smoothed_attitudes,
)
from pyimu.identification.search.investigation import Investigation
from pyimu.model.effect import Effect
from pyimu.model.signals import inputs_of
from pyimu.report.numbers import joined

UNEXCITED = "no motion excites it"


def why_unasked(kind: str, inv: Investigation, e: Effect, noise: str = "") -> str:
    """Why an effect was not looked for by regression; empty where nothing speaks against it.

    ``noise`` is why kinds of noise were not told apart, empty where they were.
    """
    if is_read(e):
        return "looked for in the raw samples" if shows_samples(inv) else HIDDEN
    if e.stochastic:
        return noise
    lacking = e.signals(kind) - known_to_all(inv.before.trials)
    if lacking:
        return _lacking(lacking, known_to_all(inv.before.trials))
    if not has_columns(e, kind):
        return "no way to look for it in these logs"
    if e in absent(inv.before):
        return UNEXCITED
    if e.name == CONING and has_smoothed_attitudes(inv.before.trials):
        return "what the filter over the reference is off by looks the same"
    return "the clock of the reference shows the same, and is estimated anyway"


def _lacking(signals: frozenset[str], known: frozenset[str]) -> str:
    """What a log would need for the signals that it does not know."""
    inputs = sorted(inputs_of(signals) - known)
    if inputs:
        return f"the log lacks {joined(inputs)}"
    does = "holds the {} already" if signals & set(PLACE) else "shows no {}"
    return "the reference " + does.format(joined(sorted(signals)).replace("_", " "))
