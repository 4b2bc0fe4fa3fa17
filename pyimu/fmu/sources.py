"""Block to texts: the generated half of an FMU.

What no model knows is hand-written C in ``fmu_src``; what one model needs is generated here: its functions in C
(``step.c``), its table of variables (``model_table.h``) and its descriptions.  Equal blocks give equal texts.
"""

from __future__ import annotations

import hashlib
import json
import math
import uuid
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import casadi as ca
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from pyimu.block import Block, Variable
from pyimu.units import BASES, ZERO_CELSIUS, parse

CORE = ("block.c", "block.h", "noise.c", "noise.h")
"""Hand-written sources that every FMU shares."""

LAYER = {2: "fmi2.c", 3: "fmi3.c"}
"""The hand-written source of each FMI version."""

DEFAULT_SEED = 0

_LOG_CATEGORIES = (("logStatusError", "refused calls and values; always told"), ("logEvents", "initialization and termination"))

_IN_BASE_UNITS = {"rad": {"rad": 1}, "s": {"s": 1}, "m": {"m": 1}, "K": {"K": 1},
                  "V": {"kg": 1, "m": 2, "s": -3, "A": -1}, "T": {"kg": 1, "s": -2, "A": -1}}
"""The bases of ``pyimu.units`` in those of FMI."""

_CAUSALITY = {"time": {"causality": "independent", "variability": "continuous"},
              "input": {"causality": "input", "variability": "continuous"},
              "tunable": {"causality": "parameter", "variability": "tunable", "initial": "exact"},
              "fixed": {"causality": "parameter", "variability": "fixed", "initial": "exact"},
              "output": {"causality": "output", "variability": "discrete", "initial": "calculated"}}

_TYPES = {"real": ("Real", "Float64"), "boolean": ("Boolean", "Boolean"), "integer": ("Integer", "Int32"),
          "seed": ("Integer", "UInt64")}

_ROLE_TEXTS = {"time": "independent", "input": "input", "tunable": "parameter, tunable", "fixed": "parameter, fixed",
               "output": "output"}


@dataclass(frozen=True)
class Entry:
    """One row of the table of variables; ``reference`` is its place there and its value reference."""

    reference: int
    role: str
    kind: str
    variable: Variable
    initial_dependencies: tuple[int, ...] = ()
    """Value references of the parameters that an output's value before the first sample follows from."""
    sample_dependencies: tuple[str, ...] = ()
    """Names of the inputs that an output's value at a sample follows from."""
    causality: dict[str, str] = field(init=False)

    def __post_init__(self) -> None:
        causality = dict(_CAUSALITY[self.role])
        if self.role == "input" and self.kind != "real":
            causality["variability"] = "discrete"
        object.__setattr__(self, "causality", causality)

    @property
    def name(self) -> str:
        return self.variable.name

    @property
    def description(self) -> str:
        return self.variable.description

    @property
    def start(self) -> float:
        return self.variable.start

    @property
    def unit(self) -> str | None:
        return self.variable.unit if self.kind == "real" else None

    @property
    def role_text(self) -> str:
        return _ROLE_TEXTS[self.role]

    @property
    def kind_text(self) -> str:
        return "integer" if self.kind == "seed" else self.kind

    @property
    def attributes(self) -> dict[str, str]:
        """The XML attributes of the variable's type: unit, bounds, start value."""
        v = self.variable
        bounds = {} if self.kind == "boolean" else {"min": v.minimum, "max": v.maximum}
        start = None if self.role in ("time", "output") else v.start
        given = {name: self._text(value) for name, value in (bounds | {"start": start}).items() if value is not None}
        return ({"unit": self.unit} if self.unit else {}) | given

    def _text(self, value: float) -> str:
        if self.kind == "boolean":
            return "true" if value else "false"
        return _xml_number(value) if self.kind == "real" else str(int(value))

    def type(self, version: int) -> str:
        return _TYPES[self.kind][version - 2]


def texts(block: Block) -> dict[str, str]:
    """The generated files of ``block``: file name to text.

    Raises ValueError where the block cannot become an FMU: its name is no C identifier, a variable's name is
    taken twice, its functions are sparse or have one name; UserError where a unit is unknown.
    """
    _check(block)
    context = _context(block)
    step = _step_source(block)
    # The token stands for the content: what differs in any generated file gets another one.
    blank = _render(context | {"token": ""})
    token = _token([step, *blank.values()])
    return {"step.c": step} | _render(context | {"token": token})


def write_generated(block: Block, folder: Path | str) -> list[Path]:
    """Write the generated files of ``block`` to ``folder``, which is made if needed; gives their paths."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, text in texts(block).items():
        written.append(folder / name)
        written[-1].write_text(text, encoding="utf-8", newline="\n")
    return written


def source_folder() -> Path:
    """The hand-written C: ``fmu_src`` beside the package in a checkout, inside it in an installed wheel."""
    package = Path(__file__).resolve().parents[1]
    for folder in (package / "fmu_src", package.parent / "fmu_src"):
        if (folder / CORE[0]).is_file():
            return folder
    raise FileNotFoundError(f"the C sources fmu_src are neither in {package} nor beside it")


def _check(block: Block) -> None:
    if not (block.name.isascii() and block.name.isidentifier()):
        raise ValueError(f"block {block.name!r}: the name of an FMU must be a C identifier")
    names = [e.name for e in _entries(block)]
    twice = sorted({n for n in names if names.count(n) > 1})
    if twice:
        raise ValueError(f"block {block.name}: more than one variable is called {', '.join(twice)}")
    if block.step.name() == block.initial.name():
        raise ValueError(f"block {block.name}: step and initial are both called {block.step.name()}")
    for function in (block.step, block.initial):
        sparsities = [function.sparsity_in(i) for i in range(function.n_in())]
        sparsities += [function.sparsity_out(i) for i in range(function.n_out())]
        if not all(s.is_dense() for s in sparsities):
            raise ValueError(f"block {block.name}: {function.name()} has a sparse argument or result; densify it")


def _entries(block: Block) -> list[Entry]:
    """The table of variables: time, inputs, parameters, outputs, sample period, seed."""
    time = Variable("time", "s", "simulation time")
    period = Variable("sample_period", "s", "time between two samples", start=block.sample_period, minimum=0.0)
    seed = Variable("seed", "1", "seed of the noise: other seeds, independent noise", start=DEFAULT_SEED, minimum=0.0)
    roles = [("time", [time]), ("input", block.inputs), ("tunable", block.parameters), ("output", block.outputs),
             ("fixed", [period, seed])]
    rows = [(role, v) for role, group in roles for v in group]
    first_parameter, first_output = 1 + len(block.inputs), 1 + len(block.inputs) + len(block.parameters)
    initial, sample = _dependencies(block.initial, 1, 0), _dependencies(block.step, 1, 1)
    entries = []
    for reference, (role, v) in enumerate(rows):
        row = reference - first_output if role == "output" else None
        entries.append(Entry(reference, role, "seed" if v is seed else v.kind, v,
                             tuple(first_parameter + i for i in initial.get(row, ())),
                             tuple(block.inputs[i].name for i in sample.get(row, ()))))
    return entries


def _dependencies(function: ca.Function, output: int, argument: int) -> dict[int, list[int]]:
    """Row of the output to the sorted rows of the argument that it depends on."""
    depends: dict[int, list[int]] = {}
    if function.numel_out(output) and function.numel_in(argument):
        for row, column in sorted(zip(*function.jac_sparsity(output, argument).get_triplet())):
            depends.setdefault(row, []).append(column)
    return depends


def _context(block: Block) -> dict:
    entries = _entries(block)
    functions = (block.step, block.initial)
    sources = {version: sorted([*(f for f in CORE if f.endswith(".c")), layer, "step.c"]) for version, layer in LAYER.items()}
    return {
        "name": block.name, "description": block.description, "step": block.step.name(), "initial": block.initial.name(),
        "sample_period": block.sample_period, "seed": DEFAULT_SEED, "noise": block.noise, "variables": entries,
        "outputs": [e for e in entries if e.role == "output"], "units": _units(entries), "sources": sources,
        "log_categories": _LOG_CATEGORIES,
        "sizes": {"inputs": len(block.inputs), "parameters": len(block.parameters), "outputs": len(block.outputs),
                  "states": block.n_state, "noise": len(block.noise)},
        "work": {what: max(getattr(f, f"sz_{what}")() for f in functions) for what in ("arg", "res", "iw", "w")},
    }


def _units(entries: Iterable[Entry]) -> list[dict]:
    """The units in use: name, and base unit attributes or None where an exponent is no integer, as FMI cannot say that."""
    names = sorted({e.unit for e in entries if e.unit})
    return [{"name": name, "base": _base_unit(name)} for name in names]


def _base_unit(name: str) -> dict[str, str] | None:
    unit = parse(name)
    exponents: dict[str, int] = {}
    for base, exponent in zip(BASES, unit.dimension):
        if exponent.denominator != 1:
            return None
        for si, power in _IN_BASE_UNITS[base].items():
            exponents[si] = exponents.get(si, 0) + power * int(exponent)
    attributes = {si: str(power) for si, power in exponents.items() if power}
    if unit.factor != 1.0:
        attributes["factor"] = _xml_number(unit.factor)
    if name == "degC":  # the temperature itself; within a quotient it is a difference
        attributes["offset"] = _xml_number(ZERO_CELSIUS)
    return attributes


def _step_source(block: Block) -> str:
    """The block's two functions in C, as casadi writes them; casadi's own integer type is kept, as its loader needs it."""
    generator = ca.CodeGenerator(block.name)
    generator.add(block.step)
    generator.add(block.initial)
    return generator.dump()


def _token(contents: Iterable[str]) -> str:
    digest = hashlib.sha256("\0".join(contents).encode()).digest()
    return "{" + str(uuid.UUID(bytes=digest[:16])) + "}"


_TEMPLATES = ("model_table.h", "modelDescription.fmi2.xml", "modelDescription.fmi3.xml", "buildDescription.xml", "index.html")


def _render(context: dict) -> dict[str, str]:
    return {name: _environment().get_template(name).render(context) for name in _TEMPLATES}


@cache
def _environment() -> Environment:
    environment = Environment(loader=FileSystemLoader(template_folder()), undefined=StrictUndefined, trim_blocks=True,
                              lstrip_blocks=True, keep_trailing_newline=True,
                              autoescape=lambda name: name is not None and name.endswith(("xml", "html")))
    environment.filters |= {"xml_number": _xml_number, "c_number": _c_number, "c_string": json.dumps, "add_one": lambda n: n + 1}
    return environment


def template_folder() -> Path:
    return Path(__file__).resolve().parent / "templates"


def _xml_number(x: float) -> str:
    """The shortest decimal that reads back as the same double, with XML's names for what is no number."""
    x = float(x)
    return repr(x) if math.isfinite(x) else "NaN" if math.isnan(x) else "INF" if x > 0 else "-INF"


def _c_number(x: float) -> str:
    x = float(x)
    return repr(x) if math.isfinite(x) else "NAN" if math.isnan(x) else "INFINITY" if x > 0 else "-INFINITY"
