"""The most that a sensor's white noise can be, by what is left beside its reference."""

import numpy as np
import pytest

from pyimu.identification.fit.most_white import FEWEST, least_density

PERIOD, N = 0.08, 1e-4
"""s; unit sqrt(s)."""


def left(rng, rows: int, of_reference: float = 0.0, walk: float = 0.0) -> np.ndarray:
    """White noise, that of an attitude which was differentiated, and a random walk."""
    white = N / PERIOD**0.5 * rng.standard_normal((rows, 3))
    attitude = of_reference * rng.standard_normal((rows + 1, 3))
    drift = walk * PERIOD**0.5 * np.cumsum(rng.standard_normal((rows, 3)), axis=0)
    return white + np.diff(attitude, axis=0) / PERIOD + drift


@pytest.mark.parametrize(("of_reference", "walk"), [(0.0, 0.0), (2e-4, 0.0), (2e-4, 2e-6)])
def test_the_octave_with_least_bounds_white_noise_beside_a_reference_s(of_reference, walk):
    """A bound below the truth is five standard errors of its octave away; what lies between the
    noise of the reference and a drift leaves some octave mostly white here.
    """
    values = left(np.random.default_rng(5), 20_000, of_reference, walk)
    most = least_density(values, [(0, 9_000), (9_000, 20_000)], PERIOD)
    assert (most > 0.9 * N**2).all() and (most < 2.0 * N**2).all()


def test_too_few_rows_tell_nothing():
    values = left(np.random.default_rng(6), 40)
    assert np.isinf(least_density(values, [(0, FEWEST - 1), (20, 40)], PERIOD)).all()
    assert np.isinf(least_density(values, [], PERIOD)).all()
