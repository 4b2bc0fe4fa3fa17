"""Write ``docs/api.md``, the names of the package with their signatures and docstrings.

``python docs/build/api_page.py``; a test keeps the page fresh.
"""

from __future__ import annotations

import inspect
import re
from functools import cached_property
from types import ModuleType

from pages import DOCS, write_changed

import pyimu

HEAD = """# Python

Written by `make generate` from the docstrings; do not edit. `help(pyimu)` says the same, with the
conventions of units and frames.
"""

ROLE = re.compile(r"``([^`]+)``")


def text() -> str:
    """The page."""
    names = [n for n in sorted(pyimu.__all__, key=str.lower) if not n.startswith("_")]
    things = {n: getattr(pyimu, n) for n in names}
    calls = [_section(f"pyimu.{n}", v) for n, v in things.items() if inspect.isroutine(v)]
    classes = [_class(f"pyimu.{n}", v) for n, v in things.items() if inspect.isclass(v)]
    rooms = [_module(n, v) for n, v in things.items() if isinstance(v, ModuleType)]
    parts = ["## Functions", *calls, "## Classes", *classes, "## Modules", *rooms]
    return "\n".join([HEAD, *parts]).rstrip() + "\n"


def _section(name: str, call: object) -> str:
    """A function: its signature and what it says of itself."""
    return f"### `{name}`\n\n```python\n{name}{_signature(call)}\n```\n\n{_doc(call)}"


def _signature(call: object) -> str:
    try:
        written = str(inspect.signature(call))
        return re.sub(r"<(function|\S+ object).*? at 0x\w+>", "...", written).replace("'", "")
    except ValueError:
        return "(...)"


def _doc(thing: object) -> str:
    return ROLE.sub(r"`\1`", inspect.getdoc(thing) or "").replace("::\n", ":\n") + "\n"


def _class(name: str, cls: type) -> str:
    """A class: what it says of itself, and its own methods and properties."""
    rows = []
    for key, member in inspect.getmembers(cls):
        is_property = isinstance(member, (property, cached_property))
        behind = _behind(member) if is_property else member
        described = is_property or inspect.isroutine(member)
        where = getattr(behind, "__module__", None) or ""
        if key.startswith("_") or not described or not where.startswith("pyimu"):
            continue
        call = "" if is_property else "()"
        first = (inspect.getdoc(member) or "").partition("\n\n")[0].replace("\n", " ")
        said = ROLE.sub(r"`\1`", first)
        rows.append(f"- `{key}{call}`" + (f": {said}" if said else ""))
    return "\n".join([f"### `{name}`", "", _doc(cls), *rows, *([""] if rows else [])])


def _behind(member: property | cached_property) -> object:
    """The function of a property."""
    return member.fget if isinstance(member, property) else member.func


def _module(name: str, module: ModuleType) -> str:
    return f"### `pyimu.{name}`\n\n{_doc(module)}"


if __name__ == "__main__":
    if write_changed(DOCS / "api.md", text()):
        print(DOCS / "api.md")
