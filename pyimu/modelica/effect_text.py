"""An effect as a package of Modelica: its functions, and a block of them for each sensor."""

from __future__ import annotations

import html
from collections.abc import Iterator
from dataclasses import dataclass

from pyimu.model.arguments import Parameter
from pyimu.model.effect import Effect
from pyimu.model.kinds import KINDS
from pyimu.model.signals import EVERY_SAMPLE, SIGNALS
from pyimu.modelica.bounds import bound_asserts
from pyimu.modelica.effect_functions import (
    OUTPUT,
    STARTED,
    EffectFunctions,
    effect_functions,
    next_of,
    signal_of,
)
from pyimu.modelica.names import identifier, pascal
from pyimu.modelica.text import GENERATED, capital, comment, number, rendered, wrapped
from pyimu.modelica.unit_names import modelica_unit

_UNITS = (
    "<p>{y} is rad/s of a gyro and m/s^2 of an accelerometer, {Y} rad and m/s. At the start values "
    "of its coefficients the effect is the identity.</p>"
)

_OF = {"gyro": "of a gyro", "accel": "of an accelerometer"}

_REAL_INPUT, _REAL_OUTPUT = (f"Modelica.Blocks.Interfaces.Real{x}" for x in ("Input", "Output"))


@dataclass(frozen=True)
class EffectBlock:
    """The block of an effect for one kind of sensor, in lines of text."""

    name: str
    description: str
    unit: str
    declarations: list[str]
    states: list[str]
    asserts: list[str]
    equations: list[str]
    modifications: str = ""


def effect_text(e: Effect) -> str:
    """The file of an effect. Raises UserError where an operation cannot be said in Modelica."""
    f = effect_functions(e)
    first, *others = [_block(f, kind) for kind in e.sensors]
    return GENERATED + rendered(
        "effect.mo",
        name=pascal(e.name),
        effect=e,
        functions=f.all,
        first=first,
        others=others,
        continuous="" if _has_memory(f) else f.output.call({}),
        documentation=_documentation(e),
    )


def _has_memory(f: EffectFunctions) -> bool:
    return bool(f.following or f.effect.noises or f.uses("h"))


def _block(f: EffectFunctions, kind: str) -> EffectBlock:
    e, unit = f.effect, modelica_unit(KINDS[kind].unit)
    states = list(_states(f, kind))
    equations = [
        *_in_order(f),
        *([f"{STARTED} = true;"] if f.waits else []),
    ]
    return EffectBlock(
        pascal(kind),
        f"{capital(e.term)}, {_OF.get(kind, f'of a sensor {kind}')}",
        unit or "",
        [line for d in _declarations(f, kind) for line in wrapped(d)],
        states,
        [line for a in _asserts(f) for line in wrapped(a)],
        [line for q in equations for line in wrapped(q)],
        ", ".join(_modifications(e, kind)),
    )


def _in_order(f: EffectFunctions) -> list[str]:
    """The equations of output and states, those first that others are made of."""
    output = f"{OUTPUT} = {f.output.call(_given(f))};"
    first, then = [], []
    for state, g in f.following.items():
        used = any(a.name == next_of(state) for a in f.output.arguments)
        (first if used else then).append(f"{identifier(state)} = {g.call(_given(f))};")
    return [*first, output, *then]


def _given(f: EffectFunctions) -> dict[str, str]:
    """What stands for the arguments of a function in a block: of the memory its last value."""
    past = {identifier(s): f"pre({identifier(s)})" for s in f.effect.states}
    past |= {next_of(s): identifier(s) for s in f.effect.states}
    waits = {STARTED: f"pre({STARTED})"} if f.waits else {}
    return {**past, **waits, "h": "samplePeriod"}


def _declarations(f: EffectFunctions, kind: str) -> Iterator[str]:
    """Coefficients and connectors."""
    e = f.effect
    for name, q in e.parameters.items():
        yield parameter_text(name, q, kind, e.term)
    places = _places(len(e.environment))
    for name, place in zip(e.environment, places, strict=True):
        signal = SIGNALS[signal_of(e, name, kind)]
        size, unit = (f"[{signal.size}]" if signal.size > 1 else ""), modelica_unit(signal.unit)
        start = "{" + ", ".join(map(number, signal.start)) + "}"
        yield (
            f'{_REAL_INPUT} {identifier(name)}{size}({"each " if size else ""}unit="{unit}", '
            f"start={start if size else number(signal.start[0])}){comment(capital(signal.text))} "
            f"annotation(Placement(transformation(extent={{{{-20,-20}},{{20,20}}}}, rotation=90, "
            f"origin={{{place},-120}})));"
        )
    for name, w in e.noises.items():
        yield (
            f'{_REAL_INPUT} {identifier(name)}[{w.size}](each unit="1") "Standard normals, new '
            'ones at each sample" annotation(Placement(transformation(extent={{-20,-20},{20,20}}, '
            "rotation=-90, origin={0,120})));"
        )


def _places(count: int) -> list[int]:
    """Where connectors stand along the lower edge."""
    return [round(-100 + 200 * (i + 1) / (count + 1)) for i in range(count)]


def parameter_text(
    name: str, q: Parameter, kind: str, term: str, value: str | None = None, said: str = ""
) -> str:
    """The declaration of a coefficient with its unit, its bounds and its start value."""
    size = f"[{','.join(map(str, q.shape))}]" if q.shape else ""
    each, written = "each " if size else "", KINDS[kind].units(q.unit)
    unit = modelica_unit(written)
    attributes = [] if unit is None else [f'{each}unit="{unit}"']
    attributes += [
        f"{each}{bound}={number(limit)}"
        for bound, limit in (("min", q.minimum), ("max", q.maximum))
        if limit is not None
    ]
    start = value or (
        f"fill({number(q.start)}, {', '.join(map(str, q.shape))})" if size else number(q.start)
    )
    text = capital(q.description or term) + (f" [{written}]" if unit is None else "")
    shown = f"({', '.join(attributes)})" if attributes else ""
    return f"parameter Real {identifier(name)}{size}{shown} = {start}{comment(text + said)};"


def _states(f: EffectFunctions, kind: str) -> Iterator[str]:
    for name, q in f.effect.states.items():
        size = f"[{','.join(map(str, q.shape))}]" if q.shape else ""
        each, start = "each " if size else "", 0 if isinstance(q.start, str) else q.start
        yield (
            f"discrete Real {identifier(name)}{size}({each}start={number(start)}, "
            f"{each}fixed=true);"
        )
    if f.waits:
        yield f"Boolean {STARTED}(start=false, fixed=true);"


def _asserts(f: EffectFunctions) -> Iterator[str]:
    """What coefficients must keep by themselves and together."""
    where = f.effect.name
    for name, q in f.effect.parameters.items():
        me = identifier(name)
        yield from bound_asserts(where, me, bool(q.shape), q.minimum, q.maximum, name)
        if not q.diagonal:
            diagonal = " + ".join(f"abs({me}[{i},{i}])" for i in range(1, q.shape[0] + 1))
            yield f'assert({diagonal} <= 0, "{where}: {name} must have zeros on its diagonal");'
    for text, g in f.limits.items():
        yield f'assert(not {g.call(_given(f))}, "{where}: {text}");'


def _modifications(e: Effect, kind: str) -> Iterator[str]:
    """What another kind of sensor has other than the first: its units."""
    unit = modelica_unit(KINDS[kind].unit)
    yield f'x(each unit="{unit}"), y(each unit="{unit}")'
    for name, q in e.parameters.items():
        own = modelica_unit(KINDS[kind].units(q.unit))
        if own is not None and own != modelica_unit(KINDS[e.sensors[0]].units(q.unit)):
            yield f'{identifier(name)}({"each " if q.shape else ""}unit="{own}")'


def _documentation(e: Effect) -> str:
    """The page of an effect: equation, coefficients, source, in HTML."""
    rows = "\n".join(
        f"<tr><td>{name}</td><td>{html.escape(q.unit)}</td>"
        f"<td>{html.escape(q.description)}</td></tr>"
        for name, q in e.parameters.items()
    )
    notes = [f"It {EVERY_SAMPLE}: the difference of held ones is zero."] if e.differences else []
    paragraphs = [
        f"<p>{html.escape(capital(e.term))}; stage: {e.stage}.</p>",
        f"<p>Equation (LaTeX): <code>{html.escape(e.equation)}</code></p>",
        f"<p>Source: {html.escape(e.source)}.</p>",
        "<table><tr><th>coefficient</th><th>unit</th><th>meaning</th></tr>",
        rows,
        "</table>",
        _UNITS,
        *(f"<p>{note}</p>" for note in notes),
    ]
    return "\n".join(paragraphs)
