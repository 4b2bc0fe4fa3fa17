"""Turns between rests as the reference of a gyro.

The gravity of one rest, turned by the gyro, must be that of the next.

A turn is two rows: where the turned direction misses the measured one, along two axes across it,
over the turn's time, so that it is a mean rate. A change dw of the rate at time t moves the turned
direction by h C_n [d x] C_t^T dw, d being the direction at the start and C_t what turns a vector
from the body's axes then into those at t (Tedaldi, Pretto and Menegatti 2014, eq. 12, integrates
the same). A rest's own mean rate is no row: a body that rests in a hand may still turn, about the
vertical most of all, by more than a bias is known to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.sparse import coo_array, csr_array

from pyimu.identification.fit.reduction import Reduction, Rows, Segments, compensated
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor


@dataclass(frozen=True)
class Turns(Reduction):
    """A trial of samples with rests in it.

    ``rests`` are their rows, ``turns`` pairs of them, and ``down`` (k, 3) the direction of gravity
    in each; ``seconds`` (n,) is what each sample stands for.
    """

    rests: tuple[np.ndarray, ...]
    turns: tuple[tuple[int, int], ...]
    down: np.ndarray
    seconds: np.ndarray

    def of_gravity(self, errors: np.ndarray) -> np.ndarray:
        """Of gravity's direction after each turn, rad."""
        spans = [self.seconds[self.middles(i, j)].sum() for i, j in self.turns]
        return np.linalg.norm(errors.reshape(-1, 2), axis=1) * spans

    def rows(
        self, sensor: Sensor, y: np.ndarray, u: np.ndarray, segments: Segments, h: float
    ) -> Rows:
        """Two rows for each turn, rad/s."""
        u, back = compensated(sensor, y, u, segments, h)
        rate = u[:, OWN[sensor.kind]]
        parts = [self._turn(rate, i, j) for i, j in self.turns]
        residual, along = (np.concatenate([p[k] for p in parts]) for k in (0, 1))
        each = [(p[2], np.einsum("rni,nij->rnj", p[3], back[p[2]])) for p in parts]
        return Rows(u, residual, _sparse(each, len(rate)), along)

    def middles(self, i: int, j: int) -> np.ndarray:
        """The rows from the middle of rest ``i`` to that of rest ``j``."""
        return np.arange(middle(self.rests[i]), middle(self.rests[j]))

    def _turn(self, rate: np.ndarray, i: int, j: int):
        """Residual (2,), its directions (2, 3), rows (n,), and slopes (2, n, 3) of a turn."""
        at = self.middles(i, j)
        h = self.seconds[at]
        turned = _turned(rate[at], h)
        end, down, span = turned[-1], self.down[i], h.sum()
        across = _across(self.down[j])
        missed = across @ (end @ down - self.down[j]) / span
        lever = across @ end @ np.cross(np.eye(3), down)
        midway = 0.5 * (turned[:-1] + turned[1:])
        slopes = np.einsum("rk,nlk->rnl", lever, midway) * (h / span)[:, None]
        return missed, across, at, slopes

    def tilted(self, rate: np.ndarray, k: int) -> np.ndarray:
        """How the rows (m, 3) follow a change of the direction of gravity in rest ``k``, at rates
        (n, 3).
        """
        out = np.zeros((len(self.time), 3))
        for n, (i, j) in enumerate(self.turns):
            if k in (i, j):
                at = self.middles(i, j)
                end = _turned(rate[at], self.seconds[at])[-1] if k == i else -np.eye(3)
                out[2 * n : 2 * n + 2] = _across(self.down[j]) @ end / self.seconds[at].sum()
        return out


def middle(rest: np.ndarray) -> int:
    """The row in the middle of a rest's rows."""
    return int(rest.mean())


def at_middle(
    down: np.ndarray, rate: np.ndarray, seconds: np.ndarray, rests: Sequence[np.ndarray]
) -> np.ndarray:
    """The directions of gravity (k, 3) in the middle of rests, from their means ``down`` (k, 3).

    A body that rests in a hand turns by some tenths of a degree. With C_t, what turns a vector from
    the axes in the middle into those at t, the mean of C_t d is what was measured, d what is asked
    for. A constant error of the rate (n, 3) cancels to first order, as the middle is the mean time.
    """
    out = []
    for rows, mean in zip(rests, down, strict=True):
        first = rows[0]
        turned = _turned(rate[first : rows[-1] + 1], seconds[first : rows[-1] + 1])
        from_start = turned[rows - first].mean(axis=0)
        at = turned[middle(rows) - first] @ np.linalg.solve(from_start, mean)
        out.append(at / np.linalg.norm(at))
    return np.array(out)


def _sparse(each: list, n: int) -> tuple[csr_array, csr_array, csr_array]:
    """Slopes of all rows against each axis (m, n), of pieces ``(rows (k,), slopes (r, k, 3))``."""
    out, m = [], sum(len(s) for _, s in each)
    starts = np.cumsum([0, *(len(s) for _, s in each)])
    row = np.concatenate(
        [np.repeat(a + np.arange(len(s)), len(at)) for a, (at, s) in zip(starts, each)]
    )
    column = np.concatenate([np.tile(at, len(s)) for at, s in each])
    for axis in range(3):
        values = np.concatenate([s[:, :, axis].ravel() for _, s in each])
        out.append(coo_array((values, (row, column)), shape=(m, n)).tocsr())
    return tuple(out)


def _across(v: np.ndarray) -> np.ndarray:
    """Two unit vectors (2, 3) across a unit vector and each other."""
    return np.linalg.svd(v[None])[2][1:]


@njit(cache=True)
def _turned(rate, h):
    """What turns a vector from the axes at the start into those of each sample and after the last,
    (n + 1, 3, 3), for rates (n, 3) that last ``h`` (n,) s each.
    """
    n = len(rate)
    out = np.empty((n + 1, 3, 3))
    out[0] = np.eye(3)
    for k in range(n):
        x, y, z = -rate[k] * h[k]
        angle = np.sqrt(x * x + y * y + z * z)
        a = np.sin(angle) / angle if angle > 1e-9 else 1.0
        b = 0.5 * (np.sin(0.5 * angle) / (0.5 * angle)) ** 2 if angle > 1e-9 else 0.5
        turn = np.array(
            [
                [1 - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y],
                [b * x * y + a * z, 1 - b * (x * x + z * z), b * y * z - a * x],
                [b * x * z - a * y, b * y * z + a * x, 1 - b * (x * x + y * y)],
            ]
        )
        for i in range(3):
            for j in range(3):
                out[k + 1, i, j] = (
                    turn[i, 0] * out[k, 0, j]
                    + turn[i, 1] * out[k, 1, j]
                    + turn[i, 2] * out[k, 2, j]
                )
    return out
