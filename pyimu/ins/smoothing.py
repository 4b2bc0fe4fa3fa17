"""The fixed-interval smoother of Rauch, Tung and Striebel 1965 over the filter's estimates.

With the error of the filter's estimate after sample k, given all samples, a mean m_k and a
covariance S_k; the prediction for sample k + 1 with its covariance P-; the transition F; and the
error d that the updates of sample k + 1 took out of the prediction (Sarkka 2013, section 8.2, on
the error state):

    C = P F^T (P-)^-1,    m_k = C (d + m_k+1),    S_k = P + C (S_k+1 - P-) C^T.

What the recursion needs of a sample, some thousand numbers, is made again segment by segment from
states that the filter kept, from the last segment back: memory does not grow with the log beyond
its results.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.linalg.lapack import dposv
from scipy.spatial.transform import Rotation

from pyimu.attitude.input_grid import InputGrid
from pyimu.block.block import Block, Run
from pyimu.ins.filter.layout import POSITION, TURN, VELOCITY, Layout
from pyimu.ins.filter.variables import OUTPUTS
from pyimu.ins.filtered import advance, widened
from pyimu.ins.track import Track

SEGMENT = 512
"""Samples of a segment."""


def smoothed(
    recorded: Block,
    layout: Layout,
    grid: InputGrid,
    p: np.ndarray,
    time: np.ndarray,
    speed: float,
    say: Callable[..., None],
) -> Track:
    """The track by all samples; ``recorded`` is the filter with what a smoother needs."""
    cuts = grid.cuts(SEGMENT)
    run = Run(recorded, int(grid.rows[-1]) + 1, p=p, sample_period=grid.period)
    u = np.empty((min(SEGMENT, int(grid.rows[-1]) + 1), len(grid.columns)))
    y = np.empty((len(u), len(recorded.outputs)))
    states = []
    for i, cut in enumerate(cuts):
        widened(run.state, layout, cut.left_out, speed)
        states.append(run.state.copy())
        advance(run, grid.piece(cut, u), y[: cut.size])
        say("filtering for the smoother", (i + 1) / len(cuts) / 2)
    out, back = _Rows(len(time)), _Backward(layout)
    for i in reversed(range(len(cuts))):
        run.state[:] = states[i]
        piece = grid.piece(cuts[i], u)
        rows = y[: cuts[i].size]
        advance(run, piece, rows)
        mean, covariance = back.over(rows)
        out.keep(rows, mean, covariance, piece, back.centres(rows))
        say("smoothing", 0.5 + (len(cuts) - i) / len(cuts) / 2)
    return out.track(time)


class _Backward:
    """The recursion, from the last sample on; ``over`` goes back over one segment."""

    def __init__(self, layout: Layout) -> None:
        n = layout.errors
        packed = n * (n + 1) // 2
        first = len(OUTPUTS)
        ends = np.cumsum([first, packed, layout.packed, n, n * n])
        self.before, self.after, self.moved, self.transition = (
            slice(a, b) for a, b in zip(ends[:-1], ends[1:], strict=True)
        )
        self.nominal, self.centre, self.n = layout.nominal, layout.centre, n
        self.upper = np.triu_indices(n)
        self.next: tuple[np.ndarray, ...] | None = None

    def _unpacked(self, rows: np.ndarray) -> np.ndarray:
        out = np.empty((len(rows), self.n, self.n))
        i, j = self.upper
        out[:, i, j] = rows
        out[:, j, i] = rows
        return out

    def over(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Means (m, n) and covariances (m, n, n) of the filter's errors given all samples."""
        before = self._unpacked(y[:, self.before])
        after = self._unpacked(y[:, self.after][:, self.nominal :])
        moved = y[:, self.moved]
        transition = y[:, self.transition].reshape(-1, self.n, self.n).transpose(0, 2, 1)
        scale = np.sqrt(np.maximum(np.diagonal(before, axis1=1, axis2=2), 1e-30))
        unit = before / scale[:, None, :] / scale[:, :, None]
        unit[:, *np.diag_indices(self.n)] += 1e-13
        mean, covariance = np.zeros_like(moved), np.empty_like(after)
        for k in reversed(range(len(y))):
            mean[k], covariance[k] = self._back(after[k])
            # what y holds is gone when the segment before takes its place
            kept = transition[k].copy() if k == 0 else transition[k]
            self.next = (before[k], unit[k], scale[k], kept, moved[k] + mean[k], covariance[k])
        return mean, covariance

    def centres(self, y: np.ndarray) -> np.ndarray:
        """The places (m, 3) about which the heading's errors turn the positions."""
        return y[:, self.after][:, self.centre]

    def _back(self, own: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        if self.next is None:
            return np.zeros(self.n), own
        predicted, unit, scale, transition, mean, covariance = self.next
        cross = (own @ transition.T) / scale
        _, solved, wrong = dposv(unit, cross.T)
        if wrong:
            raise np.linalg.LinAlgError("a predicted covariance is not positive definite")
        gain = solved.T / scale
        after = own + gain @ (covariance - predicted) @ gain.T
        return gain @ mean, (after + after.T) / 2


def _skew(v: np.ndarray) -> np.ndarray:
    """The matrices (m, 3, 3) of the cross products v x (3,)."""
    x, y, z = v.T
    none = np.zeros_like(x)
    rows = [[none, -z, y], [z, none, -x], [-y, x, none]]
    return np.array(rows).transpose(2, 0, 1)


class _Rows:
    """The smoothed estimates at the recording's rows."""

    def __init__(self, count: int) -> None:
        self.q = np.empty((count, 4))
        self.velocity, self.position = np.empty((count, 3)), np.empty((count, 3))
        self.std = np.empty((count, 9))
        self.correlation = np.empty(count)

    def keep(
        self, y: np.ndarray, mean: np.ndarray, covariance: np.ndarray, piece, centre: np.ndarray
    ) -> None:
        at, rows = piece.at, piece.rows
        y, mean, covariance, centre = y[at], mean[at], covariance[at], centre[at]
        turn = Rotation.from_rotvec(mean[:, TURN])
        q = turn * Rotation.from_quat(y[:, :4], scalar_first=True)
        self.q[rows] = q.as_quat(scalar_first=True)
        velocity = turn.apply(y[:, 7:10] + mean[:, VELOCITY])
        self.velocity[rows] = velocity
        about = Rotation.from_rotvec(mean[:, TURN] * [0.0, 0.0, 1.0])
        away = about.apply(y[:, 10:13] - centre + mean[:, POSITION])
        position = centre + away
        self.position[rows] = position
        plain = np.tile(np.eye(9), (len(y), 1, 1))
        plain[:, VELOCITY, TURN] = -_skew(velocity)
        plain[:, POSITION, 2] = -_skew(away)[:, :, 2]
        own = plain @ covariance[:, :9, :9] @ plain.transpose(0, 2, 1)
        variance = np.maximum(np.diagonal(own, axis1=1, axis2=2), 0)
        self.std[rows] = np.sqrt(variance)
        both = np.sqrt(variance[:, 6] * variance[:, 7])
        self.correlation[rows] = own[:, 6, 7] / np.maximum(both, 1e-30)

    def track(self, time: np.ndarray) -> Track:
        return Track(
            "smoother",
            time,
            self.q,
            self.velocity,
            self.position,
            self.std[:, 6:9],
            self.std[:, 3:6],
            self.std[:, 0:3],
            self.correlation,
        )
