"""The projects that a part can be written for, and writing it."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pyimu.errors import UserError
from pyimu.export import estimators, simulators
from pyimu.export.densities import densities
from pyimu.files import write_text
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.units import did_you_mean


@dataclass(frozen=True)
class Target:
    """A project: the file that it reads, and by what its docs say that noise is to be inflated.

    ``text`` makes the file of a part and a factor; ``reason`` says where the factor is from.
    """

    file: str
    text: Callable[[Part, float], str]
    inflate: float
    reason: str


_NONE = "its docs name no factor"
_SIMULATED = "a simulated sensor is to err as the real one does"

TARGETS = {
    "kalibr": Target(
        "imu.yaml",
        estimators.kalibr,
        10.0,
        "Kalibr's wiki, IMU noise model: 10 times or more for low-cost sensors",
    ),
    "openvins": Target(
        "kalibr_imu_chain.yaml",
        estimators.openvins,
        10.0,
        "OpenVINS' docs, sensor calibration: 10 to 20 times",
    ),
    "vins": Target("vins_imu.yaml", estimators.vins, 1.0, _NONE),
    "gazebo": Target("imu.sdf", simulators.gazebo, 1.0, _SIMULATED),
    "isaac": Target("isaac_ros_visual_slam.yaml", estimators.isaac, 1.0, _NONE),
    "ros2": Target("ros2_imu.yaml", estimators.ros2, 1.0, "a covariance is that of the samples"),
    "matlab": Target("imu_sensor.m", simulators.matlab, 1.0, _SIMULATED),
    "px4": Target("ekf2.params", estimators.px4, 1.0, _NONE),
}
"""Projects by the name that ``--to`` takes."""


@dataclass(frozen=True)
class Exported:
    """The file of a project: its name and text, the factor on the noise, and where that is from."""

    target: str
    file: str
    text: str
    inflate: float
    reason: str

    def said(self) -> str:
        """What was done to the noise, for people."""
        if self.inflate == 1.0:
            return f"noise as in the part ({self.reason})"
        return f"noise {self.inflate:g} times the part's ({self.reason})"


def known(to: str) -> tuple[str, ...]:
    """The projects of a list by commas, each once. Raises UserError for one that is not known."""
    names = tuple(dict.fromkeys(name.strip() for name in to.split(",")))
    for name in names:
        if name not in TARGETS:
            raise UserError(
                f"{name or repr(name)}: no project to export to{did_you_mean(name, TARGETS)}; "
                f"known are {', '.join(TARGETS)}"
            )
    return names


def export(part: str | os.PathLike | Part, to: str, inflate: float | None = None) -> Exported:
    """The file of project ``to`` (a key of ``TARGETS``) for a part.

    ``inflate`` multiplies the roots of the noise's densities; None is what the project's docs
    recommend. Raises UserError for an unknown project, a factor that is not positive, and a part
    that lacks white noise.
    """
    (name,) = known(to)
    target, found = TARGETS[name], find_part(part)
    if inflate is not None and not 0 < inflate < 1e6:
        raise UserError(f"--inflate {inflate:g}: must be above 0 and below a million")
    factor = target.inflate if inflate is None else float(inflate)
    reason = target.reason if inflate is None else "as asked for"
    for kind in ("gyro", "accel"):
        densities(found, kind)
    exported = Exported(to, target.file, "", factor, reason)
    text = target.text(found, factor).replace("{inflation}", exported.said())
    return Exported(to, target.file, text, factor, reason)


def write(
    part: str | os.PathLike | Part,
    to: str,
    folder: str | os.PathLike = ".",
    inflate: float | None = None,
) -> Path:
    """Write the file of project ``to`` into ``folder``, and give its path. Raises as ``export``."""
    made = export(part, to, inflate)
    path = Path(folder) / made.file
    write_text(path, made.text)
    return path
