"""The symbolic results: equations that print and compute, and what they were checked against.

``derive()`` runs every check; what it gives has a ``report()`` to read in a terminal, and
``write(folder)`` makes files of it. An equation is a text in the language of
``pyimu.derivations.formula``, from which its casadi expression, plain text and LaTeX follow. The
checks compare the equations with numpy and scipy, and with the functions of the package.
"""

from __future__ import annotations

from collections.abc import Callable

from pyimu.derivations.kinematics.attitude_error import ATTITUDE_ERROR
from pyimu.derivations.kinematics.convention import CONVENTION
from pyimu.derivations.kinematics.quaternions import CLOSED_STEP, KINEMATICS
from pyimu.derivations.kinematics.rates import EARTH, RATE
from pyimu.derivations.kinematics.rodrigues import RODRIGUES
from pyimu.derivations.model import Derivation, Result
from pyimu.derivations.process_noise.flicker import FLICKER
from pyimu.derivations.process_noise.gauss_markov import MARKOV, TURNING_MARKOV
from pyimu.derivations.process_noise.integrals import INTEGRALS
from pyimu.derivations.process_noise.printed import PRINTED
from pyimu.derivations.process_noise.random_walk import STILL, TURNING
from pyimu.derivations.process_noise.random_walk_axes import AXES
from pyimu.derivations.process_noise.transition import TRANSITION
from pyimu.derivations.result import Derived
from pyimu.display.silent import silent

__all__ = ["DERIVATIONS", "Derived", "Result", "derive"]

DERIVATIONS: tuple[Derivation, ...] = (
    KINEMATICS,
    CLOSED_STEP,
    CONVENTION,
    RODRIGUES,
    ATTITUDE_ERROR,
    EARTH,
    RATE,
    INTEGRALS,
    TRANSITION,
    STILL,
    TURNING,
    AXES,
    PRINTED,
    MARKOV,
    TURNING_MARKOV,
    FLICKER,
)
"""Every result, in the order in which they are printed."""


def derive(say: Callable[[str, float], None] = silent) -> Derived:
    """Every result with its checks, which are computed now.

    ``say(text, share)`` is told what is being checked, and which share of all has been.
    """
    results = []
    for k, d in enumerate(DERIVATIONS):
        say(f"checking {d.key}", k / len(DERIVATIONS))
        results.append(Result(d, tuple(d.check(d)), tuple(d.tables(d))))
    return Derived(tuple(results))
