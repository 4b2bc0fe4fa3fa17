"""The stances of a foot are rests, though each is shorter than what else counts as one; of what
does not swing, or stops but now and then, no moment is.
"""

import numpy as np
import pytest
from walks import Walk, walk

from pyimu import Recording, ins
from pyimu.ins.detector import Noise, detect
from pyimu.ins.short_rests import LEAST, between_swings
from pyimu.recording.clock import runs

H = 0.005
NOISE = Noise(np.full(3, 2e-3), np.full(3, 0.02), np.zeros(3), np.array([0.01, -0.02, 0.015]))


def measured(own: Walk, seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    shape = own.rate.shape
    gyro = own.rate + NOISE.bias + NOISE.rate * rng.standard_normal(shape)
    return gyro, own.force + NOISE.force * rng.standard_normal(shape)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("stance", [0.36, 0.5])
def test_stances_are_found_and_no_row_of_a_swing(stance, seed):
    own = walk(seed, stance=stance)
    still = detect(own.time, *measured(own, seed), NOISE, H).still
    stances = [rows for rows in runs(own.stands) if 8 < own.time[rows[0]] < 54]
    assert len(stances) > 30
    assert all(still[slice(*rows)].any() for rows in stances)
    assert not np.any(still & ~own.stands)


def test_the_path_of_a_foot_holds_by_default():
    """60 s of it, some 54 m: without stances it ends tens of metres off."""
    own = walk(2)
    gyro, accel = measured(own, 2)
    log = Recording.from_arrays(time=own.time, gyro=gyro, accel=accel)
    found = ins.run(log, method="filter", heading0=walk_heading(own))
    off = found.tracks["filter"].position[-1] - own.place[-1]
    way = np.linalg.norm(np.diff(own.place[::20], axis=0), axis=1).sum()
    assert way > 40 and np.linalg.norm(off) < 0.02 * way


def walk_heading(own: Walk) -> float:
    """rad; of the first step, which the foot's yaw at the start is."""
    first = own.place[np.argmax(np.linalg.norm(own.place[:, :2], axis=1) > 0.5)]
    return float(np.arctan2(first[1], first[0]))


def swinging(count: int, size: float, windows: int) -> np.ndarray:
    """The marks of a log of so many moments in which windows pass, between swings of ``size``."""
    passed, rates = np.zeros(200 * (count + 1), dtype=bool), np.zeros((200 * (count + 1), 3))
    rates[:, 1] = size
    for k in range(count):
        rows = slice(200 * k + 150, 200 * k + 150 + windows)
        passed[rows], rates[rows] = True, 0
    return between_swings(passed, rates, 60, H)


def test_they_need_swings_and_company():
    assert np.count_nonzero(swinging(LEAST, 3.0, 20)) == 20 * LEAST
    assert not swinging(LEAST - 1, 3.0, 20).any()
    assert not swinging(2 * LEAST, 1.0, 20).any()
    assert not swinging(2 * LEAST, 3.0, 60).any()
