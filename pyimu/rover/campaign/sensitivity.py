"""Which of the drawn parameters drives an error: first-order indices, from the runs as they are.

The first-order index of a parameter is the share of the error's variance that its knowledge alone
would take away, S = Var E(y | x) / Var y (Saltelli and others 2010, eq. 2). A design by Saltelli
costs runs of its own, and would have to vary the noise's seed as one parameter among the others;
RBD-FAST finds the same indices in any independent draws (Tarantola, Gatelli and Mara 2006, in the
form for given data of Plischke 2010, its bias taken off by Tissot and Prieur 2012). So each
campaign has its indices, and a longer one has better ones.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.stats import gamma

from pyimu.errors import UserError

HARMONICS = 10
"""Harmonics in which the variance of a parameter is looked for, SALib's usual number."""

LEAST = 200
"""Runs for a list of indices: with less, what chance makes of a parameter is a tenth and more."""

RESAMPLES = 200
"""Resamples for an interval."""

LEVEL = 0.95
"""Probability of an interval, and of no index above ``chance`` where no parameter matters."""


@dataclass(frozen=True)
class Index:
    """The first-order index of a ``factor``, and half the width of its interval."""

    factor: str
    value: float
    half_width: float

    @property
    def low(self) -> float:
        return max(0.0, self.value - self.half_width)

    @property
    def high(self) -> float:
        return min(1.0, self.value + self.half_width)


def indices(factors: Mapping[str, np.ndarray], error: np.ndarray) -> list[Index]:
    """The indices of ``factors`` (n,) by name for an ``error`` (n,), the largest first.

    The intervals are SALib's, of resamples of half the runs; they are too wide rather than too
    narrow. Empty where the error or all factors are constant. Raises UserError without SALib.
    """
    varied = {name: x for name, x in factors.items() if np.ptp(x) > 0}
    if not varied or len(error) < LEAST or not np.ptp(error) > 0:
        return []
    try:
        from SALib.analyze import rbd_fast
    except ImportError:
        raise UserError(
            "the summary of a campaign needs SALib: pip install 'pyimu[campaign]'"
        ) from None
    found = rbd_fast.analyze(
        {"num_vars": len(varied), "names": list(varied)},
        np.column_stack(list(varied.values())),
        error,
        M=HARMONICS,
        num_resamples=RESAMPLES,
        conf_level=LEVEL,
        seed=0,
    )
    rows = zip(varied, found["S1"], found["S1_conf"], strict=True)
    return sorted((Index(n, float(s), float(c)) for n, s, c in rows), key=lambda i: -i.value)


def chance(runs: int, factors: int) -> float:
    """What no index of ``factors`` that do nothing exceeds, with probability ``LEVEL``.

    Such an index is the share of ``HARMONICS`` of ``runs``/2 ordinates of a periodogram of white
    noise, which are exponential and alike; its mean is taken off.
    """
    beyond = (1 - LEVEL) / max(factors, 1)
    return float((gamma.isf(beyond, HARMONICS) - HARMONICS) * 2 / runs)
