"""Symmetric matrices without branches: the Cholesky factor and what a filter needs of it."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca

FLOOR = 1e-30
"""Least value under the root of a pivot of ``cholesky``: a singular matrix has a tiny pivot instead
of NaN."""


def reciprocal(x):
    """1 / x for x > 0, for products with many numbers.

    Casadi makes a division of each product with 1 / x, and a processor takes several products'
    time for one. It leaves them with the magnitude, which costs nothing.
    """
    return ca.fabs(1 / x)


def symmetric(size: int, entry: Callable):
    """The matrix (size, size) with ``entry(i, j)``, i <= j, on both sides of the diagonal.

    It is symmetric to the last bit.
    """
    upper = {(i, j): entry(i, j) for i in range(size) for j in range(i, size)}
    return ca.vertcat(
        *[ca.horzcat(*[upper[min(i, j), max(i, j)] for j in range(size)]) for i in range(size)]
    )


def pack(matrix):
    """The upper triangle of a symmetric matrix, row by row, as a column."""
    size = matrix.shape[0]
    return ca.vertcat(*[matrix[i, j] for i in range(size) for j in range(i, size)])


def unpack(column, size: int):
    """The symmetric matrix (size, size) of which ``column`` is the upper triangle."""
    at = {(i, j): k for k, (i, j) in enumerate((i, j) for i in range(size) for j in range(i, size))}
    return symmetric(size, lambda i, j: column[at[i, j]])


def cholesky(matrix):
    """Lower triangular L with L L^T = ``matrix``, a symmetric definite one.

    Golub and Van Loan 2013, section 4.2. The zeros above the diagonal are structural, so that
    operations on a column skip them.
    """
    size = matrix.shape[0]
    lower = type(matrix)(size, size)
    for j in range(size):
        pivot = matrix[j, j] - sum((lower[j, k] * lower[j, k] for k in range(j)), 0)
        lower[j, j] = ca.sqrt(ca.fmax(pivot, FLOOR))
        inverse = reciprocal(lower[j, j])
        for i in range(j + 1, size):
            lower[i, j] = inverse * (
                matrix[i, j] - sum((lower[i, k] * lower[j, k] for k in range(j)), 0)
            )
    return lower


def triangular(wide):
    """Lower triangular L (n, n) with L L^T = A A^T for A = ``wide`` (n, m), m >= n.

    The product A A^T, which squares the condition, is never formed: L is that of A = L Q with
    orthogonal rows of Q, by modified Gram-Schmidt on the rows (Golub and Van Loan 2013, section
    5.2.8, of A^T; L is as exact as by reflections).
    """
    size = wide.shape[0]
    rows, lower = [wide[i, :] for i in range(size)], type(wide)(size, size)
    for j in range(size):
        lower[j, j] = ca.sqrt(ca.fmax(ca.sumsqr(rows[j]), FLOOR))
        unit = rows[j] / lower[j, j]
        for i in range(j + 1, size):
            lower[i, j] = ca.dot(rows[i], unit)
            rows[i] = rows[i] - lower[i, j] * unit
    return lower


def forward(lower, b):
    """L^-1 b for lower triangular L (n, n), its diagonal above zero, and b (n, m)."""
    rows: list = []
    for i in range(lower.shape[0]):
        rest = sum((lower[i, k] * rows[k] for k in range(i)), 0)
        rows.append((b[i, :] - rest) * reciprocal(lower[i, i]))
    return ca.vertcat(*rows)


def backward(lower, b):
    """L^-T b for lower triangular L (n, n), its diagonal above zero, and b (n, m)."""
    size = lower.shape[0]
    rows: dict = {}
    for i in reversed(range(size)):
        rest = sum((lower[k, i] * rows[k] for k in range(i + 1, size)), 0)
        rows[i] = (b[i, :] - rest) * reciprocal(lower[i, i])
    return ca.vertcat(*[rows[i] for i in range(size)])
