"""The coefficients of the model in rows that the page and the terminal share."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from pyimu.identification.model.as_part import element, si_of
from pyimu.identification.model.estimated import Estimated
from pyimu.identification.outcome import Outcome
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import AXES
from pyimu.report.numbers import MISSING, in_unit, number, unit_for

ORIGINS = {
    "declared": "declared",
    "fixed": "fixed",
    "estimated": "estimated here",
    "changed": "declared otherwise, estimated here",
    "added": "added here",
}

NOT_SHOWN = "not shown"

LEGEND = (
    "Intervals: 95 %; what has none was declared, or read off the raw samples. 'not shown': these "
    "logs say nothing of it, or less than is known of any consumer part beforehand. N is the root "
    "of the two-sided density."
)


@dataclass(frozen=True)
class Row:
    """One row of the model: name, unit, a cell for each axis, where it is from, and its source."""

    name: str
    unit: str
    cells: tuple[str, ...]
    origin: str
    source: str


def rows(closed: Outcome, kind: str) -> list[Row]:
    """All coefficients of a sensor, a row for three axes."""
    return [row for v in closed.estimated if v.sensor == kind for row in _rows(v)]


def _rows(v: Estimated) -> Iterator[Row]:
    si = si_of(v.effect, v.parameter, v.unit)
    unit = "degC" if si == "degC" else unit_for(v.value, si)
    allowed = CATALOGUE[v.effect].parameters[v.parameter].indices
    if not any(v.shown[i] for i in allowed):
        cells = (NOT_SHOWN,) * 3 if v.value.shape else (NOT_SHOWN, "", "")
        yield Row(f"{v.effect} {v.parameter}", unit, cells, "not shown by these logs", "")
        return
    columns = CATALOGUE[v.effect].parameters[v.parameter].columns
    for label, indices in _lines(v.value.shape, columns):
        cells = tuple(_cell(v, i, unit) if i in allowed else "" for i in indices)
        told = {*cells} - {"", NOT_SHOWN}
        if told == {MISSING}:
            continue  # elements of a matrix that were not taken up
        origin = ORIGINS[v.origin] if told else "not shown by these logs"
        yield Row(f"{v.effect} {v.parameter}{label}", unit, cells, origin, v.source)


def _lines(shape: tuple[int, ...], columns: tuple[str, ...]) -> Iterator[tuple[str, list]]:
    """The elements of a coefficient in rows of three; a matrix may name its ``columns``."""
    if not shape:
        yield "", [(), None, None]
    elif shape == (3,):
        yield "", [(i,) for i in range(3)]
    elif shape == (3, 3):
        for i in range(3):
            yield f", {AXES[i]} from", [(i, j) for j in range(3)]
    elif len(shape) == 1:
        for k in range(shape[0]):
            yield f" {k + 1}", [(k,), None, None]
    else:
        for k in range(shape[1]):
            yield f" {columns[k] if columns else k + 1}", [(i, k) for i in range(3)]


def _cell(v: Estimated, index: tuple[int, ...], unit: str) -> str:
    if not v.shown[index]:
        return NOT_SHOWN
    if not np.isfinite(v.std[index]):
        nothing = v.origin == "added" and not v.value[index]
        value = float(in_unit(v.value[index], si_of(v.effect, v.parameter, v.unit), unit))
        return MISSING if nothing else number(value, 4)
    return element(v, index, unit)
