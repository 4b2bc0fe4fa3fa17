"""What the attitude says of an effect, and what chance says."""

import numpy as np
import pytest

from pyimu.attitude.error import AttitudeError
from pyimu.identification.by_attitude import CHANCE, _by_chance
from pyimu.identification.held_out import WINDOW

RUNS = 400


def error(levels) -> AttitudeError:
    """Ten rows in each of as many windows as there are ``levels`` [rad]."""
    total = np.repeat(levels, 10)
    time = np.arange(len(total)) * WINDOW / 10
    return AttitudeError(time, total, total, total)


def test_an_error_that_scatters_alike_grows_by_chance_as_often_as_is_said():
    """Of 400 pairs in which nothing grows 5 % are no chance; four standard errors of that."""
    rng, found = np.random.default_rng(3), 0
    for _ in range(RUNS):
        before, after = (np.sqrt(0.02**2 + 4e-5 * rng.standard_normal(6)) for _ in range(2))
        found += not _by_chance({"a": error(before)}, {"a": error(after)}, ["a"])
    assert abs(found / RUNS - CHANCE) < 4 * np.sqrt(CHANCE * (1 - CHANCE) / RUNS)


def test_an_error_that_grows_in_every_window_is_no_chance():
    before = 0.02 + 0.005 * np.arange(8)
    assert not _by_chance({"a": error(before)}, {"a": error(1.04 * before)}, ["a"])


def test_two_windows_cannot_tell():
    assert not _by_chance({"a": error([0.02, 0.03])}, {"a": error([0.03, 0.02])}, ["a"])


def test_the_power_of_each_window():
    assert error([0.1, 0.2]).powers(WINDOW) == pytest.approx([0.01, 0.04])
