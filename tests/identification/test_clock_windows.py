"""Means of windows, and copies of inputs."""

import numpy as np
import pytest

from pyimu.identification.fit.inputs import copied
from pyimu.identification.reference.clock import _means


@pytest.mark.parametrize("last", [99, 100])
def test_means_are_those_of_each_window(last):
    values = np.random.default_rng(1).standard_normal((100, 3))
    places = [(0, 20), (20, 47), (50, 81), (85, last)]
    expected = [values[a:b].mean(axis=0) for a, b in places]
    np.testing.assert_allclose(_means(values, places), expected, rtol=1e-12)


def test_copied_inputs_may_be_written_to():
    u = np.zeros((4, 50)).T
    u[:, 1], u[:, 3] = 2.0, np.nan
    new = copied(u)
    np.testing.assert_array_equal(new, u)
    new[:, 0] = 1.0
    assert not u[:, 0].any()
    assert new.flags.f_contiguous
