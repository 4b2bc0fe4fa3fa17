"""Sensors and motions that excite any effect of the catalogue, made from its definition alone."""

import numpy as np

from pyimu import units
from pyimu.effect import CATALOGUE, KINDS, SIGNALS, Sensor
from pyimu.imu import Part

H = 0.01
"""Sample period [s]."""

NATURAL = {"rad": 1.0, "s": 0.3, "m": 1.0, "K": 10.0, "V": 1.0, "T": 1e-4}
"""The size of each base unit in the motion below; a coefficient is a small share of what its unit makes of these."""

CASES = [(name, kind) for name, e in CATALOGUE.items() for kind in e.sensors]


def size(unit: str) -> float:
    """What is large in this unit."""
    return float(np.prod([NATURAL[base] ** float(e) for base, e in zip(units.BASES, units.parse(unit).dimension)]))


def excited(name: str, kind: str, share: float = 0.05) -> Sensor:
    """A sensor with one effect, each coefficient another value, matrices without symmetry."""
    return with_excited(Sensor(kind), name, share)


def with_excited(sensor: Sensor, name: str, share: float = 0.05) -> Sensor:
    added = sensor.with_values(name)
    p = added.p.copy()
    for i, slot in enumerate(s for s in added.slots):
        if slot.effect == name:
            sign = 1 if slot.definition.minimum is not None else (-1) ** i
            p[i] += sign * share * (1 + 0.17 * i) * size(slot.unit)
    return added.with_p(p)


def everything(kind: str, share: float = 0.05) -> Sensor:
    """A sensor with all effects that it can have."""
    sensor = Sensor(kind)
    for name, e in CATALOGUE.items():
        if kind in e.sensors:
            sensor = with_excited(sensor, name, share)
    return sensor


def as_part(*sensors: Sensor) -> Part:
    return Part("test", 1 / H, **{s.kind: s for s in sensors})


def motion(n: int, seed: int = 0) -> np.ndarray:
    """Inputs (n, size of all signals) on all axes and both signs, smooth in time, with every signal of its own course."""
    rng, t, columns = np.random.default_rng(seed), H * np.arange(n), []
    for unit, width in SIGNALS.values():
        for _ in range(width):
            f, phase = rng.uniform(0.2, 3.0, 3), rng.uniform(0, 2 * np.pi, 3)
            columns.append(size(unit) * (0.3 + np.sin(2 * np.pi * np.outer(t, f) + phase).sum(1)))
    return np.column_stack(columns)


def own(kind: str) -> slice:
    """Columns of a sensor's own signal in the inputs."""
    at = 0
    for signal, (_, width) in SIGNALS.items():
        if signal == KINDS[kind].own:
            return slice(at, at + width)
        at += width
    raise KeyError(kind)


def outputs(kind: str) -> slice:
    """Columns of a sensor in the outputs of the block of a part."""
    first = 3 * list(KINDS).index(kind)
    return slice(first, first + 3)


def run(sensor: Sensor, u: np.ndarray, w: np.ndarray | None = None, h: float | None = None) -> np.ndarray:
    """Output (n, 3) of one sensor for inputs (n, nu) and normals (n, nw), ``h`` s apart."""
    return as_part(sensor).block.run(u, w=w, sample_period=h)[0][:, outputs(sensor.kind)]
