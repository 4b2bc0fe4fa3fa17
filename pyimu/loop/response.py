"""What a sensor answers to a whole log at once, and how the answer changes with each coefficient.

The dynamics of a chain are linear and time-invariant, so they act by their impulse response; what follows them has
no memory once the noise is off, so casadi evaluates it, and its Jacobian, over all samples together.
"""

from __future__ import annotations

from functools import cache, lru_cache

import casadi as ca
import numpy as np
from scipy.signal import oaconvolve

from pyimu.block import step_through
from pyimu.effect import N_INPUT, OWN, Sensor
from pyimu.vectorise import over_rows

LONGEST_RESPONSE = 1 << 14


def dynamics(sensor: Sensor) -> Sensor:
    """The part of the chain that lies before everything without memory."""
    return Sensor(sensor.kind, {e.name: sensor.values[e.name] for e in sensor.effects if e.stage == "dynamics"})


def tail(sensor: Sensor) -> Sensor:
    """What follows the dynamics, less the effects whose output has no slope (rounding acts as noise here)."""
    return Sensor(sensor.kind, {e.name: sensor.values[e.name] for e in sensor.effects
                                if e.stage != "dynamics" and not is_step(e.name, sensor.kind)})


@cache
def is_step(name: str, kind: str) -> bool:
    """True for an effect whose slope is zero almost everywhere: a staircase."""
    one = Sensor(kind, {name: {}})
    x = one.chain.x
    y = one.step(one.chain.start, one.chain.u, one.chain.p, np.zeros(len(one.noise)), 1.0)[1]
    identity = ca.Function("slope", [one.chain.u, one.chain.p], [ca.jacobian(y, x)])
    return float(ca.norm_fro(identity(np.full(N_INPUT, 0.3), one.p + 1.0))) == 0.0


def impulse_response(sensor: Sensor, h: float) -> np.ndarray:
    """Response (L, 3) of a chain of dynamics to a unit impulse, until it has died away (or ``LONGEST_RESPONSE`` samples)."""
    chain = sensor.chain
    state = chain.start.copy()
    if chain.waits:
        state[0] = 1.0
    parts, total = [], 0
    while total < LONGEST_RESPONSE:
        u = np.zeros((64, N_INPUT))
        if not total:
            u[0, OWN[sensor.kind]] = 1.0
        y = np.empty((64, 3))
        state = step_through(chain.step, state, u, sensor.p, np.zeros((64, 0)), np.array([h]), y)
        parts.append(y)
        total += 64
        if np.abs(y).max() < 1e-13 and np.abs(state[chain.waits:]).max(initial=0) < 1e-13:
            break
    return np.concatenate(parts)


def through_dynamics(sensor: Sensor, x: np.ndarray, segments: list[tuple[int, int]], h: float) -> np.ndarray:
    """Input (n, 3) after the sensor's dynamics, each segment started at rest on its first sample."""
    chain = dynamics(sensor)
    if not chain.effects:
        return x
    response = impulse_response(chain, h)
    out = np.array(x)
    for a, b in segments:
        origin = x[a]
        moved = oaconvolve(x[a:b] - origin, response[: b - a], axes=0)[: b - a]
        # Dynamics pass a constant as it is; a response that was cut off before it had died away must not change the level.
        out[a:b] = moved + origin
    return out


class Tail:
    """The memoryless rest of a chain with its Jacobians, for one structure (which effects, not which values)."""

    def __init__(self, sensor: Sensor) -> None:
        self.sensor = tail(sensor)
        chain = self.sensor.chain
        y = chain.step(chain.start, chain.u, chain.p, np.zeros(len(self.sensor.noise)), 1.0)[1]
        jp = ca.jacobian(y, chain.p)
        self.axis, self.slot = (np.array(i, dtype=int) for i in jp.sparsity().get_triplet())
        outputs = ca.vertcat(y, ca.vec(ca.densify(ca.jacobian(y, chain.x)).T), *jp.nonzeros())
        self.function = ca.Function("tail", [chain.u, chain.p], [ca.densify(outputs)])
        self.output = ca.Function("output", [chain.u, chain.p], [ca.densify(y)])
        bends = [ca.jacobian(entry, chain.x[int(i)]) for entry, i in zip(jp.nonzeros(), self.axis, strict=True)]
        self.bend = ca.Function("bend", [chain.u, chain.p], [ca.densify(ca.vertcat(ca.SX(0, 1), *bends))])

    def __call__(self, u: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """For inputs (n, 7): output (n, 3), its slope against the own input (n, 3, 3), and dy/dp (n, entries).

        Entry e of dy/dp belongs to output axis ``self.axis[e]`` and to coefficient ``self.slot[e]``.
        """
        flat = over_rows(self.function, u, p)
        return flat[:, :3], flat[:, 3:12].reshape(-1, 3, 3), flat[:, 12:]

    def mean_bend(self, u: np.ndarray, p: np.ndarray) -> np.ndarray:
        """Mean over the rows (n, 7) of d(entry)/dx of its own axis, (entries,): how a regressor follows an error of the input."""
        return over_rows(self.bend, u, p).mean(axis=0)


@lru_cache(maxsize=32)
def tail_of(kind: str, effects: tuple[str, ...]) -> Tail:
    """The ``Tail`` of a structure, built once."""
    return Tail(Sensor(kind, {name: {} for name in effects}))


def predict(sensor: Sensor, u: np.ndarray, segments: list[tuple[int, int]], h: float) -> np.ndarray:
    """Noise-free answer (n, 3) of a sensor to a log (rounding left out)."""
    moved = np.array(u)
    own = OWN[sensor.kind]
    moved[:, own] = through_dynamics(sensor, u[:, own], segments, h)
    rest = tail(sensor)
    return over_rows(tail_of(rest.kind, tuple(rest.values)).output, moved, rest.p)
