"""What forms that are not exact may leave: those of a delay or a lag in a model, of a sensor's
output, and of a filter that was taken out of a reference's places.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import Protocol

from pyimu.identification.fit.fit import Fit
from pyimu.identification.search.choice import Refined
from pyimu.identification.search.remainder import left_by_form
from pyimu.model.catalogue import CATALOGUE
from pyimu.recording.reference.unfiltered_places import EXPLAINED

FORM = 0.01
"""Share of what a lag or a delay explains that its form may leave: a tenth of its amplitude, as the
sampled form of a pole is off at a quarter of the sample rate; and of what a filter explained that
was undone, of which two kinds differ as much that a log hardly tells apart."""


class Known(Protocol):
    """What is in a model: an effect, how much it explains [nat], whether samples alone show it."""

    effect: str
    gain: float
    as_sampled: bool


def left_by_forms(fit: Fit, steps: Iterable[Known]) -> float:
    """Gain [nat] that all forms together may leave of what is beside a model with ``steps``."""
    return max(_form_error(steps), _filters_error(fit))


def within_form(chosen: Refined, steps: Sequence[Known], current: Fit) -> str:
    """Why a candidate beside the ``current`` model may be nothing but what a form leaves; empty
    where it is more.
    """
    if chosen.gain <= _filters_error(current):
        return _less("the filter over the positions does, which was undone")
    # At first look it is seen by the noise by which the form is.
    gain = min(chosen.gain, chosen.screened.gain)
    if chosen.gain > _form_error(steps) or _is_exact(gain, steps, current):
        return ""
    return _less("the lag or delay does, whose form is not exact")


def _less(what: str) -> str:
    return f"explains less than {FORM:.0%} of what {what}"


def _is_exact(gain: float, steps: Sequence[Known], current: Fit) -> bool:
    """Whether a ``gain`` is more than what the form of the dynamics leaves: of a delay that is
    exact to the noise that is nothing, though the delay explains ever so much.
    """
    of_output = _form_error(steps, ("output",))
    return gain > of_output and not current.is_reduced and gain > left_by_form(current)


def _form_error(steps: Iterable[Known], stages: Collection[str] = ("dynamics", "output")) -> float:
    """Gain [nat] that the form of dynamics and output in a model may leave."""
    known = [s.gain for s in steps if CATALOGUE[s.effect].stage in stages and not s.as_sampled]
    return FORM * max(known, default=0.0)


def _filters_error(fit: Fit) -> float:
    """Gain [nat] that filters which were taken out of places may leave.

    What is left of one is linear in the world's forces. In those of the body it is mixed with how
    that turns, and no sum of the sensor's own signals says how much there is of it.
    """
    explained = (f.detail.get(EXPLAINED, 0.0) for t in fit.trials for f in t.findings)
    return FORM * max(explained, default=0.0)
