"""References that software smoothed without delay, beside a gyro."""

import numpy as np
import pytest
from loop_cases import smooth
from scipy.ndimage import gaussian_filter1d
from scipy.signal import butter, lfilter, sosfiltfilt
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.above import with_gyro_above
from pyimu.model.kinds import OWN
from pyimu.recording.integration import integrated
from pyimu.recording.recording import Recording
from pyimu.recording.reference.filters import turned_by
from pyimu.recording.reference.unsmoothed import Smoothing, unsmoothed

H, MARGIN = 0.01, 100


def mean_of(rows):
    """The moving average of an odd number of rows."""
    return lambda v: np.stack([np.convolve(c, np.ones(rows) / rows, "same") for c in v.T], axis=1)


SMOOTHERS = {
    "moving_average": (mean_of(15), 0.15),
    "gaussian": (lambda v: gaussian_filter1d(v, 0.05 / H, axis=0), 0.05),
    "butterworth_2": (
        lambda v: sosfiltfilt(butter(2, 4.0, fs=1 / H, output="sos"), v, axis=0),
        1.0 / (2.0 * np.pi * 4.0),
    ),
}


class Hand:
    """A wand turned by hand; the first and the last second of what is seen are not given."""

    def __init__(self, seed, seconds=90.0, shaken=0.0):
        rng = np.random.default_rng(seed)
        self.time = H * np.arange(-MARGIN, round(seconds / H) + MARGIN)
        angles = smooth(rng, self.time, 0.4, highest=1.0) * [1.0, 0.8, 1.0]
        if shaken:
            angles = angles + smooth(rng, self.time, shaken, highest=8.0)
        self.turn = Rotation.from_euler("ZYX", angles)
        self.rate = RotationSpline(self.time, self.turn)(self.time, 1)
        self.noise = rng.standard_normal((2, len(self.time), 3))

    def quaternions(self, noise=0.0):
        q = (self.turn * Rotation.from_rotvec(noise * self.noise[0])).as_quat(scalar_first=True)
        turned = np.sum(q[1:] * q[:-1], axis=1) < 0
        return q * np.where(np.cumsum(np.append(False, turned)) % 2, -1.0, 1.0)[:, None]

    def log(self, rate=None, **reference):
        rows = slice(MARGIN, -MARGIN)
        gyro = (self.rate if rate is None else rate) + 2e-3 * self.noise[1]
        return Recording.from_arrays(
            time=self.time[rows],
            gyro=gyro[rows],
            **{name: values[rows] for name, values in reference.items()},
        )


def units(q):
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def found_in(closed):
    return [f for f in closed.quality if f.kind == "reference_smoothed"]


def blamed(closed):
    return [a.effect for a in closed.added] + [f.text for f in closed.formulas]


@pytest.mark.parametrize(
    "kind, noise",
    [
        ("moving_average", 0.0),
        ("butterworth_2", 0.0),
        pytest.param("gaussian", 0.0, marks=pytest.mark.long),
        ("gaussian", 1e-3),
        pytest.param("moving_average", 1e-3, marks=pytest.mark.long),
        pytest.param("butterworth_2", 1e-3, marks=pytest.mark.long),
    ],
)
def test_a_smoothed_attitude_is_undone_and_no_error_of_the_sensor(kind, noise):
    """It was a formula of rates and angular accelerations, and left up to 20 times the noise. With
    the noise of a camera two filters of one variance in time are the same."""
    hand = Hand(seed=11)
    smoother, size = SMOOTHERS[kind]
    closed = pyimu.close(hand.log(ref_q=units(smoother(hand.quaternions(noise)))))
    (found,) = found_in(closed)
    assert not blamed(closed), closed.report()
    assert closed.verdict not in ("unexplained", "partly", "not_confirmed"), closed.report()
    assert "was smoothed as by" in closed.report()
    if not noise:
        assert found.detail["seconds"] == pytest.approx(size, rel=0.01)
        gyro = closed.errors["gyro"]
        assert gyro.after.total < 1.2 * gyro.floor.total


def test_a_smoothed_rate_is_undone():
    hand = Hand(seed=12)
    closed = pyimu.close(hand.log(ref_rate=mean_of(21)(hand.rate)))
    (found,) = found_in(closed)
    assert found.detail["seconds"] == pytest.approx(0.21, rel=0.01)
    assert not blamed(closed), closed.report()


@pytest.mark.parametrize(
    "kind, noise, seed",
    [
        ("moving_average", 0.0, 29),
        ("butterworth_2", 1e-3, 44),
        pytest.param("moving_average", 0.0, 17, marks=pytest.mark.long),
        pytest.param("moving_average", 1e-3, 31, marks=pytest.mark.long),
        pytest.param("gaussian", 1e-3, 41, marks=pytest.mark.long),
        *(
            pytest.param(kind, noise, seed, marks=pytest.mark.long)
            for kind in SMOOTHERS
            for noise in (3e-4, 1e-3)
            for seed in (61, 62)
        ),
    ],
)
def test_what_moves_above_all_that_can_be_restored_is_no_error_of_the_sensor(kind, noise, seed):
    """Much of the motion is quicker than the filter shows: through the window of the band it left
    up to 30 times the noise, a filter that was a little long looked like coning, and the slow
    part of what shaking makes like a heading that drifts."""
    hand, (smoother, size) = Hand(seed, shaken=0.04), SMOOTHERS[kind]
    closed = pyimu.close(hand.log(ref_q=units(smoother(hand.quaternions(noise)))))
    (found,) = found_in(closed)
    assert found.detail["seconds"] == pytest.approx(size, rel=0.002)
    assert not blamed(closed) and closed.verdict == "clean", closed.report()
    gyro = closed.errors["gyro"]
    assert gyro.after.total < 1.3 * gyro.floor.total


def test_nor_is_it_of_a_smoothed_rate():
    hand = Hand(seed=17, shaken=0.04)
    closed = pyimu.close(hand.log(ref_rate=mean_of(21)(hand.rate)))
    (found,) = found_in(closed)
    assert found.detail["seconds"] == pytest.approx(0.21, rel=0.002)
    assert not blamed(closed), closed.report()


@pytest.mark.parametrize("of", ["ref_rate", "ref_q"])
@pytest.mark.parametrize("seed", range(21, 25))
def test_beside_what_the_gyro_shows_above_nothing_but_its_noise_is_left(of, seed):
    """The filter known: without what it hides 100 times that noise was left."""
    hand = Hand(seed, seconds=30.0, shaken=0.04)
    smoothed = mean_of(21)(hand.rate if of == "ref_rate" else hand.quaternions())
    log = hand.log(**{of: smoothed if of == "ref_rate" else units(smoothed)})
    trial = gyro_trial(unsmoothed(log, Smoothing("moving_average", 0.21)))
    whole = with_gyro_above(trial)
    left, was = (
        np.concatenate([(t.y - t.u[:, OWN["gyro"]])[a:b] for a, b in whole.segments])
        for t in (whole, trial)
    )
    assert left.std() < 2e-3 < 0.01 * was.std()


def test_turns_that_a_rate_makes_are_added_up_by_more_than_lines():
    """A body that cones at 3 Hz and swings at 2 Hz, seen at 100 Hz: means of neighbours damp its
    turns by (w h)^2 / 12, and leave out what the axis turns by within a step, which adds up."""

    def turn(time):
        cone = 0.3 * np.stack([f(6 * np.pi * time) for f in (np.cos, np.sin, np.zeros_like)], 1)
        swing = Rotation.from_euler("z", 0.5 * np.sin(4 * np.pi * time)[:, None])
        return swing * Rotation.from_rotvec(cone)

    def most_missed(seen):
        return (seen.inv() * seen[1] * true[1].inv() * true)[1:-1].magnitude().max()

    time, little = H * np.arange(1000), 1e-5
    true = turn(time)
    rate = (turn(time - little).inv() * turn(time + little)).as_rotvec() / (2 * little)
    means = np.vstack([rate[:1], 0.5 * (rate[1:] + rate[:-1])])
    seen = Rotation.from_quat(turned_by(rate, H), scalar_first=True)
    assert most_missed(seen) < 0.01 * most_missed(integrated(means, H, Rotation.identity()))


def test_a_filter_that_hardly_damps_the_motion_is_undone():
    """Its gain falls with the fourth power of the frequency, and the motion is far below: a cubic
    scale factor took its place."""
    hand = Hand(seed=16)
    low = butter(2, 5.4, fs=1 / H, output="sos")
    closed = pyimu.close(hand.log(ref_rate=sosfiltfilt(low, hand.rate, axis=0)))
    (found,) = found_in(closed)
    assert found.detail["seconds"] == pytest.approx(1.0 / (2.0 * np.pi * 5.4), rel=0.03)
    assert not blamed(closed), closed.report()


def low_passed(rate, tau):
    kept = np.exp(-H / tau)
    return lfilter([1.0 - kept], [1.0, -kept], rate, axis=0)


@pytest.mark.parametrize("filtered", [False, True], ids=["clean", "gyro behind a low-pass"])
def test_what_was_not_smoothed_stays(filtered):
    hand = Hand(seed=13)
    rate = low_passed(hand.rate, 0.02) if filtered else None
    closed = pyimu.close(hand.log(rate, ref_q=hand.quaternions(1e-3)))
    assert not found_in(closed)
    assert bool(closed.added) == filtered, closed.report()


@pytest.mark.parametrize("kind", SMOOTHERS)
def test_what_undoes_a_filter_gives_the_attitude_back(kind):
    """Up to the frequency that is said, here all that moves; near the ends nothing is said."""
    hand = Hand(seed=14, seconds=30.0)
    smoother, size = SMOOTHERS[kind]
    log = hand.log(ref_q=units(smoother(hand.quaternions())))
    sharp = unsmoothed(log, Smoothing(kind, size))
    known = np.isfinite(sharp.ref_q).all(axis=1)
    assert known[MARGIN:-MARGIN].all() and not known[0] and not known[-1]

    def missed(q):
        apart = Rotation.from_quat(q[known], scalar_first=True).inv()
        return (apart * self_turn[known]).magnitude().max()

    self_turn = hand.turn[MARGIN:-MARGIN]
    assert missed(sharp.ref_q) < 0.01 * missed(log.ref_q)


def test_a_log_that_is_shorter_than_its_filter_stays_as_it_is():
    hand = Hand(seed=15, seconds=3.0)
    log = hand.log(ref_q=hand.quaternions())
    assert unsmoothed(log, Smoothing("moving_average", 0.5)) is log
