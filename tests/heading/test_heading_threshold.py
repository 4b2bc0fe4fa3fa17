"""The threshold filter: hard, and with hysteresis and a hold time."""

import numpy as np
import pytest

from pyimu.errors import UserError
from pyimu.heading import threshold_filter


def sample_by_sample(rate, threshold, release, hold):
    """The same as a state machine; ``hold`` in samples."""
    out, turns, quiet = [], False, 0
    for r in rate:
        if abs(r) >= threshold or (turns and quiet == 0 and abs(r) >= release):
            turns, quiet = True, 0
        elif turns:
            quiet += 1
            turns = quiet <= hold
        out.append(r if turns else 0.0)
        quiet = quiet if turns else 0
    return np.array(out)


def test_hard_is_zero_below_the_threshold():
    rate = np.array([0.0, 0.4, -0.6, 0.5, -0.5, 0.49, np.nan])
    want = np.array([0.0, 0.0, -0.6, 0.5, -0.5, 0.0, 0.0])
    np.testing.assert_array_equal(threshold_filter(rate, 0.5), want)


@pytest.mark.parametrize("release", [0.5, 0.2, 0.0])
@pytest.mark.parametrize("hold", [0, 3])
def test_hysteresis_and_hold_are_those_of_a_state_machine(release, hold):
    rate = np.convolve(np.random.default_rng(1).standard_normal(2000), np.ones(5) / 5, "same")
    found = threshold_filter(rate, 0.5, release=release, hold=0.01 * hold, period=0.01)
    np.testing.assert_array_equal(found, sample_by_sample(rate, 0.5, release, hold))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"threshold": -0.1}, "not negative"),
        ({"threshold": np.nan}, "not negative"),
        ({"threshold": 0.1, "release": 0.2}, "above the threshold"),
        ({"threshold": 0.1, "hold": 1.0}, "sample period"),
        ({"threshold": 0.1, "hold": -1.0}, "not negative"),
    ],
)
def test_what_it_refuses(given, said):
    with pytest.raises(UserError, match=said):
        threshold_filter(np.zeros(3), **given)
