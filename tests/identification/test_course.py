"""The loop on a car that knows its position: the clock, the heading, and no blame on the gyro."""

from dataclasses import replace

import numpy as np
import pytest
import vehicle_drives
from places import measured
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

import pyimu
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.clock import measure
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

NOISES = (0.01, 0.02, 0.03)
DRAWS = 32


def car(k, late, down):
    """Drive ``k``: positions of 10 Hz with 1 to 3 cm of noise, a gyro ``late`` s with a bias."""
    drive = vehicle_drives.figure_eight(k)
    turn = Rotation.from_euler("xyz", [180 * down + 3, 4, 30 * k], degrees=True).as_matrix()
    gyro, accel = vehicle_drives.measured_by(drive, turn, late, k)
    north, east = vehicle_drives.received(drive, NOISES[k % 3], k + 1000)
    return Recording.from_arrays(
        name="car",
        time=drive.time,
        gyro=gyro + [0.01, -0.005, 0.02],
        accel=accel,
        ref_north=north,
        ref_east=east,
    )


def clock_of(closed):
    return closed.recordings[0].log_state["gyro"]["reference"]["clock"]


@pytest.mark.long
def test_the_clock_is_as_far_off_as_its_standard_error_says():
    """The sum of squares over ``DRAWS`` is chi-square if the standard error is right; one that is
    estimated from some fifty windows scatters by a tenth, and so may be 1.25 times too small, or
    too large.
    """
    z = []
    for k in range(DRAWS):
        late = (0.3, -0.3)[k % 2]
        clock = measure(gyro_trial(car(k, late, k // 2 % 2)), Sensor("gyro"))
        assert clock.keeps_step
        z.append((clock.mean - late) / clock.std)
    squares = np.sum(np.square(z))
    assert squares < 1.25**2 * chi2.ppf(1 - 1e-4, DRAWS)
    assert squares > 1.25**-2 * chi2.ppf(1e-4, DRAWS)


@pytest.mark.long
@pytest.mark.parametrize(
    "k, late, down", [(0, 0.3, False), (1, -0.3, True), (2, 0.3, True), (5, 0.0, False)]
)
def test_a_gyro_without_fault_is_not_blamed_and_its_heading_follows(k, late, down):
    closed = pyimu.close(car(k, late, down))
    assert not closed.added and not closed.refused, closed.report()
    clock = clock_of(closed)
    assert abs(clock["late"] - late) < 5 * clock["std"]
    assert closed.recordings[0].log_state["gyro"]["reference"]["up"][2] * (-1) ** down > 0.9
    before, after = np.degrees(closed.heading)
    # The course of a smoothed position of 3 cm at 3 m/s and 10 Hz: under 1 deg.
    assert after < 1.0 and (before > 4.0) == (late != 0.0)
    assert "heading error" in closed.report()
    assert closed.as_dict()["error"]["heading"]["after"] == closed.heading[1]


def test_a_gyro_with_a_wrong_scale_is_named_behind_the_clock():
    log = car(4, 0.3, True)
    part = pyimu.part("imt30")
    faulty = Recording.from_arrays(
        name="car",
        time=log.time,
        gyro=log.gyro * [1.0, 1.0, 1.08],
        accel=log.accel,
        ref_north=log.ref_north,
        ref_east=log.ref_east,
    )
    closed = pyimu.close(faulty, part)
    added = {a.effect: a for a in closed.added if a.sensor == "gyro"}
    assert "scale_factor" in added, closed.report()
    s = added["scale_factor"].parameters["s"]
    # The tilt is known to a degree or two of the four and three there are: cos to 0.002.
    assert abs(s[0][2] - 0.08) < 5 * s[1][2] + 0.002


def test_positions_with_east_and_north_swapped_are_said_to_be_mirrored():
    right = car(1, -0.3, True)
    closed = pyimu.close(replace(right, ref_east=right.ref_north, ref_north=right.ref_east))
    assert closed.verdict == "reference_unfit", closed.report()
    assert "east and north are swapped" in closed.reason


def test_a_car_that_never_drives_has_no_course():
    rng = np.random.default_rng(3)
    time = np.arange(0, 60, 0.01)
    log = Recording.from_arrays(
        name="parked",
        time=time,
        gyro=0.3 * rng.standard_normal((len(time), 3)),
        ref_north=0.02 * rng.standard_normal(len(time)),
        ref_east=0.02 * rng.standard_normal(len(time)),
    )
    with pytest.raises(pyimu.UserError, match="parked: .*course"):
        pyimu.close(log)


def test_a_robot_that_turns_on_the_spot_has_a_course_that_does_not_turn():
    """A square of 6 m at up to 1 m/s, known to a centimetre: it stands while it turns, and what its
    course shows beside is noise, which was another body's motion.
    """
    rng, time = np.random.default_rng(5), np.arange(0.0, 80.0, 0.01)
    phase = np.mod(time, 20.0)
    speed = np.where(phase < 12.0, np.sin(np.pi * phase / 12.0) ** 2, 0.0)
    rate = np.where(phase > 14.0, np.pi / 6 * np.sin(np.pi * (phase - 14.0) / 6.0) ** 2, 0.0)
    heading = 0.01 * np.cumsum(rate)
    way = 0.01 * np.cumsum(speed[:, None] * np.column_stack([np.cos(heading), np.sin(heading)]), 0)
    place = np.where(np.arange(len(time))[:, None] % 10, np.nan, way)
    place = place + 0.01 * rng.standard_normal(place.shape)
    gyro = np.column_stack([0 * rate, 0 * rate, rate]) + 1e-3 * rng.standard_normal((len(time), 3))
    log = Recording.from_arrays(
        name="robot", time=time, gyro=gyro, ref_east=place[:, 0], ref_north=place[:, 1]
    )
    with pytest.raises(pyimu.UserError, match="robot: nothing to compare: .*turn.*on the spot"):
        pyimu.close(log)


def test_the_radio_controlled_car_and_its_receiver_lie_a_quarter_of_a_second_apart():
    closed = pyimu.close(measured("morpinet_rccar_n"))
    assert 0.23 <= clock_of(closed)["late"] <= 0.27
    before, after = np.degrees(closed.heading)
    assert before > 10 and after <= 1.5
    assert not closed.added, closed.report()
    (found,) = [f for f in closed.quality if f.kind == "mounted"]
    assert (found.column, found.detail["points"]) == ("gyro_z", "down")
