"""The levels at which a switch is looked for."""

import numpy as np
import pytest

from pyimu.identification.formula.levels import SHARES, Levels


def swept(rest: float) -> np.ndarray:
    """A rate that goes up and down between -1 and 1, and is zero for that share of its rows."""
    turns = np.sin(np.linspace(0.0, 20.0 * np.pi, 20000))
    return np.concatenate([turns, np.zeros(int(20000 * rest / (1.0 - rest)))])


@pytest.mark.parametrize("rest", [0.0, 0.5, 0.95])
def test_a_body_that_mostly_rests_is_tried_where_it_turns(rest):
    levels = np.concatenate([[-1.0], Levels.of(swept(rest)).at(SHARES), [1.0]])
    assert np.all(np.diff(levels) >= 0.0) and np.diff(levels).max() < 0.25


def test_what_is_seen_once_is_not_where_levels_lie():
    """A blow of a hundred times the rest."""
    values = np.append(np.random.default_rng(1).standard_normal(100_000), [300.0, -300.0])
    levels = Levels.of(values).at(SHARES)
    assert np.abs(levels).max() < 4.0
    np.testing.assert_allclose(levels[9], 0.0, atol=0.1)


def test_a_level_has_the_share_that_it_is_at():
    levels = Levels.of(swept(0.5))
    for share in SHARES:
        assert abs(levels.share(float(levels.at(share))) - share) < 1e-3


def test_a_number_that_does_not_change_has_one_level():
    values = 9.8 + 1e-12 * np.random.default_rng(2).standard_normal(1000)
    np.testing.assert_allclose(Levels.of(values).at(SHARES), 9.8, rtol=1e-9)
