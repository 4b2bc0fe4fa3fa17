"""The loop on real recordings of real sensors, held out as their sources were explored by hand."""

import numpy as np
import pytest
from places import measured

import pyimu
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.align import aligned
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.sensor import Sensor

MG = 9.80665e-3


def recordings(*names):
    return [measured(n) for n in names]


@pytest.fixture(scope="module")
def wand():
    """Of two logs the parts that clip, of one on x and of the other on y, and spikes; the three
    whole logs take minutes (benchmarks/measured.py).
    """
    x, y = recordings("repoimu_tstick_test05_trial1", "repoimu_tstick_test06_trial1")
    return pyimu.close(
        [pyimu.read_recording(x).slice(0, 4000), pyimu.read_recording(y).slice(2000)]
    )


@pytest.mark.long
def test_repoimu_gyro_clips_where_its_samples_stop(wand):
    found = next(a for a in wand.added if a.effect == "saturation")
    limit = found.parameters["limit"][0]
    # The plateau of this part wanders by 0.7 %; its largest readings are 7.36 and 7.43 rad/s.
    np.testing.assert_allclose(limit[:2], [7.36, 7.43], rtol=0.007)
    assert limit[2] == 0, "z never clips"


@pytest.mark.long
def test_repoimu_held_out_residual_of_test05_falls_to_a_fifth(wand):
    entry = next(r for r in wand.recordings if "test05" in r.file)
    rate = entry.errors["gyro"]
    assert rate.after.total <= rate.before.total / 5


@pytest.mark.long
def test_repoimu_reference_spikes_are_reported_and_left_out(wand):
    (spikes,) = [f for f in wand.quality if f.kind == "reference_spikes"]
    assert "test06" in spikes.detail["recording"]


def middle():
    """The middle of a log whose two clocks are 1e-4 apart, where none of their slips lies."""
    (path,) = recordings("repoimu_tstick_test07_trial1")
    return pyimu.read_recording(path).slice(2250, 6750)


def test_a_clock_that_drifts_by_half_a_sample_is_seen():
    (trial,) = aligned([gyro_trial(middle())], [], Sensor("gyro"))
    assert 8e-5 < trial.clock.skew[0] < 1.4e-4 and trial.clock.taken_out


@pytest.mark.long
def test_a_clock_that_drifts_by_half_a_sample_blames_no_sensor():
    closed = pyimu.close(middle())
    assert not [a.effect for a in closed.added if a.sensor == "gyro"]


@pytest.mark.long
def test_broad_lag_fitted_on_02_holds_on_07():
    """By a minute of each; the whole logs take longer (benchmarks/measured.py)."""
    minute = 60 * 286
    fitted, judge = (
        pyimu.read_recording(path).slice(0, minute)
        for path in recordings(
            "broad_02_undisturbed_slow_rotation_B", "broad_07_undisturbed_fast_rotation_B"
        )
    )
    closed = pyimu.close(fitted, holdout=judge)
    found = closed.added[0]
    assert found.effect == "time_delay" and "one class" in found.note
    assert set(found.alternatives) == {"first_order_lag", "lag"}
    assert 4.0e-3 <= found.parameters["td"][0] <= 4.5e-3
    assert closed.errors["gyro"].after.total <= closed.errors["gyro"].before.total / 5
    assert moving_average_ratio(judge, closed.before, closed.after) <= 1 / 5


@pytest.mark.long
def test_broad_a_delay_gains_no_more_than_the_squares_allow():
    """White noise of the residual's size is the least likely of all that have it: over n rows no
    likelihood rises by more than n log(before / after). The noise of the model that lacks the delay
    is nearly all motion; fitted beside the motion and with it in turns it never stood. A band of
    some hertz has twice as many independent rows a second, and is sampled no more than twice as
    often.
    """
    (log,) = recordings("broad_07_undisturbed_fast_rotation_B")
    closed = pyimu.close(log)
    found = next(a for a in closed.added if a.effect == "time_delay")
    time, error = pyimu.read_recording(log).time, closed.errors["gyro"]
    rows = 3 * 4 * closed.band_hz["gyro"] * (time[-1] - time[0])
    assert found.gain <= rows * np.log(error.before.total / error.after.total)


def moving_average_ratio(log, before, after, taps=15):
    """Residual after over before, gyro and reference both through the same moving average, without
    the package's own filter.
    """
    from scipy.ndimage import uniform_filter1d

    from pyimu.recording.reference.rate import reference_rate

    reference = reference_rate(log).rate
    known = np.isfinite(reference).all(axis=1)
    inside = uniform_filter1d(known.astype(float), 2 * taps + 1) > 0.999
    rms = []
    for part in (before, after):
        answer, _ = pyimu.simulate(
            part,
            np.nan_to_num(reference),
            log.accel,
            25.0,
            seed=None,
            sample_period=log.sample_period,
        )
        left = uniform_filter1d(log.gyro - answer, taps, axis=0)[inside]
        rms.append(np.sqrt(np.mean((left - left.mean(axis=0)) ** 2)))
    return rms[1] / rms[0]


@pytest.mark.long
def test_astropi_accelerometer_follows_temperature():
    closed = pyimu.close(recordings("astropi_lsm9ds1_static"))
    (found,) = (a for a in closed.added if not CATALOGUE[a.effect].stochastic)
    assert (found.sensor, found.effect) == ("accel", "thermal_bias")
    force = closed.errors["accel"]
    np.testing.assert_allclose(force.before.per_axis / MG, [1.51, 0.92, 1.37], atol=0.01)
    # By plain least squares and hand, on the same rows.
    by_hand, found = np.array([0.23, 0.24, 0.60]), force.after.per_axis / MG
    assert np.linalg.norm(found) <= 1.1 * np.linalg.norm(by_hand) and np.all(found <= 1.3 * by_hand)
