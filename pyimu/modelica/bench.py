"""A test bench for one effect: inputs that excite each of its branches, and the effect alone."""

from __future__ import annotations

import numpy as np

from pyimu.model.effect import Effect
from pyimu.model.effects import EFFECTS
from pyimu.model.kinds import KINDS
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS
from pyimu.model.typical import magnitudes
from pyimu.modelica.effect_functions import signal_of
from pyimu.modelica.names import identifier, pascal
from pyimu.modelica.text import GENERATED, capital, number, numbers, rendered, wrapped

PERIOD = 0.01
"""s; sample period of a bench."""

SAMPLES = 40
"""More than the 19 values of an input, and than a delay remembers."""

AMPLITUDES = {
    "rate": 1.0,
    "specific_force": 10.0,
    "temperature": 20.0,
    "supply": 0.5,
    "mag": 5e-5,
    "temperature_rate": 0.05,
    "angular_acceleration": 2.0,
    "jerk": 50.0,
    "vibration": 4.0,
    "earth_rate": 7e-5,
    "transport_rate": 2e-6,
}
"""Largest departure of each signal from its start value in a bench, of the size that a vehicle has.
"""

NORMALS = 2.5
"""Largest of what stands for the normals."""


def bench_text(sensor: Sensor, name: str, within: str = "PyImu.Examples.Benches") -> str:
    """A model in which the one effect of ``sensor``, with its coefficients, stands alone."""
    (e,) = sensor.effects
    own, kind = KINDS[sensor.kind].own, sensor.kind
    values = ", ".join(f"{identifier(n)}={numbers(v.tolist())}" for n, v in e_values(sensor))
    declarations = [
        f"PyImu.Effects.{pascal(e.name)}.{pascal(kind)} effect(samplePeriod={PERIOD}, {values});",
        excitation("motion", own, 0),
    ]
    connections = ["connect(motion.y, effect.x);"]
    for shift, argument in enumerate(e.environment, 1):
        signal, block = signal_of(e, argument, kind), f"source{shift}"
        if signal == "time":
            declarations.append(f"PyImu.Signals.Time.Signal {block}(samplePeriod={PERIOD});")
            connections.append(f"connect({block}.y, effect.{identifier(argument)});")
            continue
        declarations.append(excitation(block, signal, shift))
        element = "" if SIGNALS[signal].size > 1 else "[1]"
        connections.append(f"connect({block}.y{element}, effect.{identifier(argument)});")
    for argument, w in e.noises.items():
        declarations.append(
            f"PyImu.Examples.Excitation normals(samplePeriod={PERIOD}, n={w.size}, shift=7, "
            f"amplitude=fill({NORMALS}, {w.size}), offset=fill(0, {w.size}));"
        )
        connections.append(f"connect(normals.y, effect.{identifier(argument)});")
    return GENERATED + rendered(
        "bench.mo",
        name=name,
        within=within,
        description=f"{capital(e.term)} alone",
        declarations=[line for d in declarations for line in wrapped(d)],
        connections=connections,
        stop=number(SAMPLES * PERIOD),
        period=PERIOD,
        documentation=(
            "The effect alone, at a size that a consumer's part has, with inputs of both signs "
            "that change at each sample. What stands for the normals is no noise."
        ),
    )


def e_values(sensor: Sensor) -> list[tuple[str, np.ndarray]]:
    """The coefficients of the sensor's one effect."""
    (e,) = sensor.effects
    return list(sensor.values[e.name].items())


def excitation(block: str, signal: str, shift: int) -> str:
    """The declaration of a source for a signal."""
    start, size = SIGNALS[signal].start, AMPLITUDES[signal]
    return (
        f"PyImu.Examples.Excitation {block}(samplePeriod={PERIOD}, n={len(start)}, shift={shift}, "
        f"amplitude=fill({number(size)}, {len(start)}), offset={numbers(list(start))});"
    )


def excite(sample: np.ndarray, offset: np.ndarray, amplitude: np.ndarray, shift: int) -> np.ndarray:
    """What ``PyImu.Examples.Excitation`` gives at ``sample`` (n,): (n, m)."""
    k, i = np.asarray(sample, dtype=float)[:, None], np.arange(1.0, len(offset) + 1)
    return offset + amplitude * (np.mod((i + shift) * k + 5 * i, 19) - 9) / 9


def typical(e: Effect, kind: str) -> Sensor:
    """A sensor with this effect alone, of the size that it has in a consumer's part."""
    found = magnitudes(e.name, kind)["consumer"]
    sensor = Sensor(kind, {e.name: {}})
    q = e.parameters[found.parameter]
    value = np.full(q.shape, found.si)
    if q.minimum is None and found.parameter != "k":
        value = value * np.where(np.indices(q.shape).sum(axis=0) % 2, -1.0, 1.0)
    if not q.diagonal:
        np.fill_diagonal(value, 0.0)
    return sensor.with_values(e.name, **{found.parameter: value, **found.beside_si})


def benches() -> dict[str, str]:
    """Name to text of the bench of each effect of the package."""
    return {pascal(e.name): bench_text(typical(e, e.sensors[0]), pascal(e.name)) for e in EFFECTS}
