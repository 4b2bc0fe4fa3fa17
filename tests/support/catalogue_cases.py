"""Sensors and motions that excite any effect of the catalogue, made from its definition alone."""

import casadi as ca
import numpy as np

from pyimu import units
from pyimu.block.block import Block
from pyimu.block.variables import Variable
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.kinds import KINDS
from pyimu.model.part import Part
from pyimu.model.part_file import part, part_names
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, SIGNALS, inputs_for

H = 0.01
"""Sample period [s]."""

NATURAL = {"rad": 1.0, "s": 0.3, "m": 1.0, "K": 10.0, "V": 1.0, "T": 1e-4, "LSB": 1.0}
"""The size of each base unit in the motion below; a coefficient is a small share of what its unit
makes of these."""

LARGE = {
    "earth_rate": 1.0,
    "transport_rate": 1.0,
    "coning": 1e4,
    "sculling": 1e4,
    "saturation": 0.25,
    "ageing": 1.0,
    "sampling_jitter": 0.1,
}
"""Shares for effects whose coefficients are not small numbers of the natural size."""

FORMS = {
    "tau": 1.3,
    "f0": 0.7,
    "f_low": 0.01,
    "f_high": 20.0,
    "width": 3.0,
    "phase": 0.4,
    "t0": 1.1,
}
"""Form coefficients that show an effect within the few seconds of a test."""

CASES = [(name, kind) for name, e in CATALOGUE.items() for kind in e.sensors]


def size(unit: str) -> float:
    """What is large in this unit."""
    return float(
        np.prod(
            [NATURAL[base] ** float(e) for base, e in zip(units.BASES, units.parse(unit).dimension)]
        )
    )


def excited(name: str, kind: str, share: float = 0.05) -> Sensor:
    """A sensor with one effect, each coefficient another value, matrices without symmetry."""
    return with_excited(Sensor(kind), name, share)


def with_excited(sensor: Sensor, name: str, share: float = 0.05) -> Sensor:
    added = sensor.with_values(name)
    p, share = added.p.copy(), share * LARGE.get(name, 0.05) / 0.05
    for i, slot in enumerate(added.slots):
        if slot.effect != name:
            continue
        if slot.definition.form:
            p[i] = FORMS[slot.parameter] * (1 + 0.17 * (slot.index[0] if slot.index else 0))
        else:
            sign = 1 if slot.definition.minimum is not None else (-1) ** i
            p[i] += sign * share * (1 + 0.17 * (i % 9)) * size(slot.unit)
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
    """All signals (n, N_INPUT), on all axes and both signs, smooth in time, each of its own course;
    time runs.
    """
    rng, t, columns = np.random.default_rng(seed), H * np.arange(n), []
    for signal in SIGNALS.values():
        for _ in range(signal.size):
            f, phase = rng.uniform(0.2, 3.0, 3), rng.uniform(0, 2 * np.pi, 3)
            columns.append(
                size(signal.unit) * (0.09 + 0.3 * np.sin(2 * np.pi * np.outer(t, f) + phase).sum(1))
            )
    u = np.column_stack(columns)
    u[:, COLUMNS["time"]] = (t + H)[:, None]
    return u


def inputs(u: np.ndarray, part: Part) -> np.ndarray:
    """Of all signals (n, N_INPUT) those that the block of a part takes."""
    return np.hstack([u[:, COLUMNS[name]] for name in inputs_for(part.signals)])


def own(kind: str) -> slice:
    """Columns of a sensor's own signal among all signals."""
    return COLUMNS[KINDS[kind].own]


def outputs(kind: str) -> slice:
    """Columns of a sensor in the outputs of the block of a part."""
    first = 3 * list(KINDS).index(kind)
    return slice(first, first + 3)


def alone(sensor: Sensor) -> Block:
    """A sensor as a block of its own that takes every signal as an input, the derived ones too."""
    names = tuple(Variable(f"u[{i}]") for i in range(sensor.chain.u.numel()))
    u, p = ca.SX.sym("u", len(names)), ca.SX.sym("p", len(sensor.slots))
    initial = ca.Function("initial", [u, p], [ca.SX(ca.DM(sensor.chain.start)), ca.SX.zeros(3)])
    return Block(
        "alone",
        "",
        sensor.step,
        initial,
        names,
        sensor.variables,
        tuple(Variable(f"y[{i}]") for i in range(3)),
        sensor.noise,
        H,
    )


def run(
    sensor: Sensor, u: np.ndarray, w: np.ndarray | None = None, h: float | None = None
) -> np.ndarray:
    """Output (n, 3) of one sensor for all signals (n, N_INPUT) and normals (n, nw), ``h`` s
    apart.
    """
    return alone(sensor).run(u, w=w, sample_period=h)[0]


def one_of_each_kind() -> tuple[str, ...]:
    """Names of built-in parts, of each set of effects the first.

    What is compiled or simulated for each part is so for these: parts of one kind differ in their
    figures alone.
    """
    kinds = {}
    for name in part_names():
        made = part(name)
        effects = tuple(tuple(made.sensor(kind).values) for kind in KINDS)
        kinds.setdefault(effects, name)
    return tuple(kinds.values())
