"""A system of FMUs as an SSP 1.0 file, for simulators that read such.

SSP is "System Structure and Parameterization" of the Modelica Association, version 1.0 (2019). What
its readers want beyond the standard is in the template: prefixes as the standard's examples have
them, parameters bound at the component, no connectors at the system's edge, plain ``Real``,
``Integer`` and ``Boolean`` for both versions of FMI, and an annotation without which OMSimulator
reads no step.
"""

from __future__ import annotations

import shutil
import zipfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import attrs

from pyimu.errors import UserError
from pyimu.files import whole
from pyimu.fmu.build import ZIP_TIME
from pyimu.fmu.sources import render
from pyimu.fmu.system import TYPES, Component, System
from pyimu.fmu.variables import xml_number

PARAMETERS = "resources/parameters.ssv"
"""The parameters once more, as one set for the whole system: fmpy takes it for a run, but ignores
what is bound to components."""

NANOSECONDS = 9


def whole_nanoseconds(period: float) -> float:
    """The period [s] in whole nanoseconds, at least one.

    Some simulators (libcosim) count them: 1/976 s is none, and their steps would fall behind the
    samples by one in 6.2 million. 976.00016 Hz has one.
    """
    return max(round(period, NANOSECONDS), 10.0**-NANOSECONDS)


def write_ssp(system: System, path: Path | str) -> Path:
    """Write ``system`` with its FMUs to ``path``; the same system gives the same bytes.

    Raises UserError where two different FMUs have one file name, and where the file cannot be
    written; then there is none.
    """
    files = _resources(system.components)
    context = _context(system)
    texts = {
        "SystemStructure.ssd": render("SystemStructure.ssd", context),
        PARAMETERS: render("parameters.ssv", context),
    }
    path = Path(path)
    with whole(path) as unfinished, zipfile.ZipFile(unfinished, "w") as archive:
        for name, text in texts.items():
            archive.writestr(_info(name), text.encode())
        for name, fmu in files.items():
            with fmu.open("rb") as source, archive.open(_info(name), "w") as target:
                shutil.copyfileobj(source, target)
    return path


def _info(name: str) -> zipfile.ZipInfo:
    info = zipfile.ZipInfo(name, ZIP_TIME)
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = 0o644 << 16
    info.create_system = 3
    return info


def _source(component: Component) -> str:
    return f"resources/{component.fmu.name}"


def _resources(components: Iterable[Component]) -> dict[str, Path]:
    files: dict[str, Path] = {}
    for c in components:
        other = files.setdefault(_source(c), c.fmu)
        if other.resolve() != c.fmu.resolve():
            raise UserError(f"{other} and {c.fmu} are two units of one file name; rename one")
    return files


def _context(system: System) -> dict[str, Any]:
    return {
        "system": system,
        "components": [_component(system, c) for c in system.components],
        "units": _units(system),
        "xml_value": _xml_value,
    }


def _component(system: System, component: Component) -> dict[str, Any]:
    """What the description says of a component: every output, and the inputs that are fed."""
    fed = {w.input.name for w in system.wires if w.end is component}
    inputs = [v for n, v in component.variables.items() if n in fed]
    return {
        "name": component.name,
        "source": _source(component),
        "connectors": [(v, TYPES[v.type]) for v in (*inputs, *component.outputs)],
        "parameters": [
            (name, TYPES[component.variables[name].type], value)
            for name, value in component.parameters.items()
        ],
    }


def _units(system: System) -> dict[str, dict[str, str]]:
    """Units of connectors by name, with the base units of the FMU that has them."""
    found: dict[str, dict[str, str]] = {}
    for c in system.components:
        fed = [w.input for w in system.wires if w.end is c]
        for unit in {v.unit for v in (*fed, *c.outputs) if v.unit}:
            base = c.base_unit(unit)
            found[unit] = {} if base is None else _attributes(base)
    return dict(sorted(found.items()))


def _attributes(base: Any) -> dict[str, str]:
    """What of a base unit is not at its default."""
    default = type(base)()
    return {
        name: str(value) if isinstance(value, int) else xml_number(value)
        for name, value in attrs.asdict(base).items()
        if value != getattr(default, name)
    }


def _xml_value(kind: str, value: float | int | bool) -> str:
    if kind == "Boolean":
        return "true" if value else "false"
    return str(int(value)) if kind == "Integer" else xml_number(value)
