"""Headings of bodies that roll and pitch while they turn."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.recording.recording import Recording
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.reference.rocking import rate_about_z

FINE, SECONDS = 1000, 240.0
WHITE = np.radians(0.02)


def boat(roll: float, pitch: float, seed: int = 3) -> tuple[Recording, np.ndarray]:
    """A boat that rocks by so many deg, root mean square, against a heading at 10 Hz, and its rate
    about z. All of it is made at 1000 Hz.
    """
    rng, count = np.random.default_rng(seed), int(FINE * SECONDS)

    def waves(width):
        made = gaussian_filter1d(rng.standard_normal(count), width * FINE)
        return made / made.std()

    yaw = np.cumsum(np.radians(4.0) * waves(4.0)) / FINE
    turned = np.column_stack([yaw, np.radians(pitch) * waves(0.4), np.radians(roll) * waves(0.4)])
    q = Rotation.from_euler("ZYX", turned)
    rate = (q[:-1].inv() * q[1:]).as_rotvec() * FINE
    at, far = slice(0, count - 1, FINE // 50), slice(0, count - 1, FINE // 10)
    force = q[:-1][at].inv().apply([0.0, 0.0, 9.80665])
    gyro = rate[at] + WHITE * rng.standard_normal(force.shape)
    noise = np.radians(0.1) * rng.standard_normal(len(yaw[far]))
    time = np.arange(count - 1) / FINE
    own = Recording.from_arrays("heading", time=time[far], ref_heading=yaw[far] + noise)
    log = Recording.from_arrays(
        "boat",
        time=time[at],
        gyro=gyro,
        accel=force + 0.02 * rng.standard_normal(force.shape),
    )
    return pyimu.recording.reference.file.with_reference(log, own), rate[at][:, 2]


def test_a_heading_becomes_the_rate_about_the_axis_that_rocks():
    """What is left is the noise of the heading, 0.1 deg ten times a second."""
    log, z = boat(4.0, 2.0)
    yaw = np.unwrap(log.reference.ref_heading)
    plain = np.interp(log.time, log.reference.time, gaussian_filter1d(np.gradient(yaw) * 10.0, 5.0))
    said, found = rate_about_z(log, plain)
    assert found.kind == "rocks" and 0.1 < found.detail["angle"] < 0.4
    inside, rows = slice(500, -500), 50
    left = [np.convolve(v - z, np.ones(rows) / rows, "same")[inside] for v in (plain, said)]
    assert left[1].std() < 0.7 * left[0].std()


@pytest.mark.parametrize("roll, pitch", [(4.0, 2.0), (0.0, 0.0)])
def test_a_clean_gyro_beside_a_heading_is_not_blamed_for_the_waves(roll, pitch):
    """It was a lag of 71 to 162 ms, which made the held-out rows worse."""
    log, _ = boat(roll, pitch)
    closed = pyimu.close(log)
    assert not closed.added and closed.verdict in ("clean", "undecidable"), closed.report()
    assert bool(roll) == any(f.kind == "rocks" for f in closed.quality)
    assert closed.heading[1] < np.radians(0.15)


def test_a_vehicle_that_does_not_rock_keeps_its_heading():
    log, _ = boat(0.0, 0.0)
    made = reference_rate(log)
    assert not [f for f in made.findings if f.kind == "rocks"]
