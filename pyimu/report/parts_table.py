"""The listing of all built-in parts, and one part with the source of each figure.

Units are spelled as in a part file, so that a figure can be copied back. N is the root of the
two-sided density; the figure that a data sheet prints as a density is one-sided, sqrt(2) larger,
and stands under ``quoted``.
"""

from __future__ import annotations

import io
import shutil
import sys
import textwrap
from collections.abc import Iterable
from typing import Any

import numpy as np

from pyimu.files import plain
from pyimu.model.part import Part
from pyimu.model.part_entry import RATE_KEY
from pyimu.model.part_file import part, part_names, remarks
from pyimu.report.numbers import in_unit, number, told_apart, unit_for

ABSENT = "-"
"""Printed where a part says nothing."""

COLUMNS = (
    ("N", "gyro", "angle_random_walk", "N", "deg/sqrt(h)"),
    ("B", "gyro", "bias_instability", "B", "deg/h"),
    ("range", "gyro", "saturation", "limit", "deg/s"),
    ("N", "accel", "angle_random_walk", "N", "ug/sqrt(Hz)"),
    ("B", "accel", "bias_instability", "B", "ug"),
    ("range", "accel", "saturation", "limit", "g"),
)
"""What the listing compares: heading, sensor, effect, parameter, and one unit for all parts."""

SAID = ("quoted", "source")
"""What the notes of a coefficient say beside its value."""

WRAPPED = 100
"""Characters of a line of remarks, at most."""

LEAST = 18
"""Characters of a column with text; the words in it are not longer."""

SIDES = "N is the root of the two-sided density; a data sheet's one-sided figure is sqrt(2) larger."
"""Below what is printed of parts."""

UNLIMITED = 10_000
"""Characters; wider than any line here."""


def listing(parts: Iterable[Part] | None = None, width: int | None = None) -> str:
    """One line for each part: rate, noise, bias instability and range.

    ``parts`` are the built-in ones unless given.

    ``width`` is that of the terminal, None for as wide as it gets; figures are never cut, only
    descriptions are folded.
    """
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), title_justify="left")
    table.add_column("part\n\n", no_wrap=True)
    table.add_column("rate\n\nHz", justify="right", no_wrap=True)
    for heading, kind, _, _, unit in COLUMNS:
        table.add_column(f"{kind}\n{heading}\n{unit}", justify="right", no_wrap=True)
    table.add_column("description\n\n")
    for p in map(part, part_names()) if parts is None else parts:
        figures = [_figure(p, *column[1:]) for column in COLUMNS]
        table.add_row(p.name, f"{p.sample_rate:.10g}", *figures, p.description)
    return f"{_text(table, width)}\n\n{SIDES}"


def detail(name: str | Part, width: int | None = None) -> str:
    """Every coefficient of one part in a unit of its size, with quoted figure and source.

    The remarks at the head of its file stand above, with the figures that were not found, and below
    its tolerances: how far specimens lie from it.

    Raises UserError where there is no such part.
    """
    p = part(name)
    title = f"{p.name}: {p.description}" if p.description else p.name
    tables = [_sourced("coefficient", "value", _rows(p), width)]
    if p.tolerances:
        tables.append(_sourced("tolerance", "specimens lie", _tolerances(p), width))
    head = textwrap.fill(remarks(name), min(width or WRAPPED, WRAPPED))
    below = [SIDES] if any("angle_random_walk" in s.values for s in (p.gyro, p.accel)) else []
    return "\n\n".join([title, *([head] if head else []), *tables, *below])


def as_data(name: str | Part | None = None) -> dict[str, Any]:
    """A part as data, or without a name each by its own: what its file says, values in SI.

    {``name``, ``description``, ``remarks`` at the head of its file, with the figures that were not
    found, ``sample_rate`` [Hz], ``coefficients``: {``gyro.effect.parameter``:
    {``value``, ``unit``, ``quoted``, ``source``}}, ``tolerances``: {the same: {``size``,
    ``unit``, ``distribution``, ``quoted``, ``source``}}}.
    """
    if name is None:
        return {own: as_data(own) for own in part_names()}
    p = part(name)
    coefficients = {
        ".".join((sensor.kind, effect, parameter)): {
            "value": values[parameter],
            "unit": sensor.unit(sensor.effect(effect).parameters[parameter].unit),
            **{k: p.notes.get((sensor.kind, effect, parameter), {}).get(k) for k in SAID},
        }
        for sensor in (p.gyro, p.accel, p.mag)
        for effect, values in sensor.values.items()
        for parameter in values
    }
    tolerances = {
        ".".join(t.key): {
            "size": t.array,
            "unit": t.si,
            "distribution": t.distribution,
            "quoted": t.quoted,
            "source": t.source,
        }
        for t in p.tolerances
    }
    return plain(
        {
            "name": p.name,
            "description": p.description,
            "remarks": remarks(name),
            "sample_rate": p.sample_rate,
            "coefficients": coefficients,
            "tolerances": tolerances,
        }
    )


def terminal_width() -> int | None:
    """Columns of the terminal that standard output goes to, None for a file or a pipe."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def _sourced(
    first: str, second: str, rows: Iterable[tuple[str, str, str, str]], width: int | None
) -> str:
    """A table of figures with what was quoted and where; the first two columns are not folded."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for heading in (first, second):
        table.add_column(heading, no_wrap=True)
    for heading in ("quoted", "source"):
        table.add_column(heading, ratio=1, min_width=LEAST)
    for row in rows:
        table.add_row(*row)
    return _text(table, width)


def _tolerances(p: Part) -> list[tuple[str, str, str, str]]:
    """Coefficient, how far specimens lie from the part in it, figure as quoted, source."""
    return [
        (".".join(t.key), t.size(4), t.quoted or ABSENT, t.source or ABSENT) for t in p.tolerances
    ]


def _rows(p: Part) -> list[tuple[str, str, str, str]]:
    """Coefficient, value, figure as quoted, source."""
    rate = p.notes.get(RATE_KEY, {})
    rows = [("sample_rate", f"{p.sample_rate:.10g} Hz", ABSENT, rate.get("source", ABSENT))]
    for kind in ("gyro", "accel"):
        sensor = p.sensor(kind)
        for e in sensor.effects:
            for name, q in e.parameters.items():
                key = (kind, e.name, name)
                note = p.notes.get(key)
                if note is None and np.all(sensor.values[e.name][name] == q.start):
                    continue
                si = told_apart(sensor.unit(q.unit), q.said)
                value = (
                    "estimated from data"
                    if key in p.estimate
                    else _value(sensor.values[e.name][name], si)
                )
                rows.append(
                    (
                        ".".join(key),
                        value,
                        (note or {}).get("quoted", ABSENT),
                        (note or {}).get("source", ABSENT),
                    )
                )
    return rows


def _value(values: np.ndarray, si: str) -> str:
    unit = unit_for(values, si)
    return f"{_numbers(in_unit(values, si, unit), 4)} {unit if unit != '1' else ''}".rstrip()


def _numbers(values: np.ndarray, digits: int) -> str:
    """One number for equal axes, else all of them; a matrix row by row."""
    if values.ndim == 2:
        return (
            "[" + "; ".join(" ".join(number(float(v), digits) for v in row) for row in values) + "]"
        )
    texts = [number(float(v), digits) for v in np.ravel(values)]
    return texts[0] if len(set(texts)) == 1 else " ".join(texts)


def _figure(p: Part, kind: str, effect: str, parameter: str, unit: str) -> str:
    """The largest axis of a coefficient.

    It is a dash where the part has none, leaves it to the data or switches it off.
    """
    sensor = p.sensor(kind)
    if effect not in sensor.values or (kind, effect, parameter) in p.estimate:
        return ABSENT
    largest = float(np.max(sensor.values[effect][parameter]))
    si = sensor.unit({e.name: e for e in sensor.effects}[effect].parameters[parameter].unit)
    return number(float(in_unit(largest, si, unit))) if largest else ABSENT


def _text(table, width: int | None) -> str:
    """The table as lines without trailing blanks, no narrower than what must not be folded."""
    from rich.console import Console
    from rich.measure import Measurement

    wide = Console(width=UNLIMITED)
    least = Measurement.get(wide, wide.options, table).minimum
    page = io.StringIO()
    Console(
        file=page,
        width=UNLIMITED if width is None else max(width, least),
        highlight=False,
        markup=False,
        emoji=False,
    ).print(table)
    return "\n".join(line.rstrip() for line in page.getvalue().splitlines())
