"""What values of a form explain of a residual beside a random walk whose size nobody knows.

The walk is estimated anew beside each value, for a step that is taken for the walk makes it look
larger, and a walk that is taken for steps makes it look smaller. A part's declared walk may be
larger than it says, and is never smaller.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from scipy.special import logsumexp

from pyimu.identification.fit.whiten import WALKS
from pyimu.identification.search.blocks import Blocks, basis

FACTOR = 4.0
"""From one walk's K^2 that is tried to the next."""

BEYOND = 2
"""Larger walks that are tried than the residual allows."""

UNLIKELY = 1e-4
"""Weight of a walk that the residual does not allow."""

LARGER = 0.01
"""Share of declared walks that are larger than they were declared."""

SHOWN = 1e-6
"""Share of a column that others must leave of it to explain something."""


@dataclass(frozen=True)
class Walk:
    """An axis beside one noise: an orthonormal ``base`` (n, b) of what the model explains, draws
    (n, d) of the residual, white and without that, and their log-likelihood (d,) [nat].
    """

    noise: WALKS
    base: np.ndarray
    draws: np.ndarray
    likelihood: np.ndarray

    @classmethod
    def of(
        cls,
        blocks: Blocks,
        noise: WALKS,
        left: Sequence[np.ndarray],
        drawn: Sequence[np.ndarray],
    ) -> Walk:
        """That of draws (blocks, d) of each trial; its ``left`` (blocks, 1 + P) has the columns of
        the model.
        """
        count = drawn[0].shape[1]
        both = [np.hstack([d, c[:, 1:]]) for d, c in zip(drawn, left, strict=True)]
        white, log_det = blocks.white(both, noise)
        base, draws = basis(white[:, count:]), white[:, :count]
        draws = draws - base @ (base.T @ draws)
        return cls(noise, base, draws, -0.5 * (np.sum(draws**2, axis=0) + log_det))


def allowed(
    blocks: Blocks, noise: WALKS, left: Sequence[np.ndarray], declared: float
) -> tuple[list[WALKS], np.ndarray]:
    """The walks that a residual allows or that are less, and the logarithms of their weights: the
    restricted likelihood, all sizes K alike beforehand (``fit/walk.py``) where none is ``declared``
    (K^2), else no less than that, and larger with the probability ``LARGER``.
    """
    rows = sum(len(one.time) for _, one, *_ in blocks.trials)
    r = noise.slow.r
    least = declared or r / rows / blocks.length
    count = max(c for *_, c in blocks.trials)
    most = FACTOR**BEYOND * max(r / count / blocks.block, FACTOR * noise.k2)
    number = 1 + int(np.ceil(np.log(most / least) / np.log(FACTOR)))
    tried, weights = [], []
    for k2 in least * FACTOR ** np.arange(max(number, 2)):
        one = replace(noise, k2=float(k2))
        white, log_det = blocks.white(left, one)
        base = basis(white[:, 1:])
        rest = white[:, 0] - base @ (base.T @ white[:, 0])
        tried.append(one)
        weights.append(-0.5 * (float(rest @ rest) + log_det) - _log_volume(white[:, 1:]))
    sizes = np.array([n.k2 for n in tried])
    before = np.log(LARGER) * (sizes > declared) if declared else 0.5 * np.log(sizes)
    likely = np.array(weights) + before
    likely -= logsumexp(likely)
    # Of a draw a larger walk may be the likeliest than the one that it was drawn with.
    last = int(np.flatnonzero(likely > np.log(UNLIKELY))[-1]) + BEYOND
    return tried[: last + 1], likely[: last + 1]


class Explained:
    """What values explain of the draws of an axis beside one walk, those before being in.

    ``score`` and ``power`` (T, d) are those of each value's column without the columns before,
    ``likelihood`` (d,) that of what is in; ``more`` says that values are to be put in.
    """

    def __init__(self, walk: Walk, columns: np.ndarray, more: bool) -> None:
        self.score, count = columns.T @ walk.draws, walk.draws.shape[1]
        power = np.einsum("nt,nt->t", columns, columns)
        self.power = np.repeat(power[:, None], count, axis=1)
        self.likelihood = walk.likelihood.copy()
        # What is kept of many walks at once is kept in single precision.
        self.columns = columns.astype(np.float32) if more else np.zeros((0, 0), np.float32)
        self.gram = self.columns.T @ self.columns if more and count > columns.shape[1] else None
        self.before = np.zeros((0, *self.score.shape), np.float32)

    def gain(self, best: np.ndarray) -> None:
        """Raise ``best`` (T, d) to the log-likelihood [nat] beside each value."""
        _gain(self.score, self.power, self.likelihood, best)

    def take(self, best: np.ndarray, wanted: np.ndarray) -> None:
        """Put the values ``best`` (d,) in, in the draws that are ``wanted`` (d,)."""
        if self.gram is None:
            column = self.columns.T @ np.take(self.columns, best, axis=1)
        else:
            column = np.take(self.gram, best, axis=1)
        _take(best, wanted, column, self.before, self.score, self.power, self.likelihood)
        self.before = np.concatenate([self.before, column[None]])


@njit(cache=True)
def _gain(score, power, likelihood, best):
    """What ``Explained.gain`` does."""
    for t in range(score.shape[0]):
        for d in range(score.shape[1]):
            found = likelihood[d]
            if power[t, d] > SHOWN:
                found += 0.5 * score[t, d] ** 2 / power[t, d]
            best[t, d] = max(best[t, d], found)


@njit(cache=True)
def _take(best, wanted, column, before, score, power, likelihood):
    """What ``Explained.take`` does with the products ``column`` (T, d) of all columns with those
    that are put in, which become what is left of these beside those ``before`` (k, T, d).
    """
    along, share = np.zeros(len(best)), np.zeros(len(best))
    own = np.empty((len(before), len(best)), before.dtype)
    for d in range(len(best)):
        for other in range(len(before)):
            own[other, d] = before[other, best[d], d]
        size = power[best[d], d]
        if wanted[d] and size > SHOWN:
            share[d] = 1.0 / np.sqrt(size)
            along[d] = share[d] * score[best[d], d]
            likelihood[d] += 0.5 * along[d] ** 2
    for t in range(score.shape[0]):
        for other in range(len(before)):
            for d in range(len(best)):
                column[t, d] -= before[other, t, d] * own[other, d]
        for d in range(len(best)):
            left = share[d] * column[t, d]
            score[t, d] -= left * along[d]
            power[t, d] -= left**2
            column[t, d] = left


@dataclass(frozen=True)
class Best:
    """The ``number`` (d,) of the value that explains most of each draw, its ``gain`` (d,) [nat] on
    the axes that pay for it, and which those are (d,), by axis.
    """

    number: np.ndarray
    gain: np.ndarray
    pays: dict[int, np.ndarray]


class Placed:
    """Values that are put in one after another, in each of the draws where they explain most.

    ``axes`` has the walks of each axis, ``penalty`` [nat] is what a coefficient has to pay.
    """

    def __init__(self, axes: dict[int, list[Explained]], penalty: float) -> None:
        self.axes, self.penalty = axes, penalty

    def best(self) -> Best:
        """What explains most beside what is in."""
        gains = {i: self._gain(walks) for i, walks in self.axes.items()}
        total = np.sum([np.maximum(g, 0.0) for g in gains.values()], axis=0)
        number = np.argmax(total, axis=0)
        at = number, np.arange(len(number))
        return Best(number, total[at], {i: g[at] > 0.0 for i, g in gains.items()})

    def _gain(self, walks: list[Explained]) -> np.ndarray:
        """Gain (T, d) [nat], penalised, of each value on an axis, beside the walk that suits it
        best, over the likeliest walk without it.
        """
        with_it = np.full(walks[0].score.shape, -np.inf)
        for one in walks:
            one.gain(with_it)
        return with_it - np.max([one.likelihood for one in walks], axis=0) - self.penalty

    def take(self, best: Best) -> None:
        """Put it in, on the axes that pay for it."""
        for i, walks in self.axes.items():
            for one in walks:
                one.take(best.number, best.pays[i])


def _log_volume(columns: np.ndarray) -> float:
    """Half the logarithm of the determinant of what columns say of their coefficients."""
    sizes = np.linalg.svd(columns, compute_uv=False)
    return float(np.log(sizes[sizes > 1e-9 * sizes.max(initial=0.0)]).sum())
