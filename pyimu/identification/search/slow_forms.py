"""The likeliest form of an effect that varies slowly, tried on means of seconds."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.search.blocks import Blocks, beside
from pyimu.identification.search.by_chance import CHANCE, Chance
from pyimu.identification.search.form import UNUSED, Form, form_of
from pyimu.identification.search.walks import Explained, Placed, Walk
from pyimu.model.effect import Effect

MOST_BLOCKS = 1200
"""Blocks of a log, and values of a form that are tried."""

LEAST_BLOCKS = 20
"""Fewer tell nothing of a slow form."""


class Slow:
    """What a fit leaves, and the forms of effects that are tried on it."""

    def __init__(self, fit: Fit, linears: list[Linear], chance: Chance) -> None:
        self.fit, self.chance = fit, chance
        self.blocks = Blocks(fit, linears, MOST_BLOCKS)

    @cached_property
    def axes(self) -> dict[int, list[Walk]]:
        """Of each axis the residual beside each noise that it may have."""
        out = {}
        for i, noise in self.fit.noise.items():
            walks = self.chance.walks[i][0] if i in self.chance.walks else [noise]
            left = self.blocks.left[i]
            out[i] = [Walk.of(self.blocks, n, left, [v[:, :1] for v in left]) for n in walks]
        return out

    def form(self, e: Effect) -> Form | None:
        """The likeliest form of an effect, None where no log shows any."""
        name, blocks = form_of(e), self.blocks
        values = e.parameters[name].scan.forms(blocks.length, blocks.swing(e))
        # Finer than the blocks nothing is seen; instants are placed down to the sample later.
        values = values[:: max(1, -(-len(values) // MOST_BLOCKS))]
        if blocks.count < LEAST_BLOCKS or not len(values):
            return None
        events = e.parameters[name].shape
        placed = self._placed(e, name, values, bool(events))
        first = placed.best()
        # What explains nothing explains no more than by chance.
        most = events[0] if events else 1
        tolls = self.chance.tolls(e, name, values, most) if first.gain[0] > 0.0 else np.zeros(most)
        if not events:
            key = Coefficient(e.name, name, ())
            return Form({name: values[first.number[0]]}, (key,), float(tolls[0]))
        instants = sorted(values[_one_by_one(placed, tolls)])
        padded = np.concatenate([instants, np.full(events[0] - len(instants), UNUSED)])
        return Form({name: padded}, (), float(tolls[len(instants) - 1]))

    def _placed(self, e: Effect, name: str, values: np.ndarray, more: bool) -> Placed:
        made, axes = self.blocks.columns(e, name, values), {}
        for i, walks in self.axes.items():
            of_axis = [one[i] for one in made]
            axes[i] = [
                Explained(w, beside(self.blocks.white(of_axis, w.noise)[0], w.base), more)
                for w in walks
            ]
        return Placed(axes, self.chance.penalty)


def _one_by_one(placed: Placed, tolls: np.ndarray) -> list[int]:
    """Numbers of the values that explain most, each beside those before; at least one."""
    found: list[int] = []
    for toll in np.diff(tolls, prepend=0.0):
        best = placed.best()
        number = int(best.number[0])
        if found and (best.gain[0] <= toll - np.log(CHANCE) or number in found):
            break
        found.append(number)
        placed.take(best)
    return found
