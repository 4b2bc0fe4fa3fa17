"""A reference in a file of its own: its own rate and clock, and what cannot be used."""

import numpy as np
import pytest
import vehicle_drives
from scipy.spatial.transform import Rotation

from pyimu.errors import UserError
from pyimu.recording.log import read_recording, read_reference
from pyimu.recording.recording import Recording
from pyimu.recording.reference.course import course_of, looks_like_degrees
from pyimu.recording.reference.epoch import time_apart
from pyimu.recording.reference.file import other_time, with_reference, with_references
from pyimu.recording.reference.rate import reference_rate

TIME = np.arange(0.0, 40.0, 0.005)
SIZE, SLOW = 0.8, 1 / 60


def angle(t):
    return SIZE * np.sin(2.0 * t)


def rate(t):
    return 2.0 * SIZE * np.cos(2.0 * t)


AXIS = np.array([1.0, 2.0, 2.0]) / 3


def log(**more):
    gyro = np.outer(rate(TIME), AXIS)
    noise = 1e-3 * np.random.default_rng(1).standard_normal(gyro.shape)
    return Recording.from_arrays(name="log", time=TIME, gyro=gyro + noise, **more)


def tracked(start=2.0, stop=30.0, period=SLOW):
    """An attitude about a fixed axis, as optical motion capture of 60 Hz sees it."""
    t = np.arange(start, stop, period)
    q = Rotation.from_rotvec(np.outer(angle(t), AXIS)).as_quat(scalar_first=True)
    return Recording.from_arrays(name="mocap", time=t, ref_q=q)


def test_a_slow_attitude_is_differentiated_through_its_own_samples():
    """Error of the slope of a cubic spline through samples of period T: h^3 / 24 times the fourth
    derivative, 2^4 SIZE here; 1e-6 rad/s. Near its ends it is larger.
    """
    reference = reference_rate(with_reference(log(), tracked()))
    known = np.isfinite(reference.rate).all(axis=1)
    assert reference.kind == "attitude" and reference.band_limit == pytest.approx(0.25 / SLOW)
    np.testing.assert_array_equal(known, (TIME >= 2.0) & (TIME <= tracked().time[-1]))
    inside = known & (TIME > 3.0) & (TIME < 29.0)
    off = reference.rate[inside] - np.outer(rate(TIME[inside]), AXIS)
    assert np.abs(off).max() < 2 * SLOW**3 / 24 * 16 * SIZE
    q = with_reference(log(), tracked()).ref_q[inside]
    truth = Rotation.from_rotvec(np.outer(angle(TIME[inside]), AXIS))
    assert (Rotation.from_quat(q, scalar_first=True) * truth.inv()).magnitude().max() < 1e-5


def test_its_own_reference_is_put_aside():
    own = log(ref_rate=np.ones((len(TIME), 3)), ref_heading=TIME)
    paired = with_reference(own, tracked())
    assert paired.ref_rate is None and paired.ref_heading is None
    assert reference_rate(paired).kind == "attitude"


def test_a_rate_at_times_of_its_own_is_interpolated_and_ends_with_its_band():
    t = np.arange(1.0, 35.0, 0.02)
    other = Recording.from_arrays(name="table", time=t, ref_rate=np.outer(rate(t), AXIS))
    reference = reference_rate(with_reference(log(), other))
    assert reference.kind == "rate" and reference.band_hz <= 0.25 / 0.02
    known = np.isfinite(reference.rate[:, 0])
    off = reference.rate[known] - np.outer(rate(TIME[known]), AXIS)
    # A cubic spline misses by 5/384 of T^4 times the fourth derivative, more at its ends.
    assert np.abs(off).max() < 10 * 5 / 384 * 0.02**4 * 2**5 * SIZE


def test_positions_and_headings_of_another_file_are_used_too():
    drive = vehicle_drives.figure_eight(2)
    gyro, accel = vehicle_drives.measured_by(drive, np.eye(3), 0.0, 2)
    car = Recording.from_arrays(name="car", time=drive.time, gyro=gyro, accel=accel)
    north, east = vehicle_drives.received(drive, 0.02, 2)
    seen = np.isfinite(north)
    alone = Recording.from_arrays(
        name="rtk", time=drive.time[seen], ref_north=north[seen], ref_east=east[seen]
    )
    within = Recording.from_arrays(
        time=drive.time, gyro=gyro, accel=accel, ref_north=north, ref_east=east
    )
    np.testing.assert_allclose(
        reference_rate(with_reference(car, alone)).rate, reference_rate(within).rate, rtol=1e-9
    )
    turning = Recording.from_arrays(
        name="compass", time=drive.time[::5], ref_heading=drive.course[::5]
    )
    found = reference_rate(with_reference(car, turning))
    inside = np.isfinite(found.rate[:, 2])
    assert found.kind == "heading"
    assert np.abs(found.rate[inside, 2] - drive.rate[inside]).max() < 1e-2


def write(path, header, columns):
    rows = [
        ",".join(header),
        *(",".join(f"{v!r}" for v in row) for row in np.column_stack(columns).tolist()),
    ]
    path.write_text("\n".join(rows))
    return path


def test_a_file_needs_no_gyro_and_unix_times_meet(tmp_path):
    mocap, start = tracked(), 1.7e9
    names = ["stamp", *(f"ref_q_{c} [1]" for c in "wxyz")]
    file = write(tmp_path / "mocap.csv", names, [mocap.time + start, mocap.ref_q])
    columns = tmp_path / "map.toml"
    columns.write_text('[columns]\nstamp = "time [s]"\n')
    read = read_reference(file, columns)
    sensor = [f"gyro_{c} [rad/s]" for c in "xyz"]
    own = read_recording(
        write(tmp_path / "log.csv", ["time [s]", *sensor], [TIME + start, log().gyro])
    )
    known = np.isfinite(reference_rate(with_reference(own, read)).rate).all(axis=1)
    assert np.isin(np.flatnonzero(known)[[0, -1]], range(399, 6001)).all()
    with pytest.raises(UserError, match="neither gyro_x.* as --reference"):
        read_recording(file, columns)
    with pytest.raises(UserError, match="no reference in it"):
        read_reference(tmp_path / "log.csv")


@pytest.mark.parametrize(
    "shift, words",
    [
        (50.0, ["do not overlap", "52 to 79.98", "value = -52,", "if both begin together"]),
        (1.7e9, ["different epochs", "mocap"]),
    ],
)
def test_clocks_without_a_time_in_common_are_refused(shift, words):
    mocap = tracked()
    late = Recording.from_arrays(name="mocap", time=mocap.time + shift, ref_q=mocap.ref_q)
    with pytest.raises(UserError) as refused:
        with_reference(log(), late)
    assert all(w in str(refused.value) for w in words), refused.value


def hand(t, seed):
    """A rate (n, 3) that rises and falls as a hand moves: 20 sines of 0.05 to 1 Hz on each axis."""
    rng = np.random.default_rng(seed)
    f, phase, size = rng.uniform(0.05, 1.0, (3, 20)), *rng.uniform(0, 6.28, (2, 3, 20))
    return (
        0.1 * np.sum(size[:, None] * np.cos(6.28 * f[:, None] * t[:, None] + phase[:, None]), -1).T
    )


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("shift", [1.7e9, 500.0, -3600.0])
def test_how_far_two_clocks_are_apart_is_seen_by_their_turns(tmp_path, seed, shift):
    """The mean of a period is told within half of it."""
    sensor = [f"gyro_{c} [rad/s]" for c in "xyz"]
    t, fine = np.arange(0.0, 90.0, 0.01), np.arange(-20.0, 100.0, 1 / 60)
    mounting = Rotation.from_rotvec([0.5, 1.0, -0.7])
    noise = 0.02 * np.random.default_rng(seed).standard_normal((len(t), 3))
    own = write(tmp_path / "log.csv", ["time [s]", *sensor], [t, hand(t, seed) + noise])
    names = ["time [s]", *(f"ref_rate_{c} [rad/s]" for c in "xyz")]
    other = write(tmp_path / "mocap.csv", names, [fine + shift, mounting.apply(hand(fine, seed))])
    with pytest.raises(UserError, match="turn alike") as refused:
        with_reference(read_recording(own), read_reference(other))
    found = float(str(refused.value).split("value = ")[1].split(",")[0])
    assert found == pytest.approx(-shift, abs=0.05)
    columns = tmp_path / "map.toml"
    columns.write_text(f'time_offset = {{value = {found}, unit = "s"}}\n')
    both = with_reference(read_recording(own), read_reference(other, columns))
    left = np.linalg.norm(both.ref_rate, axis=1) - np.linalg.norm(hand(t, seed), axis=1)
    assert np.sqrt(np.mean(left**2)) < 0.1 * np.sqrt(np.mean(hand(t, seed) ** 2))


@pytest.mark.parametrize("shift", [40.0, -55.0, 0.4])
def test_clocks_far_apart_that_have_a_time_in_common_are_said(shift):
    """What lies within seconds the loop sets itself."""
    t, fine = np.arange(0.0, 90.0, 0.01), np.arange(-20.0, 110.0, 1 / 60)
    own = Recording.from_arrays(name="log", time=t, gyro=hand(t, 7))
    mocap = Recording.from_arrays(name="mocap", time=fine + shift, ref_rate=hand(fine, 7))
    said = other_time([own, with_reference(own, mocap)])
    assert bool(said) == (abs(shift) > 2.0)
    if said:
        assert ("earlier" if shift > 0 else "later") in said
        assert float(said.split("value = ")[1].split(",")[0]) == pytest.approx(-shift, abs=0.05)


def test_logs_of_two_motions_are_not_alike():
    """Of two hands that move otherwise no offset is told: 40 pairs."""
    t, fine = np.arange(0.0, 90.0, 0.02), np.arange(1.7e9, 1.7e9 + 120.0, 1 / 60)
    for seed in range(40):
        own = Recording.from_arrays(name="log", time=t, gyro=hand(t, seed))
        other = Recording.from_arrays(
            name="mocap", time=fine, ref_rate=hand(fine - 1.7e9, seed + 100)
        )
        assert time_apart(own, other) is None


@pytest.mark.parametrize("gyro", [None, np.full((2000, 3), np.nan)])
def test_without_a_rate_no_offset_is_told(gyro):
    t = np.arange(2000) * 0.01
    own = Recording.from_arrays(name="log", time=t, accel=np.ones((2000, 3)), gyro=gyro)
    other = Recording.from_arrays(name="mocap", time=t + 1.7e9, ref_rate=hand(t, 1))
    with pytest.raises(UserError, match="if both begin together"):
        with_reference(own, other)


def test_one_reference_for_each_log_in_order():
    with pytest.raises(UserError, match="2 references for 1 logs"):
        with_references([log()], [tracked(), tracked()])
    first, second = with_references([log(), log(ref_heading=TIME)], [tracked()])
    assert first.reference is not None and second.reference is None
    with pytest.raises(UserError, match="no reference in it"):
        with_reference(log(), log())


def degrees_of(drive, noise=0.02, seed=1):
    """North and east as a latitude and a longitude about 52, 13 deg."""
    north, east = vehicle_drives.received(drive, noise, seed)
    return 52.0 + north / 111.2e3, 13.0 + east / (111.3e3 * np.cos(np.radians(52)))


@pytest.mark.parametrize("noise", [0.02, 1.5])
def test_degrees_of_latitude_under_metres_are_refused(noise):
    drive = vehicle_drives.figure_eight(4)
    gyro, accel = vehicle_drives.measured_by(drive, np.eye(3), 0.0, 4)
    north, east = degrees_of(drive, noise)
    car = Recording.from_arrays(
        name="car", time=drive.time, gyro=gyro, accel=accel, ref_north=north, ref_east=east
    )
    with pytest.raises(UserError, match="car: ref_north.*degrees of latitude.*ref_latitude"):
        reference_rate(car)


def test_places_of_which_none_is_known_have_no_course():
    t, none = np.arange(0.0, 60.0, 0.1), np.full(600, np.nan)
    course = course_of(Recording.from_arrays(time=t, ref_north=none, ref_east=none))
    assert not course.turns and np.isnan(course.rate).all()


@pytest.mark.parametrize("origin", [0.0, 3.0, 60.0])
@pytest.mark.parametrize("size, noise", [(0.3, 1e-3), (0.02, 1e-4), (0.0, 1e-4), (0.0, 1e-5)])
def test_a_track_in_a_room_does_not_look_like_degrees(origin, size, noise):
    """Hand-held, on a small table, and at rest, about an origin in the room or beside it."""
    rng, t = np.random.default_rng(8), np.arange(0.0, 120.0, 0.01)
    path = [
        origin + size * f(0.7 * t) + noise * rng.standard_normal(len(t)) for f in (np.sin, np.cos)
    ]
    assert not looks_like_degrees(
        Recording.from_arrays(time=t, ref_north=path[0], ref_east=path[1])
    )
