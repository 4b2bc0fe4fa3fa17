"""What an arm adds to the force, by vector products."""

import numpy as np

from pyimu.identification.fit.place import GRAVITY, Place
from pyimu.model.signals import COLUMNS, N_INPUT
from pyimu.recording.reference.force import arm_forces


def turning() -> tuple[np.ndarray, np.ndarray]:
    time = np.arange(200) / 100.0
    return time, np.random.default_rng(2).standard_normal((200, 3))


def test_force_of_an_arm_is_that_of_its_vector_products():
    time, arm = np.arange(60) / 10.0, np.array([0.3, -0.2, 0.5])
    # Of a cubic the slope by four neighbours is exact.
    cubics = np.array([[0.5, -0.2, 0.1, -0.01], [-1.0, 0.3, 0.0, 0.02], [0.2, 0.1, -0.2, 0.01]])
    rate = np.array([np.polyval(c[::-1], time) for c in cubics]).T
    slope = np.array([np.polyval((c[1:] * [1, 2, 3])[::-1], time) for c in cubics]).T
    expected = np.cross(slope, arm) + np.cross(rate, np.cross(rate, arm))
    found = arm_forces(rate, time) @ arm
    np.testing.assert_allclose(found[2:-2], expected[2:-2], rtol=1e-9, atol=1e-9)


def test_slopes_are_those_of_the_forces_that_are_to_be_found():
    time, rate = turning()
    u = np.zeros((len(time), N_INPUT))
    u[:, COLUMNS["rate"]] = rate
    place = Place.of(u, time)
    assert place.unknown == tuple(range(GRAVITY))
    expected = np.gradient(place.forces, time, axis=2)
    np.testing.assert_allclose(place.slopes, expected)
    assert not place.forces[GRAVITY:].any()
