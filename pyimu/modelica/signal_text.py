"""The signals that follow from the course of others, as packages of Modelica."""

from __future__ import annotations

import casadi as ca

from pyimu.model.signals import LONGEST_HOLD, SIGNALS, VIBRATION_TIME
from pyimu.modelica.effect_functions import STARTED
from pyimu.modelica.functions import Argument, Function, array, function
from pyimu.modelica.names import camel, pascal
from pyimu.modelica.text import GENERATED, capital, comment, number, rendered, wrapped
from pyimu.modelica.unit_names import modelica_unit

DERIVED = tuple(name for name, s in SIGNALS.items() if s.derived)
"""Names of the signals that have a package."""

MEMORY = "memory"


def signal_functions(name: str) -> tuple[Function, Function | None]:
    """The functions that give a signal's value, and its memory at the next sample if it has one."""
    signal, what = SIGNALS[name], f"signal {name}"
    memory, h = ca.SX.sym(MEMORY, signal.memory), ca.SX.sym("h")
    started = ca.SX.sym(STARTED)
    inputs = [ca.SX.sym(n, SIGNALS[n].size) for n in signal.of]
    value, after = signal.advance(memory, started, h, *inputs)
    arguments = [
        array(camel(n), _shape(n), symbol) for n, symbol in zip(signal.of, inputs, strict=True)
    ]
    arguments += [array(MEMORY, (signal.memory,), memory)] if signal.memory else []
    arguments.append(Argument(STARTED, (), started, ((),), boolean=True))
    arguments.append(array("h", (), h))
    own = camel(name)
    output = function(
        f"{own}Signal", signal.text, arguments, value, _shape(name), what, positive={"h"}
    )
    if not signal.memory:
        return output, None
    return output, function(
        f"{own}SignalNextMemory",
        "memory of the next sample",
        arguments,
        after,
        (signal.memory,),
        what,
        result="following",
        positive={"h"},
    )


def _shape(name: str) -> tuple[int, ...]:
    return (SIGNALS[name].size,) if SIGNALS[name].size > 1 else ()


def signal_text(name: str) -> str:
    """The file of a derived signal."""
    signal, (output, following) = SIGNALS[name], signal_functions(name)
    given = {MEMORY: f"pre({MEMORY})", STARTED: f"pre({STARTED})", "h": "samplePeriod"}
    states = []
    equations = [f"y = {output.call(given)};"]
    if following is not None:
        states = [
            f"discrete Real {MEMORY}[{signal.memory}](each start=0, each fixed=true);",
        ]
        equations.append(f"{MEMORY} = {following.call(given)};")
        if any(a.name == STARTED for f in (output, following) for a in f.arguments):
            states.append(f"Boolean {STARTED}(start=false, fixed=true);")
            equations.append(f"{STARTED} = true;")
    return GENERATED + rendered(
        "signal.mo",
        name=pascal(name),
        description=signal.text,
        functions=[f for f in (output, following) if f is not None and not f.plain],
        declarations=[line for d in _connectors(name) for line in wrapped(d)],
        states=states,
        equations=[line for q in equations for line in wrapped(q)],
        documentation=_documentation(name),
    )


def _connectors(name: str) -> list[str]:
    signal = SIGNALS[name]
    found = []
    for i, of in enumerate(signal.of):
        place = round(100 - 200 * (i + 1) / (len(signal.of) + 1))
        found.append(_connector("Input", camel(of), of, -120, place, 20))
    return [*found, _connector("Output", "y", name, 110, 0, 10)]


def _connector(kind: str, name: str, of: str, x: int, y: int, half: int) -> str:
    signal, size = SIGNALS[of], SIGNALS[of].size
    start = "{" + ", ".join(map(number, signal.start)) + "}" if size > 1 else signal.start[0]
    dimension, each = (f"[{size}]", "each ") if size > 1 else ("", "")
    return (
        f"Modelica.Blocks.Interfaces.Real{kind} {name}{dimension}({each}"
        f'unit="{modelica_unit(signal.unit)}", start={start}){comment(capital(signal.text))} '
        f"annotation(Placement(transformation(extent={{{{{x - half},{y - half}}},"
        f"{{{x + half},{y + half}}}}})));"
    )


def _documentation(name: str) -> str:
    signal = SIGNALS[name]
    of = ", ".join(camel(n) for n in signal.of) or "the number of the sample"
    notes = {
        "temperature_rate": f"A temperature that has rested for more than {LONGEST_HOLD:g} s "
        "changes as if it had rested so long.",
        "vibration": f"Both means have a time constant of {VIBRATION_TIME:g} s.",
    }
    first = ["At the first sample it is zero."] if signal.difference else []
    text = [f"{capital(signal.text)}, sample by sample, from {of}.", *first]
    return f"<p>{' '.join([*text, notes.get(name, '')]).strip()}</p>"
