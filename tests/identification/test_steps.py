"""Steps beside a steady drift: the best single one, against a fit of each."""

import numpy as np
import pytest

from pyimu.identification.reference.steps import _fitted, _one_step


@pytest.mark.parametrize("seed", range(20))
def test_best_step_is_that_of_the_likeliest_line(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(8, 60))
    time, std = np.sort(rng.uniform(0.0, 600.0, count)), rng.uniform(0.5, 2.0, count)
    values = std * rng.standard_normal(count) + seed % 4 * (time > 250.0) + 0.01 * time
    none = np.zeros(count, dtype=bool)
    each = [
        _fitted(time, values, std, (np.arange(count) >= k).astype(np.int64), none)
        for k in range(1, count)
    ]
    best = max(line.likelihood for line in each)
    assert _one_step(time, values, std).likelihood == pytest.approx(best, abs=1e-9)


def test_one_measurement_has_no_step():
    one = np.ones(1)
    assert _one_step(one, one, one) is None
