"""Logs at rest as people bring them: a hand begins and ends them, and a radio loses samples."""

from dataclasses import replace

import numpy as np
import pytest

import pyimu
from pyimu import Recording

H, ROWS, N, G = 0.01, 60_000, 2e-4, 9.80665


def rest(seed):
    """Ten minutes of white noise, level, the temperature beside it."""
    rng = np.random.default_rng(seed)
    gyro, accel = (n / H**0.5 * rng.standard_normal((ROWS, 3)) for n in (N, 10 * N))
    time = H * np.arange(ROWS)
    return Recording.from_arrays(
        "rest",
        time=time,
        gyro=gyro,
        accel=accel + [0.0, 0.0, G],
        temperature=25.0 + 0.01 * time + 0.05 * rng.standard_normal(ROWS),
    )


def handled(log, first, last):
    """The log with a hand's motion in its first and last seconds."""
    t = log.time - log.time[0]
    moves = (t < first) | (t > t[-1] - last)
    swing = np.sin(2 * np.pi * 0.7 * t + 1.0)[:, None] * moves[:, None]
    return replace(log, gyro=log.gyro + swing, accel=log.accel + 3.0 * swing)


@pytest.mark.parametrize("first, last", [(12.0, 0.0), (0.0, 9.0), (15.0, 20.0)])
def test_a_hand_that_begins_and_ends_a_log_is_left_out(first, last):
    """The whole log was taken to move, and no part came of it. A second and two are left out with
    each; what is left has the noise of the same rows alone.
    """
    log = rest(1)
    c = pyimu.characterize(handled(log, first, last))
    (found,) = [f for f in c.logs[0].findings if f.kind == "handled"]
    assert not c.logs[0].moves and "handled: " in c.report()
    for own, given in ((found.detail["first"], first), (found.detail["last"], last)):
        assert given <= own <= given + 3.0 * (given > 0.0), found
    a, b = np.searchsorted(log.time, [found.detail["first"], log.time[-1] - found.detail["last"]])
    alone = pyimu.characterize(log.slice(int(a), int(b)))
    for one, other in zip(c.logs[0].channels, alone.logs[0].channels, strict=True):
        assert one.coefficient("N").value == pytest.approx(other.coefficient("N").value, rel=1e-6)
        assert one.mean == pytest.approx(other.mean, abs=1e-9)


def test_spikes_of_the_hand_are_in_no_noise_but_those_of_the_rest_are():
    log = handled(rest(7), 12.0, 0.0)
    log.gyro[500, 0] += 40.0
    quiet = pyimu.characterize(log)
    assert "the spikes are in N" not in quiet.report()
    log.gyro[30_000, 1] += 40.0
    (found,) = [f for f in pyimu.characterize(log).logs[0].findings if f.kind == "spikes"]
    assert (found.column, found.count, found.detail["first_row"]) == ("gyro_y", 1, 30_000)


@pytest.mark.parametrize("first, last, middle", [(70.0, 0.0, False), (5.0, 5.0, True)])
def test_a_log_that_moves_elsewhere_or_for_long_is_none_at_rest(first, last, middle):
    log = handled(rest(2), first, last)
    if middle:
        log.gyro[30_000:31_000] += np.sin(np.arange(1000) / 20.0)[:, None]
    c = pyimu.characterize(log)
    assert c.logs[0].moves and not any(f.kind == "handled" for f in c.logs[0].findings)


def lossy(log, count, seed=3):
    """The log without ``count`` of its samples, one here and one there."""
    kept = np.ones(len(log), dtype=bool)
    kept[np.random.default_rng(seed).choice(np.arange(1, ROWS - 1), count, replace=False)] = False
    groups = {g: getattr(log, g)[kept] for g in ("time", "gyro", "accel", "temperature")}
    return Recording.from_arrays("lossy", **groups)


def test_samples_that_were_lost_one_by_one_leave_deviations_as_long_as_the_log():
    """A hundred of 60,000 left no stretch of half a minute, and no bias stability in it. Closed up
    the deviations are those of the whole log but for that share of their terms, whose scatter at a
    cluster time is that of a chi-square: a hundredth where there are a thousand terms and more.
    """
    log = rest(4)
    whole, found = (pyimu.characterize(v).logs[0].sensors["gyro"] for v in (log, lossy(log, 100)))
    assert (found.segments, found.closed, found.segments_used) == (101, 100, 1)
    for one, other in zip(found.channels, whole.channels, strict=True):
        a, b = one.noise.allan, other.noise.allan
        assert a.tau[-1] > 0.99 * b.tau[-1]
        short = b.tau < 1.0
        expected = np.interp(b.tau[short], a.tau, a.deviation)
        assert np.all(np.abs(expected / b.deviation[short] - 1) < 0.02)


def test_lost_samples_are_closed_up_to_a_twentieth_of_the_log():
    found = pyimu.characterize(lossy(rest(5), 4000)).logs[0].sensors["gyro"]
    assert found.closed <= 0.05 * found.samples and found.segments - found.closed > 500


@pytest.mark.parametrize(
    "count, said", [(1, "1 gap. It is short, and closed"), (3, "3 gaps. All are short")]
)
def test_gaps_that_were_closed_are_said(count, said):
    assert said in pyimu.characterize(lossy(rest(6), count)).report()
