"""Block to texts: the generated half of an FMU.

What no model knows is hand-written C in ``fmu_src``; what one model needs is generated here: its
functions in C (``step.c``), its table of variables (``model_table.h``), the prefix of its names
(``model_prefix.h``) and its descriptions. Equal blocks give equal texts.

An FMU has three forms: FMI 2 and FMI 3 with scalars, which every importer can connect, and FMI 3 in
blocks, whose inputs and outputs have a row for each sample of a step, and whose vectors and
matrices are arrays. The functions in C are the same.
"""

from __future__ import annotations

import hashlib
import json
import math
import unicodedata
import uuid
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Literal

import casadi as ca
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from pyimu.block.block import Block
from pyimu.block.c_code import c_code
from pyimu.errors import UserError
from pyimu.fmu.unit_definitions import unit_definitions
from pyimu.fmu.variables import (
    BLOCK_SIZE,
    DEFAULT_SEED,
    Entry,
    default_block_size,
    entries,
    most_samples,
    xml_number,
)
from pyimu.model.signals import EVERY_SAMPLE

CORE = (
    "block.c",
    "block.h",
    "block_core.h",
    "block_saved.c",
    "block_values.c",
    "model.h",
    "noise.c",
    "noise.h",
    "prefix.h",
)
"""Hand-written sources that every FMU shares."""

ARGUMENTS = 6
"""What the core gives to every step, whether it takes all of it or not."""

Form = Literal[2, 3, "block"]
"""A form of an FMU: its version of FMI where it has scalars, or "block", which is FMI 3, too."""

LAYER: dict[Form, str] = {2: "fmi2.c", 3: "fmi3.c", "block": "fmi3.c"}
"""The hand-written source of each form."""

TABLE: dict[Form, str] = {2: "model_table.h", 3: "model_table.h", "block": "model_table.block.h"}
"""The generated table of variables of each form; in its FMU it is called ``model_table.h``."""

DESCRIPTION: dict[Form, str] = {
    2: "modelDescription.fmi2.xml",
    3: "modelDescription.fmi3.xml",
    "block": "modelDescription.block.xml",
}

TERMINALS: dict[Form, str] = {
    3: "terminalsAndIcons.xml",
    "block": "terminalsAndIcons.block.xml",
}
"""What can be wired as a whole; FMI 2 has nothing of the kind."""

PAGE: dict[Form, str] = {2: "index.html", 3: "index.html", "block": "index.block.html"}

_LOG_CATEGORIES = (
    ("logStatusError", "refused calls and values; always told"),
    ("logEvents", "initialization and termination"),
)


def texts(block: Block, forms: Iterable[Form] = tuple(TABLE)) -> dict[str, str]:
    """The generated files of ``block`` for some ``forms`` of it: file name to text.

    Raises ValueError where the block cannot become an FMU: its name is no C identifier, a
    variable's name is taken twice, its functions are sparse or have one name; UserError where a
    unit is unknown, a text has a character that XML has not, a start value is not finite.
    """
    _check(block)
    step = render("step.c", _names(block) | {"functions": _functions_in_c(block)})
    files = {"step.c": step}
    files |= {name: render(name, _names(block) | {"sources": _c_files()}) for name in _COMMON}
    for table in sorted({TABLE[form] for form in forms}):
        files |= _with_tokens(table, step, _context(block, table == TABLE["block"]))
    return files


def _with_tokens(table: str, step: str, context: dict) -> dict[str, str]:
    """The files of a table of variables. A token stands for all that is generated for a version of
    FMI: what differs in anything gets another one, and so do the two versions of one unit.
    """
    files = _render(table, context | {"tokens": {v: f"token of FMI {v}" for v in (2, 3)}})
    for version in (2, 3):
        token = _token([f"FMI {version}", table, step, *files.values()])
        files = {n: text.replace(f"token of FMI {version}", token) for n, text in files.items()}
    return files


def write_generated(block: Block, folder: Path | str) -> list[Path]:
    """Write the generated files of ``block`` to ``folder``; gives their paths.

    The folder is made if needed.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, text in texts(block).items():
        written.append(folder / name)
        written[-1].write_text(text, encoding="utf-8", newline="\n")
    return written


def _check(block: Block) -> None:
    if not (block.name.isascii() and block.name.isidentifier()):
        raise ValueError(f"block {block.name!r}: the name of an FMU must be a C identifier")
    _check_texts(block)
    names = [e.name for e in entries(block, False)] + [BLOCK_SIZE]
    twice = sorted({n for n in names if names.count(n) > 1})
    if twice:
        raise ValueError(f"block {block.name}: more than one variable is called {', '.join(twice)}")
    called = [f.name() for f in _functions(block)]
    if len(set(called)) < len(called):
        raise ValueError(
            f"block {block.name}: step, constants, initial and limits need names of their own, not "
            f"{', '.join(called)}"
        )
    for function in _functions(block):
        sparsities = [function.sparsity_in(i) for i in range(function.n_in())]
        sparsities += [function.sparsity_out(i) for i in range(function.n_out())]
        if not all(s.is_dense() for s in sparsities):
            raise ValueError(
                f"block {block.name}: {function.name()} has a sparse argument or result; densify it"
            )


def _check_texts(block: Block) -> None:
    """Raise UserError for a text that cannot stand in an XML file, or would harm a terminal that
    shows it, and for a start value that a unit would not take back.
    """
    variables = [*block.inputs, *block.parameters, *block.outputs]
    names = [*(v.name for v in variables), *(channel.name for channel in block.noise)]
    described = [block.description, *(v.description for v in variables)]
    for text in (*names, *described, *(block.limits.texts if block.limits else ())):
        for character in text:
            if unicodedata.category(character) in ("Cc", "Cn", "Cs"):
                raise UserError(
                    f"block {block.name}: {text!r} has the character {character!r}, which a "
                    "name or a description must not have"
                )
    for v in variables:
        if not math.isfinite(v.start):
            raise UserError(f"block {block.name}: {v.name} must start finite, not at {v.start}")


def _names(block: Block) -> dict:
    """What the texts call the block and its functions."""
    return {
        "name": block.name,
        "step": _step(block).name(),
        "constants": block.prepared and block.prepared.constants,
        "initial": block.initial.name(),
        "limits": block.limits,
    }


def _context(block: Block, in_blocks: bool) -> dict:
    variables = entries(block, in_blocks)
    functions = _functions(block)
    size = default_block_size(block) if in_blocks else None
    return _names(block) | {
        "description": block.description,
        "every_sample": EVERY_SAMPLE,
        "differences": any(EVERY_SAMPLE in v.description for v in block.parameters),
        "sample_period": block.sample_period,
        "seed": DEFAULT_SEED,
        "noise": block.noise,
        "variables": variables,
        "outputs": [e for e in variables if e.role == "output"],
        "units": unit_definitions((e.unit, e.display_unit) for e in variables if e.unit),
        "terminals": _terminals(variables),
        "stop_time": block.stop_time,
        "sources": _c_files(),
        "log_categories": _LOG_CATEGORIES,
        "block_size": size,
        "most_samples": most_samples(block),
        "step_size": block.sample_period * (size or 1),
        "input_starts": [v.start for v in block.inputs],
        "parameter_starts": [v.start for v in block.parameters],
        "sizes": {
            "inputs": len(block.inputs),
            "parameters": len(block.parameters),
            "outputs": len(block.outputs),
            "states": block.n_state,
            "constants": block.prepared.constants.numel_out(0) if block.prepared else 0,
            "noise": len(block.noise),
        },
        "work": {
            what: max(least, *(getattr(f, f"sz_{what}")() for f in functions))
            for what, least in (("arg", ARGUMENTS), ("res", 0), ("iw", 0), ("w", 0))
        },
    }


def _c_files() -> dict[Form, list[str]]:
    return {
        form: sorted([*(f for f in CORE if f.endswith(".c")), layer, "step.c"])
        for form, layer in LAYER.items()
    }


def _terminals(outer: Iterable[Entry]) -> dict[str, list[Entry]]:
    """Name of a terminal to its members."""
    found: dict[str, list[Entry]] = {}
    for e in outer:
        if e.variable.terminal:
            found.setdefault(e.variable.terminal, []).append(e)
    return found


def _functions_in_c(block: Block) -> str:
    """The block's functions in C.

    Casadi's own integer type is kept, as its loader needs it.
    """
    return c_code(block.name, _functions(block))


def _functions(block: Block) -> tuple[ca.Function, ...]:
    constants = (block.prepared.constants,) if block.prepared else ()
    limits = (block.limits.broken,) if block.limits else ()
    return (_step(block), block.initial, *constants, *limits)


def _step(block: Block) -> ca.Function:
    """The step as a unit has it, which computes its constants once for many samples."""
    return block.prepared.step if block.prepared else block.step


def _token(contents: Iterable[str]) -> str:
    digest = hashlib.sha256("\0".join(contents).encode()).digest()
    return "{" + str(uuid.UUID(bytes=digest[:16])) + "}"


_COMMON = ("model_prefix.h", "buildDescription.xml")
"""Generated files that every form shares, which hold nothing of a variable."""

_TEMPLATES: dict[str, dict[str, str]] = {
    TABLE[2]: {
        "model_table.h": "model_table.h",
        "modelDescription.fmi2.xml": "modelDescription.fmi2.xml",
        "modelDescription.fmi3.xml": "modelDescription.fmi3.xml",
        TERMINALS[3]: "terminalsAndIcons.xml",
        "index.html": "index.html",
    },
    TABLE["block"]: {
        TABLE["block"]: "model_table.h",
        DESCRIPTION["block"]: "modelDescription.fmi3.xml",
        TERMINALS["block"]: "terminalsAndIcons.xml",
        PAGE["block"]: "index.html",
    },
}
"""Of each table of variables, the generated files and the templates that they are made from."""


def _render(table: str, context: dict) -> dict[str, str]:
    return {name: render(of, context) for name, of in _TEMPLATES[table].items()}


def render(template: str, context: dict) -> str:
    """A text from one of the package's templates."""
    return _environment().get_template(template).render(context)


@cache
def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(template_folder()),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=lambda name: name is not None and name.endswith(("xml", "html", "ssd", "ssv")),
    )
    environment.filters |= {
        "xml_number": xml_number,
        "c_number": _c_number,
        "c_string": _c_string,
        "add_one": lambda n: n + 1,
    }
    return environment


def template_folder() -> Path:
    return Path(__file__).resolve().parent / "templates"


def _c_string(text: str) -> str:
    """In UTF-8, without what C11 takes for a trigraph."""
    return json.dumps(text, ensure_ascii=False).replace("??", '?""?')


def _c_number(x: float) -> str:
    x = float(x)
    return (
        repr(x)
        if math.isfinite(x)
        else "NAN"
        if math.isnan(x)
        else "INFINITY"
        if x > 0
        else "-INFINITY"
    )
