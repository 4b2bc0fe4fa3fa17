"""Candidate columns beside a model, and how much more their scores scatter than its noise says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pyimu.identification.fit.errors_in_variables import LEAST_SEEN
from pyimu.identification.fit.normal import DEAD, Normal, solve


@dataclass(frozen=True)
class Scatter:
    """How much more scores scatter than the noise model says: the mean over all candidates, and for
    how many batches it speaks where a single one is judged.
    """

    mean: float = 1.0
    batches: float = 0.0

    def with_own(self, own: float, batches: float) -> float:
        """The scatter of a candidate that shows ``own`` in so many batches, at least 1.

        A few batches say little by themselves: their word is weighed against that of all candidates
        (empirical Bayes, Efron and Morris 1973, "Stein's estimation rule", JASA 68). These never
        speak for more scatter: what is missing beside each of them makes theirs large.
        """
        if np.isinf(self.batches):
            return max(1.0, min(own, self.mean))
        weights = batches + self.batches
        weighed = (batches * own + self.batches * self.mean) / weights if weights else 1.0
        return max(1.0, min(own, weighed))


ONE = Scatter()
"""Of nothing but the candidate itself."""


@dataclass(frozen=True)
class Projected:
    """Candidate columns with everything that the model already explains projected out.

    ``turn`` (P, candidates) makes them of all columns: each of its own, of the columns ``base``,
    and of nothing else.
    """

    gram: np.ndarray
    score: np.ndarray
    turn: np.ndarray
    normal: Normal
    base: Sequence[int]

    @classmethod
    def of(cls, normal: Normal, base: list[int], wanted: list[int]) -> Projected:
        g = normal.gram
        back = solve(g[np.ix_(base, base)], g[np.ix_(base, wanted)])
        turn = np.zeros((len(normal.keys), len(wanted)))
        turn[wanted, np.arange(len(wanted))] = 1.0
        turn[base] = -back
        raw = np.diag(g)[wanted]
        gram = turn.T @ g @ turn
        # A column that the model explains up to rounding carries nothing; leave it exactly nothing.
        dead = np.diag(gram) < DEAD * raw
        if normal.seen is not None:
            # What is left of it may be the noise of the reference.
            left = np.sum(turn * (normal.seen @ turn), axis=0)
            dead |= np.diag(gram) <= LEAST_SEEN * left
            dead |= left < DEAD * np.diag(normal.seen)[wanted]
        turn[:, dead] = 0.0
        gram[dead] = gram[:, dead] = 0.0
        return cls(gram, turn.T @ normal.score, turn, normal, base)

    @cached_property
    def batch_score(self) -> np.ndarray:
        return self.normal.batch_score @ self.turn

    @cached_property
    def variance(self) -> np.ndarray:
        """Covariance of ``score``."""
        if self.normal.doubt is None:
            return self.scatter
        doubt = self.normal.doubt @ self.turn
        return self.scatter + doubt.T @ doubt

    @cached_property
    def scatter(self) -> np.ndarray:
        """The part of that covariance by which scores differ from batch to batch."""
        seen = self.normal.seen
        return self.gram if seen is None else self.turn.T @ seen @ self.turn

    def batch_gram(self, at: Sequence[int]) -> np.ndarray:
        """Gram matrices (batches, k, k) of the few candidate columns ``at``."""
        turn = self.turn[:, at]
        acts = np.flatnonzero(np.any(turn != 0.0, axis=1))
        turn = turn[acts]
        return turn.T @ self.normal.batch_gram[:, acts[:, None], acts] @ turn

    @property
    def batch_power(self) -> np.ndarray:
        """Diagonals (batches, candidates) of the Gram matrices of all candidate columns."""
        all_grams, shared, own = self.normal.batch_gram, self.turn[self.base], np.array(self.turn)
        own[self.base] = 0.0
        at = own.argmax(axis=0)
        size = own[at, np.arange(len(at))]
        of_base = all_grams[:, np.array(self.base, dtype=int)]
        mixed = 2.0 * size * of_base[:, :, at] + of_base[:, :, self.base] @ shared
        return size**2 * all_grams[:, at, at] + np.sum(shared * mixed, axis=1)


def dispersion(projected: Projected, columns: Sequence[int], scatter: Scatter = ONE) -> float:
    """How much more the scores scatter from batch to batch than the noise model says, at least 1.

    A residual whose variance follows the motion, or that is correlated beyond the whitening, makes
    every gain look larger than it is; the ratio of the empirical to the modelled variance of the
    score puts that right.
    """
    at = list(columns)
    gram, scattered = (m[np.ix_(at, at)] for m in (projected.gram, projected.scatter))
    if not np.any(np.diag(gram)):
        return 1.0
    estimate = solve(gram, projected.score[at])
    batch_gram = projected.batch_gram(at)
    rest = projected.batch_score[:, at] - batch_gram @ estimate
    own = float(np.trace(solve(scattered, rest.T @ rest))) / len(at)
    shares = np.trace(
        solve(gram, batch_gram.transpose(1, 2, 0).reshape(len(at), -1)).reshape(
            len(at), len(at), -1
        )
    ) / len(at)
    return scatter.with_own(*_unbiased(own, float(np.sum(shares**2)), len(at)))


def _unbiased(own: float, concentration: float, coefficients: int = 1) -> tuple[float, float]:
    """A scatter freed of what the estimate took of it, and the batches that it stands for.

    ``concentration`` is the sum of squares of the batches' shares of what is known.
    """
    left = 1.0 - min(concentration, 1.0)
    return (own / left, coefficients * left / concentration) if left > 1e-6 else (1.0, 0.0)


def scatter_of(projected: Projected) -> Scatter:
    """The scatter of all candidates' columns, each by itself, and how much it differs among them
    beyond what the few batches of each make of it.
    """
    gram = np.diag(projected.gram)
    seen = gram > 0.0
    shares = projected.batch_power[:, seen] / gram[seen]
    rest = projected.batch_score[:, seen] - shares * projected.score[seen]
    own = np.sum(rest**2, axis=0) / np.diag(projected.scatter)[seen]
    found = [_unbiased(*v) for v in zip(own, np.sum(shares**2, axis=0), strict=True)]
    values, batches = np.array(found).reshape(-1, 2).T
    if not batches.sum() > 0.0:
        return ONE
    mean = float(np.average(values, weights=batches))
    known = batches > 0.0
    chance = 2.0 * mean**2 / batches[known]
    between = np.average((values[known] - mean) ** 2 - chance, weights=batches[known])
    return Scatter(mean, 2.0 * mean**2 / between if between > 0.0 else np.inf)
