"""The loop with a reference in a file of its own, on a clock and at a rate of its own."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.identification.errors import by_attitude
from pyimu.recording.recording import Recording

H, NOISE = 0.005, 2e-3
MOUNTING = Rotation.from_euler("xyz", [20, -35, 100], degrees=True)


def attitude(seed, seconds):
    """An attitude at any time: sines up to 1.5 Hz of the rotation vector."""
    rng = np.random.default_rng(seed)
    frequency, phase = rng.uniform(0.1, 1.5, (3, 5)), rng.uniform(0, 2 * np.pi, (3, 5))
    t = np.arange(-5.0, seconds + 5.0, 0.01)
    turns = np.sum(np.sin(2 * np.pi * frequency * t[:, None, None] + phase), axis=2)
    return RotationSpline(t, Rotation.from_rotvec(0.15 * turns))


def pair(seed, late, seconds=100.0):
    """A log whose gyro and accelerometer are ``late`` s, and the attitude of 60 Hz that saw it."""
    rng, seen = np.random.default_rng(seed), attitude(seed, seconds)
    t, slow = np.arange(0.0, seconds, H), np.arange(0.0, seconds, 1 / 60)
    body = seen(t - late)
    gyro = MOUNTING.apply(seen(t - late, 1)) + NOISE * rng.standard_normal((len(t), 3))
    force = MOUNTING.apply(body.inv().apply([0.0, 0.0, 9.80665]))
    log = Recording.from_arrays(
        name=f"log{seed}", time=t, gyro=gyro + [0.01, -0.02, 0.0], accel=force
    )
    optical = Rotation.from_rotvec(1e-4 * rng.standard_normal((len(slow), 3))) * seen(slow)
    mocap = Recording.from_arrays(name="mocap", time=slow, ref_q=optical.as_quat(scalar_first=True))
    return log, mocap


@pytest.mark.long
@pytest.mark.parametrize("late", [1.37, -0.8])
def test_the_clock_of_another_file_is_found_and_nothing_is_blamed(late):
    """Joined to the sensor's 200 Hz by straight lines, the 60 Hz would look like coning."""
    log, mocap = pair(1, late)
    closed = pyimu.close(log, reference=mocap)
    assert not [a for a in closed.added if a.sensor == "gyro"], closed.report()
    reference = closed.recordings[0].log_state["gyro"]["reference"]
    assert reference["clock"]["late"] == pytest.approx(late, abs=5e-4)
    assert reference["band_hz"] <= 0.25 * 60
    turn = np.array(closed.recordings[0].log_state["gyro"]["rotation"])
    assert Rotation.from_matrix(turn @ MOUNTING.as_matrix().T).magnitude() < 0.01
    # The clock is not in the attitude's error: a lag of 0.8 s alone would make it some 20 deg.
    assert np.degrees(closed.attitude[1]) < 3.0


@pytest.mark.long
def test_each_log_has_its_own_reference(tmp_path):
    (a, seen_a), (b, seen_b) = pair(2, 0.4), pair(3, -0.2, 60.0)
    file = seen_b.write(tmp_path / "seen.csv")
    closed = pyimu.close(a, holdout=b, reference=[seen_a, file])
    clocks = [r.log_state["gyro"]["reference"]["clock"]["late"] for r in closed.recordings]
    np.testing.assert_allclose(clocks, [0.4, -0.2], atol=5e-4)
    with pytest.raises(pyimu.UserError, match="3 references for 2 logs"):
        pyimu.close(a, holdout=b, reference=[seen_a, file, file])


@pytest.mark.long
def test_the_attitude_is_compared_with_the_part_as_its_file_has_it(monkeypatch):
    """A walk that the log does not show is left out of the file, so the filter goes without it."""
    parts = []

    def attitudes(part, *rest):
        parts.append(part)
        return original(part, *rest)

    original = by_attitude.attitudes
    monkeypatch.setattr(by_attitude, "attitudes", attitudes)
    log, mocap = pair(4, 0.0, 60.0)
    closed = pyimu.close(log, reference=mocap)
    assert closed.attitude and parts
    assert "rate_random_walk" not in closed.after.gyro.values
    for part in parts:
        assert "rate_random_walk" not in part.gyro.values


@pytest.mark.parametrize("size", [1, 8])
def test_what_samples_waited_to_be_read_is_no_lag_of_the_sensor(size):
    """The same lag of a sensor whose samples are read one by one may be its own; beside a reference
    on another clock one log does not tell.
    """
    log, mocap = pair(4, 4e-3, 40.0)
    row = np.arange(len(log.time))
    burst, within = row // size, row % size
    read = H * (burst * size + size - 1) + 1e-4 * within
    log = Recording.from_arrays(
        name="log", time=read if size > 1 else log.time, gyro=log.gyro, accel=log.accel
    )
    closed = pyimu.close(log, reference=mocap)
    assert not [a for a in closed.added if a.sensor == "gyro"]
    clock = closed.recordings[0].log_state["gyro"]["reference"]["clock"]
    assert clock["taken_out"] and clock["late"] == pytest.approx(4e-3, abs=5e-4)
    assert closed.references[0]["or_sensor"] == (size == 1)
    assert ("a single log does not tell" in closed.report()) == (size == 1)
