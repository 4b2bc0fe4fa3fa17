"""The smoothed attitude of a recording: forward by the filter, then back by the smoother.

The smoother needs of each sample what the filter estimated before and after it, and how its errors
changed: two hundred numbers. These are made again from states that the filter kept on its way, one
segment after the other from the last, so that hours of a log take no more memory than their results
and two segments do.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from pyimu.attitude.filter.memory import BIAS_VARIANCE
from pyimu.attitude.filter.passed import AFTER, PACKED
from pyimu.attitude.filter.smoother import before_a_gap, last_belief, smoother
from pyimu.attitude.input_grid import Cut, InputGrid, Piece
from pyimu.attitude.outputs import Kept, advance
from pyimu.block.block import Block, Run

SEGMENT = 4096
"""Samples of a segment; what the smoother needs of them, 7 MB, stays in a processor's cache."""


def smoothed(
    recorded: Block, grid: InputGrid, steps: Run, walk: np.ndarray
) -> dict[str, np.ndarray]:
    """The smoothed outputs at the recording's rows, by the arguments of ``filtered``.

    ``recorded`` is the block of ``steps`` with the outputs that a smoother needs. A second thread
    runs the filter over the segment before while the smoother goes back over one.
    """
    cuts = grid.cuts(SEGMENT)
    states = _states(cuts, grid, steps, walk)
    forward, kept = _Forward(recorded, grid, steps), Kept(smoother(), len(grid.rows))
    back: Run | None = None
    with ThreadPoolExecutor(1) as second:
        coming = second.submit(forward.over, cuts[-1], states[-1])
        for i in reversed(range(len(cuts))):
            piece, rows = coming.result()
            if i:
                coming = second.submit(forward.over, cuts[i - 1], states[i - 1])
            if back is None:
                back = _backward(rows[0, AFTER], grid)
            kept.keep(back.advance(rows)[::-1], piece.rows, piece.at)
            if cuts[i].left_out:
                gap = before_a_gap()(back.state, states[i][:PACKED], walk * cuts[i].left_out)
                back.state = np.array(gap).ravel()
    return kept.arrays


class _Forward:
    """The filter over single segments, in arrays that are used again: what it gives of a segment
    holds until that of the next but one is made.
    """

    def __init__(self, recorded: Block, grid: InputGrid, steps: Run) -> None:
        self.grid, samples = grid, min(SEGMENT, int(grid.rows[-1]) + 1)
        self.run = Run(recorded, grid.rows[-1] + 1, p=steps.p, sample_period=grid.period)
        self.u = np.empty((samples, len(grid.columns)))
        self.rows, *self.reversed = (np.empty((samples, len(recorded.outputs))) for _ in range(3))

    def over(self, cut: Cut, state: np.ndarray) -> tuple[Piece, np.ndarray]:
        """The segment, and what a smoother needs of its samples, last first."""
        piece, self.run.state = self.grid.piece(cut, self.u), state.copy()
        made = self.rows[: cut.size]
        advance(self.run, piece, made)
        self.reversed.reverse()
        out = self.reversed[0][: cut.size]
        out[:] = made[::-1]
        return piece, out


def _backward(after: np.ndarray, grid: InputGrid) -> Run:
    """The smoother at the last sample, ``after`` which the estimate is that of the filter."""
    state = np.array(last_belief()(after)).ravel()
    return Run(smoother(), grid.rows[-1] + 1, state=state)


def _states(cuts: list[Cut], grid: InputGrid, steps: Run, walk: np.ndarray) -> list[np.ndarray]:
    """The filter's state before each segment; over what a gap leaves out the bias has walked on."""
    samples = min(SEGMENT, int(grid.rows[-1]) + 1)
    u, y = (np.empty((samples, n)) for n in (len(grid.columns), len(steps.block.outputs)))
    states = []
    for cut in cuts:
        steps.state[list(BIAS_VARIANCE)] += walk * cut.left_out
        states.append(steps.state.copy())
        if len(states) < len(cuts):
            advance(steps, grid.piece(cut, u), y[: cut.size])
    return states
