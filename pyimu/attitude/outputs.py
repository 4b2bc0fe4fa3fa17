"""The outputs of the attitude filter at a recording's rows."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from pyimu.attitude.filter.memory import BIAS_VARIANCE
from pyimu.attitude.input_grid import CHUNK, InputGrid, Piece
from pyimu.block.block import Block, Run

KEPT = {
    "q": (4, float),
    "gyro_bias": (3, float),
    "std": (6, float),
    "quasi_static": (0, bool),
    "nis": (0, float),
    "status": (0, np.uint16),
    "heading_std": (0, float),
    "at_rest": (0, bool),
}
"""The block's outputs that a result keeps, how many numbers each has (0: one, without an axis), and
their type."""


class Kept:
    """The outputs at the recording's rows, (n,) or (n, size) by name in ``arrays``."""

    def __init__(self, block: Block, rows: int) -> None:
        names = [v.name for v in block.outputs]
        self.first = {n: names.index(f"{n}[1]" if size else n) for n, (size, _) in KEPT.items()}
        self.arrays = {
            n: np.empty((rows, size) if size else rows, dtype=kind)
            for n, (size, kind) in KEPT.items()
        }

    def keep(self, y: np.ndarray, rows: slice, at: np.ndarray) -> None:
        """The ``rows`` from the outputs (m, ny) of a piece, in which they stand ``at`` (r,)."""
        found = y if len(at) == len(y) else y[at]
        for n, (size, _) in KEPT.items():
            first = self.first[n]
            self.arrays[n][rows] = found[:, first : first + size] if size else found[:, first]


def advance(steps: Run, piece: Piece, y: np.ndarray) -> None:
    """Run over a piece; the outputs (m, ny) are written into ``y``."""
    for samples, period in piece.periods:
        steps.advance(piece.inputs[samples], y=y[samples], sample_period=period)


def filtered(block: Block, grid: InputGrid, steps: Run, walk: np.ndarray) -> dict[str, np.ndarray]:
    """The outputs at the recording's rows.

    Over what a gap exceeds its missing samples by, the bias walks on with the variance ``walk``
    (3,) in a second.

    A second thread puts away what has been made, because memory that is touched for the first time
    can cost more than the filter.
    """
    kept, width = Kept(block, len(grid.rows)), len(block.outputs)
    buffers = [np.empty((min(CHUNK, grid.rows[-1] + 1), width)) for _ in range(2)]
    with ThreadPoolExecutor(1) as second:
        before = None
        for piece in grid.pieces():
            steps.state[list(BIAS_VARIANCE)] += walk * piece.left_out
            buffers.reverse()
            y = buffers[0][: len(piece.inputs)]
            advance(steps, piece, y)
            if before is not None:
                before.result()
            before = second.submit(kept.keep, y, piece.rows, piece.at)
        before.result()
    return kept.arrays
