"""A bias that is another one after each of many instants: its likelihood against the sum over all
ways of it, and against that of a Gauss-Markov process.
"""

import itertools

import numpy as np
import pytest
from effect_logs.cases import make
from effect_results.record import closed
from scipy.signal import lfilter
from scipy.stats import chi2

from pyimu.identification.noise.exact import AxisNoise
from pyimu.identification.noise.jumps import LEVELS
from pyimu.identification.noise.laws import kinds
from pyimu.identification.noise.levels import (
    KEPT,
    UNLIKELY,
    _likelihood,
    levels_likelihood,
    markov_likelihood,
)
from pyimu.identification.noise.rows import Rows
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.model.sensor import Sensor

H = 0.1
PART = Sensor("gyro", {"angle_random_walk": {"N": [1e-3] * 3}})


def summed(r, white, spread, rate):
    """Log-likelihood (constant left out) over all 2^(n-1) ways of where levels begin anew."""
    n, jump = len(r), -np.expm1(-rate * H)
    total = 0.0
    for way in itertools.product((0, 1), repeat=n - 1):
        level = np.cumsum((0, *way))
        c = white * np.eye(n) + spread * (level[:, None] == level)
        chance = jump ** sum(way) * (1 - jump) ** (n - 1 - sum(way))
        total += chance * np.exp(-0.5 * r @ np.linalg.solve(c, r)) / np.sqrt(np.linalg.det(c))
    return np.log(total)


@pytest.mark.parametrize("seed", range(3))
def test_the_likelihood_is_the_sum_over_all_ways(seed):
    n, white, spread, rate = 10, 0.04, 0.5, 2.0
    assert n <= KEPT
    rng = np.random.default_rng([53, seed])
    r = np.repeat(rng.standard_normal(2) * np.sqrt(spread), n // 2)
    r = r + np.sqrt(white) * rng.standard_normal(n)
    each = r[:, None], np.full(n, H), np.full((n, 1), white), np.zeros(1), np.array([spread])
    assert _likelihood(*each, rate) == pytest.approx(
        summed(r, white, spread, rate), abs=n * n * UNLIKELY
    )


def _logs(rng, n, draws, white):
    """Rows of three axes, each beside one of ``draws``."""
    t, out = np.arange(n) * H, []
    for add in draws:
        r = np.sqrt(white) * rng.standard_normal(n) + add
        out.append(Rows(t, r, t, t, H, n, averaged=True))
    return out


@pytest.mark.parametrize("seed", range(3))
def test_it_tells_levels_from_a_gauss_markov_process_of_their_spectrum(seed):
    """Three axes, 30 levels of four times the noise of their means, against the true process."""
    rng = np.random.default_rng([59, seed])
    n, dwell, white = 3600, 12.0, 1.0
    level = 4.0 * np.sqrt(white * H / dwell)
    jumps = np.cumsum(rng.exponential(dwell, n))
    draw = rng.standard_normal(n + 1)[np.searchsorted(jumps, np.arange(n) * H)]
    kept = np.exp(-H / dwell)
    smooth = lfilter([np.sqrt(1 - kept**2)], [1, -kept], rng.standard_normal((3, n + 500)))
    for adds, jumping in (([level * draw] * 3, True), (level * smooth[:, 500:], False)):
        logs = _logs(rng, n, adds, white)
        known = np.full((n, 3), white), np.zeros(3)
        ahead = levels_likelihood(logs, *known) - markov_likelihood(logs, *known)
        assert bool(ahead > SET_WIDTH) is jumping


def test_what_is_likelier_than_levels_is_the_likeliest_process():
    """On one axis: at the process's own size and time the exact likelihood is no larger."""
    rng = np.random.default_rng(61)
    n, tau, white, q = 3600, 6.0, 1.0, 0.2
    kept = np.exp(-H / tau)
    drive = q * np.sqrt(tau / 2 * (1 - kept**2)) * rng.standard_normal(n + 600)
    log = _logs(rng, n, [lfilter([1], [1, -kept], drive)[600:]], white)
    every = {k.name: k for k in kinds(PART, H, n * H)}
    sizes = {"angle_random_walk": (white * H, {}), "gauss_markov": (q**2, {"tau": tau})}
    known = AxisNoise({every[name]: v for name, v in sizes.items()}).likelihood(log[0]).sum()
    ahead = markov_likelihood(log, np.full((n, 1), white), np.zeros(1)) - known
    # Twice what an estimate of two numbers gains is chi-square of two.
    assert -0.1 < ahead < 0.5 * chi2.isf(1e-4, 2)


@pytest.mark.long
@pytest.mark.parametrize("name", ["gyro", "accel"])
def test_a_bias_that_is_another_after_each_turn_has_no_name(name):
    found = closed(make(f"strange/30/{name}.reseated", 230, (5.0, 7.0)))
    assert not found.added, found.report()
    assert found.verdict == "unexplained"
    assert {u.shape for u in found.unexplained} == {LEVELS}
