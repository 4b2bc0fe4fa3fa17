"""What the search found for one sensor: the model before and after, and the way between."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.ceiling import is_ceiling
from pyimu.identification.search.screen import Screening

AS_NOISE = "explains no more than random noise would"
"""The reason for which an effect is taken back that is not told from noise."""


AS_ROUNDING = "is no more than the rounding of samples that hardly scatter may do"
"""The reason for which an effect is taken back that rounding makes."""


@dataclass(frozen=True)
class Step:
    """One effect that was added.

    The coefficients it brought, its evidence, and who could stand in for it.

    ``declared`` says that the effect was in the model already and only its declared values were set
    free, ``as_sampled`` that the samples themselves show it, whatever squares it explains.
    ``fitted`` are the candidates that were fitted in full beside it, and their gains [nat].
    """

    effect: str
    keys: frozenset
    gain: float
    gate: float
    alternatives: tuple[str, ...]
    dispersion: float
    declared: bool = False
    as_sampled: bool = False
    fitted: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True)
class Refused:
    """An effect that passed the gate but not belief or the held-out data; ``beyond_belief`` where
    it would be of a size that no sensor has.
    """

    effect: str
    gain: float
    reason: str
    beyond_belief: bool = False

    def as_dict(self) -> dict[str, Any]:
        return asdict(self)


@dataclass(frozen=True)
class Investigation:
    """What the loop found for one sensor: the model before and after, and the way between.

    ``unfit`` says why a reference does not belong to the sensor: nothing was looked for then;
    ``believed`` that what may be noise of the reference was taken for it.
    """

    before: Fit
    after: Fit
    steps: tuple[Step, ...]
    refused: tuple[Refused, ...]
    first: Screening
    last: Screening
    held: tuple[Trial, ...]
    unfit: str = ""
    believed: bool = False

    @property
    def removable(self) -> list[str]:
        """The effects that were added and may be taken back: a ceiling may not, the samples at it
        having been left out since.
        """
        sensor, new = self.after.sensor, [s.effect for s in self.steps if not s.declared]
        return [name for name in new if not is_ceiling(sensor, name)]

    @property
    def brought_in(self) -> int:
        """Coefficients that its steps brought in."""
        return sum(len(s.keys) for s in self.steps)
