"""What columns explain at first glance: of the many that are tried few explain more than chance,
and only of these are the products with each other asked for.

With F what makes a column white, its product with another one is c' (F' F d): what is left and the
columns of a model go through the filter there and back once, and each column that is tried is
multiplied as it stands. Only its own power needs it white.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from pyimu.identification.fit.columns import Linear, Stack
from pyimu.identification.fit.errors_in_variables import has_noise
from pyimu.identification.fit.filters import Innovations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Key, Shape
from pyimu.identification.fit.normal import DEAD, TOGETHER, Normal, normal_equations, solve
from pyimu.identification.fit.whiten import RandomWalk


@dataclass(frozen=True)
class _Axis:
    """One axis of a trial: what makes its rows ``white``, residual and columns of the model,
    ``there`` and back (m, 1 + c), and their places (1 + c,) in the equations, the residual's behind
    all.
    """

    white: Callable[[], Innovations]
    there: np.ndarray
    places: list[int]

    @classmethod
    def of(cls, one: Linear, axis: int, noise: RandomWalk, model: Normal) -> _Axis:
        white = partial(noise.filter, one.time, one.segments)
        columns = np.column_stack([one.residual[:, axis], *one.columns[axis].arrays])
        places = [len(model.keys), *(model.position[k] for k in one.keys[axis])]
        there = white()
        return cls(white, there.back(there.next(columns)), places)

    def of_columns(self, columns: Stack) -> tuple[np.ndarray, np.ndarray]:
        """Products (k, 1 + c) of columns (m, k), and the power (k,) of each, both white."""
        white, count = self.white(), columns.shape[1]
        products, power = np.zeros((count, len(self.places))), np.zeros(count)
        rows = max(1, TOGETHER // max(count, 1))
        for a in range(0, columns.count, rows):
            b = min(a + rows, columns.count)
            some = columns.after(np.zeros((b - a, 0)), a, b).T
            products += some @ self.there[a:b]
            power += white.powers(some)
        return products, power


class Glance:
    """A model beside which columns are tried."""

    def __init__(self, fit: Fit) -> None:
        self.fit, linears = fit, fit.linearise()
        self.model = with_prior(normal_equations(linears, fit.noise), fit)
        self.axes = [
            {i: _Axis.of(one, i, fit.noise[i], self.model) for i in one.keys} for one in linears
        ]

    @classmethod
    def of(cls, fit: Fit) -> Glance | None:
        """That of a fit beside white noise and a walk, and references without noise; None else."""
        walks = all(isinstance(n, RandomWalk) for n in fit.noise.values())
        return cls(fit) if walks and not has_noise(fit) and not fit.is_reduced else None

    def explained(self, columns: Sequence[Callable]) -> dict[Shape, float]:
        """Twice the log-likelihood [nat] that each of the columns which functions add explains by
        itself; without those of which the model leaves nothing.
        """
        count = len(self.model.keys)
        products: dict[Key, np.ndarray] = {}
        power: dict[Key, float] = {}
        linears = self.fit.beside(self.fit.residuals(), columns)
        for one, axes in zip(linears, self.axes, strict=True):
            for i, axis in axes.items():
                each = axis.of_columns(one.columns[i])
                for key, product, own in zip(one.keys[i], *each, strict=True):
                    products.setdefault(key, np.zeros(count + 1))[axis.places] += product
                    power[key] = power.get(key, 0.0) + float(own)
        if not products:
            return {}
        both = np.array(list(products.values())).T
        of_model, own = both[:count], np.array(list(power.values()))
        back = solve(self.model.gram, of_model)
        left = own - np.sum(of_model * back, axis=0)
        score = both[count] - back.T @ self.model.score
        seen = left >= DEAD * own
        gains = score**2 / np.where(seen & (left > 0.0), left, np.inf)
        return {k: float(g) for k, g, s in zip(products, gains, seen, strict=True) if s}
