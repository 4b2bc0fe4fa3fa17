"""What the best of many values of a form explains where there is nothing to find.

Where the part says how much the sensor wanders, that is the best of many correlated numbers. Where
nobody does, or it wanders more, the walk is estimated anew beside each value (``walks.py``), and a
few events may stand for all of a walk: what they explain by chance is found by drawing walks as the
residual allows them (parametric bootstrap), placing the events one after another where they explain
most, and estimating the walk again.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, lru_cache

import numpy as np
from scipy.special import logsumexp

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.noise_fit import declared_variances
from pyimu.identification.fit.whiten import WALKS
from pyimu.identification.search.blocks import Blocks, beside
from pyimu.identification.search.walks import Explained, Placed, Walk, allowed
from pyimu.model.effect import Effect

CHANCE = 0.01
"""Share of logs with nothing to find in which the best value may gain more than the toll says."""

DRAWS, SINGLE_DRAWS = 1000, 100_000
"""Draws of the best of all values, and of one that was named beforehand."""

BLOCKS, VALUES = 200, 120
"""Blocks of the longest log on which chance is drawn, and values of a form; between them the others
lie."""


class Chance:
    """Draws of what a fit leaves where nothing is missing."""

    def __init__(self, fit: Fit, linears: Sequence[Linear], penalty: float, seed: int = 1) -> None:
        self.fit, self.penalty, self.seed = fit, penalty, seed
        self.blocks = Blocks(fit, linears, BLOCKS)

    @cached_property
    def axes(self) -> dict[int, list[Walk]]:
        """Of each axis the noises that it may have, and draws of it."""
        rng, out = np.random.default_rng(self.seed), {}
        for i, (walks, likely) in self.walks.items():
            left = self.blocks.left[i]
            k2 = rng.choice([n.k2 for n in walks], DRAWS, p=np.exp(likely - logsumexp(likely)))
            drawn = self.blocks.drawn(walks[0], k2, rng)
            out[i] = [Walk.of(self.blocks, n, left, drawn) for n in walks]
        for i in self.fit.noise.keys() - out.keys():
            out[i] = [self._known(i, rng)]
        return out

    @cached_property
    def walks(self) -> dict[int, tuple[list[WALKS], np.ndarray]]:
        """Of each axis that may wander the walks that it may have, as ``allowed`` gives them."""
        declared = declared_variances(self.fit.sensor, self.fit.trials[0].h)[1]
        return {
            i: allowed(self.blocks, noise, self.blocks.left[i], float(declared[i]))
            for i, noise in self.fit.noise.items()
            if isinstance(noise, WALKS)
        }

    def _known(self, axis: int, rng: np.random.Generator) -> Walk:
        """An axis whose noise is known, and draws of it."""
        noise, left = self.fit.noise[axis], self.blocks.left[axis]
        one = Walk.of(self.blocks, noise, left, [v[:, :1] for v in left])
        draws = rng.standard_normal((len(one.draws), DRAWS))
        draws -= one.base @ (one.base.T @ draws)
        return Walk(noise, one.base, draws, np.zeros(DRAWS))

    def tolls(self, e: Effect, name: str, values: np.ndarray, most: int) -> np.ndarray:
        """How much more (most,) the best of all ``values`` of a coefficient gains by chance than
        one that was named beforehand, and so many of them, each beside those before.
        """
        apart = -(-len(values) // VALUES)
        made = self.blocks.columns(e, name, values[::apart])
        axes, near = {}, []
        for i, walks in self.axes.items():
            columns = [beside(self._white(made, i, w), w.base) for w in walks]
            axes[i] = [Explained(w, c, most > 1) for w, c in zip(walks, columns, strict=True)]
            near.append(_neighbours(columns[0]))
        largest = self._largest(Placed(axes, self.penalty), most)
        between = (1.0 - float(np.median(near)) ** 2) * np.log(apart)
        return largest - self._single + between * np.arange(1, most + 1)

    def toll(self, linears: Sequence[Linear], effect: str) -> float:
        """How much more [nat] an effect that has no form gains by chance than beside a known noise:
        what varies as slowly as a walk may stand for it. ``linears`` have its columns.
        """
        of_axis = self.blocks.of_effect(linears, effect)
        axes = {
            i: [
                Explained(w, beside(self.blocks.white(of_axis[i], w.noise)[0], w.base), False)
                for w in ws
            ]
            for i, ws in self.axes.items()
            if i in of_axis
        }
        if not axes:
            return 0.0
        return max(0.0, float(self._largest(Placed(axes, self.penalty), 1)[0]) - self._single)

    def _white(self, made: Sequence[np.ndarray], axis: int, walk: Walk) -> np.ndarray:
        return self.blocks.white([one[axis] for one in made], walk.noise)[0]

    def _largest(self, placed: Placed, most: int) -> np.ndarray:
        """What the best values gain [nat] in all but ``CHANCE`` of the draws, one, two, ..."""
        total, out = np.zeros(DRAWS), []
        for number in range(most):
            best = placed.best()
            total = total + best.gain
            out.append(float(np.quantile(total, 1.0 - CHANCE)))
            if number + 1 < most:
                placed.take(best)
        return np.array(out)

    @property
    def _single(self) -> float:
        """The same of one value that was named beforehand, beside a noise that is known."""
        return _of_single(len(self.axes), self.penalty, self.seed)


@lru_cache(maxsize=8)
def _of_single(axes: int, penalty: float, seed: int) -> float:
    """``Chance._single`` on so many axes."""
    z = np.random.default_rng(seed).standard_normal((SINGLE_DRAWS, axes))
    gains = np.maximum(0.5 * z**2 - penalty, 0.0)
    return float(np.quantile(gains.sum(axis=1), 1.0 - CHANCE))


def _neighbours(columns: np.ndarray) -> float:
    """Typical correlation of a column with the next."""
    if columns.shape[1] < 2:
        return 1.0
    return float(np.median(np.abs(np.sum(columns[:, 1:] * columns[:, :-1], axis=0))))
