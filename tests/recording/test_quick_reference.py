"""References whose samples come more often than a log's rows."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, RotationSpline

from pyimu.recording.recording import Recording
from pyimu.recording.reference.file import with_reference
from pyimu.recording.reference.force import reference_force
from pyimu.recording.reference.rate import reference_rate

ROW, SECONDS, BAND = 0.01, 60.0, 5.0
TURN_NOISE, PLACE_NOISE = 1e-3, 3e-4
FINE = np.arange(-2.0, SECONDS + 2.0, 1e-3)


def angles(t):
    return np.column_stack([0.5 * np.sin(2.1 * t), 0.4 * np.cos(3.7 * t), 0.6 * np.sin(1.3 * t)])


def places(t):
    return np.column_stack([0.4 * np.sin(1.9 * t), 0.3 * np.cos(2.7 * t), 0.1 * np.sin(4.1 * t)])


CURVE = RotationSpline(FINE, Rotation.from_euler("ZYX", angles(FINE)))
TIME = np.arange(0.0, SECONDS, ROW)
RATE = CURVE(TIME, 1)


def seen_by(camera_hz):
    """A log beside a camera of so many Hz with white noise in each of its pictures."""
    rng, t = np.random.default_rng(5), np.arange(0.0, SECONDS, 1.0 / camera_hz)
    noise = Rotation.from_rotvec(TURN_NOISE * rng.standard_normal((len(t), 3)))
    q = (CURVE(t) * noise).as_quat(scalar_first=True)
    at = places(t) + PLACE_NOISE * rng.standard_normal((len(t), 3))
    east, north, up = at.T
    camera = Recording.from_arrays(
        "camera", time=t, ref_q=q, ref_east=east, ref_north=north, ref_up=up
    )
    log = Recording.from_arrays("log", time=TIME, gyro=RATE, accel=force())
    return with_reference(log, camera)


def force():
    moved = -(np.array([1.9, 2.7, 4.1]) ** 2) * places(TIME) + [0.0, 0.0, 9.80665]
    return CURVE(TIME).inv().apply(moved)


def below_band(error):
    """Root mean square in the band, of the rows that are known, away from the ends."""
    known = np.isfinite(error).all(axis=1) & (TIME > 1.0) & (TIME < SECONDS - 1.0)
    spectrum = np.fft.rfft(np.where(known[:, None], error, 0.0), axis=0)
    spectrum[np.fft.rfftfreq(len(TIME), ROW) > BAND] = 0.0
    return np.fft.irfft(spectrum, len(TIME), axis=0)[known].std()


def error_of(camera_hz):
    log = seen_by(camera_hz)
    found = reference_force(log)
    return below_band(reference_rate(log).rate - RATE), below_band(found.value - force())


@pytest.mark.parametrize("camera_hz", [125.0, 190.0, 240.0, 360.0])
def test_a_quicker_camera_shows_no_less(camera_hz):
    """Its noise above what rows can show came down on the motion: 60 times of it at 240 Hz. More
    pictures a second of the same noise show the motion better, by the root of their number; 600
    values of the band scatter by 3 %."""
    slow, quick = error_of(100.0), error_of(camera_hz)
    better = np.sqrt(100.0 / camera_hz)
    for one, other in zip(quick, slow, strict=True):
        assert one < 1.15 * better * other


@pytest.mark.parametrize("kind", ["attitude", "rate"])
def test_a_slower_reference_is_right_up_to_a_quarter_of_its_rate(kind):
    """A turn to and fro at 4 Hz, seen 20 times a second: a cubic spline damped it by 1.7 %."""
    t, turn = np.arange(0.0, SECONDS, 0.05), lambda at: 0.2 * np.sin(2 * np.pi * 4.0 * at)
    slope = 0.2 * 2 * np.pi * 4.0 * np.cos(2 * np.pi * 4.0 * TIME)
    z = np.array([0.0, 0.0, 1.0])
    if kind == "attitude":
        q = Rotation.from_rotvec(np.outer(turn(t), z)).as_quat(scalar_first=True)
        camera = Recording.from_arrays("camera", time=t, ref_q=q)
    else:
        seen = 0.2 * 2 * np.pi * 4.0 * np.cos(2 * np.pi * 4.0 * t)
        camera = Recording.from_arrays("camera", time=t, ref_rate=np.outer(seen, z))
    log = Recording.from_arrays("log", time=TIME, gyro=np.outer(slope, z))
    found = reference_rate(with_reference(log, camera)).rate[:, 2]
    inner = np.isfinite(found) & (TIME > 2.0) & (TIME < SECONDS - 2.0)
    assert found[inner] @ slope[inner] / (slope[inner] @ slope[inner]) == pytest.approx(1, abs=1e-3)
    assert np.abs(found - slope)[inner].max() < 2e-3 * np.abs(slope).max()
