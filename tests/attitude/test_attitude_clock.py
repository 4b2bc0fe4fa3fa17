"""A gyro whose clock is off: its samples are of other instants than their rows say, for hours."""

import numpy as np
import pytest
from attitude_cases import GRAVITY
from scipy.spatial.transform import Rotation

from pyimu.attitude import run
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

H, HOURS = 0.02, 2
SWING, PULSATION = 0.5, 2 * np.pi * 0.2
"""rad, rad/s: of a body that swings about one axis."""

LEVEL = [1, 0, 0, 0]
EVEN_TURN = SWING * PULSATION**2 * H**2 / 8
"""rad; by so much at most an angle departs from its chord over a period."""


def angle(t):
    return SWING * np.sin(PULSATION * t)


def swinging(axis: str, skew: float, hours: float = HOURS) -> tuple[Recording, Rotation]:
    """What error-free sensors record whose clock is off by ``skew``, and the truth at the rows."""
    time = H * np.arange(1, round(hours * 3600 / H) + 1)
    taken = time * (1 + skew)
    turned = angle(taken) - angle(taken - H * (1 + skew))
    gyro = np.zeros((len(time), 3))
    gyro[:, "xyz".index(axis)] = turned / (H * (1 + skew))
    up = Rotation.from_euler(axis, angle(taken)[:, None]).inv().apply([0, 0, GRAVITY])
    headings = {}
    if axis == "z":
        known = np.arange(len(time)) % 50 == 0
        heading = np.where(known, angle(time), np.nan)
        headings = {"heading": heading, "heading_std": np.where(known, 1e-3, np.nan)}
    recording = Recording("swing", time=time, gyro=gyro, accel=up, **headings)
    return recording, Rotation.from_euler(axis, angle(time)[:, None])


def part(skew: float) -> Part:
    clock = {"clock_skew": {"eps": skew}}
    gyro = Sensor("gyro", {"angle_random_walk": {"N": 1e-5}, **clock})
    return Part("test", 1 / H, gyro, Sensor("accel", {"angle_random_walk": {"N": 1e-3}, **clock}))


def off(result, truth: Rotation) -> np.ndarray:
    """Size of the attitude error at each row, rad."""
    return (Rotation.from_quat(result.q, scalar_first=True).inv() * truth).magnitude()


CASES = [("x", 1e-4), ("x", -4e-5), ("x", -1e-4), ("z", 1e-4), ("z", -4e-5), ("z", -0.01)]


@pytest.fixture(scope="module")
def without_skew():
    """Largest error of the filter itself, by the axis of the swing."""
    logs = {axis: swinging(axis, 0.0, 0.2) for axis in "xz"}
    return {a: off(run(log, part(0.0), q0=LEVEL), truth).max() for a, (log, truth) in logs.items()}


@pytest.mark.long
@pytest.mark.parametrize("axis, skew", CASES)
def test_a_clock_that_is_off_is_undone_for_hours(axis, skew, without_skew):
    """To what the filter errs by without it, the turn between two samples, and for a heading, which
    goes to the nearest sample, the turn in half a period.

    By the inverse of the effect's equation -40 ppm made 39,822 deg within 199 s. After the last
    instant of a slow clock there is no sample, and the last turn goes on.
    """
    recording, truth = swinging(axis, skew)
    result = run(recording, part(skew), q0=LEVEL)
    sampled = recording.time < recording.time[-1] * (1 + skew)
    moved = SWING * PULSATION * H / 2 if axis == "z" else 0.0
    assert off(result, truth)[sampled].max() < 1.1 * without_skew[axis] + EVEN_TURN + moved
    assert np.isfinite(result.q).all()


@pytest.mark.long
def test_a_clock_that_is_not_declared_is_seen():
    """The last test would fail on a filter that took the rows for the instants."""
    recording, truth = swinging("z", -1e-4)
    assert off(run(recording, part(0.0), q0=LEVEL), truth).max() > 0.3
