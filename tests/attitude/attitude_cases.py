"""Bodies whose motion is known, and the attitude filter's inputs, parameters and outputs by name.

The world is made by numpy and scipy alone.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation
from turns import turned

from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

GRAVITY = 9.80665
H = 0.01
EARTH = 7.292115e-5
N, K, N_ACCEL = 1e-3, 2e-4, 1e-2
WHITE = {"accel_std": 0.0, "accel_correlation_time": 0.0, "rest_time": 0.0}
"""Settings under which the filter's model of the specific force is white noise alone, and no rest
is looked for."""


def part(n: float = N, k: float = K, n_accel: float = N_ACCEL, **more) -> Part:
    """A part with white noise and a random walk, and ``more`` effects of its gyro."""
    gyro = Sensor("gyro", {"angle_random_walk": {"N": n}, "rate_random_walk": {"K": k}, **more})
    return Part("test", 1 / H, gyro, Sensor("accel", {"angle_random_walk": {"N": n_accel}}))


def parameters(block, **values) -> np.ndarray:
    """Start values of the block's parameters with some replaced, scalars or vectors by name."""
    at = {v.name: i for i, v in enumerate(block.parameters)}
    p = block.start.copy()
    for name, value in values.items():
        names = [name] if np.ndim(value) == 0 else [f"{name}[{i + 1}]" for i in range(len(value))]
        p[[at[n] for n in names]] = value
    return p


def inputs(n: int, **values) -> np.ndarray:
    """Rows of the block's inputs (n, 18), level and at rest, with some replaced."""
    u = np.zeros((n, 18))
    u[:, 5], u[:, 6] = GRAVITY, 25.0
    columns = {
        "gyro": slice(0, 3),
        "accel": slice(3, 6),
        "temperature": 6,
        "heading": 7,
        "heading_variance": 8,
        "heading_valid": 9,
        "heading_age": 10,
        "stationary": 11,
        "speed": 12,
        "speed_variance": 13,
        "speed_valid": 14,
        "mag": slice(15, 18),
    }
    for name, value in values.items():
        u[:, columns[name]] = value
    return u


def output(block, y: np.ndarray, name: str) -> np.ndarray:
    """A named output of rows y (n, ny): (n,) or (n, size)."""
    names = [v.name for v in block.outputs]
    columns = [i for i, v in enumerate(names) if v == name or v.startswith(f"{name}[")]
    return y[:, columns[0]] if names[columns[0]] == name else y[:, columns]


@dataclass(frozen=True)
class Drive:
    """A motion, a row for each period.

    ``rate`` (n, 3) rad/s against the world, over the period that ends with its row; ``attitude``
    (n) and ``force`` (n, 3) m/s^2 after it; ``inertial`` (n, 3) rad/s against inertial space.
    """

    rate: np.ndarray
    attitude: Rotation
    force: np.ndarray
    inertial: np.ndarray


def drive(rate: np.ndarray, start: Rotation | None = None, latitude: float | None = None) -> Drive:
    """A body that turns in place by ``rate`` (n, 3) rad/s, each row held for one period."""
    before_and_after = turned(Rotation.from_rotvec(rate * H), start)
    before, attitude = before_and_after[:-1], before_and_after[1:]
    force = attitude.apply([0, 0, GRAVITY], inverse=True)
    earth = (
        np.zeros(3)
        if latitude is None
        else EARTH * np.array([0, np.cos(latitude), np.sin(latitude)])
    )
    return Drive(rate, attitude, force, rate + before.apply(earth, inverse=True))


def rover_rate(n: int, still: int = 0) -> np.ndarray:
    """A gentle drive: turns, pitching over boulders; the first ``still`` rows at rest."""
    t = np.arange(n)[:, None] * H
    rate = np.array([0.2, 0.25, 0.3]) * np.sin(
        np.array([0.9, 0.7, 0.3]) * t + np.array([0.0, 1.0, 2.0])
    )
    rate[:still] = 0
    return rate


def measured(
    world: Drive, rng: np.random.Generator, bias: np.ndarray, n_accel: float = N_ACCEL
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gyro, accel and the true bias (n, 3) of one noise draw."""
    shape = world.rate.shape
    walk = bias + K * np.sqrt(H) * np.cumsum(rng.standard_normal(shape), axis=0)
    gyro = world.inertial + walk + N / np.sqrt(H) * rng.standard_normal(shape)
    return gyro, world.force + n_accel / np.sqrt(H) * rng.standard_normal(shape), walk


def error(q: np.ndarray, truth: Rotation) -> np.ndarray:
    """Attitude error (n, 3) rad in body axes: truth = q exp(error)."""
    return (Rotation.from_quat(q, scalar_first=True).inv() * truth).as_rotvec()


def attitude_after(rate: np.ndarray) -> Rotation:
    """Attitude (n) after turns by ``rate`` (n, 3) rad/s, each for a period, by products of pairs:
    as exact as one by one, and fast.
    """
    turns = Rotation.from_rotvec(rate * H).as_quat(scalar_first=True)
    w, v = turns[:, 0].copy(), turns[:, 1:].copy()
    step = 1
    while step < len(w):
        a, b, p, q = w[:-step].copy(), v[:-step].copy(), w[step:].copy(), v[step:].copy()
        w[step:], v[step:] = (
            a * p - np.sum(b * q, axis=1),
            a[:, None] * q + p[:, None] * b + np.cross(b, q),
        )
        step *= 2
    return Rotation.from_quat(np.column_stack([w, v]), scalar_first=True)


def covariance_of(state: np.ndarray) -> np.ndarray:
    """The covariance (6, 6) in a state of the filter."""
    p = np.zeros((6, 6))
    p[np.triu_indices(6)] = state[7:28]
    return p + np.triu(p, 1).T


def eventful_drive(n: int, seed: int = 0):
    """A drive with shocks, pushes and rests: gyro and accel (n, 3), heading (n,), in which rows
    there is a heading, and in which the body rests.
    """
    rng, t = np.random.default_rng(seed), H * np.arange(n)
    still = (t % 300) < 40
    rate = rover_rate(n) * ~still[:, None]
    world = attitude_after(rate)
    gyro = rate + [0.01, -0.01, 0.005] + N / np.sqrt(H) * rng.standard_normal((n, 3))
    accel = world.apply([0, 0, GRAVITY], inverse=True) + N_ACCEL / np.sqrt(H) * rng.standard_normal(
        (n, 3)
    )
    shaken = (~still & (t % 60 < 30))[:, None]
    accel += shaken * np.sin(20 * t)[:, None] * [1.5, -1.0, 0.7]
    heading = world.as_euler("ZYX")[:, 0] + 0.02 * rng.standard_normal(n)
    return gyro, accel, heading, rng.random(n) < 0.01, still


def eventful_recording(n: int = 6000, **more) -> Recording:
    """The same as a recording."""
    gyro, accel, heading, told, still = eventful_drive(n)
    std = np.where(told, 0.02, np.nan)
    return Recording.from_arrays(
        time=H * np.arange(n),
        gyro=gyro,
        accel=accel,
        heading=np.where(told, heading, np.nan),
        heading_std=std,
        stationary=still.astype(float),
        **more,
    )
