"""The clock of a log: its period and gaps whatever the stamps are rounded to, and the second rate
in a file of two.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pyimu.recording.clock import WINDOW, Cadence, Clock, cadence_of, segments
from pyimu.recording.gaps import WIDE, GapFinder, gap_rows


def two_rates(n=3000):
    return np.concatenate((np.arange(n) * 0.01, n * 0.01 + np.arange(2 * n) * 0.004))


@settings(max_examples=20, deadline=None)
@given(cuts=st.lists(st.integers(1, 8999), max_size=20))
def test_clock_does_not_depend_on_the_pieces(cuts):
    time = (
        two_rates() + np.repeat([0, 0.1, 5.0], 3000) + 5e-4 * np.random.default_rng(1).random(9000)
    )
    clocks = Clock(Cadence.of_period(0.004)), Clock(Cadence.of_period(0.004))
    clocks[0].add(time)
    for part in np.split(time, sorted(cuts)):
        clocks[1].add(part)
        clocks[1].findings()  # asking between changes nothing
    assert clocks[0].findings() == clocks[1].findings() != []


def test_two_rates_are_reported_with_where_they_begin():
    """Rows are counted in windows: one at each end of the other rate may be lost."""
    time = two_rates()
    clock = Clock(cadence_of(time))
    clock.add(time)
    (found,) = (f for f in clock.findings() if f.kind == "two_rates")
    assert (found.detail["rate"], found.detail["other_rate"]) == (
        pytest.approx(250),
        pytest.approx(100),
    )
    assert abs(found.count - 3000) <= WINDOW and found.detail["first"] == 0
    clock = Clock(Cadence.of_period(0.01))
    clock.add(time)
    (found,) = clock.findings()
    assert found.kind == "two_rates" and abs(found.detail["first"] - 30) <= WINDOW * 0.01


@pytest.mark.parametrize("n", [1200, 2000, 5000])
@pytest.mark.parametrize("period", [10.0, 30.0, 100.0])
def test_a_short_log_whose_rate_wanders_has_one_rate(n, period):
    """Of a few windows the mean periods lie apart, as two heaps do; within them they do not."""
    time = np.cumsum(0.01 * (1 + 0.05 * np.sin(2 * np.pi * 0.01 * np.arange(n) / period)))
    clock = Clock(cadence_of(time))
    clock.add(time)
    assert [f.kind for f in clock.findings()] == ["rate_wanders"]


@pytest.mark.parametrize("n", [1200, 2000, 5000])
@pytest.mark.parametrize("jitter", [0.0, 0.1])
def test_a_short_log_of_two_rates_has_two(n, jitter):
    """Stamps that are late by a tenth of a period blur the mean of 32 steps by 0.4 %."""
    late = jitter * 0.01 * np.random.default_rng(4).random(n)
    time = np.cumsum(np.where(np.arange(n) < 0.6 * n, 0.01, 0.0105)) + late
    clock = Clock(cadence_of(time))
    clock.add(time)
    assert [f.kind for f in clock.findings()] == ["two_rates"]


@pytest.mark.parametrize("n", [2000, 60_000])
@pytest.mark.parametrize("slower", [2.0, 2.5, 10.0])
def test_a_second_rate_whose_steps_are_gaps_is_one(n, slower):
    """No window of it has a period among those of the first rate, which does not wander."""
    clock = Clock(Cadence.of_period(0.01))
    clock.add(np.cumsum(np.where(np.arange(n) < 0.6 * n, 0.01, slower * 0.01)))
    kinds = {f.kind: f.detail for f in clock.findings()}
    assert "rate_wanders" not in kinds
    # Of a short log the window in which the rate changes may be the middle one of the others.
    assert kinds["two_rates"]["other_rate"] == pytest.approx(100 / slower, rel=0.5)


@pytest.mark.parametrize("shape", ["drift", "wave"])
@pytest.mark.parametrize("size", [0.02, 0.1])
def test_a_rate_that_wanders_is_one_rate(shape, size):
    """A clock that warms up, or breathes: the step changes by 2 and 10 % without a jump."""
    phase = np.linspace(0, 1, 60_000)
    change = phase if shape == "drift" else np.sin(4 * np.pi * phase)
    time = np.cumsum(0.01 * (1 + size * change))
    clock = Clock(cadence_of(time))
    clock.add(time)
    (found,) = clock.findings()
    assert found.kind == "rate_wanders"
    # the cadence is the mean step; the extremes are means of windows of 512 of 60,000 steps
    assert 1 / clock.cadence.period == pytest.approx(1 / np.diff(time).mean(), rel=1e-9)
    steps = 0.01 * (1 + size * np.array([change.max(), change.min()]))
    ends = found.detail["least_rate"], found.detail["largest_rate"]
    assert ends == pytest.approx(tuple(1 / steps), rel=0.01 * size * 2)


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
    """Rounding shifts the ends of n steps by 1 ms together at most; a gap of four periods is seen
    through it.
    """
    n = 20_000
    time = np.round(np.arange(n) / rate, 3)
    whole = cadence_of(time)
    assert abs(whole.period - 1 / rate) <= 1e-3 / (n - 1) and np.diff(time).max() <= whole.longest
    time[n // 2 :] += round(4 / rate, 3)
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
    assert np.count_nonzero(np.diff(kept * 0.001) > cadence.longest) == np.count_nonzero(
        np.diff(kept) > 1
    )


# Late stamps


def late(n, scatter, latency, seed=0, h=0.01):
    """Times (n,) of samples every ``h``, stamped late by noise of std ``scatter`` or an exponential
    latency of mean ``latency``, in periods.
    """
    rng = np.random.default_rng(seed)
    return h * (
        np.arange(n)
        + scatter * rng.standard_normal(n)
        + np.minimum(latency * rng.exponential(size=n), 0.99)
    )


@pytest.mark.parametrize("scatter, latency", [(0.1, 0), (0, 0.2)])
def test_late_stamps_are_no_gaps_and_do_not_move_the_period(scatter, latency):
    """Of 20,000 steps 8 and 750 are long. Five deviations of the scatter, or the whole latency, at
    each end bound the period's error.

    For a gap, 9 of 17 stamps would have to be late by half a period: of the latency one is by 0.08,
    so 4e-7 for a long step.
    """
    n = 20_000
    time = late(n, scatter, latency)
    cadence = cadence_of(time)
    assert np.count_nonzero(np.diff(time) > cadence.longest) > 0
    assert len(gap_rows(time, cadence.period, cadence.longest)) == 0
    assert abs(cadence.period - 0.01) <= 0.01 * (10 * scatter + 0.99 * (latency > 0)) / (n - 1)
    clock = Clock(cadence)
    clock.add(time)
    assert clock.findings() == []


@pytest.mark.parametrize("lost", [1, 2, 500])
def test_lost_samples_are_found_among_late_stamps(lost):
    """A step over one lost sample is below 1.5 periods by 4.4 deviations of the scatter: 3e-4 for
    all fifty.
    """
    n, at = 20_000, 200 + 390 * np.arange(50)
    stamps = late(n, 0.08, 0, seed=2) + 0.01 * lost * (
        np.searchsorted(at, np.arange(n), side="right")
    )
    cadence = cadence_of(stamps)
    assert gap_rows(stamps, cadence.period, cadence.longest).tolist() == at.tolist()
    clock = Clock(cadence)
    clock.add(stamps)
    (found,) = clock.findings()
    # each step has the scatter of two stamps, the sum that of fifty
    assert (
        found.count == 50
        and abs(found.detail["total"] - 50 * lost * 0.01) <= 5 * np.sqrt(100) * 0.08 * 0.01
    )
    assert found.detail["longest"] == pytest.approx(
        0.01 * (lost + 1), abs=0.01 * 0.08 * np.sqrt(2) * 5
    )


@settings(max_examples=50, deadline=None)
@given(cuts=st.lists(st.integers(0, 500), max_size=40), seed=st.integers(0, 100))
def test_gaps_do_not_depend_on_the_pieces(cuts, seed):
    rng = np.random.default_rng(seed)
    time = np.sort(late(501, 0.3, 0, seed)[rng.random(501) > 0.05])
    finder, found = GapFinder(0.01, 0.015), []
    for part in np.split(time, sorted(min(c, len(time)) for c in cuts)):
        rows, steps = finder.add(part)
        assert np.array_equal(steps, time[rows] - time[rows - 1]) and (rows < finder.settled).all()
        found.append(rows)
    assert finder.settled == len(time) - WIDE
    assert np.array_equal(np.concatenate([*found, finder.end()[0]]), gap_rows(time, 0.01, 0.015))


@pytest.mark.parametrize("before, after", [(0, 100), (100, 0), (3, 3), (1, 1)])
def test_gaps_at_the_ends_of_a_log_are_found(before, after):
    time = 0.01 * np.concatenate((np.arange(before + 1), np.arange(before + 3, before + after + 4)))
    assert gap_rows(time, 0.01, 0.015).tolist() == [before + 1]
    assert segments(np.array([0, before + 1]), len(time)) == [
        (0, before + 1),
        (before + 1, len(time)),
    ]


@pytest.mark.parametrize("other, scatter", [(108, 0.0), (92, 0.0), (101, 0.05), (108, 0.15)])
@pytest.mark.parametrize("change", [0.3, 0.5, 0.8])
def test_rates_that_are_close_are_told_apart(other, scatter, change):
    """Counted in windows, one of which lies across the change; the scatter moves a window's end by
    1.4 of it in 512 steps.
    """
    n = 100_000
    first = round(change * n)
    time = np.concatenate((np.arange(first) / 100, first / 100 + np.arange(n - first) / other))
    time += 0.01 * scatter * np.random.default_rng(4).standard_normal(n)
    for cadence in (cadence_of(time), cadence_of(time[:10_000])):
        clock = Clock(cadence)
        clock.add(time)
        (found,) = (f for f in clock.findings() if f.kind == "two_rates")
        rates = found.detail["rate"], found.detail["other_rate"]
        assert sorted(rates) == pytest.approx(
            sorted((100, other)), rel=1e-5 + 1.5 * scatter / WINDOW
        )
        counts = {100: first, other: n - first}
        assert (
            abs(found.count - counts[min(counts, key=lambda rate: abs(rate - rates[1]))])
            <= 2 * WINDOW
        )
