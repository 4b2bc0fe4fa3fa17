"""Recordings with one undeclared effect, or none, made by plain numpy: no equation here comes from
the package.

``lambda_of`` gives how many times detectable an effect is: the norm of what it changes, whitened by
the innovations filter of white noise plus random walk and freed of everything that the baseline
explains, in noise sigmas.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

G0 = 9.80665
N_GYRO = np.deg2rad(np.array([0.20764, 0.23858, 0.20489])) / 60
K_GYRO = np.deg2rad(np.array([32.8, 49.6, 64.2])) / 3600 / 60
N_ACCEL = np.array([60e-6, 55e-6, 65e-6]) * G0
K_ACCEL = np.array([4e-6, 3e-6, 5e-6]) * G0


@dataclass
class World:
    """True motion of a log: time (n,), rate and specific force (n, 3), temperature (n,)."""

    time: np.ndarray
    rate: np.ndarray
    force: np.ndarray
    temperature: np.ndarray

    @property
    def h(self) -> float:
        return self.time[1] - self.time[0]


def drive(minutes: float = 6.0, rate_hz: float = 50.0, seed: int = 0) -> World:
    """A vehicle that turns, tilts and shakes on three axes while the part warms up and cools down
    again.
    """
    rng = np.random.default_rng(seed)
    t = np.arange(0, minutes * 60, 1 / rate_hz)
    rate = np.zeros((len(t), 3))
    force = np.zeros((len(t), 3))
    for i in range(3):
        for f in rng.uniform(0.05, 2.5, 6):
            rate[:, i] += rng.uniform(0.05, 0.35) * np.sin(2 * np.pi * f * t + rng.uniform(0, 6.28))
            force[:, i] += rng.uniform(0.2, 1.2) * np.sin(
                2 * np.pi * f * 0.7 * t + rng.uniform(0, 6.28)
            )
    # Stops of a quarter of a minute, eased into over a second: a step of rate has no delay that
    # samples could show.
    busy = (
        1 / (1 + np.exp(-30 * (np.sin(2 * np.pi * t / 60 + rng.uniform(0, 6.28)) + 0.6)))[:, None]
    )
    tilt = 0.4 * np.sin(2 * np.pi * t / rng.uniform(45, 70))[:, None] * np.array([1.0, 0.6, 0.0])
    force = force * busy + G0 * np.column_stack(
        [np.sin(tilt[:, 0]), np.sin(tilt[:, 1]), np.cos(tilt[:, 0]) * np.cos(tilt[:, 1])]
    )
    period = rng.uniform(0.28, 0.4) * t[-1]
    temperature = 28.0 + 7.0 * np.sin(2 * np.pi * t / period) + 3.0 * t / t[-1]
    return World(t, rate * busy, force, temperature)


def noise(world: World, n: np.ndarray, k: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """White noise plus random walk, (n, 3)."""
    shape = (len(world.time), 3)
    white = n / np.sqrt(world.h) * rng.standard_normal(shape)
    return white + np.cumsum(k * np.sqrt(world.h) * rng.standard_normal(shape), axis=0)


def noise_only(**gyro_effects) -> Part:
    """A part that declares its noise, and of the rest what is given."""
    gyro = Sensor(
        "gyro",
        {"angle_random_walk": {"N": N_GYRO}, "rate_random_walk": {"K": K_GYRO}, **gyro_effects},
    )
    return Part(
        "noise",
        50.0,
        gyro,
        Sensor("accel", {"angle_random_walk": {"N": N_ACCEL}, "rate_random_walk": {"K": K_ACCEL}}),
    )


def recording(
    world: World,
    gyro_change=None,
    accel_change=None,
    seed: int = 1,
    name: str = "log",
    kinds=("gyro", "accel"),
) -> Recording:
    """The log of a part with white noise, random walk, turn-on bias and the changes
    ``(clean (n, 3)) -> (n, 3)`` given; of sensors it has those of ``kinds``.
    """
    rng = np.random.default_rng(seed)
    bias_g, bias_a = 0.003 * rng.standard_normal(3), 0.05 * rng.standard_normal(3)
    gyro = measured(world.rate, gyro_change, bias_g + noise(world, N_GYRO, K_GYRO, rng))
    accel = measured(world.force, accel_change, bias_a + noise(world, N_ACCEL, K_ACCEL, rng))
    return Recording.from_arrays(
        name=name,
        time=world.time,
        gyro=gyro if "gyro" in kinds else None,
        accel=accel if "accel" in kinds else None,
        temperature=world.temperature,
        ref_rate=world.rate,
        ref_force=world.force,
    )


def measured(x: np.ndarray, change, disturbance: np.ndarray) -> np.ndarray:
    """Effects of the input come before the noise, limits and rounding after it (``change.last`` is
    True).
    """
    if change is None:
        return x + disturbance
    return change(x + disturbance) if getattr(change, "last", False) else change(x) + disturbance


def lambda_of(world: World, kind: str, change, structure: bool = False) -> float:
    """How many times detectable ``change`` is over a bias, and with ``structure`` over scale factor
    and misalignment too.
    """
    x = world.rate if kind == "gyro" else world.force
    return _norm(change(x) - x, _explained(world, kind, structure))


def _norm(difference: np.ndarray, explained: list) -> float:
    """Norm of a difference (n, 3), whitened and freed of what is explained."""
    total = 0.0
    for i, (whiten, basis) in enumerate(explained):
        target = whiten(difference[:, i])
        left = target - basis @ (basis.T @ target)
        total += left @ left
    return float(np.sqrt(total))


def _explained(world: World, kind: str, structure: bool) -> list:
    """For each axis the innovations filter and an orthonormal basis of what the baseline
    explains.
    """
    x, n, k = (world.rate, N_GYRO, K_GYRO) if kind == "gyro" else (world.force, N_ACCEL, K_ACCEL)
    base = np.column_stack([np.ones(len(x)), *([x] if structure else [])])
    out = []
    for r, q in zip(n**2 / world.h, k**2 * world.h):
        p = (q + np.sqrt(q * q + 4 * q * r)) / 2

        def whiten(v, r=r, p=p):
            return lfilter([1, -1], [1, -r / (p + r)], v, axis=0) / np.sqrt(p + r)

        out.append((whiten, np.linalg.qr(whiten(base))[0]))
    return out


def last(function):
    function.last = True
    return function


SPREAD = np.array([1.0, -0.7, 0.5])
"""Of an effect's size over the axes."""


def changes(world: World, kind: str) -> dict:
    """One undeclared effect each: name in the catalogue -> size -> change of the clean signal."""
    own = {"accel": _of_accelerometers, "gyro": _of_gyros}
    return _of_any_sensor(world) | _of_temperature(world) | own[kind](world)


def _of_any_sensor(world: World) -> dict:
    """What the output depends on by itself."""
    h, ones = world.h, np.array([1.0, -0.5, 0.3])
    return {
        "scale_factor": lambda s: lambda v: v * (1 + s * SPREAD),
        "misalignment": lambda s: lambda v: v + s * np.roll(v, 1, axis=1) * ones,
        "scale_factor_asymmetry": lambda s: lambda v: v + s * SPREAD * np.abs(v),
        "scale_factor_nonlinearity": lambda s: lambda v: v + s * SPREAD * v**2,
        "scale_factor_cubic": lambda s: lambda v: v + s * SPREAD * v**3,
        "time_delay": lambda s: lambda v: _filtered(v, h, lambda w: np.exp(-1j * w * s)),
        "lag": lambda s: lambda v: _filtered(v, h, _second_order(1.0 / s)),
        "saturation": lambda s: last(lambda v: np.clip(v, -s, s)),
        "quantization": lambda s: last(lambda v: np.round(v / s) * s),
    }


def _of_temperature(world: World) -> dict:
    warmer = (world.temperature - 25)[:, None]
    rising = np.gradient(world.temperature, world.h)[:, None]
    return {
        "thermal_bias": lambda s: lambda v: v + s * SPREAD * warmer,
        "thermal_bias_quadratic": lambda s: lambda v: v + s * SPREAD * warmer**2,
        "thermal_bias_cubic": lambda s: lambda v: v + s * SPREAD * warmer**3,
        "thermal_scale_factor": lambda s: lambda v: v * (1 + s * SPREAD * warmer),
        "thermal_misalignment": lambda s: lambda v: v + s * warmer * np.roll(v, 1, axis=1) * SPREAD,
        "temperature_rate": lambda s: lambda v: v + s * SPREAD * rising,
    }


def _of_accelerometers(world: World) -> dict:
    turned = np.gradient(world.rate, world.h, axis=0)
    arms = np.array([[1.0, 0.3, -0.5], [-0.7, 0.2, 1.0], [0.4, -1.0, 0.6]])
    steady = np.roll(SPREAD, 1)

    def lever(s):
        felt = [
            np.cross(turned, s * r) + np.cross(world.rate, np.cross(world.rate, s * r))
            for r in arms
        ]
        return lambda v: v + np.column_stack([felt[i][:, i] for i in range(3)])

    return {
        "size_effect": lever,
        "vibropendulous": lambda s: lambda v: v + s * v * (np.roll(v, 1, axis=1) * steady),
    }


def _of_gyros(world: World) -> dict:
    f, turned = world.force, np.gradient(world.rate, world.h, axis=0)
    squares = np.column_stack([f[:, 0] * f[:, 1], f[:, 2] ** 2, f[:, 1] * f[:, 2]])
    matrix = np.array([[1.0, 0.2, 0.0], [-0.4, 0.5, 0.3], [0.1, 0.0, -0.8]])
    return {
        "anisoinertia": lambda s: (
            lambda v: v + s * SPREAD * np.roll(v, 1, axis=1) * np.roll(v, 2, axis=1)
        ),
        "scale_factor_g_sensitivity": lambda s: (
            lambda v: v + s * v * np.roll(f, 1, axis=1) * SPREAD
        ),
        "g2_sensitivity": lambda s: lambda v: v + s * squares,
        "angular_acceleration": lambda s: lambda v: v + s * np.roll(turned, 1, axis=1) * SPREAD,
        "g_sensitivity": lambda s: lambda v: v + f @ (s * matrix).T,
    }


def _second_order(wn: float, zeta: float = 0.6):
    """The response of a filter of natural frequency ``wn`` rad/s."""
    return lambda w: wn**2 / (wn**2 - w**2 + 2j * zeta * wn * w)


def _filtered(values: np.ndarray, h: float, response) -> np.ndarray:
    """A continuous filter ``response(omega)`` of signals (n, 3) through their spectra, mirrored at
    their end so that they join up.
    """
    mirrored = np.concatenate([values, values[::-1]])
    gain = response(2 * np.pi * np.fft.rfftfreq(len(mirrored), h))[:, None]
    back = np.fft.irfft(np.fft.rfft(mirrored, axis=0) * gain, len(mirrored), axis=0)
    return back[: len(values)]


def size_for(world: World, kind: str, name: str, wanted: float, structure: bool) -> float:
    """Size at which an effect is ``wanted`` times detectable; limits and steps, which have no such
    scale, are set by their share.
    """
    x, n = (world.rate, N_GYRO) if kind == "gyro" else (world.force, N_ACCEL)
    if name == "saturation":
        return float(np.quantile(np.abs(x), 0.998))
    if name == "quantization":
        return 2.0 * n.max() / np.sqrt(world.h)
    make, explained = changes(world, kind)[name], _explained(world, kind, structure)
    low, high = np.log(1e-9), np.log(0.03)
    for _ in range(24):  # to a millionth of the size
        middle = (low + high) / 2
        low, high = (
            (low, middle)
            if _norm(make(np.exp(middle))(x) - x, explained) > wanted
            else (middle, high)
        )
    return float(np.exp(high))


def best_possible(world: World, log: Recording, kind: str, change) -> float:
    """RMS residual of the true model on the last 30 % of a log, its bias taken from the rest."""
    x, y = (world.rate, log.gyro) if kind == "gyro" else (world.force, log.accel)
    left = y - change(x)
    at = round(0.7 * len(left))
    return float(np.sqrt(np.mean((left[at:] - left[:at].mean(axis=0)) ** 2)))
