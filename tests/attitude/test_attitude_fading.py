"""What fades in the attitude filter's state ends at zero, not as a denormal number."""

from dataclasses import replace

import numpy as np
import pytest

import pyimu
from pyimu.attitude import attitude_ukf
from pyimu.block.block import Run


@pytest.mark.long
def test_a_body_that_moved_and_then_stands_for_hours_leaves_no_denormal_numbers():
    block = attitude_ukf(replace(pyimu.part("imt30"), sample_rate=5.0))
    at = {v.name: i for i, v in enumerate(block.inputs)}
    n, moves = 20_000, 2_000
    turn = np.sin(0.3 * np.arange(moves)[:, None] + np.arange(3))
    u = np.tile(block.start_inputs, (n, 1))
    u[:, at["stationary"]] = 1.0
    run = Run(block, 10 * n)
    first = u.copy()
    first[:moves, at["stationary"]] = 0.0
    first[:moves, at["gyro[1]"] : at["gyro[1]"] + 3] += 0.3 * turn
    first[:moves, at["accel[1]"] : at["accel[1]"] + 3] += turn
    run.advance(first)
    small = np.abs(run.state)
    assert np.any((small > 0) & (small < 1e-12))  # something does fade
    for _ in range(20):
        run.advance(u)
        small = np.abs(run.state)
        assert not np.any((small > 0) & (small < np.finfo(float).tiny))
