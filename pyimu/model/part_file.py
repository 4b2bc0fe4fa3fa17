"""Part files: TOML with coefficients, units and sources, read to SI and written back.

One table per effect, one entry per parameter::

    name = "imt30"
    sample_rate = {value = 976.0, unit = "Hz"}

    [gyro.angle_random_walk]
    N = {value = [0.208, 0.239, 0.205], unit = "deg/sqrt(h)", source = "Hidalgo 2012, table 2"}

    [accel.angle_random_walk]
    N = {value = 60.0, unit = "ug/sqrt(Hz)", density = "one-sided", source = "data sheet, table 1"}

    [gyro]
    g_sensitivity = "estimate"

    [tolerance.gyro.turn_on_bias]
    b0 = {value = 20.0, unit = "deg/s", distribution = "uniform", source = "data sheet, table 1"}

A plain number stands for all three axes; a matrix is written as nested lists or row by row. The
value ``"estimate"`` leaves a coefficient to the data. A ``density`` that is one-sided, as a data
sheet's is, is divided by sqrt(2). What stands beside a value (unit, source, figure as quoted) is
kept in ``Part.notes``. A ``tolerance`` says how far specimens lie from the part in a coefficient,
within the value (uniform) or with it for a standard deviation (normal); one number stands for every
element, of a matrix too. ``Part.specimen`` draws from them.
"""

from __future__ import annotations

import itertools
import os
import re
from importlib.resources import files
from pathlib import Path

from pyimu.errors import UserError, printable
from pyimu.files import exists, read_toml, shortened, write_text
from pyimu.model.part import Part
from pyimu.model.part_reader import meant, parse_part, part_of
from pyimu.model.part_writer import format_part


def part_names() -> tuple[str, ...]:
    """Names of the built-in parts."""
    return tuple(
        sorted(
            f.name.removesuffix(".toml")
            for f in files("pyimu.model").joinpath("parts").iterdir()
            if f.name.endswith(".toml")
        )
    )


def part(name_or_path: str | os.PathLike | Part) -> Part:
    """A built-in part by its name, or the part in a TOML file; a ``Part`` is given back as it is.

    Raises UserError where there is no such part, or the file says something that is no part.
    """
    if isinstance(name_or_path, Part):
        return name_or_path
    if not isinstance(name_or_path, (str, os.PathLike)):
        raise UserError(
            f"a part is a Part, the name of one or a TOML file, not {str(name_or_path)[:40]!r}"
        )
    name, path = str(name_or_path), Path(name_or_path)
    if name in part_names():
        return parse_part(_built_in(name), f"{name}.toml")
    if path.suffix == ".toml" or exists(path):
        return load_part(path)
    raise UserError(
        f"{shortened(name)}: no built-in part and no TOML file; {meant(name, part_names())}"
    )


def _built_in(name: str) -> str:
    """The text of a built-in part's file."""
    return files("pyimu.model").joinpath("parts", f"{name}.toml").read_text(encoding="utf-8")


def remarks(name_or_path: str | os.PathLike | Part) -> str:
    """The comment at the head of a part's file: its setting, and which figures were not found.

    Empty for a ``Part``, which has no file, and for a file without. Raises as ``part``.
    """
    part(name_or_path)
    if isinstance(name_or_path, Part):
        return ""
    name = str(name_or_path)
    text = _built_in(name) if name in part_names() else Path(name).read_text(encoding="utf-8")
    head = itertools.takewhile(lambda line: line.startswith("#"), text.splitlines())
    return printable(" ".join(" ".join(line.lstrip("# ") for line in head).split()))


def new_part(name: str, folder: str | os.PathLike = ".") -> Path:
    """Write ``NAME.toml``, a part to fill in: a place for each figure of a data sheet.

    Raises UserError for a name that is taken by a built-in part or is no file's name, and where
    there is such a file already.
    """
    if not re.fullmatch(r"[A-Za-z0-9][\w.+-]*", name):
        raise UserError(
            f"{name!r}: a part's name has letters, digits, '-', '_' and '.', as in mypart"
        )
    name = name.removesuffix(".toml")
    path = Path(folder) / f"{name}.toml"
    if name in part_names():
        raise UserError(f"{name} is a built-in part (pyimu parts {name}); give yours another name")
    if path.exists():
        raise UserError(f"{path}: is there already; give another name, or take that file away")
    text = files("pyimu.model").joinpath("part_template.toml").read_text(encoding="utf-8")
    write_text(path, text.replace("NAME", name))
    return path


def load_part(path: str | os.PathLike) -> Part:
    """The part in a TOML file.

    Raises UserError, with file and key, where it cannot be read or is not a valid part.
    """
    return part_of(read_toml(Path(path)), str(path))


def save_part(part: Part, path: str | os.PathLike) -> Path:
    """Write a part to a TOML file, which reads back as an equal part.

    The file is written whole or not at all.

    Each value is written in the unit in which its note quotes it, else in SI. Raises UserError
    where the file cannot be written.
    """
    path = Path(path)
    write_text(path, format_part(part))
    return path
