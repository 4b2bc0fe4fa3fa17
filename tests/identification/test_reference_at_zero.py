"""Noise of a force that a centrifuge or a shaker says, about axes that are not moved."""

import numpy as np

import pyimu
from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY as G

H = 0.01


def on_an_arm(seed: int, bend: float = 0.0, asymmetry: float = 0.0) -> Recording:
    """One axis after another at five levels of either sign, 12 s each, in m/s^2; its force is known
    to 0.08 mg in each row, the sensor's noise is 1 mg.
    """
    rng = np.random.default_rng(seed)
    u = np.arange(0.0, 12.0, H)
    ramp = np.clip(u / 2, 0, 1) * np.clip((12 - u) / 2, 0, 1)
    force = np.zeros((15 * len(u), 3))
    force[:, 2] = G
    for k in range(15):
        level = (1 + k % 5) * G * (-1) ** k
        force[k * len(u) : (k + 1) * len(u), k // 5] += level * ramp
    noise = 1e-3 * G * rng.standard_normal(force.shape)
    accel = force + bend / G * force**2 + asymmetry / 2 * np.sign(force) + noise + 0.02
    told = force + 8e-5 * G * rng.standard_normal(force.shape)
    time = H * np.arange(len(force))
    return Recording.from_arrays("arm", time=time, accel=accel, ref_force=told)


def test_the_sign_of_a_references_noise_is_no_bias_of_the_sensor():
    """The force has 0.08 mg of noise about axes that are not loaded, whose sign is that of a bias
    asymmetry of -0.13 mg. Beside this log the noise is known; of one of 15 min at seven levels it
    was not, and the asymmetry was added.
    """
    closed = pyimu.close(on_an_arm(4, bend=3e-4))
    assert [a.effect for a in closed.added] == ["scale_factor_nonlinearity"], closed.report()


def test_a_bias_that_has_the_sign_of_the_force_is_found():
    closed = pyimu.close(on_an_arm(5, asymmetry=5e-3))
    assert "bias_asymmetry" in [a.effect for a in closed.added], closed.report()
