"""Normal equations of whitened rows."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product

import numpy as np

from pyimu.identification.fit.columns import Linear, Stack
from pyimu.identification.fit.filters import Filter
from pyimu.identification.fit.keys import Key, LogBias, LogTurn
from pyimu.identification.fit.reduction import Unit
from pyimu.identification.fit.whiten import Autoregressive, RandomWalk

BATCHES = 80
"""Batches into which all rows are cut to see how much the scores really scatter."""


TOGETHER = 1 << 16
"""Numbers that are whitened at once: as many as the cache holds."""

TURN = np.pi / np.sqrt(3.0)
"""rad; standard deviation of an angle of which nothing is known."""

DEAD = 1e-9
"""Share of a column's power below which what others leave of it is rounding."""

Noise = dict[int, "RandomWalk | Autoregressive | Unit"]


@dataclass
class Normal:
    """Normal equations in whitened units, whole and by batch.

    ``gram`` (P, P), ``score`` (P,), for named columns. ``seen`` (P, P) is the Gram matrix of the
    columns as they are, where the noise of a reference was taken out of ``gram``: what that adds to
    a column is no slope, but scatters its score as much as any. ``doubt`` (k, P) are standard
    errors of ``score``, independent of each other, by what is not known of that noise.
    """

    keys: list[Key]
    batch_gram: np.ndarray
    batch_score: np.ndarray
    power: float
    rows: int
    log_det: float
    seen: np.ndarray | None = None
    doubt: np.ndarray | None = None

    @cached_property
    def gram(self) -> np.ndarray:
        return self.batch_gram.sum(axis=0)

    @cached_property
    def score(self) -> np.ndarray:
        return self.batch_score.sum(axis=0)

    @property
    def variance(self) -> np.ndarray:
        """Covariance (P, P) of ``score`` where nothing is left to explain."""
        known = self.gram if self.seen is None else self.seen
        return known if self.doubt is None else known + self.doubt.T @ self.doubt

    @cached_property
    def position(self) -> dict[Key, int]:
        return {k: i for i, k in enumerate(self.keys)}

    @property
    def log_likelihood(self) -> float:
        """Gaussian log-likelihood [nat] of the residual as it stands, constant left out."""
        return -0.5 * (self.power + self.log_det)


def normal_equations(linears: list[Linear], noise: Noise) -> Normal:
    """Whiten residual and columns, axis by axis, and add up what the rows say."""
    keys = list(dict.fromkeys(k for one in linears for i in one.keys for k in one.keys[i]))
    position = {k: i for i, k in enumerate(keys)}
    batches = [
        max(2, round(BATCHES * len(one.time) / max(1, sum(len(o.time) for o in linears))))
        for one in linears
    ]
    gram = np.zeros((sum(batches), len(keys), len(keys)))
    score = np.zeros((sum(batches), len(keys)))
    power, log_det, rows, first = 0.0, 0.0, 0, 0
    for one, count in zip(linears, batches, strict=True):
        edges = np.linspace(0, len(one.time), count + 1).astype(int).tolist()
        for i, columns in one.columns.items():
            at = [position[k] for k in one.keys[i]]
            white = noise[i].filter(one.time, one.segments)
            products = _products(white, one.residual[:, i], columns, edges)
            power += float(products[:, 0, 0].sum())
            log_det += white.log_det
            rows += len(one.time)
            batch, runs = slice(first, first + count), in_slices(at, range(1, 1 + len(at)))
            for to, a in runs:
                score[batch, to] += products[:, 0, a]
            for (to, a), (across, b) in product(runs, runs):
                gram[batch, to, across] += products[:, a, b]
        first += count
    return Normal(keys, gram, score, power, rows, log_det)


def in_slices(to: Sequence[int], of: Sequence[int]) -> list[tuple[slice, slice]]:
    """Places ``to`` (c,), and ``of`` (c,) which each belongs there, as few slices of both."""
    pairs = list(zip(to, of, strict=True))
    breaks = [k for k, (one, two) in enumerate(pairwise(pairs), 1) if _is_break(one, two)]
    edges = [0, *breaks, len(pairs)]
    ends = [(*pairs[a], b - a) for a, b in pairwise(edges) if b > a]
    return [(slice(at, at + count), slice(there, there + count)) for at, there, count in ends]


def _is_break(one: tuple[int, int], two: tuple[int, int]) -> bool:
    return two[0] - one[0] != 1 or two[1] - one[1] != 1


def _products(white: Filter, residual: np.ndarray, columns: Stack, edges: list[int]) -> np.ndarray:
    """Sums of products (batches, 1 + c, 1 + c) of whitened rows between ``edges`` (batches + 1,),
    the residual's (m,) first and those of the columns (m, c) after it.
    """
    width, first = 1 + columns.shape[1], 0
    out = np.empty((len(edges) - 1, width, width))
    while first < len(out):
        # As many batches as fit into the cache are whitened together.
        most = edges[first] + TOGETHER // width
        last = max(first + 1, bisect_right(edges, most) - 1)
        a, b = edges[first], edges[last]
        block = white.next(columns.after(residual[a:b, None], a, b))
        for batch in range(first, last):
            rows = block[edges[batch] - a : edges[batch + 1] - a]
            np.matmul(rows.T, rows, out=out[batch])
        first = last
    return out


def _scaled(gram: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Scale of each column, eigenvalues and eigenvectors of the scaled matrix, and which directions
    the data show.
    """
    power = np.diag(gram)
    scale = np.sqrt(np.where(power > 1e-300, power, 1.0))
    values, vectors = np.linalg.eigh(gram / np.outer(scale, scale))
    return scale, values, vectors, values > DEAD * max(values.max(initial=0.0), 1e-300)


def variances(gram: np.ndarray, seen: np.ndarray | None = None) -> np.ndarray:
    """Variances (P,) of the solution; ``seen`` (P, P) is the covariance of the scores where it is
    not ``gram`` (Huber 1967, the sandwich of both).

    Infinite for a coefficient that a direction which the data do not show takes part in.
    """
    scale, values, vectors, keep = _scaled(gram)
    if seen is None:
        shown = np.sum(vectors[:, keep] ** 2 / values[keep], axis=1) / scale**2
    else:
        inverse = (vectors[:, keep] / values[keep]) @ vectors[:, keep].T
        # A column that the data do not show has no slope, however much its score scatters.
        unit = np.where(np.diag(gram) > 0.0, 1.0 / scale, 0.0)
        shown = np.sum(inverse * (inverse @ (seen * np.outer(unit, unit))), axis=1) / scale**2
    hidden = np.sum(vectors[:, ~keep] ** 2, axis=1)
    return np.where(hidden > 1e-6, np.inf, shown)


def standard_errors(normal: Normal) -> dict[Key, float]:
    """Standard errors of the solution by key; those of biases are beside mountings that have any
    turn, and no more. Of one that the logs do not show slopes alone make many, and a bias beside
    gravity as unsure.
    """
    gram = normal.gram
    seen = None if normal.seen is None else normal.variance
    found = variances(gram, seen)
    bound = np.diag([TURN**-2.0 * isinstance(k, LogTurn) for k in normal.keys])
    if bound.any():
        bounded = variances(gram + bound, None if seen is None else seen + bound)
        biases = np.array([isinstance(k, LogBias) for k in normal.keys])
        found = np.where(biases & np.isfinite(found), np.minimum(found, bounded), found)
    return dict(zip(normal.keys, np.sqrt(found).tolist(), strict=True))


def covariance(gram: np.ndarray, seen: np.ndarray | None = None) -> np.ndarray:
    """Covariance (P, P) of the solution, in the directions that the data show; ``seen`` as in
    ``variances``.
    """
    inverse = solve(gram, np.eye(len(gram)))
    return inverse if seen is None else inverse @ seen @ inverse.T


def log_determinant(gram: np.ndarray) -> float:
    """Logarithm of the determinant of normal equations, in the directions that the data show."""
    scale, values, _, keep = _scaled(gram)
    return float(np.sum(np.log(values[keep])) + 2.0 * np.sum(np.log(scale)))


def solve(gram: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Least-norm solution of normal equations.

    Directions that the data do not show stay where they are.
    """
    scale, values, vectors, keep = _scaled(gram)
    turned = vectors[:, keep].T @ (right / (scale if right.ndim == 1 else scale[:, None]))
    inverse = values[keep] if right.ndim == 1 else values[keep][:, None]
    answer = vectors[:, keep] @ (turned / inverse)
    return answer / (scale if right.ndim == 1 else scale[:, None])
