"""The built-in parts in the library, and the sensors that are one of them by a parameter."""

from __future__ import annotations

from pyimu.errors import UserError
from pyimu.model.part import Part
from pyimu.model.part_file import part, part_names
from pyimu.model.signals import ALWAYS, inputs_for
from pyimu.modelica.names import camel, pascal
from pyimu.modelica.part_text import part_text
from pyimu.modelica.text import GENERATED, comment, number, rendered

DEFAULT = "imt30"
"""The part that a sensor is unless another is chosen."""


def parts() -> dict[str, Part]:
    """The built-in parts by the name of their packages."""
    return {pascal(name): part(name) for name in part_names()}


def part_texts() -> dict[str, str]:
    """Name to text of the package of each built-in part."""
    return {name: part_text(p, "PyImu.Sensors.Parts", name) for name, p in parts().items()}


def sensor_texts() -> dict[str, str]:
    """Name to text of what chooses among the parts."""
    found = parts()
    for p in found.values():
        extra = set(inputs_for(p.signals)) - set(ALWAYS)
        if extra:
            raise UserError(f"part {p.name} needs {', '.join(extra)}, which Sensors.Imu lacks")
    listed = [
        {"name": name, "block": camel(p.name), "period": number(p.sample_period)}
        for name, p in found.items()
    ]
    literals = ",\n    ".join(f"{name}{comment(p.description)}" for name, p in found.items())

    def selected(name: str, interface: str, what: str, unit: str, outputs: tuple[str, ...]) -> str:
        return GENERATED + rendered(
            "selected.mo",
            name=name,
            interface=interface,
            description=f"{what} of a built-in part",
            default=pascal(DEFAULT),
            unit=unit,
            parts=listed,
            outputs=outputs,
        )

    return {
        "Part": f"{GENERATED}within PyImu.Sensors;\ntype Part = enumeration(\n    {literals})\n"
        '  "The built-in parts";\n',
        "Imu": selected("Imu", "Imu", "Inertial measurement unit", "", ("gyro", "accel")),
        "Gyroscope": selected("Gyroscope", "Triad", "Gyroscope", "rad/s", ("y",)),
        "Accelerometer": selected("Accelerometer", "Triad", "Accelerometer", "m/s2", ("y",)),
    }
