"""Slow noise that the motion drives against noise that goes on with time, by the likelihood of
either.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from effect_logs.cases import make
from effect_results.record import closed
from scipy.signal import lfilter

from pyimu.identification.noise.driven import FOLLOWS, GAIN, TURNED, driven_of
from pyimu.identification.noise.exact import AxisNoise
from pyimu.identification.noise.jumps import Jumping, _Log
from pyimu.identification.noise.laws import kinds
from pyimu.identification.noise.levels import _seen_times
from pyimu.identification.noise.rows import Rows
from pyimu.model.sensor import Sensor

H, N_ROWS, WHITE, TAU = 0.1, 3600, 1.0, 6.0
PART = Sensor("gyro", {"angle_random_walk": {"N": [1.0] * 3}})


def driven_in(monkeypatch, logs, size):
    """What is found of residuals on axis x beside noise that is known to be a Gauss-Markov process
    of a variance ``size`` and ``TAU``.
    """
    every = {k.name: k for k in kinds(PART, H, N_ROWS * H)}
    q2 = 2.0 * size / TAU
    noise = AxisNoise(
        {every["angle_random_walk"]: (WHITE * H, {}), every["gauss_markov"]: (q2, {"tau": TAU})}
    )
    slow = SimpleNamespace(kind=every["gauss_markov"])
    axis = SimpleNamespace(had={})
    state = SimpleNamespace(axes={0: axis}, found={0: (slow,)})
    found = SimpleNamespace(state=state, start=state, loose=lambda i: [])
    made = [_Log(one, noise.variance(one), float(noise.likelihood(one).sum())) for one in logs]
    monkeypatch.setattr(Jumping, "logs", lambda self, i: made)
    return driven_of(found)


def rows_along(rng, along, size, times=lambda x: 1.0):
    """Means over 0.1 s, turned about x and z by turns and rests of 5 to 15 s, beside a process that
    goes on as ``along`` says of the rate and the input's slope, ``times`` a function of the input.
    """
    t = np.arange(N_ROWS) * H
    edges = np.cumsum(rng.uniform(5.0, 15.0, 100))
    turns = np.searchsorted(edges, t) % 2
    # Each turn begins and ends within 2 s, at a speed of its own.
    speeds = rng.uniform(0.2, 1.0, (101, 2))[np.searchsorted(edges, t)] * turns[:, None]
    rate = np.zeros((N_ROWS, 3))
    rate[:, [0, 2]] = lfilter([1 / 20] * 20, [1.0], speeds, axis=0)
    slope = np.gradient(rate[:, 0], H)
    moved = along(rate, slope)
    moved = moved / moved.mean() * H
    kept, process = np.exp(-moved / TAU), np.zeros(N_ROWS)
    drawn = rng.standard_normal(N_ROWS)
    process[0] = drawn[0]
    for k in range(1, N_ROWS):
        process[k] = kept[k] * process[k - 1] + np.sqrt(1.0 - kept[k] ** 2) * drawn[k]
    own = rate[:, 0] / rate[:, 0].std()
    r = np.sqrt(WHITE) * rng.standard_normal(N_ROWS) + np.sqrt(size) * times(own) * process
    return Rows(t, r, rate[:, 0], slope, H, N_ROWS, averaged=True, rate=rate)


WAYS = {
    TURNED: lambda rate, slope: np.linalg.norm(rate, axis=1),
    FOLLOWS: lambda rate, slope: np.abs(slope),
    "": lambda rate, slope: np.ones(len(slope)),
    GAIN: lambda rate, slope: np.ones(len(slope)),
}


@pytest.mark.parametrize("what", WAYS)
def test_what_the_motion_drives_is_told_from_noise_of_the_same_spectrum(what, monkeypatch):
    """Eight logs, of a process as large as a mean's noise. Each must be told right: what goes on
    with time is taken for driven at 1e-3 an axis at most, as two models of as many numbers differ
    by x nat for the wrong one with a chance of exp(-x) at most.
    """
    for seed in range(8):
        rng = np.random.default_rng([67, seed])
        times = (lambda x: x) if what == GAIN else (lambda x: 1.0)
        found = driven_in(monkeypatch, [rows_along(rng, WAYS[what], WHITE, times)], WHITE)
        assert {one.shape for one in found.values()} == ({what} if what else set())


@pytest.mark.parametrize("seed", range(3))
def test_the_likelihood_of_a_gain_is_that_of_dense_gaussian_algebra(seed):
    """Of the differences from the first row, in which no bias is: the diffuse one is off by a part
    in 1e8, and the first row's own density is left out.
    """
    rng = np.random.default_rng([71, seed])
    t = np.cumsum(rng.uniform(0.05, 0.3, 60))
    x, r, white = rng.standard_normal(60), rng.standard_normal(60), rng.uniform(0.5, 1.5, 60)
    walk, variance, tau = 0.2, 0.7, 1.3
    whole = variance * np.outer(x, x) * np.exp(-np.abs(t[:, None] - t) / tau)
    whole += walk * np.minimum.outer(t, t) + np.diag(white)
    lift = np.hstack([-np.ones((59, 1)), np.eye(59)])
    c, d = lift @ whole @ lift.T, lift @ r
    dense = -0.5 * (np.linalg.slogdet(c)[1] + d @ np.linalg.solve(c, d))
    steps = np.diff(t, prepend=t[0])
    made = _seen_times(r - r[0], x, steps, white, walk, variance, tau, 1e8)
    assert made == pytest.approx(dense, abs=1e-3)


@pytest.mark.long
@pytest.mark.parametrize("name", ["gyro", "accel"])
def test_a_belt_that_creeps_is_no_noise(name):
    found = closed(make(f"strange/30/{name}.drifting_phase", 480, (5.0, 7.0)))
    assert not found.added, found.report()
    assert found.verdict == "unexplained"
