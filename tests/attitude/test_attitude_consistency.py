"""The filter's errors are as large as it says: a few of the drives of
``benchmarks/consistency.py``, judged by the same bands.
"""

import numpy as np
import pytest
from consistency import (
    INSTANTS,
    KINDS,
    REST,
    SCENARIOS,
    SECOND_ORDER,
    Bands,
    Sums,
    aligned,
    expected_at_rest,
    outside,
    simulate,
)
from drives.attitude import H, Noise, Scenario

DRIVES, SHORT = 24, INSTANTS[:7]
"""Drives of 40 s."""

LONG = {"gyro with Gauss-Markov noise", "relative rate noise, each axis by itself"}
SOME_LONG = [
    pytest.param(s, marks=[pytest.mark.long] * (s.name in LONG), id=s.name) for s in SCENARIOS
]


@pytest.mark.parametrize("scenario", SOME_LONG)
def test_normalised_errors_and_innovations_are_chi_square(scenario):
    sums = simulate(scenario, DRIVES, SHORT)
    assert outside(sums, Bands(len(SCENARIOS) * len(SHORT) * len(KINDS)), scenario.bounded) == []
    assert sums.norm < 1e-12 and sums.least_eigenvalue > 0


@pytest.mark.parametrize("walk", [1e-6, pytest.param(1e-3, marks=pytest.mark.long)])
@pytest.mark.parametrize("declared", [False, True])
def test_run_from_its_own_alignment_claims_no_more_than_it_knows(declared, walk):
    """Not less either would be too much to ask: the rest's rows are used twice, and a turn about
    the vertical is allowed for.

    As gravity may tell again of an undeclared rest's bias what its mean has told, the variance may
    be 2/3 of what it should be.
    """
    rest, instants = 12.0, np.array([0.01, 1, 5, 10, 15, 20, 40])
    scenario = Scenario("a rest", rest=rest, noise=Noise(1e-3, walk))
    more = {"stationary": H * np.arange(round(instants[-1] / H)) < rest} if declared else {}
    squares = aligned(scenario, DRIVES, instants, **more)
    bands = Bands(4 * squares.size)
    assert squares.max() / DRIVES < bands.of(DRIVES)[1] * (1 if declared else 1.5)


def test_heading_and_vertical_bias_at_rest_become_no_better_known():
    """Gravity tells nothing of them: sigma^2 = s^2 + N^2 t + K^2 t^3/3 + s_b^2 t^2, and s_b^2 + K^2
    t, to second order of 0.36 rad.
    """
    sums = simulate(REST, 1, INSTANTS)
    heading, bias = expected_at_rest(INSTANTS)
    np.testing.assert_allclose(sums.heading_variance, heading, rtol=SECOND_ORDER)
    np.testing.assert_allclose(sums.vertical_bias_variance, bias, rtol=SECOND_ORDER)


def test_bands_hold_all_together_with_the_stated_probability():
    """Of three hundred right filters no more than a few leave any band; one whose covariance is
    half of what it should be does at once.
    """
    rng, shape, degrees = (
        np.random.default_rng(0),
        (10, len(KINDS)),
        24 * np.array(list(KINDS.values())),
    )
    squares = rng.chisquare(degrees, (300, *shape))
    bands = Bands(np.prod(shape))

    def is_outside(values):
        return bool(
            outside(
                Sums(values, np.broadcast_to(degrees, shape), np.zeros(10), np.zeros(10)), bands
            )
        )

    assert (
        sum(map(is_outside, squares)) <= 12
    )  # of 300 at 1 %: more than 12 with a probability of 1.5e-5
    assert is_outside(2 * squares[0])
