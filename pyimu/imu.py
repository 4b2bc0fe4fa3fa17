"""The inertial measurement unit: a part as data, its block, and its simulation over a whole log."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import casadi as ca
import numpy as np

import pyimu.effects  # noqa: F401  (fills the catalogue)
from pyimu.block import Block, Variable
from pyimu.effect import SIGNALS, Sensor
from pyimu.noise import normals

AXES = "xyz"
STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True)
class Part:
    """A sensor as data: name, sample rate [Hz], the gyro's and the accelerometer's chain of effects with their values.

    ``estimate`` names the coefficients ``(sensor, effect, parameter)`` that the part leaves to the data;
    ``notes`` keeps what the file says beside a value: its source, the figure as quoted.
    """

    name: str
    sample_rate: float
    gyro: Sensor = field(default_factory=lambda: Sensor("gyro"))
    accel: Sensor = field(default_factory=lambda: Sensor("accel"))
    estimate: frozenset[tuple[str, str, str]] = frozenset()
    notes: dict[tuple[str, str, str], dict[str, str]] = field(default_factory=dict, compare=False)
    description: str = ""

    @property
    def sample_period(self) -> float:
        return 1.0 / self.sample_rate

    def sensor(self, kind: str) -> Sensor:
        return {"gyro": self.gyro, "accel": self.accel}[kind]

    def with_sensor(self, sensor: Sensor) -> Part:
        return replace(self, **{sensor.kind: sensor})

    @cached_property
    def block(self) -> Block:
        """The part as the block ``ImuSensor``: gyro and accelerometer side by side on the same inputs."""
        return _imu_sensor(self)


def input_variables() -> tuple[Variable, ...]:
    """The motion and environment that every sensor takes, in the order of its input vector."""
    text = {"rate": "angular rate against inertial space, body axes", "specific_force": "specific force, body axes",
            "temperature": "temperature of the part"}
    # At rest and level, at the reference temperature: what an unconnected input should mean.
    starts = {"specific_force": (0.0, 0.0, STANDARD_GRAVITY), "temperature": (25.0,)}
    return tuple(Variable(f"{name}[{i + 1}]" if size > 1 else name, unit, text[name], starts.get(name, (0.0,) * size)[i])
                 for name, (unit, size) in SIGNALS.items() for i in range(size))


def _imu_sensor(part: Part) -> Block:
    sensors = (part.gyro, part.accel)
    u, h = ca.SX.sym("u", sum(size for _, size in SIGNALS.values())), ca.SX.sym("h")
    s, p, w = (
        [ca.SX.sym(f"{name}_{sensor.kind}", size(sensor)) for sensor in sensors] for name, size in
        (("s", lambda c: len(c.chain.start)), ("p", lambda c: len(c.slots)), ("w", lambda c: len(c.noise))))
    results = [sensor.step(s[i], u, p[i], w[i], h) for i, sensor in enumerate(sensors)]
    step = ca.Function("step", [ca.vertcat(*s), u, ca.vertcat(*p), ca.vertcat(*w), h],
                       [ca.vertcat(*[r[0] for r in results]), ca.vertcat(*[r[1] for r in results])],
                       ["s", "u", "p", "w", "h"], ["s_next", "y"])
    start = np.concatenate([sensor.chain.start for sensor in sensors])
    all_p = ca.SX.sym("p", p[0].numel() + p[1].numel())
    initial = ca.Function("initial", [all_p], [ca.SX(ca.DM(start)), ca.SX.zeros(6)], ["p"], ["s", "y"])
    return Block(name="ImuSensor", description=part.description or f"Inertial measurement unit {part.name}",
                 step=step, initial=initial, inputs=input_variables(),
                 parameters=part.gyro.variables + part.accel.variables,
                 outputs=tuple(Variable(f"{c.kind}[{i + 1}]", c.output.unit, f"measured {c.output.own.replace('_', ' ')}, axis {AXES[i]}")
                               for c in sensors for i in range(3)),
                 noise=part.gyro.noise + part.accel.noise, sample_period=part.sample_period)


def simulate(part: Part, rate: np.ndarray, specific_force: np.ndarray, temperature: np.ndarray | float = 25.0, *,
             seed: int | None = 0, sample_period: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Measured rate and specific force, each (n, 3), of a part that moves as given (rad/s, m/s^2, degC).

    Row k draws the noise that the FMU draws for its sample k + 1 under the same seed; ``seed=None`` is noise off.
    """
    n = len(rate)
    u = np.column_stack([rate, specific_force, np.broadcast_to(temperature, (n,))])
    block = part.block
    w = None if seed is None or not block.noise else normals(seed, [c.number for c in block.noise], 1, n)
    y, _ = block.run(u, w=w, sample_period=sample_period)
    return y[:, :3], y[:, 3:]
