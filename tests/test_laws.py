"""The laws of intervals and gates are those of scipy.stats."""

import numpy as np
import pytest
from scipy import stats

from pyimu.numerics.laws import beta, chi2, f, norm, t

DF = np.array([0.3, 1.0, 2.0, 7.5, 40.0, 3000.0])
X = np.array([1e-3, 0.5, 1.0, 20.0, 900.0])
P = np.array([1e-12, 1e-4, 0.025, 0.5, 0.999])


@pytest.mark.parametrize("name", ["sf", "logcdf", "logsf", "logpdf"])
def test_chi_squared_at_a_place(name):
    mine, theirs = (getattr(law, name)(X[:, None], DF) for law in (chi2, stats.chi2))
    np.testing.assert_allclose(mine, theirs, rtol=1e-13)


@pytest.mark.parametrize("name", ["isf", "ppf"])
def test_chi_squared_at_a_probability(name):
    mine, theirs = (getattr(law, name)(P[:, None], DF) for law in (chi2, stats.chi2))
    np.testing.assert_allclose(mine, theirs, rtol=1e-13)


def test_normal():
    for name in ("pdf", "sf"):
        np.testing.assert_allclose(
            getattr(norm, name)(X[:4]), getattr(stats.norm, name)(X[:4]), rtol=1e-13
        )
    for name in ("isf", "ppf"):
        np.testing.assert_allclose(getattr(norm, name)(P), getattr(stats.norm, name)(P), rtol=1e-13)


def test_ratios():
    below = np.array([1.0, 2.5, 30.0, 5000.0])
    for above in (1, 9):
        np.testing.assert_allclose(
            f.sf(X[:, None], above, below), stats.f.sf(X[:, None], above, below), rtol=1e-12
        )
        np.testing.assert_allclose(
            f.ppf(P[:, None], above, below), stats.f.ppf(P[:, None], above, below), rtol=1e-9
        )
        shares = np.array([1e-6, 0.1, 0.9])[:, None]
        np.testing.assert_allclose(
            beta.sf(shares, above, below), stats.beta.sf(shares, above, below), rtol=1e-9
        )
    np.testing.assert_allclose(t.sf(X[:, None], below), stats.t.sf(X[:, None], below), rtol=1e-12)
    some = P[P != 0.5, None]
    np.testing.assert_allclose(t.isf(some, below), stats.t.isf(some, below), rtol=1e-9)
    np.testing.assert_allclose(t.isf(0.5, below), 0.0, atol=1e-12)


def test_what_is_outside_of_a_law_is_not_a_number():
    assert np.isnan(chi2.isf(1.5, 3)) and np.isnan(chi2.ppf(-0.1, 3)) and np.isnan(norm.isf(2.0))
