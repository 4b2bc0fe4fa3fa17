"""The generated files of the Modelica library."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

from pyimu.attitude import attitude_ukf
from pyimu.block.compiled import source_folder
from pyimu.block.normals import edges
from pyimu.model.effects import EFFECTS
from pyimu.model.part_file import part
from pyimu.modelica.bench import benches
from pyimu.modelica.effect_text import effect_text
from pyimu.modelica.filters import filter_texts
from pyimu.modelica.imported import imported_text
from pyimu.modelica.kinematics import attitude_texts, drive_texts
from pyimu.modelica.names import pascal
from pyimu.modelica.sensors import DEFAULT, part_texts, parts, sensor_texts
from pyimu.modelica.signal_text import DERIVED, signal_text
from pyimu.modelica.text import GENERATED, rendered
from pyimu.modelica.ukf_text import c_prefix, ukf_classes, ukf_source

SOURCES = ("noise.c", "noise.h", "prefix.h")
"""Hand-written C of the units that the library brings along."""

C_SOURCES = "Resources/C-Sources"

PACKAGES: tuple[tuple[str, str, str, Callable[[], Mapping[str, str]]], ...] = (
    (
        "Effects",
        "Errors of sensors: each a package of its functions and blocks",
        (
            "Each package holds the functions of one effect, which are printed from its "
            "definition, and a block of them for each kind of sensor that can have it. An effect "
            "without memory has a form in continuous time as well."
        ),
        lambda: {pascal(e.name): effect_text(e) for e in EFFECTS},
    ),
    (
        "Signals",
        "Signals that follow from the course of others",
        (
            "What some effects depend on besides the inputs of a sensor: rates of change, mean "
            "squares, what follows from attitude and place."
        ),
        lambda: {pascal(name): signal_text(name) for name in DERIVED},
    ),
    (
        "Examples/Benches",
        "Each effect alone, with inputs that excite its branches",
        (
            "One model for each effect. Their values are compared in the tests with those of the "
            "definition, sample by sample."
        ),
        benches,
    ),
    (
        "Sensors/Parts",
        "The built-in parts",
        (
            "A package for each part: its gyroscope, its accelerometer, and both as a measurement "
            "unit. A part has the effects of which its data sheet says something."
        ),
        part_texts,
    ),
    (
        "Attitude/Functions",
        "Functions of quaternions, Rodrigues parameters and the Earth's rotation",
        (
            "Printed from pyimu.symbolic. Quaternions are Hamilton's, scalar first, from body to "
            "world axes (east, north, up)."
        ),
        attitude_texts,
    ),
    (
        "Rover/Functions",
        "Motion of the test drives as functions of time",
        "Printed from the unit RoverDrive on level ground and without vibration.",
        drive_texts,
    ),
    (
        "ShapingFilters",
        "Noises as filters on white noise in continuous time",
        (
            "From white noise of two-sided density 1 to the noise of one axis. The sampled noises "
            "of PyImu.Noise have the same densities far below half the sample rate."
        ),
        filter_texts,
    ),
)
"""Packages that hold generated files only: folder, description, text, classes."""

FOLDERS = tuple(folder for folder, *_ in PACKAGES)


@cache
def library() -> Mapping[str, str]:
    """Path below ``PyImu`` to text of every generated file."""
    found = {f"Sensors/{name}.mo": text for name, text in sensor_texts(parts()).items()}
    found["Noise/layerEdge.mo"] = _edges()
    for name in SOURCES:
        path = source_folder() / name
        found[f"{C_SOURCES}/{name}"] = path.read_text(encoding="utf-8")
    found |= _filter()
    for folder, description, text, classes in PACKAGES:
        found |= _package(folder, description, text, classes())
    return found


def _filter() -> dict[str, str]:
    """The attitude filter of the part that a sensor is unless another is chosen, and how the units
    of both look to an importer.
    """
    sensor = part(DEFAULT)
    block, prefix = attitude_ukf(sensor), c_prefix(DEFAULT)
    head = f"{GENERATED[3:].strip()} The attitude filter of the part {DEFAULT}."
    texts = ukf_classes(block, prefix, f"{prefix}.c", f"modelica://PyImu/{C_SOURCES}")
    return {
        "Interfaces/ImportedSensor.mo": imported_text(sensor.block, "ImportedSensor"),
        "Interfaces/ImportedFilter.mo": imported_text(block, "ImportedFilter"),
        f"{C_SOURCES}/{prefix}.c": ukf_source(block, prefix, head),
        **{
            f"Attitude/{name}.mo": f"{GENERATED}within PyImu.Attitude;\n{text}"
            for name, text in texts.items()
        },
    }


def _edges() -> str:
    """The table of the ziggurat as a function."""
    found = [repr(x) for x in edges().tolist()[:-1]]
    lines = [", ".join(found[i : i + 4]) + "," for i in range(0, len(found), 4)]
    return GENERATED + rendered("layerEdge.mo", lines=lines)


def _package(
    folder: str, description: str, text: str, classes: Mapping[str, str]
) -> dict[str, str]:
    """The files of a package with these classes in this order."""
    *above, name = Path(folder).parts
    package = GENERATED + rendered(
        "package.mo",
        within=".".join(("PyImu", *above)),
        name=name,
        description=description,
        documentation=text,
    )
    return {
        f"{folder}/package.mo": package,
        f"{folder}/package.order": "".join(f"{name}\n" for name in classes),
        **{f"{folder}/{name}.mo": text for name, text in classes.items()},
    }
