"""The outputs of a block for arrays as long as a log.

The arrays go through the C of the block's FMU, a piece at a time.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np

from pyimu.block.block import Block, Run
from pyimu.block.variables import Variable
from pyimu.errors import UserError

PIECE = 8192
"""Rows that go through at a time."""


def measure(
    block: Block,
    given: Mapping[str, np.ndarray | float],
    n: int,
    missing: Mapping[int, int],
    seed: int | None,
    sample_period: float,
    wanted: Iterable[str],
) -> dict[str, np.ndarray]:
    """The ``wanted`` groups of outputs, each (n, size), by name.

    ``missing`` gives by row how many samples are missing before it.
    """
    inputs, outputs = _places(block.inputs), _places(block.outputs)
    source = _Inputs(block, inputs, given, n)
    measured = {name: np.empty((n, outputs[name].stop - outputs[name].start)) for name in wanted}
    columns = [
        (outputs[name].start + i, column)
        for name, rows in measured.items()
        for i, column in enumerate(rows.T)
    ]
    run = Run(block, n + sum(missing.values()), seed=seed, sample_period=sample_period)
    y = np.empty((PIECE, len(block.outputs)))
    for start, stop in pairwise([0, *sorted(missing), n]):
        if start:
            for u in source.between(start - 1, start, missing[start]):
                run.advance(u, y=y[: len(u)])
        for k in range(start, stop, PIECE):
            rows = slice(k, min(k + PIECE, stop))
            made = run.advance(source.rows(rows), y=y[: rows.stop - k])
            for column, to in columns:
                to[rows] = made[:, column]
    return measured


def _places(variables: Sequence[Variable]) -> dict[str, slice]:
    """Where each array stands in a vector of scalars that are named ``name`` or ``name[i]``."""
    names = [v.name.partition("[")[0] for v in variables]
    return {name: slice(names.index(name), names.index(name) + names.count(name)) for name in names}


class _Inputs:
    """The inputs of a block, a piece at a time.

    Rows of arrays beside constants, and start values where nothing is given.
    """

    def __init__(
        self,
        block: Block,
        places: Mapping[str, slice],
        given: Mapping[str, np.ndarray | float],
        n: int,
    ) -> None:
        self._u = np.tile([v.start for v in block.inputs], (PIECE, 1))
        self._held = places.get("attitude", slice(0))
        self._columns = []  # one by one, as numpy copies narrow rows slowly
        for name, values in given.items():
            at, values = places[name], np.asarray(values)
            size = at.stop - at.start
            row = () if size == 1 else (size,)
            if values.shape == row:
                self._u[:, at] = values
            elif values.shape == (n, *row):
                self._columns += [
                    (at.start + i, column) for i, column in enumerate(values.reshape(n, size).T)
                ]
            else:
                raise UserError(f"{name} has shape {values.shape}, expected {(n, *row)} or {row}")

    def rows(self, rows: slice) -> np.ndarray:
        """Inputs (rows, nu), good until the next call."""
        u = self._u[: rows.stop - rows.start]
        for at, values in self._columns:
            u[:, at] = values[rows]
        return u

    def between(self, before: int, after: int, count: int) -> Iterator[np.ndarray]:
        """``count`` inputs interpolated linearly between two rows; an attitude is held."""
        first, last = (
            self.rows(slice(before, before + 1))[0].copy(),
            self.rows(slice(after, after + 1))[0].copy(),
        )
        last[self._held] = first[self._held]
        for k in range(0, count, PIECE):
            share = np.arange(k + 1, min(k + PIECE, count) + 1)[:, None] / (count + 1)
            yield first + share * (last - first)
