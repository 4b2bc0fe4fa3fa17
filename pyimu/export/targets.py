"""The projects that a part can be written for, and writing it."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from pyimu.errors import UserError
from pyimu.export import estimators, simulators
from pyimu.export.densities import NAMES, lacking, present
from pyimu.files import write_text
from pyimu.model.part import Part
from pyimu.model.part_file import part as find_part
from pyimu.units import did_you_mean


@dataclass(frozen=True)
class Target:
    """A project: the file that it reads, and by what its docs say that noise is to be inflated.

    ``text`` makes the file of a part and a factor; ``reason`` says where the factor is from.
    ``words`` are what the file calls the noise of each sensor, and ``without`` is what the project
    does where that is missing; empty where the file then has no meaning.
    """

    file: str
    text: Callable[[Part, float], str]
    inflate: float
    reason: str
    words: Mapping[str, str]
    without: str


def _words(pattern: str, gyro: str, accel: str) -> dict[str, str]:
    """What a file calls the noise of each sensor."""
    return {"gyro": pattern.replace("?", gyro), "accel": pattern.replace("?", accel)}


_CONTINUOUS = "?_noise_density and ?_random_walk"
_NONE = "its docs name no factor"
_SIMULATED = "a simulated sensor is to err as the real one does"

TARGETS = {
    "kalibr": Target(
        "imu.yaml",
        estimators.kalibr,
        10.0,
        "Kalibr's wiki, IMU noise model: 10 times or more for low-cost sensors",
        _words(_CONTINUOUS, "gyroscope", "accelerometer"),
        "Kalibr asks for them: put them in",
    ),
    "openvins": Target(
        "kalibr_imu_chain.yaml",
        estimators.openvins,
        10.0,
        "OpenVINS' docs, sensor calibration: 10 to 20 times",
        _words(_CONTINUOUS, "gyroscope", "accelerometer"),
        "OpenVINS asks for them: put them in",
    ),
    "vins": Target(
        "vins_imu.yaml", estimators.vins, 1.0, _NONE, _words("?_n and ?_w", "gyr", "acc"), ""
    ),
    "gazebo": Target(
        "imu.sdf",
        simulators.gazebo,
        1.0,
        _SIMULATED,
        _words("<?>", *simulators.TRIADS.values()),
        "Gazebo simulates it without noise",
    ),
    "isaac": Target(
        "isaac_ros_visual_slam.yaml",
        estimators.isaac,
        1.0,
        _NONE,
        _words(_CONTINUOUS, "gyro", "accel"),
        "the node's own defaults stand",
    ),
    "ros2": Target(
        "ros2_imu.yaml",
        estimators.ros2,
        1.0,
        "a covariance is that of the samples",
        _words("?_covariance", "angular_velocity", "linear_acceleration"),
        "zeros, which sensor_msgs/Imu calls unknown",
    ),
    "matlab": Target(
        "imu_sensor.m",
        simulators.matlab,
        1.0,
        _SIMULATED,
        _words("?", "imu.Gyroscope", "imu.Accelerometer"),
        "imuSensor's ideal one stands",
    ),
    "px4": Target(
        "ekf2.params",
        estimators.px4,
        1.0,
        _NONE,
        _words("EKF2_?_NOISE and EKF2_?_B_NOISE", "GYR", "ACC"),
        "EKF2's defaults stand",
    ),
}
"""Projects by the name that ``--to`` takes."""


@dataclass(frozen=True)
class Exported:
    """The file of a project: its name and text, the factor on the noise, and where that is from.

    ``missing`` says what of the file the part has no noise for, empty where it has all.
    """

    target: str
    file: str
    text: str
    inflate: float
    reason: str
    missing: str = ""

    def said(self) -> str:
        """What was done to the noise, and what is missing, for people."""
        times = "as in the part" if self.inflate == 1.0 else f"{self.inflate:g} times the part's"
        return f"noise {times} ({self.reason}){self.missing and f'; {self.missing}'}"


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
    recommend. A part with the white noise of one sensor gives a file with that alone, and
    ``missing`` says so. Raises UserError for an unknown project, a factor that is not positive, a
    part without white noise, and one with that of one sensor where the file needs both.
    """
    (name,) = known(to)
    target, found = TARGETS[name], find_part(part)
    if inflate is not None and not 0 < inflate < 1e6:
        raise UserError(f"--inflate {inflate:g}: must be above 0 and below a million")
    factor = target.inflate if inflate is None else float(inflate)
    reason = target.reason if inflate is None else "as asked for"
    exported = Exported(to, target.file, "", factor, reason, _missing(to, found))
    text = target.text(found, factor).replace("{inflation}", exported.said())
    return replace(exported, text=text)


def export_all(
    part: str | os.PathLike | Part, to: str, inflate: float | None = None
) -> list[Exported]:
    """The files of the projects of a list by commas. Raises as ``export``, and says then which of
    them there could be.
    """
    made, refused = [], []
    for name in known(to):
        try:
            made.append(export(part, name, inflate))
        except UserError as error:
            refused.append(error)
    if refused and made:
        raise UserError(f"{refused[0]}; --to {','.join(e.target for e in made)} can be written")
    if refused:
        raise refused[0]
    return made


def _missing(to: str, part: Part) -> str:
    """What of a project's file the part has no noise for. Raises UserError where it needs that."""
    there, said, target = present(part), [], TARGETS[to]
    for kind in NAMES:
        if kind not in there:
            if not target.without:
                raise lacking(part, kind, f"the file of {to}")
            said.append(
                f"the part has no white noise of the {NAMES[kind]}, {target.words[kind]}: "
                f"{target.without}"
            )
    return "; ".join(said)


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
