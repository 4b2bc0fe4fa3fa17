"""What is left of a filter that was taken out of positions, and was not quite of that size."""

import numpy as np
from test_filtered_places import RATE, SMOOTHERS, Wand, low_passed
from test_noise_of_places import fitted, scales

from pyimu.identification.fit.keys import LogPlace
from pyimu.identification.fit.place import STILL_LATE, STILL_SMOOTH
from pyimu.identification.fit.trials import accel_trial
from pyimu.identification.logs.trials import prepared
from pyimu.recording.reference.unfiltered_places import (
    places_on_time,
    unlagged_places,
    unsmoothed_places,
)
from pyimu.recording.reference.unsmoothed import Smoothing

CUT_OFF = 8.0
LAG = 1.0 / (2.0 * np.pi * CUT_OFF)


def lagged(wand, share):
    """The wand's positions behind a low-pass, a ``share`` of which was taken out; a computer's is
    early by half a sample beside the law of its time constant."""
    log = wand.log(low_passed(CUT_OFF)(wand.place))
    return unlagged_places(log, share * LAG, "position", early=0.5 / RATE)


def smoothed(wand, share):
    smoother, size = SMOOTHERS["gaussian"]
    log = wand.log(smoother(wand.place))
    return unsmoothed_places(log, Smoothing("gaussian", share * size), "position")


def model_of(log):
    (trial,), _ = prepared([accel_trial(log, False)], [], True)
    return fitted(trial)


def left(found, number):
    (trial,) = found.trials
    return found.states[trial.name].place[number], found.std[LogPlace(trial.name, number)]


def test_what_a_lag_leaves_is_found_and_bends_no_scale_factor():
    """(1 - share) of a first-order low-pass, to first order in w lag: the noise aside, (w lag)^2 of
    it are missing, 7 % at the wand's fastest."""
    found = model_of(lagged(Wand(seed=71), share=0.8))
    late, std = left(found, STILL_LATE)
    assert abs(late - 0.2 * LAG) < 4.0 * std + 0.1 * 0.2 * LAG
    assert std < 0.05 * LAG
    assert np.abs(scales(found)).max() < 4.5


def test_what_a_smoothing_leaves_is_half_the_variance_that_is_missing():
    found = model_of(smoothed(Wand(seed=72), share=0.9))
    size = SMOOTHERS["gaussian"][1]
    wide, std = left(found, STILL_SMOOTH)
    missing = 0.5 * (1.0 - 0.9**2) * size**2
    assert abs(wide - missing) < 4.0 * std + 0.1 * missing
    assert np.abs(scales(found)).max() < 4.5


def test_a_delay_of_positions_is_known_as_well_as_they_show_it():
    wand = Wand(seed=73)
    log = wand.log(np.vstack([wand.place[:2], wand.place[:-2]]))
    found = model_of(places_on_time(log, "position", early=-1.5 / RATE))
    late, std = left(found, STILL_LATE)
    assert abs(late - 0.5 / RATE) < 4.0 * std + 1e-4


def test_positions_as_they_were_seen_have_nothing_left_of_a_filter():
    (trial,), _ = prepared([accel_trial(Wand(seed=74, seconds=20.0).log(), False)], [], True)
    assert trial.place.size == 0.0 and STILL_LATE not in trial.place.unknown
