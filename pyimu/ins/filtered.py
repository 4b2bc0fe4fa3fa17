"""The filter over a recording: its inputs, its run, and its outputs at the recording's rows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyimu.attitude.input_grid import InputGrid, Piece
from pyimu.block.block import Block, Run
from pyimu.display.brief import Brief
from pyimu.ins.filter.layout import POSITION, Layout
from pyimu.ins.filter.variables import OUTPUTS
from pyimu.ins.track import Track

Say = Callable[..., None]

COLUMN = {v.name: i for i, v in enumerate(OUTPUTS)}


def columns(name: str, size: int) -> slice:
    """Where the outputs have a vector."""
    first = COLUMN[f"{name}[1]"]
    return slice(first, first + size)


@dataclass(frozen=True, eq=False, repr=False)
class Filtered(Brief):
    """The outputs of the filter at the recording's rows, (n, outputs)."""

    time: np.ndarray
    y: np.ndarray

    def vector(self, name: str, size: int = 3) -> np.ndarray:
        return self.y[:, columns(name, size)]

    def scalar(self, name: str) -> np.ndarray:
        return self.y[:, COLUMN[name]]

    def track(self, method: str) -> Track:
        return Track(
            method,
            self.time,
            self.vector("q", 4),
            self.vector("velocity"),
            self.vector("position"),
            self.vector("position_std"),
            self.vector("velocity_std"),
            self.vector("attitude_std"),
            self.scalar("position_correlation"),
        )


def widened(state: np.ndarray, layout: Layout, left_out: float, speed: float) -> None:
    """What a gap of ``left_out`` s beyond the missing samples adds to the state's variances of the
    position, at a top ``speed`` in m/s.
    """
    if not left_out:
        return
    n, place = layout.errors, layout.nominal
    diagonal = {}
    for i in range(n):
        diagonal[i] = place
        place += n - i
    for i in range(POSITION.start, POSITION.stop):
        known = state[diagonal[i]]
        state[diagonal[i]] = (np.sqrt(known) + speed * left_out) ** 2


def advance(run: Run, piece: Piece, y: np.ndarray) -> None:
    for samples, period in piece.periods:
        run.advance(piece.inputs[samples], y=y[samples], sample_period=period)


def filtered(
    block: Block, layout: Layout, grid: InputGrid, p: np.ndarray, time: np.ndarray, speed: float
) -> Filtered:
    """The block over the grid; ``speed`` m/s is the top speed."""
    run = Run(block, int(grid.rows[-1]) + 1, p=p, sample_period=grid.period)
    out = np.empty((len(time), len(OUTPUTS)))
    for piece in grid.pieces():
        widened(run.state, layout, piece.left_out, speed)
        y = np.empty((len(piece.inputs), len(OUTPUTS)))
        advance(run, piece, y)
        out[piece.rows] = y[piece.at]
    return Filtered(time, out)
