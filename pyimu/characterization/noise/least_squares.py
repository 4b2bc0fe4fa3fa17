"""Generalised least squares in the squares of the coefficients, and which of them are needed.

None of the squares may be negative. ``coefficients`` states the method.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import nnls
from scipy.special import gammaincc

from pyimu.characterization.allan.moments import RAMP, AllanMoments
from pyimu.numerics.laws import chi2, norm

CHANCE = 1e-3
"""A term is needed where noise without it would, with at most this probability, look as if it had
as much of it."""

ROUNDS, CLOSE = 40, 1e-6
"""The most repetitions, and the relative change that ends them."""


@dataclass(frozen=True)
class Problem:
    """Allan variances ``measured`` (t,) to fit, and their moments.

    Squares of coefficients are (k,), for a sample period of one, those of ``moments``.
    ``nuisance`` (t, j) are columns of which any amount, of any sign, may be in the variances: they
    are projected out of the fit.
    """

    moments: AllanMoments
    measured: np.ndarray
    nuisance: np.ndarray = None

    def __post_init__(self) -> None:
        if self.nuisance is None:
            object.__setattr__(self, "nuisance", np.empty((len(self.measured), 0)))

    def fit(self, kept: Sequence[int]) -> np.ndarray:
        """Squares (k,) of the terms ``kept``, none negative; those of the others are zero.

        The weights are those of the noise with these squares.
        """
        root = np.diag(self.measured * np.sqrt(self.moments.m))
        columns = np.column_stack([self.nuisance, self.moments.design[:, kept], self.measured])
        squares = np.zeros(self.moments.design.shape[1])
        for _ in range(ROUNDS):
            before = squares
            squares = self._non_negative(kept, columns, root)
            settled = np.all(np.abs(squares - before) <= CLOSE * (squares + before))
            if settled or not has_noise(squares):
                break
            root = np.linalg.cholesky(self.moments.covariance(squares))
        return squares

    def _non_negative(
        self, kept: Sequence[int], columns: np.ndarray, root: np.ndarray
    ) -> np.ndarray:
        """Squares (k,) of the terms ``kept`` by least squares under the covariance root root^T.

        ``columns`` (t, j + k + 1) are the nuisance, the terms and what was measured.
        """
        squares = np.zeros(self.moments.design.shape[1])
        if not len(kept):  # nnls of scipy 1.17 frees memory twice where there is nothing to fit
            return squares
        # Not a triangular solve: libraries divide even such small ones among the processors, which
        # takes a hundred times longer.
        white = np.linalg.solve(root, columns)
        white = without(white[:, : self.nuisance.shape[1]], white[:, self.nuisance.shape[1] :])
        size = np.sqrt(np.sum(np.square(white[:, :-1]), axis=0))
        squares[kept] = nnls(white[:, :-1] / size, white[:, -1])[0] / size
        return squares

    def functionals(self, terms: Sequence[int], squares: np.ndarray) -> np.ndarray:
        """Rows (k, t) whose products with Allan variances are the estimates of ``terms``.

        The estimates may have any sign; the weights are those of noise with these squares.
        """
        x = np.column_stack([self.moments.design[:, terms], self.nuisance])
        weighted = cho_solve(cho_factor(self.moments.covariance(squares), lower=True), x).T
        size = 1 / np.sqrt(np.sum(weighted.T * x, axis=0))
        return (
            size[:, None]
            * np.linalg.solve(weighted @ x * np.outer(size, size), size[:, None] * weighted)
        )[: len(terms)]

    def covariance(self, kept: Sequence[int], squares: np.ndarray) -> np.ndarray:
        """Covariance (k, k) of the estimates of the terms ``kept``, which have these squares."""
        rows = self.functionals(kept, squares)
        return rows @ self.moments.covariance(squares) @ rows.T

    def misfit(self, squares: np.ndarray) -> float:
        """Weighted sum of squared residuals; infinite where the squares are those of no noise."""
        if not has_noise(squares):
            return np.inf
        left = np.column_stack([self.nuisance, self.measured - self.moments.design @ squares])
        white = np.linalg.solve(np.linalg.cholesky(self.moments.covariance(squares)), left)
        return float(np.sum(without(white[:, :-1], white[:, -1:]) ** 2))

    def strengths(self, squares: np.ndarray) -> np.ndarray:
        """The best estimates (j,) of how much of each nuisance there is, given the squares."""
        root = np.linalg.cholesky(self.moments.covariance(squares))
        left = np.column_stack([self.nuisance, self.measured - self.moments.design @ squares])
        white = np.linalg.solve(root, left)
        return np.linalg.lstsq(white[:, :-1], white[:, -1], rcond=None)[0]

    def needed(self, chosen: Sequence[int]) -> list[int]:
        """The terms that remain when those not needed are dropped, the least needed first."""
        kept = list(chosen)
        while len(kept) > 1:
            squares = self.fit(kept)
            chances = [self._chance(i, kept, squares) for i in kept]
            if max(chances) <= CHANCE:
                break
            kept.pop(int(np.argmax(chances)))
        return kept

    def _chance(self, i: int, kept: Sequence[int], squares: np.ndarray) -> float:
        """Bound of the probability that noise without term i gives it as large an estimate.

        Two weights are tried: those of that noise, which are the sharpest for a small term but put
        a random walk into the longest cluster alone, and those of the fit ``squares`` of all terms
        ``kept``.
        """
        if squares[i] == 0:
            return 1.0
        others = self.fit([j for j in kept if j != i])
        if not has_noise(others):
            return 0.0
        return 2 * min(self._tail(i, weights, others) for weights in (others, squares))

    def _tail(self, i: int, weights: np.ndarray, others: np.ndarray) -> float:
        """Probability that noise with the squares ``others`` gives term i as large an estimate.

        The estimate is made under the weights of noise with the squares ``weights``.
        """
        row = self.functionals([i, *(j for j in np.flatnonzero(weights) if j != i)], weights)[0]
        std, shape = self._spread(row, others)
        excess = row @ (self.measured - self.moments.design @ others) / std
        return float(gammaincc(shape, max(shape + excess * np.sqrt(shape), 0.0)))

    def _spread(self, row: np.ndarray, squares: np.ndarray) -> tuple[float, float]:
        """Standard deviation of an estimate, and the shape of a gamma distribution as skew.

        The estimate is the product of ``row`` with the Allan variances. Its skewness is taken as
        the mean of theirs, each weighted by what it contributes to the variance of the estimate.
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
        """Upper bound of the square of term i, which is not among the terms ``kept``.

        It is the square with which the estimate would come out as low as it did, or lower, with the
        probability 1 - ``level``.
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
        """Upper bound of the square of term i where there is no other term.

        No cluster's variance comes out that much smaller than the term alone makes it. Of many
        clusters one is low by chance, so each counts with its share of the probability. A ramp is
        counted as a random walk.
        """
        k = i - 1 if i >= RAMP else i
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


def has_noise(squares: np.ndarray) -> bool:
    """Whether squares (k,) are those of some noise: a ramp is none."""
    return bool(np.any(squares[:RAMP]) or np.any(squares[RAMP + 1 :]))


def without(columns: np.ndarray, others: np.ndarray) -> np.ndarray:
    """``others`` (t, k) less their projections on ``columns`` (t, j)."""
    if not columns.shape[1]:
        return others
    q, _ = np.linalg.qr(columns)
    return others - q @ (q.T @ others)
