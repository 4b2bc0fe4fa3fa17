"""Generalised least squares in the squares of the coefficients, none negative, and which of them
are needed; see ``coefficients``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import nnls
from scipy.stats import chi2, gamma, norm

from pyimu.characterization.allan.moments import TERMS, AllanMoments

CHANCE = 1e-3
"""A term is needed where noise without it would look as if it had as much of it with at most this
probability."""

RAMP = TERMS.index("R")
"""The terms before it are noise."""

ROUNDS, CLOSE = 40, 1e-6
"""Repetitions at most, and the relative change that ends them."""


@dataclass(frozen=True)
class Problem:
    """Allan variances ``measured`` (t,) and their moments; squares of coefficients are (5,), for a
    sample period of one.

    ``nuisance`` (t, k) are columns of which any amount, of any sign, may be in the variances: they
    are left out of the fit.
    """

    moments: AllanMoments
    measured: np.ndarray
    nuisance: np.ndarray = None

    def __post_init__(self) -> None:
        if self.nuisance is None:
            object.__setattr__(self, "nuisance", np.empty((len(self.measured), 0)))

    def fit(self, kept: Sequence[int]) -> np.ndarray:
        """Squares of the terms ``kept``, none negative, zero of the others, under the weights that
        they themselves make.
        """
        root = np.diag(self.measured * np.sqrt(self.moments.m))
        squares = np.zeros(len(TERMS))
        for _ in range(ROUNDS):
            before = squares
            squares = self._non_negative(kept, root)
            if np.all(np.abs(squares - before) <= CLOSE * (squares + before)) or not np.any(
                squares[:RAMP]
            ):
                break
            root = np.linalg.cholesky(self.moments.covariance(squares))
        return squares

    def _non_negative(self, kept: Sequence[int], root: np.ndarray) -> np.ndarray:
        """Least squares under the covariance root root^T."""
        # Not a triangular solve: libraries share even such small ones among processors, and wait
        # for them a hundred times longer.
        white = np.linalg.solve(
            root, np.column_stack([self.nuisance, self.moments.design[:, kept], self.measured])
        )
        white = _without(white[:, : self.nuisance.shape[1]], white[:, self.nuisance.shape[1] :])
        size = np.linalg.norm(white[:, :-1], axis=0)
        squares = np.zeros(len(TERMS))
        squares[kept] = nnls(white[:, :-1] / size, white[:, -1])[0] / size
        return squares

    def functionals(self, terms: Sequence[int], squares: np.ndarray) -> np.ndarray:
        """Rows (k, t) whose products with Allan variances are the estimates, of any sign, of
        ``terms`` under the weights of given squares.
        """
        x = np.column_stack([self.moments.design[:, terms], self.nuisance])
        weighted = cho_solve(cho_factor(self.moments.covariance(squares), lower=True), x).T
        size = 1 / np.sqrt(np.sum(weighted.T * x, axis=0))
        return (
            size[:, None]
            * np.linalg.solve(weighted @ x * np.outer(size, size), size[:, None] * weighted)
        )[: len(terms)]

    def covariance(self, kept: Sequence[int], squares: np.ndarray) -> np.ndarray:
        """Of the estimates (k, k) of the terms ``kept``, which have these squares."""
        rows = self.functionals(kept, squares)
        return rows @ self.moments.covariance(squares) @ rows.T

    def misfit(self, squares: np.ndarray) -> float:
        """The weighted sum of squares that is left; infinite where the squares are those of no
        noise.
        """
        if not np.any(squares[:RAMP]):
            return np.inf
        left = np.column_stack([self.nuisance, self.measured - self.moments.design @ squares])
        white = np.linalg.solve(np.linalg.cholesky(self.moments.covariance(squares)), left)
        return float(np.sum(_without(white[:, :-1], white[:, -1:]) ** 2))

    def needed(self, chosen: Sequence[int]) -> list[int]:
        """Those of the terms that are left when, one after the other, the least needed has gone."""
        kept = list(chosen)
        while len(kept) > 1:
            squares = self.fit(kept)
            chances = [self._chance(i, kept, squares) for i in kept]
            if max(chances) <= CHANCE:
                break
            kept.pop(int(np.argmax(chances)))
        return kept

    def _chance(self, i: int, kept: Sequence[int], squares: np.ndarray) -> float:
        """Probability, at most, that noise of the other terms gives term i an estimate as large as
        it has.

        Once under the weights of that noise, which are the sharpest for a small term but put a
        random walk into the longest cluster alone; and once under those of the fit ``squares`` of
        all ``kept``.
        """
        if squares[i] == 0:
            return 1.0
        others = self.fit([j for j in kept if j != i])
        if not np.any(others[:RAMP]):
            return 0.0
        return 2 * min(self._tail(i, weights, others) for weights in (others, squares))

    def _tail(self, i: int, weights: np.ndarray, others: np.ndarray) -> float:
        row = self.functionals([i, *(j for j in np.flatnonzero(weights) if j != i)], weights)[0]
        std, shape = self._spread(row, others)
        excess = row @ (self.measured - self.moments.design @ others) / std
        return float(gamma.sf(shape + excess * np.sqrt(shape), shape))

    def _spread(self, row: np.ndarray, squares: np.ndarray) -> tuple[float, float]:
        """Standard deviation of the product of ``row`` with the Allan variances, and the shape of a
        gamma distribution as skew.

        Its skewness is taken for the mean of those of the Allan variances, in proportion to what
        they contribute to its variance.
        """
        covariance = self.moments.covariance(squares)
        shares = row * (covariance @ row)
        variance = np.sum(shares)
        skewness = (
            np.abs(shares)
            / variance
            @ (2 * np.sqrt(np.diag(covariance)) / (self.moments.design @ squares))
        )
        return float(np.sqrt(variance)), float(4 / skewness**2)

    def bound(self, i: int, kept: Sequence[int], squares: np.ndarray, level: float) -> float:
        """Square of term i, added to those ``kept``, below which its estimate lies with the
        probability 1 - ``level`` as far as it does.
        """
        most, bound, squares = self._alone(i, level), 0.0, squares.copy()
        for _ in range(ROUNDS):
            squares[i], before = bound, bound
            row = self.functionals([i, *kept], squares)[0]
            std, _ = self._spread(row, squares)
            bound = max(row @ self.measured, 0.0) + std * norm.ppf(level)
            bound = max(bound, before)
            if bound >= most:
                return most
            if bound - before <= CLOSE * bound:
                break
        return bound

    def _alone(self, i: int, level: float) -> float:
        """The same where no other term is there: no cluster's variance comes out so much smaller
        than the term alone makes it.

        Of so many clusters one is low by chance: each counts with its share of the probability. A
        ramp is counted as a walk.
        """
        k = min(i, RAMP - 1)
        spread = np.diagonal(self.moments.products[k, k])
        freedom = self.moments.design[:, k] ** 2 / spread
        return float(
            np.min(
                self.measured
                / self.moments.design[:, i]
                * freedom
                / chi2.ppf((1 - level) / len(freedom), freedom)
            )
        )


def _without(columns: np.ndarray, others: np.ndarray) -> np.ndarray:
    """``others`` (t, k) less their projections on ``columns`` (t, j)."""
    if not columns.shape[1]:
        return others
    q, _ = np.linalg.qr(columns)
    return others - q @ (q.T @ others)
