"""References that a logger writes at its own rows, each sample until the next one comes."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.recording.recording import Recording
from pyimu.recording.reference.held import held_apart
from pyimu.recording.reference.rate import reference_rate

ROW, SECONDS = 0.01, 60.0
TIME = np.arange(0.0, SECONDS, ROW)


def angle(t):
    """rad about z; turns at up to 1.3 Hz."""
    return 0.8 * np.sin(2 * np.pi * 0.4 * t) + 0.1 * np.sin(2 * np.pi * 1.3 * t)


def rate(t):
    return np.column_stack(
        [
            0.5 * np.sin(1.7 * t),
            0.4 * np.cos(2.9 * t),
            0.8 * 2 * np.pi * 0.4 * np.cos(2 * np.pi * 0.4 * t)
            + 0.13 * 2 * np.pi * np.cos(2 * np.pi * 1.3 * t),
        ]
    )


def about_z(turn):
    return Rotation.from_rotvec(np.outer(turn, [0.0, 0.0, 1.0])).as_quat(scalar_first=True)


def sampled(hz, first):
    """Times (k,) of samples, and the one (n,) that each row shows; ``first`` is in spacings."""
    node = (np.arange(-1, SECONDS * hz) + first) / hz
    return node, np.searchsorted(node, TIME, side="right") - 1


@settings(max_examples=40, deadline=None)
@given(share=st.floats(0.08, 0.95), first=st.floats(0.0, 0.99))
@example(share=0.4995, first=0.2499)
def test_samples_of_any_rate_are_placed_within_the_row_that_shows_them_first(share, first):
    """Spaced as they were taken; of all places the latest."""
    node, latest = sampled(share / ROW, first)
    assume(np.min(np.abs(node / ROW - np.rint(node / ROW))) > 1e-6)
    log = Recording.from_arrays(time=TIME, gyro=rate(TIME), ref_rate=rate(node)[latest])
    held = held_apart(log)
    own = held.reference.time
    taken = node[np.unique(latest)]
    assert len(own) == len(taken)
    late = (own - taken)[1:]
    # Where the rates are so near to a simple ratio that they hardly beat, and rows wait for parts
    # of a row alone, a drift may be left.
    waits = np.sort((TIME[np.flatnonzero(np.diff(latest)) + 1] - taken[1:]) / ROW % 1.0)
    widest = np.max(np.diff(waits, append=waits[0] + 1.0))
    least = -0.5 if widest < 0.1 else -1.0
    assert np.all(late > least * ROW) and np.all(late < 1.05 * ROW)
    number = np.arange(len(late))
    assert np.ptp(late - np.polyval(np.polyfit(number, late, 1), number)) < 0.1 * ROW


@pytest.mark.parametrize("kind", ["ref_q", "ref_rate", "ref_heading"])
def test_the_rate_of_a_held_reference_is_that_of_its_samples(kind):
    """60 Hz in rows of 100 Hz; the rows' own times scatter by 10 ms, and the rate with them."""
    node, latest = sampled(60.0, 0.0)
    values = {
        "ref_q": about_z(angle(node)),
        "ref_rate": rate(node),
        "ref_heading": angle(node),
    }[kind]
    log = Recording.from_arrays(time=TIME, gyro=rate(TIME), **{kind: values[latest]})
    held = held_apart(log)
    found = reference_rate(held).rate[:, 2]
    inside = np.isfinite(found) & (TIME > 1.0) & (TIME < SECONDS - 1.0)
    assert np.count_nonzero(inside) > 0.9 * len(TIME)
    # The samples are 0 to 6.7 ms older than their rows, and placed at the latest: at their own.
    off = found[inside] - rate(TIME)[inside, 2]
    assert np.std(off) < 2e-3 * np.std(rate(TIME)[:, 2])


def test_what_is_not_held_stays_as_it_is():
    turned = about_z(angle(TIME))
    every = Recording.from_arrays(time=TIME, gyro=rate(TIME), ref_q=turned)
    assert held_apart(every) is every
    _, latest = sampled(5.0, 0.3)
    both = Recording.from_arrays(
        time=TIME, gyro=rate(TIME), ref_q=turned, ref_east=TIME[latest], ref_north=TIME[latest]
    )
    assert held_apart(both) is both, "an attitude at every row beside a position that is held"
    turns = np.where((TIME > 20.0) & (TIME < 40.0), np.sin(0.7 * (TIME - 20.0)), 0.0)
    turns[3001] = turns[3000]
    stands = Recording.from_arrays(
        time=TIME, gyro=rate(TIME), ref_rate=np.outer(turns, [0.0, 0.0, 1.0])
    )
    assert held_apart(stands) is stands, (
        "neither a rest nor two rows that are alike are samples that were held"
    )
    none = Recording.from_arrays(time=TIME, gyro=rate(TIME))
    assert held_apart(none) is none


def test_samples_that_were_dropped_leave_the_others_in_their_places():
    rng = np.random.default_rng(0)
    node, _ = sampled(37.0, 0.2)
    node = node[rng.random(len(node)) > 0.05]
    latest = np.searchsorted(node, TIME, side="right") - 1
    seen = latest >= 0
    log = Recording.from_arrays(
        time=TIME[seen], gyro=rate(TIME[seen]), ref_rate=rate(node)[latest[seen]]
    )
    own = held_apart(log).reference.time
    late = (own - node[np.unique(latest[seen])])[1:]
    assert np.ptp(late) < 0.1 * ROW


def test_a_clean_sensor_beside_a_held_attitude_is_not_blamed():
    """It was "unexplained", and scale factors of up to 73 ppm were found."""
    rng = np.random.default_rng(3)
    node, latest = sampled(60.0, 0.4)
    fine = np.arange(-0.5, SECONDS + 0.5, 5e-4)
    swing = np.column_stack([0.6 * np.sin(2.1 * fine), 0.4 * np.sin(3.3 * fine), angle(fine)])
    turned = Rotation.from_euler("ZYX", swing)
    step = (turned[:-1].inv() * turned[1:]).as_rotvec() / 5e-4
    spun = np.column_stack([np.interp(TIME, fine[:-1] + 2.5e-4, step[:, i]) for i in range(3)])
    near = np.clip(np.rint((node[latest] - fine[0]) / 5e-4).astype(int), 0, len(fine) - 1)
    gyro = spun + 0.004 + 1e-3 * rng.standard_normal(spun.shape)
    seen = turned[near] * Rotation.from_rotvec((1e-4 * rng.standard_normal((len(node), 3)))[latest])
    log = Recording.from_arrays(time=TIME, gyro=gyro, ref_q=seen.as_quat(scalar_first=True))
    closed = pyimu.close(log)
    assert not closed.added and closed.verdict in ("clean", "undecidable"), closed.report()
    assert closed.references[0]["sample_rate"]["value"] == pytest.approx(60.0, rel=1e-3)
