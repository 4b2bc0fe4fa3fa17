"""A sensor, or markers, that turned in their mount once: the reference's, and no effect."""

from dataclasses import replace

import numpy as np
import pytest
import traps

from pyimu.identification.close import undeclared
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.logs.trials import aligned_trials
from pyimu.recording.recording import Recording


def findings(log, gyro=None):
    """What making the gyro's trial of a case finds; ``gyro`` stands in for its samples."""
    columns = dict(log.logs[0])
    if gyro is not None:
        columns["gyro"] = gyro
    recording = Recording.from_arrays("log", **columns)
    sensor = undeclared(recording.sample_rate).gyro
    ((trial,), _) = aligned_trials(sensor, gyro_trial, [recording], [], None)
    return {f.kind: f for f in trial.findings}, trial


@pytest.mark.parametrize("number", range(4))
def test_a_mount_that_slips_is_found_with_its_angle(number):
    """1 to 4 deg in 0.1 s; noise of the attitude of 0.1 deg in the band makes a hundredth of it,
    and a motion about few axes some tenths of a degree.
    """
    log = traps.case("mounting_slips", 2, number)
    found, trial = findings(log)
    assert found["mount_slipped"].detail["angle"] == pytest.approx(log.figures["angle"], rel=0.2)
    first, last = (found["mount_slipped"].detail[k] for k in ("first", "last"))
    inside = (trial.time > first) & (trial.time < last)
    assert not any(inside[a:b].any() for a, b in trial.segments)


@pytest.mark.parametrize("name", ["nothing_wrong", "mounting_10_deg", "gyro_early_12_5_ms"])
def test_one_mounting_is_one(name):
    for number in range(3):
        assert "mount_slipped" not in findings(traps.case(name, 2, number))[0]


def test_a_step_of_the_bias_and_a_gain_that_changes_are_the_sensors():
    log = traps.case("nothing_wrong", 2, 1)
    gyro, late = log.logs[0]["gyro"], log.logs[0]["time"] > 40.0
    step = np.where(late[:, None], np.radians([0.3, -0.5, 0.4]), 0.0)
    for changed in (gyro + step, gyro * np.where(late[:, None], [1.03, 0.98, 1.02], 1.0)):
        assert "mount_slipped" not in findings(log, changed)[0]


def test_a_mirrored_gyro_has_not_slipped():
    """Its cubic scale factor changes its gain a little as it moves: it had slipped by 176 deg."""
    case = traps.case("axes_exchanged_in_one", 30010, 0)
    assert "mount_slipped" not in findings(replace(case, logs=case.logs[1:]))[0]
