"""A part as a package of Modelica: gyroscope, accelerometer, and both as a measurement unit."""

from __future__ import annotations

import html
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from pyimu.errors import UserError
from pyimu.model.chain import Chain
from pyimu.model.effect import Effect
from pyimu.model.effects import EFFECTS
from pyimu.model.part import Part
from pyimu.model.part_entry import RATE_KEY
from pyimu.model.sensor import Sensor
from pyimu.model.signals import ALWAYS, SIGNALS, inputs_for
from pyimu.modelica.effect_functions import signal_of
from pyimu.modelica.effect_text import effect_text
from pyimu.modelica.names import camel, identifier, pascal
from pyimu.modelica.text import GENERATED, capital, comment, number, numbers, rendered, wrapped
from pyimu.modelica.unit_names import modelica_unit

VERSION = "0.1.0"
"""Of the library that the text is for."""

TRIADS = {"gyro": "Gyroscope", "accel": "Accelerometer"}

CONNECTORS = {"rate": "rate", "specific_force": "specificForce", "temperature": "temperature"}
"""The inputs that every part has, by their names in ``SIGNALS``."""


@dataclass(frozen=True)
class Triad:
    """One sensor of a part, in lines of text."""

    name: str
    description: str
    start: str
    declarations: list[str]
    connections: list[str]


def part_text(part: Part, within: str = "", name: str = "") -> str:
    """The file of a part. ``within`` is the package that it belongs to, none for a user's own.

    Raises UserError for a part with a coefficient that is left to the data, and for an effect whose
    function uses what Modelica does not have.
    """
    if part.estimate:
        kind, effect, parameter = sorted(part.estimate)[0]
        raise UserError(
            f"part {part.name}: {kind}.{effect}.{parameter} is left to the data; a Modelica class "
            "needs a value: run pyimu close first"
        )
    needed = inputs_for(part.signals)
    extra = [n for n in needed if n not in ALWAYS]
    own = [e for e in _effects(part) if e not in EFFECTS]
    sensors = (part.gyro, part.accel)
    return (GENERATED if within else "") + rendered(
        "part.mo",
        within=within,
        name=name or pascal(part.name),
        description=part.description or f"Inertial measurement unit {part.name}",
        own=[_nested(effect_text(e)) for e in own],
        triads=[_triad(part, s) for s in sensors],
        period=number(part.sample_period),
        connectors=[line for n in extra for line in wrapped(connector(n))],
        connections=list(_of_both(sensors)),
        uses=not within,
        version=VERSION,
        documentation=_documentation(part),
    )


def _effects(part: Part) -> list[Effect]:
    return list(dict.fromkeys((*part.gyro.effects, *part.accel.effects)))


def _nested(text: str) -> list[str]:
    """The package of an effect as a class within that of a part."""
    lines = text.splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("package "))
    return [line for line in lines[first:] if line]


def connector(name: str, condition: str = "") -> str:
    """The declaration of an input by its name in ``SIGNALS``, there under a condition if any."""
    signal = SIGNALS[name]
    size = f"[{signal.size}]" if signal.size > 1 else ""
    start = numbers(list(signal.start)) if size else number(signal.start[0])
    return (
        f"Modelica.Blocks.Interfaces.RealInput {identifier(camel(name))}{size}"
        f'({"each " if size else ""}unit="{modelica_unit(signal.unit)}", start={start})'
        f"{condition}{comment(capital(signal.text))};"
    )


def _extra(sensor: Sensor) -> list[str]:
    """Inputs of a sensor beside those that every part has."""
    return [n for n in inputs_for(sensor.signals) if n not in ALWAYS]


def _of_both(sensors: Iterable[Sensor]) -> Iterator[str]:
    """Connections of the two sensors of a part with its connectors."""
    for sensor in sensors:
        me = TRIADS[sensor.kind].lower()
        for name in (*CONNECTORS.values(), *(identifier(camel(n)) for n in _extra(sensor))):
            yield f"connect({name}, {me}.{name});"
        yield f"connect({me}.y, {sensor.kind});"


def _triad(part: Part, sensor: Sensor) -> Triad:
    """The chain of a sensor's effects."""
    own = sensor.output.own
    derived = [n for n in SIGNALS if n in sensor.signals and SIGNALS[n].derived]
    declarations = [connector(n) for n in _extra(sensor)]
    measured = comment(f"Measured {own.replace('_', ' ')}")
    declarations.append(
        f"Modelica.Blocks.Interfaces.RealOutput y[3]"
        f'(each unit="{modelica_unit(sensor.output.unit)}"){measured} '
        "annotation(Placement(transformation(extent={{100,-10},{120,10}})));"
    )
    connections = []
    for name in derived:
        block = f"{camel(name)}Signal"
        declarations.append(
            f"PyImu.Signals.{pascal(name)}.Signal {block}(samplePeriod=samplePeriod);"
        )
        connections += [f"connect({_source(n)}, {block}.{camel(n)});" for n in SIGNALS[name].of]
    last = CONNECTORS[own]
    if not sensor.effects:
        declarations.append("PyImu.Sensors.Sampler sampler(samplePeriod=samplePeriod, y0=y0);")
        connections.append(f"connect({last}, sampler.x);")
        last = "sampler.y"
    for e in sensor.effects:
        block = _block(e)
        declarations += _effect(part, sensor, e)
        connections.append(f"connect({last}, {block}.x);")
        connections += [
            f"connect({_source(signal_of(e, n, sensor.kind))}, {block}.{identifier(n)});"
            for n in e.environment
        ]
        connections += [f"connect({block}Normals.y, {block}.{identifier(n)});" for n in e.noises]
        last = f"{block}.y"
    connections.append(f"connect({last}, y);")
    return Triad(
        TRIADS[sensor.kind],
        f"{TRIADS[sensor.kind]} of {part.name}",
        numbers(list(SIGNALS[own].start)),
        [line for d in declarations for line in wrapped(d)],
        connections,
    )


def _source(signal: str) -> str:
    """Where a signal comes from in a triad."""
    if SIGNALS[signal].derived:
        return f"{camel(signal)}Signal.y"
    return CONNECTORS.get(signal, identifier(camel(signal)))


def _block(e: Effect) -> str:
    """Name of an effect's block in a triad, which no connector or parameter has."""
    name = camel(e.name)
    taken = {"y", "y0", "seed", "samplePeriod", "globalSeed", "sampler"}
    return f"{name}Effect" if name in taken | {camel(n) for n in SIGNALS} else identifier(name)


def _effect(part: Part, sensor: Sensor, e: Effect) -> Iterator[str]:
    """The declarations of an effect's block with its coefficients, and of its normals."""
    block = _block(e)
    package = "PyImu.Effects." if e in EFFECTS else ""
    values = "".join(
        f", {identifier(n)}={numbers(v.tolist())}" for n, v in sensor.values[e.name].items()
    )
    said = _said(part, sensor.kind, e)
    yield (
        f"{package}{pascal(e.name)}.{pascal(sensor.kind)} {block}(samplePeriod=samplePeriod, y0=y0"
        f"{values}){comment(said)};"
    )
    for name, w in e.noises.items():
        numbers_of = [c.number for c in Chain(sensor.kind, (e,)).noise if f".{name}[" in c.name]
        channels = ", ".join(map(str, numbers_of))
        yield (
            f"PyImu.Noise.Normals {block}Normals(samplePeriod=samplePeriod, seed=seed, n={w.size}, "
            f"channel={{{channels}}});"
        )


def _said(part: Part, kind: str, e: Effect) -> str:
    """The term of an effect, and the source of each of its coefficients."""
    found = []
    for name in e.parameters:
        note = part.notes.get((kind, e.name, name), {})
        if note.get("source"):
            quoted = f"{note['quoted']}, " if note.get("quoted") else ""
            found.append(f"{name}: {quoted}{note['source']}")
    return "; ".join([capital(e.term), *found])


def _documentation(part: Part) -> str:
    """What the part is, and the source of its sample rate."""
    rate = part.notes.get(RATE_KEY, {}).get("source", "no source")
    text = part.description or f"Inertial measurement unit {part.name}"
    sampled = f"Sampled at {part.sample_rate:g} Hz ({rate})."
    sources = "Coefficients are in SI units; their sources stand behind the blocks that have them."
    return f"<p>{html.escape(text)}.</p>\n<p>{html.escape(sampled)} {sources}</p>"
