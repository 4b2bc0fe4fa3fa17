"""The arc tangent as plain arithmetic, against that of the C library."""

import casadi as ca
import numpy as np
import pytest

from pyimu.symbolic.elementary import arc_tangent

y, x = ca.SX.sym("y"), ca.SX.sym("x")
OURS = ca.Function("arc_tangent", [y, x], [arc_tangent(y, x)])


@pytest.mark.parametrize("spread", [0, 1, 12, 100])
def test_an_angle_is_that_of_the_library_to_two_units_of_the_last_place(spread):
    rng = np.random.default_rng(spread)
    a, b = rng.standard_normal((2, 200_000)) * 10.0 ** rng.uniform(-spread, spread, (2, 200_000))
    ours, theirs = np.array(OURS(a[None], b[None])).ravel(), np.arctan2(a, b)
    assert np.all(np.abs(ours - theirs) <= 3 * np.spacing(np.abs(theirs)))  # theirs is off by one


@pytest.mark.parametrize(
    ("across", "along"), [(0, 1), (0, -1), (-0.0, -1), (1, 0), (-1, 0), (0, 0), (1, 1), (-1, 1)]
)
def test_an_angle_on_an_axis_is_exact(across, along):
    assert float(OURS(across, along)) == np.arctan2(across, along)


@pytest.mark.parametrize("numbers", [(np.nan, 1), (1, np.nan)])
def test_what_is_no_number_stays_none(numbers):
    assert np.isnan(float(OURS(*numbers)))
