"""An attitude filter in Modelica: a block around the C of its co-simulation unit.

Its step is a function of matrices with switches, which casadi cannot expand to scalars; so it is
not printed but called, as ``external "C"``, with an external object for what it remembers.
"""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from pyimu.block.block import Block
from pyimu.block.c_code import c_code
from pyimu.block.variables import Variable
from pyimu.modelica.bounds import bound_asserts
from pyimu.modelica.names import camel, pascal
from pyimu.modelica.text import capital, comment, number, numbers, rendered, wrapped
from pyimu.modelica.unit_names import modelica_unit

OPTIONAL: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "useHeading": (
        "a heading sensor is connected",
        ("heading", "heading_variance", "heading_valid", "heading_age"),
    ),
    "useStationary": ("it is told when the body stands", ("stationary",)),
    "useSpeed": ("a speed is connected", ("speed", "speed_variance", "speed_valid")),
    "useMagnetometer": ("a magnetometer is connected", ("mag",)),
}
"""Inputs that a model may leave out, by the parameter that says that they are there."""

SHORT = 110
"""Characters of a description that a dialog shows; all of a longer one stands on the page."""

SOURCES = (
    "Hidalgo 2012, sections 4 and 5; Crassidis and Markley 2003; Groves 2013, section 15.3; what "
    "differs from them, the guide of the unit says"
)

_CONNECTORS = {"real": "Real", "boolean": "Boolean", "integer": "Integer"}


def ukf_source(block: Block, prefix: str, head: str) -> str:
    """The C of a filter, with three functions for Modelica.

    ``prefix`` begins all its names, so that several stand in one program. Raises ValueError
    for a block with noise or limits, and one whose start depends on its inputs: these have no form
    here.
    """
    if block.noise or block.limits or block.initial.jac_sparsity(1, 0).nnz():
        raise ValueError(f"block {block.name}: noise, limits or a start that depends on its inputs")
    functions = (block.step, block.initial)
    kept = {f.name() for f in functions}
    pieces = [
        piece
        for piece in c_code(prefix, functions).split("\n\n")
        if "CASADI_SYMBOL_EXPORT" not in piece or _exported(piece) in kept
    ]
    text = "\n\n".join(pieces).strip()
    for name in kept:
        text = text.replace(f"CASADI_SYMBOL_EXPORT int {name}(", f"static int {prefix}_{name}(")
    return rendered(
        "sampled.c",
        head=head,
        prefix=prefix,
        name=block.name,
        functions=text,
        macros=re.findall(r"^ *#define (\w+)", text, re.MULTILINE),
        step=block.step.name(),
        initial=block.initial.name(),
        inputs=len(block.inputs),
        parameters=len(block.parameters),
        outputs=len(block.outputs),
        states=block.n_state,
        work={
            what: max(1, *(getattr(f, f"sz_{what}")() for f in functions))
            for what in ("arg", "res", "iw", "w")
        },
    )


def _exported(piece: str) -> str:
    """The name of the function that casadi exports in a piece of its C; empty for none."""
    found = re.search(r"^CASADI_SYMBOL_EXPORT .*?(\w+)\(", piece, re.MULTILINE)
    return found[1] if found else ""


def ukf_classes(block: Block, prefix: str, file: str, folder: str) -> dict[str, str]:
    """Name to text of the classes of a filter whose C lies in ``file`` of the URI ``folder``."""
    function = f"{camel(_words(block.name))}Sample"
    given: dict[str, Any] = {
        "name": block.name,
        "function": function,
        "prefix": prefix,
        "file": file,
        "folder": folder,
        "inputs": len(block.inputs),
        "outputs": len(block.outputs),
    }
    return {
        block.name: _block(block, function),
        f"{block.name}Memory": rendered("ukf_memory.mo", **given),
        function: rendered("ukf_sample.mo", **given),
    }


def _words(name: str) -> str:
    """``AttitudeUkf`` as words."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name)


def _block(block: Block, function: str) -> str:
    inputs, parameters, outputs = (
        _arrays(v) for v in (block.inputs, block.parameters, block.outputs)
    )
    used = {name: use for use, (_, names) in OPTIONAL.items() for name in names if name in inputs}
    declarations = [
        *_switches(dict.fromkeys(used.values())),
        *(_parameter(block, name, of) for name, of in parameters.items()),
        *_inputs(block, inputs, used),
        *_outputs(block, outputs),
    ]
    return rendered(
        "ukf_block.mo",
        name=block.name,
        description=f"{block.description}, in C",
        period=number(block.sample_period),
        declarations=_lines(declarations),
        hidden=_lines(_hidden(block, inputs, parameters, used)),
        start=f"shown = {function}(memory, 0, fill(0, {len(block.inputs)}));",
        equations=_lines(_equations(block, inputs, parameters, outputs, used, function)),
        documentation=_documentation(block),
    )


def _lines(declarations: Iterable[str]) -> list[str]:
    """Lines that are not too long, each as far in as its declaration begins."""
    return [" " * (len(d) - len(d.lstrip())) + line for d in declarations for line in wrapped(d)]


def _arrays(variables: Sequence[Variable]) -> dict[str, list[Variable]]:
    """Scalars by the name of the vector that they belong to, or by their own."""
    found: dict[str, list[Variable]] = {}
    for v in variables:
        found.setdefault(v.name.partition("[")[0], []).append(v)
    return found


def _name(name: str) -> str:
    """``gyro_error.thermal_bias.kT`` as ``gyroThermalBias_kT``, ``at_rest`` as ``atRest``."""
    *above, last = name.replace("_error.", "_").split(".")
    return f"{camel('_'.join(above))}_{last}" if above else camel(last)


def _said(block: Block, v: Variable) -> str:
    """The description of a variable with the names that others have here."""
    text = v.description
    for name in _arrays((*block.inputs, *block.parameters, *block.outputs)):
        if "_" in name:
            text = re.sub(rf"\b{re.escape(name)}\b", _name(name), text)
    return capital(text)


def _short(text: str) -> str:
    """What a dialog has room for: the first clause of a long description."""
    if text[0].isdigit():
        return "What happened, as a sum of the numbers in the documentation"
    return text if len(text) <= SHORT else re.split(r"[.;:] ", text, maxsplit=1)[0]


def _elements(name: str, of: Sequence[Variable], me: str = "") -> list[str]:
    """The scalars of an array as they are written."""
    me = me or _name(name)
    return [me + v.name.removeprefix(name) for v in of]


def _attributes(of: Sequence[Variable]) -> tuple[str, str]:
    """Size and unit attribute of some variables."""
    units = [modelica_unit(v.unit) for v in of]
    if "[" not in of[0].name:
        return "", f'unit="{units[0]}"' if units[0] else ""
    size = "[" + of[-1].name.partition("[")[2]
    if None in units:
        return size, ""
    if len(set(units)) == 1:
        return size, f'each unit="{units[0]}"'
    return size, "unit={" + ", ".join(f'"{u}"' for u in units) + "}"


def _switches(uses: Iterable[str]) -> Iterator[str]:
    for use in uses:
        yield (
            f'parameter Boolean {use} = false "True where {OPTIONAL[use][0]}" '
            'annotation(Evaluate=true, choices(checkBox=true), Dialog(group="Inputs"));'
        )


def _parameter(block: Block, name: str, of: Sequence[Variable]) -> str:
    (first, *_), (size, unit) = of, _attributes(of)
    each = "each " if size else ""
    bounds = (("min", first.minimum), ("max", first.maximum))
    attributes = [a for a in (unit,) if a]
    attributes += [f"{each}{word}={number(at)}" for word, at in bounds if at is not None]
    start = numbers([v.start for v in of]) if size else number(first.start)
    said = _short(_said(block, first)) + ("" if unit else f" [{first.unit}]")
    group = "Start" if first.fixed else "Sensor" if "." in name else "Filter"
    shown = f"({', '.join(attributes)})" if attributes else ""
    return (
        f"parameter Real {_name(name)}{size}{shown} = {start}{comment(said)} "
        f'annotation(Dialog(group="{group}"));'
    )


def _inputs(
    block: Block, inputs: Mapping[str, list[Variable]], used: Mapping[str, str]
) -> Iterator[str]:
    """Those that are always there along the left edge, the others along the lower one."""
    always = [n for n in inputs if n not in used]
    for name, of in inputs.items():
        if name in used:
            at = list(used).index(name)
            origin = f"{round(-100 + 200 * (at + 1) / (len(used) + 1))},-120"
            place = f"extent={{{{-10,-10}},{{10,10}}}}, rotation=90, origin={{{origin}}}"
        else:
            high = round(100 - 200 * (always.index(name) + 1) / (len(always) + 1))
            place = f"extent={{{{-140,{high - 20}}},{{-100,{high + 20}}}}}"
        condition = f" if {used[name]}" if name in used else ""
        yield _connector(block, "Input", name, of, place, condition)


def _outputs(block: Block, outputs: Mapping[str, list[Variable]]) -> Iterator[str]:
    for at, (name, of) in enumerate(outputs.items()):
        high = round(100 - 200 * (at + 1) / (len(outputs) + 1))
        place = f"extent={{{{100,{high - 6}}},{{112,{high + 6}}}}}"
        yield _connector(block, "Output", name, of, place)


def _connector(
    block: Block,
    role: str,
    name: str,
    of: Sequence[Variable],
    place: str,
    condition: str = "",
) -> str:
    (size, unit), kind = _attributes(of), _CONNECTORS[of[0].kind]
    attributes = [unit] if unit and kind == "Real" else []
    if role == "Input" and not condition:
        start = numbers([v.start for v in of]) if size else number(of[0].start)
        attributes.append(f"start={start}")
    shown = f"({', '.join(attributes)})" if attributes else ""
    return (
        f"Modelica.Blocks.Interfaces.{kind}{role} {_name(name)}{size}{shown}{condition}"
        f"{comment(_short(_said(block, of[0])))} "
        f"annotation(Placement(transformation({place})));"
    )


def _hidden(
    block: Block,
    inputs: Mapping[str, list[Variable]],
    parameters: Mapping[str, list[Variable]],
    used: Mapping[str, str],
) -> Iterator[str]:
    for name in used:
        size, _ = _attributes(inputs[name])
        kind = _CONNECTORS[inputs[name][0].kind]
        yield f"Modelica.Blocks.Interfaces.{kind}Input {_name(name)}Used{size};"
    values = ", ".join(e for name, of in parameters.items() for e in _elements(name, of))
    yield (
        f"final parameter Real p[{len(block.parameters)}] = {{{values}}} "
        '"In the order of the co-simulation unit";'
    )
    yield f"{block.name}Memory memory = {block.name}Memory(samplePeriod, p);"
    yield 'discrete Real k(start=0, fixed=true) "Number of the sample; 0 is the start";'
    yield f'Real u[{len(block.inputs)}] "Inputs, in the order of the co-simulation unit";'
    yield f'discrete Real shown[{len(block.outputs)}] "Outputs, in that order";'


def _equations(
    block: Block,
    inputs: Mapping[str, list[Variable]],
    parameters: Mapping[str, list[Variable]],
    outputs: Mapping[str, list[Variable]],
    used: Mapping[str, str],
    function: str,
) -> Iterator[str]:
    for name, (first, *others) in parameters.items():
        yield from bound_asserts(
            block.name, _name(name), bool(others), first.minimum, first.maximum
        )
    for name, use in used.items():
        of, me = inputs[name], _name(name)
        size, _ = _attributes(of)
        rest = numbers([v.start for v in of]) if size else number(of[0].start)
        if of[0].kind == "boolean":
            rest = "true" if of[0].start else "false"
        yield f"connect({me}, {me}Used);"
        yield f"if not {use} then"
        yield f"  {me}Used = {rest};"
        yield "end if;"
    given = ", ".join(e for name, of in inputs.items() for e in _given(name, of, used))
    yield f"u = {{{given}}};"
    yield "when sample(samplePeriod, samplePeriod) then"
    yield "  k = pre(k) + 1;"
    yield f"  shown = {function}(memory, k, u);"
    yield "end when;"
    at = 0
    for name, of in outputs.items():
        elements = [f"shown[{at + i + 1}]" for i in range(len(of))]
        at += len(of)
        yield f"{_name(name)} = {_shown(of, elements)};"


def _given(name: str, of: Sequence[Variable], used: Mapping[str, str]) -> list[str]:
    me = _name(name) + ("Used" if name in used else "")
    if of[0].kind == "boolean":
        return [f"if {me} then 1 else 0"]
    return _elements(name, of, me)


def _shown(of: Sequence[Variable], elements: Sequence[str]) -> str:
    if of[0].kind == "boolean":
        return f"{elements[0]} > 0.5"
    if of[0].kind == "integer":
        return f"integer({elements[0]} + 0.5)"
    return elements[0] if "[" not in of[0].name else "{" + ", ".join(elements) + "}"


def _documentation(block: Block) -> str:
    """The page of a filter, with the descriptions that are too long for a dialog."""
    named = _arrays((*block.inputs, *block.parameters, *block.outputs))
    texts = {_name(name): _said(block, of[0]) for name, of in named.items()}
    rows = [
        f"<tr><td>{name}</td><td>{html.escape(text, quote=False)}.</td></tr>"
        for name, text in texts.items()
        if text != _short(text)
    ]
    what = (
        f"<p>{html.escape(block.description)}: the C of the co-simulation unit {block.name}, whose "
        "samples it gives. It needs a tool that calls external C, and its compiler; where there is "
        "none, import the unit.</p>"
    )
    when = (
        "<p>Sample k is made at the time k samplePeriod; before the first one the outputs are "
        "those of the start. Inputs that a model does not have stay switched off. Sources: "
        f"{SOURCES}.</p>"
    )
    return "\n".join([what, when, "<table>", *rows, "</table>"])


def c_prefix(name: str) -> str:
    """The beginning of the names in C of a part's filter."""
    return f"pyimu_{pascal(name).lower()}_ukf"
