"""Up to which frequency positions show a motion, and not their noise alone."""

import numpy as np
import pytest
from scipy.signal import butter, sosfilt

from pyimu.recording.reference.shown import ROOM, shown_up_to

RATE, SECONDS = 100.0, 60.0


def positions(rng, low, noise, columns=3):
    """Positions (n, columns) m that move by some cm, hardly at all above ``low`` Hz."""
    sos = butter(8, low, fs=RATE, output="sos")
    moved = sosfilt(sos, rng.standard_normal((round(SECONDS * RATE), columns)), axis=0)
    return 0.05 * moved / moved.std(axis=0) + noise * rng.standard_normal(moved.shape)


@pytest.mark.parametrize("low", [2.0, 6.0])
def test_noise_alone_is_what_is_far_above_the_motion(low):
    """Of an eighth order's power (low / f)^16 is left: where that is as much as the noise, within a
    third of an octave either way, motion ends.
    """
    noise = 1e-3
    found = shown_up_to([positions(np.random.default_rng(1), low, noise)], 1 / RATE, 2)
    ends = low * (0.05**2 / low / (2 * noise**2 / RATE)) ** (1 / 16)
    assert ROOM * ends / 2 ** (1 / 3) < found < ROOM * ends * 2 ** (1 / 3)


def test_one_axis_that_moves_quickly_is_enough():
    rng = np.random.default_rng(2)
    slow, quick = (positions(rng, low, 1e-3) for low in (2.0, 12.0))
    mixed = np.column_stack([slow[:, :2], quick[:, 2]])
    assert shown_up_to([mixed], 1 / RATE, 2) == shown_up_to([quick[:, 2:]], 1 / RATE, 2)


@pytest.mark.parametrize("seconds", [2.0, 60.0])
def test_where_all_may_be_motion_nothing_is_said(seconds):
    """Positions without noise that are seen to move up to the end, and too few of them."""
    few = positions(np.random.default_rng(3), 40.0, 0.0)[: round(seconds * RATE)]
    assert shown_up_to([few], 1 / RATE, 2) == np.inf
