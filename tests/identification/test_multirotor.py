"""A multirotor beside cameras: motors shake what it hardly feels, for it leans into its way."""

import numpy as np
from scipy.spatial.transform import Rotation, RotationSpline

import pyimu
from pyimu.identification.fit.sample_noise import band_noise, rest_noise
from pyimu.identification.fit.trials import gyro_trial
from pyimu.recording.recording import Recording

H, GRAVITY, LATE = 0.005, 9.8, 1.7
TIME = np.arange(0.0, 150.0, H)
MOTORS, REST = 73.0, 10.0
"""Hz, and s before they run."""

NOISE = {"gyro": 1e-3, "accel": 0.02}
BIAS = np.array([0.1, -0.15, 0.2])


def ways(seed):
    """Positions and accelerations (n, 3), from rest on."""
    rng = np.random.default_rng(seed)
    turn, phase = 2 * np.pi * rng.uniform(0.05, 0.25, (8, 3)), rng.uniform(0, 2 * np.pi, (8, 3))
    size, since = [0.6, 0.6, 0.2] / (1 + turn**2), np.maximum(TIME - REST, 0.0)[:, None]
    place = sum(
        s * np.sin(w * since + p) for s, w, p in zip(size, turn, phase, strict=True)
    ) * np.tanh((0.1 * since) ** 3)
    push = np.gradient(np.gradient(place, H, axis=0), H, axis=0)
    return place, push


def flight(seed):
    """A log of it, whose gyro and accelerometer have nothing but biases and noise, and whose
    reference is on a clock of its own.
    """
    rng = np.random.default_rng(seed)
    place, push = ways(seed)
    up = push + [0.0, 0.0, GRAVITY]
    up /= np.linalg.norm(up, axis=1)[:, None]
    side = np.cross(up, [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side, axis=1)[:, None]
    axes = Rotation.from_matrix(np.stack([np.cross(side, up), side, up], axis=2))
    attitude = RotationSpline(TIME[::4], axes[::4])
    true = attitude(TIME)
    motors = 2 * np.pi * np.cumsum(MOTORS + rng.standard_normal(len(TIME))) * H
    shaken = np.sin(motors[:, None] + [0.0, 1.0, 2.0]) * (TIME > REST)[:, None]

    def noisy(values, std):
        return values + std * rng.standard_normal(values.shape)

    seen = true * Rotation.from_rotvec(noisy(np.zeros_like(place), 5e-4))
    reference = Recording.from_arrays(
        name="cameras",
        time=TIME + LATE,
        ref_q=seen.as_quat(scalar_first=True),
        **dict(zip(("ref_east", "ref_north", "ref_up"), noisy(place, 2e-4).T, strict=True)),
    )
    log = Recording.from_arrays(
        name="flight",
        time=TIME,
        gyro=noisy(attitude(TIME, 1) + 0.05 * shaken, NOISE["gyro"]),
        accel=noisy(true.inv().apply(push + [0, 0, GRAVITY]) + 3 * shaken + BIAS, NOISE["accel"]),
    )
    return log, reference


def test_an_accelerometer_that_motors_shake_is_examined_on_the_clock_that_the_gyro_shows():
    """Their vibration is far above the band of the positions, and hid the motion in it: the
    accelerometer was compared with a force 1.7 s away, or not at all; and its floor was that of
    white noise as large, 25 times what is left. What the gyro feels with it is no sensitivity.
    """
    log, reference = flight(1)
    closed = pyimu.close(log, reference=reference)
    assert not closed.added and not closed.not_examined, closed.report()
    assert "gyro and accelerometer shake together at" in closed.reason, closed.report()
    for kind, errors in closed.errors.items():
        assert 0.5 < errors.after.total / errors.floor.total < 1.5, (kind, closed.report())
    (bias,) = [e for e in closed.estimated if (e.sensor, e.effect) == ("accel", "turn_on_bias")]
    assert np.all(np.abs(bias.value - BIAS) < 4 * bias.std), (bias.value, bias.std)


def test_what_motors_shake_is_no_noise_of_the_band():
    """Of a gyro's white noise as much is left in its band as it has of it; of the motors' line
    nothing, which is 35 times as large. A mean over so many rows has a tenth of an error.
    """
    log, reference = flight(2)
    trial = gyro_trial(
        pyimu.Recording.from_arrays(
            name="flight", time=log.time, gyro=log.gyro, accel=log.accel, ref_q=reference.ref_q
        )
    )
    assert np.all(rest_noise(trial) > 10 * NOISE["gyro"])
    assert np.all(np.abs(band_noise(trial) / NOISE["gyro"] - 1) < 0.5), band_noise(trial)
