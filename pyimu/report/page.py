"""The elements of the package's pages: tables, pictures and cells."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from pyimu.errors import Finding
from pyimu.report.curves import METADATA, Curves
from pyimu.report.findings import grouped
from pyimu.report.glossary import words_on
from pyimu.report.numbers import MISSING, in_unit, number, pretty, si_quantity, unit_for

COLUMNS, LETTERS = 5, 50
"""Columns, and letters of their heads, that stand side by side on a phone of 360 pixels."""


@dataclass(frozen=True)
class Table:
    """Head and rows of cells."""

    head: tuple[str, ...]
    rows: list[tuple] = field(default_factory=list)

    @property
    def wide(self) -> bool:
        """Whether its columns are too many for a phone, or their heads too long: there the cells of
        a row stand one below the other.
        """
        return len(self.head) > COLUMNS or len("".join(self.head)) > LETTERS


@dataclass(frozen=True)
class Picture:
    """An SVG, the line under it, and what it shows for who cannot see it."""

    svg: Markup
    caption: str
    alt: str
    small: bool = False

    @property
    def drawn(self) -> Markup:
        """The SVG without the numbers of its curves."""
        return Markup(METADATA.sub("", self.svg))

    @property
    def curves(self) -> Curves | None:
        """Its curves as numbers, None where it was drawn without."""
        found = METADATA.search(self.svg)
        return None if found is None else Curves(html.unescape(found[1]), found[2])

    @property
    def file(self) -> str:
        """Name of the file that its curves are downloaded as."""
        return "_".join(re.findall(r"\w+", self.alt)) + ".csv"


@lru_cache(maxsize=4)
def templates(package: str) -> Environment:
    """The templates of a package; ``page.html`` is what their pages extend, and explains their
    words.
    """
    own = [PackageLoader("pyimu.report", folder) for folder in ("templates", "vendor")]
    environment = Environment(
        loader=ChoiceLoader([PackageLoader(package, "templates"), *own]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals |= {"words_on": words_on, "missing": MISSING}
    environment.filters["command"] = command
    return environment


def prose(text: str) -> Markup:
    """A cell of prose, which may break into lines."""
    return words(_breakable(text))


def words(text: Markup) -> Markup:
    """The same of prose that has marks of its own."""
    return Markup('<span class="words">{}</span>').format(text)


OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")


def command(text: str) -> Markup:
    """A command as it was typed, whose options do not break behind their hyphens."""
    marks = ((at.start(), at.end()) for at in OPTION.finditer(text))
    said, before = Markup(""), 0
    for first, stop in marks:
        option = Markup('<span class="option">{}</span>').format(text[first:stop])
        said, before = said + escape(text[before:first]) + option, stop
    return said + escape(text[before:])


def file_name(name: str) -> Markup:
    """A cell with the name of a file, which may break behind underscores."""
    return Markup('<span class="file">{}</span>').format(_breakable(name))


def _breakable(text: str) -> Markup:
    """Text that may break behind underscores, as a name of three words must on a phone."""
    return Markup("<wbr>").join(map(command, re.findall(r"[^_]+_*|_+", text)))


def equation(latex: str) -> Markup:
    """An equation in LaTeX as MathML, which browsers draw by themselves."""
    from latex2mathml.converter import convert as latex_to_mathml

    return Markup(latex_to_mathml(latex).replace(' xmlns="http://www.w3.org/1998/Math/MathML"', ""))


def both(value: Any, si: str, unit: str | None = None) -> Markup:
    """A cell with a value in the people's unit and in SI."""
    if value is None or not np.isfinite(value):
        return Markup(MISSING)
    unit = unit or unit_for(value, si)
    shown = f"{number(float(in_unit(value, si, unit)))} {pretty(unit)}".rstrip()
    plain = si_quantity(value, si)
    return escape(shown) if plain == shown else Markup("{}<small>{}</small>").format(shown, plain)


def quality_table(*logs: tuple[str, Iterable[Finding]]) -> Table:
    """The findings of each log, by its name, and what they mean."""
    table = Table(("finding", "column", "count", "detail"))
    for name, findings in logs:
        where = f"{name}: " if len(logs) > 1 else ""
        for said in grouped(findings):
            about = Markup("{}<small>{}</small>").format(_breakable(said.detail), said.meaning)
            column = prose(f"{where}{said.columns or 'all'}")
            table.rows.append((said.kind, column, f"{said.count:,}", words(about)))
    return table
