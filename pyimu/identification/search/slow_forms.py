"""The likeliest form of an effect that varies slowly, tried on means of seconds."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.search.blocks import Blocks, basis, beside
from pyimu.identification.search.by_chance import CHANCE, Chance
from pyimu.identification.search.form import UNUSED, Form, form_of
from pyimu.model.effect import Effect

MOST_BLOCKS = 1200
"""Blocks of a log, and values of a form that are tried."""

LEAST_BLOCKS = 20
"""Fewer tell nothing of a slow form."""


@dataclass(frozen=True)
class _Tried:
    """Columns of one axis for each value, of unit length and free of what the model explains, and
    the residual [standard deviations] that is left to explain.
    """

    columns: np.ndarray
    residual: np.ndarray

    @property
    def gain(self) -> np.ndarray:
        return 0.5 * (self.columns.T @ self.residual) ** 2

    def without(self, number: int) -> _Tried:
        """What is left once one value is in."""
        one = self.columns[:, number]
        return _Tried(self.columns, self.residual - one * (one @ self.residual))


class Slow:
    """What a fit leaves, and the forms of effects that are tried on it."""

    def __init__(self, fit: Fit, linears: list[Linear], penalty: float) -> None:
        self.fit, self.linears, self.penalty = fit, linears, penalty
        self.blocks = Blocks(fit, linears, MOST_BLOCKS)

    @cached_property
    def chance(self) -> Chance:
        return Chance(self.fit, self.linears, self.penalty)

    @cached_property
    def base(self) -> dict[int, tuple[np.ndarray, np.ndarray]]:
        """By axis the residual, white, and an orthonormal basis of the columns of the model."""
        out = {}
        for i, noise in self.fit.noise.items():
            white, _ = self.blocks.white(self.blocks.left[i], noise)
            out[i] = white[:, 0], basis(white[:, 1:])
        return out

    def form(self, e: Effect) -> Form | None:
        """The likeliest form of an effect, None where no log shows any."""
        name, blocks = form_of(e), self.blocks
        values = e.parameters[name].scan.forms(blocks.length, blocks.swing(e))
        # Finer than the blocks nothing is seen; instants are placed down to the sample later.
        values = values[:: max(1, -(-len(values) // MOST_BLOCKS))]
        if blocks.count < LEAST_BLOCKS or not len(values):
            return None
        tried, events = self._tried(e, name, values), e.parameters[name].shape
        first = _total(tried.values(), self.penalty)
        best = int(np.argmax(first))
        # What explains nothing explains no more than by chance.
        most = events[0] if events else 1
        tolls = self.chance.tolls(e, name, values, most) if first[best] > 0.0 else np.zeros(most)
        if not events:
            return Form({name: values[best]}, (Coefficient(e.name, name, ()),), float(tolls[0]))
        instants = sorted(values[self._one_by_one(tried, tolls)])
        padded = np.concatenate([instants, np.full(events[0] - len(instants), UNUSED)])
        return Form({name: padded}, (), float(tolls[len(instants) - 1]))

    def _one_by_one(self, tried: dict[int, _Tried], tolls: np.ndarray) -> list[int]:
        """Numbers of the values that explain most, each beside those before; at least one."""
        found: list[int] = []
        for toll in np.diff(tolls, prepend=0.0):
            total = _total(tried.values(), self.penalty)
            best = int(np.argmax(total))
            if found and (total[best] <= toll - np.log(CHANCE) or best in found):
                break
            found.append(best)
            tried = {i: t.without(best) for i, t in tried.items()}
        return found

    def _tried(self, e: Effect, name: str, values: np.ndarray) -> dict[int, _Tried]:
        made, out = self.blocks.columns(e, name, values), {}
        for i, (residual, base) in self.base.items():
            white, _ = self.blocks.white([one[:, :, i] for one in made], self.fit.noise[i])
            out[i] = _Tried(beside(white, base), residual)
        return out


def _total(tried: Iterable[_Tried], penalty: float) -> np.ndarray:
    """Gain [nat] of each value, on the axes that pay for themselves."""
    return np.sum([np.maximum(t.gain - penalty, 0.0) for t in tried], axis=0)
