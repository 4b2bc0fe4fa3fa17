"""Small positive definite systems, beside numpy's."""

import numpy as np
import pytest

from pyimu.numerics.positive import cholesky, solve


@pytest.mark.parametrize("p", [1, 2, 5])
def test_a_system_is_solved(p):
    rng = np.random.default_rng(p)
    half = rng.normal(size=(p, p))
    matrix, right = half @ half.T, rng.normal(size=p)
    root, found = cholesky(matrix), right.copy()
    solve(root, found)
    # A root of condition c loses c roundings, the system c squared of them.
    rounding = 10 * p * np.finfo(float).eps * np.linalg.cond(matrix)
    np.testing.assert_allclose(root, np.linalg.cholesky(matrix), rtol=rounding, atol=rounding)
    np.testing.assert_allclose(found, np.linalg.solve(matrix, right), rtol=rounding, atol=rounding)


def test_what_the_others_say_is_zero():
    matrix, found = np.array([[4.0, 2.0], [2.0, 1.0]]), np.array([2.0, 1.0])
    solve(cholesky(matrix), found)
    np.testing.assert_array_equal(found, [0.5, 0.0])
