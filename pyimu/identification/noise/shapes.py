"""The shapes that what is slow in a residual may have in place of noise, and how likely a model is
beside the likeliest of noise and shapes.
"""

from __future__ import annotations

from collections.abc import Mapping

from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.trial import Trial
from pyimu.identification.noise.driven import DRIVEN, driven_of
from pyimu.identification.noise.explained import Explained
from pyimu.identification.noise.jumps import JUMPS, Jump, jumps_of
from pyimu.model.sensor import Sensor

SHAPES: Mapping[str, str] = JUMPS | DRIVEN
"""By name what is neither noise nor an effect, and how that looks."""


def shapes_of(found: Explained) -> dict[int, Jump]:
    """By axis what is likelier than the slow noise that was chosen: what all axes together speak
    for, jumps or what the motion drives, and what is left to the other of the two.
    """
    less, more = sorted((jumps_of(found), driven_of(found)), key=_gain)
    return {**less, **more}


def likelihood_of(
    sensor: Sensor, fit: Fit, held: tuple[Trial, ...], free: frozenset[str], rounds: bool
) -> float | None:
    """Log-likelihood [nat], penalised, of the fitted and the held-out rows of a model beside the
    kinds of noise that explain most of its residual; None where ``noise_of`` says nothing.
    """
    known = Explained.of(sensor, fit, held, free, rounds)
    if known is None:
        return None
    found = known.chosen_of(1)
    return found.explained() + _gain(shapes_of(found))


def _gain(shapes: Mapping[int, Jump]) -> float:
    return sum(max(one.gain, 0.0) for one in shapes.values())
