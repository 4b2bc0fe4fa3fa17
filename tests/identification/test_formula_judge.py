"""What held-out rows must say of a formula."""

import numpy as np
import pytest

from pyimu.identification.formula.judge import DISPLACES, least_gain, outweighs
from pyimu.identification.search.confirm import Evidence
from pyimu.identification.search.investigation import Step


def test_an_axis_without_a_difference_is_asked_for_no_gain():
    """Rows of the fitted part are taken off those of the whole: what is left may lie below zero."""
    asked = least_gain(np.array([-4.8e-3, 0.0, 15.0, 1000.0]))
    np.testing.assert_allclose(asked[:2], 0.0)
    np.testing.assert_allclose(asked[3], 300.0)
    assert asked[2] == pytest.approx(15.0 - 2.0 * np.sqrt(30.0))


def held_out(gained: float) -> Evidence:
    none = np.zeros(3)
    return Evidence(np.array([gained, 0.0, 0.0]), none, none, none, none, none, none, None)


@pytest.mark.parametrize(
    ("ahead", "gained", "takes"),
    [
        (7.0 + DISPLACES * 400.0, 0.0, True),
        (5.0 + DISPLACES * 400.0, 0.0, False),
        (9.0, DISPLACES * 400.0, True),  # what held-out rows gain counts as much
        (5.0, 1000.0, False),  # and is no part of the choice among thousands
        (7.0 + DISPLACES * 400.0, -1000.0, True),  # what they lose is judged elsewhere
    ],
)
def test_a_formula_takes_a_place_by_the_fitted_and_the_held_out_rows(ahead, gained, takes):
    steps = [Step(n, frozenset(), g, 6.0, (), 1.0) for n, g in (("one", 300.0), ("two", 100.0))]
    assert outweighs(steps, ahead, held_out(gained), needed=6.0) is takes
