"""Tables in JSON whose names stand apart from their rows.

Edge Impulse's acquisition format (its documentation, "Data acquisition format": ``payload`` with
``sensors``, ``values`` and ``interval_ms``); the ways in which pandas writes a frame (``to_json``:
``split``, ``columns``, ``index``); and a list of rows of which the first has the names.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from pyimu.errors import UserError


@dataclass(frozen=True)
class JsonTable:
    """Samples, each an object, and the sample rate [Hz] that the file states."""

    rows: list[dict[str, Any]]
    rate: float | None = None


def table_in(data: Any, where: object) -> JsonTable | None:
    """The table that ``data`` is, None of any other.

    Raises UserError for one of which rows and names differ in number.
    """
    if isinstance(data, list):
        if len(data) > 1 and all(isinstance(row, list) for row in data) and _are_texts(data[0]):
            return JsonTable(_rows(data[0], data[1:], where))
        if data and all(isinstance(row, list) and row and _are_numbers(row) for row in data):
            return JsonTable(_rows([f"column {k + 1}" for k in range(len(data[0]))], data, where))
        return None
    if not isinstance(data, dict):
        return None
    payload = data.get("payload")
    if isinstance(payload, dict) and isinstance(payload.get("sensors"), list):
        return _acquired(payload, where)
    names, rows = data.get("columns"), data.get("data")
    if isinstance(names, list) and isinstance(rows, list) and _are_texts(names):
        found, index = _rows(names, rows, where), data.get("index")
        if isinstance(index, list) and len(index) == len(found) and "index" not in names:
            found = [{"index": at, **row} for at, row in zip(index, found, strict=True)]
        return JsonTable(found)
    return _of_objects(data)


def _acquired(payload: dict[str, Any], where: object) -> JsonTable:
    """What Edge Impulse's tools acquired."""
    names = []
    for sensor in payload["sensors"]:
        name = sensor.get("name") if isinstance(sensor, dict) else None
        if not isinstance(name, str):
            raise UserError(f"{where}: payload.sensors: each has a name and units")
        unit = sensor.get("units")
        names.append(f"{name} [{unit}]" if isinstance(unit, str) and unit != "N/A" else name)
    values, interval = payload.get("values"), payload.get("interval_ms")
    if not isinstance(values, list):
        raise UserError(f"{where}: payload.values: a list of samples was expected")
    if len(names) == 1 and not any(isinstance(row, list) for row in values):
        values = [[value] for value in values]
    stated = isinstance(interval, (int, float)) and 1e-3 <= interval <= 1e6
    return JsonTable(_rows(names, values, where), 1000 / interval if stated else None)


def _rows(names: Sequence[str], rows: Sequence[Any], where: object) -> list[dict[str, Any]]:
    for number, row in enumerate(rows, 1):
        if not isinstance(row, list) or len(row) != len(names):
            there = f"{len(row)} values" if isinstance(row, list) else "no list"
            raise UserError(
                f"{where}: sample {number}: {there}, expected {len(names)} as there are names"
            )
    return [dict(zip(names, row, strict=True)) for row in rows]


def _of_objects(data: dict[str, Any]) -> JsonTable | None:
    """That of an object of objects: columns with numbered members, or numbered rows."""
    members = [value for value in data.values() if isinstance(value, dict)]
    if not data or len(members) < len(data) or not members[0]:
        return None
    keys = list(members[0])
    if any(list(member) != keys for member in members):
        return None
    if _are_numbered(keys) and not _are_numbered(list(data)):
        columns = [member.values() for member in members]
        return JsonTable([dict(zip(data, row, strict=True)) for row in zip(*columns, strict=True)])
    return JsonTable(members) if _are_numbered(list(data)) else None


def _are_texts(cells: Sequence[Any]) -> bool:
    return bool(cells) and all(isinstance(cell, str) for cell in cells)


def _are_numbers(cells: Sequence[Any]) -> bool:
    return all(cell is None or isinstance(cell, (int, float)) for cell in cells)


def _are_numbered(keys: Sequence[str]) -> bool:
    """Whether keys are 0, 1, 2 and so on, as pandas numbers rows."""
    return len(keys) > 1 and all(key == str(k) for k, key in enumerate(keys))
