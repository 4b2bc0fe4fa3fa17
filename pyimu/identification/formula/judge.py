"""What held-out rows and the sensor's own signal say of a formula."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyimu.identification.fit.fit import Fit
from pyimu.identification.formula.compose import Chosen
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.confirm import CHANCE as REFUTED
from pyimu.identification.search.confirm import SPEAKS, Evidence
from pyimu.identification.search.investigation import Investigation, Step
from pyimu.identification.search.own_signal import is_of_reference

CONFIRMED, CHANCE = 0.3, 2.0
"""Share of what the models differ by on held-out rows that these must gain: all of it in the mean
where the formula is true, the contrary of it where it is not. Where they differ by little a true
one may gain less, by so many standard errors."""

DISPLACES = 0.05
"""Share of what effects with a name explain of the fitted rows, by which a formula must explain
more, of these and of the held-out ones, to take their place: near level a product with the vertical
force is a multiple of gravity."""

DOUBTFUL = 0.0
"""Log-likelihood [nat] by which the sensor's own signal may speak against a formula: what is chosen
from thousands of terms must be seen there, where a named effect must only not be missing."""


def least_gain(difference: np.ndarray, chance: float = CHANCE) -> np.ndarray:
    """Gain [nat] that held-out rows have at least by what is true, where models differ by so much
    there, to within ``chance`` standard errors: its mean is that ``difference``, its variance twice
    that. Held-out rows are all rows less the fitted ones, so that an axis where the models agree
    may have a little less than none.
    """
    there = np.maximum(difference, 0.0)
    return np.minimum(CONFIRMED * there, there - chance * np.sqrt(2.0 * there))


def left_of(chosen: Chosen, seen: Evidence) -> Chosen:
    """The terms with the axes that held-out rows do not speak against."""
    denied = (seen.difference > SPEAKS) & (seen.gained < least_gain(seen.difference))
    return [(t, tuple(i for i in a if not denied[i])) for t, a in chosen]


def is_denied(inv: Investigation, after: Fit, seen: Evidence) -> bool:
    """Whether held-out rows, of whatever little difference, or the sensor's own signal speak
    against a model.
    """
    lost = seen.gained.sum() < float(least_gain(seen.difference.sum(), REFUTED))
    return lost or seen.raises or seen.is_little or is_of_reference(inv.after, after, DOUBTFUL)


def is_confirmed(seen: Evidence) -> bool:
    """Whether held-out rows gain by a formula as they must where it is true, and do not lose, and
    all rows gain as much as by an effect with a name.
    """
    if seen.raises or seen.is_little:
        return False
    gained, difference = float(seen.gained.sum()), seen.difference.sum()
    return difference > SET_WIDTH / 2 and gained > max(0.0, float(least_gain(difference)))


def outweighs(displaced: Sequence[Step], ahead: float, seen: Evidence, needed: float) -> bool:
    """Whether a formula explains so much more than the effects whose place it takes, of the fitted
    rows and of the held-out ones, which have no part in its choice.
    """
    held = max(float(seen.gained.sum()), 0.0)
    return ahead > needed and ahead + held > needed + DISPLACES * sum(s.gain for s in displaced)
