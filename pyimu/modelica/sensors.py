"""The built-in parts in the library, and the sensors that are one of them by a parameter."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from pyimu.model.part import Part
from pyimu.model.part_file import part, part_names
from pyimu.model.signals import ALWAYS, SIGNALS, inputs_for
from pyimu.modelica.names import camel, identifier, pascal
from pyimu.modelica.part_text import connector, part_text
from pyimu.modelica.text import GENERATED, comment, number, rendered, wrapped

DEFAULT = "imt30"
"""The part that a sensor is unless another is chosen."""

IMU_OUTPUTS = ("gyro", "accel", "measuredTemperature")


def parts() -> dict[str, Part]:
    """The built-in parts by the name of their packages."""
    return {pascal(name): part(name) for name in part_names()}


def part_texts() -> dict[str, str]:
    """Name to text of the package of each built-in part."""
    return {name: part_text(p, "PyImu.Sensors.Parts", name) for name, p in parts().items()}


def sensor_texts(found: Mapping[str, Part]) -> dict[str, str]:
    """Name to text of what chooses among these parts, by the names of their packages."""
    literals = ",\n    ".join(f"{name}{comment(p.description)}" for name, p in found.items())
    return {
        "Part": f"{GENERATED}within PyImu.Sensors;\ntype Part = enumeration(\n    {literals})\n"
        '  "The built-in parts"\n  annotation(Documentation(info="<html>\n<p>What a sensor may be; '
        'figures and sources stand with Sensors.Parts.</p>\n</html>"));\n',
        "Imu": _selected(
            found,
            "Imu",
            "Inertial measurement unit",
            lambda p: p.signals,
            outputs=IMU_OUTPUTS,
        ),
        "Gyroscope": _selected(
            found, "Gyroscope", "Gyroscope", lambda p: p.gyro.signals, "Triad", "rad/s"
        ),
        "Accelerometer": _selected(
            found, "Accelerometer", "Accelerometer", lambda p: p.accel.signals, "Triad", "m/s2"
        ),
    }


def _selected(
    found: Mapping[str, Part],
    name: str,
    what: str,
    signals: Callable[[Part], Iterable[str]],
    interface: str = "Imu",
    unit: str = "",
    outputs: tuple[str, ...] = ("y",),
) -> str:
    """A sensor that is one of the parts; it has an input that some need where one of these is
    chosen.
    """
    extra = {n: [s for s in inputs_for(signals(p)) if s not in ALWAYS] for n, p in found.items()}
    wanted = [s for s in SIGNALS if any(s in needed for needed in extra.values())]
    return GENERATED + rendered(
        "selected.mo",
        name=name,
        interface=interface,
        description=f"{what} of a built-in part",
        default=pascal(DEFAULT),
        unit=unit,
        outputs=outputs,
        parts=[
            {
                "name": n,
                "block": camel(p.name),
                "period": number(p.sample_period),
                "extra": [identifier(camel(s)) for s in extra[n]],
            }
            for n, p in found.items()
        ],
        connectors=[
            line
            for s in wanted
            for line in wrapped(connector(s, _chosen(n for n in found if s in extra[n])))
        ],
    )


def _chosen(names: Iterable[str]) -> str:
    """The condition that one of these parts is chosen."""
    return " if " + " or ".join(f"part == PyImu.Sensors.Part.{name}" for name in names)
