"""The filter's errors are as large as it says: a few of the drives of ``benchmarks/consistency.py``, judged by the same bands."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))
from consistency import INSTANTS, KINDS, SCENARIOS, SECOND_ORDER, Bands, Sums, expected_at_rest, outside, simulate

DRIVES, SHORT = 24, INSTANTS[:7]
"""Drives of 40 s."""


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda s: s.name)
def test_normalised_errors_and_innovations_are_chi_square(scenario):
    sums = simulate(scenario, DRIVES, SHORT)
    assert outside(sums, Bands(len(SCENARIOS) * len(SHORT) * len(KINDS))) == []
    assert sums.norm < 1e-12 and sums.least_eigenvalue > 0


def test_heading_and_vertical_bias_at_rest_become_no_better_known():
    """Gravity tells nothing of them: sigma^2 = s^2 + N^2 t + K^2 t^3/3 + s_b^2 t^2, and s_b^2 + K^2 t, to second order of 0.36 rad."""
    sums = simulate(SCENARIOS[-1], 1, INSTANTS)
    heading, bias = expected_at_rest(INSTANTS)
    np.testing.assert_allclose(sums.heading_variance, heading, rtol=SECOND_ORDER)
    np.testing.assert_allclose(sums.vertical_bias_variance, bias, rtol=SECOND_ORDER)


def test_bands_hold_all_together_with_the_stated_probability():
    """Of three hundred right filters no more than a few leave any band; one whose covariance is half of what it should be does at once."""
    rng, shape, degrees = np.random.default_rng(0), (10, len(KINDS)), 24 * np.array(list(KINDS.values()))
    squares = rng.chisquare(degrees, (300, *shape))
    bands = Bands(np.prod(shape))

    def is_outside(values):
        return bool(outside(Sums(values, np.broadcast_to(degrees, shape), np.zeros(10), np.zeros(10)), bands))

    assert sum(map(is_outside, squares)) <= 12  # of 300 at 1 %: more than 12 with a probability of 1.5e-5
    assert is_outside(2 * squares[0])
