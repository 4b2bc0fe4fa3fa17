"""The clock of a log: its period and gaps whatever the stamps are rounded to, and the second rate in a file of two."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pyimu.clock import WINDOW, Cadence, Clock, cadence_of


def two_rates(n=3000):
    return np.concatenate((np.arange(n) * 0.01, n * 0.01 + np.arange(2 * n) * 0.004))


@settings(max_examples=20, deadline=None)
@given(cuts=st.lists(st.integers(1, 8999), max_size=20))
def test_clock_does_not_depend_on_the_pieces(cuts):
    time = two_rates() + np.repeat([0, 0.1, 5.0], 3000)
    clocks = Clock(Cadence.of_period(0.004)), Clock(Cadence.of_period(0.004))
    clocks[0].add(time)
    for part in np.split(time, sorted(cuts)):
        clocks[1].add(part)
    assert clocks[0].findings() == clocks[1].findings()


def test_two_rates_are_reported_with_where_they_begin():
    """Rows are counted in windows: one at each end of the other rate may be lost."""
    time = two_rates()
    clock = Clock(cadence_of(time))
    clock.add(time)
    (found,) = (f for f in clock.findings() if f.kind == "two_rates")
    assert (found.detail["rate"], found.detail["other_rate"]) == (pytest.approx(250), pytest.approx(100))
    assert abs(found.count - 3000) <= WINDOW and found.detail["first"] == 0
    clock = Clock(Cadence.of_period(0.01))
    clock.add(time)
    (found,) = clock.findings()
    assert found.kind == "two_rates" and abs(found.detail["first"] - 30) <= WINDOW * 0.01


@pytest.mark.parametrize("seed", range(5))
def test_jitter_gaps_and_coarse_stamps_are_no_second_rate(seed):
    rng = np.random.default_rng(seed)
    jittered = np.cumsum(0.01 * (1 + 0.4 * rng.uniform(-1, 1, 100_000)))
    lossy = np.flatnonzero(rng.random(100_000) < 0.7) * 0.01
    stamped = np.round(np.arange(100_000) / 976, 3)
    for time in (jittered, lossy, stamped):
        clock = Clock(cadence_of(time))
        clock.add(time)
        assert [f.kind for f in clock.findings() if f.kind != "gaps"] == []


@pytest.mark.parametrize("rate", [333, 400, 410, 512, 640, 700, 833, 952, 976, 990])
def test_times_rounded_to_ms_keep_rate_and_have_no_gaps(rate):
    """Rounding shifts the ends of n steps by 1 ms together at most; a gap of four periods is seen through it."""
    n = 20_000
    time = np.round(np.arange(n) / rate, 3)
    whole = cadence_of(time)
    assert abs(whole.period - 1 / rate) <= 1e-3 / (n - 1) and np.diff(time).max() <= whole.longest
    time[n // 2:] += round(4 / rate, 3)
    assert np.count_nonzero(np.diff(time) > cadence_of(time).longest) == 1
    clock = Clock(whole)
    clock.add(time)
    assert {f.kind for f in clock.findings()} == {"gaps"}


@pytest.mark.parametrize("share", [0.001, 0.02, 0.2])
def test_lost_samples_are_no_rounding(share):
    """Each lost sample of a clock without jitter makes a gap, and the period stays."""
    kept = np.flatnonzero(np.random.default_rng(0).random(20_000) > share)
    cadence = cadence_of(kept * 0.001)
    assert cadence.period == pytest.approx(0.001, rel=1e-9)
    assert np.count_nonzero(np.diff(kept * 0.001) > cadence.longest) == np.count_nonzero(np.diff(kept) > 1)
