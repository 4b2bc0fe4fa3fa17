"""Modelica files from their templates."""

from __future__ import annotations

import re
import textwrap
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from pyimu.modelica.names import string

GENERATED = "// Written by `make generate` from the definitions in pyimu; do not edit.\n"
"""How a file begins that nobody edits."""

LINE = 100
"""Characters in a line of a generated file, about."""


def rendered(template: str, **values: Any) -> str:
    """A template filled in."""
    return _templates().get_template(template).render(**values).strip("\n") + "\n"


def wrapped(line: str, width: int = LINE - 6) -> list[str]:
    """A declaration, an equation or a statement in lines that are not too long.

    It is broken between words, not within a string.
    """
    lines: list[str] = []
    for piece in re.findall(r'(?:[^ "]|"[^"]*")+', line):
        if lines and len(lines[-1]) + 1 + len(piece) <= width:
            lines[-1] += f" {piece}"
        else:
            lines.append(f"  {piece}" if lines else piece)
    return lines


def comment(text: str) -> str:
    """Text as the description behind a declaration; nothing for none."""
    return f' "{string(text)}"' if text else ""


def capital(text: str) -> str:
    """Text that begins a sentence."""
    return text[:1].upper() + text[1:]


def numbers(values: Any) -> str:
    """Nested lists of numbers as an array; what is one number throughout as ``fill``."""
    if isinstance(values, list):
        return "{" + ", ".join(numbers(v) for v in values) + "}"
    return number(float(values))


def number(value: float) -> str:
    """The shortest decimal that reads back as the same double, whole numbers without a point."""
    return str(int(value)) if value == int(value) and abs(value) < 1e6 else repr(value)


def _folded(line: str, indent: int) -> str:
    """A line of a class, in several where it is long."""
    return ("\n" + " " * indent).join(wrapped(line.strip(), LINE - indent))


def _page(text: str) -> str:
    """HTML as a Modelica string, each paragraph in lines that are not too long."""
    lines = (
        textwrap.wrap(p, LINE, break_long_words=False, break_on_hyphens=False)
        for p in text.splitlines()
    )
    return string("\n".join(line for paragraph in lines for line in paragraph))


@cache
def _templates() -> Environment:
    found = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    found.filters.update(
        text=string,
        comment=comment,
        capital=capital,
        folded=_folded,
        page=_page,
        outdented=lambda text: re.sub(r"^  ", "", text, flags=re.MULTILINE),
    )
    return found
