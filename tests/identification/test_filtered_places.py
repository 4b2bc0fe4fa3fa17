"""Positions behind a filter, beside attitudes: the force that they make is damped, or late."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d
from scipy.signal import butter, lfilter, sosfiltfilt
from scipy.spatial.transform import Rotation, RotationSpline
from test_force_of_places import waves

import pyimu
from pyimu.identification.fit.trials import accel_trial
from pyimu.identification.reference.above import with_sensor_above
from pyimu.identification.reference.place import at_the_point
from pyimu.identification.reference.unfiltered import with_sharp_places
from pyimu.model.kinds import OWN
from pyimu.recording.recording import Recording
from pyimu.recording.reference.unfiltered_places import unlagged_places, unsmoothed_places
from pyimu.recording.reference.unsmoothed import Smoothing, unsmoothed

RATE, FINE, GRAVITY, MARGIN = 100.0, 2, 9.80665, 200
PLACES = ("ref_east", "ref_north", "ref_up")
ARM = np.array([0.03, -0.05, 0.02])


def mean_of(rows):
    """The moving average of an odd number of rows."""
    return lambda v: np.stack([np.convolve(c, np.ones(rows) / rows, "same") for c in v.T], axis=1)


def low_passed(cut_off):
    """Counts each sample as it comes: half a sample less late than one that is no computer's."""
    kept = np.exp(-2.0 * np.pi * cut_off / RATE)
    return lambda v: lfilter([1.0 - kept], [1.0, -kept], v, axis=0)


def both_ways(cut_off):
    low = butter(2, cut_off, fs=RATE, output="sos")
    return lambda v: sosfiltfilt(low, v, axis=0)


SMOOTHERS = {
    "moving_average": (mean_of(15), 0.15),
    "gaussian": (lambda v: gaussian_filter1d(v, 0.05 * RATE, axis=0), 0.05),
    "butterworth_2": (both_ways(5.0), 1.0 / (2.0 * np.pi * 5.0)),
}


class Wand:
    """Waved and turned by hand; the cameras look on for two seconds before and after."""

    def __init__(self, seed, seconds=60.0, place_noise=2e-4, body_noise=5e-4):
        rng = np.random.default_rng(seed)
        fine = np.arange(round((seconds + 2 * MARGIN / RATE) * RATE) * FINE) / (RATE * FINE)
        turn = RotationSpline(fine, Rotation.from_rotvec(waves(rng, fine, 0.5, 0.1, 1.2)[0]))
        place, _, push = (v[::FINE] for v in waves(rng, fine, 0.06, 0.2, 2.5))
        self.time = fine[::FINE]
        rate, slope, body = turn(self.time, 1), turn(self.time, 2), turn(self.time)
        force = body.inv().apply(push + [0.0, 0.0, GRAVITY])
        force += np.cross(slope, ARM) + np.cross(rate, np.cross(rate, ARM))
        noise = rng.standard_normal((4, len(self.time), 3))
        self.gyro, self.accel = rate + 2e-3 * noise[0], force + 0.01 * noise[1]
        self.place = place + place_noise * noise[2]
        q = (body * Rotation.from_rotvec(body_noise * noise[3])).as_quat(scalar_first=True)
        turned = np.sum(q[1:] * q[:-1], axis=1) < 0
        self.q = q * np.where(np.cumsum(np.append(False, turned)) % 2, -1.0, 1.0)[:, None]

    def log(self, places=None, q=None, accel=None):
        rows = slice(MARGIN, -MARGIN)
        shown = self.place if places is None else places
        q = self.q if q is None else q / np.linalg.norm(q, axis=1, keepdims=True)
        return Recording.from_arrays(
            name="wand",
            time=self.time[rows],
            gyro=self.gyro[rows],
            accel=(self.accel if accel is None else accel)[rows],
            ref_q=q[rows],
            **dict(zip(PLACES, shown[rows].T, strict=True)),
        )


def found_in(log):
    """The findings about positions, of a log whose clock is right."""
    sharp = with_sharp_places(log, {}, None)
    return [] if sharp is log else [f for f in sharp.reference.findings if f.column in PLACES]


def width(seconds):
    """Root of the second moment of the filter that was found, by its length: of a moving average
    that is 0.15 s, of the others less than a third of it."""
    return seconds if seconds < 0.1 else seconds / np.sqrt(12.0)


@pytest.mark.parametrize("kind", SMOOTHERS)
def test_the_filter_over_positions_is_found_and_how_long_it_is(kind):
    """By its form or one of the same second moment, which does nearly the same to what moves below
    2.5 Hz: of six seeds half take a moving average for a Gaussian."""
    smoother, size = SMOOTHERS[kind]
    wand = Wand(seed=21)
    (found,) = found_in(wand.log(smoother(wand.place)))
    assert found.kind == "reference_smoothed"
    assert width(found.detail["seconds"]) == pytest.approx(width(size), rel=0.05)


@pytest.mark.parametrize("cut_off", [5.0, pytest.param(12.0, marks=pytest.mark.long)])
def test_a_low_pass_filter_over_positions_is_found_by_its_delay_too(cut_off):
    wand = Wand(seed=22)
    (found,) = found_in(wand.log(low_passed(cut_off)(wand.place)))
    assert found.kind == "reference_lag"
    assert found.detail["time_constant"] == pytest.approx(1 / (2 * np.pi * cut_off), rel=0.05)


def test_positions_that_are_late_alone_are_moved():
    wand = Wand(seed=23)
    late = np.vstack([wand.place[:2], wand.place[:-2]])
    (found,) = found_in(wand.log(late))
    assert found.kind == "positions_late"
    assert found.detail["late"] == pytest.approx(2.0 / RATE, abs=2e-3)


def test_positions_that_are_early_by_less_than_half_a_row_stay():
    """The accelerometers of a unit that was measured beside cameras are 0.3 ms from its gyros."""
    wand = Wand(seed=30)
    early = CubicSpline(wand.time, wand.place)(wand.time + 1e-3)
    assert not found_in(wand.log(early))


@pytest.mark.parametrize("seed", [306, pytest.param(310, marks=pytest.mark.long)])
def test_the_filter_of_the_attitudes_is_found_over_positions_whose_noise_hides_it(seed):
    """Software smooths all that cameras saw: one filter need not be found among many, and its
    width is that of the attitudes' to the last digit."""
    smoother, size = SMOOTHERS["gaussian"]
    wand = Wand(seed, place_noise=0.09)
    log = unsmoothed(wand.log(smoother(wand.place), smoother(wand.q)), Smoothing("gaussian", size))
    (found,) = found_in(log)
    assert (found.kind, found.detail["seconds"]) == ("reference_smoothed", size)


def test_positions_behind_none_are_not_behind_the_filter_of_the_attitudes():
    wand = Wand(seed=307, place_noise=0.06)
    smoother, size = SMOOTHERS["gaussian"]
    log = wand.log(q=smoother(wand.q))
    assert not found_in(unsmoothed(log, Smoothing("gaussian", size)))


def test_what_a_filter_over_positions_may_leave_is_no_effect():
    """Accelerometers that are 0.1 ms late explain a thousandth of what the filter did."""
    smoother, _ = SMOOTHERS["gaussian"]
    wand = Wand(seed=101)
    late = CubicSpline(wand.time, wand.accel)(wand.time - 1e-4)
    found = pyimu.close(wand.log(smoother(wand.place), accel=late))
    assert (found.verdict, found.added) == ("not_confirmed", ())
    (reason,) = {r.reason for _, r in found.refused if r.effect == "time_delay"}
    assert reason.startswith("explains less than 1% of what the filter over the positions does")


def ringing(force, turn=2.0 * np.pi * 40.0, zeta=0.3):
    """A force behind a filter of second order that rings (Tustin's rule)."""
    k = 2.0 * RATE / turn
    over = [k * k + 2.0 * zeta * k + 1.0, 2.0 - 2.0 * k * k, k * k - 2.0 * zeta * k + 1.0]
    return lfilter([1.0, 2.0, 1.0], over, force - force[0], axis=0) + force[0]


@pytest.mark.parametrize("sensor", ["as it is", "behind a low-pass", "that rings"])
@pytest.mark.parametrize("seed", [24, pytest.param(25, marks=pytest.mark.long)])
def test_positions_as_they_were_seen_stay(sensor, seed):
    """A sensor's own low-pass filter damps what positions show, and one that rings raises it by
    less than a filter over positions that is worth a name would lower them."""
    wand = Wand(seed)
    shown = {"behind a low-pass": low_passed(15.0), "that rings": ringing}
    accel = shown[sensor](wand.accel) if sensor in shown else None
    kinds = {f.kind for f in found_in(wand.log(accel=accel))}
    assert not kinds & {"reference_smoothed", "reference_lag"}
    assert not kinds or accel is not None


def test_positions_without_noise_are_behind_no_filter_that_smooths_the_sensors_noise():
    """What it explains is the accelerometer's noise, that of the positions being less."""
    assert not found_in(Wand(seed=84, seconds=40.0, place_noise=0.0).log())


@pytest.mark.parametrize("seed", [85, *(pytest.param(s, marks=pytest.mark.long) for s in (86, 88))])
def test_a_filter_over_positions_without_noise_is_found(seed):
    """As wide as it is, by its form: a moving average of as large a second moment does nearly the
    same below 2.5 Hz, and may be taken for it."""
    smoother, size = SMOOTHERS["gaussian"]
    wand = Wand(seed, seconds=40.0, place_noise=0.0)
    (found,) = found_in(wand.log(smoother(wand.place)))
    assert width(found.detail["seconds"]) == pytest.approx(size, rel=0.05)


def test_an_accelerometer_beside_smoothed_positions_is_not_blamed_and_its_own_is_found():
    """A scale factor of 1 % is its own; over the attitudes lies the same filter. Without the filter
    taken out the scale factors were 5 to 15 % off, and unexplained."""
    smoother, _ = SMOOTHERS["butterworth_2"]
    wand = Wand(seed=26, seconds=90.0)
    log = wand.log(smoother(wand.place), smoother(wand.q), 1.01 * wand.accel)
    closed = pyimu.close(log)
    assert not closed.added and closed.verdict == "clean", closed.report()
    (scale,) = [e for e in closed.estimated if (e.sensor, e.effect) == ("accel", "scale_factor")]
    assert np.all(np.abs(scale.value - 0.01) < 5 * scale.std)
    assert np.all(scale.std < 2e-3)
    assert "the positions of the reference of wand were smoothed as by" in closed.report()


@pytest.mark.parametrize("kind", SMOOTHERS)
def test_what_undoes_a_filter_gives_the_positions_back(kind):
    smoother, size = SMOOTHERS[kind]
    wand = Wand(seed=27, seconds=20.0, place_noise=0.0)
    log = wand.log(smoother(wand.place))
    sharp = unsmoothed_places(log, Smoothing(kind, size), "position")
    assert missed(wand, sharp.reference) < 0.01 * missed(wand, log)


def test_what_undoes_a_lag_gives_the_positions_back():
    """The filter of a computer is early by half a sample beside the law of a time constant."""
    wand = Wand(seed=28, seconds=20.0, place_noise=0.0)
    log = wand.log(low_passed(8.0)(wand.place))
    sharp = unlagged_places(log, 1.0 / (2.0 * np.pi * 8.0), "position", early=0.5 / RATE)
    assert missed(wand, sharp.reference) < 0.05 * missed(wand, log)


def missed(wand, reference):
    """By how many m the positions of a reference miss those that were filtered, at most."""
    seen = np.column_stack([getattr(reference, n) for n in PLACES])
    known = np.isfinite(seen).all(axis=1)
    assert known[MARGIN:-MARGIN].all()
    return np.abs(seen - wand.place[MARGIN:-MARGIN])[known].max()


def test_what_a_filter_hides_is_taken_from_the_sensor():
    """Of waves of up to 2.5 Hz behind 1.2 Hz; without it they come down into the band."""
    wand, size = Wand(seed=29, seconds=40.0), 1.0 / (2.0 * np.pi * 1.2)
    log = wand.log(both_ways(1.2)(wand.place))
    sharp = unsmoothed_places(log, Smoothing("butterworth_2", size), "position")
    hidden = accel_trial(sharp, False)
    (a, b), *others = (shown := with_sensor_above(hidden)).segments

    def left(trial):
        return (at_the_point(trial) - trial.u[:, OWN["accel"]])[a:b].std()

    assert not others and left(shown) < 0.1 * left(hidden)
